// V1, V2 where nodal values are NaN or infinite: a node whose exact weight is zero takes no part, whatever it holds.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/grid.hpp"
#include "barycert/map.hpp"
#include "barycert/sampler.hpp"
#include "tests/core/rational.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/locate/points.hpp"
#include "tests/mesh/sample/points/rows.hpp"
#include "tests/scratch.hpp"

namespace barycert::testing {
namespace {

using testing_rational::nearest;
using testing_rational::Q;

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t edges[6][2]{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};

// The judge: Cramer's rule in rationals, and sums over the nodes whose coefficient is not zero.

Q determinant(const std::vector<std::vector<Q>>& m) {
    if (m.size() == 1) return m[0][0];
    Q sum = 0;
    for (std::size_t j = 0; j < m.size(); ++j) {
        std::vector<std::vector<Q>> rest;
        for (std::size_t i = 1; i < m.size(); ++i) {
            rest.push_back(m[i]);
            rest.back().erase(rest.back().begin() + static_cast<std::ptrdiff_t>(j));
        }
        sum += (j % 2 == 0 ? 1 : -1) * m[0][j] * determinant(rest);
    }
    return sum;
}

/// Node to coefficient of its value at the point, by the function of the cell.
std::map<Mesh::Index, Q> coefficients(const Mesh& mesh, Mesh::Index cell, const double* point) {
    const std::size_t n = mesh.corners(), d = n - 1, c = static_cast<std::size_t>(cell);
    std::vector<std::vector<Q>> rows;  // 1 and the coordinates of each corner
    const auto row = [&](const double* x) {
        std::vector<Q> r{1};
        for (std::size_t k = 0; k < d; ++k) r.emplace_back(x[k]);
        return r;
    };
    for (std::size_t i = 0; i < n; ++i)
        rows.push_back(row(&mesh.points[d * static_cast<std::size_t>(mesh.cells[n * c + i])]));
    const Q whole = determinant(rows);
    std::vector<Q> l;
    for (std::size_t i = 0; i < n; ++i) {
        auto changed = rows;
        changed[i] = row(point);
        l.push_back(determinant(changed) / whole);
    }
    std::map<Mesh::Index, Q> all;
    const bool quadratic = !mesh.mid_nodes.empty();
    const std::size_t mids = d == 2 ? 3 : 6;
    for (std::size_t i = 0; i < n; ++i) all[mesh.cells[n * c + i]] = quadratic ? Q(l[i] * (2 * l[i] - 1)) : l[i];
    for (std::size_t e = 0; quadratic && e < mids; ++e)
        all[mesh.mid_nodes[mids * c + e]] = 4 * l[edges[e][0]] * l[edges[e][1]];
    return all;
}

/// The value of component c, or nothing: a value that takes part is not finite.
std::optional<Q> exact_value(const Mesh& mesh, const Field& field, std::size_t c, Mesh::Index cell,
                             const double* point) {
    Q sum = 0;
    for (const auto& [node, coefficient] : coefficients(mesh, cell, point)) {
        if (coefficient == 0) continue;
        const double f = field.data[static_cast<std::size_t>(field.components) * static_cast<std::size_t>(node) + c];
        if (!std::isfinite(f)) return std::nullopt;
        sum += coefficient * Q(f);
    }
    return sum;
}

void expect_value(const Mesh& mesh, std::size_t c, Mesh::Index cell, const double* point, Rounding rounding,
                  double found, const std::string& what) {
    const std::optional<Q> exact = exact_value(mesh, mesh.point_fields[0], c, cell, point);
    const std::string where = what + text_of(point, mesh.dimension) + " in cell " + std::to_string(cell);
    if (!exact) {
        EXPECT_TRUE(std::isnan(found)) << where << ": " << found;
    } else if (rounding == Rounding::correct) {
        EXPECT_TRUE(nearest(found, *exact)) << where << ": " << found;
    } else {
        EXPECT_NEAR(found, exact->get_d(), 1e-12) << where;
    }
}

void expect_rows(const Mesh& mesh, const std::vector<double>& points, const Table& rows, Rounding rounding,
                 const std::string& what) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    ASSERT_EQ(rows.cells.size(), points.size() / d) << what;
    for (std::size_t i = 0; i < rows.cells.size() && !::testing::Test::HasFailure(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            if (rows.cells[i] >= 0)
                expect_value(mesh, c, rows.cells[i], &points[d * i], rounding, rows.values[3 * i + c], what);
        }
    }
}

// Meshes with coordinates that are small dyadic numbers, a field of three components with holes in each.

void add_mid_nodes(Mesh& mesh) {
    std::map<std::pair<Mesh::Index, Mesh::Index>, Mesh::Index> known;
    const std::size_t n = mesh.corners(), d = n - 1;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        for (std::size_t e = 0; e < (d == 2 ? 3 : 6); ++e) {
            const auto ends = std::minmax(mesh.cells[n * c + edges[e][0]], mesh.cells[n * c + edges[e][1]]);
            const auto [it, added] = known.try_emplace(ends, static_cast<Mesh::Index>(mesh.point_count()));
            mesh.mid_nodes.push_back(it->second);
            for (std::size_t k = 0; added && k < d; ++k)
                mesh.points.push_back((mesh.points[d * static_cast<std::size_t>(ends.first) + k] +
                                       mesh.points[d * static_cast<std::size_t>(ends.second) + k]) /
                                      2);
        }
    }
    mesh.mid_edge_order = MidEdgeOrder::vtk;
}

