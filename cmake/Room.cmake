# rnm_room(NAME [COLD] [LINK libs...] [PRIVATE libs...]) - the static library of src/NAME.
# COLD: it parses, plans and waits, so that its time is that of its compiler; -O1 for half of that.
# A room that generates sources does so in src/NAME/room.cmake, which may append to ROOM_SOURCES.

add_library(rnm_warnings INTERFACE)
target_compile_options(rnm_warnings INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor)
if(CMAKE_UNITY_BUILD) # these two would speak of names that another file of the same batch has
  target_compile_options(rnm_warnings INTERFACE -Wno-subobject-linkage)
else()
  target_compile_options(rnm_warnings INTERFACE -Wshadow)
endif()
if(RNMBAKE_WERROR)
  target_compile_options(rnm_warnings INTERFACE -Werror)
endif()

function(rnm_cold TARGET)
  target_compile_options(${TARGET} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

function(rnm_room NAME)
  cmake_parse_arguments(ROOM "COLD" "" "LINK;PRIVATE" ${ARGN})
  file(GLOB_RECURSE ROOM_SOURCES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/${NAME}/*.cpp)
  if(EXISTS ${CMAKE_SOURCE_DIR}/src/${NAME}/room.cmake)
    include(${CMAKE_SOURCE_DIR}/src/${NAME}/room.cmake)
  endif()
  if(ROOM_SOURCES)
    add_library(${NAME} STATIC ${ROOM_SOURCES})
    target_include_directories(${NAME} PUBLIC ${CMAKE_SOURCE_DIR}/src)
    target_link_libraries(${NAME} PUBLIC ${ROOM_LINK} PRIVATE ${ROOM_PRIVATE} rnm_warnings)
    if(ROOM_COLD)
      rnm_cold(${NAME})
    endif()
  else()
    add_library(${NAME} INTERFACE)
    target_include_directories(${NAME} INTERFACE ${CMAKE_SOURCE_DIR}/src)
    target_link_libraries(${NAME} INTERFACE ${ROOM_LINK})
  endif()
endfunction()
