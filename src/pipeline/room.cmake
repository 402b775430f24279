# What goes with a delivery to an engine travels inside the binary (deliver/engines/shipped_files.h).
include(Embed)
foreach(FOLDER web/threejs web/playcanvas web/babylon engines/unity engines/unreal engines/source engines/bevy)
  file(GLOB NAMES CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}/${FOLDER} ${CMAKE_SOURCE_DIR}/${FOLDER}/*.*)
  list(SORT NAMES)
  get_filename_component(ENGINE ${FOLDER} NAME)
  rnm_embed(embedded_${ENGINE}_files ${CMAKE_SOURCE_DIR}/${FOLDER} ROOM_SOURCES ${NAMES})
endforeach()
