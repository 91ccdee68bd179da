#include "tests/systems/point_sets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>

#include "barycert/grid.hpp"
#include "core/base/random.hpp"
#include "mesh/cell_types.hpp"
#include "mesh/pulling.hpp"
#include "tests/mesh/whole_cells.hpp"
#include "tests/systems/test_meshes.hpp"

namespace barycert::systems {
namespace {

using At = std::array<double, 3>;
using Corners = std::array<std::size_t, 4>;  ///< some corners of a cell, in any order

/// Makes the sets that do not depend on the cells.
class AnyMaker {
public:
    AnyMaker(const Mesh& mesh, std::uint64_t seed)
        : mesh_(mesh), d_(mesh.corners() - 1), box_(bounds_of_cells(mesh)), random_(seed) {}

    At node() {
        At at{};
        const std::size_t i = random_.below(mesh_.point_count());
        for (std::size_t k = 0; k < d_; ++k) at[k] = mesh_.points[d_ * i + k];
        return at;
    }

    At in_box() {
        At at{};
        for (std::size_t k = 0; k < d_; ++k) {
            const double margin = 0.1 * (box_.high[k] - box_.low[k]);
            at[k] = random_.uniform(box_.low[k] - margin, box_.high[k] + margin);
        }
        return at;
    }

protected:
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    At ulps_from(At at) {
        for (std::size_t k = 0; k < d_; ++k) {
            for (int steps = random_.integer(-3, 3); steps != 0; steps += steps < 0 ? 1 : -1)
                at[k] = std::nextafter(at[k], steps < 0 ? -infinity : infinity);
        }
        return at;
    }
    /// 2^-11 to 2^-50.
    double little() { return std::exp2(random_.uniform(-50, -11)); }
    /// Weights, before they are divided by their sum, that make points uniform over a face.
    double share() { return -std::log(1 - random_.unit()) + 1e-300; }

    const Mesh& mesh_;
    std::size_t d_;
    Bounds3 box_;
    base::Random random_;
};

class Maker : public AnyMaker {
public:
    Maker(const Mesh& mesh, std::uint64_t seed) : AnyMaker(mesh, seed) { find_boundary(); }

    At inside() { return on(d_ + 1); }

    /// A random point of a random face of `corners` corners of a random cell, rounded.
    At on(std::size_t corners) { return on(random_.below(mesh_.cell_count()), shuffled(), corners); }

    At ulps_from_facet() { return ulps_from(on(d_)); }

    /// `by` times the height of the cell beyond one of its facets.
    At beyond_facet(double by) {
        const std::size_t cell = random_.below(mesh_.cell_count());
        return beyond(cell, shuffled(), by);
    }

    /// 2^-11 to 2^-50 times the height of a cell beyond a facet that only this cell has.
    At beyond_boundary() {
        const auto [cell, opposite] = boundary_[random_.below(boundary_.size())];
        Corners corners{0, 1, 2, 3};
        std::swap(corners[opposite], corners[d_]);
        return beyond(cell, corners, little());
    }

    bool has_boundary() const { return !boundary_.empty(); }

private:
    double coordinate(std::size_t cell, std::size_t corner, std::size_t axis) const {
        return mesh_.points[d_ * static_cast<std::size_t>(mesh_.cells[(d_ + 1) * cell + corner]) + axis];
    }

    Corners shuffled() {
        Corners corners{0, 1, 2, 3};
        for (std::size_t i = d_; i > 0; --i) std::swap(corners[i], corners[random_.below(i + 1)]);
        return corners;
    }

    /// On the first `count` of the corners.
    At on(std::size_t cell, const Corners& corners, std::size_t count) {
        std::array<double, 4> weight{};
        double sum = 0;
        for (std::size_t i = 0; i < count; ++i) sum += weight[i] = share();
        At at{};
        for (std::size_t k = 0; k < d_; ++k) {
            for (std::size_t i = 0; i < count; ++i) at[k] += weight[i] / sum * coordinate(cell, corners[i], k);
        }
        return at;
    }

    At beyond(std::size_t cell, const Corners& corners, double by) {
        At at = on(cell, corners, d_);
        for (std::size_t k = 0; k < d_; ++k) at[k] -= by * (coordinate(cell, corners[d_], k) - at[k]);
        return at;
    }

    void find_boundary() {
        struct Facet {
            std::array<Mesh::Index, 3> nodes;
            std::size_t cell, opposite;
        };
        std::vector<Facet> facets;
        for (std::size_t cell = 0; cell < mesh_.cell_count(); ++cell) {
            for (std::size_t opposite = 0; opposite <= d_; ++opposite) {
                Facet facet{{-1, -1, -1}, cell, opposite};
                std::size_t n = 0;
                for (std::size_t i = 0; i <= d_; ++i)
                    if (i != opposite) facet.nodes[n++] = mesh_.cells[(d_ + 1) * cell + i];
                std::sort(facet.nodes.begin(), facet.nodes.end());
                facets.push_back(facet);
            }
        }
        std::sort(facets.begin(), facets.end(), [](const Facet& a, const Facet& b) {
            return a.nodes != b.nodes ? a.nodes < b.nodes : a.cell < b.cell;
        });
        for (std::size_t i = 0; i < facets.size(); ++i) {
            const bool first = i == 0 || facets[i - 1].nodes != facets[i].nodes;
            const bool last = i + 1 == facets.size() || facets[i + 1].nodes != facets[i].nodes;
            if (first && last) boundary_.push_back({facets[i].cell, facets[i].opposite});
        }
    }

