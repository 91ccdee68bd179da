// Maps of meshes: the cells under the pixels, the errors in the cells.

#include "barycert/audit_pictures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "tests/mesh/curved_mesh.hpp"

namespace barycert {
namespace {

Mesh mesh_named(const std::string& name) {
    return read_tetgen(std::string(BARYCERT_DATA_DIR) + "/meshes/" + name + ".node",
                       {.faces = false, .neighbours = false, .threads = 0})
        .value();
}

MeshSource source_of(std::initializer_list<const char*> names) {
    MeshSource source;
    for (const char* name : names) source.add(name, mesh_named(name));
    return source;
}

Kernel one_kernel(const char* name) {
    return kernels_matching(name).at(0);
}

/// Whether the closed cell holds the point, exactly.
bool holds(const Mesh& mesh, std::size_t cell, const std::array<double, 3>& point) {
    Case c;
    c.simplex = mesh.dimension == 2 ? Simplex::triangle : Simplex::tetrahedron;
    for (int i = 0; i < vertex_count(c.simplex); ++i) {
        for (int axis = 0; axis < mesh.dimension; ++axis)
            c.vertex(i, axis) = mesh.points[static_cast<std::size_t>(
                mesh.cells[cell * mesh.corners() + static_cast<std::size_t>(i)] * mesh.dimension + axis)];
    }
    c.point = point;
    const Region region = ask_oracle(c).region;
    return region == Region::interior || region == Region::boundary;
}

TEST(Maps, PixelsShowTheCellsThatHoldThem) {
    for (const char* name : {"bracket", "plate", "lattice-box", "curved"}) {
        SCOPED_TRACE(name);
        // Kernels answer for straight sides.
        const Mesh mesh = std::string_view(name) == "curved" ? testing::curved_ball(3) : mesh_named(name);
        MeshSource source;
        source.add(name, mesh);
        const auto maps = mesh_maps({one_kernel("triangle.exact"), one_kernel("tetrahedron.exact")}, source, 1);
        ASSERT_EQ(maps.size(), 1U);
        const MeshMap& map = maps.front();
        ASSERT_EQ(map.why_not, "");
        EXPECT_EQ(map.axis < 0, mesh.dimension == 2);
        EXPECT_EQ(std::max(map.width, map.height), MeshMap::longer_side);
        ASSERT_EQ(map.pixels.size(), map.width * map.height);
        EXPECT_TRUE(std::is_sorted(map.cells.begin(), map.cells.end()));
        std::size_t inside = 0;
        for (std::size_t i = 0; i < map.pixels.size(); i += 7) {
            const double s = (static_cast<double>(i % map.width) + 0.5) / static_cast<double>(map.width);
            const double t =
                (static_cast<double>(map.height - 1 - i / map.width) + 0.5) / static_cast<double>(map.height);
            const double across = (1 - s) * map.low[0] + s * map.high[0], up = (1 - t) * map.low[1] + t * map.high[1];
            std::array<double, 3> p{across, up, 0};
            if (map.axis == 0) p = {map.at, across, up};
            if (map.axis == 1) p = {across, map.at, up};
            if (map.axis == 2) p = {across, up, map.at};
            if (map.pixels[i] >= 0) {
                ++inside;
                // These meshes are numbered from 0 in their files, or by their places.
                const auto number = map.cells[static_cast<std::size_t>(map.pixels[i])];
                EXPECT_TRUE(holds(mesh, static_cast<std::size_t>(number), p)) << i;
            } else if (i % 35 == 0) {
                for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) EXPECT_FALSE(holds(mesh, cell, p)) << i;
            }
        }
        // The bracket is made of plates: the plane goes along one.
        EXPECT_GT(3 * inside, map.pixels.size() / 7);
    }
}

/// Off by a thousandth where the first vertex has x above 1/2; else right.
int wrong_on_the_right(const double* v, const double* p, double* w) {
    const int status = one_kernel("tetrahedron.exact").weights(v, p, w);
    if (v[0] > 0.5) w[1] += 1e-3;
    return status;
}

/// Not a number for some cells, declared for others.
int silent_on_the_right(const double* v, const double* p, double* w) {
    const int status = one_kernel("tetrahedron.exact").weights(v, p, w);
    if (v[0] > 0.75) return 1;
    if (v[0] > 0.5) w[2] = std::numeric_limits<double>::quiet_NaN();
    return status;
}

TEST(Maps, ErrorsAreThoseOfTheCells) {
    const Mesh mesh = mesh_named("cube-hole");
    Kernel exact = one_kernel("tetrahedron.exact"), wrong = exact, silent = exact;
    wrong.certifies = silent.certifies = false;
    wrong.name = "tetrahedron.wrong";
    wrong.weights = wrong_on_the_right;
    silent.name = "tetrahedron.silent";
    silent.weights = silent_on_the_right;
    const auto maps = mesh_maps({exact, wrong, silent}, source_of({"cube-hole"}), 1);
    ASSERT_EQ(maps.size(), 1U);
    const MeshMap& map = maps.front();
    ASSERT_EQ(map.kernels.size(), 3U);
    std::size_t right = 0, left = 0;
    for (std::size_t i = 0; i < map.cells.size(); ++i) {
        const auto node = mesh.cells[static_cast<std::size_t>(map.cells[i]) * 4];
        const double x = mesh.points[static_cast<std::size_t>(node) * 3];
        EXPECT_EQ(map.kernels[0].errors[i], 0);
        if (x > 0.5) {
            ++right;
            EXPECT_NEAR(map.kernels[1].errors[i], 1e-3, 1e-4);
            EXPECT_TRUE(std::isinf(map.kernels[2].errors[i]));
        } else {
            ++left;
            EXPECT_EQ(map.kernels[1].errors[i], 0);
            EXPECT_EQ(map.kernels[2].errors[i], 0);
        }
    }
    EXPECT_GT(right, 20U);
    EXPECT_GT(left, 20U);
    EXPECT_EQ(map.kernels[0].wrong, 0U);
    for (const auto& k : map.kernels) EXPECT_EQ(k.cases, 9 * map.cells.size());
    // A weight of zero that is a thousandth is a finding; so is every answer that is none.
    EXPECT_GT(map.kernels[1].wrong, 0U);
    EXPECT_EQ(map.kernels[2].wrong, 9 * right);
}

TEST(Maps, PlainFormulasErrOnFacets) {
    const auto maps = mesh_maps({one_kernel("tetrahedron.signed-volume"), one_kernel("triangle.signed-area")},
                                source_of({"cube-hole", "plate"}), 1);
    ASSERT_EQ(maps.size(), 2U);
    for (const MeshMap& map : maps) {
        ASSERT_EQ(map.kernels.size(), 1U);
        EXPECT_GT(map.kernels[0].wrong, 0U);
        EXPECT_GT(*std::max_element(map.kernels[0].errors.begin(), map.kernels[0].errors.end()), 1e-17);
        EXPECT_LT(*std::max_element(map.kernels[0].errors.begin(), map.kernels[0].errors.end()), 1e-6);
    }
}

TEST(Maps, SameForAnyNumberOfThreads) {
    const std::vector<Kernel> kernels{one_kernel("tetrahedron.cramer"), one_kernel("tetrahedron.kahan")};
    const MeshSource source = source_of({"bracket"});
    const auto one = mesh_maps(kernels, source, 3, 1), many = mesh_maps(kernels, source, 3, 5);
    EXPECT_EQ(one.at(0).pixels, many.at(0).pixels);
    EXPECT_EQ(one.at(0).cells, many.at(0).cells);
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_EQ(one.at(0).kernels[k].errors, many.at(0).kernels[k].errors);
        EXPECT_EQ(one.at(0).kernels[k].wrong, many.at(0).kernels[k].wrong);
    }
    EXPECT_NE(mesh_maps(kernels, source, 4).at(0).kernels[0].errors, one.at(0).kernels[0].errors);
}

