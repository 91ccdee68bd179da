#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "barycert/defect.hpp"
#include "barycert/mesh.hpp"
#include "mesh/check/stages.hpp"
#include "mesh/index/box_tree.hpp"

namespace barycert::check {
namespace {

std::array<double, 3> node_place(const Mesh& mesh, Mesh::Index node) {
    std::array<double, 3> at{0, 0, 0};
    std::copy_n(mesh.point(node), mesh.dimension, at.begin());
    return at;
}

}  // namespace

void mark_used(const std::vector<Mesh::Index>& indices, std::vector<std::uint8_t>& used) {
    for (const Mesh::Index i : indices) {
        if (i >= 0 && static_cast<std::size_t>(i) < used.size()) used[static_cast<std::size_t>(i)] = 1;
    }
}

std::vector<std::uint8_t> find_finite(const std::vector<double>& points, int d, const std::vector<std::uint8_t>& used,
                                      DefectList& defects) {
    std::vector<std::uint8_t> finite(used.size(), 1);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!std::isfinite(points[i])) finite[i / static_cast<std::size_t>(d)] = 0;
    }
    for (std::size_t i = 0; i < used.size(); ++i) {
        const DefectPlace place{.nodes = {static_cast<Mesh::Index>(i), -1, -1}};
        if (used[i] == 0) defects.add(DefectKind::unused_node, place);
        if (finite[i] == 0) defects.add(DefectKind::not_finite, place);
    }
    return finite;
}

void check_nodes(Checked& c) {
    std::vector<std::uint8_t> used(c.mesh.point_count(), 0);
    mark_used(c.mesh.cells, used);
    const std::vector<std::uint8_t> vertex = used;
    for (const auto* const nodes : {&c.mesh.mid_nodes, &c.mesh.shapes.nodes, &c.mesh.shapes.rings})
        mark_used(*nodes, used);
    c.finite = find_finite(c.mesh.points, c.mesh.dimension, used, c.defects);
    std::vector<Mesh::Index> nodes;
    nodes.reserve(used.size());
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (c.finite[i] != 0) nodes.push_back(static_cast<Mesh::Index>(i));
    }
    for (const auto& [first, second] : coincident_nodes(c.mesh, nodes)) {
        c.defects.add(DefectKind::coincident_nodes, {.nodes = {first, second, -1}});
        // Two that cells have for vertices are why these cells do not meet in a common face.
        if (vertex[static_cast<std::size_t>(first)] != 0 && vertex[static_cast<std::size_t>(second)] != 0)
            c.defects[DefectKind::coincident_nodes].cause = true;
    }
}

Box box_around(const Mesh& mesh, Mesh::Index node, double radius) {
    Box box{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(mesh.dimension); ++k) {
        box.low[k] = mesh.point(node)[k] - radius;
        box.high[k] = mesh.point(node)[k] + radius;
    }
    return box;
}

double node_distance(const Mesh& mesh, Mesh::Index a, Mesh::Index b) {
    const auto p = node_place(mesh, a), q = node_place(mesh, b);
    return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

std::vector<std::array<Mesh::Index, 2>> coincident_nodes(const Mesh& mesh, const std::vector<Mesh::Index>& nodes) {
    struct PlacedNode {
        std::array<double, 3> at;
        Mesh::Index node;
    };
    std::vector<PlacedNode> placed;
    placed.reserve(nodes.size());
    for (const Mesh::Index n : nodes) placed.push_back({node_place(mesh, n), n});
    tbb::parallel_sort(placed.begin(), placed.end(), [](const PlacedNode& a, const PlacedNode& b) {
        return a.at != b.at ? a.at < b.at : a.node < b.node;
    });
    std::vector<std::array<Mesh::Index, 2>> pairs;
    for (std::size_t i = 1, first = 0; i < placed.size(); ++i) {
        if (placed[i].at != placed[first].at)
            first = i;
        else
            pairs.push_back({placed[first].node, placed[i].node});
    }
    std::ranges::sort(pairs, {}, [](const auto& pair) { return pair[1]; });
    return pairs;
}

bool for_each_near(const Mesh& mesh, const std::vector<Mesh::Index>& nodes, const std::vector<double>& radius,
                   std::size_t limit, const std::function<void(const NearPair&)>& found) {
    std::vector<Box> boxes(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) boxes[i] = box_around(mesh, nodes[i], radius[i]);
    const BoxTree tree(std::move(boxes));
    const auto near_after = [&](std::size_t i, auto&& use) {
        const auto at = node_place(mesh, nodes[i]);
        return tree.for_each(Box{at, at}, [&](std::uint32_t j) {
            if (j <= i) return true;
            const double apart = node_distance(mesh, nodes[i], nodes[j]);
            return apart > std::min(radius[i], radius[j]) || use(NearPair{nodes[i], nodes[j], apart});
        });
    };
    // The pairs of one wave are kept at a time, and of these no more than anybody wants.
    constexpr std::size_t wave = 1 << 16;
    for (std::size_t begin = 0; begin < nodes.size(); begin += wave) {
        const std::size_t end = std::min(nodes.size(), begin + wave), room = std::min(limit, 64 * wave);
        std::atomic<std::size_t> count = 0;
        in_blocks(
            end - begin, 1024, std::vector<NearPair>(),
            [&](std::size_t first, std::size_t last, std::vector<NearPair>& part) {
                const auto keep = [&](const NearPair& p) {
                    part.push_back(p);
                    return ++count <= room;
                };
                for (std::size_t i = begin + first; i < begin + last && near_after(i, keep); ++i) {
                }
            },
            [&](const std::vector<NearPair>& part) {
                if (count <= room) std::ranges::for_each(part, found);
            });
        if (count > room) {
            // Which of them were found first depends on threads: the first in order are found once more.
            std::size_t left = room;
            const auto tell = [&](const NearPair& p) { return left > 0 && (found(p), --left > 0); };
            for (std::size_t i = begin; i < end && left > 0; ++i) near_after(i, tell);
            return false;
        }
        limit -= count;
    }
    return true;
}

}  // namespace barycert::check
