# `cmake --install`, and find_package(orthodyn) in other projects.
include(CMakePackageConfigHelpers)
set(_config ${CMAKE_INSTALL_LIBDIR}/cmake/orthodyn)

# The system's loader prefers this folder on processors of that level and uses the default folder on all others
# (tools/package).
set(_library ${CMAKE_INSTALL_LIBDIR})
if(ORTHODYN_HWCAPS)
  string(APPEND _library /glibc-hwcaps/${ORTHODYN_PROCESSOR})
endif()

install(TARGETS orthodyn EXPORT orthodynTargets LIBRARY DESTINATION ${_library} COMPONENT library)
if(ORTHODYN_MPI)
  install(TARGETS orthodyn_petsc LIBRARY DESTINATION ${_library} COMPONENT library)
endif()
install(TARGETS orthodyn_cli COMPONENT program)
install(DIRECTORY lib DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/orthodyn FILES_MATCHING PATTERN "*.h")
install(DIRECTORY tools/draw DESTINATION ${CMAKE_INSTALL_DATADIR}/orthodyn USE_SOURCE_PERMISSIONS COMPONENT program
        PATTERN __pycache__ EXCLUDE PATTERN web EXCLUDE)
install(DIRECTORY configs/schema DESTINATION ${CMAKE_INSTALL_DATADIR}/orthodyn COMPONENT program)
install(EXPORT orthodynTargets NAMESPACE orthodyn:: DESTINATION ${_config})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/orthodynConfig.cmake.in
  ${PROJECT_BINARY_DIR}/orthodynConfig.cmake INSTALL_DESTINATION ${_config})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/orthodynConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/orthodynConfig.cmake ${PROJECT_BINARY_DIR}/orthodynConfigVersion.cmake
        DESTINATION ${_config})
