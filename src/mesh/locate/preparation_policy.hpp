/// When it pays to make the parts of an index: one policy, and all that is counted for it.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>

#include "barycert/locator.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/locate/contested_cells.hpp"
#include "mesh/locate/lazy_parts.hpp"
#include "mesh/locate/occupancy.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::locate {

/// Decides by the number of points of a call; for calls of one point, by the number of such calls so far. So the parts
/// that are made do not depend on threads. They do not change results, only which cells are tested.
class PreparationPolicy {
public:
    /// Whether a locator may be built without the proof, for points to show whether it pays.
    static bool proves_later(Prove prove, std::size_t cells) {
        constexpr std::size_t small = 100000;  // as Prove::when_it_pays promises
        return prove == Prove::when_it_pays && cells <= small;
    }

    /// The parts of an index of so many cells, which must stay.
    PreparationPolicy(const LazyParts& parts, const CellIndex& index) : parts_(parts), index_(index) {}

    /// Makes what pays when so many points are located; calls with fewer points profit of it later.
    void prepare(std::size_t points) const {
        prove_for(points);
        if (parts_.proved() != nullptr && !parts_.proved()->proof.contested.empty() && points > cells() / cost_of_list)
            parts_.contested_cells().prepare();
        if (static_cast<double>(points) < cost_of_coarse * cells_of_occupancy()) return;
        expect_outside(static_cast<double>(points) * (1 - parts_.filled()));
    }
    /// Proves cells if that pays: when so many points more will be located.
    void prove_for(std::size_t points) const {
        // As measured: meshes of 2,400 and 39,000 cells are proved in the time that these save by walks.
        constexpr std::size_t enough = 50000;
        if (parts_.method() != Method::walk || parts_.proved() != nullptr) return;
        if (asked_.fetch_add(points, std::memory_order_relaxed) + points >= enough) parts_.demand_proved();
    }
    /// A call for one point found it outside without an occupancy.
    void found_outside() const {
        const auto enough = static_cast<std::size_t>(std::ceil(cost_of_coarse * cells_of_occupancy()));
        if (outside_.load(std::memory_order_relaxed) >= enough) return;
        if (outside_.fetch_add(1, std::memory_order_relaxed) + 1 == enough)
            base::in_arena(parts_.threads(), cells(), [&] { expect_outside(static_cast<double>(enough)); });
    }
    /// A call for one point found it in a contested cell. Precondition: proved.
    void found_contested() const {
        const ContestedCells& contested = parts_.contested_cells();
        if (cost_of_list * contested_.fetch_add(1, std::memory_order_relaxed) > contested.size()) contested.prepare();
    }

private:
    /// A list of ContestedCells costs about as much as asking its tree for so many points.
    static constexpr std::size_t cost_of_list = 4;
    static constexpr double cost_of_coarse = 0.6, cost_of_fine = 6;  ///< in points outside, a cell
    static constexpr double max_filled = 0.95;

    std::size_t cells() const { return index_.cell_count(); }
    /// An occupancy of few cells takes as long as one of a certain number.
    double cells_of_occupancy() const { return static_cast<double>(std::max(cells(), Occupancy::least_cells)); }

    /// Makes the occupancy that pays for so many points outside. As measured: one takes about 100 ns without; to make
    /// the coarse one takes about 60 ns a cell. The fine one takes about 600 and saves a few more nanoseconds a point:
    /// where there are so many points, they are taken not to be the last.
    void expect_outside(double points) const {
        if (!(parts_.filled() < max_filled) || points < cost_of_coarse * cells_of_occupancy()) return;
        if (points >= cost_of_fine * cells_of_occupancy())
            parts_.make_occupancy(Occupancy::Detail::fine);
        else if (!parts_.has_fine_occupancy())
            parts_.make_occupancy(Occupancy::Detail::coarse);
    }

    const LazyParts& parts_;
    const CellIndex& index_;
    mutable std::atomic<std::size_t> asked_ = 0;      ///< points before the proof
    mutable std::atomic<std::size_t> outside_ = 0;    ///< points of calls for one, before an occupancy is made
    mutable std::atomic<std::size_t> contested_ = 0;  ///< points of calls for one
};

}  // namespace barycert::locate
