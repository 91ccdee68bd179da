/// What a run of `barycert sample` or `barycert resample` did: what its reports are made of.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "barycert/check/certificate.hpp"
#include "barycert/core/weights.hpp"
#include "barycert/report/png.hpp"
#include "barycert/sample/grid.hpp"
#include "barycert/sample/sample.hpp"

namespace barycert::report {

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
    check::Verdict verdict = check::Verdict::not_checked;
    SampleSeconds seconds;
    int threads = 1;
};

/// nan, error, fill=V, nearest, nearest=DISTANCE, extrapolate: as on the command line.
std::string policy_text(const OutsidePolicy& policy);

}  // namespace barycert::report
