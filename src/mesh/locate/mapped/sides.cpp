// The sides of cells whose maps are products: who is on which side of them.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/predicates.hpp"
#include "barycert/simplex.hpp"
#include "core/base/vectors.hpp"
#include "core/isoparametric/ball.hpp"
#include "core/shape_functions.hpp"
#include "core/vtk_cell.hpp"
#include "mesh/cell_types.hpp"
#include "mesh/index/box_tree.hpp"
#include "mesh/index/cell_maps.hpp"
#include "mesh/index/crossing.hpp"
#include "mesh/index/facet_contact.hpp"
#include "mesh/index/warped_sides.hpp"
#include "mesh/locate/mapped/mapped_cells.hpp"
#include "mesh/pulling.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::locate {

namespace iso = core::isoparametric;

namespace {

/// Weights of a point in the tetrahedron of a side's nodes.
struct InSide {
    bool holds = false;
    unsigned zeros = 0;       ///< a bit for each weight
    Sign inner = Sign::zero;  ///< a c - b d, times the orientation of the tetrahedron
};

/// The sign of a c - b d, of weights that are none negative.
Sign sign_of_saddle(const std::array<const double*, 4>& n, const double* p) {
    const auto weight = [&]<class N>(std::size_t left_out, N one) {
        std::array<const double*, 4> at = n;
        at[left_out] = p;
        std::array<std::array<N, 3>, 3> e{};
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < 3; ++k) e[i][k] = N(at[i + 1][k]) - N(at[0][k]);
        }
        return one * base::dot(e[0], base::cross(e[1], e[2]));
    };
    using Number = iso::Ball<double>;
    const Number one(1.0);
    const Number near = weight(0, one) * weight(2, one) - weight(1, one) * weight(3, one);
    if (const auto sign = near.sign(); sign && std::isfinite(near.mid)) return static_cast<Sign>(*sign);
    const iso::Rational unit(1), exact = weight(0, unit) * weight(2, unit) - weight(1, unit) * weight(3, unit);
    return static_cast<Sign>(exact.sign());
}

InSide look(const std::array<const double*, 4>& n, const double* p) {
    InSide out;
    if (index::outcode(3, index::box_of(3, n.data(), 4), p) != 0) return out;
    const Sign whole = orient3d(n[0], n[1], n[2], n[3]);
    for (std::size_t i = 0; i < 4; ++i) {
        std::array<const double*, 4> at = n;
        at[i] = p;
        const Sign own = orient3d(at[0], at[1], at[2], at[3]) * whole;
        if (own == Sign::negative) return out;
        if (own == Sign::zero) out.zeros |= 1U << i;
    }
    out.holds = true;
    out.inner = sign_of_saddle(n, p) * whole;
    return out;
}

}  // namespace

template <class Use>
void MappedCells::for_sides(std::size_t shape, Use use) const {
    const std::span nodes = mesh_.shapes.nodes_of(shape);
    unsigned bit = 1;
    for (const std::vector<Mesh::Index>& ring : mesh::rings_of(mesh_.shapes.types[shape])) {
        if (ring.size() != 4) continue;
        use(std::array{mesh_.point(nodes[ring[0]]), mesh_.point(nodes[ring[1]]), mesh_.point(nodes[ring[2]]),
                       mesh_.point(nodes[ring[3]])},
            bit);
        bit <<= 1U;
    }
}

void MappedCells::find_sides() {
    if (mesh_.dimension == 2) return;
    std::vector<std::uint8_t> products(whole_count(), 0);
    for (std::size_t shape = 0; shape < whole_count(); ++shape)
        products[shape] = sign_[shape] != 0 && !maps_.reference(shape)->is_simplex() ? 1 : 0;
    const std::vector<std::uint8_t> warped = mesh::warped_sides(mesh_, products);
    split_sides_ = mesh::compare_sides(mesh_, warped).split;
    for (std::size_t shape = 0; shape < whole_count(); ++shape) {
        const auto first = static_cast<std::size_t>(mesh_.shapes.parts[shape]);
        const bool uncut = products[shape] != 0 && mesh_.shapes.inside[first] == mesh::uncut_part;
        if (warped[shape] != 0 || uncut) warped_.push_back({static_cast<Mesh::Index>(shape), warped[shape], uncut});
    }
    if (warped_.empty()) return;
    std::vector<index::Box> boxes(warped_.size());
    base::parallel_for_each(boxes.size(), 1024, [&](std::size_t i) {
        std::array<const double*, 8> corners{};
        const mesh::CellMaps::Nodes nodes = maps_.nodes(static_cast<std::size_t>(warped_[i].whole));
        for (std::size_t c = 0; c < nodes.count; ++c) corners[c] = mesh_.point(nodes.at[c]);
        boxes[i] = index::box_of(3, corners.data(), static_cast<int>(nodes.count));
    });
    tree_ = std::make_unique<index::BoxTree>(std::move(boxes));
    if (split_sides_.empty()) return;
    boxes.resize(split_sides_.size());
    std::ranges::transform(split_sides_, boxes.begin(), [&](const mesh::SplitSide& side) {
        std::array<const double*, 4> nodes{};
        std::ranges::transform(side.ring, nodes.begin(), [&](Mesh::Index node) { return mesh_.point(node); });
        return index::box_of(3, nodes.data(), 4);
    });
    split_tree_ = std::make_unique<index::BoxTree>(std::move(boxes));
}

