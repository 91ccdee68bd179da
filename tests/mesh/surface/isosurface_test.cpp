// Iso-surfaces and iso-lines: laws K1 to K4 and D1, each point against rationals.
#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "barycert/environment.hpp"
#include "barycert/surface.hpp"
#include "tests/mesh/check/random_complexes.hpp"
#include "tests/mesh/surface/fields.hpp"
#include "tests/mesh/surface/judge.hpp"

namespace barycert::testing {
namespace {

Result<Cut> cut_of(const Mesh& mesh, const Field& field, double value, const CutOptions& options, int component) {
    return mesh.dimension == 3 ? isosurface(mesh, field, value, options, component)
                               : isoline(mesh, field, value, options, component);
}

/// Cuts and judges; the same on one, two and three threads.
Cut expect_right(const Mesh& mesh, const Field& field, double value, int component, CutOptions options,
                 const Allowed& allowed = {}) {
    options.threads = 1;
    const Result<Cut> cut = cut_of(mesh, field, value, options, component);
    EXPECT_TRUE(cut) << cut.error().message();
    if (!cut) return {};
    expect_cut(mesh, heights_of(mesh, field, value, component), *cut, options, allowed);
    for (const int threads : {2, 3}) {
        options.threads = threads;
        const Result<Cut> again = cut_of(mesh, field, value, options, component);
        EXPECT_TRUE(again);
        if (again) expect_same(cut->surface, again->surface);
    }
    return *cut;
}

TEST(Isosurface, K1K2K3K4OfAnyFieldInAnyBox) {
    std::uint64_t parts = 0, at_nodes = 0, exact = 0;
    for (const int d : {2, 3}) {
        for (std::uint64_t k = 0; k < 400 && !HasFailure(); ++k) {
            base::Random r = base::Random::stream(13, base::hash64("iso"), 2 * k + static_cast<std::uint64_t>(d));
            const Mesh mesh = moved_box(r, d);
            const int kind = static_cast<int>(k % field_kinds), components = r.integer(1, 3);
            const Field field = random_field(r, "f", mesh.point_count(), components, kind);
            const Field carried = random_field(r, "g", mesh.point_count(), 2, r.integer(0, field_kinds - 1));
            const Field of_cells = random_field(r, "c", mesh.cell_count(), 2, field_kinds - 1);
            const int component = r.integer(0, components - 1);
            const double value = level_of(r, field, component);
            SCOPED_TRACE("d " + std::to_string(d) + ", case " + std::to_string(k));
            CutOptions options;
            if (r.coin()) options.point_fields = {&carried, &field};  // numbers out of range need integers
            options.cell_fields = {&of_cells};
            const Cut cut = expect_right(mesh, field, value, component, options);
            parts += cut.surface.cell_count();
            at_nodes += cut.counts.at_nodes;
            exact += cut.counts.tiers.exact;
        }
    }
    // All of it was met.
    EXPECT_GT(parts, 3000U);
    EXPECT_GT(at_nodes, 300U);
    EXPECT_GT(exact, 300U);
}

TEST(Isosurface, OfGrownComplexesAndOfAnything) {
    for (const int d : {2, 3}) {
        for (std::uint64_t k = 0; k < 200 && !HasFailure(); ++k) {
            base::Random r = base::Random::stream(14, base::hash64("iso complexes"), k);
            const int which = static_cast<int>(k % 3);
            const Mesh mesh = which == 0 ? grown_complex(d, r) : which == 1 ? damaged_box(d, r) : random_soup(d, r);
            if (mesh.cell_count() == 0) continue;
            const Field field = random_field(r, "f", mesh.point_count(), 1, r.integer(0, 1));
            SCOPED_TRACE("d " + std::to_string(d) + ", case " + std::to_string(k));
            expect_right(mesh, field, level_of(r, field, 0), 0, {}, {.flat_cells = true, .any_complex = true});
        }
    }
}

TEST(Isosurface, K2OfOwnMeshes) {
    for (const char* const name : {"bracket", "flange", "torus", "cube-hole", "plate", "lattice-box", "needle-slit"}) {
        SCOPED_TRACE(name);
        const Mesh mesh = own_mesh(name);
        Field distance{"r", 1, {}};
        const auto d = static_cast<std::size_t>(mesh.dimension);
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (std::size_t i = 0; i < mesh.point_count(); ++i) {
            const double x = mesh.points[d * i] + 0.3 * mesh.points[d * i + 1];
            distance.data.push_back(x);
            low = std::min(low, x);
            high = std::max(high, x);
        }
        const Cut cut = expect_right(mesh, distance, 0.5 * low + 0.5 * high, 0, {.point_fields = {&distance}});
        EXPECT_GT(cut.surface.cell_count(), 5U);
    }
}

// One cell, every state of its corners: what is where, by hand.
TEST(Isosurface, OneTetrahedronByHand) {
    Mesh mesh;
    mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    mesh.cells = {0, 1, 2, 3};
    const auto cut = [&](std::vector<double> f) {
        const Field field{"f", 1, std::move(f)};
        return isosurface(mesh, field, 0, {}).value().surface;
    };
    const Surface corner = cut({1, -1, -1, -3});
    EXPECT_EQ(corner.points, (std::vector<double>{0.5, 0, 0, 0, 0.5, 0, 0, 0, 0.25}));
    EXPECT_EQ(corner.cells, (std::vector<Mesh::Index>{0, 1, 2}));
    EXPECT_EQ(corner.mesh_edges, (std::vector<Mesh::Index>{0, 1, 0, 2, 0, 3}));
    const Surface away = cut({-1, 1, 1, 3});
    EXPECT_EQ(away.points, corner.points);
    EXPECT_EQ(away.mesh_edges, (std::vector<Mesh::Index>{1, 0, 2, 0, 3, 0}));
    EXPECT_EQ((std::set<Mesh::Index>{away.cells.begin(), away.cells.end()}).size(), 3U);
    EXPECT_EQ(cut({1, 1, -1, -1}).cell_count(), 2U);
    EXPECT_EQ(cut({0, 1, -1, -1}).cell_count(), 1U);
    EXPECT_EQ(cut({0, 0, -1, -1}).cell_count(), 0U) << "an edge has no area";
    EXPECT_EQ(cut({0, -1, -1, -1}).cell_count(), 0U) << "nor has a node";
    const Surface face = cut({0, 0, 0, -1});
    EXPECT_EQ(face.points, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0}));
    EXPECT_EQ(face.cell_count(), 1U) << "a face with the rest outside";
    EXPECT_EQ(cut({0, 0, 0, 1}).cell_count(), 0U) << "a face with the rest in the set";
    EXPECT_EQ(cut({0, 0, 0, 0}).cell_count(), 0U);
    EXPECT_EQ(cut({1, 1, 1, 1}).cell_count(), 0U);
    EXPECT_EQ(cut({-1, -1, -1, -1}).point_count(), 0U);
    // Turned over, the normal stays.
    mesh.cells = {1, 0, 2, 3};
    const Surface turned = cut({1, -1, -1, -3});
    EXPECT_EQ(turned.points, corner.points);
    EXPECT_EQ((std::set<Mesh::Index>{turned.cells.begin(), turned.cells.end()}).size(), 3U);
    const auto first = std::find(turned.cells.begin(), turned.cells.end(), 0);
    EXPECT_EQ(*(first + 1 == turned.cells.end() ? turned.cells.begin() : first + 1), 1);
}

