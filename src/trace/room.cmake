# The light tree weighs several lights at a time where a square root need not report errors.
set_source_files_properties(${CMAKE_SOURCE_DIR}/src/trace/lights/light_tree.cpp PROPERTIES
  COMPILE_OPTIONS "-fno-math-errno;-fno-trapping-math")
