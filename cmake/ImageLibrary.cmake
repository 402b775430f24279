# OpenImageIO, without the include folders that its package names but does not bring (Debian 12's wants
# /usr/include/opencv4, which no header of OpenImageIO that we use needs).
find_package(OpenImageIO REQUIRED)
get_target_property(OIIO_FOLDERS OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
foreach(FOLDER IN LISTS OIIO_FOLDERS)
  if(IS_ABSOLUTE "${FOLDER}" AND NOT EXISTS "${FOLDER}")
    list(REMOVE_ITEM OIIO_FOLDERS "${FOLDER}")
  endif()
endforeach()
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${OIIO_FOLDERS}")