Mesh holed(int d, bool quadratic, base::Random& random) {
    Mesh mesh = box(d, {3, 2, 2});
    flip_some(mesh, random);
    if (quadratic) add_mid_nodes(mesh);
    mesh.point_fields = random_fields(mesh.point_count(), {3}, false, random);
    static constexpr std::array<double, 3> holes{nan, infinity, -infinity};
    for (double& f : mesh.point_fields[0].data) {
        if (random.below(3) == 0) f = holes[random.below(3)];
    }
    return mesh;
}

/// Nodes, points of edges, faces and cells that lie there exactly, quarters of them: a corner of a quadratic with l =
/// 1/2 has no part.
std::vector<double> exact_points(const Mesh& mesh, base::Random& random) {
    std::vector<double> points = mesh.points;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        for (int more = 0; more < 4; ++more) {
            std::vector<double> quarters(mesh.corners(), 0.0);
            for (int i = 0; i < 4; ++i) quarters[random.below(mesh.corners())] += 0.25;
            const std::vector<double> at = in_cell(mesh, c, quarters);
            points.insert(points.end(), at.begin(), at.end());
        }
    }
    return points;
}

class NotFinite : public ::testing::TestWithParam<std::tuple<int, bool, std::string>> {
protected:
    void SetUp() override { ASSERT_TRUE(use_simd_target(std::get<2>(GetParam()))); }
    void TearDown() override { use_simd_target(""); }
    Mesh mesh(std::uint64_t number) {
        base::Random random = base::Random::stream(33, number, std::get<1>(GetParam()) ? 1 : 0);
        return holed(std::get<0>(GetParam()), std::get<1>(GetParam()), random);
    }
    static constexpr std::array<Rounding, 2> roundings{Rounding::correct, Rounding::plain};
};

