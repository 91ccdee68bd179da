/// Whole jobs, files to files: what the command line and the bindings call.
///
/// A job names its files and options; one call reads the mesh and its fields, checks the mesh where that pays, streams
/// points through a Sampler and writes rows, grids, pictures or meshes. Memory is that of the mesh and some blocks of
/// points. Output files appear whole or not at all; rows on stdout cannot be taken back.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/check.hpp"
#include "barycert/grid.hpp"
#include "barycert/notes.hpp"
#include "barycert/picture.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/vtk.hpp"

namespace barycert {

/// A field from a file of its own: a row of numbers for each node, or for each cell.
struct FieldFile {
    enum class Of : std::uint8_t { either, points, cells };
    Of of = Of::either;
    std::string name, path;
    /// Of a CSV file the name or number (from 1) of the column, of a structured NPY file the field, of a mesh the
    /// array. Empty: all that a text or NPY file holds.
    std::string column = {};
};

/// What a job is doing.
struct JobProgress {
    std::string_view stage;  ///< such as "reading part.1" or "points"
    std::uint64_t done = 0;  ///< how many; 0: not counted
};

/// What both jobs have.
struct SamplingJob {
    std::string mesh;  ///< as for read_mesh
    /// Of a mesh that is a series (.pvd, .vtu.series): which step. None: where the output has {step} or {time} in its
    /// name, and there are no series of fields, every one, each into an output of its own, in which its number or time
    /// takes that place; points are located anew where the mesh is another one. Else the first.
    StepChoice step = {};
    bool all_steps = false;  ///< Error where that is not so
    std::vector<FieldFile> field_files = {};
    /// Fields that change from step to step: each path has one *, and each file that it matches is a step, in natural
    /// order (2 before 10); or it is a .pvd or .vtu.series file. Where the output has {step} in its name, each step has
    /// an output of its own, in which what the * stood for, or the time, takes that place ({time} likewise); points are
    /// located once, and values of one step at a time are in memory. Else the steps of NAME, 256 at most, are columns
    /// NAME@STEP.
    std::vector<FieldFile> series = {};
    Curved curved = Curved::straight;      ///< what becomes of curved cells, of the mesh of `onto` as well
    std::vector<std::string> fields = {};  ///< names, see Sampler::build; empty: all
    std::string output;                    ///< the format goes by the suffix; "-" is CSV on stdout
    /// Where to write the weights of the points on the nodes of the mesh (node_weights.hpp): .npz, a matrix that
    /// scipy.sparse.load_npz reads. Empty: nowhere. Not for grids. A SampleJob with weights needs no output.
    std::string weights = {};
    SampleOptions options = {};
    std::optional<VtkData> vtk_data = {};  ///< of an output in a format of VTK; not set: raw

