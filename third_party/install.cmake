# SPDX-License-Identifier: BSD-3-Clause
# What is installed, how other projects find it (find_package(terrane), target terrane::terrane), and
# packages made of it (ninja package).
include(CMakePackageConfigHelpers)

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/terrane)

install(TARGETS terrane EXPORT terrane)
install(DIRECTORY framework/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/terrane FILES_MATCHING PATTERN *.h)
install(DIRECTORY plugins DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/terrane FILES_MATCHING PATTERN *.h)
install(DIRECTORY resources archives DESTINATION ${CMAKE_INSTALL_DATADIR}/terrane)
install(FILES schemas.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/terrane)
install(FILES LICENSE README.md CHANGES.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

install(EXPORT terrane NAMESPACE terrane:: FILE terrane-targets.cmake DESTINATION ${config_dir})
configure_package_config_file(third_party/terrane-config.cmake.in ${PROJECT_BINARY_DIR}/terrane-config.cmake
    INSTALL_DESTINATION ${config_dir} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/terrane-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/terrane-config.cmake ${PROJECT_BINARY_DIR}/terrane-config-version.cmake
    DESTINATION ${config_dir})

set(CPACK_GENERATOR TGZ DEB)
set(CPACK_PACKAGE_CONTACT "The Terrane authors")
set(CPACK_PACKAGE_VENDOR "The Terrane authors")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Headers stand in the package too, and need these.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libglm-dev, libspdlog-dev")
set(CPACK_STRIP_FILES ON)
include(CPack)
