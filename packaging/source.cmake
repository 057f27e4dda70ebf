# The target `package_source`: this folder as it is, without what .gitignore names, and with the version
# of its sources written down, as `git archive` does it.
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_SOURCE_GENERATOR TGZ)
set(CPACK_SOURCE_PACKAGE_FILE_NAME glintmark-${PROJECT_VERSION})
# As expressions; anchored, for the folder itself may lie below one called build.
string(REGEX REPLACE "([][+.*()^$?|\\])" "\\\\\\1" source "${PROJECT_SOURCE_DIR}")
string(REGEX REPLACE "([][+.*()^$?|\\])" "\\\\\\1" binary "${PROJECT_BINARY_DIR}")
set(CPACK_SOURCE_IGNORE_FILES "^${source}/(\\.git|build|build-[^/]*|results/latest)(/|$)" "^${binary}/"
    "/__pycache__/" "\\.swp$")
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_SOURCE_DIR}/source_version.cmake)
set(CPACK_GLINTMARK_SOURCE_DIR ${PROJECT_SOURCE_DIR})
