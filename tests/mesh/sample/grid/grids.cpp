#include <algorithm>
#include <cmath>

#include "tests/mesh/sample/grid/compare.hpp"

namespace barycert::testing {
namespace {

using Triple = std::array<double, 3>;
using Counts = std::array<std::int64_t, 3>;

class Maker {
public:
    Maker(const Mesh& mesh, std::int64_t points, base::Random& random)
        : mesh_(mesh), random_(random), d_(static_cast<std::size_t>(mesh.dimension)), box_(bounds_of_cells(mesh)) {
        side_ = static_cast<std::int64_t>(std::pow(static_cast<double>(points), 1.0 / static_cast<double>(d_)));
    }

    std::vector<NamedGrid> grids;

    void whole() {
        add("odd", {side_ | 1, (side_ - 2) | 1, (side_ - 4) | 1}, box_.low, box_.high);
        add("even", {side_ & ~1, (side_ + 2) & ~1, (side_ - 2) & ~1}, box_.low, box_.high);
        // Whole and half steps of what is 4 or 8 long.
        add("powers of two", {17, 17, 9}, box_.low, box_.high);
        add("coarse", {2, 3, 2}, box_.low, box_.high);
        add("beyond", {side_, side_, side_}, around(-0.31, 0), around(0.17, 1));
        add("coarse beyond", {4, 3, 5}, around(-2.0, 0), around(3.0, 1));
        add("long rows", {side_ * side_ / 2, 3, d_ == 3 ? 2 : 1}, around(0.01, 0), around(-0.02, 1));
    }
    void single_points() {
        for (std::size_t axis = 0; axis < d_; ++axis) {
            Counts counts{side_, side_, side_};
            counts[axis] = 1;
            add("one along " + std::to_string(axis), counts, box_.low, box_.high);
            Triple low = box_.low, high = box_.high;
            low[axis] = high[axis] = node(any())[axis];  // through a node
            add("one through a node along " + std::to_string(axis), counts, low, high);
        }
        add("one point", {1, 1, 1}, box_.low, box_.high);
        const Triple at = node(any());
        add("one node", {1, 1, 1}, at, at);
    }
    void outside() {
        for (std::size_t axis = 0; axis < d_; ++axis) {
            for (const double by : {-1.5, 1.0 + 0x1p-20}) {
                Triple low = box_.low, high = box_.high;
                const double extent = high[axis] - low[axis];
                low[axis] += by * extent;
                high[axis] += by * extent;
                add("outside", {7, 6, 5}, low, high);
            }
        }
    }
    /// Its ends, and lines and planes through them, are coordinates of nodes.
    void between_nodes() {
        const Triple a = node(any()), b = node(any());
        Triple low{}, high{};
        Counts counts{1, 1, 1};
        for (std::size_t k = 0; k < d_; ++k) {
            low[k] = std::min(a[k], b[k]);
            high[k] = std::max(a[k], b[k]);
            if (low[k] < high[k]) counts[k] = 2 + static_cast<std::int64_t>(random_.below(12));
        }
        add("between nodes", counts, low, high);
    }
    /// Far finer than a cell, around a point of one.
    void fine() {
        const std::size_t cell = random_.below(mesh_.cell_count());
        Triple centre{};
        Triple extent{};
        for (std::size_t k = 0; k < d_; ++k) {
            double low = INFINITY, high = -INFINITY;
            for (std::size_t i = 0; i <= d_; ++i) {
                const double x = node(mesh_.cells[(d_ + 1) * cell + i])[k];
                centre[k] += x / static_cast<double>(d_ + 1);
                low = std::min(low, x);
                high = std::max(high, x);
            }
            extent[k] = high - low;
        }
        for (const double part : {0x1p-20, 0.05, 0.6}) {
            Triple low{}, high{};
            for (std::size_t k = 0; k < d_; ++k) {
                low[k] = centre[k] - part * extent[k];
                high[k] = centre[k] + part * extent[k];
            }
            add("fine", {2 * side_ + 1, side_, side_ / 2}, low, high);
        }
        // Around a node: all its cells.
        const Triple at = node(mesh_.cells[(d_ + 1) * cell]);
        for (const double part : {0x1p-40, 0x1p-10, 0.3}) {
            Triple low{}, high{};
            for (std::size_t k = 0; k < d_; ++k) {
                low[k] = at[k] - part * extent[k];
                high[k] = at[k] + part * extent[k];
            }
            add("around a node", {side_ | 1, side_ | 1, side_ | 1}, low, high);
        }
    }
    /// Next to nothing along one axis.
    void thin() {
        for (std::size_t axis = 0; axis < d_; ++axis) {
            Triple low = box_.low, high = box_.high;
            const double x = node(any())[axis], by = 0x1p-30 * (high[axis] - low[axis]);
            low[axis] = x - by;
            high[axis] = x + by;
            Counts counts{side_ / 2 + 1, side_, side_};
            counts[axis] = 5;
            add("thin along " + std::to_string(axis), counts, low, high);
        }
    }

private:
    Mesh::Index any() { return mesh_.cells[random_.below(mesh_.cells.size())]; }
    Triple node(Mesh::Index i) const {
        Triple at{};
        for (std::size_t k = 0; k < d_; ++k) at[k] = mesh_.points[d_ * static_cast<std::size_t>(i) + k];
        return at;
    }
    Triple around(double by, int end) const {
        Triple at{};
        for (std::size_t k = 0; k < d_; ++k)
            at[k] = (end == 0 ? box_.low[k] : box_.high[k]) + by * (box_.high[k] - box_.low[k]);
        return at;
    }
    /// Grids that cannot be are left out: no double lies between the ends; or among subnormal numbers the rounded
    /// spacing leads beyond the last point.
    void add(const std::string& name, Counts counts, const Triple& low, const Triple& high) {
        for (std::size_t k = 0; k < 3; ++k) counts[k] = k < d_ ? std::max<std::int64_t>(counts[k], 1) : 1;
        const auto grid = grid_over(mesh_.dimension, counts, low, high);
        bool good = grid.has_value();
        for (std::size_t k = 0; good && k < d_; ++k)
            good = counts[k] == 1 || grid->coordinate(k, counts[k] - 2) <= grid->last[k];
        if (good) grids.push_back({name, *grid});
    }

    const Mesh& mesh_;
    base::Random& random_;
    std::size_t d_;
    Bounds3 box_;
    std::int64_t side_ = 1;
};

}  // namespace

std::vector<NamedGrid> awkward_grids(const Mesh& mesh, std::int64_t points, base::Random& random) {
    Maker maker(mesh, points, random);
    maker.whole();
    maker.single_points();
    maker.outside();
    for (int i = 0; i < 3; ++i) maker.between_nodes();
    maker.fine();
    maker.thin();
    return maker.grids;
}

}  // namespace barycert::testing
