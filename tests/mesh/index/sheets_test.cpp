// Open facets that border on the same insides: around ridges that many of them have.
#include "mesh/index/open_sheets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/locator.hpp"
#include "tests/mesh/check/meshes.hpp"

namespace barycert::testing {
namespace {

struct Sheets {
    std::size_t facets, conflicts, count;
};

Sheets sheets_of(const Mesh& mesh) {
    const ExactEnvironment environment;
    index::CellIndex index = index::make_cell_index(mesh);
    const index::FacetLinks links = index::link_facets(index);
    std::vector<index::PlacedFacet> facets;
    for (const index::CellFacet& facet : links.open) facets.push_back(index::placed(index, facet));
    const std::vector<std::uint8_t> conflict = index::find_conflicts(index, facets);
    return {facets.size(), static_cast<std::size_t>(std::count(conflict.begin(), conflict.end(), 1)),
            index::find_sheets(index, links.open, facets, conflict).size()};
}

using Side = std::array<double, 2>;

/// A cell a wedge, in any order around the ridge that all of them have (2D: a node). Equal sides are one facet.
Mesh wedges(int d, const std::vector<std::array<Side, 2>>& cells) {
    Mesh mesh;
    mesh.dimension = d;
    const auto add = [&](double x, double y, double z) {
        return add_node(mesh, d == 2 ? std::vector<double>{x, y} : std::vector<double>{x, y, z});
    };
    const Mesh::Index low = add(0, 0, -1), high = d == 2 ? low : add(0, 0, 2);
    std::map<Side, Mesh::Index> nodes;
    for (const auto& sides : cells) {
        mesh.cells.push_back(low);
        if (d == 3) mesh.cells.push_back(high);
        for (const Side& side : sides) {
            const auto [at, is_new] = nodes.try_emplace(side);
            if (is_new) at->second = add(side[0], side[1], 0);
            mesh.cells.push_back(at->second);
        }
    }
    return mesh;
}

TEST(IndexSheets, GoOnOverRidgesWhereManyMeet) {
    for (const int d : {2, 3}) {
        // Three cells, between them gaps; the last side is half a turn from the first.
        const Mesh apart = wedges(d, {{{{2, 0}, {1, 1}}}, {{{-1, -3}, {1, -2}}}, {{{-1, 4}, {-2, 0}}}});
        const Sheets found = sheets_of(apart);
        EXPECT_EQ(found.facets, 3U * (static_cast<std::size_t>(d) + 1));
        EXPECT_EQ(found.conflicts, 0U);
        EXPECT_EQ(found.count, 1U);
        EXPECT_TRUE(Locator::build(apart)->certified());
    }
}

// No facet meets another but in the ridge.
TEST(IndexSheets, OfACellWithinOthersAreTwo) {
    const std::array<Side, 2> small{{{0.5, 0.125}, {0.25, 0.5}}};
    const std::vector<std::vector<std::array<Side, 2>>> cases{
        {{{{8, 0}, {-7, 8}}}, small},
        {small, {{{1, -8}, {-9, -9}}}, {{{8, 0}, {-7, 8}}}},
        {{{{8, 0}, {0, 8}}}, small, {{{0, 8}, {-8, 0}}}},  // both make half a turn
    };
    for (const int d : {2, 3}) {
        for (const auto& sides : cases) {
            for (int turned = 0; turned < 8; ++turned) {
                std::vector<std::array<Side, 2>> cells = sides;
                for (auto& cell : cells) {
                    for (auto& [x, y] : cell) {
                        if ((turned & 1) != 0) x = -x;
                        if ((turned & 2) != 0) y = -y;
                        if ((turned & 4) != 0) std::swap(x, y);
                    }
                }
                const Mesh mesh = wedges(d, cells);
                const Sheets found = sheets_of(mesh);
                EXPECT_EQ(found.conflicts, 0U);
                EXPECT_EQ(found.count, 2U);
                EXPECT_FALSE(Locator::build(mesh)->certified());
            }
        }
    }
}

// Piece by piece they were a sheet for every few facets, and each had to be asked for.
TEST(IndexSheets, OfScatteredCellsAreFew) {
    for (const int d : {2, 3}) {
        base::Random random(3);
        const Mesh whole = box(d, d == 2 ? std::array{60, 60, 0} : std::array{12, 12, 12});
        Mesh half = whole;
        half.cells.clear();
        for (std::size_t c = 0; c < whole.cell_count(); ++c) {
            if (random.coin()) continue;
            for (std::size_t i = 0; i < whole.corners(); ++i)
                half.cells.push_back(whole.cells[whole.corners() * c + i]);
        }
        const Sheets found = sheets_of(half);
        EXPECT_EQ(found.conflicts, 0U);
        EXPECT_LT(found.count, found.facets / 50) << d;
        EXPECT_TRUE(Locator::build(half)->certified());
    }
}

}  // namespace
}  // namespace barycert::testing