    /// Where the caller will write a report: the job makes sure that this is no other file of the job, and can be
    /// written. Empty: nowhere.
    std::string report;
    bool count_degenerate = true;      ///< of SampleSummary: a pass over the cells
    std::string program = "barycert";  ///< how the user calls the program, for commands in messages
    /// Called by one thread at a time, which need not be the caller's.
    std::function<void(const JobProgress&)> progress = {};
};

/// Fields at points: rows to CSV, NPY or VTU files.
struct SampleJob : SamplingJob {
    std::string points;                     ///< as for open_points; or
    std::vector<std::string> columns = {};  ///< PointOptions::columns
    std::vector<std::string> keep = {};     ///< PointOptions::keep: columns of the points that rows have, too
    std::string map;                        ///< a map (map.hpp) in place of points
    std::string save_map;                   ///< where to write one; empty: nowhere
    std::optional<bool> all{};  ///< a row for each cell that holds a point; not set: no, or as the map has it
};

/// Fields on a regular grid, or at the nodes of another mesh: exactly one of counts, spacing and onto is set.
struct ResampleJob : SamplingJob {
    std::vector<std::int64_t> counts = {};         ///< points along each axis
    std::vector<double> spacing = {};              ///< of points: one for all axes, or one each
    std::vector<double> bounds = {};               ///< low and high, axis after axis; empty: the box of the cells
    std::string onto;                              ///< a mesh
    std::optional<std::array<double, 2>> range{};  ///< of the colours of a picture
};

/// How the owners of points were found. `pass`: one look at each cell, and no index of the mesh.
enum class FoundBy : std::uint8_t { walk, candidates, map, grid, pass };

constexpr std::string_view name(FoundBy f) {
    return f == FoundBy::walk         ? "walk"
           : f == FoundBy::candidates ? "candidates"
           : f == FoundBy::map        ? "map"
           : f == FoundBy::grid       ? "grid"
                                      : "pass";
}

/// Where points came from.
enum class PointsFrom : std::uint8_t { points, map, mesh, grid };

constexpr std::string_view name(PointsFrom f) {
    return f == PointsFrom::points ? "points" : f == PointsFrom::map ? "map" : f == PointsFrom::mesh ? "mesh" : "grid";
}

/// Wall times of the stages. Points are read, sampled and written at the same time: of these each has the time in which
/// somebody was busy with it, divided by the threads where several may be.
struct SampleSeconds {
    double mesh = 0;    ///< reading the mesh and the files of fields
    double build = 0;   ///< of the locator and the sampler
    double read = 0;    ///< of points
    double sample = 0;  ///< owners, features and values
    double write = 0;
    double total = 0;
};

/// A column of a cell field over the cells of MESH, and over those of the mesh at whose nodes it was sampled, between
/// which it is then linear (quadratic on second-order cells). Exact sums of value times volume (in the plane area; of
/// straight sides, and positive whatever the orientation), rounded once; cells that overlap count twice.
struct FieldIntegral {
    std::string column;
    double source = 0, target = 0;
    std::uint64_t source_left_out = 0, target_left_out = 0;  ///< cells with a value that is not finite
};

/// What a job did: what its reports are made of.
struct SampleSummary {
    std::string command;  ///< "sample" or "resample"
    std::string mesh, output, weights;
    std::string points;                ///< the file they came from; empty for a grid
    CurvedCells curved;                ///< of the mesh: taken with straight sides
    CurvedCells onto_curved;           ///< of the mesh of ResampleJob::onto
    std::vector<std::string> columns;  ///< of values
    std::vector<std::string> carried;  ///< columns that were carried through: labels of cells, columns of points
    Notes notes;                       ///< what was left out, converted or guessed: of the mesh, of fields, of points
    std::string reason;                ///< why `method`: a clause
    std::optional<Grid> grid;          ///< of ResampleJob::counts and spacing
    std::optional<SliceCounts> picture;
    std::vector<FieldIntegral> integrals;  ///< of the cell fields that became values at nodes of another mesh
    OutsidePolicy outside;
    SampleCounts counts;  ///< locations: one a point
    SampleSeconds seconds;
    std::uint64_t nodes = 0, cells = 0;
    std::uint64_t degenerate_cells = 0;  ///< method `pass`: of the cells near the points
    std::uint64_t contested_cells = 0;   ///< see Locator::contested_cells
    std::uint64_t rows = 0;
    /// Fields that are sampled and have values that are not finite; of series, those of the first step that has some.
    std::vector<NotFinite> not_finite;
    std::uint64_t nan_values = 0;    ///< of points inside: from values of nodes or cells that are not finite
    std::vector<std::string> steps;  ///< of series, in order; all else but nan_values and seconds is of one of them
    std::vector<double> times;       ///< of these steps, where the mesh is the series
    std::uint64_t meshes = 1;        ///< of such steps; in each of them points are located, and counted
    int dimension = 3, threads = 1;
    PointsFrom from = PointsFrom::points;
    FoundBy method = FoundBy::walk;
    Rounding rounding = Rounding::correct;
    Verdict verdict = Verdict::not_checked;  ///< certified: P1 to P4 of check.hpp are proved
    bool all = false;                        ///< a row for each cell that holds a point
};

/// Returns an Error, and writes nothing, if the job contradicts itself, an input cannot be read, an output is an input
/// or cannot be written, or the policy for points outside is `error` and a point is outside.
Result<SampleSummary> sample_files(const SampleJob& job);
Result<SampleSummary> resample_files(const ResampleJob& job);

}  // namespace barycert