bool MappedCells::is_near_split(const double* point) const {
    bool near = false;
    if (split_tree_ != nullptr)
        split_tree_->for_each(index::box_of(3, &point, 1), [&](std::uint32_t) {
            near = true;
            return false;
        });
    return near;
}

Feature MappedCells::feature_by_triangles(std::size_t shape, const double* point) const {
    const std::span nodes = mesh_.shapes.nodes_of(shape);
    int winding = 0;
    for (const std::vector<Mesh::Index>& ring : mesh::rings_of(mesh_.shapes.types[shape])) {
        const std::size_t n = ring.size();
        const auto node = [&](std::size_t i) { return nodes[static_cast<std::size_t>(ring[i])]; };
        const auto are_neighbours = [&](Mesh::Index a, Mesh::Index b) {
            for (std::size_t i = 0; i < n; ++i) {
                const std::array side{node(i), node((i + 1) % n)};
                if (side == std::array{a, b} || side == std::array{b, a}) return true;
            }
            return false;
        };
        for (std::size_t i = 1; i + 1 < n; ++i) {
            const std::array corners{node(0), node(i), node(i + 1)};
            const std::array at{mesh_.point(corners[0]), mesh_.point(corners[1]), mesh_.point(corners[2])};
            const auto on = index::face_around(3, {corners, at}, point);
            if (on[0] < 0) {
                winding += index::crossing(at, point);
                continue;
            }
            if (on[1] < 0) return Feature::vertex;
            // A diagonal of the side is no edge.
            return on[2] < 0 && are_neighbours(on[0], on[1]) ? Feature::edge : Feature::face;
        }
    }
    return winding != 0 ? Feature::interior : Feature::outside;
}

std::vector<MappedCells::AtSides> MappedCells::at_sides(const double* point) const {
    std::vector<AtSides> all;
    if (tree_ == nullptr) return all;
    tree_->for_each(index::box_of(3, &point, 1), [&](std::uint32_t i) {
        const auto shape = static_cast<std::size_t>(warped_[i].whole);
        // The rings of a wedge are seen from outside where its Jacobian is negative, those of others where it is
        // positive.
        const auto outward = static_cast<Sign>(mesh_.shapes.types[shape] == vtk_wedge ? -sign_[shape] : sign_[shape]);
        bool some = false, outside = false;
        Feature on = Feature::interior;
        for_sides(shape, [&](const std::array<const double*, 4>& n, unsigned bit) {
            if (outside || (warped_[i].sides & bit) == 0) return;
            const InSide in = look(n, point);
            if (!in.holds) return;
            some = true;
            outside = in.inner * outward == Sign::negative;
            if (in.inner != Sign::zero) return;
            const int zeros = std::popcount(in.zeros);
            on = std::max(on, zeros == 3 ? Feature::vertex : zeros == 2 ? Feature::edge : Feature::face);
        });
        if (some) return all.push_back({shape, outside, on}), true;
        if (warped_[i].uncut) on = feature_by_triangles(shape, point);
        if (warped_[i].uncut && on != Feature::outside) all.push_back({shape, false, on});
        return true;
    });
    return all;
}

/// Bits of the nodes that are on every face that holds the point.
std::uint64_t MappedCells::active_nodes(std::size_t shape, const double* point) const {
    const mesh::CellMaps::Nodes nodes = maps_.nodes(shape);
    std::uint64_t active = (std::uint64_t{1} << nodes.count) - 1;
    if (const iso::Reference& reference = *maps_.reference(shape); reference.is_simplex()) {
        const unsigned zeros = in_curved(shape, point).zeros;
        for (std::size_t i = 0; i < nodes.count; ++i) {
            for (std::size_t c = 0; c < 4; ++c) {
                if ((zeros >> c & 1U) != 0 && reference.indices[i][c] != 0) active &= ~(std::uint64_t{1} << i);
            }
        }
        return active;
    }
    const bool flat = mesh_.dimension == 2;
    const auto& faces = mesh::rings_of(mesh::numbered_round(mesh_.shapes.types[shape]));  // as CellMaps has the nodes
    const std::size_t count = flat ? faces.front().size() : faces.size();
    for (std::size_t face = 0; face < count; ++face) {
        const std::vector<Mesh::Index>& ring = flat ? faces.front() : faces[face];
        std::array<const double*, 4> n{};
        std::uint64_t own = 0;
        for (std::size_t i = 0; i < (flat ? 2 : ring.size()); ++i) {
            const auto place = static_cast<std::size_t>(ring[(i + (flat ? face : 0)) % ring.size()]);
            n[i] = mesh_.point(nodes.at[place]);
            own |= std::uint64_t{1} << place;
        }
        const auto in_triangle = [&](std::size_t j, std::size_t k) {
            return index::face_around(3, {{0, 1, 2}, {n[0], n[j], n[k]}}, point)[0] >= 0;
        };
        bool on = false;
        if (flat) {
            on = orient2d(n[0], n[1], point) == Sign::zero;  // of a convex cell that holds the point
        } else if (ring.size() == 3) {
            on = in_triangle(1, 2);
        } else if (orient3d(n[0], n[1], n[2], n[3]) == Sign::zero) {
            on = in_triangle(1, 2) || in_triangle(2, 3);
        } else {
            const InSide in = look(n, point);
            on = in.holds && in.inner == Sign::zero;
        }
        if (on) active &= own;
    }
    return active;
}

}  // namespace barycert::locate
