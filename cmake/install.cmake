# cmake --install: the program, the libraries, their headers, and what find_package(halfspace) needs: the targets
# halfspace::halfspace, halfspace::halfspace_c, and, where SystemC is found, halfspace::systemc and halfspace::run.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

install(TARGETS halfspace EXPORT halfspaceTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
set_target_properties(halfspace_systemc PROPERTIES EXPORT_NAME systemc)
set_target_properties(halfspace_run PROPERTIES EXPORT_NAME run)
install(TARGETS halfspace_systemc halfspace_run EXPORT halfspaceSystemcTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS halfspace_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY model/halfspace DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.hpp" PATTERN c_api EXCLUDE PATTERN cli EXCLUDE PATTERN gltf EXCLUDE
                                 PATTERN reference EXCLUDE PATTERN speed EXCLUDE)
foreach(targets halfspaceTargets halfspaceSystemcTargets)
  install(EXPORT ${targets} NAMESPACE halfspace:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/halfspace)
endforeach()

configure_package_config_file(cmake/halfspaceConfig.cmake.in ${PROJECT_BINARY_DIR}/halfspaceConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/halfspace)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/halfspaceConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/halfspaceConfig.cmake ${PROJECT_BINARY_DIR}/halfspaceConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/halfspace)
