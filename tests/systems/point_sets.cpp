#include "systems/point_sets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "barycert/base/random.hpp"
#include "barycert/grid.hpp"

namespace barycert::systems {
namespace {

using At = std::array<double, 3>;
using Corners = std::array<std::size_t, 4>;  ///< some corners of a cell, in any order

class Maker {
public:
    Maker(const Mesh& mesh, std::uint64_t seed)
        : mesh_(mesh), d_(mesh.corners() - 1), box_(bounds_of_cells(mesh)), random_(seed) {
        find_boundary();
    }

    At inside() { return on(d_ + 1); }

    /// A random point of a random face of `corners` corners of a random cell, rounded.
    At on(std::size_t corners) { return on(random_.below(mesh_.cell_count()), shuffled(), corners); }

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

    At ulps_from_facet() {
        At at = on(d_);
        for (std::size_t k = 0; k < d_; ++k) {
            for (int steps = random_.integer(-3, 3); steps != 0; steps += steps < 0 ? 1 : -1)
                at[k] = std::nextafter(at[k], steps < 0 ? -infinity : infinity);
        }
        return at;
    }

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
        const double by = std::exp2(random_.uniform(-50, -11));
        return beyond(cell, corners, by);
    }

    bool has_boundary() const { return !boundary_.empty(); }

private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();

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
        // Uniform over the face: exponential weights, divided by their sum.
        for (std::size_t i = 0; i < count; ++i) sum += weight[i] = -std::log(1 - random_.unit()) + 1e-300;
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

    const Mesh& mesh_;
    std::size_t d_;
    Bounds3 box_;
    base::Random random_;
    std::vector<std::pair<std::size_t, std::size_t>> boundary_;  ///< cell, corner opposite
};

}  // namespace

Points make_points(const Mesh& mesh, std::size_t count, std::uint64_t seed) {
    Maker maker(mesh, seed);
    Points points;
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const auto add = [&](const char* name, const char* recipe, const std::function<At()>& make) {
        points.sets.push_back({name, recipe, points.coordinates.size() / d, count});
        for (std::size_t i = 0; i < count; ++i) {
            const At at = make();
            points.coordinates.insert(points.coordinates.end(), at.begin(), at.begin() + mesh.dimension);
        }
    };
    add("inside", "random, in a random cell", [&] { return maker.inside(); });
    add("box", "random, in the box of the mesh and 10 % around it", [&] { return maker.in_box(); });
    if (d == 3) add("faces", "random, on a random face, rounded to double", [&] { return maker.on(3); });
    add("edges", "random, on a random edge, rounded to double", [&] { return maker.on(2); });
    add("nodes", "a random node", [&] { return maker.node(); });
    add("ulps", "on a facet, then up to 3 ulps off along each axis", [&] { return maker.ulps_from_facet(); });
    add("beyond", "5e-4 of the height of a cell beyond its facet", [&] { return maker.beyond_facet(5e-4); });
    if (maker.has_boundary())
        add("outside", "2^-11 to 2^-50 of the height of a cell beyond a boundary facet",
            [&] { return maker.beyond_boundary(); });
    return points;
}

}  // namespace barycert::systems
