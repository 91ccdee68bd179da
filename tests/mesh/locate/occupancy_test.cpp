// Where Occupancy says that no cell is, no cell may be: at the edges of its bins above all.
#include "mesh/locate/occupancy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "barycert/locator.hpp"
#include "mesh/locate/lanes.hpp"
#include "mesh/locate/locator_data.hpp"
#include "tests/limits.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/check/random_complexes.hpp"
#include "tests/mesh/locate/points.hpp"
#include "tests/mesh/locate/ways.hpp"

namespace barycert::testing {
namespace {

using Detail = locate::Occupancy::Detail;

/// The lowest double of the box that the quantizer maps to q or above, on axis k.
double first_of(const locate::CellIndex& index, std::size_t k, std::int32_t q) {
    double below = index.low[k], x = index.high[k];
    if (index.bins.quantizer().at(k, below) >= q) return below;
    for (;;) {
        const double middle = below * 0.5 + x * 0.5;
        if (!(below < middle && middle < x)) break;
        (index.bins.quantizer().at(k, middle) >= q ? x : below) = middle;
    }
    return x;
}

/// Points whose coordinates are the first or the last ones of bins, of corners of cells, or anything in the box.
std::vector<double> edge_points(const Mesh& mesh, const locate::CellIndex& index, const locate::Occupancy& occupancy,
                                std::size_t count, base::Random& random) {
    std::vector<double> points;
    const std::size_t d = index.dimension();
    for (std::size_t i = 0; i < count; ++i) {
        // Near a cell, where answers differ.
        const std::size_t corner = random.below(mesh.cells.size());
        const auto node = static_cast<std::size_t>(mesh.cells[corner]);
        for (std::size_t k = 0; k < d; ++k) {
            const double at = mesh.points[d * node + k];
            const int shift = locate::Quantizer::bits - occupancy.bits(k);
            const std::int64_t bin = index.bins.quantizer().at(k, at) >> shift;
            const std::int64_t other = std::max<std::int64_t>(0, bin + random.integer(-2, 3)) << shift;
            double x = at;
            const int kind = random.integer(0, 5);
            if (kind <= 3 && other <= locate::Quantizer::max) {
                x = first_of(index, k, static_cast<std::int32_t>(other));
                if (kind >= 2) x = std::nextafter(x, -infinity);
            } else if (kind == 4) {
                x = index.low[k] + (index.high[k] - index.low[k]) * random.unit();
            }
            points.push_back(std::clamp(x, index.low[k], index.high[k]));
        }
    }
    return points;
}

struct Told {
    std::size_t clear = 0, outside = 0, points = 0;
};

/// Every point that is told to be outside must be so.
Told ask(const Mesh& mesh, Detail detail, base::Random& random, const std::string& what) {
    Told told;
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    if (!locator || mesh.cell_count() == 0) return told;
    const locate::CellIndex& index = locate::LocatorData::of(*locator).index;
    const double filled = locate::filled_share(index);
    if (!(filled < 1)) return told;
    const locate::Occupancy occupancy(index, filled, detail);
    const std::size_t d = index.dimension();
    std::vector<double> points = edge_points(mesh, index, occupancy, 400, random);
    const std::vector<double> more = awkward_points(mesh, 20, random);
    points.insert(points.end(), more.begin(), more.end());
    const PointJudge judge(mesh);
    told.points = points.size() / d;
    std::vector<std::uint32_t> bin(told.points), plain(told.points);
    EXPECT_TRUE(locate::find_bins(index, &occupancy, points, bin.data()));
    EXPECT_TRUE(locate::find_bins(index, nullptr, points, plain.data()));
    for (std::size_t i = 0; i < told.points; ++i) {
        const double* const p = points.data() + d * i;
        const bool outside = judge.holders(p).empty(), in_box = index.box_holds(p);
        const bool kept = in_box && occupancy.may_hold(index, p);
        told.outside += outside ? 1 : 0;
        told.clear += kept ? 0 : 1;
        EXPECT_TRUE(outside || kept) << what << ": " << text_of(p, mesh.dimension) << " is said to be outside";
        EXPECT_EQ(bin[i], kept ? index.bins.of(p) : locate::no_bin) << what << text_of(p, mesh.dimension);
        EXPECT_EQ(plain[i], in_box ? index.bins.of(p) : locate::no_bin) << what << text_of(p, mesh.dimension);
    }
    return told;
}

TEST(LocateOccupancy, L1NoCellWhereThereIsNoneSoups) {
    for (const int d : {2, 3}) {
        Told all;
        for (std::uint64_t n = 0; n < 60 && !::testing::Test::HasFailure(); ++n) {
            base::Random random = base::Random::stream(11, n, static_cast<std::uint64_t>(d));
            const Mesh mesh = n % 3 == 0   ? random_soup(d, random)
                              : n % 3 == 1 ? grown_complex(d, random)
                                           : damaged_box(d, random);
            const Told told =
                ask(mesh, n % 2 == 0 ? Detail::fine : Detail::coarse, random, "mesh " + std::to_string(n));
            all.clear += told.clear;
            all.outside += told.outside;
        }
        EXPECT_GT(8 * all.clear, all.outside);
    }
}

TEST(LocateOccupancy, L1NoCellWhereThereIsNoneAnyMagnitude) {
    for (const int d : {2, 3}) {
        for (const std::array<double, 3> factor : {std::array<double, 3>{1, 1, 1},
                                                   {1e300, 1e300, 1e300},
                                                   {1e-300, 1e-300, 1e-300},
                                                   {4e307, 4e307, 4e307},
                                                   {5e-324, 5e-324, 5e-324},
                                                   {1e300, 1e-300, 1},
                                                   {1e-9, 1, 1e9}}) {
            for (const double shift : {0.0, 0.1, 1e6, 1e12, 1e15}) {
                base::Random random(12);
                Mesh mesh = box(d, {4, 4, 3});
                std::vector<bool> keep(mesh.cell_count());
                for (std::size_t c = 0; c < keep.size(); ++c) keep[c] = random.below(4) == 0;
                mesh = mapped(only(mesh, keep), {0.3, 0.3, 0.3}, {shift, -shift, shift});
                mesh = mapped(mesh, factor, {});
                bool finite = true;
                for (const double x : mesh.points) finite &= std::isfinite(x);
                for (const Detail detail : {Detail::coarse, Detail::fine})
                    if (finite) ask(mesh, detail, random, "factor " + testing::text_of(factor.data(), 3));
            }
        }
    }
}

// A thin cell along a diagonal: nearly all of its box is known to be empty.
TEST(LocateOccupancy, MostOfTheBoxOfAThinCellIsEmpty) {
    Mesh mesh;
    mesh.points = {0, 0, 0, 1, 1, 1, 1, 1, 0.99, 0.99, 1, 1};
    mesh.cells = {0, 1, 2, 3};
    base::Random random(13);
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    ASSERT_TRUE(locator);
    locate::LocatorData::of(*locator).policy.prepare(1'000'000);
    ASSERT_NE(locate::LocatorData::of(*locator).parts.occupancy(), nullptr);
    std::size_t kept = 0;
    constexpr std::size_t count = 10000;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = random.unit(), y = random.unit(), z = random.unit();
        const double p[] = {x, y, z};
        kept +=
            locate::LocatorData::of(*locator).parts.occupancy()->may_hold(locate::LocatorData::of(*locator).index, p)
                ? 1
                : 0;
    }
    EXPECT_GT(kept, 0U);
    EXPECT_LT(kept, count / 8);
}

// A mesh that fills its box leaves nothing to tell, and neither does a flat one.
TEST(LocateOccupancy, NoRoom) {
    for (const int d : {2, 3}) {
        const Mesh full = box(d, {3, 3, 3});
        const auto locator = Locator::build(full);
        locate::LocatorData::of(*locator).policy.prepare(1'000'000);
        EXPECT_EQ(locate::LocatorData::of(*locator).parts.occupancy(), nullptr);
        Mesh flat = full;
        for (std::size_t i = 0; i < flat.points.size(); i += static_cast<std::size_t>(d)) flat.points[i] = 3;
        EXPECT_GE(locate::filled_share(locate::LocatorData::of(*Locator::build(flat, {.prove = Prove::never})).index),
                  1);
    }
}

// All ways of asking, with the occupancy made: the batch is long enough.
TEST(LocateOccupancy, L1L2L3EveryWay) {
    for (const int d : {2, 3}) {
        for (std::uint64_t n = 0; n < 40 && !::testing::Test::HasFailure(); ++n) {
            base::Random random = base::Random::stream(14, n, static_cast<std::uint64_t>(d));
            Mesh mesh = n % 2 == 0 ? grown_complex(d, random) : damaged_box(d, random);
            if (mesh.cell_count() == 0) continue;
            const auto locator = Locator::build(mesh, {.prove = Prove::never});
            locate::LocatorData::of(*locator).policy.prepare(1'000'000);
            if (locate::LocatorData::of(*locator).parts.occupancy() == nullptr) continue;
            std::vector<double> points = edge_points(mesh, locate::LocatorData::of(*locator).index,
                                                     *locate::LocatorData::of(*locator).parts.occupancy(), 200, random);
            const std::vector<double> more = awkward_points(mesh, 10, random);
            points.insert(points.end(), more.begin(), more.end());
            ASSERT_GE(points.size() / static_cast<std::size_t>(d), mesh.cell_count());
            expect_right(mesh, points, random, "complex " + std::to_string(n), {.threads = false});
        }
    }
}

}  // namespace
}  // namespace barycert::testing
