// Cells of which it is proved that all others meet them in common faces: held against the slow judge of pairs of cells.
#include "mesh/index/proof.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "barycert/predicates.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/locate/locator_data.hpp"
#include "tests/limits.hpp"
#include "tests/mesh/check/judge.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/check/random_complexes.hpp"
#include "tests/mesh/shaped_mesh.hpp"

namespace barycert::testing {
namespace {

using index::Place;

bool degenerate(const Mesh& mesh, std::size_t cell) {
    const double* at[4];
    for (std::size_t i = 0; i < mesh.corners(); ++i)
        at[i] = &mesh.points[static_cast<std::size_t>(mesh.dimension) *
                             static_cast<std::size_t>(mesh.cells[mesh.corners() * cell + i])];
    return (mesh.dimension == 2 ? orient2d(at[0], at[1], at[2]) : orient3d(at[0], at[1], at[2], at[3])) == Sign::zero;
}

bool boxes_meet(const Mesh& mesh, std::size_t a, std::size_t b) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    for (std::size_t k = 0; k < d; ++k) {
        const auto range = [&](std::size_t cell) {
            std::array<double, 2> out{infinity, -infinity};
            for (std::size_t i = 0; i < mesh.corners(); ++i) {
                const double x = mesh.points[d * static_cast<std::size_t>(mesh.cells[mesh.corners() * cell + i]) + k];
                out = {std::min(out[0], x), std::max(out[1], x)};
            }
            return out;
        };
        const auto first = range(a), second = range(b);
        if (first[0] > second[1] || second[0] > first[1]) return false;
    }
    return true;
}

/// Returns how many cells are not contested. Expects that each of them meets all others as it should; looks at every
/// `step`th cell.
std::size_t expect_proved(const Mesh& mesh, const std::string& what, std::size_t step = 1) {
    const Locator locator = Locator::build(mesh, {.threads = 1}).value();
    const locate::LocatorData& data = locate::LocatorData::of(locator);
    std::size_t proved = 0;
    for (std::size_t p = 0; p < mesh.cell_count(); ++p) {
        const Mesh::Index a = data.index.original[p];
        if (data.parts.proved()->proof.is_contested(static_cast<Place>(p)) ||
            degenerate(mesh, static_cast<std::size_t>(a)))
            continue;
        if (proved++ % step != 0) continue;
        for (std::size_t b = 0; b < mesh.cell_count(); ++b) {
            if (b == static_cast<std::size_t>(a) || !boxes_meet(mesh, static_cast<std::size_t>(a), b)) continue;
            if (degenerate(mesh, b)) continue;
            EXPECT_TRUE(meeting(mesh, a, static_cast<Mesh::Index>(b)).in_common_face)
                << what << ": cell " << a << " is not contested, but cell " << b << " meets it elsewhere";
        }
    }
    return proved;
}

TEST(IndexProof, WhatIsNotContestedMeetsOthersInCommonFaces) {
    std::size_t proved = 0, bad = 0;
    for (const int d : {2, 3}) {
        for (std::uint64_t n = 0; n < 6000 && !::testing::Test::HasFailure(); ++n) {
            base::Random random = base::Random::stream(11, n, static_cast<std::uint64_t>(d));
            Mesh mesh = n % 3 == 0   ? random_soup(d, random)
                        : n % 3 == 1 ? grown_complex(d, random)
                                     : damaged_box(d, random);
            if (random.coin()) flip_some(mesh, random);
            const bool certified = Locator::build(mesh)->certified();
            EXPECT_EQ(certified, judge(mesh).complex) << n;
            const std::size_t here = expect_proved(mesh, "mesh " + std::to_string(n));
            bad += certified ? 0 : 1;
            proved += certified ? 0 : here;
        }
    }
    EXPECT_GT(bad, 3000U);
    EXPECT_GT(proved, 2500U);  // of bad meshes: a proof that contests everything would prove nothing
}

/// A box with one node moved far enough to fold cells.
Mesh folded_box(int d, int side) {
    Mesh mesh = box(d, {side, side, side});
    const auto width = static_cast<std::size_t>(d);
    for (std::size_t i = 0; i < mesh.point_count(); ++i) {
        bool middle = true;
        for (std::size_t k = 0; k < width; ++k) middle &= mesh.points[width * i + k] == side / 2;
        for (std::size_t k = 0; k < width && middle; ++k) mesh.points[width * i + k] += k == 0 ? 1.25 : 0.125;
    }
    return mesh;
}

TEST(IndexProof, OnlyTheNeighbourhoodOfADefectIsContested) {
    for (const int d : {2, 3}) {
        const Mesh mesh = folded_box(d, d == 2 ? 12 : 6);
        const Locator locator = Locator::build(mesh).value();
        EXPECT_FALSE(locator.certified());
        EXPECT_GT(locator.contested_cells(), 0U);
        EXPECT_LT(locator.contested_cells(), mesh.cell_count() / 8) << d;
        expect_proved(mesh, "folded box", d == 2 ? 1 : 41);
    }
}

// Parts inside others, cavities filled with a part of their own, cells that are there twice, three cells at a facet.
TEST(IndexProof, PartsInsideOthers) {
    for (const int d : {2, 3}) {
        const std::size_t step = d == 2 ? 1 : 101;
        Mesh outer = box(d, {5, 5, 5});
        const Mesh inner = mapped(box(d, {1, 1, 1}), {0.5, 0.5, 0.5}, {2.125, 2.25, 2.125});
        const Mesh nested = joined(outer, inner);
        EXPECT_FALSE(Locator::build(nested)->certified());
        expect_proved(nested, "nested", step);
        expect_proved(joined(inner, outer), "nested, the inner one first", step);
        const Mesh apart = joined(outer, mapped(inner, {1, 1, 1}, {10, 0, 0}));
        EXPECT_TRUE(Locator::build(apart)->certified());
        Mesh twice = outer;
        for (std::size_t i = 0; i < outer.corners(); ++i) twice.cells.push_back(outer.cells[7 * outer.corners() + i]);
        EXPECT_FALSE(Locator::build(twice)->certified());
        expect_proved(twice, "a cell twice", step);
        Mesh third = outer;  // a cell more at an inner facet, with a node of its own
        for (std::size_t i = 0; i + 1 < outer.corners(); ++i)
            third.cells.push_back(outer.cells[(outer.cell_count() / 2) * outer.corners() + i]);
        third.cells.push_back(
            add_node(third, d == 2 ? std::vector<double>{2.3, 2.6} : std::vector<double>{2.3, 2.6, 2.9}));
        EXPECT_FALSE(Locator::build(third)->certified());
        expect_proved(third, "a third cell at a facet", step);
    }
}

/// Cells around a node (3D: an edge), more than are asked pair by pair.
Mesh fan(int d, int blades) {
    Mesh mesh;
    mesh.dimension = d;
    const auto add = [&](double x, double y, double z) {
        return add_node(mesh, d == 2 ? std::vector<double>{x, y} : std::vector<double>{x, y, z});
    };
    const Mesh::Index low = add(0, 0, 0), high = d == 2 ? low : add(0, 0, 1);
    for (int i = 0; i < blades; ++i) {
        const double turn = 2 * std::numbers::pi * i / blades;
        add(std::cos(turn), std::sin(turn), 0.5);
    }
    const Mesh::Index first = high + 1;
    for (int i = 0; i < blades; ++i) {
        mesh.cells.push_back(low);
        if (d == 3) mesh.cells.push_back(high);
        mesh.cells.push_back(first + i);
        mesh.cells.push_back(first + (i + 1) % blades);
    }
    return mesh;
}

TEST(IndexProof, CrowdedNodes) {
    for (const int d : {2, 3}) {
        const Mesh good = fan(d, 300);
        EXPECT_TRUE(Locator::build(good)->certified());
        Mesh folded = good;
        for (int k = 0; k < 2; ++k) folded.points[static_cast<std::size_t>(d * (d + 7) + k)] *= -0.9;
        Mesh more = good;  // a cell of its own across a few blades
        for (const double at : {0.3, 0.4, 0.5}) {
            const double x = 0.8 * std::cos(at), y = 0.8 * std::sin(at);
            more.cells.push_back(add_node(
                more, d == 2 ? std::vector<double>{x, y} : std::vector<double>{x, y * (1 + at), 0.4 + at / 8}));
        }
        if (d == 3) more.cells.push_back(add_node(more, {0.5, 0.3, 0.9}));
        for (const Mesh* const mesh : {&folded, &more}) {
            const Locator locator = Locator::build(*mesh).value();
            EXPECT_FALSE(locator.certified());
            EXPECT_GT(locator.contested_cells(), 0U);
            if (mesh == &more) {
                EXPECT_LT(locator.contested_cells(), 100U);
            }
            expect_proved(*mesh, mesh == &folded ? "a folded fan" : "a cell across a fan", 97);
        }
    }
}

template <class T>
bool same_bytes(const index::Buffer<T>& a, const index::Buffer<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.bytes()) == 0;
}

