# Install headers, libraries, executables and data, and export them so that find_package(barycert) works elsewhere.
# The components are the Debian packages: see BarycertPackage.cmake.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(BARYCERT_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/barycert)
install(TARGETS barycert EXPORT barycertTargets COMPONENT dev INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
# What stands at the top of src/barycert is public; the rooms below it are not. There is no list but for the libraries
# that a build may leave out.
file(GLOB public_headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/barycert/*.hpp ${PROJECT_SOURCE_DIR}/src/barycert/*.h)
if(NOT TARGET barycert_audit)
  list(FILTER public_headers EXCLUDE REGEX "/(oracle|audit[a-z_]*)\.hpp$")
endif()
install(FILES ${public_headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/barycert COMPONENT dev)
if(TARGET barycert_audit)
  install(TARGETS barycert_audit EXPORT barycertAuditTargets COMPONENT dev INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT barycertAuditTargets NAMESPACE barycert:: DESTINATION ${BARYCERT_CMAKE_DIR} COMPONENT dev)
endif()
if(TARGET barycert_vtk)
  install(TARGETS barycert_vtk EXPORT barycertVtkTargets COMPONENT vtk)
  install(EXPORT barycertVtkTargets NAMESPACE barycert:: DESTINATION ${BARYCERT_CMAKE_DIR} COMPONENT vtk)
  file(GLOB vtk_headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/vtk/vtk*.h)
  install(FILES ${vtk_headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/barycert/vtk COMPONENT vtk)
endif()
if(TARGET barycert_cli)
  install(TARGETS barycert_cli COMPONENT cli)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/data/meshes DESTINATION ${CMAKE_INSTALL_DATADIR}/barycert/data COMPONENT cli OPTIONAL)
  include(BarycertPages)
endif()
install(EXPORT barycertTargets NAMESPACE barycert:: DESTINATION ${BARYCERT_CMAKE_DIR} COMPONENT dev)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/barycertConfig.cmake.in ${PROJECT_BINARY_DIR}/barycertConfig.cmake
  INSTALL_DESTINATION ${BARYCERT_CMAKE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/barycertConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/barycertConfig.cmake ${PROJECT_BINARY_DIR}/barycertConfigVersion.cmake
  DESTINATION ${BARYCERT_CMAKE_DIR} COMPONENT dev)
include(BarycertPkgConfig)
