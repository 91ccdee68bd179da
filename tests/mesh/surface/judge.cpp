#include "tests/mesh/surface/judge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "tests/core/rational.hpp"

namespace barycert::testing {
namespace {

using testing_rational::bits;
using testing_rational::nearest;
using Q = mpq_class;
using Index = Mesh::Index;
using Vector = std::vector<Q>;

/// A point by its edge: lower node, higher node.
using Key = std::pair<Index, Index>;

Q determinant(const std::vector<Vector>& rows) {
    if (rows.size() == 2) return rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0];
    return rows[0][0] * (rows[1][1] * rows[2][2] - rows[1][2] * rows[2][1]) -
           rows[0][1] * (rows[1][0] * rows[2][2] - rows[1][2] * rows[2][0]) +
           rows[0][2] * (rows[1][0] * rows[2][1] - rows[1][1] * rows[2][0]);
}

/// Sign of the volume or area of d + 1 points.
int side(const std::vector<Vector>& points) {
    std::vector<Vector> rows;
    for (std::size_t i = 1; i < points.size(); ++i) {
        Vector row;
        for (std::size_t k = 0; k < points[0].size(); ++k) row.push_back(points[i][k] - points[0][k]);
        rows.push_back(row);
    }
    return sgn(determinant(rows));
}

class Judge {
public:
    Judge(const Mesh& mesh, const Heights& heights, const Cut& cut, const CutOptions& options, const Allowed& allowed)
        : mesh_(mesh),
          heights_(heights),
          surface_(cut.surface),
          counts_(cut.counts),
          options_(options),
          allowed_(allowed),
          d_(mesh.corners() - 1) {}

    void judge() {
        ASSERT_EQ(surface_.dimension, mesh_.dimension);
        ASSERT_EQ(surface_.mesh_edges.size(), 2 * surface_.point_count());
        ASSERT_EQ(surface_.mesh_cells.size(), surface_.cell_count());
        points();
        cells();
        if (!allowed_.any_complex) boundary();
        fields_of_cells();
    }

private:
    Index end(std::size_t point, std::size_t i) const { return surface_.mesh_edges[2 * point + i]; }
    const Q& height(Index node) const { return *heights_[static_cast<std::size_t>(node)]; }
    Key key(std::size_t point) const { return std::minmax(end(point, 0), end(point, 1)); }

    const Index* corners(std::size_t cell) const { return &mesh_.cells[(d_ + 1) * cell]; }

    bool used(std::size_t cell) const {
        return std::all_of(corners(cell), corners(cell) + d_ + 1,
                           [&](Index n) { return heights_[static_cast<std::size_t>(n)].has_value(); });
    }

    /// The number that is x at `in` and y at `out`, where g is zero.
    Q crossing(std::size_t point, double x, double y) const {
        if (end(point, 0) == end(point, 1)) return Q(x);
        const Q in = height(end(point, 0)), out = height(end(point, 1));
        return Q(x) + (Q(y) - Q(x)) * in / (in - out);
    }

    Vector exact_point(std::size_t point) const {
        Vector x;
        for (std::size_t k = 0; k < d_; ++k)
            x.push_back(crossing(point, mesh_.points[d_ * static_cast<std::size_t>(end(point, 0)) + k],
                                 mesh_.points[d_ * static_cast<std::size_t>(end(point, 1)) + k]));
        return x;
    }
    Vector node(Index n) const {
        Vector x;
        for (std::size_t k = 0; k < d_; ++k) x.push_back(Q(mesh_.points[d_ * static_cast<std::size_t>(n) + k]));
        return x;
    }

