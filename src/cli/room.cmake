# doctor names the image library that this build links.
set_source_files_properties(${CMAKE_SOURCE_DIR}/src/cli/doctor.cpp
  PROPERTIES COMPILE_DEFINITIONS RNMBAKE_OPENIMAGEIO_VERSION="${OpenImageIO_VERSION}")
