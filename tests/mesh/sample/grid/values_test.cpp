// Any number of fields and components, any values.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/limits.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/sample/grid/compare.hpp"
#include "tests/mesh/sample/points/rows.hpp"

namespace barycert::testing {
namespace {

/// Over the whole mesh, and around a node of it.
std::vector<Grid> some_grids(const Mesh& mesh) {
    const Bounds3 box = bounds_of_cells(mesh);
    const int d = mesh.dimension;
    std::array<double, 3> low{}, high{};
    const std::vector<double> node = node_at(mesh, mesh.cells[5]);
    for (std::size_t k = 0; k < static_cast<std::size_t>(d); ++k) {
        low[k] = node[k] - 0.05 * (box.high[k] - box.low[k]);
        high[k] = node[k] + 0.05 * (box.high[k] - box.low[k]);
    }
    return {over(d, {31, 13, d == 3 ? 10 : 1}, box.low, box.high), over(d, {21, 11, d == 3 ? 5 : 1}, low, high)};
}

TEST(ResampleValues, AnyNumberOfComponents) {
    for (const char* stem : {"lattice-eighths", "cube-hole-o2", "plate"}) {
        base::Random random(base::hash64(stem));
        Mesh mesh = own_mesh(stem);
        for (const std::vector<int>& of_nodes :
             {std::vector<int>{1}, {2}, {3}, {4}, {5}, {6}, {9}, {1, 1}, {3, 1, 5}, {9, 4, 2, 1}, {17}, {}}) {
            for (const std::vector<int>& of_cells : {std::vector<int>{}, {1}, {2, 9}}) {
                mesh.point_fields = random_fields(mesh.point_count(), of_nodes, random.coin(), random);
                mesh.cell_fields = random_fields(mesh.cell_count(), of_cells, random.coin(), random);
                const auto grids = some_grids(mesh);
                const std::string what = stem + std::string(", ") + std::to_string(of_nodes.size()) + " fields";
                const SampleCounts counts = expect_law(mesh, grids[random.below(2)], what);
                EXPECT_EQ(counts.values.cases(), of_nodes.empty() ? 0 : counts.locations.inside()) << what;
            }
        }
    }
}

/// The field whose every node has value(i), and one of 3 components with it in the middle.
void expect_law_for(Mesh mesh, const std::string& what, const std::function<double(std::size_t)>& value) {
    base::Random random(1);
    mesh.cell_fields.clear();
    for (const int components : {1, 3}) {
        mesh.point_fields = random_fields(mesh.point_count(), {components}, false, random);
        for (std::size_t i = 0; i < mesh.point_count(); ++i)
            mesh.point_fields[0].data[static_cast<std::size_t>(components) * i + (components == 3 ? 1 : 0)] = value(i);
        std::uint64_t interior = 0;
        for (const Grid& grid : some_grids(mesh)) interior += expect_law(mesh, grid, what).locations.interior;
        EXPECT_GT(interior, 0U) << what;
        expect_truth(mesh,
                     over(mesh.dimension, {4, 3, mesh.dimension == 3 ? 3 : 1}, bounds_of_cells(mesh).low,
                          bounds_of_cells(mesh).high),
                     what);
    }
}

TEST(ResampleValues, AwkwardValues) {
    for (const char* stem : {"lattice-eighths", "cube-hole-o2", "plate", "cube-hole"}) {
        const Mesh mesh = own_mesh(stem);
        const std::string name = stem + std::string(": ");
        base::Random random(base::hash64(stem));
        for (const double x : {0.0, -0.0, 1.0, -0.1, 5e-324, -5e-324, 1e-310, 0x1p-1022, 1e300, 0x1p900, 0x1p901,
                               -1e308, 1.7976931348623157e308})
            expect_law_for(mesh, name + "constant", [&](std::size_t) { return x; });
        for (const double x :
             {5e-324, 1e-310, 1e-300, 0x1p-500, 0x1p-480, 0x1p899, 0x1p900, 1e300, 1.7976931348623157e308})
            expect_law_for(mesh, name + "magnitude " + std::to_string(std::ilogb(x)),
                           [&](std::size_t) { return x * random.uniform(-1, 1); });
        expect_law_for(mesh, name + "both zeros", [&](std::size_t) { return random.coin() ? 0.0 : -0.0; });
        expect_law_for(mesh, name + "1 or -1", [&](std::size_t) { return random.coin() ? 1.0 : -1.0; });
        expect_law_for(mesh, name + "nearly constant",
                       [&](std::size_t) { return 1 + 0x1p-52 * random.integer(-1, 1); });
        expect_law_for(mesh, name + "nearly constant, large",
                       [&](std::size_t) { return 1e16 + 2 * random.integer(-2, 2); });
        expect_law_for(mesh, name + "any exponents", [&](std::size_t) { return random.scaled(-1, 1, -1074, 1023); });
        expect_law_for(mesh, name + "now and then no number", [&](std::size_t i) {
            return i % 7 != 0 ? random.uniform(-1, 1) : i % 3 == 0 ? std::nan("") : i % 2 == 0 ? infinity : -infinity;
        });
        expect_law_for(mesh, name + "no numbers", [&](std::size_t) { return std::nan(""); });
    }
}

// Coordinates as values: sums that are exact, ties, and values that cancel to a zero of whatever sign.
TEST(ResampleValues, LinearFields) {
    for (const char* stem : {"lattice-eighths", "lattice-box", "plate"}) {
        const Mesh mesh = own_mesh(stem);
        const auto d = static_cast<std::size_t>(mesh.dimension);
        const auto x = [&](std::size_t i, std::size_t k) { return mesh.points[d * i + k]; };
        expect_law_for(mesh, "x", [&](std::size_t i) { return x(i, 0); });
        expect_law_for(mesh, "y - x", [&](std::size_t i) { return x(i, 1) - x(i, 0); });
        expect_law_for(mesh, "a tie", [&](std::size_t i) { return 1 + 0x1p-50 * x(i, 0); });
        expect_law_for(mesh, "a tie above 2^53", [&](std::size_t i) { return 0x1p55 + 2 * x(i, 1); });
    }
}

TEST(ResampleValues, Plain) {
    for (const char* stem : {"lattice-eighths", "cube-hole-o2", "plate", "needle-slit"}) {
        base::Random random(base::hash64(stem));
        Mesh mesh = own_mesh(stem);
        for (const bool awkward : {false, true}) {
            mesh.point_fields = random_fields(mesh.point_count(), {1, 6}, awkward, random);
            mesh.cell_fields = random_fields(mesh.cell_count(), {2}, awkward, random);
            for (const NamedGrid& g : awkward_grids(mesh, 500, random)) {
                const SampleCounts counts = expect_law(mesh, g.grid, stem + (", plain, " + g.name),
                                                       {.rounding = Rounding::plain, .outside = {}});
                EXPECT_TRUE(!mesh.mid_nodes.empty() || counts.values.cases() == 0);
            }
        }
    }
}

}  // namespace
}  // namespace barycert::testing
