# What goes with a delivery for the web travels inside the binary.
include(Embed)
foreach(ENGINE threejs playcanvas babylon)
  file(GLOB NAMES CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}/web/${ENGINE} ${CMAKE_SOURCE_DIR}/web/${ENGINE}/*.*)
  list(SORT NAMES)
  rnm_embed(embedded_${ENGINE}_files ${CMAKE_SOURCE_DIR}/web/${ENGINE} ROOM_SOURCES ${NAMES})
endforeach()
file(GLOB NAMES CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_LIST_DIR}/deliver/engines/shipped
     ${CMAKE_CURRENT_LIST_DIR}/deliver/engines/shipped/*)
list(SORT NAMES)
rnm_embed(embedded_engine_files ${CMAKE_CURRENT_LIST_DIR}/deliver/engines/shipped ROOM_SOURCES ${NAMES})

# What goes with a delivery to Unity.
file(GLOB NAMES CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}/engines/unity ${CMAKE_SOURCE_DIR}/engines/unity/*.*)
list(SORT NAMES)
rnm_embed(embedded_unity_files ${CMAKE_SOURCE_DIR}/engines/unity ROOM_SOURCES ${NAMES})
