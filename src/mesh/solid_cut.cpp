#include "mesh/solid_cut.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/predicates.hpp"
#include "mesh/face_cut.hpp"
#include "mesh/tetrahedra_search.hpp"

namespace barycert::mesh {
namespace {

using Index = Mesh::Index;
using NodePair = std::array<Index, 2>;

NodePair edge_of(Index a, Index b) {
    return {std::min(a, b), std::max(a, b)};
}

NodeTriangle sorted(NodeTriangle triangle) {
    std::ranges::sort(triangle);
    return triangle;
}

/// Its order is an even permutation of the ascending one.
bool is_even(const NodeTriangle& t) {
    return (t[0] < t[1]) == ((t[1] < t[2]) == (t[0] < t[2]));
}

bool has(const NodeTriangle& triangle, Index node) {
    return std::ranges::count(triangle, node) != 0;
}

/// The faces of a cell in triangles.
class SolidBoundary {
public:
    SolidBoundary(const NumberedNodes& nodes, const std::vector<std::vector<Index>>& rings) {
        for (const std::vector<Index>& ring : rings) {
            for (std::size_t i = 0; i < ring.size(); ++i)
                cell_edges_.push_back(edge_of(ring[i], ring[(i + 1) % ring.size()]));
            const std::size_t first = triangles_.size();
            if (cut_face(nodes, ring, triangles_)) {
                const Index lowest = *std::ranges::min_element(ring, {}, [&](Index n) { return nodes.number(n); });
                for (std::size_t i = first; i < triangles_.size(); ++i)
                    at_lowest_ = at_lowest_ && has(triangles_[i], lowest);
                continue;
            }
            if (!on_one_line(nodes, ring)) {
                is_cut_ = false;
                return;
            }
            // A face without an area, between edges of others: only a node of all its triangles can see the cell.
            for (std::size_t i = 1; i + 1 < ring.size(); ++i) triangles_.push_back({ring[0], ring[i], ring[i + 1]});
            has_lines_ = true;
        }
        cancel();
        for (const NodeTriangle& t : triangles_) {
            for (std::size_t i = 0; i < 3; ++i) face_edges_.push_back(edge_of(t[i], t[(i + 1) % 3]));
            sorted_.push_back(sorted(t));
        }
        for (auto* const edges : {&cell_edges_, &face_edges_}) std::ranges::sort(*edges);
        std::ranges::sort(sorted_);
    }

    bool is_cut() const { return is_cut_; }
    bool at_lowest() const { return at_lowest_; }
    bool has_lines() const { return has_lines_; }
    const std::vector<NodeTriangle>& triangles() const { return triangles_; }

    /// Bits that tell which parts of a part's boundary lie inside the cell (feature_of_whole).
    std::uint16_t inside(const std::array<Index, 4>& c) const {
        unsigned bits = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const NodeTriangle facet = sorted({c[(k + 1) % 4], c[(k + 2) % 4], c[(k + 3) % 4]});
            if (!std::ranges::binary_search(sorted_, facet)) bits |= 1U << k;
        }
        unsigned shift = 4;
        for (const auto& [i, j] : {std::pair(0U, 1U), {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}) {
            const NodePair edge = edge_of(c[i], c[j]);
            const bool of_cell = std::ranges::binary_search(cell_edges_, edge);
            const bool of_face = std::ranges::binary_search(face_edges_, edge);
            bits |= (of_face ? (of_cell ? 0U : 1U) : 2U) << shift;
            shift += 2;
        }
        return static_cast<std::uint16_t>(bits);
    }

private:
    /// Triangles that a cell has from both sides, as collapsed ones may, bound nothing.
    void cancel() {
        struct Side {
            NodeTriangle nodes;
            bool even;
            std::size_t number;
            auto operator<=>(const Side&) const = default;  // NOLINT(modernize-use-nullptr)
        };
        std::vector<Side> sides;
        for (std::size_t i = 0; i < triangles_.size(); ++i)
            sides.push_back({sorted(triangles_[i]), is_even(triangles_[i]), i});
        std::ranges::sort(sides);
        std::vector<bool> gone(triangles_.size(), false);
        for (std::size_t i = 0, next = 0; i < sides.size(); i = next) {
            std::size_t odd = i;
            while (next < sides.size() && sides[next].nodes == sides[i].nodes) odd += sides[next++].even ? 0U : 1U;
            for (std::size_t k = 0; k < std::min(odd - i, next - odd); ++k)
                gone[sides[i + k].number] = gone[sides[odd + k].number] = true;
        }
        std::size_t to = 0;
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            if (!gone[i]) triangles_[to++] = triangles_[i];
        }
        triangles_.resize(to);
    }

    std::vector<NodeTriangle> triangles_, sorted_;
    std::vector<NodePair> cell_edges_, face_edges_;
    bool is_cut_ = true, at_lowest_ = true, has_lines_ = false;
};

/// All triangles that do not have the node lie strictly on one side of it.
bool sees_all(const NumberedNodes& nodes, const std::vector<NodeTriangle>& triangles, Index apex) {
    Sign side = Sign::zero;
    for (const NodeTriangle& t : triangles) {
        if (has(t, apex)) continue;
        const Sign own = orient3d(nodes.at(apex), nodes.at(t[0]), nodes.at(t[1]), nodes.at(t[2]));
        if (own == Sign::zero || (side != Sign::zero && own != side)) return false;
        side = own;
    }
    return side != Sign::zero;
}

}  // namespace

Parts cut_solid(const NumberedNodes& nodes, const std::vector<std::vector<Index>>& rings) {
    Parts parts;
    const SolidBoundary boundary(nodes, rings);
    if (!boundary.is_cut() || boundary.triangles().empty()) return parts;
    std::vector<Index> own;
    for (const NodeTriangle& t : boundary.triangles()) own.insert(own.end(), t.begin(), t.end());
    std::ranges::sort(own, {}, [&](Index node) { return nodes.number(node); });
    own.erase(std::unique(own.begin(), own.end()), own.end());
    const auto apex =
        std::ranges::find_if(own, [&](Index node) { return sees_all(nodes, boundary.triangles(), node); });
    parts.at_lowest = boundary.at_lowest() && apex == own.begin();
    if (apex != own.end()) {
        for (const NodeTriangle& t : boundary.triangles()) {
            if (!has(t, *apex)) parts.corners.push_back({*apex, t[0], t[1], t[2]});
        }
    } else if (!boundary.has_lines()) {
        parts.corners = find_tetrahedra(nodes, own, boundary.triangles());
    }
    for (const auto& corners : parts.corners) parts.inside.push_back(boundary.inside(corners));
    return parts;
}

}  // namespace barycert::mesh
