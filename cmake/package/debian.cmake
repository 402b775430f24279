# debian.cmake - what Debian's policy wants of the files of a package; run by CPack on what it is about to pack.
set(USR "${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr")
set(DOC "${USR}/share/doc/rnmbake")

# A compressed copy without name and time, in place of FILE.
function(compress FILE)
  execute_process(COMMAND gzip --best --no-name --force "${FILE}" COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(GLOB PAGES "${USR}/share/man/man1/*.1")
foreach(PAGE IN LISTS PAGES)
  compress("${PAGE}")
endforeach()
file(RENAME "${DOC}/LICENSE" "${DOC}/copyright")
file(RENAME "${DOC}/CHANGELOG.md" "${DOC}/changelog")
compress("${DOC}/changelog")
