// Slices: sides of nodes and points against rationals.
#include <gtest/gtest.h>

#include "barycert/surface.hpp"
#include "mesh/surface/parts.hpp"
#include "tests/core/rational.hpp"
#include "tests/mesh/surface/fields.hpp"
#include "tests/mesh/surface/judge.hpp"

namespace barycert::testing {
namespace {

Cut expect_right_slice(const Mesh& mesh, const Plane& plane, CutOptions options, const Allowed& allowed = {}) {
    options.threads = 1;
    const Result<Cut> cut = slice(mesh, plane, options);
    EXPECT_TRUE(cut) << cut.error().message();
    if (!cut) return {};
    expect_cut(mesh, heights_of(mesh, plane), *cut, options, allowed);
    for (const int threads : {2, 3}) {
        options.threads = threads;
        expect_same(cut->surface, slice(mesh, plane, options).value().surface);
    }
    return *cut;
}

/// Through nodes, along faces, or anywhere; of any magnitude.
Plane random_plane(base::Random& r, const Mesh& mesh) {
    const int how = r.integer(0, 4);
    Plane plane;
    for (double& n : plane.normal) n = how == 0 || how == 3 ? r.integer(-2, 2) : r.uniform(-1, 1);
    if (plane.normal == std::array<double, 3>{0, 0, 0}) plane.normal[2] = 1;
    const double* const x = mesh.points.data() + 3 * r.below(mesh.point_count());
    plane = plane_through({x[0], x[1], x[2]}, plane.normal);
    if (how == 1) plane.offset += r.uniform(-1, 1);
    if (how == 2) {  // of any magnitude, as far as the offset stays a double
        const int shift = r.integer(-500, 300);
        for (double& n : plane.normal) n = std::ldexp(n, shift);
        plane.offset = std::ldexp(plane.offset, shift);
    }
    return plane;
}

TEST(Slice, K1K2K3K4OfAnyPlaneInAnyBox) {
    std::uint64_t parts = 0, at_nodes = 0, quick = 0;
    for (std::uint64_t k = 0; k < 400 && !HasFailure(); ++k) {
        base::Random r = base::Random::stream(16, base::hash64("slice"), k);
        const Mesh mesh = moved_box(r, 3);
        const Field f = random_field(r, "f", mesh.point_count(), 2, r.integer(0, field_kinds - 1));
        const Plane plane = random_plane(r, mesh);
        SCOPED_TRACE("case " + std::to_string(k));
        const Cut cut = expect_right_slice(mesh, plane, {.point_fields = {&f}});
        parts += cut.surface.cell_count();
        at_nodes += cut.counts.at_nodes;
        quick += cut.counts.tiers.double_double;
    }
    EXPECT_GT(parts, 2000U);
    EXPECT_GT(at_nodes, 100U);
    EXPECT_GT(quick, 1000U);
}

// Numbers of which floating point makes nothing: planes that graze, coordinates far apart.
TEST(Slice, OfNumbersOfAnyKind) {
    for (std::uint64_t k = 0; k < 200 && !HasFailure(); ++k) {
        base::Random r = base::Random::stream(17, base::hash64("slice, any"), k);
        Mesh mesh = box(3, {2, 1, 1});
        for (double& x : mesh.points) x = field_number(r, static_cast<int>(k % 6));
        Plane plane{{field_number(r, 3), field_number(r, 1), field_number(r, 4)}, field_number(r, 3)};
        if (k % 4 == 1) {  // products that underflow
            for (double& x : mesh.points) x = std::ldexp(r.uniform(-1, 1), -535);
            for (double& n : plane.normal) n = std::ldexp(r.uniform(-1, 1), -537);
        }
        if (k % 4 != 3) {
            const double* const x = mesh.points.data();
            plane = plane_through({x[0], x[1], x[2]}, plane.normal);
            if (!std::isfinite(plane.offset)) continue;
        }
        expect_right_slice(mesh, plane, {}, {.flat_cells = true, .any_complex = true});
    }
}

/// An m up to 2^51 for which x * m is next to the middle between two integers: the denominator of a convergent of the
/// continued fraction of 2 x that has an odd numerator. 0 if there is none.
double near_a_half(const mpq_class& x) {
    mpz_class h[2] = {0, 1}, k[2] = {1, 0}, best = 0;  // the last two convergents
    const mpz_class limit = mpz_class(1) << 51;
    for (mpq_class rest = 2 * x;;) {
        mpz_class whole;
        mpz_fdiv_q(whole.get_mpz_t(), rest.get_num_mpz_t(), rest.get_den_mpz_t());
        for (mpz_class* const c : {h, k}) {
            const mpz_class next = whole * c[1] + c[0];
            c[0] = c[1];
            c[1] = next;
        }
        if (k[1] > limit) break;
        if (mpz_odd_p(h[1].get_mpz_t()) != 0) best = k[1];
        rest -= whole;
        if (rest == 0) break;
        rest = 1 / rest;
    }
    return best.get_d();
}

// Values as near to the middle between two doubles as can be, from heights that are small differences of large terms.
TEST(Slice, K1NearTiesWhereHeightsCancelOut) {
    std::uint64_t exact = 0;
    for (std::uint64_t k = 0; k < 500 && !HasFailure(); ++k) {
        base::Random r = base::Random::stream(20, base::hash64("slice, ties"), k);
        Plane plane{{}, 4};
        for (double& n : plane.normal) n = r.uniform(0.5, 1);
        Mesh mesh;
        for (const double side : {-1, 1}) {
            const double x = r.uniform(0.5, 1), y = r.uniform(0.5, 1), by = std::ldexp(r.uniform(0.5, 1), -30);
            const double z = (4 - plane.normal[0] * x - plane.normal[1] * y) / plane.normal[2] + side * by;
            mesh.points.insert(mesh.points.end(), {x, y, z});
        }
        mesh.points.insert(mesh.points.end(), {0, 0, 9, 1, 0, 9});
        mesh.cells = {0, 1, 2, 3};
        const Heights g = heights_of(mesh, plane);
        ASSERT_EQ(sgn(*g[0]), 1);
        ASSERT_EQ(sgn(*g[1]), -1);
        const double m = near_a_half(*g[0] / (*g[0] - *g[1]));
        const Field f{"f", 1, {1, 1 + m * 0x1p-52, 3, 3}};
        exact += expect_right_slice(mesh, plane, {.point_fields = {&f}}).counts.tiers.exact;
    }
    EXPECT_GE(exact, 400U);
}

/// The area of triangles across the third axis.
double area_of(const Surface& s) {
    double area = 0;
    for (std::size_t t = 0; t < s.cell_count(); ++t) {
        const auto x = [&](std::size_t i, std::size_t k) {
            return s.points[3 * static_cast<std::size_t>(s.cells[3 * t + i]) + k];
        };
        const double twice = (x(1, 0) - x(0, 0)) * (x(2, 1) - x(0, 1)) - (x(1, 1) - x(0, 1)) * (x(2, 0) - x(0, 0));
        EXPECT_GT(twice, 0) << "normals along that of the plane";
        area += twice / 2;
    }
    return area;
}

// A section has what of the mesh ends at the plane, wherever it ends.
TEST(Slice, SectionsWhereTheMeshEnds) {
    Mesh mesh = box(3, {2, 2, 2});
    for (const double at : {0.0, 0.5, 1.0, 2.0})
        EXPECT_EQ(area_of(surface::section(mesh, {{0, 0, 1}, at}, {}).value().surface), 4) << at;
    EXPECT_EQ(surface::section(mesh, {{0, 0, 1}, 2.5}, {}).value().surface.cell_count(), 0);
    // A step: a half is one cube high, cells turned at random.
    std::vector<Mesh::Index> cells;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        double x = 0, z = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            x += mesh.point(mesh.cells[4 * c + i])[0] / 4;
            z += mesh.point(mesh.cells[4 * c + i])[2] / 4;
        }
        if (x > 1 && z > 1) continue;
        cells.insert(cells.end(), &mesh.cells[4 * c], &mesh.cells[4 * c] + 4);
        if (c % 3 == 0) std::swap(cells.end()[-1], cells.end()[-2]);
    }
    mesh.cells = cells;
    const Cut cut = surface::section(mesh, {{0, 0, 1}, 1}, {}).value();
    EXPECT_EQ(area_of(cut.surface), 4);
    EXPECT_EQ(cut.surface.point_count(), 9);
    EXPECT_EQ(cut.counts.at_nodes, 9U);
    EXPECT_TRUE(std::ranges::is_sorted(cut.surface.mesh_cells));
    EXPECT_EQ(area_of(slice(mesh, {{0, 0, 1}, 1}).value().surface), 2);
    EXPECT_EQ(area_of(surface::section(mesh, {{0, 0, 1}, 2}, {}).value().surface), 2);
}

