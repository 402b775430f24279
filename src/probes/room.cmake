# What goes with the files for engines travels inside the binary.
include(Embed)
file(GLOB NAMES CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_LIST_DIR}/formats/shipped
     ${CMAKE_CURRENT_LIST_DIR}/formats/shipped/*)
list(SORT NAMES)
rnm_embed(embedded_probe_files ${CMAKE_CURRENT_LIST_DIR}/formats/shipped ROOM_SOURCES ${NAMES})
