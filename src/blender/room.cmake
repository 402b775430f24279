# The Python scripts travel inside the binary; a new, changed or removed file makes the next build write them anew.
include(Embed)
file(GLOB_RECURSE NAMES CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}/blender_scripts
     ${CMAKE_SOURCE_DIR}/blender_scripts/*.py)
list(SORT NAMES)
rnm_embed(embedded_scripts ${CMAKE_SOURCE_DIR}/blender_scripts ROOM_SOURCES ${NAMES})
