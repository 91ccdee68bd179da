// Arrays that hold anything: no crash, no certificate that the judge would not give, and the same from any threads.
#include <gtest/gtest.h>

#include <cfenv>
#include <chrono>
#include <limits>

#include "tests/mesh/check/judge.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/check/random_complexes.hpp"

namespace barycert::testing {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

template <class T>
void expect_same_bits(const std::vector<T>& x, const std::vector<T>& y) {
    ASSERT_EQ(x.size(), y.size());
    for (std::size_t i = 0; i < x.size(); ++i) ASSERT_TRUE(x[i] == y[i] || (x[i] != x[i] && y[i] != y[i])) << i;
}

void expect_same_report(const CheckReport& r, const CheckReport& s) {
    ASSERT_EQ(r.certified(), s.certified());
    ASSERT_EQ(words(found(r)), words(found(s)));
    for (std::size_t i = 0; i < r.defects.size(); ++i) {
        const Defect &f = r.defects[i], &g = s.defects[i];
        ASSERT_EQ(f.count, g.count);
        ASSERT_EQ(f.at_least, g.at_least);
        ASSERT_EQ(f.places.size(), g.places.size());
        for (std::size_t k = 0; k < f.places.size(); ++k) {
            ASSERT_EQ(f.places[k].cells, g.places[k].cells);
            ASSERT_EQ(f.places[k].nodes, g.places[k].nodes);
            ASSERT_STREQ(f.places[k].detail, g.places[k].detail);
        }
    }
    ASSERT_EQ(r.contacts.size(), s.contacts.size());
    for (std::size_t i = 0; i < r.contacts.size(); ++i) {
        ASSERT_EQ(r.contacts[i].cells, s.contacts[i].cells);
        ASSERT_EQ(r.contacts[i].common.fraction, s.contacts[i].common.fraction);
    }
    ASSERT_EQ(r.parts, s.parts);
    ASSERT_EQ(r.boundary.facets, s.boundary.facets);
    ASSERT_EQ(r.boundary.pieces, s.boundary.pieces);
    ASSERT_EQ(r.volume.cells, s.volume.cells);
    expect_same_bits(r.measures.orientation, s.measures.orientation);
    expect_same_bits(r.measures.defects, s.measures.defects);
    for (const auto m : {&CellMeasures::volume, &CellMeasures::condition, &CellMeasures::radius_edge,
                         &CellMeasures::aspect, &CellMeasures::min_angle, &CellMeasures::max_angle})
        expect_same_bits(r.measures.*m, s.measures.*m);
}

CheckReport with_threads(const Mesh& mesh, int threads) {
    CheckOptions options;
    options.threads = threads;
    return check_mesh(mesh, options);
}

TEST(Robustness, SizesThatDoNotFit) {
    for (const int d : {-3, -1, 0, 1, 4, 1000, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
        for (const std::size_t n : {0U, 12U}) {
            Mesh mesh;
            mesh.dimension = d;
            mesh.points.assign(n, 1);
            mesh.cells.assign(n, 0);
            const CheckReport r = quick(mesh);
            EXPECT_FALSE(r.certified());
            EXPECT_EQ(words(found(r)), "bad_structure");
            EXPECT_FALSE(r.certificate.covers(mesh));
        }
    }
    for (const int d : {2, 3}) {
        Mesh mesh = box(d, {1, 1, 1});
        mesh.points.pop_back();
        EXPECT_EQ(words(found(quick(mesh))), "bad_structure");
        mesh = box(d, {1, 1, 1});
        mesh.cells.pop_back();
        EXPECT_EQ(words(found(quick(mesh))), "bad_structure");
    }
}

TEST(Robustness, AnyIndices) {
    constexpr Mesh::Index wild[] = {std::numeric_limits<Mesh::Index>::min(), -2, -1, 0, 1, 7, 8, 9,
                                    std::numeric_limits<Mesh::Index>::max()};
    for (const int d : {2, 3}) {
        std::size_t certified = 0;
        for (std::uint64_t i = 0; i < 1000; ++i) {
            base::Random random = base::Random::stream(41, static_cast<std::uint64_t>(d), i);
            Mesh mesh = i % 2 == 0 ? damaged_box(d, random) : random_soup(d, random);
            const auto any = [&] { return wild[random.below(std::size(wild))]; };
            for (std::uint64_t k = random.below(3); k > 0 && !mesh.cells.empty(); --k)
                mesh.cells[random.below(mesh.cells.size())] = any();
            for (std::uint64_t k = random.below(2); k > 0; --k)
                mesh.points[random.below(mesh.points.size())] = random.below(8) != 0 ? nan : 1e308;
            bool extra = random.below(4) == 0;
            if (extra) {
                mesh.neighbours.resize(random.coin() ? mesh.cells.size() : random.below(30));
                for (Mesh::Index& n : mesh.neighbours) n = any();
                mesh.faces.resize(random.below(20));
                for (Mesh::Index& n : mesh.faces) n = any();
            }
            const CheckReport r = quick(mesh, 5);
            if (r.certified()) {
                EXPECT_TRUE(judge(mesh).complex);
            } else if (!extra && r.find(DefectKind::not_finite) == nullptr) {
                EXPECT_FALSE(judge(mesh).complex);
            }
            certified += r.certified() ? 1 : 0;
        }
        EXPECT_GT(certified, 40U);
    }
}

TEST(Robustness, AllTheSame) {
    for (const int d : {2, 3}) {
        Mesh mesh = box(d, {3, 3, 3});
        for (Mesh::Index& n : mesh.cells) n = 5;
        EXPECT_FALSE(quick(mesh).certified());
        mesh = box(d, {3, 3, 3});
        for (double& x : mesh.points) x = nan;
        EXPECT_EQ(words(found(quick(mesh))), "not_finite");
        for (double& x : mesh.points) x = 1e308;
        EXPECT_EQ(words(found(quick(mesh, 5)) & ~set_of(DefectKind::coincident_nodes)), "degenerate_cell");
        mesh = box(d, {3, 3, 3});
        for (std::size_t c = 1; c < mesh.cell_count(); ++c) {
            for (std::size_t i = 0; i < mesh.corners(); ++i) mesh.cells[c * mesh.corners() + i] = mesh.cells[i];
        }
        const CheckReport r = quick(mesh, 5);
        EXPECT_EQ(r.find(DefectKind::duplicate_cell)->count, mesh.cell_count() - 1);
        mesh.points.clear();
        EXPECT_EQ(words(found(quick(mesh))), "index_out_of_range");
    }
}

// Large enough for several blocks and waves of every search.
TEST(Robustness, SameFromAnyThreads) {
    for (const int d : {2, 3}) {
        Mesh mesh = d == 2 ? box(2, {120, 100, 0}) : box(3, {9, 8, 7});
        mesh = joined(mesh, mapped(mesh, {1, 1, 1}, {d == 2 ? 119.5 : 8.5, 0.25, 0.25}));
        base::Random random(43);
        mesh = renumbered(mesh, random);
        flip_some(mesh, random);
        for (int i = 0; i < 50; ++i) {
            mesh.cells[random.below(mesh.cells.size())] = static_cast<Mesh::Index>(random.below(mesh.point_count()));
            mesh.points[random.below(mesh.points.size())] += 0.5;
        }
        mesh.points[random.below(mesh.points.size())] = nan;
        mesh.cells[random.below(mesh.cells.size())] = -1;
        const CheckReport r = with_threads(mesh, 1);
        EXPECT_GE(r.defects.size(), 8U) << words(found(r));
        for (const int threads : {2, 5}) expect_same_report(r, with_threads(mesh, threads));
        expect_same_report(r, with_threads(mesh, 2));
    }
}

// A caller that changes something when it is told of a stage changes nothing that is computed after it.
TEST(Robustness, SameWithACallerThatRoundsUpward) {
    for (const int d : {2, 3}) {
        base::Random random(46);
        Mesh mesh = box(d, {6, 5, 4});
        for (double& x : mesh.points) x += random.uniform(-0.2, 0.2);
        CheckOptions options;
        options.threads = 1;
        const CheckReport r = check_mesh(mesh, options);
        std::size_t told = 0;
        options.progress = [&](const char*) {
            ++told;
            std::fesetround(FE_UPWARD);
        };
        const CheckReport upward = check_mesh(mesh, options);
        EXPECT_EQ(std::fegetround(), FE_TONEAREST);
        EXPECT_GT(told, 2U);
        expect_same_report(r, upward);
    }
}

// Every cell overlaps every other: the searches are given up, and say so.
TEST(Robustness, AllOverlapAll) {
    for (const int d : {2, 3}) {
        base::Random random(44);
        Mesh mesh;
        mesh.dimension = d;
        for (int i = 0; i < 300 * (d + 1); ++i) {
            mesh.cells.push_back(i);
            for (int k = 0; k < d; ++k)
                mesh.points.push_back((i % (d + 1) == k + 1 ? 4 : -1) + random.uniform(-0.1, 0.1));
        }
        const CheckReport r = quick(mesh, 5);
        EXPECT_FALSE(r.certified());
        ASSERT_NE(r.find(DefectKind::overlapping_cells), nullptr);
        EXPECT_TRUE(r.find(DefectKind::overlapping_cells)->at_least);
        EXPECT_EQ(r.find(DefectKind::overlapping_cells)->count, 1000U);
        EXPECT_EQ(r.find(DefectKind::boundary_contact)->count, 1000U);
        EXPECT_EQ(r.find(DefectKind::nested_part)->count, 300U);
        EXPECT_EQ(r.contacts.size(), 5U);
    }
}

// How many pairs there are is told exactly up to the limit, and not said to be more.
TEST(Robustness, AtTheLimitOfPairs) {
    for (const int overlapping : {999, 1000, 1001}) {
        Mesh mesh;
        mesh.dimension = 2;
        for (int i = 0; i < overlapping; ++i) {
            const double x = 10.0 * i;
            mesh.points.insert(mesh.points.end(), {x, 0, x + 4, 0, x, 4, x + 1, 1, x + 2, 1, x + 1, 2});
            for (int k = 0; k < 6; ++k) mesh.cells.push_back(6 * i + k);
        }
        const CheckReport r = quick(mesh);
        EXPECT_EQ(r.find(DefectKind::overlapping_cells)->count,
                  static_cast<std::uint64_t>(std::min(overlapping, 1000)));
        EXPECT_EQ(r.find(DefectKind::overlapping_cells)->at_least, overlapping > 1000);
        EXPECT_EQ(r.find(DefectKind::nested_part)->count, 1000U);  // of two a pair
        EXPECT_TRUE(r.find(DefectKind::nested_part)->at_least);
    }
}

TEST(Robustness, Examples) {
    Mesh mesh = box(2, {20, 20, 0});
    for (std::size_t i = 0; i < 50; ++i) mesh.cells[i * 6] = -1;
    for (const std::size_t n : {0U, 1U, 7U, 1000U}) {
        CheckOptions options;
        options.examples = n;
        const CheckReport r = check_mesh(mesh, options);
        EXPECT_EQ(r.find(DefectKind::index_out_of_range)->count, 50U);
        EXPECT_EQ(r.find(DefectKind::index_out_of_range)->places.size(), std::min<std::size_t>(n, 50));
    }
}

}  // namespace
}  // namespace barycert::testing