TEST(Maps, WhatIsLeftOutIsCounted) {
    const auto all = kernels_matching("*");
    const auto maps = mesh_maps(all, source_of({"bracket", "plate", "bracket", "plate", "bracket"}), 1);
    ASSERT_EQ(maps.size(), MeshMap::max_meshes);
    for (const MeshMap& map : maps) {
        const Simplex simplex = map.dimension == 2 ? Simplex::triangle : Simplex::tetrahedron;
        const auto fit = std::count_if(all.begin(), all.end(),
                                       [&](const Kernel& k) { return k.simplex == simplex && !k.perspective; });
        EXPECT_EQ(map.kernels.size(), MeshMap::max_kernels);
        EXPECT_EQ(map.kernels.size() + map.left_out, static_cast<std::size_t>(fit));
        for (const auto& k : map.kernels) EXPECT_EQ(std::count(k.kernel.begin(), k.kernel.end(), '.'), 1);
    }
    // No more than fit: variants, too.
    const auto few = mesh_maps(kernels_matching("tetrahedron.cramer*"), source_of({"bracket"}), 1);
    EXPECT_EQ(few.at(0).left_out, 0U);
    EXPECT_EQ(few.at(0).kernels.size(), kernels_matching("tetrahedron.cramer*").size());
    EXPECT_TRUE(mesh_maps(kernels_matching("segment.*"), source_of({"bracket"}), 1).empty());
    EXPECT_TRUE(mesh_maps(all, MeshSource(), 1).empty());
}

TEST(Maps, AMeshWithoutAMapSaysWhy) {
    Mesh mesh = mesh_named("bracket");
    mesh.points[5] = std::numeric_limits<double>::infinity();
    MeshSource source;
    source.add("broken", mesh);
    const auto maps = mesh_maps({one_kernel("tetrahedron.cramer")}, source, 1);
    ASSERT_EQ(maps.size(), 1U);
    EXPECT_NE(maps[0].why_not, "");
    EXPECT_TRUE(maps[0].pixels.empty());
    // Flat: no pixel has an owner.
    Mesh flat = mesh_named("bracket");
    for (std::size_t i = 2; i < flat.points.size(); i += 3) flat.points[i] = 0;
    MeshSource flattened;
    flattened.add("flat", flat);
    const auto none = mesh_maps({one_kernel("tetrahedron.cramer")}, flattened, 1);
    ASSERT_EQ(none.size(), 1U);
    EXPECT_EQ(none[0].why_not, "no cell is large enough to be seen");
}

}  // namespace
}  // namespace barycert
