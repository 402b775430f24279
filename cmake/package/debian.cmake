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
# The user's own is CHANGELOG.md; this one is of the package. SOURCE_DATE_EPOCH sets its date.
string(TIMESTAMP DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE "${DOC}/changelog" "rnmbake (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * What is new stands in CHANGELOG.md.

 -- ${CPACK_PACKAGE_CONTACT}  ${DATE}
")
compress("${DOC}/changelog")
