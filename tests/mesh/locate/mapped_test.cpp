// Cells with maps of their own: owners, features and values against Newton's method for every cell, in long double.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "barycert/sampler.hpp"
#include "mesh/pulling.hpp"
#include "tests/mesh/curved_mesh.hpp"
#include "tests/mesh/shaped_mesh.hpp"
#include "tests/mesh/whole_cells.hpp"

namespace barycert::test {
namespace {

using Index = Mesh::Index;
using Real = long double;

/// Reference coordinates of a point and the value there, of shape functions n(x).
struct Inverse {
    std::array<Real, 3> x{};
    Real value = 0;
    bool found = false;
};

template <class Functions>
Inverse invert(std::size_t d, const std::vector<const double*>& nodes, const std::vector<double>& values,
               const double* p, Functions n, std::array<Real, 3> start) {
    Inverse out{start, 0, false};
    for (int step = 0; step < 60; ++step) {
        const auto image = [&](const std::array<Real, 3>& x) {
            const std::vector<Real> f = n(x);
            std::array<Real, 4> sum{};
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                for (std::size_t k = 0; k < d; ++k) sum[k] += f[i] * nodes[i][k];
                sum[3] += f[i] * values[i];
            }
            return sum;
        };
        const auto here = image(out.x);
        std::array<std::array<Real, 4>, 3> a{};
        constexpr Real h = 1e-6L;
        for (std::size_t j = 0; j < d; ++j) {
            auto above = out.x, below = out.x;
            above[j] += h;
            below[j] -= h;
            const auto high = image(above), low = image(below);
            for (std::size_t k = 0; k < d; ++k) a[k][j] = (high[k] - low[k]) / (2 * h);
        }
        for (std::size_t k = 0; k < d; ++k) a[k][d] = p[k] - here[k];
        for (std::size_t c = 0; c < d; ++c) {
            std::size_t pivot = c;
            for (std::size_t i = c; i < d; ++i) pivot = std::abs(a[i][c]) > std::abs(a[pivot][c]) ? i : pivot;
            if (a[pivot][c] == 0) return out;
            std::swap(a[pivot], a[c]);
            for (std::size_t i = 0; i < d; ++i) {
                if (i == c) continue;
                const Real f = a[i][c] / a[c][c];
                for (std::size_t j = c; j <= d; ++j) a[i][j] -= f * a[c][j];
            }
        }
        Real moved = 0;
        for (std::size_t k = 0; k < d; ++k) {
            const Real by = std::clamp<Real>(a[k][d] / a[k][k], -0.5L, 0.5L);
            out.x[k] += by;
            moved = std::max(moved, std::abs(by));
        }
        if (moved < 1e-17L) {
            out.found = true;
            out.value = image(out.x)[3];
            return out;
        }
    }
    return out;
}

std::vector<Real> products(const std::array<Real, 3>& x) {
    return shape_functions(12, x);
}

/// n^3 hexahedra, their nodes moved; `lattice`: by whole numbers, of cells of size 16. Numbered at random. Or each of
/// two wedges (13), or of a pyramid (14) on its first side.
Mesh warped_grid(int n, double by, bool lattice, unsigned seed, std::uint8_t type = 12) {
    std::mt19937 random(seed);
    const int side = n + 1;
    std::vector<Index> number(static_cast<std::size_t>(side * side * side));
    std::iota(number.begin(), number.end(), 0);
    std::ranges::shuffle(number, random);
    Mesh mesh;
    mesh.points.resize(3 * number.size());
    Field field{"f", 1, std::vector<double>(number.size())};
    const auto at = [&](int i, int j, int k) { return number[static_cast<std::size_t>(i + side * (j + side * k))]; };
    for (int k = 0; k < side; ++k) {
        for (int j = 0; j < side; ++j) {
            for (int i = 0; i < side; ++i) {
                const auto node = static_cast<std::size_t>(at(i, j, k));
                const std::array<int, 3> place{i, j, k};
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const double own = std::uniform_real_distribution(-by, by)(random);
                    mesh.points[3 * node + axis] =
                        lattice ? 16 * place[axis] + std::round(16 * own) : place[axis] + own;
                }
                field.data[node] = std::uniform_real_distribution(-1.0, 1.0)(random);
            }
        }
    }
    for (int k = 0; k < n; ++k) {
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                const std::vector<Index> own{
                    at(i, j, k),     at(i + 1, j, k),     at(i + 1, j + 1, k),     at(i, j + 1, k),
                    at(i, j, k + 1), at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)};
                if (type == 12) add_shape(mesh, 12, own);
                if (type == 14) add_shape(mesh, 14, {own[0], own[1], own[2], own[3], own[6]});
                if (type != 13) continue;
                // One as the reference cell, one with its first triangle seen from outside.
                add_shape(mesh, 13, {own[0], own[1], own[3], own[4], own[5], own[7]});
                add_shape(mesh, 13, {own[1], own[3], own[2], own[5], own[7], own[6]});
            }
        }
    }
    cut(mesh);
    mesh.point_fields = {field};
    return mesh;
}

