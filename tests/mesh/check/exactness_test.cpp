// All that is said to be exact is: signs, volumes, sums, whatever the size of the coordinates.
#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "tests/mesh/check/judge.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/check/random_complexes.hpp"
#include "tests/mesh/check/signs.hpp"

namespace barycert::testing {
namespace {

using Kernel = CGAL::Simple_cartesian<CGAL::Gmpq>;

int cgal_orientation(const Mesh& mesh, std::size_t cell) {
    std::vector<Kernel::Point_2> p;
    std::vector<Kernel::Point_3> q;
    for (std::size_t i = 0; i < mesh.corners(); ++i) {
        const auto at = node_at(mesh, mesh.cells[cell * mesh.corners() + i]);
        if (mesh.dimension == 2) {
            p.emplace_back(CGAL::Gmpq(at[0]), CGAL::Gmpq(at[1]));
        } else {
            q.emplace_back(CGAL::Gmpq(at[0]), CGAL::Gmpq(at[1]), CGAL::Gmpq(at[2]));
        }
    }
    return mesh.dimension == 2 ? static_cast<int>(CGAL::orientation(p[0], p[1], p[2]))
                               : static_cast<int>(CGAL::orientation(q[0], q[1], q[2], q[3]));
}

/// Every sign, volume and sum of a mesh whose cells have different nodes.
void expect_exact(const Mesh& mesh) {
    const CheckReport r = quick(mesh);
    second_path::Q sum(0);
    std::uint64_t wrong = 0;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        const int sign = exact_sign(mesh, c);
        ASSERT_EQ(r.measures.orientation[c], sign);
        ASSERT_EQ(cgal_orientation(mesh, c), sign);
        ASSERT_EQ(std::bit_cast<std::uint64_t>(r.measures.volume[c] + 0.0),
                  std::bit_cast<std::uint64_t>(exact_volume(mesh, c) + 0.0))
            << r.measures.volume[c] << " for " << exact_volume(mesh, c);
        const bool plainly = plain_sign(mesh, c) == sign;
        ASSERT_EQ((r.measures.defects[c] & defect_bit(DefectKind::plain_sign_wrong)) == 0, plainly);
        wrong += plainly ? 0 : 1;
        ASSERT_EQ(std::isinf(r.measures.condition[c]), sign == 0);
        sum += abs(determinant<second_path::Q>(mesh, c));
    }
    const Defect* const f = r.find(DefectKind::plain_sign_wrong);
    ASSERT_EQ(f == nullptr ? 0 : f->count, wrong);
    ASSERT_EQ(r.volume.cells, second_path::nearest(sum / (mesh.dimension == 2 ? 2 : 6)));
}

Mesh cells_of(int d, int count, base::Random& random, double (*coordinate)(base::Random&)) {
    Mesh mesh;
    mesh.dimension = d;
    for (int i = 0; i < count * (d + 1); ++i) {
        mesh.cells.push_back(i);
        for (int k = 0; k < d; ++k) mesh.points.push_back(coordinate(random));
    }
    return mesh;
}

TEST(Exactness, OfCells) {
    double (*const coordinates[])(base::Random&) = {
        [](base::Random& r) { return r.uniform(-1, 1); },
        [](base::Random& r) { return static_cast<double>(r.integer(0, 9)) / 10; },
        [](base::Random& r) { return 1 + std::ldexp(r.integer(0, 3), -52); },
        [](base::Random& r) { return r.scaled(-1, 1, -20, 20); },
        [](base::Random& r) { return r.scaled(-1, 1, -200, 200); },
        [](base::Random& r) { return std::ldexp(r.uniform(-1, 1), 1000); },
        [](base::Random& r) { return std::ldexp(r.uniform(-1, 1), -500); },
        [](base::Random& r) { return std::ldexp(r.integer(-9, 9), -1074); },
        [](base::Random& r) { return r.coin() ? 0.0 : r.uniform(1e300, 1.7e308); },
    };
    for (const int d : {2, 3}) {
        std::uint64_t number = 0;
        for (const auto coordinate : coordinates) {
            SCOPED_TRACE(std::to_string(d) + "D, coordinates " + std::to_string(number));
            base::Random random = base::Random::stream(21, static_cast<std::uint64_t>(d), number++);
            for (int i = 0; i < 10; ++i) expect_exact(cells_of(d, 30, random, coordinate));
        }
    }
}

// Coordinates of 61, 62, 125, 126 bits: where integers of one and two limbs end.
TEST(Exactness, AtTheWidthsOfIntegers) {
    for (const int d : {2, 3}) {
        for (const int bits : {55, 58, 59, 60, 61, 62, 63, 64, 65, 121, 122, 123, 124, 125, 126, 127, 128, 129}) {
            base::Random random =
                base::Random::stream(22, static_cast<std::uint64_t>(d), static_cast<std::uint64_t>(bits));
            Mesh mesh = cells_of(d, 20, random, [](base::Random& r) { return r.coin() ? -1.0 : 1.0; });
            for (double& x : mesh.points) {
                x = std::ldexp(random.coin() ? x : x * (2 - 0x1p-52), bits - 1);
                if (random.below(8) == 0) x = random.coin() ? 1 : -1;
            }
            expect_exact(mesh);
        }
    }
}

/// The same in other units: exactly the same verdict and counts. Stretched, nodes may come near others and edges.
void expect_same_in(const Mesh& mesh, std::array<double, 3> factor) {
    const bool stretched = factor[0] != factor[1] || factor[1] != factor[2];
    const CheckReport r = quick(mesh), s = quick(mapped(mesh, factor, {0, 0, 0}));
    EXPECT_EQ(r.certified(), s.certified());
    const DefectSet doubtful =
        set_of(DefectKind::plain_sign_wrong) |  // plain double may over- or underflow
        (stretched ? set_of(DefectKind::near_nodes, DefectKind::near_hanging, DefectKind::crack) : 0);
    EXPECT_EQ(words(found(r) & ~doubtful), words(found(s) & ~doubtful));
    EXPECT_EQ(r.degenerate, s.degenerate);
    EXPECT_EQ(r.boundary.facets, s.boundary.facets);
    EXPECT_EQ(r.boundary.pieces, s.boundary.pieces);
    EXPECT_EQ(r.volume.equal, s.volume.equal);
    for (const Defect& f : r.defects) {
        const Defect* const g = s.find(f.kind);
        if ((defect_bit(f.kind) & doubtful) == 0) {
            EXPECT_TRUE(g != nullptr && f.count == g->count);
        }
    }
}

TEST(Exactness, ScaledByPowersOfTwo) {
    const std::array<double, 3> factors[] = {{0x1p900, 0x1p900, 0x1p900},    {0x1p-900, 0x1p-900, 0x1p-900},
                                             {0x1p1020, 0x1p1020, 0x1p1020}, {0x1p-1074, 0x1p-1074, 0x1p-1074},
                                             {0x1p1000, 0x1p-1000, 1},       {0x1p-1074, 1, 0x1p1020}};
    std::size_t certified = 0;
    for (const int d : {2, 3}) {
        for (std::uint64_t i = 0; i < 60; ++i) {
            base::Random random = base::Random::stream(23, static_cast<std::uint64_t>(d), i);
            const Mesh mesh = i % 2 == 0 ? damaged_box(d, random) : grown_complex(d, random);
            certified += quick(mesh).certified() ? 1 : 0;
            for (const auto& factor : factors) expect_same_in(mesh, factor);
        }
    }
    EXPECT_GT(certified, 30U);
}

// Not exact any more: what was coplanar may not be, but it is what it is. The judge says so.
TEST(Exactness, ScaledByPowersOfTen) {
    const std::array<double, 3> factors[] = {{1e300, 1e300, 1e300}, {1e-300, 1e-300, 1e-300}, {1e300, 1e-300, 0.1}};
    std::size_t certified = 0;
    for (const int d : {2, 3}) {
        for (std::uint64_t i = 0; i < 24; ++i) {
            base::Random random = base::Random::stream(24, static_cast<std::uint64_t>(d), i);
            const Mesh mesh = mapped(damaged_box(d, random), factors[i % 3], {0, 0, 0});
            EXPECT_EQ(quick(mesh).certified(), judge(mesh).complex);
            certified += quick(mesh).certified() ? 1 : 0;
        }
    }
    EXPECT_GT(certified, 8U);
}

// Two parts beside each other: apart by one ulp, touching, and one within the other by one ulp.
TEST(Exactness, OneUlpDecides) {
    for (const int d : {2, 3}) {
        for (const double at : {1.0, 1e-300, 1e300, 0.1, 3e-310, 123456.789}) {
            const Mesh left = mapped(box(d, {1, 1, 1}), {at, at, at}, {0, 0, 0});
            for (const int side : {-1, 0, 1}) {
                Mesh right = left;
                const double to = side < 0 ? 0 : INFINITY, near = side == 0 ? at : std::nextafter(at, to);
                for (std::size_t i = 0; i < right.points.size(); i += static_cast<std::size_t>(d))
                    right.points[i] = right.points[i] == 0 ? near : 3 * at;
                // Moved sideways, so that nodes do not coincide.
                for (std::size_t i = 1; i < right.points.size(); i += static_cast<std::size_t>(d))
                    right.points[i] += at / 3;
                const CheckReport r = quick(joined(left, right));
                EXPECT_EQ(r.certified(), side > 0) << at;
                EXPECT_EQ(r.find(DefectKind::overlapping_cells) != nullptr, side < 0) << at;
                EXPECT_EQ(r.find(DefectKind::boundary_contact) != nullptr, side <= 0) << at;
            }
        }
    }
}

}  // namespace
}  // namespace barycert::testing
