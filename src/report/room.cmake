# The report's page travels inside the binary.
include(EmbedReport)
rnm_embed_report(${CMAKE_CURRENT_LIST_DIR}/html ROOM_SOURCES)