TEST(Slice, ThroughTheLatticeOfTheBox) {
    const Mesh mesh = box(3, {2, 2, 2});
    double expected = 4;
    for (const double at : {0.0, 0.5, 1.0, 1.5, 2.0}) {
        const Cut cut = expect_right_slice(mesh, {{0, 0, 1}, at}, {});
        // Where the plane is the top, nothing of the mesh is beyond it.
        if (at == 2) expected = 0;
        EXPECT_EQ(area_of(cut.surface), expected) << at;
        if (at == 1) {
            EXPECT_EQ(cut.counts.on_edges, 0U);
        }
    }
}

TEST(Slice, TheOffsetOfAPlaneThroughAPointIsRoundedOnce) {
    for (std::uint64_t k = 0; k < 500; ++k) {
        base::Random r = base::Random::stream(18, base::hash64("planes"), k);
        std::array<double, 3> p{}, n{};
        mpq_class exact(0);
        for (std::size_t i = 0; i < 3; ++i) {
            p[i] = field_number(r, static_cast<int>(k % 5));
            n[i] = field_number(r, static_cast<int>(k % 5));
            exact += mpq_class(p[i]) * mpq_class(n[i]);
        }
        EXPECT_TRUE(testing_rational::nearest(plane_through(p, n).offset, exact));
        EXPECT_EQ(plane_through(p, n).normal, n);
    }
}

TEST(Slice, WhatIsNoPlaneIsRefused) {
    const Mesh mesh = box(3, {1, 1, 1});
    for (const Plane& plane : {Plane{{0, 0, 0}, 1}, Plane{{0, std::nan(""), 1}, 1}, Plane{{0, 0, 1}, HUGE_VAL}}) {
        const auto cut = slice(mesh, plane);
        ASSERT_FALSE(cut);
        EXPECT_EQ(cut.error().expected, "four finite numbers, the normal not zero");
    }
    EXPECT_FALSE(slice(box(2, {1, 1, 1}), {{0, 0, 1}, 0}));
}

}  // namespace
}  // namespace barycert::testing