TEST(Isoline, OneTriangleByHand) {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.points = {0, 0, 1, 0, 0, 1};
    mesh.cells = {0, 1, 2};
    const auto cut = [&](std::vector<double> f) {
        const Field field{"f", 1, std::move(f)};
        return isoline(mesh, field, 0, {.point_fields = {&field}}).value().surface;
    };
    const Surface corner = cut({1, -1, -3});
    EXPECT_EQ(corner.points, (std::vector<double>{0.5, 0, 0, 0.25}));
    EXPECT_EQ(corner.cells, (std::vector<Mesh::Index>{0, 1})) << "the set is to the left";
    EXPECT_EQ(corner.point_fields[0].data, (std::vector<double>{0, 0}));
    EXPECT_EQ(cut({-1, 1, 3}).cells, (std::vector<Mesh::Index>{1, 0}));
    EXPECT_EQ(cut({0, 0, -1}).cell_count(), 1U);
    EXPECT_EQ(cut({0, 0, 1}).cell_count(), 0U);
    EXPECT_EQ(cut({0, -1, -1}).cell_count(), 0U);
}

// A face of three nodes on the value with both cells outside is a sheet, and has two sides.
TEST(Isosurface, ASheetHasTwoSides) {
    Mesh mesh;
    mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1};
    mesh.cells = {0, 1, 2, 3, 0, 2, 1, 4};
    const Field field{"f", 1, {2, 2, 2, 1, 0}};
    const Cut cut = expect_right(mesh, field, 2, 0, {});
    EXPECT_EQ(cut.surface.cell_count(), 2U);
    EXPECT_EQ(cut.surface.point_count(), 3U);
    EXPECT_EQ(cut.counts.at_nodes, 3U);
}

// A flat cell between two others: its part closes the gap, turned as they are.
TEST(Isosurface, FlatCellsFitTheirNeighbours) {
    std::uint64_t flat = 0;
    for (std::uint64_t k = 0; k < 300 && !HasFailure(); ++k) {
        base::Random r = base::Random::stream(15, base::hash64("flat cells"), k);
        // Two cells on the square 0 1 2 3, cut by different diagonals: the cell 0 1 2 3 between is flat.
        Mesh mesh;
        mesh.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.5, 1, 0.5, 0.5, -1};
        mesh.cells = {0, 1, 2, 4, 0, 2, 3, 4, 0, 1, 2, 3, 1, 0, 3, 5, 1, 3, 2, 5};
        mesh = renumbered(mesh, r);
        if (r.coin()) flip_some(mesh, r);
        const Field field = random_field(r, "f", 6, 1, static_cast<int>(k % 2));
        const Cut cut = expect_right(mesh, field, level_of(r, field, 0), 0, {}, {.flat_cells = true});
        flat += cut.counts.degenerate;
    }
    EXPECT_GT(flat, 100U);
}