/// The start of each bin has its middle in the smallest block of bins around it that has any middle.
void expect_starts(const Mesh& mesh) {
    const Locator locator = Locator::build(mesh).value();
    const index::CellIndex& index = locate::LocatorData::of(locator).index;
    const std::size_t bins = index.bins.count(), corners = index.corners();
    EXPECT_LE(bins, 2 * mesh.cell_count());
    EXPECT_GT(bins, mesh.cell_count());
    std::vector<std::uint32_t> own;
    std::vector<std::size_t> middles(2 * bins, 0);  // of blocks: 1 is all, 2 and 3 are its halves
    for (std::size_t place = 0; place < mesh.cell_count(); ++place) {
        std::array<double, 3> middle{};
        for (std::size_t i = 0; i < corners; ++i)
            for (std::size_t k = 0; k < index.dimension(); ++k)
                middle[k] += index.corner_points(static_cast<Place>(place))[i][k] / static_cast<double>(corners);
        own.push_back(index.bins.of(middle.data()));
        for (std::size_t block = bins + own.back(); block != 0; block /= 2) ++middles[block];
    }
    std::size_t wrong = 0, empty = 0;
    ASSERT_EQ(index.start.size(), bins);
    for (std::size_t bin = 0; bin < bins; ++bin) {
        const Place start = index.start[bin];
        ASSERT_TRUE(start >= 0 && static_cast<std::size_t>(start) < own.size());
        std::size_t block = bins + bin, of_start = bins + own[static_cast<std::size_t>(start)];
        empty += middles[block] == 0 ? 1U : 0U;
        for (; middles[block] == 0; block /= 2) of_start /= 2;
        wrong += block == of_start ? 0U : 1U;
    }
    EXPECT_GT(empty, 0U);
    EXPECT_EQ(wrong, 0U) << "of " << bins;
}

