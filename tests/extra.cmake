# Suites that are driven by Python.
find_package(Python3 REQUIRED COMPONENTS Interpreter)

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
foreach(CHECK keys gltf)
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
  add_test(NAME bad_input.${CLASS}
    COMMAND ${CMAKE_COMMAND} -E env RNMBAKE_BINARY=$<TARGET_FILE:rnmbake>
            $<TARGET_FILE:Python3::Interpreter> ${CMAKE_CURRENT_SOURCE_DIR}/with_blender/bad_input/${FILE}_check.py
            -v ${CLASS})
  set_tests_properties(bad_input.${CLASS} PROPERTIES LABELS blender TIMEOUT 1200)
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
add_test(NAME attic.check
  COMMAND ${CMAKE_COMMAND} -E env RNMBAKE_BINARY=$<TARGET_FILE:rnmbake>
          $<TARGET_FILE:Python3::Interpreter> ${CMAKE_CURRENT_SOURCE_DIR}/with_blender/attic_check.py -v)
set_tests_properties(attic.check PROPERTIES LABELS blender TIMEOUT 1200)

add_test(NAME manifest.schema
  COMMAND ${CMAKE_COMMAND} -E env RNMBAKE_BINARY=$<TARGET_FILE:rnmbake>
          $<TARGET_FILE:Python3::Interpreter> ${CMAKE_CURRENT_SOURCE_DIR}/with_blender/manifest_check.py -v)
set_tests_properties(manifest.schema PROPERTIES LABELS blender TIMEOUT 1200)

foreach(CLASS Changes Killed)
  add_test(NAME reuse.${CLASS}
    COMMAND ${CMAKE_COMMAND} -E env RNMBAKE_BINARY=$<TARGET_FILE:rnmbake>
            $<TARGET_FILE:Python3::Interpreter> ${CMAKE_CURRENT_SOURCE_DIR}/with_blender/reuse_check.py -v ${CLASS})
  set_tests_properties(reuse.${CLASS} PROPERTIES LABELS blender TIMEOUT 1200)
endforeach()

add_test(NAME outputs.check
  COMMAND ${CMAKE_COMMAND} -E env RNMBAKE_BINARY=$<TARGET_FILE:rnmbake>
          $<TARGET_FILE:Python3::Interpreter> ${CMAKE_CURRENT_SOURCE_DIR}/with_blender/outputs_check.py -v)
set_tests_properties(outputs.check PROPERTIES LABELS blender TIMEOUT 1200)

add_test(NAME saved_scene.check
  COMMAND ${CMAKE_COMMAND} -E env RNMBAKE_BINARY=$<TARGET_FILE:rnmbake>
          $<TARGET_FILE:Python3::Interpreter> ${CMAKE_CURRENT_SOURCE_DIR}/with_blender/saved_scene_check.py -v)
set_tests_properties(saved_scene.check PROPERTIES LABELS blender TIMEOUT 1200)

# A bake as tasks for many machines. (On a Slurm of two nodes: farm/farm_check.py Slurm, by hand.)
foreach(CLASS Tasks)
  add_test(NAME farm.${CLASS}
    COMMAND ${CMAKE_COMMAND} -E env RNMBAKE_BINARY=$<TARGET_FILE:rnmbake>
            $<TARGET_FILE:Python3::Interpreter> ${CMAKE_CURRENT_SOURCE_DIR}/farm/farm_check.py -v ${CLASS})
  set_tests_properties(farm.${CLASS} PROPERTIES LABELS "blender;farm" TIMEOUT 2400 SKIP_REGULAR_EXPRESSION "SKIPPED: no Slurm")
endforeach()

# The report's page in a real browser, and report.json against its schema.
add_executable(sample_report ${CMAKE_CURRENT_SOURCE_DIR}/report/sample_report.cpp)
target_link_libraries(sample_report PRIVATE report rnm_warnings)
foreach(CHECK page schema)
  add_test(NAME report.${CHECK}
    COMMAND ${CMAKE_COMMAND} -E env SAMPLE_REPORT=$<TARGET_FILE:sample_report>
            $<TARGET_FILE:Python3::Interpreter> ${CMAKE_CURRENT_SOURCE_DIR}/report/${CHECK}_check.py -v)
  set_tests_properties(report.${CHECK} PROPERTIES LABELS unit TIMEOUT 300)
endforeach()
add_test(NAME report.study
  COMMAND ${CMAKE_COMMAND} -E env RNMBAKE_BINARY=$<TARGET_FILE:rnmbake>
          $<TARGET_FILE:Python3::Interpreter> ${CMAKE_CURRENT_SOURCE_DIR}/report/study_check.py -v)
set_tests_properties(report.study PROPERTIES LABELS unit TIMEOUT 300)

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
add_test(NAME sandbox.check
  COMMAND ${CMAKE_COMMAND} -E env RNMBAKE_BINARY=$<TARGET_FILE:rnmbake>
          $<TARGET_FILE:Python3::Interpreter> ${CMAKE_CURRENT_SOURCE_DIR}/with_blender/sandbox/sandbox_check.py -v)
set_tests_properties(sandbox.check PROPERTIES LABELS blender TIMEOUT 1200 SKIP_REGULAR_EXPRESSION "OK \\(skipped=")

# Completion and manual pages, by real shells, man and mandoc.
foreach(CHECK completion man)
  add_test(NAME shell.${CHECK}
    COMMAND ${CMAKE_COMMAND} -E env RNMBAKE_BINARY=$<TARGET_FILE:rnmbake>
            $<TARGET_FILE:Python3::Interpreter> ${CMAKE_CURRENT_SOURCE_DIR}/shell/${CHECK}_check.py -v)
  set_tests_properties(shell.${CHECK} PROPERTIES LABELS unit TIMEOUT 300)
endforeach()

# Lightmaps in builds of CMake, Ninja and make.
add_test(NAME builds.check
  COMMAND ${CMAKE_COMMAND} -E env RNMBAKE_BINARY=$<TARGET_FILE:rnmbake> RNMBAKE_BUILD=${CMAKE_BINARY_DIR}
          $<TARGET_FILE:Python3::Interpreter> ${CMAKE_CURRENT_SOURCE_DIR}/builds/builds_check.py -v)
set_tests_properties(builds.check PROPERTIES LABELS blender TIMEOUT 1200)
