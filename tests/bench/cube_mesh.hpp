/// The unit cube as the benchmarks of VTK's filters take it.
#pragma once

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "generated_mesh.hpp"
#ifdef BARYCERT_WITH_TETGEN
#include "large_mesh.hpp"
#endif

namespace barycert::bench {

/// `cubes` along each edge of a lattice; 0: the large mesh, or without TetGen a lattice of about as many cells.
inline Mesh cube_mesh(int cubes) {
#ifdef BARYCERT_WITH_TETGEN
    if (cubes == 0) return read_mesh(large_mesh_stem()).value();
#endif
    return jittered_cube(cubes > 0 ? cubes : 68, 1);
}

}  // namespace barycert::bench
