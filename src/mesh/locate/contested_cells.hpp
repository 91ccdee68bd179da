/// Cells that may meet others elsewhere than at common faces, and who of them owns a point.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/simplex.hpp"
#include "core/base/lists.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/index/cell_tree.hpp"
#include "mesh/index/proof.hpp"
#include "mesh/locate/lanes.hpp"
#include "mesh/locate/lazy.hpp"
#include "mesh/locate/names.hpp"

namespace barycert::locate {

/// The cells that others may meet beside common faces (doc/theorem.md), to find who else holds a point.
class ContestedCells {
public:
    /// The contested cells that are not degenerate. `index` must stay.
    ContestedCells(const CellIndex& index, const Proof& proof, std::span<const Place> degenerate);

    std::size_t size() const { return cells_.size(); }

    /// Makes the lists. Before threads share the points: results are the same with them, counts of tests are not.
    void prepare() const {
        lists_.get([this] { return make_lists(); });
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
};

}  // namespace barycert::locate
