/// What a check and a sampling found, as text, JSON, HTML and pictures. Strings come back; only write_png writes a
/// file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "barycert/check.hpp"
#include "barycert/environment.hpp"
#include "barycert/grid.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/weights.hpp"

// Pictures of slices: one scalar on a regular grid in a plane, by colour, as a PNG file.

namespace barycert {

/// How text looks on the user's terminal, and what commands in it begin with.
struct TerminalStyle {
    bool colour = false;
    std::string command = "barycert";  ///< how the user calls the program, for commands to repeat
    /// What replays a witness: appended to "barycert replay"; a file name, or empty to name the family and case
    /// instead.
    std::string witness_path = {};
    std::vector<std::string> mesh_arguments = {};     ///< as the user gave them, repeated in replay commands
    std::vector<std::string> library_arguments = {};  ///< likewise: the user's kernel libraries
};

/// One line: version, rounding, SIMD target, compiler.
std::string environment_line(const Environment& environment);

struct Slice {
    std::size_t width = 0, height = 0;
    std::span<const double> values = {};  ///< width * height, line after line, the second coordinate ascending
    double aspect = 1;                    ///< spacing of the values along a line over the spacing of lines

    /// What the first and the last colour mean; without one, the least and the greatest of the values that are drawn.
    std::optional<std::pair<double, double>> range = {};
    std::span<const std::uint8_t> valid = {};  ///< empty, or one a value: 0 where there is none (outside)
    bool bar = true;                           ///< a colour bar with the range in numbers, to the right of the slice
};

/// What became of the values.
struct SliceCounts {
    std::uint64_t drawn = 0;       ///< with a colour
    std::uint64_t below = 0;       ///< of these: below the range, drawn as its low end
    std::uint64_t above = 0;       ///< of these: above it, drawn as its high end
    std::uint64_t not_finite = 0;  ///< valid but NaN or infinite: transparent
    std::uint64_t outside = 0;     ///< not valid: transparent
    double low = 0, high = 0;      ///< the range; NaN if nothing is drawn and none was given
};

/// Writes the slice as 8-bit RGBA in sRGB with colours of colour_map.hpp; the file appears whole or not at all.
///
/// One pixel a value, the second coordinate upwards: values[0] is at the lower left. Where aspect is not 1, columns or
/// lines are repeated so that the picture has the shape of the plane: round(width * aspect) columns if it is above 1,
/// else round(height / aspect) lines, each showing the value whose place holds its middle.
/// The range is divided into 256 equal parts, a colour each; its ends have the first and the last colour. If all that
/// is drawn has one value, or the range is one number, that has the colour in the middle. The bar is a white panel of
/// its own beside the slice; a slice less than 25 pixels high is made so high by transparent lines below it. Without a
/// range there is no bar.
///
/// `counts`: if given, set. Errors: sizes that do not fit together, no value at all, more than a million pixels a side;
/// an aspect or a range that is none; a file that cannot be written.
Status write_png(const std::string& path, const Slice& slice, SliceCounts* counts = nullptr);

// What a run of `barycert sample` or `barycert resample` did: what its reports are made of.

/// How the owners of points were found.
enum class FoundBy : std::uint8_t { walk, candidates, map, grid };

constexpr std::string_view name(FoundBy f) {
    return f == FoundBy::walk ? "walk" : f == FoundBy::candidates ? "candidates" : f == FoundBy::map ? "map" : "grid";
}

/// Where points came from.
enum class PointsFrom : std::uint8_t { points, map, mesh, grid };

constexpr std::string_view name(PointsFrom f) {
    return f == PointsFrom::points ? "points" : f == PointsFrom::map ? "map" : f == PointsFrom::mesh ? "mesh" : "grid";
}

/// Wall times of the stages.
struct SampleSeconds {
    double mesh = 0;     ///< reading the mesh and the files of fields
    double certify = 0;  ///< the check of the mesh
    double build = 0;    ///< of the locator and the sampler
    double read = 0;     ///< of points
    double sample = 0;   ///< owners, features and values
    double write = 0;
    double total = 0;
};

struct SampleRun {
    std::string command;  ///< "sample" or "resample"
    std::string mesh, output;
    PointsFrom from = PointsFrom::points;
    std::string points;        ///< the file they came from; empty for a grid
    std::optional<Grid> grid;  ///< of resample --grid and --spacing
    std::optional<SliceCounts> picture;
    int dimension = 3;
    std::uint64_t nodes = 0, cells = 0, degenerate_cells = 0;
    std::vector<std::string> columns;  ///< of values
    Rounding rounding = Rounding::correct;
    bool all = false;  ///< a row for each cell that holds a point
    OutsidePolicy outside;
    SampleCounts counts;  ///< locations: one a point
    std::uint64_t rows = 0;
    std::uint64_t nan_values = 0;  ///< of points inside: from values of nodes or cells that are not finite
    FoundBy method = FoundBy::walk;
    std::string reason;  ///< why that method: a clause
    Verdict verdict = Verdict::not_checked;
    SampleSeconds seconds;
    int threads = 1;
};

/// nan, error, fill=V, nearest, nearest=DISTANCE, extrapolate: as on the command line.
std::string policy_text(const OutsidePolicy& policy);

// The report on a mesh as text for a terminal or a log.

/// The verdict in one line; below it what was checked, what was found and what to do about it, pairs of cells that meet
/// where they must not, measures, notes. At most 100 columns, names of files aside. `mesh` is what the report is of,
/// `name` what the user calls it.
std::string check_text(const CheckReport& report, const Mesh& mesh, const std::string& name,
                       const TerminalStyle& style);

// The report on a mesh as JSON. Every member is documented in SCHEMA.md beside this file.

inline constexpr int check_schema = 1;

/// `name`: what the user calls the mesh.
std::string check_json(const CheckReport& report, const std::string& name, const Environment& environment);

// The report on a mesh as one HTML page, for people: to read, to print, to pass on.

/// The verdict; what was checked and found, with places and remedies; histograms of the measures; the worst cells and
/// those with problems drawn, and where in the mesh they are. UTF-8, self-contained: style and pictures are in the
/// page, which asks for nothing from anywhere and runs no scripts. It is well-formed XML, too. Some hundred kilobytes
/// at most, whatever the size of the mesh. `mesh` is what the report is of, `mesh_name` what the user calls it.
///
/// Cost: some passes over the mesh, and its boundary once more. Of broken meshes nothing is drawn that has no place.
std::string check_html(const CheckReport& report, const Mesh& mesh, const std::string& mesh_name);

// What a run of sampling did, for people.

/// A few lines of at most 120 columns, names of files aside.
std::string sample_text(const SampleRun& run, bool colour);

// What a run of sampling did, as JSON. Every member is documented in SCHEMA.md beside this file.

inline constexpr int sample_schema = 1;

std::string sample_json(const SampleRun& run, const Environment& environment);

}  // namespace barycert