TEST_P(NotFinite, V1V2AtPointsFromEveryCell) {
    for (std::uint64_t number = 0; number < 3; ++number) {
        base::Random random(number);
        const Mesh mesh = this->mesh(number);
        const std::vector<double> points = exact_points(mesh, random);
        const auto d = static_cast<std::size_t>(mesh.dimension);
        for (const Prove prove : {Prove::at_once, Prove::never}) {
            const auto locator = Locator::build(mesh, {.prove = prove});
            const auto sampler = Sampler::build(*locator, all_fields(mesh));
            for (const Rounding rounding : roundings) {
                const Table rows = sampler->sample(points, {.rounding = rounding}).value();
                expect_rows(mesh, points, rows, rounding, "lowest ");
                Table all = locator->locate_all(points).value();
                const std::vector<std::size_t> begin = all.point_begin;
                const std::vector<double> repeated = all.points;
                ASSERT_TRUE(sampler->evaluate(repeated, {.rounding = rounding}, all));
                expect_rows(mesh, repeated, all, rounding, "all ");
                std::size_t finite = 0, holes = 0;
                for (std::size_t i = 0; i + 1 < begin.size(); ++i) {
                    for (std::size_t row = begin[i]; row < begin[i + 1]; ++row) {
                        for (std::size_t c = 0; c < 3; ++c) {
                            const double here = all.value(row, c), owner = rows.value(i, c);
                            ++(std::isnan(here) ? holes : finite);
                            if (rounding == Rounding::correct) {
                                EXPECT_TRUE(same(here, owner)) << text_of(&points[d * i], mesh.dimension);
                            } else {
                                EXPECT_EQ(std::isnan(here), std::isnan(owner));
                            }
                        }
                    }
                }
                EXPECT_GT(finite, 100U);
                EXPECT_GT(holes, 100U);
                // Nodes come back as they are, beside whatever nodes.
                for (std::size_t i = 0; i < 3 * mesh.point_count(); ++i) {
                    const double own = mesh.point_fields[0].data[i];
                    if (rows.cells[i / 3] < 0) continue;
                    EXPECT_EQ(std::isfinite(own), std::isfinite(rows.values[i])) << own;
                    if (rounding == Rounding::correct && std::isfinite(own)) {
                        EXPECT_EQ(rows.values[i], own);
                    }
                }
            }
        }
    }
}

TEST_P(NotFinite, V1OnGridsAndFromMaps) {
    const test::Scratch scratch;
    const Mesh mesh = this->mesh(7);
    const auto locator = Locator::build(mesh);
    const auto sampler = Sampler::build(*locator, all_fields(mesh));
    const int d = mesh.dimension;
    const Grid grid = grid_over(d, {13, 9, d == 3 ? 9 : 1}, {0, 0, 0}, {3, 2, 2}).value();
    std::vector<double> points;
    for (std::int64_t k = 0; k < grid.counts[2]; ++k) {
        for (std::int64_t j = 0; j < grid.counts[1]; ++j) {
            for (std::int64_t i = 0; i < grid.counts[0]; ++i) {
                const std::array<std::int64_t, 3> place{i, j, k};
                for (std::size_t axis = 0; axis < static_cast<std::size_t>(d); ++axis)
                    points.push_back(grid.coordinate(axis, place[axis]));
            }
        }
    }
    for (const Rounding rounding : roundings) {
        const Table on_grid = resample(*sampler, grid, {.rounding = rounding}).value();
        expect_rows(mesh, points, on_grid, rounding, "grid ");
        const Table at_points = sampler->sample(points, {.rounding = rounding}).value();
        EXPECT_TRUE(same(on_grid, at_points));
        Table located = locator->locate(points).value();
        located.points = points;
        auto writer = MapWriter::open(scratch.path("map"), mesh, false);
        ASSERT_TRUE(writer && writer->write(located.view()) && writer->commit());
        auto reader = MapReader::open(scratch.path("map"), mesh);
        Table rows;
        ASSERT_EQ(reader->read(points.size(), rows).value(), located.row_count());
        const std::vector<double> read = rows.points;
        ASSERT_TRUE(sampler->evaluate(read, {.rounding = rounding}, rows));
        expect_rows(mesh, points, rows, rounding, "map ");
    }
    // The matrix has no entry where the weight is zero.
    Table located = locator->locate(points).value();
    located.points = points;
    const NodeWeights matrix = node_weights(*locator, located.view()).value();
    for (std::size_t i = 0; i < matrix.row_count(); ++i) {
        double sum = 0;
        for (std::size_t k = matrix.begin[i]; k < matrix.begin[i + 1]; ++k)
            sum += matrix.weights[k] * mesh.point_fields[0].data[3 * static_cast<std::size_t>(matrix.nodes[k])];
        const double* const at = &points[static_cast<std::size_t>(d) * i];
        EXPECT_EQ(exact_value(mesh, mesh.point_fields[0], 0, located.cells[i], at).has_value(), std::isfinite(sum));
    }
}

