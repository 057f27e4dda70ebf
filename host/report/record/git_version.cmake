# Writes OUTPUT, a header with the version of the source in the folder SOURCE, if it changed: that of
# its git checkout, else the one that `git archive` or `package_source` has left in archive_version.txt.
file(REAL_PATH ${SOURCE} source)
# Checkouts of another user, as containers have them, are read all the same; a repository around the
# folder is not the folder's.
set(git git -c safe.directory=${source} -C ${source})
execute_process(COMMAND ${git} rev-parse --show-toplevel
                OUTPUT_VARIABLE top OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
set(version unknown)
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/archive_version.txt archived)
if(archived MATCHES "^[0-9a-f]+(-dirty)?$")
  set(version ${archived})
endif()
if(top STREQUAL source)
  execute_process(COMMAND ${git} describe --always --dirty --exclude=*
                  OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE
                  ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed)
    set(version ${described})
  endif()
endif()
set(text "#define GLINTMARK_GIT_VERSION \"${version}\"\n")
set(old "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT text STREQUAL old)
  file(WRITE ${OUTPUT} "${text}")
endif()