    std::vector<std::pair<std::size_t, std::size_t>> boundary_;  ///< cell, corner opposite
};

/// Makes points of solids that are no linear simplices, by the images of places in their reference cells.
class SolidMaker : public AnyMaker {
public:
    SolidMaker(const Mesh& mesh, std::uint64_t seed) : AnyMaker(mesh, seed), cells_(test::whole_cells(mesh)) {
        std::map<Ring, std::pair<Face, int>> faces;
        for (std::size_t cell = 0; cell < cells_.count(); ++cell) {
            for (const Ring& ring : mesh::rings_of(cells_.types[cell])) {
                Ring nodes;
                for (const Mesh::Index corner : ring)
                    nodes.push_back(cells_.of(cell)[static_cast<std::size_t>(corner)]);
                std::sort(nodes.begin(), nodes.end());
                auto& [face, times] = faces[nodes];
                face = {cell, &ring};
                ++times;
            }
        }
        for (const auto& [nodes, face] : faces)
            if (face.second == 1) boundary_.push_back(face.first);
    }

    At inside() {
        const std::size_t cell = random_.below(cells_.count());
        Ring all(test::reference_corners(cells_.types[cell]).size());
        std::iota(all.begin(), all.end(), 0);
        return at(cell, all, 0);
    }
    At on_face() { return beyond_face(0); }
    At on_edge() {
        const auto [cell, ring] = random_face();
        const std::size_t first = random_.below(ring->size());
        return at(cell, {(*ring)[first], (*ring)[(first + 1) % ring->size()]}, 0);
    }
    At ulps_from_face() { return ulps_from(on_face()); }
    At beyond_face(double by) {
        const auto [cell, ring] = random_face();
        return at(cell, *ring, by);
    }
    At beyond_boundary() {
        const auto [cell, ring] = boundary_[random_.below(boundary_.size())];
        return at(cell, *ring, little());
    }

private:
    using Ring = std::vector<Mesh::Index>;  ///< corners of a cell
    struct Face {
        std::size_t cell = 0;
        const Ring* ring = nullptr;
    };

    Face random_face() {
        const std::size_t cell = random_.below(cells_.count());
        const auto& rings = mesh::rings_of(cells_.types[cell]);
        return {cell, &rings[random_.below(rings.size())]};
    }

    /// Between these corners; then `by` times as far on as it is from the middle of the reference cell.
    At at(std::size_t cell, const Ring& between, double by) {
        const std::uint8_t type = cells_.types[cell];
        const auto corners = test::reference_corners(type);
        test::ReferencePlace place{};
        std::vector<double> weights;
        double sum = 0;
        for (std::size_t i = 0; i < between.size(); ++i) sum += weights.emplace_back(share());
        for (std::size_t k = 0; k < 3; ++k) {
            long double middle = 0;
            for (const auto& corner : corners) middle += corner[k] / static_cast<long double>(corners.size());
            for (std::size_t i = 0; i < between.size(); ++i)
                place[k] += weights[i] / sum * corners[static_cast<std::size_t>(between[i])][k];
            place[k] += by * (place[k] - middle);
        }
        return test::at_place<3>(type, cells_.of(cell), place, mesh_.points);
    }

    test::CellArrays cells_;
    std::vector<Face> boundary_;
};

struct Recipe {
    const char *name, *how;
};
constexpr Recipe inside{"inside", "random, in a random cell"};
constexpr Recipe box{"box", "random, in the box of the mesh and 10 % around it"};
constexpr Recipe faces{"faces", "random, on a random face, rounded to double"};
constexpr Recipe edges{"edges", "random, on a random edge, rounded to double"};
constexpr Recipe nodes{"nodes", "a random node"};
constexpr Recipe ulps{"ulps", "on a facet, then up to 3 ulps off along each axis"};

}  // namespace

Points make_points(const Mesh& mesh, std::size_t count, std::uint64_t seed) {
    Points points;
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const auto add = [&](const Recipe& recipe, const std::function<At()>& make) {
        points.sets.push_back({recipe.name, recipe.how, points.coordinates.size() / d, count});
        for (std::size_t i = 0; i < count; ++i) {
            const At at = make();
            points.coordinates.insert(points.coordinates.end(), at.begin(), at.begin() + mesh.dimension);
        }
    };
    if (kind_of(mesh) == CellKind::others) {
        SolidMaker maker(mesh, seed);
        add(inside, [&] { return maker.inside(); });
        add(box, [&] { return maker.in_box(); });
        add(faces, [&] { return maker.on_face(); });
        add(edges, [&] { return maker.on_edge(); });
        add(nodes, [&] { return maker.node(); });
        add(ulps, [&] { return maker.ulps_from_face(); });
        add({"past", "beyond a face by 5e-4 of the way from the middle of its cell"},
            [&] { return maker.beyond_face(5e-4); });
        add({"off", "beyond a boundary face by 2^-11 to 2^-50 of the way from the middle of its cell"},
            [&] { return maker.beyond_boundary(); });
        return points;
    }
    Maker maker(mesh, seed);
    add(inside, [&] { return maker.inside(); });
    add(box, [&] { return maker.in_box(); });
    if (d == 3) add(faces, [&] { return maker.on(3); });
    add(edges, [&] { return maker.on(2); });
    add(nodes, [&] { return maker.node(); });
    add(ulps, [&] { return maker.ulps_from_facet(); });
    add({"beyond", "5e-4 of the height of a cell beyond its facet"}, [&] { return maker.beyond_facet(5e-4); });
    if (maker.has_boundary())
        add({"outside", "2^-11 to 2^-50 of the height of a cell beyond a boundary facet"},
            [&] { return maker.beyond_boundary(); });
    return points;
}

}  // namespace barycert::systems
