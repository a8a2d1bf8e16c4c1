# cmake --install: libraries, headers, the command, and the files that find_package(heddle) reads.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(_dir ${CMAKE_INSTALL_LIBDIR}/cmake/heddle)
get_property(_sets GLOBAL PROPERTY HEDDLE_EXPORT_SETS)
list(REMOVE_DUPLICATES _sets)
foreach(_set IN LISTS _sets)
  install(EXPORT ${_set} NAMESPACE heddle:: DESTINATION ${_dir})
endforeach()
set(HEDDLE_OPENVDB_MODULE_DIR /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB) # Debian's Find module
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/heddle-config.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/heddle-config.cmake INSTALL_DESTINATION ${_dir})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/heddle-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/heddle-config.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/heddle-config-version.cmake DESTINATION ${_dir})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md
  DESTINATION ${CMAKE_INSTALL_DOCDIR})
