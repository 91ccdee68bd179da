// The bounds of fill_lanes.cpp and raster_lanes.cpp: points within some ulps of faces of ever flatter cells, against
// the oracle.
//
// Cells are (x, y, z) -> (x, y, a x + b y + h z) of lattice cells, so that many points of a lattice grid lie exactly in
// their faces; then nodes move by some ulps, and so the same points come to lie just inside or just outside. The
// spacing of the grid in z is h / 4 or a multiple, in a window around the cell's plane.
#include <gtest/gtest.h>

#include <cmath>

#include "barycert/exact/oracle.hpp"
#include "check/meshes.hpp"
#include "locate/judge.hpp"
#include "locate/points.hpp"
#include "resample/compare.hpp"
#include "sample/rows.hpp"

namespace barycert::testing {
namespace {

struct Tally {
    std::size_t points = 0, far = 0, near = 0, inside = 0, boundary = 0;
    std::size_t wrong_owner = 0, wrong_feature = 0, wrong_value = 0;
};

/// Every point of the grid, for a mesh of one cell. far(point): it is outside, by the making of the cell.
template <class Far>
void judge(const Mesh& mesh, const Grid& grid, Far far, Tally& tally) {
    const auto locator = Locator::build(mesh, quick(mesh).certificate);
    const auto sampler = Sampler::build(*locator, all_fields(mesh));
    const Samples found = resampled(*sampler, grid).samples;
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
        const exact::Answer right = exact::ask(question);
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

double some_ulps(double x, Random& random) {
    const int steps = random.integer(-3, 3);
    for (int i = 0; i < std::abs(steps); ++i) x = std::nextafter(x, steps < 0 ? -1e9 : 1e9);
    return x;
}

void expect_right_near_faces(int d, int flat, int rounds, Tally& tally) {
    Random random(static_cast<std::uint64_t>(1000 * d + flat));
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

}  // namespace
}  // namespace barycert::testing
