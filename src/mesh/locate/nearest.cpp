// The nearest point of a mesh: branch and bound over a tree of boxes. Floating point leaves out what its bound proves
// to be farther than the best so far; the feature of each cell that is left, and which of two is nearer, is decided
// exactly.
#include "mesh/locate/nearest.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "mesh/index/box_tree.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/locate/batch.hpp"
#include "mesh/locate/mapped/nearest_side.hpp"
#include "mesh/locate/near_bounds.hpp"
#include "mesh/locate/near_feature.hpp"

namespace barycert {
namespace locate {
namespace {

/// Empty of cells that have maps.
Box box_of_cell(const CellIndex& index, const MappedCells* mapped, std::size_t cell) {
    if (mapped != nullptr && mapped->is_mapped(index.original[cell])) return empty_box;
    return box_of(3, index.corner_points(static_cast<Place>(cell)).data(), static_cast<int>(index.corners()));
}

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A box or cell to be looked at, those of lower key first.
struct Open {
    Real key;
    std::size_t level, i;
};

class Search {
public:
    Search(const CellIndex& index, const MappedCells* mapped, const double* point, double limit, NearestWork& work)
        : index_(index),
          mapped_(mapped),
          work_(work),
          limited_(limit < infinity),
          limit_(limited_ ? limit + 0x1p-1074L : 0) {
        std::copy_n(point, index_.dimension(), p_.begin());
    }

    Nearest among(std::span<const std::uint32_t> places) {
        for (const std::uint32_t i : places) try_cell(i);
        return found();
    }

    Nearest in(const NearestTree& tree) {
        const std::size_t top = tree.levels() - 1;
        if (is_empty(tree.box(top, 0))) return found_;
        best_.place = place(tree.box(top, 0));  // of no cell: something to compare with
        std::vector<Open> stack;
        open(tree.box(top, 0), top, 0, stack);
        std::vector<Open> next;
        while (!stack.empty()) {
            const Open now = stack.back();
            stack.pop_back();
            if (beyond(place(tree.box(now.level, now.i)))) continue;
            next.clear();
            const std::size_t first = NearestTree::fan * now.i;
            const std::size_t below = now.level == 0 ? index_.cell_count() : tree.count(now.level - 1);
            for (std::size_t i = first; i < std::min(below, first + NearestTree::fan); ++i) {
                if (now.level == 0) {
                    open(box_of_cell(index_, mapped_, i), 0, i, next);
                } else {
                    open(tree.box(now.level - 1, i), now.level - 1, i, next);
                }
            }
            std::sort(next.begin(), next.end(), [](const Open& a, const Open& b) { return b.key < a.key; });
            if (now.level != 0) {
                stack.insert(stack.end(), next.begin(), next.end());
                continue;
            }
            for (; !next.empty(); next.pop_back()) try_cell(next.back().i);
        }
        return found();
    }

private:
    Nearest found() {
        if (found_.cell >= 0) found_.distance = distance_to(p_, feature_);
        return found_;
    }

    static bool is_empty(const Box& box) { return box.low[0] > box.high[0]; }
    NearPlace place(const Box& box) const { return NearPlace(p_, box.nearest(p_), {}); }

    /// Certainly farther than the best, or than the limit.
    bool beyond(const NearPlace& x) const {
        if (found_.cell >= 0 && farther(x, best_.place).low() > best_.slack) return true;
        if (!limited_) return false;  // it would be true of none, but arithmetic with infinity is slow
        Real square = 0;
        for (const Real away : x.away) square += away * away;
        return square * (1 - 0x1p-40L) > limit_ * limit_;
    }

    void open(const Box& box, std::size_t level, std::size_t i, std::vector<Open>& out) {
        if (is_empty(box)) return;
        ++work_.boxes;
        const NearPlace x = place(box);
        if (!beyond(x)) out.push_back({key(farther(x, best_.place).value), level, i});
    }
    /// A number, that sorting be sound.
    static Real key(Real x) { return x == x ? x : 0; }

    void try_cell(std::size_t i) {
        ++work_.cells;
        const NearCell cell = near_cell(index_, i);
        const NearGuess guess = guess_nearest(cell, p_);
        const Mesh::Index number = index_.original[i];
        if (found_.cell >= 0) {
            // The square of the distance to any point of the cell exceeds that to the best by at least this.
            const Real excess = farther(guess.place, best_.place).low() - guess.gap - best_.slack;
            if (excess > 0 || (excess >= 0 && number > found_.cell)) return;
        }
        ++work_.exact;
        NearFeature feature;
        if (!nearest_feature(cell, p_, guess.mask, feature)) return;  // degenerate
        const NearBest here(p_, feature);
        const int order = found_.cell < 0 ? -1 : compare(feature, here);
        if (order > 0 || (order == 0 && number > found_.cell)) return;
        found_.cell = number;
        found_.nodes = feature.nodes;
        feature_ = feature;
        best_ = here;
    }

