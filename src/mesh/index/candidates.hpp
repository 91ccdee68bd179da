/// Pairs of facets or cells that may meet where they must not, without asking all that meet in a common node.
///
/// Boxes alone would name every pair of a pinwheel: thousands of blades around one node have boxes that all meet there.
/// But two that have node v in common, and a point beside their common face, have the direction from v to that point in
/// common; and if they have nodes v and w, the half plane at the line vw through it. So items are put in groups: by a
/// node that more than `crowd` of them have, of these by a second one that more than `crowd` have, and the rest. An
/// item with the nodes of a group is compared with its members by boxes of directions, any other by boxes of places.
///
/// Cost: O(n log n) and what is named. That is still quadratic where boxes meet though items do not: those of places of
/// long thin items side by side askew to the axes, and those of directions of items that are long and thin as seen from
/// the node (3D): of n blades that are a stretch each, some n^2 / 100 pairs are named.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "mesh/index/box_tree.hpp"

namespace barycert::index {

/// The convex hull of nodes at places: a facet or a cell.
struct Item {
    int count = 0;
    std::array<Mesh::Index, 4> nodes{-1, -1, -1, -1};
    std::array<const double*, 4> at{};

    /// Where it has the node; nullptr if it has not.
    const double* place_of(Mesh::Index node) const;
};

/// So many items at a node that it is not asked for all pairs of them: below it that costs less than groups do; nodes
/// of good meshes have some tens of cells.
inline constexpr std::size_t crowd = 256;

/// More than `crowd` of the items, numbers below `items`, have one node in common; nodes_of(i): those of item i, below
/// `nodes`.
template <class NodesOf>
bool is_crowded(std::size_t nodes, std::size_t items, NodesOf nodes_of) {
    std::vector<std::uint32_t> count(nodes, 0);
    std::uint32_t most = 0;
    for (std::size_t i = 0; i < items; ++i) {
        for (const Mesh::Index node : nodes_of(i)) most = std::max(most, ++count[static_cast<std::size_t>(node)]);
    }
    return most > crowd;
}

class Candidates {
public:
    Candidates(int d, std::span<const Item> items, std::size_t most_at_a_node = crowd);

    /// found(j), in no special order, for each item j that has a point in common with `item` beside the face of their
    /// common nodes, for each one of the same nodes (their boxes are the same), and for others, until it returns false.
    /// Returns false if it did.
    template <class F>
    bool for_each(const Item& item, F&& found) const {
        const Box place = box_of(d_, item.at.data(), item.count);
        return bounds_->for_each(place, [&](std::uint32_t g) {
            const Group& group = groups_[g];
            const auto named = [&](std::uint32_t i) { return found(group.members[i]); };
            const auto [tree, box] = query_of(group, item, place);
            return group.trees[tree]->for_each(box, named);
        });
    }

    /// The box of all items; none if there are no items.
    const Box* bounds() const { return bounds_->bounds(); }

private:
    struct Group {
        std::array<Mesh::Index, 2> nodes{-1, -1};  ///< that all members have
        std::vector<std::uint32_t> members;
        std::array<std::optional<BoxTree>, 3> trees;  ///< by place, direction from the first node, and around both
    };
    /// Which tree of the group to ask for the item, and for which box.
    std::pair<std::size_t, Box> query_of(const Group& group, const Item& item, const Box& place) const;
    void add(std::array<Mesh::Index, 2> nodes, std::vector<std::uint32_t> members, std::span<const Item> items);
    void split(Mesh::Index node, const std::vector<std::uint32_t>& members, std::span<const Item> items);

    int d_;
    std::size_t crowd_;
    std::vector<Group> groups_;
    std::optional<BoxTree> bounds_;
};

}  // namespace barycert::index
