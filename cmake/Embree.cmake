# Embree.cmake - finds Embree 4 or 3 as target `embree`, and says which through RNMBAKE_EMBREE_MAJOR.
find_package(embree 4 QUIET CONFIG)
if(NOT embree_FOUND)
  find_package(embree 3.12 REQUIRED CONFIG)
endif()
string(REGEX MATCH "^[0-9]+" RNMBAKE_EMBREE_MAJOR "${embree_VERSION}")
message(STATUS "Embree ${embree_VERSION}")
