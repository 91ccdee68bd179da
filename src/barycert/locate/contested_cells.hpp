/// The cells that others may meet beside common faces (doc/theorem.md), to find who else holds a point.
#pragma once

#include "barycert/base/lists.hpp"
#include "barycert/index/cell_tree.hpp"
#include "barycert/index/proof.hpp"
#include "barycert/locate/lazy.hpp"
#include "barycert/locate/names.hpp"
#include "barycert/predicates.hpp"

namespace barycert::locate {

struct PointRecord;

class ContestedCells {
public:
    /// The contested cells that are not degenerate. `index` must stay.
    ContestedCells(const CellIndex& index, const Proof& proof, std::span<const Place> degenerate);

    /// A list costs about as much as asking the tree for so many points.
    static constexpr std::size_t cost_of_list = 4;

    /// Makes the lists. Before threads share the points: results are the same with them, counts of tests are not.
    void prepare() const {
        lists_.get([this] { return make_lists(); });
    }
    /// One more of points that come one by one.
    void prepare_for_one_more() const {
        if (cost_of_list * asked_.fetch_add(1, std::memory_order_relaxed) > cells_.size()) prepare();
    }

    /// For points[which[i]], i < count, each inside the contested cell owner[which[i]], certainly not on its faces:
    /// sets the owner and the feature. Others that hold the point are contested, for in one that is not, every cell
    /// that holds a point has the face on which it lies.
    void find_owners(const PointRecord* points, const std::uint32_t* which, std::size_t count, Place* owner,
                     Feature* feature, TierCounts& tests) const;

    std::size_t bytes() const { return cells_.size() * sizeof(Place) + tree_.bytes() + bytes_of(lists_); }

private:
    /// For cells_[i], those of lower number in the mesh that may overlap it. Empty if there would be too many.
    using Lists = base::Lists<Place>;
    Lists make_lists() const;

    const CellIndex& index_;
    std::vector<Place> cells_;  ///< ascending
    BoxGroups tree_;            ///< of their boxes
    Lazy<Lists> lists_;
    mutable std::atomic<std::size_t> asked_ = 0;  ///< one by one
};

}  // namespace barycert::locate