    /// K1 and K4.
    void points() {
        std::set<Index> met(surface_.cells.begin(), surface_.cells.end());
        EXPECT_EQ(met.size(), surface_.point_count()) << "a point of no triangle";
        std::uint64_t at_nodes = 0;
        for (std::size_t v = 0; v < surface_.point_count() && !::testing::Test::HasFailure(); ++v) {
            if (v > 0) {
                EXPECT_LT(key(v - 1), key(v)) << "points are not in order, each once";
            }
            at_nodes += end(v, 0) == end(v, 1) ? 1 : 0;
            EXPECT_EQ(sgn(height(end(v, 0))), end(v, 0) == end(v, 1) ? 0 : 1);
            if (end(v, 0) != end(v, 1)) {
                EXPECT_EQ(sgn(height(end(v, 1))), -1);
            }
            const Vector x = exact_point(v);
            for (std::size_t k = 0; k < d_; ++k) EXPECT_TRUE(nearest(surface_.points[d_ * v + k], x[k])) << v;
            fields(v);
        }
        EXPECT_EQ(counts_.at_nodes, at_nodes);
        EXPECT_EQ(counts_.on_edges, surface_.point_count() - at_nodes);
        EXPECT_EQ(counts_.tiers.cases(), counts_.on_edges);
    }

    void fields(std::size_t v) const {
        ASSERT_EQ(surface_.point_fields.size(), options_.point_fields.size());
        for (std::size_t f = 0; f < options_.point_fields.size(); ++f) {
            const Field& from = *options_.point_fields[f];
            const Field& to = surface_.point_fields[f];
            const auto components = static_cast<std::size_t>(from.components);
            ASSERT_EQ(to.name, from.name);
            ASSERT_EQ(to.components, from.components);
            ASSERT_EQ(to.data.size(), components * surface_.point_count());
            for (std::size_t c = 0; c < components; ++c) {
                const double x = from.data[components * static_cast<std::size_t>(end(v, 0)) + c];
                const double y = from.data[components * static_cast<std::size_t>(end(v, 1)) + c];
                const double found = to.data[components * v + c];
                if (std::isfinite(x) && std::isfinite(y)) {
                    EXPECT_TRUE(nearest(found, crossing(v, x, y)));
                } else if (end(v, 0) == end(v, 1) && !std::isnan(x)) {
                    EXPECT_EQ(found, x);
                } else {
                    EXPECT_TRUE(std::isnan(found));
                }
            }
        }
    }

