// D1: answers depend on the points and the mesh alone.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <thread>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/fix.hpp"
#include "barycert/gmsh_files.hpp"
#include "barycert/locator.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/plc.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/locate/points.hpp"

namespace barycert::testing {
namespace {

struct Answers {
    std::vector<Mesh::Index> cells;
    std::vector<Feature> features;

    friend bool operator==(const Answers&, const Answers&) = default;
};

Answers ask(const Locator& locator, const std::vector<double>& points, int threads) {
    const std::size_t count = points.size() / static_cast<std::size_t>(locator.mesh().dimension);
    Answers a{std::vector<Mesh::Index>(count, -9), std::vector<Feature>(count)};
    EXPECT_TRUE(locator.locate(points, a.cells, a.features, nullptr, threads));
    return a;
}

std::vector<std::size_t> shuffled(std::size_t n, base::Random& random) {
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    return order;
}

// More points than fit in a block, of all kinds: threads, targets, methods and the order of points change nothing.
TEST(LocateOrder, D1ManyPoints) {
    const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, 8);
    for (const char* stem : {"cube-hole", "lattice-eighths", "plate"}) {
        base::Random random(base::hash64(stem));
        const Mesh mesh = own_mesh(stem);
        std::vector<double> points = awkward_points(mesh, 1200, random);
        const std::vector<double> inner = inner_points(mesh, 30000, random);
        points.insert(points.end(), inner.begin(), inner.end());
        const auto walks = Locator::build(mesh), asks = Locator::build(mesh, {.prove = Prove::never});
        const Answers right = ask(*walks, points, 1);
        EXPECT_TRUE(ask(*asks, points, 1) == right) << stem;
        for (const std::string& target : simd_targets()) {
            ASSERT_TRUE(use_simd_target(target));
            for (const int threads : {0, 2, 7}) EXPECT_TRUE(ask(*walks, points, threads) == right) << stem << target;
        }
        EXPECT_TRUE(use_simd_target(""));
        const auto d = static_cast<std::size_t>(mesh.dimension);
        const std::vector<std::size_t> order = shuffled(right.cells.size(), random);
        std::vector<double> other(points.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            for (std::size_t k = 0; k < d; ++k) other[d * i + k] = points[d * order[i] + k];
        }
        for (const Locator* locator : {&*walks, &*asks}) {
            const Answers answers = ask(*locator, other, 2);
            for (std::size_t i = 0; i < order.size(); ++i) {
                ASSERT_EQ(answers.cells[i], right.cells[order[i]]) << stem;
                ASSERT_EQ(answers.features[i], right.features[order[i]]) << stem;
            }
        }
    }
}

// Cells in another order: owners are those of lowest index in the new order among the same cells.
TEST(LocateOrder, L1CellsPermuted) {
    for (const char* stem : {"cube-hole", "lattice-box", "plate"}) {
        base::Random random(base::hash64(stem));
        const Mesh mesh = own_mesh(stem);
        Mesh other = mesh;
        other.neighbours.clear();
        other.faces.clear();
        other.face_markers.clear();
        const std::vector<std::size_t> old = shuffled(mesh.cell_count(), random);
        std::vector<Mesh::Index> now(old.size());
        for (std::size_t c = 0; c < old.size(); ++c) {
            now[old[c]] = static_cast<Mesh::Index>(c);
            for (std::size_t i = 0; i < mesh.corners(); ++i)
                other.cells[mesh.corners() * c + i] = mesh.cells[mesh.corners() * old[c] + (i + c) % mesh.corners()];
        }
        const std::vector<double> points = awkward_points(mesh, 300, random);
        const auto first = Locator::build(mesh);
        const auto second = Locator::build(other);
        EXPECT_EQ(second->method(), Method::walk) << stem;
        const auto all = first->locate_all(points), all_of_other = second->locate_all(points);
        ASSERT_TRUE(all && all_of_other);
        ASSERT_EQ(all->point_begin, all_of_other->point_begin);
        const Answers answers = ask(*second, points, 2), before = ask(*first, points, 2);
        for (std::size_t i = 0; i < answers.cells.size(); ++i) {
            std::vector<Mesh::Index> mapped_cells;
            for (std::size_t j = all->point_begin[i]; j < all->point_begin[i + 1]; ++j)
                mapped_cells.push_back(all->cells[j] < 0 ? -1 : now[static_cast<std::size_t>(all->cells[j])]);
            std::sort(mapped_cells.begin(), mapped_cells.end());
            for (std::size_t j = 0; j < mapped_cells.size(); ++j)
                ASSERT_EQ(all_of_other->cells[all->point_begin[i] + j], mapped_cells[j]) << stem;
            ASSERT_EQ(answers.cells[i], mapped_cells.front()) << stem;
            ASSERT_EQ(answers.features[i], before.features[i]) << stem;  // in a complex the same from every cell
        }
    }
}

// A walk from any cell to any point.
TEST(LocateOrder, D1Hints) {
    for (const char* stem : {"bracket", "torus", "plate"}) {
        base::Random random(base::hash64(stem));
        const Mesh mesh = own_mesh(stem);
        const std::vector<double> points = awkward_points(mesh, 400, random);
        const auto locator = Locator::build(mesh);
        const Answers right = ask(*locator, points, 1);
        for (std::size_t i = 0; i < right.cells.size(); ++i) {
            const double* const p = &points[i * static_cast<std::size_t>(mesh.dimension)];
            for (int n = 0; n < 6; ++n) {
                const auto hint = static_cast<Mesh::Index>(random.below(mesh.cell_count()));
                ASSERT_EQ(*locator->locate(p, hint), (Location{right.cells[i], right.features[i]})) << stem << hint;
            }
        }
    }
}

/// Answers must be those of an index that was proved at once, whether the proof came before, meanwhile or not at all.
TEST(LocateOrder, TheProofComesWhenItPays) {
    constexpr std::size_t enough = 50000;
    for (const char* stem : {"cube-hole", "plate", "bracket"}) {
        for (const bool twice : {false, true}) {  // a cell that is there twice is contested
            base::Random random(base::hash64(stem));
            const Mesh whole = own_mesh(stem);
            Mesh mesh;
            mesh.dimension = whole.dimension;
            mesh.points = whole.points;
            mesh.cells = whole.cells;
            if (twice) std::copy_n(whole.cells.begin(), mesh.corners(), std::back_inserter(mesh.cells));
            const auto at_once = Locator::build(mesh), later = Locator::build(mesh, {.prove = Prove::when_it_pays});
            const std::vector<double> points = inner_points(mesh, enough / 2, random);
            const Answers right = ask(*at_once, points, 1);
            std::vector<Mesh::Index> cells(enough / 2);
            std::vector<Feature> features(cells.size());
            LocationCounts counts[2];
            for (LocationCounts& c : counts) {
                ASSERT_TRUE(later->locate(points, cells, features, &c));
                EXPECT_TRUE((Answers{cells, features} == right)) << stem << twice;
            }
            EXPECT_EQ(counts[0].ways.candidates, cells.size()) << stem;
            EXPECT_LT(counts[1].ways.candidates, cells.size() / 2) << stem;
            EXPECT_EQ(later->certified(), !twice) << stem;
            EXPECT_EQ(later->contested_cells(), at_once->contested_cells()) << stem;

            const auto asked = Locator::build(mesh, {.prove = Prove::when_it_pays});
            EXPECT_EQ(asked->contested_cells(), at_once->contested_cells()) << stem;
            LocationCounts proved;
            ASSERT_TRUE(asked->locate(points, cells, features, &proved));
            EXPECT_EQ(proved.ways.walk, counts[1].ways.walk) << stem;
        }
    }
}

TEST(LocateOrder, CallsForOnePointRememberWhereNoCellIs) {
    for (const char* stem : {"bracket", "cube-hole", "plate"}) {
        base::Random random(base::hash64(stem));
        const Mesh mesh = own_mesh(stem);
        const std::vector<double> points = awkward_points(mesh, 3000, random);
        for (const Prove prove : {Prove::at_once, Prove::never}) {
            // One that many calls have asked, with hints and without, and one that none has.
            const auto locator = Locator::build(mesh, {.prove = prove});
            const Answers right = ask(*Locator::build(mesh), points, 1);
            const std::size_t d = mesh.corners() - 1;
            for (const bool hints : {true, false}) {
                Mesh::Index hint = -1;
                for (std::size_t i = 0; i < right.cells.size(); ++i) {
                    const Location found = locator->locate(points.data() + d * i, hint).value();
                    ASSERT_EQ(found.cell, right.cells[i]) << stem << " point " << i;
                    ASSERT_EQ(found.feature, right.features[i]) << stem << " point " << i;
                    if (hints) hint = found.cell;
                }
            }
        }
    }
    // An occupancy takes memory, and is made after so many points outside as pay for it.
    const Mesh mesh = own_mesh("bracket");
    const auto locator = Locator::build(mesh);
    base::Random random(9);
    std::size_t few = 0;
    for (std::size_t outside = 0; outside < mesh.cell_count();) {
        double x[3];
        for (std::size_t k = 0; k < 3; ++k) {
            double low = HUGE_VAL, high = -HUGE_VAL;
            for (std::size_t i = k; i < mesh.points.size(); i += 3)
                low = std::min(low, mesh.points[i]), high = std::max(high, mesh.points[i]);
            x[k] = random.uniform(low, high);
        }
        if (locator->locate(x)->cell < 0 && ++outside == 200) few = locator->bytes();
    }
    EXPECT_GT(locator->bytes(), few);
}

TEST(LocateOrder, ThreadsAskWhileAnotherProves) {
    base::Random random(8);
    const Mesh mesh = own_mesh("bracket");
    const std::vector<double> points = awkward_points(mesh, 2000, random);
    const Answers right = ask(*Locator::build(mesh), points, 1);
    const auto locator = Locator::build(mesh, {.prove = Prove::when_it_pays});
    std::atomic<std::size_t> wrong = 0;
    const auto one_by_one = [&](std::size_t first) {
        for (std::size_t n = 0; n < right.cells.size(); ++n) {
            const std::size_t i = (first + n) % right.cells.size();
            const Result<Location> found = locator->locate(&points[3 * i], n % 3 == 0 ? -1 : right.cells[(i + n) % 7]);
            wrong += found && *found == Location{right.cells[i], right.features[i]} ? 0 : 1;
        }
    };
    const auto together = [&] { wrong += ask(*locator, points, 2) == right ? 0 : 1; };
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < 3; ++t) threads.emplace_back(one_by_one, 1000 * t);
    for (int t = 0; t < 2; ++t) threads.emplace_back(together);
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, 0U);
    EXPECT_GT(2 * right.cells.size() + 3 * right.cells.size(), 50000U);
    LocationCounts counts;
    std::vector<Mesh::Index> cells(right.cells.size());
    std::vector<Feature> features(cells.size());
    ASSERT_TRUE(locator->locate(points, cells, features, &counts));
    EXPECT_GT(counts.ways.walk, 0U);
}

