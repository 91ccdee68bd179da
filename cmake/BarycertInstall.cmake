# Install headers, libraries, executables and data, and export them so that find_package(barycert) works elsewhere.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(BARYCERT_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/barycert)
install(TARGETS barycert EXPORT barycertTargets INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
# Headers that stand on the standard library alone are public; what includes others' headers stays inside.
set(internal_headers core/*-inl core/blocks core/exact_weights core/fixed_integer core/gradient_exact core/gradient_lanes core/input_file core/integer core/lanes core/point_arguments core/quadratic_edges core/quadratic_exact core/quadratic_lanes core/quotient core/scaled_double core/simd_targets core/strict_math
  exact/integers exact/rounding exact/solve kernels/elf_file kernels/registry kernels/scanline kernels/variants
  kernels/vectors kernels/*_formulas mesh/facets mesh/integer_row mesh/row_errors mesh/scanner mesh/tetgen_reader mesh/text_table plc/plc_text
  check/box_tree check/boundary check/candidates check/cells check/disjoint_sets check/exact_volumes check/facet_contact check/facets check/files
  check/findings check/local_delaunay check/nodes check/overlap check/pairs check/plc_facet check/shape check/signs check/witness audit/witness_json report/check_conditions report/environment_json report/terminal_text vti/xml_name report/png_rows report/colour_bar
  locate/batch locate/bins locate/buffer locate/cell_index locate/cell_signs locate/cell_tree locate/finder locate/locator_data
  locate/near* locate/node_cells locate/open_facets locate/quantizer locate/*-inl locate/radix_sort locate/sorted_points locate/walk_lanes
  sample/chunk_sampler sample/*-inl sample/fill_lanes sample/map_format sample/outside sample/raster_lanes sample/sampler_data sample/slab_sampler sample/value_lanes
  points/csv_* points/formats points/line_reader points/npy_*
  vtk/blocks vtk/byte_stream vtk/grid_to_mesh vtk/legacy_text vtk/mesh_to_grid vtk/messages vtk/numbers vtk/raw_grid vtk/vtu_output vtk/xml_arrays vtk/xml_tree)
list(TRANSFORM internal_headers REPLACE "(.+)" "PATTERN;\\1.hpp;EXCLUDE")
if(NOT TARGET barycert_vtk)
  list(APPEND internal_headers PATTERN vtk EXCLUDE)
endif()
if(NOT TARGET barycert_audit)
  foreach(folder exact audit report)
    list(APPEND internal_headers PATTERN ${folder} EXCLUDE)
  endforeach()
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/barycert/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/barycert
  FILES_MATCHING PATTERN "*.hpp" PATTERN "*.h" ${internal_headers})
if(TARGET barycert_audit)
  install(TARGETS barycert_audit EXPORT barycertAuditTargets INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT barycertAuditTargets NAMESPACE barycert:: DESTINATION ${BARYCERT_CMAKE_DIR})
endif()
if(TARGET barycert_vtk)
  install(TARGETS barycert_vtk EXPORT barycertVtkTargets INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT barycertVtkTargets NAMESPACE barycert:: DESTINATION ${BARYCERT_CMAKE_DIR})
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
