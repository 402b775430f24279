# The pages travel inside the binary.
include(Embed)
rnm_embed(embedded_report ${CMAKE_CURRENT_LIST_DIR}/html ROOM_SOURCES head.html page.html style.css
          data.js colour.js format.js charts.js viewer.js objects.js sections.js main.js)
rnm_embed(embedded_study ${CMAKE_CURRENT_LIST_DIR}/html ROOM_SOURCES study.html study.js)