std::vector<const double*> nodes_of(const Mesh& mesh, std::size_t shape, std::vector<double>& values) {
    std::vector<const double*> nodes;
    values.clear();
    for (auto i = shape == 0 ? 0 : mesh.shapes.ends[shape - 1]; i < mesh.shapes.ends[shape]; ++i) {
        const auto node = static_cast<std::size_t>(mesh.shapes.nodes[static_cast<std::size_t>(i)]);
        nodes.push_back(&mesh.points[3 * node]);
        values.push_back(mesh.point_fields[0].data[node]);
    }
    return nodes;
}

/// The tie of IsoparametricValues, as the summary counts it, beside a point that is decided.
TEST(MappedCells, V1UndecidedValuesAreCounted) {
    Mesh mesh;
    mesh.dimension = 2;
    constexpr double q = 65537, q2 = q * q;
    mesh.points = {0, 0, 4 * q2, 0, 3 * q2, 3 * q2, 0, 4 * q2};
    mesh.shapes.types = {9};
    mesh.shapes.ends = {4};
    mesh.shapes.nodes = {0, 1, 2, 3};
    mesh.point_fields = {{"f", 1, {1, 1 + (q + 3) * 0x1p-53, 1 - (2 * q - 3) * 0x1p-53, 1}}};
    cut(mesh);
    const std::vector<double> points{4 * q - 1, 4 * q - 1, 0, 0, 5 * q2, 5 * q2};
    const Table rows = Sampler::build(mesh, {}, {.interpolation = CellInterpolation::multilinear, .progress = {}})
                           .value()
                           .sample(points)
                           .value();
    EXPECT_EQ(rows.counts.undecided, 1U);
    EXPECT_EQ(rows.counts.unmapped, 0U);
    EXPECT_EQ(rows.counts.max_off, 0x1p-52);
    EXPECT_EQ(rows.values[1], 1);
}

TEST(MappedCells, L1V1CellsWithCurvedSides) {
    std::mt19937 random(4);
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const std::uint8_t type = seed <= 3 ? 12 : seed == 4 ? 13 : 14;
        const Mesh mesh = warped_grid(4, type == 12 ? 0.2 : 0.15, false, seed, type);
        const Sampler sampler =
            Sampler::build(mesh, {}, {.interpolation = CellInterpolation::multilinear, .progress = {}}).value();
        EXPECT_EQ(sampler.locator().unmapped_cells(), 0U);
        std::vector<double> points;
        for (int i = 0; i < 3 * (type == 12 ? 1500 : 900); ++i)
            points.push_back(std::uniform_real_distribution(-0.2, 4.2)(random));
        const Table rows = sampler.sample(points).value();
        const Table linear = Sampler::build(mesh).value().sample(points).value();
        EXPECT_EQ(rows.counts.undecided + rows.counts.unmapped, 0U);
        std::size_t inside = 0, moved = 0;
        for (std::size_t i = 0; i < rows.row_count(); ++i) {
            Index owner = -1;
            Real value = 0;
            bool near = false;
            for (std::size_t cell = 0; cell < mesh.shapes.count() && owner < 0; ++cell) {
                std::vector<double> values;
                const auto nodes = nodes_of(mesh, cell, values);
                const auto functions = [&](const std::array<Real, 3>& at) { return shape_functions(type, at); };
                const Inverse x = invert(3, nodes, values, &points[3 * i], functions, {0.4, 0.4, 0.4});
                if (!x.found) continue;
                const Real last = type == 13 ? x.x[0] + x.x[1] : 0.5L;
                const auto [low, high] = std::minmax({x.x[0], x.x[1], x.x[2], last});
                near |= std::abs(low) < 1e-12L || std::abs(high - 1) < 1e-12L;
                if (low >= 0 && high <= 1) {
                    owner = static_cast<Index>(cell);
                    value = x.value;
                }
            }
            if (near) continue;
            const Index own = mesh.cell_number(rows.cells[i]);
            ASSERT_EQ(own, owner) << i;
            ASSERT_EQ(sampler.locator().locate(&points[3 * i]).value().cell, rows.cells[i]);
            const std::span<const double> point(&points[3 * i], 3);
            ASSERT_EQ(sampler.locator().locate_all(point).value().cells, std::vector<Index>{rows.cells[i]});
            if (owner < 0) continue;
            ++inside;
            moved += mesh.cell_number(linear.cells[i]) != owner ? 1 : 0;
            ASSERT_NEAR(rows.values[i], static_cast<double>(value), 1e-15);
            ASSERT_EQ(rows.features[i], Feature::interior);
        }
        EXPECT_GT(inside, type == 12 ? 1000U : type == 13 ? 600U : 150U);
        EXPECT_GT(moved, type == 14 ? 0U : 10U);  // others than those of the parts
    }
}