TEST(LocateOrder, CountsAreAddedTo) {
    base::Random random(9);
    const Mesh mesh = own_mesh("lattice-eighths");
    const std::vector<double> points = awkward_points(mesh, 50, random);
    const auto locator = Locator::build(mesh, {.prove = Prove::never});
    std::vector<Mesh::Index> cells(points.size() / 3);
    std::vector<Feature> features(cells.size());
    LocationCounts counts;
    ASSERT_TRUE(locator->locate(points, cells, features, &counts));
    const LocationCounts once = counts;
    ASSERT_TRUE(locator->locate(points, cells, features, &counts));
    counts.add(locator->locate_all(points)->counts.locations);
    EXPECT_EQ(counts.points(), 3 * cells.size());
    EXPECT_EQ(counts.vertex, 3 * once.vertex);
    EXPECT_EQ(counts.edge, 3 * once.edge);
    EXPECT_EQ(counts.face, 3 * once.face);
    EXPECT_EQ(counts.interior, 3 * once.interior);
    EXPECT_EQ(counts.inside() + counts.outside, counts.points());
    EXPECT_GT(counts.tests.filter, 0U);
    EXPECT_GT(counts.tests.exact, 0U);
    std::vector<double> bad = points;
    bad[4] = std::numeric_limits<double>::quiet_NaN();
    const LocationCounts before = counts;
    EXPECT_FALSE(locator->locate(bad, cells, features, &counts));
    EXPECT_EQ(counts.points(), before.points());
}

}  // namespace
}  // namespace barycert::testing
