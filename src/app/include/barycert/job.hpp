/// Whole jobs, files to files: the parts that all of them have. The command line and the bindings call them.
///
/// A job names its files and options; one call reads the mesh and its fields, checks the mesh where that pays, streams
/// points through a Sampler and writes rows, grids, pictures or meshes. Memory is that of the mesh and some blocks of
/// points. Output files appear whole or not at all; rows on stdout cannot be taken back.
///
/// Example:
///
///     #include <cstdio>
///     #include "barycert/sample_job.hpp"
///     SampleJob job;
///     job.mesh = "part.1";
///     job.field_files = {{.of = FieldFile::Of::points, .name = "T", .path = "temperature.csv", .column = "T"}};
///     job.progress = [](const JobProgress& now) { std::puts(std::string(now.stage).c_str()); };
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/series.hpp"

namespace barycert {

/// A field from a file of its own: a row of numbers for each node, or for each cell.
struct FieldFile {
    enum class Of : std::uint8_t { either, points, cells };
    Of of = Of::either;
    std::string name, path;
    /// The column of a CSV file, by name or number (from 1); the field of a structured NPY file; the array of a mesh.
    /// Empty: all that a text or NPY file holds.
    std::string column = {};
};

/// The current stage of a job.
struct JobProgress {
    std::string_view stage;  ///< such as "reading part.1" or "points"
    std::uint64_t done = 0;  ///< how many; 0: not counted
};

/// Members that all jobs on a mesh have.
struct MeshJob {
    std::string mesh;      ///< as for read_mesh
    StepChoice step = {};  ///< of a mesh that is a series (.pvd, .vtu.series); none: the first
    std::vector<FieldFile> field_files = {};
    Curved curved = Curved::isoparametric;                             ///< what becomes of curved cells
    CellInterpolation cell_interpolation = CellInterpolation::linear;  ///< of sampling and verification

    /// Reports that the caller will write: the name of each, for messages, and its path. Paths are checked as outputs.
    std::vector<std::pair<std::string, std::string>> reports = {};
    std::string program = "barycert";  ///< how the user calls the program, for commands in messages
    /// Called by one thread at a time, which need not be the caller's.
    std::function<void(const JobProgress&)> progress = {};
};

/// Members that reports of all jobs on a mesh have.
struct MeshReport {
    std::string mesh;
    CurvedCells curved;  ///< of the mesh: taken with straight sides
    Notes notes;         ///< what was left out, converted or guessed: of the mesh, of fields, of points
    std::uint64_t nodes = 0, cells = 0;
    std::uint64_t simplices = 0;  ///< that the cells are cut into; 0: they are simplices
    int dimension = 3, threads = 1;
};

/// Wall times of the stages. Points are read, sampled and written at the same time: each of these stages has the time
/// during which a thread was busy with it, divided by the number of threads where several may be.
struct JobSeconds {
    double mesh = 0;    ///< reading the mesh and the files of fields
    double build = 0;   ///< of the locator and the sampler; of a contour the cut
    double read = 0;    ///< of points
    double sample = 0;  ///< owners, features and values; of a picture the index, too
    double write = 0;
    double total = 0;
};

}  // namespace barycert
