#include "mesh/cell_rings.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "mesh/face_cut.hpp"

namespace barycert::mesh {
namespace {

using Index = Mesh::Index;

bool follows(const std::vector<Index>& ring, Index a, Index b) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
        if (ring[i] == a && ring[(i + 1) % ring.size()] == b) return true;
    }
    return false;
}

/// The parts of a ring between the places where it passes a node again.
void add_loops(std::vector<Index> ring, Rings& loops) {
    for (std::size_t last = 1; last < ring.size(); ++last) {
        for (std::size_t first = last; first-- > 0;) {
            if (ring[first] != ring[last]) continue;
            const auto begin = ring.begin() + static_cast<std::ptrdiff_t>(first);
            const auto end = ring.begin() + static_cast<std::ptrdiff_t>(last);
            loops.emplace_back(begin, end);
            ring.erase(begin, end);
            last = first;
            break;
        }
    }
    loops.push_back(std::move(ring));
}

}  // namespace

void drop_repeated(Rings& rings) {
    for (auto& ring : rings) {
        ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
        if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    }
    std::erase_if(rings, [](const auto& ring) { return ring.size() < 3; });
}

bool turn_alike(Rings& rings) {
    std::unordered_map<Index, std::vector<std::size_t>> of_node;
    for (std::size_t r = 0; r < rings.size(); ++r) {
        for (const Index node : rings[r]) {
            auto& own = of_node[node];
            if (own.empty() || own.back() != r) own.push_back(r);  // a ring may have a node twice
        }
    }
    std::vector<bool> known(rings.size(), false);
    std::vector<std::size_t> next;
    for (std::size_t first = 0; first < rings.size(); ++first) {
        if (known[first]) continue;
        known[first] = true;
        next.push_back(first);
        while (!next.empty()) {
            const std::size_t own = next.back();
            next.pop_back();
            for (std::size_t i = 0; i < rings[own].size(); ++i) {
                const Index a = rings[own][i], b = rings[own][(i + 1) % rings[own].size()];
                std::size_t others = 0;
                for (const std::size_t r : of_node[a]) {
                    if (r == own) continue;
                    const bool same = follows(rings[r], a, b);
                    if (!same && !follows(rings[r], b, a)) continue;
                    ++others;
                    if (known[r] && same) return false;
                    if (known[r]) continue;
                    if (same) std::ranges::reverse(rings[r]);
                    known[r] = true;
                    next.push_back(r);
                }
                if (others != 1) return false;
            }
        }
    }
    return !rings.empty();
}

void collapse(const NumberedNodes& nodes, Rings& rings) {
    std::vector<Index> own;
    for (const auto& ring : rings) own.insert(own.end(), ring.begin(), ring.end());
    const auto place = [&](Index node) { return std::span(nodes.at(node), static_cast<std::size_t>(nodes.dimension)); };
    const auto before = [&](Index a, Index b) {
        const auto order =
            std::lexicographical_compare_three_way(place(a).begin(), place(a).end(), place(b).begin(), place(b).end());
        return order < 0 || (order == 0 && nodes.lower(a, b));
    };
    std::ranges::sort(own, before);
    own.erase(std::unique(own.begin(), own.end()), own.end());
    std::unordered_map<Index, Index> twins;
    for (std::size_t i = 1, kept = 0; i < own.size(); ++i) {
        if (std::ranges::equal(place(own[i]), place(own[kept])))
            twins[own[i]] = own[kept];
        else
            kept = i;
    }
    Rings loops;
    for (auto& ring : rings) {
        for (Index& node : ring) {
            const auto twin = twins.find(node);
            node = twin == twins.end() ? node : twin->second;
        }
    }
    drop_repeated(rings);
    for (auto& ring : rings) add_loops(std::move(ring), loops);
    drop_repeated(loops);
    rings = std::move(loops);
}

}  // namespace barycert::mesh
