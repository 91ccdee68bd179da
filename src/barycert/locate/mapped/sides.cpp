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
    if (std::isfinite(near.mid) && std::abs(near.mid) > near.radius)
        return near.mid > 0 ? Sign::positive : Sign::negative;
    const iso::Rational unit(1), exact = weight(0, unit) * weight(2, unit) - weight(1, unit) * weight(3, unit);
    return static_cast<Sign>(exact.sign());
}

bool in_tetrahedron(const std::array<const double*, 4>& n, const double* p) {
    const Sign whole = orient3d(n[0], n[1], n[2], n[3]);
    for (std::size_t i = 0; i < 4; ++i) {
        if (side_of_plane(n, i, p) * whole == Sign::negative) return false;
    }
    return true;
}

InSide look(const std::array<const double*, 4>& n, const double* p) {
    const Sign whole = orient3d(n[0], n[1], n[2], n[3]);
    InSide out;
    for (std::size_t i = 0; i < 4; ++i) {
        const Sign own = side_of_plane(n, i, p) * whole;
        if (own == Sign::negative) return out;
        if (own == Sign::zero) out.zeros |= 1U << i;
    }
    out.holds = true;
    out.inner = sign_of_saddle(n, p) * whole;
    return out;
}

/// The faces with four corners of a linear solid, by places of its nodes in the order of the reference cell.
struct Quads {
    std::array<std::array<std::uint8_t, 4>, 6> corners{};
    std::size_t count = 0;
};

const Quads& quads_of(std::uint8_t type) {
    static const auto all = [] {
        std::array<Quads, 17> quads;
        for (std::uint8_t t = 10; t < 17; ++t) {
            std::string_view faces = mesh::shape_of(t == 11 ? 12 : t).faces;
            while (!faces.empty()) {
                const std::size_t end = std::min(faces.find(' '), faces.size());
                if (end == 4 && quads[t].count < 6) {
                    auto& own = quads[t].corners[quads[t].count++];
                    std::ranges::transform(faces.substr(0, 4), own.begin(),
                                           [](char c) { return static_cast<std::uint8_t>(c - '0'); });
                }
                faces.remove_prefix(std::min(end + 1, faces.size()));
            }
        }
        return quads;
    }();
    return all[type < all.size() ? type : 0];
}

}  // namespace

void MappedCells::for_sides(std::size_t shape,
                            const std::function<void(const std::array<Mesh::Index, 4>&, unsigned)>& use) const {
    const mesh::CellMaps::Nodes nodes = maps_.nodes(shape);
    const Quads& quads = quads_of(mesh_.dimension == 2 ? 0 : mesh_.shapes.types[shape]);
    for (std::size_t side = 0; side < quads.count; ++side) {
        std::array<Mesh::Index, 4> ring{};
        std::ranges::transform(quads.corners[side], ring.begin(), [&](std::uint8_t c) { return nodes.at[c]; });
        use(ring, 1U << side);
    }
}

bool MappedCells::in_some_side(std::size_t shape, const double* point) const {
    const mesh::CellMaps::Nodes nodes = maps_.nodes(shape);
    const Quads& quads = quads_of(mesh_.shapes.types[shape]);
    for (std::size_t side = 0; side < quads.count; ++side) {
        if ((warped_[shape] >> side & 1U) == 0) continue;
        std::array<const double*, 4> p{};
        std::ranges::transform(quads.corners[side], p.begin(), [&](std::uint8_t c) { return at(nodes.at[c]); });
        bool in_box = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax({p[0][k], p[1][k], p[2][k], p[3][k]});
            in_box = in_box && low <= point[k] && point[k] <= high;
        }
        if (in_box && in_tetrahedron(p, point)) return true;
    }
    return false;
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
    for_sides(shape, [&](const std::array<Mesh::Index, 4>& ring, unsigned bit) {
        if ((warped_[shape] & bit) == 0 || out) return;
        const InSide in = look({at(ring[0]), at(ring[1]), at(ring[2]), at(ring[3])}, point);
        if (!in.holds) return;
        in_some = true;
        const Sign inner = in.inner * static_cast<Sign>(sign_[shape]);
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
    const auto& places = maps_.places(shape).at;
    const bool flat = mesh_.dimension == 2;
    const std::uint8_t type = mesh_.shapes.types[shape];
    std::string_view faces = flat ? "01 12 23 30" : mesh::shape_of(type == 11 ? 12 : type).faces;
    for (; !faces.empty(); faces.remove_prefix(std::min(faces.find(' '), faces.size() - 1) + 1)) {
        std::array<const double*, 4> n{};
        std::uint64_t own = 0;
        std::size_t count = 0;
        for (; count < 4 && count < faces.size() && faces[count] != ' '; ++count) {
            const auto place = static_cast<std::size_t>(faces[count] - '0');
            n[count] = places[place];
            own |= std::uint64_t{1} << place;
        }
        const auto in_triangle = [&](std::size_t i, std::size_t j, std::size_t k) {
            if (orient3d(n[i], n[j], n[k], point) != Sign::zero) return false;
            std::array<double, 9> vertices{};
            std::copy_n(n[i], 3, vertices.begin());
            std::copy_n(n[j], 3, vertices.begin() + 3);
            std::copy_n(n[k], 3, vertices.begin() + 6);
            return weight_signs(Simplex::triangle3d, vertices.data(), point).contains();
        };
        bool on = false;
        if (flat) {
            on = orient2d(n[0], n[1], point) == Sign::zero;  // of a convex cell that holds the point
        } else if (count == 3) {
            on = in_triangle(0, 1, 2);
        } else if (orient3d(n[0], n[1], n[2], n[3]) == Sign::zero) {
            on = in_triangle(0, 1, 2) || in_triangle(0, 2, 3);
        } else {
            const InSide in = look(n, point);
            on = in.holds && in.inner == Sign::zero;
        }
        if (on) active &= own;
        if (faces.size() == count) break;
    }
    return active;
}

}  // namespace barycert::locate
