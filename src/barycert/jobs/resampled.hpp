/// Where resampled values go: files of grids, files of the other mesh; and their integrals.
#pragma once

#include <string>

#include "barycert/grid.hpp"
#include "barycert/jobs/stream.hpp"

namespace barycert::jobs {

/// The point of that number; in 2D without a third coordinate.
std::array<double, 3> point_of(const Grid& grid, std::uint64_t i);

/// A sink of the blocks of a grid, in order, whose views have no points: the output `path` of the job, by its suffix.
/// `picture` gets what became of the values of a picture, with the commit. Refused: a format that cannot hold
/// these fields or that grid; a path that cannot be written.
Sink open_grid_sink(const ResampleJob& job, const std::string& path, const TableFormat& format, const Grid& grid,
                    std::optional<SliceCounts>& picture);

/// True if the output is rows: CSV or NPY.
bool is_rows_output(const std::string& path);

/// Takes one row a node, and writes the mesh when all is there: VTK's files, or TetGen's by their stem. Refused:
/// columns that are carried through, for which meshes have no place. `notes` gets the names that a .node file cannot
/// hold, once.
Sink mesh_sink(Mesh mesh, const std::string& path, const TableFormat& format, Notes& notes);

// What becomes of cell fields that are sampled at the nodes of another mesh.

/// Gives the rows of all nodes of `other` to the sink that is opened. Integrals of cell fields that are sampled as they
/// are go into the report: over the mesh, which is prepared, and with the commit over the other one. `other` is not
/// read any more when the sink is opened.
Sink with_integrals(SampledMesh& mesh, const TableFormat& format, const Mesh& other, const std::function<Sink()>& open);

/// That cell fields become values at nodes, if there are some, and of which there are no integrals: a note of the
/// report.
void note_cell_fields(SampledMesh& mesh, bool of_series);

}  // namespace barycert::jobs
