# Jobs on this machine, for tests, examples and benchmarks: barycert::vtk itself needs VTK's controllers alone, no MPI.
include_guard(GLOBAL)

# More ranks than cores, which wait without work and are not bound to a core, by any user, over shared memory: a machine
# without a network would be warned of. uct, openib and ofi are left out by Debian's configuration, whose list this one
# takes the place of (with them, jobs under ThreadSanitizer crash). For Open MPI 4, and in the names of 5; others take no
# notice.
set(barycert_mpi_environment OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle=1 "OMPI_MCA_btl=^tcp,uct,openib,ofi"
  OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none
  PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe PRTE_MCA_hwloc_default_binding_policy=none CACHE INTERNAL "")

# barycert_find_mpi(COMPONENTS...): sets BARYCERT_MPI_FOUND, and vtk_targets with VTK::ParallelMPI.
macro(barycert_find_mpi)
  set(BARYCERT_MPI_FOUND FALSE)
  barycert_find_vtk(${ARGN})
  if(VTK_FOUND AND TARGET barycert_vtk)
    find_package(VTK 9.1 QUIET COMPONENTS ${ARGN} OPTIONAL_COMPONENTS ParallelMPI)
    find_package(MPI QUIET COMPONENTS C)
    if(TARGET VTK::ParallelMPI AND MPIEXEC_EXECUTABLE)
      set(BARYCERT_MPI_FOUND TRUE)
      list(APPEND vtk_targets VTK::ParallelMPI)
    endif()
  endif()
endmacro()

# barycert_mpi_test(NAME RANKS COMMAND...)
function(barycert_mpi_test name ranks)
  add_test(NAME ${name} COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${ranks} ${ARGN})
  # Libraries of MPI do not give back all that they take. A job that hangs is a failure.
  set_tests_properties(${name} PROPERTIES ENVIRONMENT "${barycert_mpi_environment};ASAN_OPTIONS=detect_leaks=0" TIMEOUT 300
    PROCESSORS 2)
endfunction()
