# Writes OUTPUT, a C++ file whose FUNCTION returns the FILES below ROOT, name and text, in this order.
# Run at build time: cmake -DROOT=... -DOUTPUT=... -DFUNCTION=... -DFILES="a.py,core/b.py" -P Embed.cmake
# Included without OUTPUT it provides rnm_embed(FUNCTION ROOT VARIABLE names...) instead.
if(DEFINED OUTPUT)
  set(TYPE "std::vector<std::pair<const char*, const char*>>")
  set(TEXT "#include <utility>\n#include <vector>\n\nnamespace rnmbake {\n\nconst ${TYPE}& ${FUNCTION}();\n\n")
  string(APPEND TEXT "const ${TYPE}& ${FUNCTION}() {\n")
  string(APPEND TEXT "  static const ${TYPE} files = {\n")
  string(REPLACE "," ";" FILES "${FILES}")
  foreach(NAME IN LISTS FILES)
    file(READ "${ROOT}/${NAME}" CONTENT)
    string(APPEND TEXT "      {\"${NAME}\", R\"embedded_file(${CONTENT})embedded_file\"},\n")
  endforeach()
  string(APPEND TEXT "  };\n  return files;\n}\n\n}  // namespace rnmbake\n")
  file(WRITE "${OUTPUT}" "${TEXT}")
  return()
endif()

set(RNM_EMBED "${CMAKE_CURRENT_LIST_FILE}" CACHE INTERNAL "")

# Appends to VARIABLE a generated source with FUNCTION, which returns these files of ROOT.
function(rnm_embed FUNCTION ROOT VARIABLE)
  list(TRANSFORM ARGN PREPEND "${ROOT}/" OUTPUT_VARIABLE PATHS)
  list(JOIN ARGN "," JOINED)
  set(GENERATED "${CMAKE_BINARY_DIR}/generated/${FUNCTION}.cpp")
  # The list of names is part of the command, so Ninja notices removals, too.
  add_custom_command(OUTPUT "${GENERATED}"
    COMMAND "${CMAKE_COMMAND}" "-DROOT=${ROOT}" "-DOUTPUT=${GENERATED}" "-DFUNCTION=${FUNCTION}"
            "-DFILES=${JOINED}" -P "${RNM_EMBED}"
    DEPENDS ${PATHS} "${RNM_EMBED}" VERBATIM COMMENT "Embedding ${ROOT}")
  set(${VARIABLE} ${${VARIABLE}} "${GENERATED}" PARENT_SCOPE)
endfunction()
