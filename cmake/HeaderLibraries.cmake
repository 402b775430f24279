# Libraries whose packages differ in what they ship, behind one name each.
add_library(json INTERFACE)
find_package(nlohmann_json QUIET)
if(nlohmann_json_FOUND)
  target_link_libraries(json INTERFACE nlohmann_json::nlohmann_json)
else()
  find_path(RNMBAKE_JSON_INCLUDE nlohmann/json.hpp REQUIRED)
  target_include_directories(json SYSTEM INTERFACE ${RNMBAKE_JSON_INCLUDE})
endif()

add_library(cli11 INTERFACE)
find_path(RNMBAKE_CLI11_INCLUDE CLI/CLI.hpp REQUIRED)
target_include_directories(cli11 SYSTEM INTERFACE ${RNMBAKE_CLI11_INCLUDE})

add_library(zstd INTERFACE)
find_path(RNMBAKE_ZSTD_INCLUDE zstd.h REQUIRED)
find_library(RNMBAKE_ZSTD_LIBRARY zstd REQUIRED)
target_include_directories(zstd SYSTEM INTERFACE ${RNMBAKE_ZSTD_INCLUDE})
target_link_libraries(zstd INTERFACE ${RNMBAKE_ZSTD_LIBRARY})

add_library(xxhash INTERFACE) # compiled in through XXH_INLINE_ALL
find_path(RNMBAKE_XXHASH_INCLUDE xxhash.h REQUIRED)
target_include_directories(xxhash SYSTEM INTERFACE ${RNMBAKE_XXHASH_INCLUDE})

add_library(utf8proc INTERFACE)
find_path(RNMBAKE_UTF8PROC_INCLUDE utf8proc.h REQUIRED)
find_library(RNMBAKE_UTF8PROC_LIBRARY utf8proc REQUIRED)
target_include_directories(utf8proc SYSTEM INTERFACE ${RNMBAKE_UTF8PROC_INCLUDE})
target_link_libraries(utf8proc INTERFACE ${RNMBAKE_UTF8PROC_LIBRARY})

add_library(stb INTERFACE) # one header, compiled in
find_path(RNMBAKE_STB_INCLUDE stb_rect_pack.h PATH_SUFFIXES stb REQUIRED)
target_include_directories(stb SYSTEM INTERFACE ${RNMBAKE_STB_INCLUDE})
