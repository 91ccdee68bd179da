/// Where resampled values go: files of grids, files of the other mesh; and their integrals.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "barycert/grid.hpp"
#include "barycert/io.hpp"
#include "barycert/jobs.hpp"
#include "barycert/jobs/sampled_mesh.hpp"
#include "barycert/result.hpp"

namespace barycert::jobs {

/// A sink of the blocks of a grid, in order; their views have no points.
struct GridOutput {
    std::unique_ptr<TableSink> sink;
    const SliceCounts* picture = nullptr;  ///< of a picture, after the commit: what became of the values
};

/// What is wrong with the output of a grid, as far as its name and the options tell.
Status check_grid_output(const ResampleJob& job);

/// The output `path` of the job, by its suffix. Errors: a format that cannot hold these fields or that grid; a path
/// that cannot be written.
Result<GridOutput> open_grid_sink(const ResampleJob& job, const std::string& path, const TableFormat& format,
                                  const Grid& grid);

/// The files that such an output has; what is wrong with it, as far as its name tells.
std::vector<std::string> files_of_mesh_output(const ResampleJob& job);
Status check_mesh_output(const ResampleJob& job);

/// True if the output is rows: CSV or NPY.
bool is_rows_output(const std::string& path);

/// Takes one row a node, and writes the mesh when all is there: VTK's files, or TetGen's by their stem. Error: columns
/// that are carried through, for which meshes have no place. `notes` gets the names that a .node file cannot hold,
/// once.
Result<std::unique_ptr<TableSink>> mesh_sink(Mesh mesh, const std::string& path, const TableFormat& format,
                                             Notes& notes);

// What becomes of cell fields that are sampled at the nodes of another mesh.

/// The columns of cell fields that are sampled as they are; their integrals over the mesh go into the report.
/// Precondition: the mesh is prepared.
std::vector<std::size_t> integrate_source(SampledMesh& mesh, const TableFormat& format);

/// Nodes and cells, of which integrals are made.
Mesh geometry_of(const Mesh& mesh);

/// Gives the rows of all nodes of `geometry` to the sink; with the commit, the integrals over it go into the report.
std::unique_ptr<TableSink> integrate_target(SampledMesh& mesh, Mesh geometry, const std::vector<std::size_t>& columns,
                                            std::unique_ptr<TableSink> sink);

/// That cell fields become values at nodes, if there are some, and of which there are no integrals: a note of the
/// report.
void note_cell_fields(SampledMesh& mesh, bool of_series);

}  // namespace barycert::jobs