// Single cells of each type, as VTK numbers them and mirrored, their sides warped.
TEST(MappedCells, L1V1CellsOfAllTypes) {
    std::mt19937 random(8);
    const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    for (std::uint8_t type = 11; type <= 14; ++type) {
        std::array<std::size_t, 2> inside{}, outside{};  // not as in parts
        for (int round = 0; round < 200; ++round) {
            const bool mirrored = round % 2 == 1;
            Mesh mesh;
            std::vector<Index> nodes;
            mesh.point_fields = {{"f", 1, {}}};
            for (const auto& place : reference_corners(type)) {
                nodes.push_back(static_cast<Index>(nodes.size()));
                for (const Real x : place) mesh.points.push_back(static_cast<double>(x) + uniform(-0.15, 0.15));
                if (mirrored) mesh.points.back() = -mesh.points.back();
                mesh.point_fields[0].data.push_back(uniform(-1, 1));
            }
            add_shape(mesh, type, nodes);
            cut(mesh);
            const Sampler sampler =
                Sampler::build(mesh, {}, {.interpolation = CellInterpolation::multilinear, .progress = {}}).value();
            if (sampler.locator().unmapped_cells() != 0) continue;
            std::vector<double> points, values;
            for (int i = 0; i < 40; ++i) {
                points.insert(points.end(), {uniform(-0.2, 1.2), uniform(-0.2, 1.2), uniform(-0.2, 1.2)});
                if (mirrored) points.back() = -points.back();
            }
            const Table rows = sampler.sample(points).value(),
                        parts = Sampler::build(mesh).value().sample(points).value();
            const auto corners = nodes_of(mesh, 0, values);
            const auto functions = [&](const std::array<Real, 3>& x) { return shape_functions(type, x); };
            for (std::size_t i = 0; i < rows.row_count(); ++i) {
                const Inverse x = invert(3, corners, values, &points[3 * i], functions, {0.4, 0.4, 0.4});
                if (!x.found) continue;
                const Real across = type == 13 ? x.x[0] + x.x[1] : std::max(x.x[0], x.x[1]);
                const Real room = std::min({x.x[0], x.x[1], x.x[2], 1 - across, 1 - x.x[2]});
                if (std::abs(room) < 1e-12L) continue;
                ASSERT_EQ(rows.cells[i] >= 0, room > 0) << int{type} << ' ' << round << ' ' << i;
                ASSERT_EQ(sampler.locator().locate(&points[3 * i])->cell >= 0, room > 0);
                inside[room > 0 && parts.cells[i] < 0 ? 1 : 0] += room > 0 ? 1 : 0;
                outside[room < 0 && parts.cells[i] >= 0 ? 1 : 0] += room < 0 ? 1 : 0;
                if (room > 0) {
                    ASSERT_NEAR(rows.values[i], static_cast<double>(x.value), 1e-14);
                }
            }
        }
        for (const auto& count : {inside, outside}) {
            EXPECT_GT(count[0], 500U) << int{type};
            EXPECT_GT(count[1], 10U) << int{type};
        }
    }
}

