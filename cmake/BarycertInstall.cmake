# Install headers, libraries, executables and data, and export them so that find_package(barycert) works elsewhere.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(BARYCERT_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/barycert)
install(TARGETS barycert EXPORT barycertTargets)
# Headers that stand on the standard library alone are public; what includes CGAL's numbers stays inside.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/barycert/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/barycert
  FILES_MATCHING PATTERN "*.hpp" PATTERN "*.h"
  PATTERN "exact/integers.hpp" EXCLUDE PATTERN "exact/rounding.hpp" EXCLUDE PATTERN "exact/solve.hpp" EXCLUDE)
if(TARGET barycert_audit)
  install(TARGETS barycert_audit EXPORT barycertTargets)
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
