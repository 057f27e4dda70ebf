# A package of this very system by `cpack`: libraries have other names on others.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME glintmark)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ
    GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
# Not a mailbox, but of the form that a package must have.
set(GLINTMARK_MAINTAINER "The glintmark authors <glintmark@users.noreply.github.com>" CACHE STRING
    "Maintainer of the Debian package")
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${GLINTMARK_MAINTAINER})
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "fonts-lato, pocl-opencl-icd | opencl-icd")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "cost and accuracy of micro-detail shading on OpenCL devices")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "Measures what the shading of glints, mapped normals, area lights and
rough metals costs on an OpenCL device, and what its accuracy costs,
beside the figures of the papers that describe it. Every figure comes
with a checked answer; the same checks tell whether a driver is right.")
file(READ ${PROJECT_SOURCE_DIR}/CHANGELOG.md changes)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # SOURCE_DATE_EPOCH where it is set
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/changelog.Debian
"glintmark (${PROJECT_VERSION}-1) unstable; urgency=medium

  * As changelog.gz says.

 -- ${GLINTMARK_MAINTAINER}  ${date}
")
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/changelog "${changes}")
foreach(name changelog changelog.Debian)
  execute_process(COMMAND ${GLINTMARK_GZIP} -9nkf ${CMAKE_CURRENT_BINARY_DIR}/${name}
                  COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}.gz DESTINATION ${doc})
endforeach()
