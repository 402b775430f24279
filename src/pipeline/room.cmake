# What goes with a delivery for the web travels inside the binary.
include(Embed)
file(GLOB NAMES CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}/web/threejs ${CMAKE_SOURCE_DIR}/web/threejs/*.*)
list(SORT NAMES)
rnm_embed(embedded_threejs_files ${CMAKE_SOURCE_DIR}/web/threejs ROOM_SOURCES ${NAMES})
file(GLOB NAMES CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_LIST_DIR}/deliver/engines/shipped
     ${CMAKE_CURRENT_LIST_DIR}/deliver/engines/shipped/*)
list(SORT NAMES)
rnm_embed(embedded_engine_files ${CMAKE_CURRENT_LIST_DIR}/deliver/engines/shipped ROOM_SOURCES ${NAMES})