    /// Which crossings a cell has, by its corners.
    std::set<Key> crossings(const Index* corners, std::size_t count) const {
        std::set<Key> all;
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t j = 0; j < count; ++j) {
                if (height(corners[i]) < 0 || height(corners[j]) >= 0) continue;
                all.insert(height(corners[i]) == 0 ? Key{corners[i], corners[i]}
                                                   : Key(std::minmax(corners[i], corners[j])));
            }
        }
        return all;
    }

    /// Each cell has the triangles of its crossings, turned outwards: K3.
    void cells() {
        std::map<Index, std::vector<std::size_t>> parts;
        for (std::size_t t = 0; t < surface_.cell_count(); ++t) {
            if (t > 0) {
                EXPECT_LE(surface_.mesh_cells[t - 1], surface_.mesh_cells[t]);
            }
            parts[surface_.mesh_cells[t]].push_back(t);
        }
        std::uint64_t left_out = 0;
        for (std::size_t c = 0; c < mesh_.cell_count() && !::testing::Test::HasFailure(); ++c) {
            const std::vector<std::size_t>& own = parts[static_cast<Index>(c)];
            if (!used(c)) {
                ++left_out;
                EXPECT_TRUE(own.empty());
                continue;
            }
            const std::set<Index> nodes(corners(c), corners(c) + d_ + 1);
            if (nodes.size() != d_ + 1) {
                EXPECT_TRUE(own.empty());
                continue;
            }
            const std::set<Key> expected = crossings(corners(c), d_ + 1);
            EXPECT_EQ(own.size(), expected.size() < d_ ? 0 : expected.size() - d_ + 1);
            std::set<Key> found;
            for (const std::size_t t : own) {
                std::set<Key> distinct;
                for (std::size_t i = 0; i < d_; ++i)
                    distinct.insert(key(static_cast<std::size_t>(surface_.cells[d_ * t + i])));
                EXPECT_EQ(distinct.size(), d_) << "a point twice";
                found.insert(distinct.begin(), distinct.end());
                orientation(c, t);
            }
            if (!own.empty()) {
                EXPECT_EQ(found, expected);
            }
        }
        EXPECT_EQ(counts_.not_finite, left_out);
        EXPECT_EQ(counts_.cells,
                  std::count_if(parts.begin(), parts.end(), [](const auto& p) { return !p.second.empty(); }));
    }

    void orientation(std::size_t cell, std::size_t t) {
        std::vector<Vector> all;
        for (std::size_t i = 0; i < d_; ++i)
            all.push_back(exact_point(static_cast<std::size_t>(surface_.cells[d_ * t + i])));
        all.emplace_back();
        for (std::size_t i = 0; i <= d_; ++i) {
            const Index n = corners(cell)[i];
            all.back() = node(n);
            const int sign = sgn(height(n));
            if (sign == 0) continue;
            // In space the set lies behind a triangle, in the plane to the left of a segment.
            const int wanted = d_ == 3 ? -sign : sign;
            const int found = side(all);
            if (found == 0 && allowed_.flat_cells) continue;
            EXPECT_EQ(found, wanted) << "turned the wrong way";
        }
    }

    /// K2: what does not cancel out is exactly the edges of the surface in facets of one used cell, each turned as the
    /// cell has it. A chain: cells of a directed simplex count against those of its opposite.
    void boundary() {
        std::map<std::vector<Key>, int> chain;
        for (std::size_t t = 0; t < surface_.cell_count(); ++t) {
            const auto at = [&](std::size_t i) { return key(static_cast<std::size_t>(surface_.cells[d_ * t + i])); };
            for (std::size_t i = 0; i < d_; ++i) {
                if (d_ == 2) {
                    chain[{at(i)}] += i == 1 ? 1 : -1;
                } else {
                    add(chain, at(i), at((i + 1) % 3), 1);
                }
            }
        }
        for (const auto& [facet, cell] : single_facets()) {
            const std::set<Key> ends = crossings(facet.data(), d_);
            if (ends.size() < d_ - 1) continue;
            if (d_ == 2) {
                add_point(chain, facet, *ends.begin());
            } else {
                add_segment(chain, facet);
            }
        }
        std::erase_if(chain, [](const auto& entry) { return entry.second == 0; });
        EXPECT_TRUE(chain.empty()) << chain.size() << " open edges, or too many";
    }

    static void add(std::map<std::vector<Key>, int>& chain, const Key& a, const Key& b, int count) {
        if (a == b) return;
        chain[a < b ? std::vector<Key>{a, b} : std::vector<Key>{b, a}] += a < b ? count : -count;
    }

    /// The boundary of the set is the surface and the part of the mesh's boundary that is in the set; it has no rim. So
    /// the rim of the surface is that of the part, run the other way: adding the latter leaves nothing.
    void add_segment(std::map<std::vector<Key>, int>& chain, const std::vector<Index>& facet) const {
        for (std::size_t i = 0; i < 3; ++i) {
            const Index a = facet[i], b = facet[(i + 1) % 3], c = facet[(i + 2) % 3];
            const bool in_a = height(a) >= 0, in_b = height(b) >= 0, in_c = height(c) >= 0;
            const auto point = [&](Index in, Index out) {
                return height(in) == 0 ? Key{in, in} : Key(std::minmax(in, out));
            };
            // With the set to the left, seen from outside.
            if (in_a && !in_b && !in_c) add(chain, point(a, b), point(a, c), 1);
            if (!in_a && in_b && in_c) add(chain, point(c, a), point(b, a), 1);
        }
    }

    /// The same in the plane: the part of the edge from its first node to the point ends there, that to its second node
    /// begins there.
    void add_point(std::map<std::vector<Key>, int>& chain, const std::vector<Index>& facet, const Key& point) const {
        chain[{point}] += height(facet[0]) >= 0 ? 1 : -1;
    }

    /// Facets that one used cell alone has, turned so that its cell is behind them (2D: to their left).
    std::vector<std::pair<std::vector<Index>, std::size_t>> single_facets() const {
        std::map<std::vector<Index>, std::vector<std::pair<std::size_t, std::size_t>>> all;
        for (std::size_t c = 0; c < mesh_.cell_count(); ++c) {
            const std::set<Index> nodes(corners(c), corners(c) + d_ + 1);
            if (!used(c) || nodes.size() != d_ + 1) continue;
            for (std::size_t i = 0; i <= d_; ++i) {
                std::vector<Index> facet;
                for (std::size_t j = 0; j <= d_; ++j) {
                    if (j != i) facet.push_back(corners(c)[j]);
                }
                std::sort(facet.begin(), facet.end());
                all[facet].emplace_back(c, i);
            }
        }
        std::vector<std::pair<std::vector<Index>, std::size_t>> result;
        for (const auto& [facet, cells] : all) {
            if (cells.size() != 1) continue;
            std::vector<Index> turned = facet;
            std::vector<Vector> at;
            for (const Index n : facet) at.push_back(node(n));
            at.push_back(node(corners(cells[0].first)[cells[0].second]));
            const int sign = side(at);
            EXPECT_NE(sign, 0) << "the judge knows no side of a flat cell at the boundary";
            if (sign == (d_ == 3 ? 1 : -1)) std::swap(turned[0], turned[1]);
            result.emplace_back(turned, cells[0].first);
        }
        return result;
    }

    void fields_of_cells() const {
        ASSERT_EQ(surface_.cell_fields.size(), options_.cell_fields.size());
        for (std::size_t f = 0; f < options_.cell_fields.size(); ++f) {
            const Field& from = *options_.cell_fields[f];
            const Field& to = surface_.cell_fields[f];
            const auto components = static_cast<std::size_t>(from.components);
            ASSERT_EQ(to.data.size(), components * surface_.cell_count());
            for (std::size_t i = 0; i < to.data.size(); ++i) {
                const auto cell = static_cast<std::size_t>(surface_.mesh_cells[i / components]);
                EXPECT_EQ(bits(to.data[i]), bits(from.data[components * cell + i % components]));
            }
        }
    }

    const Mesh& mesh_;
    const Heights& heights_;
    const Surface& surface_;
    const CutCounts& counts_;
    const CutOptions& options_;
    const Allowed& allowed_;
    std::size_t d_;
};

