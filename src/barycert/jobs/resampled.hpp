/// Where resampled values go: files of grids, files of the other mesh; and their integrals.
#pragma once

#include "barycert/jobs/stream.hpp"

namespace barycert::jobs {

/// The point of that number; in 2D without a third coordinate.
std::array<double, 3> point_of(const Grid& grid, std::uint64_t i);

/// A sink of the blocks of a grid, in order, whose views have no points: `path`, by its suffix. `picture` gets, with
/// the commit, what became of values. Refused: a format that cannot hold fields or grid.
Sink open_grid_sink(const ResampleJob& job, const std::string& path, const TableFormat& format, const Grid& grid,
                    std::optional<SliceCounts>& picture);

/// Takes one row a node, and writes the mesh when all is there: VTK's files, or TetGen's by their stem. Refused:
/// carried columns, for which meshes have no place. `notes` gets the names that a .node file cannot hold, once.
Sink mesh_sink(Mesh mesh, const std::string& path, const TableFormat& format, Notes& notes);

// What becomes of cell fields that are sampled at the nodes of another mesh.

/// Gives the rows of all nodes of `other` to the sink that is opened, and does not read it from then on. Integrals of
/// cell fields sampled as they are go into the report: over the mesh, which is prepared, with the commit over `other`.
Sink with_integrals(SampledMesh& mesh, const TableFormat& format, const Mesh& other, const std::function<Sink()>& open);

/// Notes in the report that cell fields, if there are some, become values at nodes, and which have no integrals.
void note_cell_fields(SampledMesh& mesh, bool of_series);

}  // namespace barycert::jobs
