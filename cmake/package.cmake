# What `cmake --install` leaves: the headers of floors 0 to 4 with find_package(tyndall), the schemas of our files, and
# the program when built.
include_guard(GLOBAL)
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(where "${CMAKE_INSTALL_LIBDIR}/cmake/tyndall")
install(TARGETS tyndall_headers EXPORT tyndallTargets FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(EXPORT tyndallTargets NAMESPACE tyndall:: DESTINATION "${where}")
configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/tyndallConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/package/tyndallConfig.cmake" INSTALL_DESTINATION "${where}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/package/tyndallConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES "${PROJECT_BINARY_DIR}/package/tyndallConfig.cmake"
  "${PROJECT_BINARY_DIR}/package/tyndallConfigVersion.cmake" DESTINATION "${where}")
install(FILES "${PROJECT_SOURCE_DIR}/schema/tyndall-medium-1.schema.json"
  "${PROJECT_SOURCE_DIR}/schema/tyndall-scene-1.schema.json" DESTINATION "${CMAKE_INSTALL_DATADIR}/tyndall/schema")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/presets" DESTINATION "${CMAKE_INSTALL_DATADIR}/tyndall"
  FILES_MATCHING PATTERN "*.medium.json")
if(TARGET tyndall_cli)
  install(TARGETS tyndall_cli RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
endif()