    /// -1, 0, 1 as p is nearer to the feature than to the best, as near, or farther.
    int compare(const NearFeature& feature, const NearBest& here) {
        if (feature.nodes == feature_.nodes) return 0;
        const Estimate more = farther(here.place, best_.place);
        const Real slack = here.slack + best_.slack;
        if (more.low() > slack) return 1;
        if (-more.high() > slack) return -1;
        ++work_.comparisons;
        return compare_distances(p_, feature, feature_);
    }

    const CellIndex& index_;
    const MappedCells* mapped_;
    NearestWork& work_;
    bool limited_;
    Real limit_;  ///< with room for the rounding of distances
    Point3 p_{};
    Nearest found_{.distance = infinity};
    NearFeature feature_;
    NearBest best_;
};

}  // namespace

NearCell near_cell(const CellIndex& index, std::size_t place) {
    const std::size_t corners = index.corners();
    NearCell cell{.count = static_cast<int>(corners), .in_space = corners == index.dimension()};
    std::array<Place, 4> places{};
    std::copy_n(index.cells[place].node.begin(), corners, places.begin());
    const auto node = [&](Place q) { return index.original_node[static_cast<std::size_t>(q)]; };
    // By insertion: in the part of std::sort that is for more than 16, GCC 12 sees a read past the end when it
    // compiles for its sanitizers.
    for (std::size_t k = 1; k < corners; ++k) {
        for (std::size_t j = k; j > 0 && node(places[j]) < node(places[j - 1]); --j)
            std::swap(places[j], places[j - 1]);
    }
    for (std::size_t k = 0; k < corners; ++k) {
        cell.nodes[k] = node(places[k]);
        cell.at[k] = index.nodes[places[k]].at;
    }
    return cell;
}

NearestTree::NearestTree(const CellIndex& index, const MappedCells* mapped) {
    std::size_t below = index.cell_count();
    do {
        const std::size_t level = begin_.size(), count = (below + fan - 1) / fan;
        begin_.push_back(boxes_.size());
        for (std::size_t i = 0; i < count; ++i) {
            Box all = empty_box;
            for (std::size_t j = fan * i; j < std::min(below, fan * (i + 1)); ++j)
                all.add(level == 0 ? box_of_cell(index, mapped, j) : boxes_[begin_[level - 1] + j]);
            boxes_.push_back(all);
        }
        below = count;
    } while (below > 1);
    begin_.push_back(boxes_.size());
}

Nearest find_nearest(const CellIndex& index, const NearestTree& tree, const double* point, double limit,
                     NearestWork* work, const MappedCells* mapped) {
    const Nearest none{.distance = infinity};
    if (!(limit >= 0)) return none;
    NearestWork unasked;
    const Nearest found = Search(index, mapped, point, limit, work != nullptr ? *work : unasked).in(tree);
    return found.distance <= limit ? found : none;
}

Nearest find_nearest_of(const CellIndex& index, std::span<const std::uint32_t> places, const double* point,
                        double limit) {
    NearestWork unasked;
    const Nearest found = Search(index, nullptr, point, limit, unasked).among(places);
    return found.distance <= limit ? found : Nearest{.distance = infinity};
}

Nearest find_nearest(const LocatorData& data, const double* point, double limit, NearestWork* work) {
    if (data.index.cell_count() == 0) return {.distance = infinity};
    return find_nearest(data.index, data.parts.nearest_tree(), point, limit, work, data.mapped.get());
}

}  // namespace locate

Result<Nearest> Locator::nearest(const double* point, double limit) const {
    const ExactEnvironment environment;
    if (data_->grid) return locate::not_listed("the nearest cell");
    limit = base::held(limit);
    const std::size_t d = data_->index.dimension();
    if (Status status = locate::check_finite({point, d}, d); !status) return status.error();
    if (data_->mapped == nullptr) return locate::find_nearest(*data_, point, limit);
    if (!(limit >= 0)) return Nearest{.distance = std::numeric_limits<double>::infinity()};
    if (const Location at = *locate(point); at.cell >= 0) return Nearest{.cell = at.cell};
    return locate::nearest_in_maps(*data_, point, limit).nearest;
}

}  // namespace barycert
