#The shaders travel inside the binary; a new, changed or removed file makes the next build write them anew.
include(Embed)
file(GLOB NAMES CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}/shaders
     ${CMAKE_SOURCE_DIR}/shaders/*.* ${CMAKE_SOURCE_DIR}/shaders/engines/*.* ${CMAKE_SOURCE_DIR}/shaders/wgsl/*.*)
list(FILTER NAMES EXCLUDE REGEX "\\.md$")
list(SORT NAMES)
rnm_embed(embedded_shaders ${CMAKE_SOURCE_DIR}/shaders ROOM_SOURCES ${NAMES})
