# What goes with a delivery for the web travels inside the binary.
include(Embed)
file(GLOB NAMES CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}/web/threejs ${CMAKE_SOURCE_DIR}/web/threejs/*.*)
list(SORT NAMES)
rnm_embed(embedded_threejs_files ${CMAKE_SOURCE_DIR}/web/threejs ROOM_SOURCES ${NAMES})