// By differences of the function of the owner, in long double; a point on a side is any's of its cells.
TEST(MappedCells, G1GradientsAreThoseOfTheOwner) {
    std::mt19937 random(6);
    const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    for (std::uint8_t type = 12; type <= 14; ++type) {
        const Mesh mesh = warped_grid(2, 0.15, false, type, type);
        const Sampler sampler =
            Sampler::build(mesh, {"f", "grad(f)"}, {.interpolation = CellInterpolation::multilinear}).value();
        EXPECT_EQ(sampler.columns(), (std::vector<std::string>{"f", "grad(f).0", "grad(f).1", "grad(f).2"}));
        std::vector<double> points;
        for (int i = 0; i < 600; ++i) points.push_back(uniform(0, 2));
        const Table rows = sampler.sample(points).value();
        std::size_t inside = 0;
        for (std::size_t i = 0; i < rows.row_count(); ++i) {
            const Index owner = mesh.cell_number(rows.cells[i]);
            if (owner < 0) continue;
            ++inside;
            std::vector<double> values;
            const auto nodes = nodes_of(mesh, static_cast<std::size_t>(owner), values);
            const auto functions = [&](const std::array<Real, 3>& at) { return shape_functions(type, at); };
            for (std::size_t k = 0; k < 3; ++k) {
                std::array<double, 3> low{points[3 * i], points[3 * i + 1], points[3 * i + 2]}, high = low;
                constexpr double h = 0x1p-15;
                low[k] -= h;
                high[k] += h;
                const Real to = invert(3, nodes, values, high.data(), functions, {0.4, 0.4, 0.4}).value;
                const Real from = invert(3, nodes, values, low.data(), functions, {0.4, 0.4, 0.4}).value;
                const auto by = static_cast<double>((to - from) / (static_cast<Real>(high[k]) - low[k]));
                ASSERT_NEAR(rows.values[4 * i + 1 + k], by, 1e-6 * (1 + std::abs(by))) << int{type} << ' ' << i;
            }
        }
        EXPECT_GT(inside, type == 14 ? 20U : 100U);
    }
}

// An affine function has the same gradient everywhere: in cells with maps and without, and beyond them.
TEST(MappedCells, G1GradientsOfAffineFunctionsInsideAndOutside) {
    for (const bool curved : {false, true}) {
        Mesh mesh = curved ? barycert::testing::curved_ball(3) : warped_grid(2, 0.15, false, 3);
        mesh.point_fields = {{"f", 1, std::vector<double>(mesh.point_count())}};
        Field& field = mesh.point_fields.front();
        for (std::size_t node = 0; node < mesh.point_count(); ++node) {
            // Of few bits, so that the values are exact.
            for (std::size_t k = 0; k < 3; ++k)
                mesh.points[3 * node + k] = std::round(0x1p12 * mesh.points[3 * node + k]) * 0x1p-12;
            field.data[node] = 3 * mesh.points[3 * node] - 2 * mesh.points[3 * node + 2] + 7;
        }
        const Sampler sampler =
            Sampler::build(mesh, {"grad(f)", "grad(f).x"}, {.interpolation = CellInterpolation::multilinear}).value();
        std::mt19937 random(2);
        std::vector<double> points;
        for (int i = 0; i < 300; ++i)
            points.push_back(std::uniform_real_distribution(curved ? -1.2 : -0.5, curved ? 1.2 : 2.5)(random));
        for (const Outside outside : {Outside::nan, Outside::nearest, Outside::extrapolate}) {
            const Table rows = sampler.sample(points, {.outside = {outside}}).value();
            std::size_t inside = 0;
            for (std::size_t i = 0; i < rows.row_count(); ++i) {
                if (outside == Outside::nan && rows.cells[i] < 0) continue;
                ++inside;
                const std::vector<double> row(rows.values.begin() + static_cast<std::ptrdiff_t>(4 * i),
                                              rows.values.begin() + static_cast<std::ptrdiff_t>(4 * i + 4));
                ASSERT_EQ(row, (std::vector<double>{3, 0, -2, 3})) << i;
            }
            EXPECT_GT(inside, 20U);
        }
    }
}

