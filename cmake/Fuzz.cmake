# Fuzz targets (clang's libFuzzer): ./dev fuzz. Everything is then built for them: address and undefined-behaviour
# sanitizers, coverage for the fuzzer.
if(NOT RNMBAKE_FUZZ)
  function(rnm_fuzz_targets)
  endfunction()
  return()
endif()

if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  message(FATAL_ERROR "RNMBAKE_FUZZ needs clang: -DCMAKE_CXX_COMPILER=clang++")
endif()
add_compile_options(-fsanitize=fuzzer-no-link,address,undefined,float-cast-overflow
                    -fno-sanitize-recover=all -fno-omit-frame-pointer)
add_link_options(-fsanitize=address,undefined)

function(rnm_fuzz_targets)
  # The one file of the trace room that reads a scene; the rest of it needs Embree.
  add_executable(exchange_fuzz EXCLUDE_FROM_ALL ${CMAKE_SOURCE_DIR}/tests/fuzz/exchange_fuzz.cpp
                                                ${CMAKE_SOURCE_DIR}/src/trace/geometry/triangles.cpp)
  target_link_options(exchange_fuzz PRIVATE -fsanitize=fuzzer)
  add_executable(exchange_seeds EXCLUDE_FROM_ALL ${CMAKE_SOURCE_DIR}/tests/fuzz/exchange_seeds.cpp)
  foreach(TARGET exchange_fuzz exchange_seeds)
    target_include_directories(${TARGET} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
    target_link_libraries(${TARGET} PRIVATE scene rnm_warnings)
  endforeach()
  # What a launch leaves behind; one file of the pipeline room, the rest of which needs Embree.
  add_executable(launch_fuzz EXCLUDE_FROM_ALL ${CMAKE_SOURCE_DIR}/tests/fuzz/launch_fuzz.cpp
                                              ${CMAKE_SOURCE_DIR}/src/pipeline/scene/launch_answer.cpp)
  target_link_options(launch_fuzz PRIVATE -fsanitize=fuzzer)
  add_executable(launch_seeds EXCLUDE_FROM_ALL ${CMAKE_SOURCE_DIR}/tests/fuzz/launch_seeds.cpp)
  foreach(TARGET launch_fuzz launch_seeds)
    target_include_directories(${TARGET} PRIVATE ${CMAKE_SOURCE_DIR}/tests)
    target_link_libraries(${TARGET} PRIVATE blender scene rnm_warnings)
  endforeach()
  # Project files, and basis files, whose reader stands in the cli room.
  add_executable(project_fuzz EXCLUDE_FROM_ALL ${CMAKE_SOURCE_DIR}/tests/fuzz/project_fuzz.cpp
                                               ${CMAKE_SOURCE_DIR}/src/cli/bases/basis_file.cpp)
  target_link_options(project_fuzz PRIVATE -fsanitize=fuzzer)
  target_link_libraries(project_fuzz PRIVATE config encoding tomlplusplus::tomlplusplus rnm_warnings)
  add_executable(project_seeds EXCLUDE_FROM_ALL ${CMAKE_SOURCE_DIR}/tests/fuzz/project_seeds.cpp)
  target_link_libraries(project_seeds PRIVATE config rnm_warnings)
  # Flags and pictures; the libraries that read pictures are the system's, without sanitizers.
  add_executable(ssbump_fuzz EXCLUDE_FROM_ALL ${CMAKE_SOURCE_DIR}/tests/fuzz/ssbump_fuzz.cpp)
  target_link_options(ssbump_fuzz PRIVATE -fsanitize=fuzzer)
  target_link_libraries(ssbump_fuzz PRIVATE cli cli11 rnm_warnings)
  add_executable(ssbump_seeds EXCLUDE_FROM_ALL ${CMAKE_SOURCE_DIR}/tests/fuzz/ssbump_seeds.cpp)
  target_link_libraries(ssbump_seeds PRIVATE image base rnm_warnings)
endfunction()
