# The version has one home: project() in the top CMakeLists.txt.
set_source_files_properties(${CMAKE_SOURCE_DIR}/src/cli/app.cpp
  PROPERTIES COMPILE_DEFINITIONS RNMBAKE_VERSION="${PROJECT_VERSION}")
set_source_files_properties(${CMAKE_SOURCE_DIR}/src/cli/doctor.cpp
  PROPERTIES COMPILE_DEFINITIONS "RNMBAKE_VERSION=\"${PROJECT_VERSION}\";RNMBAKE_OPENIMAGEIO_VERSION=\"${OpenImageIO_VERSION}\"")
