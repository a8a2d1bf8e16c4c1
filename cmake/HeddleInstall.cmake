# cmake --install: libraries, headers, the command, and files for find_package and pkg-config.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(_dir ${CMAKE_INSTALL_LIBDIR}/cmake/heddle)
get_property(_core GLOBAL PROPERTY HEDDLE_CORE_TARGETS)
set(_apps ${HEDDLE_ROOMS})
list(REMOVE_ITEM _apps ${_core})
if(HEDDLE_SHARED)
  install(TARGETS heddle_library EXPORT heddle-core FILE_SET HEADERS)
else()
  # two export sets, so that a machine without the libraries of the apps can still link the core
  install(TARGETS ${_core} EXPORT heddle-core FILE_SET HEADERS)
  install(FILES ${HEDDLE_UMBRELLA} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/heddle)
  if(_apps)
    install(TARGETS ${_apps} EXPORT heddle-apps FILE_SET HEADERS)
    install(EXPORT heddle-apps NAMESPACE heddle:: DESTINATION ${_dir})
  endif()
endif()
install(EXPORT heddle-core NAMESPACE heddle:: DESTINATION ${_dir})

# Debian's Find module
set(HEDDLE_OPENVDB_MODULE_DIR /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB)
list(TRANSFORM _core REPLACE "^heddle_" "heddle::" OUTPUT_VARIABLE HEDDLE_CORE_NAMES)
list(TRANSFORM _apps REPLACE "^heddle_" "heddle::" OUTPUT_VARIABLE HEDDLE_APP_NAMES)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/heddle-config.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/heddle-config.cmake INSTALL_DESTINATION ${_dir}
  PATH_VARS CMAKE_INSTALL_INCLUDEDIR)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/heddle-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/heddle-config.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/heddle-config-version.cmake DESTINATION ${_dir})
include(HeddlePkgConfig)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md
  ${PROJECT_SOURCE_DIR}/CHANGELOG.md
  DESTINATION ${CMAKE_INSTALL_DOCDIR})
