/// Many points at once, on SIMD lanes: their bins, the cells whose boxes hold them, steps of their walks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/index/cell_index.hpp"
#include "mesh/index/cell_tree.hpp"
#include "mesh/locate/names.hpp"

namespace barycert::locate {

/// A point among others in the order of the bins. 2D: z = 0.
struct alignas(32) PointRecord {
    std::array<double, 3> at;
    std::uint32_t number;  ///< where its results go
};

/// Four further components of the values of a node: one aligned load, as a NodeRecord.
struct alignas(32) ValueRecord {
    std::array<double, 4> value;
};

/// A node's data as lanes read them: its coordinates and component 0 side by side, then components in fours.
struct NodeValues {
    const NodeRecord* first = nullptr;
    /// Component c >= 1 of a node: more[(c - 1) / 4 * node_count + node], (c - 1) % 4.
    const ValueRecord* more = nullptr;
    std::size_t node_count = 0;
    std::size_t components = 0;

    double at(std::size_t node, std::size_t c) const {
        return c == 0 ? first[node].value : more[(c - 1) / 4 * node_count + node].value[(c - 1) % 4];
    }
};

class SortedPoints;
class Occupancy;

/// In place of a bin: no cell holds the point.
inline constexpr std::uint32_t no_bin = ~std::uint32_t{0};

/// bin[i] = index.bins.of(point i), or no_bin if the point lies beyond the box of the cells or, if `occupancy` is
/// given, where it has no cell. Returns whether all coordinates are finite; a point with one that is not gets no_bin.
bool find_bins(const CellIndex& index, const Occupancy* occupancy, std::span<const double> points, std::uint32_t* bin);

struct Candidate {
    std::uint32_t point;
    Place cell;
};

/// Appends each cell whose box holds points[i], for i = which[0 .. count), to `out`, point by point. Cells that are not
/// named do not hold the point. Points must lie in the box of the mesh.
void find_candidates(const CellIndex& index, const CellTree& tree, const PointRecord* points,
                     const std::uint32_t* which, std::size_t count, std::vector<Candidate>& out);

/// Points that are found together: enough for full lanes in every round of the walks, few enough for the first cache.
inline constexpr std::size_t chunk_size = 1024;

/// Where a walk stands.
struct alignas(8) Walk {
    std::uint32_t point;
    Place cell;
};

/// With room for a vector more than the points of a chunk.
struct WalkList {
    std::array<Walk, chunk_size + 8> walks;
    std::size_t count = 0;
};

/// Where the walks of the next chunk start. To be found bit by bit, between the steps of others: what each needs in
/// memory is asked for, and too much asked for at once would keep all waiting.
struct Upcoming {
    const CellIndex* index = nullptr;
    const SortedPoints* sorted = nullptr;
    std::size_t first = 0, count = 0, done = 0;
    std::array<Walk, chunk_size> walks;

    void find(std::size_t number);
};

/// One step of each of `count` walks. Where the point is certainly inside the cell, the walk ends and goes to
/// `arrived`; where it is certainly beyond a facet that has a neighbour, it goes on there; these walks are moved to the
/// front of `walks`, and their number is returned. All others, on facets or at the end of the domain or in doubt, go to
/// `stuck`, with the cell where they stand, or ~cell if the point is certainly outside of it. `walks` is of the size of
/// a WalkList. `nodes`: those of the index, or a copy. `fetch`: ask some steps before for the memory that a step will
/// read. In between, walks of `upcoming` are found.
std::size_t step_walks(const CellIndex& index, const NodeRecord* nodes, const PointRecord* points, Walk* walks,
                       std::size_t count, bool fetch, Upcoming& upcoming, WalkList& arrived, WalkList& stuck);

}  // namespace barycert::locate
