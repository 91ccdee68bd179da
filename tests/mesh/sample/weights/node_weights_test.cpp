// Weights of points on nodes: the exact ones, rounded once.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "barycert/oracle.hpp"
#include "barycert/sampler.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/check/random_complexes.hpp"
#include "tests/mesh/locate/points.hpp"
#include "tests/mesh/sample/points/rows.hpp"
#include "tests/mesh/sample/quantity/quantities.hpp"

namespace barycert::testing {
namespace {

/// Row i as a map, after its form has been looked at.
std::map<Mesh::Index, double> row_of(const NodeWeights& w, std::size_t i) {
    std::map<Mesh::Index, double> row;
    for (std::size_t k = w.begin[i]; k < w.begin[i + 1]; ++k) {
        EXPECT_NE(w.weights[k], 0);
        EXPECT_TRUE(k == w.begin[i] || w.nodes[k - 1] < w.nodes[k]);
        row[w.nodes[k]] = w.weights[k];
    }
    return row;
}

/// The weights in a cell, by the oracle.
std::map<Mesh::Index, double> true_row(const Mesh& mesh, Mesh::Index cell, const double* point) {
    std::map<Mesh::Index, double> row;
    const auto c = static_cast<std::size_t>(cell);
    Case question = case_of(mesh, cell, point);
    const std::size_t mids = mesh.mid_nodes.empty() ? 0 : mesh.mid_nodes.size() / mesh.cell_count();
    for (std::size_t i = 0; i < mesh.corners() + mids; ++i) {
        question.values.fill(0);
        std::vector<double> values(mids, 0.0);
        (i < mesh.corners() ? question.values[i] : values[i - mesh.corners()]) = 1;
        const double weight = mids == 0 ? ask_oracle(question).value : oracle_quadratic_value(question, values);
        const Mesh::Index node =
            i < mesh.corners() ? mesh.cells[mesh.corners() * c + i] : mesh.mid_nodes[mids * c + i - mesh.corners()];
        if (weight != 0) row[node] = weight;
    }
    return row;
}

void expect_true_weights(const Mesh& mesh, const std::vector<double>& points, const std::string& what) {
    const auto locator = Locator::build(mesh);
    ASSERT_TRUE(locator) << what;
    const auto d = static_cast<std::size_t>(mesh.dimension);
    Table rows = locator->locate(points).value();
    rows.points = points;
    const Table all = locator->locate_all(points).value();
    for (const Table* table : std::array<const Table*, 2>{&rows, &all}) {
        const auto weights = node_weights(*locator, table->view());
        ASSERT_TRUE(weights) << what << weights.error().message();
        ASSERT_EQ(weights->row_count(), table->cells.size());
        for (std::size_t i = 0; i < table->cells.size() && !::testing::Test::HasFailure(); ++i) {
            const double* const p = &table->points[d * i];
            EXPECT_EQ(row_of(*weights, i),
                      table->cells[i] < 0 ? (std::map<Mesh::Index, double>{}) : true_row(mesh, table->cells[i], p))
                << what << text_of(p, mesh.dimension);
        }
    }
    // Outside: those of the function of the nearest cell, and of the nearest point.
    const auto beyond = node_weights(*locator, rows.view(), {.kind = Outside::extrapolate});
    const auto snapped = node_weights(*locator, rows.view(), {.kind = Outside::nearest});
    const auto limited = node_weights(*locator, rows.view(), {.kind = Outside::nearest, .limit = 0});
    ASSERT_TRUE(beyond && snapped && limited);
    for (std::size_t i = 0; i < rows.cells.size() && !::testing::Test::HasFailure(); ++i) {
        const double* const p = &points[d * i];
        if (rows.cells[i] >= 0) {
            EXPECT_EQ(row_of(*snapped, i), row_of(*beyond, i));
            continue;
        }
        const Nearest near = locator->nearest(p, HUGE_VAL).value();
        if (near.cell < 0) {  // every cell is degenerate
            EXPECT_TRUE(row_of(*beyond, i).empty() && row_of(*snapped, i).empty()) << what;
            continue;
        }
        EXPECT_EQ(row_of(*beyond, i), true_row(mesh, near.cell, p)) << what << text_of(p, mesh.dimension);
        EXPECT_TRUE(near.distance == 0 || limited->begin[i] == limited->begin[i + 1]) << what;
        if (!mesh.mid_nodes.empty()) continue;
        std::map<Mesh::Index, double> expected;
        std::vector<Mesh::Index> nodes;
        for (const Mesh::Index node : near.nodes) {
            if (node >= 0) nodes.push_back(node);
        }
        Case question{.simplex = nodes.size() == 3 ? Simplex::triangle3d : Simplex::segment};
        for (std::size_t k = 0; k < d; ++k) question.point[k] = p[k];
        for (std::size_t n = 0; n < nodes.size(); ++n) {
            for (std::size_t k = 0; k < d; ++k)
                question.vertex(static_cast<int>(n), static_cast<int>(k)) =
                    mesh.points[d * static_cast<std::size_t>(nodes[n]) + k];
        }
        for (std::size_t n = 0; n < nodes.size(); ++n) {
            question.values.fill(0);
            question.values[n] = 1;
            const double weight = nodes.size() == 1 ? 1 : ask_oracle(question).value;
            if (weight != 0) expected[nodes[n]] = weight;
        }
        EXPECT_EQ(row_of(*snapped, i), expected) << what << text_of(p, mesh.dimension);
    }
}

TEST(NodeWeights, OfOwnMeshes) {
    for (const char* stem : {"cube-hole", "cube-hole-o2", "lattice-eighths", "plate"}) {
        base::Random random(base::hash64(stem));
        const Mesh mesh = own_mesh(stem);
        expect_true_weights(mesh, awkward_points(mesh, 3, random), stem);
    }
}

TEST(NodeWeights, OfBadMeshes) {
    for (const int d : {2, 3}) {
        for (std::uint64_t k = 0; k < 60 && !HasFailure(); ++k) {
            base::Random random = base::Random::stream(8, static_cast<std::uint64_t>(d), k);
            Mesh mesh = k % 2 == 0 ? random_soup(d, random) : damaged_box(d, random);
            if (mesh.cells.empty()) continue;
            const double scale = k % 3 == 0 ? 0x1p-1060 : k % 3 == 1 ? 1 : 0x1p1000;
            for (double& x : mesh.points) x *= scale;
            expect_true_weights(mesh, awkward_points(mesh, 1, random), std::to_string(k));
        }
    }
}

// On cells of second order the nearest point's weights are rounded, so the row is that of a point of the cell: it gives
// what the sampler gives.
TEST(NodeWeights, OfSecondOrderAtTheNearestPoint) {
    base::Random random(9);
    const Mesh mesh = own_mesh("cube-hole-o2");
    const auto locator = Locator::build(mesh);
    const std::vector<double> points = awkward_points(mesh, 12, random);
    Table rows = locator->locate(points).value();
    rows.points = points;
    const auto weights = node_weights(*locator, rows.view(), {.kind = Outside::nearest});
    ASSERT_TRUE(weights);
    Mesh unit = mesh;
    std::size_t outside = 0;
    for (std::size_t i = 0; i < rows.cells.size() && outside < 40; ++i) {
        if (rows.cells[i] >= 0) continue;
        ++outside;
        for (const auto& [node, weight] : row_of(*weights, i)) {
            unit.point_fields = {{"u", 1, std::vector<double>(mesh.point_count(), 0.0)}};
            unit.point_fields[0].data[static_cast<std::size_t>(node)] = 1;
            const auto sampler = Sampler::build(*locator, {{&unit.point_fields[0], false}});
            const Table value =
                sampler->sample(std::span(points).subspan(3 * i, 3), {.outside = {.kind = Outside::nearest}}).value();
            EXPECT_EQ(value.values[0], weight) << i << ' ' << node;
        }
    }
    EXPECT_GT(outside, 10U);
}

TEST(NodeWeights, OfWhatCannotBeAreRefused) {
    const Mesh mesh = box(2, {2, 1, 1});
    const auto locator = Locator::build(mesh);
    const std::vector<double> points{0.5, 0.25, 9, 9};
    std::vector<Mesh::Index> cells{0, 99};
    EXPECT_FALSE(node_weights(*locator, {.dimension = 2, .points = points, .cells = cells}));
    cells = {-2, 0};
    EXPECT_FALSE(node_weights(*locator, {.dimension = 2, .points = points, .cells = cells}));
    cells = {0};
    EXPECT_FALSE(node_weights(*locator, {.dimension = 2, .points = points, .cells = cells}));
    cells = {0, -1};
    EXPECT_TRUE(node_weights(*locator, {.dimension = 2, .points = points, .cells = cells}));
    const std::vector<double> nowhere{std::nan(""), 0, 9, HUGE_VAL};
    EXPECT_FALSE(node_weights(*locator, {.dimension = 2, .points = nowhere, .cells = cells}));
    cells = {-1, -1};
    // Nothing is nearest to them: rows without weights.
    const auto none =
        node_weights(*locator, {.dimension = 2, .points = nowhere, .cells = cells}, {.kind = Outside::nearest});
    ASSERT_TRUE(none);
    EXPECT_TRUE(none->weights.empty());
    Mesh flat = mesh;
    flat.cells[0] = flat.cells[1];
    const auto degenerate = Locator::build(flat);
    cells = {0, -1};
    ASSERT_TRUE(degenerate);
    EXPECT_FALSE(node_weights(*degenerate, {.dimension = 2, .points = points, .cells = cells}));
}

}  // namespace
}  // namespace barycert::testing
