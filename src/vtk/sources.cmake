# The classes of this folder and what they stand on, for VTK's own library and for ParaView's plug-in.
set(barycert_vtk_classes vtkBarycertCheck vtkBarycertLocator vtkBarycertProbe vtkBarycertTetGenReader)
list(TRANSFORM barycert_vtk_classes APPEND .h OUTPUT_VARIABLE barycert_vtk_headers)
list(TRANSFORM barycert_vtk_classes APPEND .cpp OUTPUT_VARIABLE barycert_vtk_sources)
list(APPEND barycert_vtk_sources exact_index.cpp probe_arrays.cpp read_cells.cpp)
list(TRANSFORM barycert_vtk_headers PREPEND ${CMAKE_CURRENT_LIST_DIR}/)
list(TRANSFORM barycert_vtk_sources PREPEND ${CMAKE_CURRENT_LIST_DIR}/)
# The class that needs VTK::ParallelCore besides.
set(barycert_vtk_parallel_sources vtkPBarycertProbe.cpp distributed_probe.cpp)
list(TRANSFORM barycert_vtk_parallel_sources PREPEND ${CMAKE_CURRENT_LIST_DIR}/)