// Hexahedra that no cut into tetrahedra fits, but whose maps are injective: nowhere as linear cells, told; as
// multilinear ones where their maps have them.
TEST(MappedCells, L1V1CellsWithoutParts) {
    std::mt19937 random(4);
    std::size_t without = 0;
    std::map<Feature, std::size_t> seen;
    for (int round = 0; round < 6000; ++round) {
        Mesh mesh;
        std::vector<Index> nodes{0, 1, 2, 3, 4, 5, 6, 7};
        std::ranges::shuffle(nodes, random);
        mesh.points.resize(24);
        const auto places = places_of(12);
        for (std::size_t i = 0; i < 8; ++i) {
            for (std::size_t k = 0; k < 3; ++k)
                mesh.points[3 * static_cast<std::size_t>(nodes[i]) + k] =
                    places[i][k] * 4 + static_cast<int>(random() % 17) - 8;
        }
        add_shape(mesh, 12, nodes);
        mesh.point_fields = {{"f", 1, {0, 1, -1, 2, 3, 0.5, -2, 1}}};
        cut(mesh);
        if (mesh::uncut_parts(mesh).empty()) continue;
        EXPECT_EQ(mesh.cell_count(), 1U);
        EXPECT_NE(mesh::told_uncut(mesh).find("multilinear cells"), std::string::npos);
        const Sampler sampler =
            Sampler::build(mesh, {}, {.interpolation = CellInterpolation::multilinear, .progress = {}}).value();
        if (sampler.locator().unmapped_cells() != 0) continue;
        ++without;
        std::vector<double> points, values;
        for (int i = 0; i < 3 * 200; ++i) points.push_back(std::uniform_real_distribution(-8.0, 32.0)(random));
        const Table rows = sampler.sample(points).value(), linear = Sampler::build(mesh).value().sample(points).value();
        const auto corners = nodes_of(mesh, 0, values);
        for (std::size_t i = 0; i < rows.row_count(); ++i) {
            ASSERT_EQ(linear.cells[i], -1);
            const Inverse x = invert(3, corners, values, &points[3 * i], products, {0.5, 0.5, 0.5});
            if (!x.found) continue;
            const Real room = std::min(std::ranges::min(x.x), 1 - std::ranges::max(x.x));
            if (std::abs(room) < 1e-12L) continue;
            ASSERT_EQ(rows.features[i], room > 0 ? Feature::interior : Feature::outside) << round << ' ' << i;
            ASSERT_EQ(sampler.locator().locate(&points[3 * i])->feature, rows.features[i]);
            ++seen[rows.features[i]];
            if (room > 0) {
                ASSERT_NEAR(rows.values[i], static_cast<double>(x.value), 1e-13);
            }
        }
        // Exactly on sides, edges and corners.
        for (int i = 0; i < 100; ++i) {
            std::array<Real, 3> x{};
            for (Real& own : x) own = static_cast<Real>(random() % 5) / 4;
            const std::vector<Real> n = products(x);
            std::array<double, 3> p{};
            for (std::size_t k = 0; k < 3; ++k) {
                Real sum = 0;
                for (std::size_t j = 0; j < 8; ++j) sum += n[j] * corners[j][k];
                p[k] = static_cast<double>(sum);
            }
            const auto on = std::ranges::count_if(x, [](Real own) { return own == 0 || own == 1; });
            const Feature feature = std::array{Feature::interior, Feature::face, Feature::edge,
                                               Feature::vertex}[static_cast<std::size_t>(on)];
            ASSERT_EQ(sampler.locator().locate(p.data())->feature, feature);
            ++seen[feature];
        }
    }
    EXPECT_GT(without, 30U);
    EXPECT_EQ(seen.size(), 5U);
    EXPECT_GT(seen[Feature::interior], 1000U);
}

// Exactly on sides and edges: fractions of few bits between nodes on a lattice.
TEST(MappedCells, L1L2PointsOnCurvedSides) {
    const Mesh mesh = warped_grid(3, 0.12, true, 9);
    const Locator locator =
        Locator::build(mesh, {.interpolation = CellInterpolation::multilinear, .progress = {}}).value();
    ASSERT_EQ(locator.unmapped_cells(), 0U);
    std::mt19937 random(5);
    std::map<Feature, int> seen;
    for (int i = 0; i < 6000; ++i) {
        const std::size_t cell = random() % mesh.shapes.count();
        std::array<double, 3> x{};
        for (double& own : x) own = static_cast<double>(random() % 5) / 4;
        std::vector<double> values;
        const auto nodes = nodes_of(mesh, cell, values);
        const std::vector<Real> n = products({x[0], x[1], x[2]});
        std::array<double, 3> p{};
        for (std::size_t k = 0; k < 3; ++k) {
            Real sum = 0;
            for (std::size_t j = 0; j < 8; ++j) sum += n[j] * nodes[j][k];
            p[k] = static_cast<double>(sum);  // exact
        }
        const auto on = std::ranges::count_if(x, [](double own) { return own == 0 || own == 1; });
        const Feature feature = on == 0   ? Feature::interior
                                : on == 1 ? Feature::face
                                : on == 2 ? Feature::edge
                                          : Feature::vertex;
        const Table all = locator.locate_all(p).value();
        const Location owner = locator.locate(p.data()).value();
        std::vector<Index> cells;
        for (std::size_t row = 0; row < all.row_count(); ++row) {
            cells.push_back(mesh.cell_number(all.cells[row]));
            ASSERT_EQ(all.features[row], feature) << i;
        }
        ASSERT_TRUE(std::ranges::is_sorted(cells));
        ASSERT_EQ(std::ranges::count(cells, static_cast<Index>(cell)), 1) << i;
        ASSERT_EQ(mesh.cell_number(owner.cell), cells.front());
        ASSERT_EQ(owner.feature, feature);
        if (on == 0) {
            ASSERT_EQ(cells.size(), 1U);
        } else if (on == 1) {
            ASSERT_LE(cells.size(), 2U);
        }
        ++seen[feature];
    }
    EXPECT_EQ(seen.size(), 4U);
}

