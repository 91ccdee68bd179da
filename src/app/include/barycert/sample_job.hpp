/// Jobs that sample: fields at points, on a grid, at the nodes of another mesh.
///
/// Example:
///
///     SampleJob job;
///     job.mesh = "part.1";
///     job.points = "points.csv";
///     job.output = "rows.csv";
///     const SampleReport report = sample_files(job).value();
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/certificate.hpp"
#include "barycert/figure.hpp"
#include "barycert/grid.hpp"
#include "barycert/job.hpp"
#include "barycert/mesh.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/table.hpp"
#include "barycert/weights.hpp"

namespace barycert {

/// Members that sampling and resampling have.
struct SamplingJob : MeshJob {
    /// For a mesh that is a series. Every step is sampled into an output of its own if the job has no `step` and no
    /// series of fields, and its output has {step} or {time} in its name; the step's number or time takes that place.
    /// Points are located anew where the mesh is another one. If all_steps is set and these conditions do not hold, the
    /// job is an Error.
    bool all_steps = false;
    /// Fields that change from step to step. Each path has one *, and each file that it matches is a step, in natural
    /// order (2 before 10); or it is a .pvd or .vtu.series file. If the output has {step} or {time} in its name, each
    /// step has an output of its own, and the text that the * stood for, or the time, takes that place; points are
    /// located once, and only the values of one step are in memory. Otherwise the steps of NAME, 256 at most, are
    /// columns NAME@STEP.
    std::vector<FieldFile> series = {};
    std::vector<std::string> fields = {};  ///< names, see Sampler::build; empty: all
    std::string output;                    ///< the format goes by the suffix; "-" is CSV on stdout
    /// Where to write the weights of the points on the nodes of the mesh (sampler.hpp): .npz, a matrix that
    /// scipy.sparse.load_npz reads. Empty: nowhere. Not for grids. A SampleJob with weights needs no output.
    std::string weights = {};
    SampleOptions options = {};
    std::optional<VtkData> vtk_data = {};  ///< of an output in a format of VTK; not set: raw

    bool count_degenerate = true;  ///< of SampleReport: a pass over the cells
};

/// Points from one end to the other, equally far apart: each coordinate is rounded.
struct PointLine {
    std::vector<double> from, to;
    std::int64_t count = 200;  ///< at least 1; one is at the first end
};

/// Fields at points: rows to CSV, NPY or VTU files. For a surface (read_surface) rows are those of its nearest point,
/// with the triangle, the feature on which the point lies, and the distance, negative inside; options.outside.limit
/// bounds the distance. A map then has triangles, and weights are those of the nearest points (nearest projection).
struct SampleJob : SamplingJob {
    std::string points;                  ///< a file of points, as for open_points
    std::optional<PointLine> line = {};  ///< points on a line; exactly one of `points`, `line` and `map` is set
    /// A plot of the values along the way from point to point, or of a series over its times, for each point: .png,
    /// .svg, .pdf. At most six curves.
    std::string plot;
    FigureOptions figure = {};              ///< of it: title, unit, background, resolution
    std::vector<std::string> columns = {};  ///< PointOptions::columns
    std::vector<std::string> keep = {};     ///< PointOptions::keep: columns of the points that rows have, too
    std::string map;                        ///< a map (map.hpp) in place of points
    std::string save_map;                   ///< where to write one; empty: nowhere
    std::optional<bool> all{};  ///< a row for each cell that holds a point; not set: no, or as the map has it
};

/// Fields on a regular grid, or at the nodes of another mesh: exactly one of counts, spacing and onto is set.
struct ResampleJob : SamplingJob {
    std::vector<std::int64_t> counts = {};  ///< points along each axis
    std::vector<double> spacing = {};       ///< of points: one for all axes, or one each
    std::vector<double> bounds = {};        ///< low and high, axis after axis; empty: the box of the cells
    std::string onto;                       ///< a mesh; `curved` is of it, too
    FigureOptions figure = {};              ///< of a picture: its colours, axes, title, background
};

/// How the owners of points were found. `pass`: one look at each cell, and no index of the mesh. `axes`: by coordinates
/// along axes, in a mesh that is a grid.
enum class FoundBy : std::uint8_t { walk, candidates, map, grid, pass, axes };

constexpr std::string_view name(FoundBy f) {
    constexpr std::array<std::string_view, 6> names{"walk", "candidates", "map", "grid", "pass", "axes"};
    return names[static_cast<std::size_t>(f)];
}

/// Where points came from.
enum class PointsFrom : std::uint8_t { points, map, mesh, grid };

constexpr std::string_view name(PointsFrom f) {
    constexpr std::array<std::string_view, 4> names{"points", "map", "mesh", "grid"};
    return names[static_cast<std::size_t>(f)];
}

/// Integrals of a column of a cell field: over the cells of its mesh, and over the cells of the mesh at whose nodes it
/// was sampled, between which it is linear (quadratic on second-order cells). Exact sums of value times volume (area in
/// the plane; with straight sides, whatever the orientation), rounded once; cells that overlap count twice.
struct FieldIntegral {
    std::string column;
    double source = 0, target = 0;
    std::uint64_t source_left_out = 0, target_left_out = 0;  ///< cells with a value that is not finite
};

/// Results of a job, from which its reports are made.
struct SampleReport : MeshReport {
    std::string command;  ///< "sample" or "resample"
    std::string output, weights;
    std::string points;                ///< the file they came from; empty for a grid
    CurvedCells onto_curved;           ///< of the mesh of ResampleJob::onto
    std::vector<std::string> columns;  ///< of values
    std::vector<std::string> carried;  ///< columns that were carried through: labels of cells, columns of points
    std::string reason;                ///< why `method`: a clause
    std::optional<Grid> grid;          ///< of ResampleJob::counts and spacing
    std::optional<FigureCounts> picture;
    std::vector<FieldIntegral> integrals;  ///< of the cell fields that became values at nodes of another mesh
    OutsidePolicy outside;
    SampleCounts counts;  ///< locations: one a point
    JobSeconds seconds;
    std::uint64_t degenerate_cells = 0;  ///< method `pass`: of the cells near the points
    std::uint64_t contested_cells = 0;   ///< see Locator::contested_cells
    std::uint64_t rows = 0;
    /// Fields that are sampled and have values that are not finite; of series, those of the first step that has some.
    std::vector<NotFinite> not_finite;
    std::uint64_t nan_values = 0;    ///< of points inside: from values of nodes or cells that are not finite
    std::vector<std::string> steps;  ///< of series, in order; all else but nan_values and seconds is of one of them
    std::vector<double> times;       ///< of these steps, where the mesh is the series
    std::uint64_t meshes = 1;        ///< of such steps; in each of them points are located, and counted
    PointsFrom from = PointsFrom::points;
    FoundBy method = FoundBy::walk;
    Rounding rounding = Rounding::correct;
    Verdict verdict = Verdict::not_checked;  ///< certified: P1 to P4 of check.hpp are proved
    bool all = false;                        ///< a row for each cell that holds a point
    bool surface = false;  ///< `cells` are triangles in space, and rows are of the nearest points on them
};

/// Sample, and write the output. Error, and nothing is written: the job contradicts itself; an input cannot be read; an
/// output is an input or cannot be written; a point is outside under the policy `error`.
Result<SampleReport> sample_files(const SampleJob& job);
/// The plot alone, of what a sampler has: six columns at most.
Status write_line_plot(const std::string& path, const Sampler& sampler, const PointLine& line,
                       const FigureOptions& options);
Result<SampleReport> resample_files(const ResampleJob& job);

}  // namespace barycert
