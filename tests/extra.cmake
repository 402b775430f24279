# Suites that are driven by Python.
find_package(Python3 REQUIRED COMPONENTS Interpreter)

# rnm_check(NAME LABELS TIMEOUT FILE [ENV variables...] [ARGS words...]) - a Python suite that runs the program.
function(rnm_check NAME LABELS TIMEOUT FILE)
  cmake_parse_arguments(CHECK "" "" "ENV;ARGS" ${ARGN})
  add_test(NAME ${NAME}
    COMMAND ${CMAKE_COMMAND} -E env RNMBAKE_BINARY=$<TARGET_FILE:rnmbake> ${CHECK_ENV}
            $<TARGET_FILE:Python3::Interpreter> ${CMAKE_CURRENT_SOURCE_DIR}/${FILE}_check.py -v ${CHECK_ARGS})
  set_tests_properties(${NAME} PROPERTIES LABELS "${LABELS}" TIMEOUT ${TIMEOUT})
endfunction()

# What `./dev lint` says without a compiler. A high cost starts them, and docs.*, before all others.
foreach(CHECK format rooms python)
  add_test(NAME style.${CHECK} COMMAND ${CMAKE_SOURCE_DIR}/tools/dev/style.sh ${CHECK})
  set_tests_properties(style.${CHECK} PROPERTIES LABELS "unit;style" TIMEOUT 300 COST 1000)
endforeach()

