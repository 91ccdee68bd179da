# VTK is for src/vtk, whose classes are VTK's, for tests, as a judge, and for benchmarks, as a peer: barycert reads and
# writes VTK's files without it.
# barycert_find_vtk(COMPONENTS...): sets VTK_FOUND and vtk_targets. Eigen must have been looked up before: VTK's package
# brings a FindEigen3 of its own.
macro(barycert_find_vtk)
  set(VTK_FOUND FALSE)
  if(BARYCERT_VTK STREQUAL "AUTO")
    find_package(VTK 9.1 QUIET COMPONENTS ${ARGN})
  elseif(BARYCERT_VTK)
    find_package(VTK 9.1 REQUIRED COMPONENTS ${ARGN})
  endif()
  set(vtk_targets ${ARGN})
  list(TRANSFORM vtk_targets PREPEND VTK::)
endmacro()
