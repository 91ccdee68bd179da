// One point: a walk without the buffers of many.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "barycert/environment.hpp"
#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "core/grid_lanes.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/locate/batch.hpp"
#include "mesh/locate/cell_signs.hpp"
#include "mesh/locate/finder.hpp"
#include "mesh/locate/lanes.hpp"
#include "mesh/locate/locator_data.hpp"
#include "mesh/locate/occupancy.hpp"

namespace barycert {
namespace locate {
namespace {

/// Result of a look at one cell, as of a step of the walks on lanes, which have the proofs.
struct Look {
    bool inside = false;  ///< certainly
    bool beyond = false;  ///< certainly, of the facet opposite to `face`
    bool far = false;     ///< by several times the height of the cell over that facet, about
    std::size_t face = 0;
};

template <Simplex s>
Look look(const CellIndex& index, Place place, const double* p) {
    constexpr double many = 4;
    constexpr std::size_t d = space_dimension(s);
    CellAtPoint<s> at(index, index.cells[place], p);
    auto& n = at.weights.numerator;
    // A branch, as cells of a mesh are nearly all oriented alike: nothing waits for the denominator.
    if (at.weights.denominator < 0) [[unlikely]] {
        for (double& x : n) x = -x;
    }
    Look out;
    const std::size_t first = n[1] < n[0] ? 1 : 0, other = d == 3 && n[d] < n[2] ? d : 2;
    const double lowest = std::min(std::min(n[0], n[1]), std::min(n[2], n[d]));
    out.face = std::min(n[2], n[d]) < std::min(n[0], n[1]) ? other : first;
    if (!at.in_range) return out;
    out.inside = lowest > at.numerator_error();
    out.beyond = lowest < -at.numerator_error();
    out.far = lowest < -many * std::abs(at.weights.denominator);
    return out;
}

/// Where a walk of one point ends.
struct End {
    Place cell;
    bool inside;   ///< certainly
    bool outside;  ///< of this cell, certainly, and it has no neighbour there
};

/// Where the last walk of this thread ended. A particle's next hint is that cell, and to look its place up would wait
/// for memory.
///
/// It cannot change an answer, only how long that takes. A walk starts there, and any place that the index has is a
/// start (so what is kept of a locator that is gone, at whose address there is another now, does no harm). A walk ends
/// - at a cell that certainly holds the point in its interior: if the cell is not contested, no other holds the point
///   (doc/theorem.md), so all walks that end like this end there; if it is, find_owners() takes the lowest of all that
///   hold the point;
/// - or without an answer, and Finder::settle() decides by exact signs of cells, whatever cell it is told to begin
/// with.
struct LastEnd {
    const LocatorData* data = nullptr;
    Mesh::Index cell = -1;
    Place place = -1;
};
thread_local LastEnd last_end;

/// A place to walk from, and whether it is the hint's.
struct From {
    Place cell;
    bool hint;
};

From start_of(const LocatorData& data, const double* p, Mesh::Index hint) {
    const CellIndex& index = data.index;
    if (hint < 0 || static_cast<std::size_t>(hint) >= index.cell_count()) return {index.start[index.bins.of(p)], false};
    if (last_end.cell == hint && last_end.data == &data &&
        static_cast<std::size_t>(last_end.place) < index.cell_count())
        return {last_end.place, true};
    // Both are asked of memory at the same time. Cells that are far apart in the order of the curve may be neighbours:
    // then the bin's start is a little farther than the hint.
    constexpr Place near = 40;
    const Place place = data.parts.places()[static_cast<std::size_t>(hint)], start = index.start[index.bins.of(p)];
    return std::abs(place - start) <= near ? From{place, true} : From{start, false};
}

/// Asks for what the next look may read, and for the number of the cell, while this one is looked at.
void fetch_around(const CellIndex& index, Place cell) {
    for (const Place next : index.cells[cell].next) __builtin_prefetch(&index.cells[std::max(next, 0)]);
    __builtin_prefetch(&index.original[cell]);
}

/// If a hint turns out far, or does not lead there in some steps, the walk goes on from the start of the point's bin.
template <Simplex s>
End walk(const CellIndex& index, const double* p, From from) {
    constexpr int patience = 4, max_steps = 256;
    constexpr std::size_t in_cache = std::size_t{1} << 15;
    const bool fetch = index.cell_count() > in_cache;
    Place cell = from.cell;
    for (int step = 0; step < max_steps; ++step) {
        if (fetch && (step > 0 || !from.hint)) fetch_around(index, cell);
        const Look at = look<s>(index, cell, p);
        if (at.inside) return {cell, true, false};
        if (!at.beyond) return {cell, false, false};
        const Place next = index.cells[cell].next[at.face];
        if (from.hint && (at.far || step == patience || next < 0)) {
            from = {index.start[index.bins.of(p)], false};
            cell = from.cell;
        } else if (next < 0) {
            return {cell, false, true};
        } else {
            cell = next;
        }
    }
    return {cell, false, false};
}

template <Simplex s>
End walk_and_note(const LocatorData& data, const double* p, Mesh::Index hint) {
    const End end = walk<s>(data.index, p, start_of(data, p, hint));
    last_end = {&data, data.index.original[end.cell], end.cell};
    return end;
}

}  // namespace
}  // namespace locate

Result<Location> Locator::locate(const double* point, Mesh::Index hint) const {
    const ExactEnvironment environment;
    const locate::LocatorData& data = *data_;
    const locate::CellIndex& index = data.index;
    const std::size_t d = index.dimension();
    for (std::size_t k = 0; k < d; ++k) {
        if (!std::isfinite(point[k])) return locate::check_finite({point, d}, d).error();
    }
    if (data.grid) {
        Location found;
        core::sample_grid(*data.grid, {{point, d}, &found.cell, &found.feature}, nullptr);
        return found;
    }
    const auto location = [&](locate::Place owner, Feature feature) {
        const Location found = owner < 0 ? Location{} : Location{index.original[owner], feature};
        return data.mapped ? data.settle(point, found) : found;
    };
    if (!index.box_holds(point)) return location(-1, Feature::outside);
    const locate::Occupancy* const occupancy = data.parts.occupancy();
    const auto no_cell_is_near = [&] { return occupancy != nullptr && !occupancy->may_hold(index, point); };
    // Who has no hint may be outside, and then a walk would be in vain.
    if (hint < 0 && no_cell_is_near()) return location(-1, Feature::outside);
    locate::PointRecord record{};
    for (std::size_t k = 0; k < d; ++k) record.at[k] = point[k];
    locate::Place stuck = -1;
    data.policy.prove_for(1);
    if (const auto* const proved = data.parts.proved()) {
        const locate::End end = d == 2 ? locate::walk_and_note<Simplex::triangle>(data, point, hint)
                                       : locate::walk_and_note<Simplex::tetrahedron>(data, point, hint);
        if (end.inside && !proved->proof.is_contested(end.cell)) return location(end.cell, Feature::interior);
        if (end.inside) {
            locate::Place lowest = end.cell;
            Feature on = Feature::interior;
            TierCounts tests;
            constexpr std::uint32_t which = 0;
            data.policy.found_contested();
            data.parts.contested_cells().find_owners(&record, &which, 1, &lowest, &on, tests);
            return location(lowest, on);
        }
        stuck = end.outside ? ~end.cell : end.cell;
    }
    if (hint >= 0 && no_cell_is_near()) return location(-1, Feature::outside);
    locate::Finder finder(data, index.nodes.data(), 1);
    locate::Place owner = -1;
    Feature feature = Feature::outside;
    finder.settle(record, stuck, owner, feature);
    if (owner < 0 && occupancy == nullptr) data.policy.found_outside();
    return location(owner, feature);
}

}  // namespace barycert