TEST(MappedCells, WeightsAreTheShapeFunctions) {
    const Mesh mesh = warped_grid(3, 0.15, false, 11);
    const Locator locator =
        Locator::build(mesh, {.interpolation = CellInterpolation::multilinear, .progress = {}}).value();
    std::mt19937 random(6);
    std::vector<double> points;
    for (int i = 0; i < 900; ++i) points.push_back(std::uniform_real_distribution(0.3, 2.7)(random));
    Table rows = locator.locate(points).value();
    rows.points = points;
    const NodeWeights weights = node_weights(locator, rows.view()).value();
    const Table values = Sampler::build(locator, {{&mesh.point_fields[0]}}).value().sample(points).value();
    for (std::size_t i = 0; i < rows.row_count(); ++i) {
        ASSERT_EQ(weights.begin[i + 1] - weights.begin[i], 8U);
        double sum = 0, value = 0;
        for (std::size_t k = weights.begin[i]; k < weights.begin[i + 1]; ++k) {
            sum += weights.weights[k];
            value += weights.weights[k] * mesh.point_fields[0].data[static_cast<std::size_t>(weights.nodes[k])];
        }
        ASSERT_NEAR(sum, 1, 1e-15);
        ASSERT_NEAR(value, values.values[i], 1e-15);
    }
}

Mesh with_field(Mesh mesh) {
    std::mt19937 random(8);
    Field field{"f", 1, {}};
    for (std::size_t i = 0; i < mesh.point_count(); ++i)
        field.data.push_back(std::uniform_real_distribution(-1.0, 1.0)(random));
    mesh.point_fields = {field};
    return mesh;
}

TEST(MappedCells, NodesOfCurvedCellsHaveTheirOwnValues) {
    for (const int d : {2, 3}) {
        for (const double part : {0.0, 0.1, 0.4}) {
            Mesh mesh = with_field(testing::curved_ball(d, part));
            // One node of the boundary is off the middle by rounding alone, to the outside.
            const auto axes = static_cast<std::size_t>(d);
            for (std::size_t k = 0; part != 0 && k < axes; ++k) {
                double& x = mesh.points[axes * static_cast<std::size_t>(mesh.mid_nodes[1]) + k];
                if (x != 0) x = std::copysign(0.5 + 1e-13, x);
            }
            const Sampler sampler = Sampler::build(mesh).value();
            ASSERT_EQ(sampler.locator().unmapped_cells(), 0U) << d << ' ' << part;
            const Table rows = sampler.sample(mesh.points).value();
            for (std::size_t i = 0; i < mesh.point_count(); ++i) {
                ASSERT_GE(rows.cells[i], 0) << "node " << i << ", " << d << "D, " << part;
                ASSERT_EQ(rows.values[i], mesh.point_fields[0].data[i]) << i;
            }
        }
    }
}

