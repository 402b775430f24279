# The Python scripts travel inside the binary.
include(EmbedScripts)
rnm_embed_scripts(${CMAKE_SOURCE_DIR}/blender_scripts ROOM_SOURCES)
