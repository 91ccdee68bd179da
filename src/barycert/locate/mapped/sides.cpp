// The sides of cells whose maps are products: who is on which side of them.
#include <algorithm>
#include <bit>

#include "barycert/core/isoparametric/ball.hpp"
#include "barycert/locate/mapped/mapped_cells.hpp"
#include "barycert/mesh/pulling.hpp"

namespace barycert::locate {

namespace iso = core::isoparametric;

namespace {

Sign side_of_plane(const std::array<const double*, 4>& n, std::size_t left_out, const double* p) {
    std::array<const double*, 4> at = n;
    at[left_out] = p;
    return orient3d(at[0], at[1], at[2], at[3]);
}

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
        return one *
               (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]));
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
    for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax({n[0][k], n[1][k], n[2][k], n[3][k]});
        if (p[k] < low || p[k] > high) return out;
    }
    const Sign whole = orient3d(n[0], n[1], n[2], n[3]);
    for (std::size_t i = 0; i < 4; ++i) {
        const Sign own = side_of_plane(n, i, p) * whole;
        if (own == Sign::negative) return out;
        if (own == Sign::zero) out.zeros |= 1U << i;
    }
    out.holds = true;
    out.inner = sign_of_saddle(n, p) * whole;
    return out;
}

/// CellMaps has the nodes of a voxel in the order of a hexahedron.
const std::vector<std::vector<Mesh::Index>>& faces_of(std::uint8_t type) {
    return mesh::rings_of(type == 11 ? 12 : type);
}

}  // namespace

void MappedCells::for_sides(std::size_t shape,
                            const std::function<void(const std::array<Mesh::Index, 4>&, unsigned)>& use) const {
    if (mesh_.dimension == 2) return;
    const mesh::CellMaps::Nodes nodes = maps_.nodes(shape);
    unsigned bit = 1;
    for (const auto& corners : faces_of(mesh_.shapes.types[shape])) {
        if (corners.size() != 4) continue;
        std::array<Mesh::Index, 4> ring{};
        std::ranges::transform(corners, ring.begin(),
                               [&](Mesh::Index c) { return nodes.at[static_cast<std::size_t>(c)]; });
        use(ring, bit);
        bit <<= 1U;
    }
}

void MappedCells::find_sides() {
    struct Found {
        std::array<Mesh::Index, 4> key;
        Side side;
    };
    std::vector<Found> all;
    for (std::size_t shape = 0; shape < whole_count(); ++shape) {
        // Whoever is across a side may own points of its tetrahedron, mapped or not.
        if (mesh_.shapes.types[shape] > 14 || mesh_.dimension == 2) continue;
        for_sides(shape, [&](const std::array<Mesh::Index, 4>& ring, unsigned bit) {
            if (sign_[shape] != 0 && (warped_[shape] & bit) == 0) return;
            Found found{ring, {ring, {static_cast<Mesh::Index>(shape), -1}}};
            std::ranges::sort(found.key);
            all.push_back(found);
        });
    }
    std::ranges::stable_sort(all, {}, &Found::key);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const bool again = i > 0 && all[i].key == all[i - 1].key;
        if (again && sides_.back().cells[1] < 0) {
            sides_.back().cells[1] = all[i].side.cells[0];
        } else {
            sides_.push_back(all[i].side);
        }
    }
    std::erase_if(sides_, [&](const Side& side) {
        return std::ranges::none_of(side.cells,
                                    [&](Mesh::Index s) { return s >= 0 && sign_[static_cast<std::size_t>(s)] != 0; });
    });
    if (sides_.empty()) return;
    std::vector<index::Box> boxes;
    for (const Side& side : sides_) {
        std::array<const double*, 4> p{};
        std::ranges::transform(side.nodes, p.begin(), [&](Mesh::Index node) { return at(node); });
        boxes.push_back(index::box_of(3, p.data(), 4));
    }
    tree_ = std::make_unique<index::BoxTree>(std::move(boxes));
}

Feature MappedCells::held(std::size_t shape, const double* point, Feature in_parts) const {
    if (sign_[shape] == 0 || warped_[shape] == 0) return in_parts;
    bool in_some = false, out = false;
    Feature on = Feature::interior;
    // VTK's wedges have a negative Jacobian where their rings are seen from outside, all others a positive one.
    const Sign turned = static_cast<Sign>(mesh_.shapes.types[shape] == 13 ? -sign_[shape] : sign_[shape]);
    for_sides(shape, [&](const std::array<Mesh::Index, 4>& ring, unsigned bit) {
        if ((warped_[shape] & bit) == 0 || out) return;
        const InSide in = look({at(ring[0]), at(ring[1]), at(ring[2]), at(ring[3])}, point);
        if (!in.holds) return;
        in_some = true;
        const Sign inner = in.inner * turned;
        out = inner == Sign::negative;
        if (inner != Sign::zero) return;
        const int count = std::popcount(in.zeros);
        on = std::max(on, count == 3 ? Feature::vertex : count == 2 ? Feature::edge : Feature::face);
    });
    if (out) return Feature::outside;
    return in_some ? on : in_parts;
}

/// Those of each face that holds the point.
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
    const auto& faces = faces_of(mesh_.shapes.types[shape]);
    const std::size_t count = flat ? faces.front().size() : faces.size();
    for (std::size_t face = 0; face < count; ++face) {
        const std::vector<Mesh::Index>& ring = flat ? faces.front() : faces[face];
        std::array<const double*, 4> n{};
        std::uint64_t own = 0;
        for (std::size_t i = 0; i < (flat ? 2 : ring.size()); ++i) {
            const auto place = static_cast<std::size_t>(ring[(i + (flat ? face : 0)) % ring.size()]);
            n[i] = at(nodes.at[place]);
            own |= std::uint64_t{1} << place;
        }
        const auto in_triangle = [&](std::size_t j, std::size_t k) {
            if (orient3d(n[0], n[j], n[k], point) != Sign::zero) return false;
            std::array<double, 9> vertices{};
            std::copy_n(n[0], 3, vertices.begin());
            std::copy_n(n[j], 3, vertices.begin() + 3);
            std::copy_n(n[k], 3, vertices.begin() + 6);
            return weight_signs(Simplex::triangle3d, vertices.data(), point).contains();
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
