// Meshes that a Locator refuses, and its use of a certificate that is none for its mesh.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "barycert/locator.hpp"
#include "tests/limits.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/locate/points.hpp"
#include "tests/mesh/locate/ways.hpp"

namespace barycert::testing {
namespace {

const double nan = std::numeric_limits<double>::quiet_NaN();

TEST(LocateErrors, TheFirstPointThatIsNotFiniteIsNamed) {
    for (const int d : {2, 3}) {
        const Mesh mesh = box(d, {2, 2, 2});
        for (const Prove prove : {Prove::never, Prove::when_it_pays, Prove::at_once}) {
            const auto locator = Locator::build(mesh, {.prove = prove});
            for (const auto& [bad, count] : {std::pair(nan, 20), {infinity, 20}, {-infinity, 20}, {nan, 5000}}) {
                std::vector<double> points(static_cast<std::size_t>(count * d), 0.5);
                points[static_cast<std::size_t>(7 * d + 1)] = bad;
                points[static_cast<std::size_t>(13 * d)] = bad;
                std::vector<Mesh::Index> cells(static_cast<std::size_t>(count));
                std::vector<Feature> features(static_cast<std::size_t>(count));
                const Status status = locator->locate(points, cells, features);
                ASSERT_FALSE(status);
                EXPECT_NE(status.error().message().find("coordinate 1 of point 7"), std::string::npos)
                    << status.error().message();
                const auto all = locator->locate_all(points);
                ASSERT_FALSE(all);
                EXPECT_NE(all.error().message().find("point 7"), std::string::npos);
                EXPECT_FALSE(locator->locate(&points[static_cast<std::size_t>(7 * d)]));
                EXPECT_FALSE(locator->locate(&points[static_cast<std::size_t>(7 * d)], 1));
            }
        }
    }
}

TEST(LocateErrors, SizesThatDoNotFit) {
    const Mesh mesh = box(3, {1, 1, 1});
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    std::vector<Mesh::Index> cells(2);
    std::vector<Feature> features(2);
    EXPECT_FALSE(locator->locate(std::vector<double>(5), cells, features));
    EXPECT_FALSE(locator->locate(std::vector<double>(9), cells, features));
    EXPECT_FALSE(locator->locate(std::vector<double>(3), cells, features));
    EXPECT_FALSE(locator->locate(std::vector<double>(6), cells, std::span(features).first(1)));
    EXPECT_FALSE(locator->locate(std::vector<double>(6), std::span(cells).first(1), features));
    EXPECT_FALSE(locator->locate_all(std::vector<double>(4)));
    EXPECT_TRUE(locator->locate(std::vector<double>(6), cells, features));
}

TEST(LocateErrors, InconsistentMeshes) {
    const Mesh good = box(3, {1, 1, 1});
    const auto refused = [&](auto spoil) {
        Mesh mesh = good;
        spoil(mesh);
        const auto locator = Locator::build(mesh, {.prove = Prove::never});
        EXPECT_FALSE(locator.has_value());
        return locator ? std::string() : locator.error().message();
    };
    EXPECT_NE(refused([](Mesh& m) { m.cells[3] = 8; }).find("is not a node"), std::string::npos);
    EXPECT_NE(refused([](Mesh& m) { m.cells[3] = -1; }).find("is not a node"), std::string::npos);
    EXPECT_NE(refused([](Mesh& m) { m.cells.pop_back(); }), "");
    EXPECT_NE(refused([](Mesh& m) { m.points.pop_back(); }), "");
    EXPECT_NE(refused([](Mesh& m) { m.points[5] = nan; }).find("finite"), std::string::npos);
    EXPECT_NE(refused([](Mesh& m) { m.points[5] = infinity; }).find("finite"), std::string::npos);
    EXPECT_NE(refused([](Mesh& m) { m.dimension = 4; }), "");
    EXPECT_NE(refused([](Mesh& m) { m.dimension = 0; }), "");
    EXPECT_NE(refused([](Mesh& m) { m.mid_nodes = {0, 1}; }), "");
    EXPECT_NE(refused([](Mesh& m) { m.point_fields.push_back({"f", 1, {1.0}}); }), "");
}

// Meshes that a check certifies are taken, and those that are refused were not certified.
TEST(LocateErrors, CertifiedMeshesAreTaken) {
    const std::vector<std::pair<const char*, void (*)(Mesh&)>> spoils{
        {"nothing", [](Mesh&) {}},
        {"values that are not finite",
         [](Mesh& m) {
             m.point_fields.push_back({"f", 1, std::vector<double>(m.point_count(), nan)});
         }},
        {"a triangle as face",
         [](Mesh& m) {
             m.faces = {m.cells[0], m.cells[1], m.cells[2]};
         }},
        {"an edge as face",
         [](Mesh& m) {
             m.faces = {m.cells[0], m.cells[1]};
         }},
        {"a face of no node",
         [](Mesh& m) {
             m.faces = {m.cells[0], m.cells[1], -1};
         }},
        {"nodes at mid-edges of no face",
         [](Mesh& m) {
             m.face_mid_nodes = {0, 1, 2};
         }},
        {"markers of no face", [](Mesh& m) { m.face_markers = {1}; }},
        {"too few nodes at mid-edges",
         [](Mesh& m) {
             m.mid_nodes = {0, 1};
         }},
        {"nodes at mid-edges in no order",
         [](Mesh& m) { m.mid_nodes.assign(m.cell_count() * (m.dimension == 2 ? 3 : 6), 0); }},
        {"a node at a mid-edge that is none",
         [](Mesh& m) {
             m.mid_edge_order = MidEdgeOrder::vtk;
             m.mid_nodes.assign(m.cell_count() * (m.dimension == 2 ? 3 : 6), -1);
         }},
        {"too few markers", [](Mesh& m) { m.point_markers = {1}; }},
        {"a short field",
         [](Mesh& m) {
             m.point_fields.push_back({"f", 1, {1.0}});
         }},
        {"a short field of cells",
         [](Mesh& m) {
             m.cell_fields.push_back({"f", 2, {1.0}});
         }},
        {"a field without components",
         [](Mesh& m) {
             m.cell_fields.push_back({"f", 0, {}});
         }},
        {"an index base of its own", [](Mesh& m) { m.index_base = 7; }},
        {"neighbours that are too few", [](Mesh& m) { m.neighbours = {-1}; }},
        {"a corner that is no node", [](Mesh& m) { m.cells[0] = -1; }},
        {"a coordinate that is not finite", [](Mesh& m) { m.points[0] = nan; }},
    };
    int taken = 0;
    for (const int d : {2, 3}) {
        for (const auto& [what, spoil] : spoils) {
            SCOPED_TRACE(std::string(what) + ", dimension " + std::to_string(d));
            Mesh mesh = box(d, {2, 2, 2});
            spoil(mesh);
            const bool certified = quick(mesh).certified();
            const auto locator = Locator::build(mesh);
            EXPECT_EQ(certified, locator.has_value()) << (locator ? "" : locator.error().message());
            taken += certified ? 1 : 0;
        }
    }
    EXPECT_EQ(taken, 9);  // nothing, values that are not finite, what belongs to no face; in space also the triangle
}

// Values of fields are nobody's business here.
TEST(LocateErrors, FieldsMayHoldAnything) {
    Mesh mesh = box(3, {1, 1, 1});
    mesh.point_fields.push_back({"f", 1, std::vector<double>(8, nan)});
    EXPECT_TRUE(Locator::build(mesh, {.prove = Prove::never}));
}

TEST(LocateErrors, AFoldedMeshIsContestedWhereItFolds) {
    for (const int d : {2, 3}) {
        Mesh folded = box(d, {3, 3, 2});
        EXPECT_TRUE(Locator::build(folded)->certified());
        for (int k = 0; k < d; ++k) folded.points[static_cast<std::size_t>(k)] += 1.5;  // a node goes through facets
        const auto other = Locator::build(folded);
        ASSERT_TRUE(other);
        EXPECT_FALSE(other->certified());
        EXPECT_GT(other->contested_cells(), 0U);
        const PointJudge judge(folded);
        base::Random random(1);
        const std::vector<double> points = awkward_points(folded, 40, random);
        for (std::size_t i = 0; i < points.size(); i += static_cast<std::size_t>(d)) {
            const std::vector<Held> all = judge.holders(&points[i]);
            const Held owner = all.empty() ? Held{} : all.front();
            ASSERT_EQ(*other->locate(&points[i]), (Location{owner.cell, owner.feature}));
        }
    }
}

TEST(LocateErrors, MovedLocatorsAnswer) {
    const Mesh mesh = box(3, {2, 1, 1});
    Locator first = Locator::build(mesh, {.prove = Prove::never}).value();
    const std::array<double, 3> p{1.5, 0.5, 0.25};
    const Location before = *first.locate(p.data());
    Locator second = std::move(first);
    EXPECT_EQ(*second.locate(p.data()), before);
    EXPECT_EQ(&second.mesh(), &mesh);
    EXPECT_GT(second.bytes(), 0U);
}

}  // namespace
}  // namespace barycert::testing
