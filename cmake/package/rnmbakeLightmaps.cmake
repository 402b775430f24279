# rnmbakeLightmaps.cmake - lightmaps as a part of a build (docs/builds.md).
cmake_minimum_required(VERSION 3.21) # CMP0116: depfiles of Ninja relative to the build folder

# rnmbake_add_lightmaps(TARGET name SCENE file OUTPUT dir
#                       [CONFIG project.toml] [OBJECTS pattern...] [FLAGS flag...] [DEPENDS file...] [JOB_POOL pool] [ALL])
#
# Target NAME bakes SCENE into OUTPUT whenever the scene, CONFIG or a file that either reads has changed. OUTPUT/manifest.json
# stands for all of it: depend on that file. Target property RNMBAKE_MANIFEST has its path. SCENE and CONFIG are relative to the
# source folder, OUTPUT to the build folder.
#
# With Ninja the bake has the terminal, and shows its progress; as one rule at a time has it, bakes run one after the other.
# JOB_POOL takes a pool of yours instead.
function(rnmbake_add_lightmaps)
  cmake_parse_arguments(PARSE_ARGV 0 BAKE "ALL" "TARGET;SCENE;CONFIG;OUTPUT;JOB_POOL" "OBJECTS;FLAGS;DEPENDS")
  foreach(WANTED TARGET SCENE OUTPUT)
    if(NOT BAKE_${WANTED})
      message(FATAL_ERROR "rnmbake_add_lightmaps: ${WANTED} is missing")
    endif()
  endforeach()
  if(BAKE_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "rnmbake_add_lightmaps: what is ${BAKE_UNPARSED_ARGUMENTS}?")
  endif()
  cmake_path(ABSOLUTE_PATH BAKE_SCENE BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE)
  cmake_path(ABSOLUTE_PATH BAKE_OUTPUT BASE_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}" NORMALIZE)
  set(INPUTS "${BAKE_SCENE}" ${BAKE_DEPENDS})
  set(WORDS "${BAKE_SCENE}")
  if(BAKE_CONFIG)
    cmake_path(ABSOLUTE_PATH BAKE_CONFIG BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE)
    list(APPEND INPUTS "${BAKE_CONFIG}")
    set(WORDS "${BAKE_CONFIG}" --file "${BAKE_SCENE}")
  endif()
  if(BAKE_OBJECTS)
    list(JOIN BAKE_OBJECTS "," PATTERNS)
    list(APPEND WORDS --objects "${PATTERNS}")
  endif()
  set(MANIFEST "${BAKE_OUTPUT}/manifest.json")
  set(DEPFILE "${CMAKE_CURRENT_BINARY_DIR}/${BAKE_TARGET}.lightmaps.d")
  set(SHOWN USES_TERMINAL)
  if(BAKE_JOB_POOL)
    set(SHOWN JOB_POOL "${BAKE_JOB_POOL}")
  endif()
  set(TOUCH "")
  if(NOT CMAKE_GENERATOR MATCHES "Ninja")
    # Make has no restat: a manifest that a bake left alone would be older than the scene for ever.
    set(TOUCH COMMAND "${CMAKE_COMMAND}" -E touch "${MANIFEST}")
  endif()
  add_custom_command(OUTPUT "${MANIFEST}"
    COMMAND rnmbake::rnmbake bake ${WORDS} --output "${BAKE_OUTPUT}" --depfile "${DEPFILE}" ${BAKE_FLAGS}
    ${TOUCH}
    DEPENDS ${INPUTS} DEPFILE "${DEPFILE}"
    COMMENT "Baking lightmaps of ${BAKE_TARGET}" VERBATIM ${SHOWN})
  set(ALL "")
  if(BAKE_ALL)
    set(ALL ALL)
  endif()
  add_custom_target(${BAKE_TARGET} ${ALL} DEPENDS "${MANIFEST}")
  set_target_properties(${BAKE_TARGET} PROPERTIES RNMBAKE_MANIFEST "${MANIFEST}")
endfunction()
