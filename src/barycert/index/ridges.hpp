/// The d - 1 nodes of a facet that another one may share: an edge in 3D, a node in 2D.
#pragma once

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/base/arena.hpp"

namespace barycert::index {

struct Ridge {
    std::uint64_t nodes;  ///< of two, the lower one in the upper half
    std::uint32_t facet;
    std::uint32_t other;  ///< which of the facet's nodes it does not have
};

/// Of all facets, which have their `nodes`; equal ones side by side, by facet.
template <class Facet>
std::vector<Ridge> ridges_of(int d, const std::vector<Facet>& facets) {
    const auto n = static_cast<std::size_t>(d);
    std::vector<Ridge> ridges(facets.size() * n);
    base::parallel_for_each(facets.size(), 1024, [&](std::size_t f) {
        const auto node = [&](std::size_t i) { return static_cast<std::uint64_t>(facets[f].nodes[i]); };
        for (std::size_t i = 0; i < n; ++i) {
            const std::uint64_t x = node(d == 2 ? 1 - i : (i + 1) % 3), y = d == 2 ? 0 : node((i + 2) % 3);
            ridges[n * f + i] = {d == 2 ? x : std::min(x, y) << 32 | std::max(x, y), static_cast<std::uint32_t>(f),
                                 static_cast<std::uint32_t>(i)};
        }
    });
    tbb::parallel_sort(ridges.begin(), ridges.end(), [](const Ridge& a, const Ridge& b) {
        return a.nodes != b.nodes ? a.nodes < b.nodes : a.facet < b.facet;
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
