include(CMakePackageConfigHelpers)
configure_package_config_file(cmake/kinetix-config.cmake.in ${CMAKE_BINARY_DIR}/kinetix-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/kinetix)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/kinetix-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/kinetix-config.cmake ${CMAKE_BINARY_DIR}/kinetix-config-version.cmake
  ${PROJECT_SOURCE_DIR}/cmake/suitesparse.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/kinetix)
install(EXPORT kinetix-targets NAMESPACE kinetix:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/kinetix)