std::vector<std::uint64_t> all_bits(const std::vector<double>& numbers) {
    std::vector<std::uint64_t> all;
    for (const double x : numbers) all.push_back(bits(x));
    return all;
}

}  // namespace

Heights heights_of(const Mesh& mesh, const Field& field, double value, int component) {
    Heights all(mesh.point_count());
    const auto components = static_cast<std::size_t>(field.components);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const double f = field.data[components * i + static_cast<std::size_t>(component)];
        if (std::isfinite(f)) all[i] = Q(f) - Q(value);
    }
    return all;
}

Heights heights_of(const Mesh& mesh, const Plane& plane) {
    Heights all(mesh.point_count());
    for (std::size_t i = 0; i < all.size(); ++i) {
        Q g(plane.offset);
        for (std::size_t k = 0; k < 3; ++k) g -= Q(plane.normal[k]) * Q(mesh.points[3 * i + k]);
        all[i] = g;
    }
    return all;
}

void expect_cut(const Mesh& mesh, const Heights& heights, const Cut& cut, const CutOptions& options,
                const Allowed& allowed) {
    Judge(mesh, heights, cut, options, allowed).judge();
}

void expect_same(const Surface& a, const Surface& b) {
    EXPECT_EQ(all_bits(a.points), all_bits(b.points));
    EXPECT_EQ(a.cells, b.cells);
    EXPECT_EQ(a.mesh_cells, b.mesh_cells);
    EXPECT_EQ(a.mesh_edges, b.mesh_edges);
    ASSERT_EQ(a.point_fields.size(), b.point_fields.size());
    for (std::size_t f = 0; f < a.point_fields.size(); ++f)
        EXPECT_EQ(all_bits(a.point_fields[f].data), all_bits(b.point_fields[f].data));
    ASSERT_EQ(a.cell_fields.size(), b.cell_fields.size());
    for (std::size_t f = 0; f < a.cell_fields.size(); ++f)
        EXPECT_EQ(all_bits(a.cell_fields[f].data), all_bits(b.cell_fields[f].data));
}

}  // namespace barycert::testing
