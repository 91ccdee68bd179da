# Install headers, libraries, executables and data, and export them so that find_package(barycert) works elsewhere.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(BARYCERT_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/barycert)
install(TARGETS barycert EXPORT barycertTargets INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
# What stands at the top of src/barycert is public; the rooms below it are not. There is no list but for the libraries
# that a build may leave out.
file(GLOB public_headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/barycert/*.hpp ${PROJECT_SOURCE_DIR}/src/barycert/*.h)
if(NOT TARGET barycert_audit)
  list(FILTER public_headers EXCLUDE REGEX "/(oracle|audit[a-z_]*)\.hpp$")
endif()
install(FILES ${public_headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/barycert)
if(TARGET barycert_audit)
  install(TARGETS barycert_audit EXPORT barycertAuditTargets INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT barycertAuditTargets NAMESPACE barycert:: DESTINATION ${BARYCERT_CMAKE_DIR})
endif()
if(TARGET barycert_vtk)
  install(TARGETS barycert_vtk EXPORT barycertVtkTargets)
  install(EXPORT barycertVtkTargets NAMESPACE barycert:: DESTINATION ${BARYCERT_CMAKE_DIR})
  file(GLOB vtk_headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/vtk/vtk*.h)
  install(FILES ${vtk_headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/barycert/vtk)
endif()
if(TARGET barycert_cli)
  install(TARGETS barycert_cli)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/data/meshes DESTINATION ${CMAKE_INSTALL_DATADIR}/barycert/data OPTIONAL)
endif()
install(EXPORT barycertTargets NAMESPACE barycert:: DESTINATION ${BARYCERT_CMAKE_DIR})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/barycertConfig.cmake.in ${PROJECT_BINARY_DIR}/barycertConfig.cmake
  INSTALL_DESTINATION ${BARYCERT_CMAKE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/barycertConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/barycertConfig.cmake ${PROJECT_BINARY_DIR}/barycertConfigVersion.cmake
  DESTINATION ${BARYCERT_CMAKE_DIR})
