#include "mesh/index/triangles.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/simplex.hpp"
#include "core/base/disjoint_sets.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/index/facet_contact.hpp"
#include "mesh/index/ridges.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::index {
namespace {

constexpr std::size_t triangles_at_once = 4096;

/// Nodes at one place have one bin, and so stand near each other.
std::vector<Place> first_at_place(const CellIndex& index) {
    const std::size_t count = index.nodes.size();
    std::vector<Place> same(count);
    const auto bin = [&](std::size_t i) { return index.bins.of(index.nodes[i].at.data()); };
    base::parallel_for((count + triangles_at_once - 1) / triangles_at_once, [&](std::size_t block) {
        // Runs that begin in the block.
        std::size_t first = block * triangles_at_once;
        const std::size_t end = std::min(count, first + triangles_at_once);
        while (first != 0 && first < count && bin(first) == bin(first - 1)) ++first;
        std::vector<Place> run;
        while (first < end) {
            std::size_t last = first + 1;
            while (last < count && bin(last) == bin(first)) ++last;
            run.resize(last - first);
            for (std::size_t i = first; i < last; ++i) same[i] = run[i - first] = static_cast<Place>(i);
            const auto at = [&](Place p) -> auto& {
                return index.nodes[p].at;
            };
            if (run.size() > 1) std::ranges::sort(run, {}, [&](Place p) { return std::pair(at(p), p); });
            for (std::size_t i = 1; i < run.size(); ++i) {
                if (at(run[i]) == at(run[i - 1]))
                    same[static_cast<std::size_t>(run[i])] = same[static_cast<std::size_t>(run[i - 1])];
            }
            first = last;
        }
    });
    return same;
}

}  // namespace

Triangles place_triangles(std::span<const double> points, std::span<const Mesh::Index> corners,
                          std::span<const Mesh::Index> numbers, Flat of_flat) {
    Triangles all;
    std::vector<std::uint8_t> flat(numbers.size());
    const auto at = [&](std::size_t corner) { return &points[3 * static_cast<std::size_t>(corners[corner])]; };
    base::parallel_for_each(flat.size(), triangles_at_once, [&](std::size_t i) {
        flat[i] = proper(3, {{}, {at(3 * i), at(3 * i + 1), at(3 * i + 2)}}) ? 0 : 1;
    });
    for (std::size_t i = 0; i < flat.size(); ++i) {
        if (flat[i] != 0) all.degenerate.push_back(numbers[i]);
    }
    std::vector<Mesh::Index> kept, kept_numbers;
    if (!all.degenerate.empty() && of_flat == Flat::left_out) {
        for (std::size_t i = 0; i < flat.size(); ++i) {
            if (flat[i] != 0) continue;
            kept.insert(kept.end(), &corners[3 * i], &corners[3 * i] + 3);
            kept_numbers.push_back(numbers[i]);
        }
        corners = kept;
        numbers = kept_numbers;
    }
    all.index = make_cell_index(Simplex::triangle3d, points, corners);
    all.same = first_at_place(all.index);
    for (std::size_t i = 0; i < all.same.size(); ++i) all.joined = all.joined || all.same[i] != static_cast<Place>(i);
    const std::size_t count = numbers.size();
    all.facets.resize(count);
    all.odd.resize(count);
    if (of_flat == Flat::kept && !all.degenerate.empty()) all.flat.resize(count);
    base::parallel_for_each(count, triangles_at_once, [&](std::size_t i) {
        CellRecord& cell = all.index.cells[i];
        for (Place& node : cell.node) node = all.same[static_cast<std::size_t>(node)];
        PlacedFacet& f = all.facets[i];
        std::copy_n(cell.node.begin(), 3, f.nodes.begin());
        unsigned swaps = 0;
        for (const auto& [a, b] : {std::pair(0U, 1U), {1U, 2U}, {0U, 1U}}) {
            if (f.nodes[b] < f.nodes[a]) std::swap(f.nodes[a], f.nodes[b]), ++swaps;
        }
        for (std::size_t k = 0; k < 3; ++k) f.at[k] = all.index.nodes[f.nodes[k]].at.data();
        all.odd[i] = swaps % 2;
        Mesh::Index& number = all.index.original[i];
        if (!all.flat.empty()) all.flat[i] = flat[static_cast<std::size_t>(number)];
        number = numbers[static_cast<std::size_t>(number)];
    });
    return all;
}

void join_sides(const Triangles& triangles, std::span<const Ridge> ring, base::DisjointSets& sides) {
    // A triangle that ascends looks forward in the turn with the side to which its normal points.
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Ridge &a = ring[i], &b = ring[(i + 1) % ring.size()];
        sides.join(2 * std::size_t{a.facet} + (triangles.ascends(a) ? 0 : 1),
                   2 * std::size_t{b.facet} + (triangles.ascends(b) ? 1 : 0));
    }
}

}  // namespace barycert::index