# One test for each folder of tests/cli/ that holds a `command`; see run_cases.py.
file(GLOB CLI_CASES CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/cli/*/command)
foreach(COMMAND_FILE ${CLI_CASES})
  get_filename_component(CASE_FOLDER ${COMMAND_FILE} DIRECTORY)
  get_filename_component(CASE ${CASE_FOLDER} NAME)
  add_test(NAME cli_case.${CASE}
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/cli/run_cases.py
            --binary $<TARGET_FILE:rnmbake> ${CASE})
  set_tests_properties(cli_case.${CASE} PROPERTIES LABELS unit TIMEOUT 150)
endforeach()

add_test(NAME docs.check
  COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/docs/check_docs.py --binary $<TARGET_FILE:rnmbake>)
add_test(NAME docs.claims COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/docs/check_claims.py)
set_tests_properties(docs.check docs.claims PROPERTIES LABELS unit TIMEOUT 300 COST 1000)

foreach(CHECK accuracy tracing volumes)
  add_test(NAME bench.${CHECK}
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/bench/${CHECK}_check.py)
  set_tests_properties(bench.${CHECK} PROPERTIES LABELS unit TIMEOUT 60)
endforeach()

# What scripts for Blender do without it.
foreach(CHECK keys gltf lightmaps)
  add_test(NAME scripts.${CHECK}
    COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/scripts/${CHECK}_check.py)
  set_tests_properties(scripts.${CHECK} PROPERTIES LABELS unit TIMEOUT 300)
endforeach()

# The shaders, and what the command makes of them, by glslang.
add_test(NAME shaders.compile
  COMMAND Python3::Interpreter ${CMAKE_CURRENT_SOURCE_DIR}/shaders/compile_check.py
          --binary $<TARGET_FILE:rnmbake>)
set_tests_properties(shaders.compile PROPERTIES LABELS unit TIMEOUT 300)

# Bad input through the real program and a real Blender: one test for each class of bad_input/*_check.py.
foreach(CHECK files.Scenes files.Folders content.Content content.Names content.Scripts
              blender.Environment blender.Failing blender.Stopped)
  string(REPLACE "." ";" PARTS ${CHECK})
  list(GET PARTS 0 FILE)
  list(GET PARTS 1 CLASS)
  rnm_check(bad_input.${CLASS} blender 1200 with_blender/bad_input/${FILE} ARGS ${CLASS})
endforeach()

# The scenes that ./dev scenes built, against what their README promises.
find_program(RNMBAKE_TEST_BLENDER blender)
if(RNMBAKE_TEST_BLENDER)
  add_test(NAME scenes.check
    COMMAND ${RNMBAKE_TEST_BLENDER} -b --factory-startup -noaudio --python-exit-code 86
            --python ${CMAKE_CURRENT_SOURCE_DIR}/with_blender/scenes_check.py -- ${CMAKE_SOURCE_DIR}/scenes/built)
  set_tests_properties(scenes.check PROPERTIES LABELS blender TIMEOUT 600)
endif()

# The scene that is like other people's files, through every command.
rnm_check(attic.check blender 1200 with_blender/attic)

rnm_check(added_light.check blender 600 with_blender/added_light)

rnm_check(manifest.schema blender 1200 with_blender/manifest)

foreach(CLASS Changes Killed Local Scenes)
  rnm_check(reuse.${CLASS} blender 1200 with_blender/reuse ARGS ${CLASS})
endforeach()
foreach(CLASS Reference Traced Validated)
  rnm_check(reuse.${CLASS} blender 1200 with_blender/reuse_traced ARGS ${CLASS})
endforeach()

set_tests_properties(reuse.Local reuse.Traced reuse.Validated PROPERTIES LABELS "blender;long")

rnm_check(outputs.check blender 1200 with_blender/outputs)

rnm_check(saved_scene.check blender 1200 with_blender/saved_scene)

# A bake as tasks for many machines, and on a Slurm of two nodes. (All of class Slurm, five minutes: farm/slurm_check.py.)
rnm_check(farm.Tasks "blender;farm;long" 2400 farm/farm ARGS Tasks)
rnm_check(farm.NoSlurm "blender;farm" 1200 farm/slurm ARGS NoSlurm)
rnm_check(farm.Slurm "blender;farm" 2400 farm/slurm ARGS Slurm.test_a_lost_node_is_made_up_for
          Slurm.test_a_failing_object_stops_its_own_merge_alone Slurm.test_a_node_that_does_not_see_the_cache)
set_tests_properties(farm.Slurm PROPERTIES SKIP_REGULAR_EXPRESSION "OK \\(skipped=")

# A plan as a job of other queues, run by their own programs.
foreach(CLASS OpenJobDescription Flamenco)
  rnm_check(farm.${CLASS} "blender;farm;long" 1200 farm/export ENV RNMBAKE_BUILD=${CMAKE_BINARY_DIR} ARGS ${CLASS})
  set_tests_properties(farm.${CLASS} PROPERTIES SKIP_REGULAR_EXPRESSION "OK \\(skipped=")
endforeach()

# Scenes handed over to engines: the Khronos validator, three.js in a real browser.
rnm_check(deliver.check blender 1200 with_blender/deliver/deliver)
set_tests_properties(deliver.check PROPERTIES SKIP_REGULAR_EXPRESSION "OK \\(skipped=")
foreach(CLASS PlayCanvas Babylon)
  rnm_check(deliver.${CLASS} "blender;long" 1200 with_blender/deliver/web_engines ARGS ${CLASS})
  set_tests_properties(deliver.${CLASS} PROPERTIES SKIP_REGULAR_EXPRESSION "OK \\(skipped=")
endforeach()
foreach(CLASS Dungeon DungeonGltf LivingRoom LivingRoomGltf Staircase StaircaseGltf)
  rnm_check(deliver.${CLASS} "blender;long" 1200 with_blender/deliver/scenes ARGS ${CLASS})
  set_tests_properties(deliver.${CLASS} PROPERTIES SKIP_REGULAR_EXPRESSION "OK \\(skipped=")
endforeach()
rnm_check(deliver.Engines blender 1200 with_blender/deliver/engines)
rnm_check(deliver.Vtf blender 600 with_blender/deliver/vtf ENV RNMBAKE_BUILD=${CMAKE_BINARY_DIR})
set_tests_properties(deliver.Engines deliver.Vtf PROPERTIES SKIP_REGULAR_EXPRESSION "OK \\(skipped=")

# The report's page in a real browser, and report.json against its schema.
add_executable(sample_report ${CMAKE_CURRENT_SOURCE_DIR}/report/sample_report.cpp)
target_link_libraries(sample_report PRIVATE report rnm_warnings)
foreach(CHECK page schema)
  add_test(NAME report.${CHECK}
    COMMAND ${CMAKE_COMMAND} -E env SAMPLE_REPORT=$<TARGET_FILE:sample_report>
            $<TARGET_FILE:Python3::Interpreter> ${CMAKE_CURRENT_SOURCE_DIR}/report/${CHECK}_check.py -v)
  set_tests_properties(report.${CHECK} PROPERTIES LABELS unit TIMEOUT 300)
endforeach()
rnm_check(report.study unit 300 report/study)

# Files of light probes for engines, by readers that share nothing with what writes them.
add_executable(sample_formats ${CMAKE_CURRENT_SOURCE_DIR}/probes/formats/sample_formats.cpp)
target_include_directories(sample_formats PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
target_link_libraries(sample_formats PRIVATE probes rnm_warnings)
foreach(CHECK formats more_formats threejs)
  add_test(NAME probes.${CHECK}
    COMMAND ${CMAKE_COMMAND} -E env SAMPLE_FORMATS=$<TARGET_FILE:sample_formats> CXX=${CMAKE_CXX_COMPILER}
            $<TARGET_FILE:Python3::Interpreter> ${CMAKE_CURRENT_SOURCE_DIR}/probes/formats/${CHECK}_check.py -v)
  set_tests_properties(probes.${CHECK} PROPERTIES LABELS unit TIMEOUT 300)
endforeach()

# Scenes of strangers, whose scripts try to get out of --sandbox.
rnm_check(sandbox.check blender 1200 with_blender/sandbox/sandbox)
set_tests_properties(sandbox.check PROPERTIES SKIP_REGULAR_EXPRESSION "OK \\(skipped=")

# Completion and manual pages, by real shells, man and mandoc.
foreach(CHECK completion man)
  rnm_check(shell.${CHECK} unit 300 shell/${CHECK})
endforeach()

# Lightmaps in builds of CMake, Ninja and make.
rnm_check(builds.check blender 1200 builds/builds ENV RNMBAKE_BUILD=${CMAKE_BINARY_DIR})