// Corners at random: each middle is rounded, and many on the boundary to the outside.
TEST(MappedCells, NodesOffByRoundingAreInCellsThatHaveThem) {
    std::mt19937 random(3);
    for (const int d : {2, 3}) {
        Mesh mesh = testing::straight_ball(d);
        const auto axes = static_cast<std::size_t>(d), mids = mesh::edges_of(d).size();
        mesh.points.resize(axes * (2 * axes + 1));
        for (double& x : mesh.points) x += std::uniform_real_distribution(-0.1, 0.1)(random);
        mesh.mid_nodes.clear();
        mesh = with_field(testing::second_order(std::move(mesh)));
        ASSERT_GT(curved_cells(mesh).rounded_cells, 0U);
        for (const Curved curved : {Curved::isoparametric, Curved::exact}) {
            const Sampler sampler = Sampler::build(mesh, {}, {.curved = curved}).value();
            EXPECT_EQ(sampler.locator().has_curved_cells(), curved == Curved::exact);
            const Table rows = sampler.sample(mesh.points).value();
            for (std::size_t i = 0; i < mesh.point_count(); ++i) {
                // Straight sides leave nodes that were rounded to the outside where they are.
                if (curved == Curved::isoparametric && rows.cells[i] < 0) continue;
                ASSERT_GE(rows.cells[i], 0) << "node " << i << ", " << d << 'D';
                const auto cell = static_cast<std::size_t>(rows.cells[i]);
                const auto node = static_cast<Index>(i);
                const auto corners = mesh.corners_of(cell);
                const auto own = std::span(mesh.mid_nodes).subspan(mids * cell, mids);
                EXPECT_EQ(std::ranges::count(corners, node) + std::ranges::count(own, node), 1) << i;
                if (curved == Curved::exact) {
                    EXPECT_EQ(rows.values[i], mesh.point_fields[0].data[i]) << i;
                }
            }
        }
    }
}

// A node amid a curved edge may lie inside the straight simplex of one of them.
TEST(MappedCells, AllCellsOfACurvedEdgeHoldItsNode) {
    for (const int d : {2, 3}) {
        const auto corners = static_cast<std::size_t>(d) + 1, mids = mesh::edges_of(d).size();
        const Mesh mesh = testing::curved_ball(d, 0.4);
        const Table all = Locator::build(mesh).value().locate_all(mesh.points).value();
        const auto holds = [&](std::size_t cell, Index node) {
            const auto own = static_cast<std::size_t>(node);
            return std::count(all.cells.begin() + static_cast<std::ptrdiff_t>(all.point_begin[own]),
                              all.cells.begin() + static_cast<std::ptrdiff_t>(all.point_begin[own + 1]),
                              static_cast<Index>(cell)) == 1;
        };
        for (std::size_t i = 0; i < mesh.cells.size(); ++i) EXPECT_TRUE(holds(i / corners, mesh.cells[i])) << d << i;
        for (std::size_t i = 0; i < mesh.mid_nodes.size(); ++i)
            EXPECT_TRUE(holds(i / mids, mesh.mid_nodes[i])) << d << "D, cell " << i / mids << ", edge " << i % mids;
    }
}

TEST(MappedCells, L1V1CurvedSimplices) {
    std::mt19937 random(12);
    for (const int d : {2, 3}) {
        const auto axes = static_cast<std::size_t>(d);
        const Mesh mesh = with_field(testing::curved_ball(d, 0.4));
        const Sampler sampler = Sampler::build(mesh).value();
        ASSERT_TRUE(sampler.locator().has_curved_cells());
        std::vector<double> points;
        for (std::size_t i = 0; i < axes * 1500; ++i)
            points.push_back(std::uniform_real_distribution(-1.0, 1.0)(random));
        const Table rows = sampler.sample(points).value();
        const auto edges = mesh::edges_of(d);
        const auto functions = [&](const std::array<Real, 3>& x) {
            std::array<Real, 4> l{1 - x[0] - x[1] - (d == 3 ? x[2] : 0), x[0], x[1], x[2]};
            std::vector<Real> n;
            for (std::size_t c = 0; c <= axes; ++c) n.push_back(l[c] * (2 * l[c] - 1));
            for (const auto& edge : edges) n.push_back(4 * l[edge[0]] * l[edge[1]]);
            return n;
        };
        std::size_t inside = 0, outside_straight = 0;
        const Table straight =
            Locator::build(mesh, {.curved = Curved::straight, .progress = {}}).value().locate(points).value();
        for (std::size_t i = 0; i < rows.row_count(); ++i) {
            Index owner = -1;
            Real value = 0;
            bool near = false;
            for (std::size_t cell = 0; cell < mesh.cell_count() && owner < 0; ++cell) {
                std::vector<const double*> nodes;
                std::vector<double> values;
                const auto add = [&](Index node) {
                    nodes.push_back(&mesh.points[axes * static_cast<std::size_t>(node)]);
                    values.push_back(mesh.point_fields[0].data[static_cast<std::size_t>(node)]);
                };
                for (std::size_t c = 0; c <= axes; ++c) add(mesh.cells[(axes + 1) * cell + c]);
                for (std::size_t e = 0; e < edges.size(); ++e) add(mesh.mid_nodes[edges.size() * cell + e]);
                const Inverse x =
                    invert(axes, nodes, values, &points[axes * i], functions, {0.3, 0.3, d == 3 ? 0.3 : 0});
                if (!x.found) continue;
                Real low = 1 - x.x[0] - x.x[1] - (d == 3 ? x.x[2] : 0);
                for (std::size_t k = 0; k < axes; ++k) low = std::min(low, x.x[k]);
                near |= std::abs(low) < 1e-12L;
                if (low >= 0) {
                    owner = static_cast<Index>(cell);
                    value = x.value;
                }
            }
            if (near) continue;
            ASSERT_EQ(rows.cells[i], owner) << d << "D, point " << i;
            if (owner < 0) continue;
            ++inside;
            outside_straight += straight.cells[i] < 0 ? 1 : 0;
            ASSERT_NEAR(rows.values[i], static_cast<double>(value), 1e-15);
        }
        EXPECT_GT(inside, 300U);
        EXPECT_GT(outside_straight, 20U);
    }
}

