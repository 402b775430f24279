# What `cmake --install` puts where, and the Debian package that `cpack -G DEB` makes of it (docs/install.md).
include(CMakePackageConfigHelpers)
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON) # a package needs no tests and benchmarks

install(TARGETS rnmbake RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS rnmbake-engine RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/rnmbake)
install(FILES README.md LICENSE CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs)
install(DIRECTORY scenes/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples/scenes
        PATTERN built EXCLUDE PATTERN __pycache__ EXCLUDE)

# Completion and manual pages come out of the program, so that they know every flag of it.
set(MADE ${CMAKE_BINARY_DIR}/generated/shell)
add_custom_command(OUTPUT ${MADE}/rnmbake ${MADE}/_rnmbake ${MADE}/rnmbake.fish ${MADE}/man1/rnmbake.1
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${MADE}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${MADE}
  COMMAND rnmbake completion bash > ${MADE}/rnmbake
  COMMAND rnmbake completion zsh > ${MADE}/_rnmbake
  COMMAND rnmbake completion fish > ${MADE}/rnmbake.fish
  COMMAND rnmbake man -o ${MADE}/man1
  DEPENDS rnmbake VERBATIM COMMENT "Completion and manual pages")
add_custom_target(shell_files ALL DEPENDS ${MADE}/rnmbake)
install(FILES ${MADE}/rnmbake DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${MADE}/_rnmbake DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
install(FILES ${MADE}/rnmbake.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

# find_package(rnmbake).
set(PACKAGE_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/rnmbake)
set(RNMBAKE_PROGRAM ${CMAKE_INSTALL_FULL_BINDIR}/rnmbake)
configure_package_config_file(${CMAKE_SOURCE_DIR}/cmake/package/rnmbakeConfig.cmake.in
  ${CMAKE_BINARY_DIR}/generated/rnmbakeConfig.cmake INSTALL_DESTINATION ${PACKAGE_FOLDER} PATH_VARS RNMBAKE_PROGRAM)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/generated/rnmbakeConfigVersion.cmake
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES ${CMAKE_BINARY_DIR}/generated/rnmbakeConfig.cmake
              ${CMAKE_BINARY_DIR}/generated/rnmbakeConfigVersion.cmake
              ${CMAKE_SOURCE_DIR}/cmake/package/rnmbakeLightmaps.cmake DESTINATION ${PACKAGE_FOLDER})

install(DIRECTORY ${MADE}/man1/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)

set(RNMBAKE_MAINTAINER "The rnmbake authors <rnmbake@users.noreply.github.com>" CACHE STRING "Of the Debian package")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME rnmbake)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "${RNMBAKE_MAINTAINER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "directional lightmaps of Blender and glTF scenes")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_SOURCE_DIR}/cmake/package/debian.cmake)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "rnmbake bakes the light of a scene into the three maps of the Half-Life 2
basis (radiosity normal maps), from which an engine lights normal-mapped
surfaces, and into light probes. Blender's Cycles does the tracing,
headless; a path tracer of its own tells how exact the result is.")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "blender, python3-numpy")
include(CPack)