TEST(IndexProof, WalksStartNearTheirBins) {
    for (const char* stem : {"bracket", "plate", "torus"}) expect_starts(own_mesh(stem));
    Mesh hexahedra;
    hexahedra.points = box(3, {5, 4, 3}).points;
    for (const int corner : {0, 1, 2, 3, 6, 7, 8, 9, 12, 13, 14, 30, 36, 42, 60}) {
        std::vector<Mesh::Index> nodes;
        for (const int step : {0, 1, 7, 6, 30, 31, 37, 36}) nodes.push_back(corner + step);
        test::add_shape(hexahedra, 12, nodes);
    }
    test::cut(hexahedra);
    ASSERT_GE(hexahedra.cell_count(), 75U);
    expect_starts(hexahedra);
}

TEST(IndexProof, D1TheIndexHasTheSameBytesForAnyNumberOfThreads) {
    const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, 8);
    base::Random random(4);
    for (const int d : {2, 3}) {
        Mesh mesh = renumbered(folded_box(d, d == 2 ? 150 : 20), random);  // several blocks
        flip_some(mesh, random);
        const Locator one = Locator::build(mesh, {.threads = 1}).value();
        for (const int threads : {2, 3, 8}) {
            const Locator other = Locator::build(mesh, {.threads = threads}).value();
            const auto &a = locate::LocatorData::of(one), &b = locate::LocatorData::of(other);
            EXPECT_TRUE(same_bytes(a.index.cells, b.index.cells) && same_bytes(a.index.nodes, b.index.nodes) &&
                        same_bytes(a.index.original, b.index.original))
                << threads;
            EXPECT_TRUE(same_bytes(a.index.start, b.index.start));
            EXPECT_EQ(a.index.original_node, b.index.original_node);
            EXPECT_EQ(a.parts.proved()->proof.contested, b.parts.proved()->proof.contested);
        }
    }
}

// Links are the neighbours that the mesh module computes in its own way, and open facets the rest.
TEST(IndexProof, LinksAreNeighbours) {
    base::Random random(5);
    for (const int d : {2, 3}) {
        Mesh subject = renumbered(box(d, d == 2 ? std::array{140, 120, 0} : std::array{19, 17, 18}), random);
        flip_some(subject, random);
        const std::vector<Mesh::Index> neighbours = mesh::compute_neighbours(subject);
        const Locator locator = Locator::build(subject).value();
        EXPECT_TRUE(locator.certified());
        const auto& index = locate::LocatorData::of(locator).index;
        for (std::size_t p = 0; p < index.cell_count(); ++p) {
            for (std::size_t i = 0; i < subject.corners(); ++i) {
                const auto cell = static_cast<std::size_t>(index.original[p]);
                const Place next = index.cells[p].next[i];
                const Mesh::Index linked = next < 0 ? -1 : index.original[static_cast<std::size_t>(next)];
                ASSERT_EQ(linked, neighbours[subject.corners() * cell + i]) << d;
            }
        }
    }
}

}  // namespace
}  // namespace barycert::testing
