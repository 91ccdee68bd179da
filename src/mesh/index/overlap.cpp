#include "mesh/index/overlap.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "barycert/predicates.hpp"
#include "mesh/index/candidates.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/index/cell_tree.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::index {
namespace {

// Two open convex polytopes are disjoint if and only if a plane separates them weakly, and then there is one whose
// normal is that of a facet of their Minkowski difference: the normal of a face of one, or the product of an edge of
// one and an edge of the other (in the plane: the normal of an edge of one).

/// The other corners, when corner i is left out.
constexpr std::array<std::array<std::size_t, 3>, 4> faces{{{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};
/// The ends of an edge, then the other two corners.
constexpr std::array<std::array<std::size_t, 4>, 6> edges{
    {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}}};

/// Side of p at the facet of a opposite to corner i.
Sign side(int d, const Corners& a, std::size_t i, const double* p) {
    const auto& f = faces[i];
    if (d == 2) return orient2d(a[f[0]], a[f[1]], p);
    return orient3d(a[f[0]], a[f[1]], a[f[2]], p);
}

/// A facet of a has all of b on its outer side, or on it.
bool facet_separates(int d, const Corners& a, const Corners& b) {
    const auto corners = static_cast<std::size_t>(d) + 1;
    for (std::size_t i = 0; i < corners; ++i) {
        const Sign inner = side(d, a, i, a[i]);
        bool separates = true;
        for (std::size_t j = 0; j < corners && separates; ++j) {
            bool common = false;  // a vertex of the facet is on its plane
            for (std::size_t k = 0; k < corners; ++k) common |= k != i && a[k] == b[j];
            separates = common || side(d, a, i, b[j]) != inner;
        }
        if (separates) return true;
    }
    return false;
}

/// The plane through edge e of a, parallel to edge f of b, has a on one side and b on the other, or on it.
bool edges_separate(const Corners& a, const Corners& b, const std::array<std::size_t, 4>& e,
                    const std::array<std::size_t, 4>& f) {
    const double *const p = a[e[0]], *const q = a[e[1]], *const r = b[f[0]], *const s = b[f[1]];
    // Sides of that plane; both ends of f have the same.
    const Sign b_edge = det3d(p, q, r, s, p, r);
    const Sign a2 = det3d(p, q, r, s, p, a[e[2]]), a3 = det3d(p, q, r, s, p, a[e[3]]);
    if (a2 == Sign::zero && a3 == Sign::zero) return false;  // parallel edges: no normal
    const Sign a_side = a2 != Sign::zero ? a2 : a3;
    if (a2 * a3 == Sign::negative || b_edge == a_side) return false;
    const Sign b2 = det3d(p, q, r, s, p, b[f[2]]), b3 = det3d(p, q, r, s, p, b[f[3]]);
    return b2 != a_side && b3 != a_side;
}

}  // namespace

bool may_overlap(int d, const Corners& a, const Corners& b) {
    return !facet_separates(d, a, b) && !facet_separates(d, b, a);
}

bool interiors_meet(int d, const Corners& a, const Corners& b) {
    if (!may_overlap(d, a, b)) return false;
    if (d == 2) return true;
    for (const auto& e : edges) {
        for (const auto& f : edges) {
            if (edges_separate(a, b, e, f)) return false;
        }
    }
    return true;
}

Item item_of(const CellIndex& index, Place cell) {
    Item item{.count = static_cast<int>(index.corners()), .at = index.corner_points(cell)};
    std::copy_n(index.cells[cell].node.begin(), index.corners(), item.nodes.begin());
    return item;
}

bool for_each_near_cell(const CellIndex& index, std::span<const Item> items, std::size_t few,
                        const std::function<const CellTree&()>& tree,
                        const std::function<Decided(std::size_t, Place)>& use) {
    const auto nodes_of = [&](std::size_t c) { return std::span(index.cells[c].node).first(index.corners()); };
    if (items.size() < few && !is_crowded(index.original_node.size(), index.cell_count(), nodes_of)) {
        const CellTree& cells = tree();
        base::parallel_for(items.size(), [&](std::size_t i) {
            const CellBox box = box_of(index, items[i].at.data(), static_cast<std::size_t>(items[i].count));
            cells.for_each_meeting(box, [&](std::size_t c) { return use(i, static_cast<Place>(c)) != Decided::item; });
        });
        return true;
    }
    const Candidates candidates(static_cast<int>(index.dimension()), items);
    base::parallel_for_each(index.cell_count(), 1 << 10, [&](std::size_t c) {
        const auto cell = static_cast<Place>(c);
        candidates.for_each(item_of(index, cell), [&](std::uint32_t i) { return use(i, cell) != Decided::cell; });
    });
    return false;
}

std::vector<std::uint8_t> find_overlapped(const CellIndex& index, std::span<const Place> asked,
                                          std::span<const Place> degenerate,
                                          const std::function<const CellTree&()>& tree) {
    std::vector<std::uint8_t> out(asked.size(), 0);
    std::vector<Item> items(asked.size());
    for (std::size_t i = 0; i < asked.size(); ++i) items[i] = item_of(index, asked[i]);
    for_each_near_cell(index, items, (index.cell_count() + 63) / 64, tree, [&](std::size_t i, Place cell) {
        const std::atomic_ref<std::uint8_t> flag(out[i]);
        if (flag.load(std::memory_order_relaxed) != 0) return Decided::item;
        if (asked[i] == cell || std::ranges::binary_search(degenerate, cell) ||
            !interiors_meet(static_cast<int>(index.dimension()), items[i].at, index.corner_points(cell)))
            return Decided::nothing;
        flag.store(1, std::memory_order_relaxed);
        return Decided::item;
    });
    return out;
}

}  // namespace barycert::index
