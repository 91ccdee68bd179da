// The bounds of fill_lanes.cpp: points within some ulps of faces of ever flatter cells, against the oracle.
//
// Cells are (x, y, z) -> (x, y, a x + b y + h z) of lattice cells, so that many points of a lattice grid lie exactly in
// their faces; then nodes move by some ulps, and so the same points come to lie just inside or just outside. The
// spacing of the grid in z is h / 4 or a multiple, in a window around the cell's plane.
#include <gtest/gtest.h>

#include <cmath>

#include "barycert/oracle.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/locate/judge.hpp"
#include "tests/mesh/locate/points.hpp"
#include "tests/mesh/sample/grid/compare.hpp"
#include "tests/mesh/sample/points/rows.hpp"

namespace barycert::testing {
namespace {

struct Tally {
    std::size_t points = 0, far = 0, near = 0, inside = 0, boundary = 0;
    std::size_t wrong_owner = 0, wrong_feature = 0, wrong_value = 0;
};

/// Every point of the grid, for a mesh of one cell. far(point): it is outside, by the making of the cell.
template <class Far>
void judge(const Mesh& mesh, const Grid& grid, Far far, Tally& tally) {
    const auto locator = Locator::build(mesh);
    const auto sampler = Sampler::build(*locator, all_fields(mesh));
    const Table found = resampled(*sampler, grid).samples;
    const std::vector<double> points = points_of(grid);
    const auto d = static_cast<std::size_t>(mesh.dimension);
    for (std::size_t i = 0; i < found.cells.size(); ++i) {
        ++tally.points;
        if (far(&points[d * i])) {
            tally.wrong_owner += found.cells[i] == -1 ? 0 : 1;
            ++tally.far;
            continue;
        }
        Case question = case_of(mesh, 0, &points[d * i]);
        for (std::size_t n = 0; n <= d; ++n)
            question.values[n] = mesh.point_fields[0].data[static_cast<std::size_t>(mesh.cells[n])];
        const OracleAnswer right = ask_oracle(question);
        const bool in = right.region == Region::interior || right.region == Region::boundary;
        bool near = false;
        for (std::size_t n = 0; n <= d; ++n) near |= right.weights[n] != 0 && std::abs(right.weights[n]) < 0x1p-24;
        tally.near += near ? 1 : 0;
        tally.inside += in ? 1 : 0;
        tally.boundary += right.region == Region::boundary ? 1 : 0;
        const bool owner = (found.cells[i] == 0) == in;
        tally.wrong_owner += owner ? 0 : 1;
        tally.wrong_feature += found.features[i] == (in ? right.feature : Feature::outside) ? 0 : 1;
        tally.wrong_value += !in || same(found.values[i], right.value) ? 0 : 1;
        if (!owner && tally.wrong_owner < 4)
            ADD_FAILURE() << "owner of " << text_of(&points[d * i], mesh.dimension) << ", which is "
                          << name(right.region);
    }
}

double some_ulps(double x, base::Random& random) {
    const int steps = random.integer(-3, 3);
    for (int i = 0; i < std::abs(steps); ++i) x = std::nextafter(x, steps < 0 ? -1e9 : 1e9);
    return x;
}

void expect_right_near_faces(int d, int flat, int rounds, Tally& tally) {
    base::Random random(static_cast<std::uint64_t>(1000 * d + flat));
    const auto n = static_cast<std::size_t>(d);
    const double h = std::ldexp(1.0, -flat);
    for (int round = 0; round < rounds; ++round) {
        // The long axes carry the shear; the last one is thin. Any of them may be the one along rows.
        const double a = 0.25 * random.integer(-6, 6), b = d == 3 ? 0.25 * random.integer(-6, 6) : 0;
        const double shift = random.below(3) == 0 ? 64 : 0;
        const std::size_t turn = random.below(n);
        const auto placed = [&](std::array<double, 3> p) {
            p[n - 1] = a * p[0] + (d == 3 ? b * p[1] : 0) + h * p[n - 1];
            std::array<double, 3> at{};
            for (std::size_t k = 0; k < n; ++k) at[(k + turn) % n] = p[k] + shift;
            return at;
        };
        const auto far = [&](const double* at) {
            std::array<double, 3> p{};
            for (std::size_t k = 0; k < n; ++k) p[k] = at[(k + turn) % n] - shift;
            const double off = p[n - 1] - a * p[0] - (d == 3 ? b * p[1] : 0);
            return off < -h - 1e-12 || off > 5 * h + 1e-12;
        };
        Mesh mesh;
        mesh.dimension = d;
        std::array<double, 3> low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
        for (std::size_t i = 0; i <= n; ++i) {
            std::array<double, 3> p{};
            for (std::size_t k = 0; k < n; ++k) p[k] = random.integer(0, 4);
            const std::array<double, 3> at = placed(p);
            for (std::size_t k = 0; k < n; ++k) {
                mesh.points.push_back(some_ulps(at[k], random));
                low[k] = std::min(low[k], at[k]);
                high[k] = std::max(high[k], at[k]);
            }
            mesh.cells.push_back(static_cast<Mesh::Index>(i));
        }
        mesh.point_fields = random_fields(mesh.point_count(), {1}, false, random);
        if (round % 3 == 1) {  // values that are ties but for some ulps
            for (std::size_t i = 0; i <= n; ++i) mesh.point_fields[0].data[i] = 1 + 0x1p-50 * random.integer(0, 4);
        }
        std::array<std::int64_t, 3> counts{1, 1, 1};
        for (std::size_t k = 0; k < n; ++k)
            counts[k] = high[k] > low[k] ? static_cast<std::int64_t>(std::min(2 * (high[k] - low[k]), 26.0)) + 1 : 1;
        if (const auto grid = grid_over(d, counts, low, high)) judge(mesh, *grid, far, tally);
        // A window on the thin axis, around the plane at a lattice point: layers of the lattice of h.
        const std::size_t thin = (n - 1 + turn) % n;
        std::array<double, 3> corner{};
        for (std::size_t k = 0; k < n; ++k) corner[k] = random.integer(0, 4);
        const double middle = placed(corner)[thin];
        low[thin] = middle - 3 * h;
        high[thin] = middle + 5 * h;
        counts[thin] = 17;
        if (const auto grid = grid_over(d, counts, low, high)) judge(mesh, *grid, far, tally);
    }
}

TEST(ResampleBounds, NearFacesOfSlivers) {
    std::size_t near = 0;
    for (const int d : {2, 3}) {
        Tally tally;
        for (const int flat : {0, 4, 8, 12, 15, 17, 18, 19, 20, 21, 22, 24, 26, 30, 34, 36, 38, 42, 46, 50})
            expect_right_near_faces(d, flat, d == 3 ? 300 : 700, tally);
        EXPECT_EQ(tally.wrong_owner, 0U) << "of " << tally.points;
        EXPECT_EQ(tally.wrong_feature, 0U) << "of " << tally.points;
        EXPECT_EQ(tally.wrong_value, 0U) << "of " << tally.points;
        EXPECT_GT(tally.inside, 2000U);
        EXPECT_GT(tally.boundary, 0U);
        near += tally.near;
        RecordProperty("points" + std::to_string(d), static_cast<int>(tally.points));
        RecordProperty("near" + std::to_string(d), static_cast<int>(tally.near));
    }
    EXPECT_GT(near, 100000U);
}

/// A cell with a face (2D: a side) that holds the direction of x but for some ulps, and rows of points that lie in it
/// but for some ulps: what tells them is the bound E alone, not the slack along the row.
void expect_right_along_faces(int d, int flat, int rounds, Tally& tally) {
    base::Random random(static_cast<std::uint64_t>(5000 * d + flat));
    const auto n = static_cast<std::size_t>(d);
    const double h = std::ldexp(1.0, -flat);
    for (int round = 0; round < rounds; ++round) {
        // The face lies in z = b y (2D: y = 0), with the last vertex h away from it, anywhere along it.
        const double b = random.uniform(-2, 2), shift = random.below(3) == 0 ? random.uniform(1, 3) : 0;
        Mesh mesh;
        mesh.dimension = d;
        std::array<double, 3> low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
        for (std::size_t i = 0; i <= n; ++i) {
            std::array<double, 3> at{random.uniform(-1, 1), random.uniform(-1, 1), 0};
            const double off = i == n ? h * random.uniform(-1, 1) : 0;
            at[n - 1] = (d == 3 ? b * at[1] : 0) + off + shift;
            if (i == n && d == 2) at[0] *= std::ldexp(1.0, flat);  // else no triangle with such a side is flat askew
            for (std::size_t k = 0; k < n; ++k) {
                mesh.points.push_back(k + 1 == n && i < n ? some_ulps(at[k], random) : at[k]);
                low[k] = std::min(low[k], at[k]);
                high[k] = std::max(high[k], at[k]);
            }
            mesh.cells.push_back(static_cast<Mesh::Index>(i));
        }
        for (std::size_t i = 0; i < random.below(n + 1); ++i) std::swap(mesh.cells[i], mesh.cells[n]);
        mesh.point_fields = random_fields(mesh.point_count(), {1}, false, random);
        if (d == 3) low[1] = high[1] = random.uniform(low[1], high[1]);
        low[n - 1] = high[n - 1] = some_ulps((d == 3 ? b * low[1] : 0) + shift, random);
        if (d == 2) {  // along the side, which is short beside the cell
            low[0] = std::min(mesh.points[0], mesh.points[2]);
            high[0] = std::max(mesh.points[0], mesh.points[2]);
        }
        const auto far = [](const double*) { return false; };
        if (const auto grid = grid_over(d, {random.integer(2, 24), 1, 1}, low, high)) judge(mesh, *grid, far, tally);
    }
}

TEST(ResampleBounds, AlongFaces) {
    for (const int d : {2, 3}) {
        Tally tally;
        for (const int flat : {0, 2, 4, 6, 8, 10, 12, 14, 15, 16, 17, 18, 19, 20, 21, 22, 25, 30, 34, 36, 40, 45})
            expect_right_along_faces(d, flat, 500, tally);
        EXPECT_EQ(tally.wrong_owner, 0U) << "of " << tally.points;
        EXPECT_EQ(tally.wrong_feature, 0U) << "of " << tally.points;
        EXPECT_EQ(tally.wrong_value, 0U) << "of " << tally.points;
        EXPECT_GT(tally.inside, tally.points / 20) << "of " << tally.points;
        EXPECT_LT(tally.inside, tally.points / 20 * 19) << "of " << tally.points;
        EXPECT_GT(tally.near, tally.points / 4) << "of " << tally.points;
    }
}

}  // namespace
}  // namespace barycert::testing
