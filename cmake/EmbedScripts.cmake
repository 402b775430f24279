# Writes OUTPUT, a C++ file that holds the text of every FILE below ROOT.
# Run at build time: cmake -DROOT=... -DOUTPUT=... -DFILES="a.py,core/b.py" -P EmbedScripts.cmake
# Included without OUTPUT it provides rnm_embed_scripts(ROOT VARIABLE) instead.
if(DEFINED OUTPUT)
  set(TEXT "#include \"blender/scripts.h\"\n\nnamespace rnmbake {\n\n")
  string(APPEND TEXT "const std::vector<EmbeddedScript>& embedded_scripts() {\n")
  string(APPEND TEXT "  static const std::vector<EmbeddedScript> scripts = {\n")
  string(REPLACE "," ";" FILES "${FILES}")
  foreach(NAME IN LISTS FILES)
    file(READ "${ROOT}/${NAME}" CONTENT)
    string(APPEND TEXT "      {\"${NAME}\", R\"embedded_py(${CONTENT})embedded_py\"},\n")
  endforeach()
  string(APPEND TEXT "  };\n  return scripts;\n}\n\n}  // namespace rnmbake\n")
  file(WRITE "${OUTPUT}" "${TEXT}")
  return()
endif()

set(RNM_EMBED_SCRIPTS "${CMAKE_CURRENT_LIST_FILE}" CACHE INTERNAL "")

# Appends to VARIABLE a generated source with all Python files below ROOT; a new, changed or removed file
# makes the next build write it anew.
function(rnm_embed_scripts ROOT VARIABLE)
  file(GLOB_RECURSE NAMES CONFIGURE_DEPENDS RELATIVE "${ROOT}" "${ROOT}/*.py")
  list(SORT NAMES)
  list(TRANSFORM NAMES PREPEND "${ROOT}/" OUTPUT_VARIABLE PATHS)
  list(JOIN NAMES "," JOINED)
  set(GENERATED "${CMAKE_BINARY_DIR}/generated/embedded_scripts.cpp")
  # The list of names is part of the command, so Ninja notices removals, too.
  add_custom_command(OUTPUT "${GENERATED}"
    COMMAND "${CMAKE_COMMAND}" "-DROOT=${ROOT}" "-DOUTPUT=${GENERATED}" "-DFILES=${JOINED}" -P "${RNM_EMBED_SCRIPTS}"
    DEPENDS ${PATHS} "${RNM_EMBED_SCRIPTS}" VERBATIM COMMENT "Embedding the Blender scripts")
  set(${VARIABLE} ${${VARIABLE}} "${GENERATED}" PARENT_SCOPE)
endfunction()