/// A hexahedron under two wedges: its upper side is z = bend x y, theirs are the planes through its nodes on each side
/// of x = y.
Mesh hexahedron_under_wedges(double bend) {
    Mesh mesh;
    mesh.points = {0, 0, 0,  1, 0, 0,  1, 1, bend, 0, 1, 0, 0, 0, -2, 1, 0, -2,
                   1, 1, -2, 0, 1, -2, 0, 0, 2,    1, 0, 2, 1, 1, 2,  0, 1, 2};
    mesh.shapes.types = {12, 13, 13};
    mesh.shapes.ends = {8, 14, 20};
    mesh.shapes.nodes = {4, 5, 6, 7, 0, 1, 2, 3, 0, 1, 2, 8, 9, 10, 0, 2, 3, 8, 10, 11};
    EXPECT_FALSE(mesh::cut_into_simplices(mesh));
    return mesh;
}

// Their owners are told by hand. All coordinates are fractions of few bits.
TEST(MappedCells, L1WhereSidesOfNeighboursDiffer) {
    std::mt19937 random(7);
    const auto part = [&](unsigned of) { return static_cast<double>(random() % (of + 1)) / of; };
    for (const double bend : {-0.5, 0.5}) {
        const Mesh mesh = hexahedron_under_wedges(bend);
        const Locator locator = Locator::build(mesh, {.interpolation = CellInterpolation::multilinear}).value();
        EXPECT_TRUE(locator.certified());
        const Notes notes = notes_of_maps(locator, CellInterpolation::multilinear, "m");
        ASSERT_EQ(notes.size(), 1U);
        EXPECT_NE(notes[0].text.find("1 side that is not flat has"), std::string::npos);
        EXPECT_NE(notes[0].text.find("first between cells 0 and 1"), std::string::npos);
        std::vector<double> points;
        std::vector<Index> expected;
        std::size_t outside = 0, both = 0;
        for (int i = 0; i < 20000; ++i) {
            const double x = part(64), y = part(64), z = i % 4 == 0 ? 4 * part(64) - 2 : bend * part(64);
            points.insert(points.end(), {x, y, z});
            const bool hexahedron = z <= bend * x * y, wedge = z >= bend * std::min(x, y);
            expected.push_back(hexahedron ? 0 : !wedge ? -1 : y <= x ? 1 : 2);
            outside += !hexahedron && !wedge ? 1 : 0;
            both += hexahedron && wedge && z < bend * x * y ? 1 : 0;
        }
        EXPECT_GT(bend < 0 ? both : outside, 1000U);
        const Table found = locator.locate(points).value();
        for (std::size_t i = 0; i < expected.size(); ++i)
            ASSERT_EQ(mesh.cell_number(found.cells[i]) < 0
                          ? -1
                          : mesh::whole_of_parts(mesh)[static_cast<std::size_t>(found.cells[i])],
                      expected[i])
                << points[3 * i] << ' ' << points[3 * i + 1] << ' ' << points[3 * i + 2];
    }
}

}  // namespace
}  // namespace barycert::test
