/// Fields on a regular grid, cell by cell: each cell finds the points of the grid that it holds, which is many times
/// faster than asking for the cell of each point.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "barycert/sample/grid.hpp"
#include "barycert/sample/sample.hpp"

namespace barycert {

/// Some layers of a grid (2D: some lines), whole, in the order of the grid's points.
struct GridBlock {
    std::uint64_t first_point = 0;
    std::span<const Mesh::Index> cells;  ///< the owner, -1 outside
    std::span<const Feature> features;
    std::span<const double> values;     ///< sampler.columns().size() a point, point after point
    std::span<const double> distances;  ///< as in Samples
};

using GridSink = std::function<Status(const GridBlock&)>;

/// The rows that sampler.sample gives for the points of the grid, bit for bit: owners, features, values, counts (but
/// LocationCounts::tests, and which tier decided a value). Blocks come in order and are gone after the call; memory is
/// that of a few layers. Works on every mesh; no certificate is needed. Errors: those of sample (a point outside, with
/// policy `error`), and of `sink`, after which nothing is done any more.
Status resample(const Sampler& sampler, const Grid& grid, const SampleOptions& options, const GridSink& sink,
                SampleCounts& counts);

}  // namespace barycert
