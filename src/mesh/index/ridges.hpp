/// The d - 1 nodes of a facet that another one may share: an edge in 3D, a node in 2D.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "mesh/threads/arena.hpp"

namespace barycert::index {

struct Ridge {
    std::uint64_t nodes;  ///< of two, the lower one in the upper half
    std::uint32_t facet;
    std::uint32_t other;  ///< which of the facet's nodes it does not have
};

/// Returns the ridges of all facets, which have their `nodes`; equal ones side by side, by facet. Memory: 4 bytes a
/// node, up to the highest.
template <class Facet>
std::vector<Ridge> ridges_of(int d, const std::vector<Facet>& facets) {
    const auto n = static_cast<std::size_t>(d);
    const auto ridge = [&](std::size_t f, std::size_t i) {
        const auto node = [&](std::size_t k) { return static_cast<std::uint64_t>(facets[f].nodes[k]); };
        const std::uint64_t x = node(d == 2 ? 1 - i : (i + 1) % 3), y = d == 2 ? 0 : node((i + 2) % 3);
        return Ridge{d == 2 ? x : std::min(x, y) << 32 | std::max(x, y), static_cast<std::uint32_t>(f),
                     static_cast<std::uint32_t>(i)};
    };
    // By the lower node, then the few of each.
    const auto lower = [&](const Ridge& r) { return static_cast<std::size_t>(d == 2 ? r.nodes : r.nodes >> 32); };
    std::vector<std::uint32_t> next;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t node = lower(ridge(f, i));
            if (node >= next.size()) next.resize(std::max(node + 1, 2 * next.size()));
            ++next[node];
        }
    }
    std::exclusive_scan(next.begin(), next.end(), next.begin(), 0U);
    std::vector<Ridge> ridges(facets.size() * n);
    for (std::size_t f = 0; f < facets.size(); ++f) {
        for (std::size_t i = 0; i < n; ++i) {
            const Ridge r = ridge(f, i);
            ridges[next[lower(r)]++] = r;
        }
    }
    base::parallel_for_each(next.size(), 1024, [&](std::size_t node) {
        std::sort(
            ridges.begin() + (node == 0 ? 0 : next[node - 1]), ridges.begin() + next[node],
            [](const Ridge& a, const Ridge& b) { return a.nodes != b.nodes ? a.nodes < b.nodes : a.facet < b.facet; });
    });
    return ridges;
}

/// use(span) for each set of equal ones.
template <class Use>
void for_each_ridge(const std::vector<Ridge>& ridges, Use use) {
    for (auto first = ridges.begin(); first != ridges.end();) {
        const auto last = std::find_if(first, ridges.end(), [&](const Ridge& r) { return r.nodes != first->nodes; });
        use(std::span<const Ridge>(first, last));
        first = last;
    }
}

}  // namespace barycert::index
