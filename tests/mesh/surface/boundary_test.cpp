// The boundary of a mesh: which facets, turned outwards, closed.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "barycert/predicates.hpp"
#include "barycert/surface.hpp"
#include "tests/mesh/check/random_complexes.hpp"
#include "tests/mesh/surface/fields.hpp"
#include "tests/mesh/surface/judge.hpp"

namespace barycert::testing {
namespace {

using Index = Mesh::Index;

/// The facets that one cell alone has, by the sets of their nodes.
std::map<std::set<Index>, Index> single_facets(const Mesh& mesh) {
    std::map<std::set<Index>, std::vector<Index>> all;
    const std::size_t n = mesh.corners();
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        for (std::size_t i = 0; i < n; ++i) {
            std::set<Index> facet;
            for (std::size_t j = 0; j < n; ++j) {
                if (j != i) facet.insert(mesh.cells[n * c + j]);
            }
            all[facet].push_back(static_cast<Index>(c));
        }
    }
    std::map<std::set<Index>, Index> single;
    for (const auto& [facet, cells] : all) {
        if (cells.size() == 1) single[facet] = cells.front();
    }
    return single;
}

Surface expect_right_boundary(const Mesh& mesh, CutOptions options) {
    options.threads = 1;
    Surface s = boundary(mesh, options).value();
    const std::map<std::set<Index>, Index> expected = single_facets(mesh);
    EXPECT_EQ(s.cell_count(), expected.size());
    const std::size_t d = s.corners();
    std::set<Index> nodes;
    for (std::size_t f = 0; f < s.cell_count() && !::testing::Test::HasFailure(); ++f) {
        std::vector<Index> facet;
        for (std::size_t i = 0; i < d; ++i)
            facet.push_back(s.mesh_edges[2 * static_cast<std::size_t>(s.cells[d * f + i])]);
        nodes.insert(facet.begin(), facet.end());
        const auto found = expected.find({facet.begin(), facet.end()});
        if (found == expected.end()) {
            ADD_FAILURE() << "not a facet of one cell";
            break;
        }
        EXPECT_EQ(s.mesh_cells[f], found->second);
        if (f > 0) {
            EXPECT_LE(s.mesh_cells[f - 1], s.mesh_cells[f]);
        }
        // The fourth corner of the cell is behind it.
        for (std::size_t i = 0; i <= d; ++i) {
            const Index other = mesh.cells[(d + 1) * static_cast<std::size_t>(s.mesh_cells[f]) + i];
            if (std::find(facet.begin(), facet.end(), other) != facet.end()) continue;
            const auto at = [&](Index node) { return mesh.points.data() + d * static_cast<std::size_t>(node); };
            const Sign sign = d == 3 ? -orient3d(at(facet[0]), at(facet[1]), at(facet[2]), at(other))
                                     : orient2d(at(facet[0]), at(facet[1]), at(other));
            EXPECT_NE(sign, Sign::negative);
        }
    }
    EXPECT_EQ(nodes.size(), s.point_count());
    for (std::size_t v = 0; v < s.point_count(); ++v) {
        const auto node = static_cast<std::size_t>(s.mesh_edges[2 * v]);
        EXPECT_EQ(s.mesh_edges[2 * v], s.mesh_edges[2 * v + 1]);
        if (v > 0) {
            EXPECT_LT(s.mesh_edges[2 * v - 2], s.mesh_edges[2 * v]);
        }
        for (std::size_t k = 0; k < d; ++k) EXPECT_EQ(s.points[d * v + k], mesh.points[d * node + k]);
        for (std::size_t f = 0; f < s.point_fields.size(); ++f)
            EXPECT_EQ(s.point_fields[f].data[v], options.point_fields[f]->data[node]);
    }
    options.threads = 3;
    expect_same(s, boundary(mesh, options).value());
    return s;
}

TEST(Boundary, OfBoxesAndOfAnything) {
    for (const int d : {2, 3}) {
        for (std::uint64_t k = 0; k < 100 && !HasFailure(); ++k) {
            base::Random r = base::Random::stream(19, base::hash64("boundary"), k);
            const int which = static_cast<int>(k % 3);
            const Mesh mesh = which == 0 ? moved_box(r, d) : which == 1 ? grown_complex(d, r) : damaged_box(d, r);
            const Field f = random_field(r, "f", mesh.point_count(), 1, 1);
            const Field c = random_field(r, "c", mesh.cell_count(), 1, 1);
            expect_right_boundary(mesh, {.point_fields = {&f}, .cell_fields = {&c}});
        }
    }
}

TEST(Boundary, OfOwnMeshesIsClosed) {
    for (const char* const name : {"bracket", "flange", "torus", "cube-hole", "plate"}) {
        SCOPED_TRACE(name);
        const Surface s = expect_right_boundary(own_mesh(name), {});
        std::map<std::vector<Index>, int> chain;
        const std::size_t d = s.corners();
        for (std::size_t i = 0; i < s.cells.size(); ++i) {
            const Index a = s.cells[i], b = s.cells[i / d * d + (i + 1) % d];
            if (d == 2) {
                chain[{a}] += i % 2 == 0 ? 1 : -1;
            } else {
                chain[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
            }
        }
        for (const auto& [edge, count] : chain) EXPECT_EQ(count, 0);
    }
}

}  // namespace
}  // namespace barycert::testing