TEST(Isosurface, D1TheSameBitsAndTiersOnEverySimdTarget) {
    base::Random r(21);
    const Mesh mesh = own_mesh("cube-hole");
    const Field f = random_field(r, "f", mesh.point_count(), 1, 1), g = random_field(r, "g", mesh.point_count(), 3, 1);
    const Plane plane{{0.3, -0.5, 0.7}, 0.2};
    const CutOptions options{.point_fields = {&f, &g}, .threads = 1};
    use_simd_target("");
    const Cut iso = isosurface(mesh, f, 0.1, options).value(), section = slice(mesh, plane, options).value();
    EXPECT_GT(iso.surface.cell_count(), 1000U);
    EXPECT_GT(section.surface.cell_count(), 100U);
    for (const std::string& target : simd_targets()) {
        SCOPED_TRACE(target);
        ASSERT_TRUE(use_simd_target(target));
        for (const auto& [cut, expected] : {std::pair(isosurface(mesh, f, 0.1, options).value(), &iso),
                                            {slice(mesh, plane, options).value(), &section}}) {
            expect_same(cut.surface, expected->surface);
            EXPECT_EQ(cut.counts.tiers, expected->counts.tiers);
        }
    }
    use_simd_target("");
}

TEST(Isosurface, WhatDoesNotFitIsRefused) {
    const Mesh mesh = box(3, {1, 1, 1}), flat = box(2, {1, 1, 1});
    const Field f{"f", 2, std::vector<double>(16, 1)}, g{"g", 1, std::vector<double>(4, 1)};
    const auto says = [](const auto& result, const std::string& part) {
        ASSERT_FALSE(result);
        EXPECT_NE(result.error().message().find(part), std::string::npos) << result.error().message();
    };
    says(isosurface(mesh, g, 0), "size of field \"g\"");
    says(isosurface(flat, g, 0), "another dimension");
    says(isoline(mesh, f, 0), "another dimension");
    says(isosurface(mesh, f, 0, {}, 2), "no such component");
    says(isosurface(mesh, f, 0, {}, -1), "no such component");
    says(isosurface(mesh, f, std::nan("")), "expected a finite number");
    says(isosurface(mesh, f, HUGE_VAL), "expected a finite number");
    says(isosurface(mesh, f, 0, {.point_fields = {&g}}), "size of field \"g\"");
    says(isosurface(mesh, f, 0, {.cell_fields = {&g}}), "size of field \"g\"");
    says(isosurface(mesh, f, 0, {.point_fields = {nullptr}}), "a field is missing");
    const Field none{"none", 0, {}};
    says(isosurface(mesh, none, 0), "number of components");
    for (const Mesh::Index bad : {-1, 8}) {
        Mesh broken = mesh;
        broken.cells[3] = bad;
        says(isosurface(broken, f, 0), "a corner of a cell that is no node");
        says(boundary(broken), "a corner of a cell that is no node");
    }
    Mesh broken = mesh;
    broken.points[3] = HUGE_VAL;
    says(isosurface(broken, f, 0), "a coordinate that is not finite");
    broken = mesh;
    broken.cells.pop_back();
    says(isosurface(broken, f, 0), "not whole");
    broken.dimension = 4;
    says(boundary(broken), "neither 2 nor 3");
}

TEST(Isosurface, NothingComesOfNothing) {
    const Field f{"f", 1, {}};
    const Cut cut = isosurface(Mesh(), f, 0).value();
    EXPECT_EQ(cut.surface.point_count() + cut.surface.cell_count(), 0U);
    const Mesh mesh = box(3, {2, 2, 2});
    const Field nan{"nan", 1, std::vector<double>(mesh.point_count(), std::nan(""))};
    const Cut none = isosurface(mesh, nan, 0).value();
    EXPECT_EQ(none.surface.point_count(), 0U);
    EXPECT_EQ(none.counts.not_finite, mesh.cell_count());
}

TEST(Isosurface, SecondOrderCellsAreTold) {
    const Mesh mesh = own_mesh("cube-hole-o2");
    ASSERT_FALSE(mesh.mid_nodes.empty());
    const Field& f = mesh.point_fields.front();
    const Cut cut = isosurface(mesh, f, f.data[0]).value();
    EXPECT_EQ(cut.counts.second_order, mesh.cell_count());
}

}  // namespace
}  // namespace barycert::testing
