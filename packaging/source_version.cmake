# Run by cpack before it packs: writes the version of the sources where git_version.cmake looks for it in
# an archive. Packages of other kinds have no such place.
set(records ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/host/report/record)
if(NOT EXISTS ${records}/archive_version.txt)
  return()
endif()
set(SOURCE ${CPACK_GLINTMARK_SOURCE_DIR})
set(OUTPUT ${CPACK_TOPLEVEL_DIRECTORY}/source_version.h)
include(${SOURCE}/host/report/record/git_version.cmake)
file(WRITE ${records}/archive_version.txt "${version}\n")
