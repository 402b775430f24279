# Writes OUTPUT, a C++ file that holds the page, the styles and the scripts of the HTML report (ROOT).
# Run at build time: cmake -DROOT=... -DOUTPUT=... -DSCRIPTS="a.js,b.js" -P EmbedReport.cmake
# Included without OUTPUT it provides rnm_embed_report(ROOT VARIABLE) instead.
if(DEFINED OUTPUT)
  string(REPLACE "," ";" SCRIPTS "${SCRIPTS}")
  set(SCRIPT "")
  foreach(NAME IN LISTS SCRIPTS)
    file(READ "${ROOT}/${NAME}" CONTENT)
    string(APPEND SCRIPT "${CONTENT}\n")
  endforeach()
  file(READ "${ROOT}/page.html" PAGE)
  file(READ "${ROOT}/style.css" STYLE)
  set(TEXT "#include \"report/html_parts.h\"\n\nnamespace rnmbake {\n\n")
  foreach(PART PAGE STYLE SCRIPT)
    string(TOLOWER "${PART}" LOWER)
    string(APPEND TEXT "const char* const html_${LOWER} = R\"report_part(${${PART}})report_part\";\n\n")
  endforeach()
  string(APPEND TEXT "}  // namespace rnmbake\n")
  file(WRITE "${OUTPUT}" "${TEXT}")
  return()
endif()

set(RNM_EMBED_REPORT "${CMAKE_CURRENT_LIST_FILE}" CACHE INTERNAL "")

# Appends to VARIABLE a generated source with the files of ROOT. The scripts become one, in this order.
function(rnm_embed_report ROOT VARIABLE)
  set(SCRIPTS data.js colour.js format.js charts.js viewer.js objects.js sections.js main.js)
  list(TRANSFORM SCRIPTS PREPEND "${ROOT}/" OUTPUT_VARIABLE PATHS)
  list(JOIN SCRIPTS "," JOINED)
  set(GENERATED "${CMAKE_BINARY_DIR}/generated/html_parts.cpp")
  add_custom_command(OUTPUT "${GENERATED}"
    COMMAND "${CMAKE_COMMAND}" "-DROOT=${ROOT}" "-DOUTPUT=${GENERATED}" "-DSCRIPTS=${JOINED}" -P "${RNM_EMBED_REPORT}"
    DEPENDS ${PATHS} "${ROOT}/page.html" "${ROOT}/style.css" "${RNM_EMBED_REPORT}" VERBATIM
    COMMENT "Embedding the report's page")
  set(${VARIABLE} ${${VARIABLE}} "${GENERATED}" PARENT_SCOPE)
endfunction()