// Beyond a side of the box by a power of two: the nearest point is exact.
TEST_P(NotFinite, N3AtTheNearestPoint) {
    const Mesh mesh = this->mesh(11);
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const auto locator = Locator::build(mesh);
    const auto sampler = Sampler::build(*locator, all_fields(mesh));
    base::Random random(5);
    std::vector<double> points, nearest_points;
    for (int i = 0; i < 300; ++i) {
        std::array<double, 3> at{}, on{};
        for (std::size_t k = 0; k < d; ++k) {
            const double high = k == 0 ? 3 : 2;
            at[k] = random.integer(-4, static_cast<int>(4 * high) + 4) / 4.0;
            on[k] = std::clamp(at[k], 0.0, high);
        }
        if (at == on) continue;
        points.insert(points.end(), at.begin(), at.begin() + static_cast<std::ptrdiff_t>(d));
        nearest_points.insert(nearest_points.end(), on.begin(), on.begin() + static_cast<std::ptrdiff_t>(d));
    }
    for (const Rounding rounding : roundings) {
        const Table rows =
            sampler->sample(points, {.rounding = rounding, .outside = {.kind = Outside::nearest}}).value();
        const Table there = sampler->sample(nearest_points, {.rounding = rounding}).value();
        std::uint64_t holes = 0;
        for (std::size_t i = 0; i < rows.cells.size(); ++i) {
            bool hole = false;
            for (std::size_t c = 0; c < 3; ++c) {
                const Mesh::Index cell = locator->nearest(&points[d * i], infinity)->cell;
                expect_value(mesh, c, cell, &nearest_points[d * i], rounding, rows.value(i, c), "nearest ");
                EXPECT_EQ(std::isnan(there.value(i, c)), std::isnan(rows.value(i, c)));
                hole = hole || std::isnan(rows.value(i, c));
            }
            holes += hole ? 1 : 0;
        }
        EXPECT_GT(holes, 0U);
        EXPECT_LT(holes, rows.cells.size());
        EXPECT_EQ(rows.counts.values.not_finite, rounding == Rounding::correct ? holes : 0);
        // Beyond the mesh each corner has a part, unless the point is level with the others.
        const Table far =
            sampler->sample(points, {.rounding = rounding, .outside = {.kind = Outside::extrapolate}}).value();
        for (std::size_t i = 0; i < far.cells.size(); ++i) {
            const Mesh::Index cell = locator->nearest(&points[d * i], infinity)->cell;
            for (std::size_t c = 0; c < 3; ++c)
                expect_value(mesh, c, cell, &points[d * i], rounding, far.value(i, c), "extrapolated ");
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Sample, NotFinite,
                         ::testing::Combine(::testing::Values(2, 3), ::testing::Bool(),
                                            ::testing::ValuesIn(simd_targets())),
                         [](const auto& of) {
                             std::string name = std::to_string(std::get<0>(of.param)) + "D_" +
                                                (std::get<1>(of.param) ? "quadratic_" : "linear_") +
                                                std::get<2>(of.param);
                             for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
                             return name;
                         });

// The case that was reported: a node with NaN beside a node with 0.
TEST(SampleNotFinite, V2ANodeBesideNaN) {
    Mesh mesh = box(2, {1, 1, 1});
    mesh.point_fields = {{"T", 1, {0, nan, 2, 3}}};
    const auto locator = Locator::build(mesh);
    const auto sampler = Sampler::build(*locator, all_fields(mesh));
    for (const Rounding rounding : {Rounding::correct, Rounding::plain}) {
        Table all = locator->locate_all(mesh.points).value();
        const std::vector<double> points = all.points;
        ASSERT_TRUE(sampler->evaluate(points, {.rounding = rounding}, all));
        ASSERT_EQ(all.cells.size(), 6U);
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t row = all.point_begin[i]; row < all.point_begin[i + 1]; ++row)
                EXPECT_TRUE(same(all.value(row, 0), mesh.point_fields[0].data[i])) << i << ": " << all.value(row, 0);
        }
    }
}

}  // namespace
}  // namespace barycert::testing
