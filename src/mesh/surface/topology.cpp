#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/surface.hpp"
#include "core/base/large_pages.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/surface/cell_cases.hpp"
#include "mesh/surface/parts.hpp"

namespace barycert::surface {
namespace {

using Index = Mesh::Index;

/// A cell with a part of the surface.
template <std::size_t n>
struct CutCell {
    std::array<Index, n> corners{};  ///< copied: cells that are cut lie anywhere among the others
    Index cell = 0;
    std::uint8_t states = 0;  ///< index of its CellCase
    std::int8_t sign = 0;     ///< its orientation; 0: to be left out
};

/// Cells that one task looks at, in their order: the work does not depend on threads.
template <std::size_t n>
struct CutCells {
    std::vector<CutCell<n>> cells;
    std::uint64_t not_finite = 0, degenerate = 0;
    std::size_t first_part = 0;  ///< of the surface
};
constexpr std::size_t block_size = std::size_t{1} << 13;

constexpr std::int8_t not_asked = 2;

/// 1 or -1 as an even or an odd permutation brings the corners to: corner i, then the others in ascending order.
/// Requires: all different.
int parity(const Index* corners, std::size_t n, std::size_t i) {
    int sign = i % 2 == 0 ? 1 : -1;
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t k = 0; k < j; ++k) {
            if (j != i && k != i && corners[j] < corners[k]) sign = -sign;
        }
    }
    return sign;
}

bool repeats(const Index* corners, std::size_t n) {
    for (std::size_t j = 0; j < n; ++j) {
        if (std::find(corners, corners + j, corners[j]) != corners + j) return true;
    }
    return false;
}

/// Orientations that `flat`, cells of zero volume, take from their neighbours, by cell: cells on both sides of a facet
/// see its corners turn in opposite ways. 1 or -1; 0 if a corner is there twice: then its facets come in equal pairs,
/// turned in opposite ways, and the surface is whole without it. Cells of zero volume that are connected take the
/// orientation of the first cell with volume that is met from the first of them in `flat`; if there is none, that one
/// is taken for positive. Needs the neighbours of all cells.
std::vector<std::int8_t> flat_signs(const Mesh& mesh, const std::vector<Index>& flat) {
    const std::size_t n = mesh.corners();
    const std::vector<Index> neighbours = mesh::compute_neighbours(mesh);
    std::vector<std::int8_t> signs(mesh.cell_count(), not_asked);
    const auto corners = [&](Index cell) { return mesh.cells.data() + n * static_cast<std::size_t>(cell); };
    const auto sign_at = [&](Index cell) -> std::int8_t& { return signs[static_cast<std::size_t>(cell)]; };
    for (const Index start : flat) {
        if (sign_at(start) != not_asked) continue;
        // With respect to the start, of which it is not known.
        sign_at(start) = repeats(corners(start), n) ? 0 : 1;
        std::vector<Index> met;
        if (sign_at(start) != 0) met.push_back(start);
        int of_start = 0;
        for (std::size_t next = 0; next < met.size(); ++next) {
            const Index cell = met[next];
            for (std::size_t i = 0; i < n; ++i) {
                const Index other = neighbours[n * static_cast<std::size_t>(cell) + i];
                if (other < 0 || sign_at(other) != not_asked || repeats(corners(other), n)) continue;
                // The corner opposite to the common facet: the node that `cell` has not.
                const Index* const opposite = std::find_if(corners(other), corners(other) + n, [&](Index node) {
                    return std::find(corners(cell), corners(cell) + n, node) == corners(cell) + n;
                });
                const auto j = static_cast<std::size_t>(opposite - corners(other));
                if (j == n) continue;  // both have the same nodes
                const int fitting = -sign_at(cell) * parity(corners(cell), n, i) * parity(corners(other), n, j);
                const int own = static_cast<int>(orientation(mesh, corners(other)));
                if (own != 0) {
                    if (of_start == 0) of_start = own * fitting;
                    continue;
                }
                sign_at(other) = static_cast<std::int8_t>(fitting);
                met.push_back(other);
            }
        }
        if (of_start < 0)
            for (const Index cell : met) sign_at(cell) = static_cast<std::int8_t>(-sign_at(cell));
    }
    return signs;
}

/// A facet where g is 0, its corners ascending, and its cell.
struct LevelFacet {
    std::array<Index, 3> corners{};
    Index cell = 0;
    bool in_set = false;  ///< so is the cell's other corner

    auto operator<=>(const LevelFacet&) const = default;
};

/// Cells of the set, ascending, that have a facet where g is 0, and no other cell has it. Requires: tetrahedra,
/// whose corners are nodes.
std::vector<Index> cells_at_ends(const Mesh& mesh, const States& states) {
    std::vector<Index> cells;
    if (std::ranges::find(states.of, std::uint8_t{on}) == states.of.end()) return cells;
    std::vector<LevelFacet> facets;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        LevelFacet facet{.cell = static_cast<Index>(c)};
        std::size_t count = 0;
        std::uint8_t apex = unknown;
        for (std::size_t i = 0; i < 4; ++i) {
            const Index node = mesh.cells[4 * c + i];
            const std::uint8_t state = states.of[static_cast<std::size_t>(node)];
            if (state != on) apex = state;
            if (state == on && count < 3) facet.corners[count] = node;
            count += state == on ? 1 : 0;
        }
        if (count != 3 || apex == unknown) continue;
        std::ranges::sort(facet.corners);
        facet.in_set = apex == inside;
        facets.push_back(facet);
    }
    std::ranges::sort(facets);
    for (std::size_t i = 0; i < facets.size(); ++i) {
        const bool alone = (i == 0 || facets[i - 1].corners != facets[i].corners) &&
                           (i + 1 == facets.size() || facets[i + 1].corners != facets[i].corners);
        if (alone && facets[i].in_set) cells.push_back(facets[i].cell);
    }
    std::ranges::sort(cells);
    return cells;
}

template <std::size_t n>
class Cutter {
public:
    Cutter(const Mesh& mesh, const States& states, bool ends) : mesh_(mesh), states_(states), ends_(ends) {}

    Status cut(Surface& surface, CutCounts& counts) {
        if (!find_cells()) return bad_index();
        orient_flat_cells();
        if constexpr (n == 4) {
            if (ends_) add_ends();
        }
        count_parts();
        gather_ends();
        const std::size_t points = first_.back();
        if (std::max(points, part_count_) > INT32_MAX)
            return file_error("mesh.too-large", {}, "the surface is too large", "at most 2147483647 points and cells",
                              std::to_string(std::max(points, part_count_)), "cut a part of the mesh");
        write_edges(points, surface, counts);
        write_parts(surface, counts);
        return Done{};
    }

private:
    static const CellCase<n>& case_of(const CutCell<n>& c) { return cell_cases<n>[c.states]; }

    /// The node of the lower number first; a node itself twice.
    struct Ends {
        std::size_t low;
        Index high;
    };
    static Ends ends(const Index* corners, const Crossing& crossing) {
        const Index in = corners[crossing.in], out = corners[crossing.out];
        return {static_cast<std::size_t>(std::min(in, out)), std::max(in, out)};
    }

    /// False if a corner is no node.
    bool find_cells() {
        const std::size_t count = mesh_.cell_count();
        std::atomic<bool> good{true};
        blocks_.resize((count + block_size - 1) / block_size);
        base::parallel_for(blocks_.size(), [&](std::size_t b) {
            CutCells<n>& block = blocks_[b];
            const std::size_t begin = b * block_size, size = std::min(count - begin, block_size);
            const Index* const first = mesh_.cells.data() + n * begin;
            std::array<std::uint32_t, block_size> mixed;
            const std::size_t found = mixed_cells(first, n, size, states_, mixed.data());
            if (found == no_node) {
                good = false;
                return;
            }
            for (std::size_t k = 0; k < found; ++k) {
                const std::size_t cell = begin + mixed[k];
                CutCell<n> cut{.cell = static_cast<Index>(cell)};
                std::copy_n(mesh_.cells.data() + n * cell, n, cut.corners.data());
                std::size_t states = 0;
                for (std::size_t i = 0; i < n; ++i)
                    states |= static_cast<std::size_t>(states_.of[static_cast<std::size_t>(cut.corners[i])]) << (2 * i);
                cut.states = static_cast<std::uint8_t>(states);
                const CellCase<n>& what = case_of(cut);
                if (what.part_count == 0) {
                    block.not_finite += what.left_out ? 1 : 0;
                    continue;
                }
                cut.sign = static_cast<std::int8_t>(orientation(mesh_, cut.corners.data()));
                block.degenerate += cut.sign == 0 ? 1 : 0;
                block.cells.push_back(cut);
            }
        });
        return good;
    }

    /// As if the cell's other corner were outside, but turned: normals point out of the set, away from the cell.
    void add_ends() {
        for (const Index cell : cells_at_ends(mesh_, states_)) {
            CutCell<n> cut{.cell = cell};
            std::copy_n(mesh_.cells.data() + n * static_cast<std::size_t>(cell), n, cut.corners.data());
            for (std::size_t i = 0; i < n; ++i) {
                if (states_.of[static_cast<std::size_t>(cut.corners[i])] == on)
                    cut.states = static_cast<std::uint8_t>(cut.states | std::uint8_t{on} << (2 * i));
            }
            cut.sign = static_cast<std::int8_t>(-static_cast<int>(orientation(mesh_, cut.corners.data())));
            std::vector<CutCell<n>>& cells = blocks_[static_cast<std::size_t>(cell) / block_size].cells;
            const auto at = std::ranges::lower_bound(cells, cell, {}, &CutCell<n>::cell);
            if (cut.sign != 0) cells.insert(at, cut);
        }
    }

    void orient_flat_cells() {
        std::vector<Index> flat;
        for (const CutCells<n>& block : blocks_) {
            for (const CutCell<n>& c : block.cells)
                if (c.sign == 0) flat.push_back(c.cell);
        }
        if (flat.empty()) return;
        const std::vector<std::int8_t> signs = flat_signs(mesh_, flat);
        for (CutCells<n>& block : blocks_) {
            for (CutCell<n>& c : block.cells)
                if (c.sign == 0) c.sign = signs[static_cast<std::size_t>(c.cell)];
            std::erase_if(block.cells, [](const CutCell<n>& c) { return c.sign == 0; });
        }
    }

    void count_parts() {
        for (CutCells<n>& block : blocks_) {
            block.first_part = part_count_;
            for (const CutCell<n>& c : block.cells) part_count_ += case_of(c).part_count;
        }
    }

    /// visit(cell) for the cut cells of all blocks, in parallel; before that, ask(node) for the corners of a cell soon
    /// to come, and a little later ask_again(node): what is asked for lies anywhere in memory.
    template <class Ask, class AskAgain, class Visit>
    void for_cut_cells(Ask ask, AskAgain ask_again, Visit visit) const {
        constexpr std::size_t ahead = 24, again = 12;
        base::parallel_for(blocks_.size(), [&](std::size_t b) {
            const std::vector<CutCell<n>>& cells = blocks_[b].cells;
            std::size_t part = blocks_[b].first_part;
            for (std::size_t k = 0; k < cells.size(); ++k) {
                if (k + ahead < cells.size())
                    for (const Index node : cells[k + ahead].corners) ask(static_cast<std::size_t>(node));
                if (k + again < cells.size())
                    for (const Index node : cells[k + again].corners) ask_again(static_cast<std::size_t>(node));
                visit(cells[k], part);
                part += case_of(cells[k]).part_count;
            }
        });
    }

    template <class F>
    void for_crossings(const std::vector<std::size_t>& counters, F&& f) const {
        for_cut_cells([&](std::size_t node) { __builtin_prefetch(&counters[node], 1); }, [](std::size_t) {},
                      [&](const CutCell<n>& c, std::size_t) {
                          const CellCase<n>& what = case_of(c);
                          for (std::size_t i = 0; i < what.crossing_count; ++i)
                              f(ends(c.corners.data(), what.crossings[i]));
                      });
    }

    /// At each node, the higher ends of the crossed edges of which it is the lower one: by a counting sort, as threads
    /// come; then sorted, each once. first_[i]: the number of the first point of node i; those of the others follow.
    void gather_ends() {
        const std::size_t nodes = mesh_.point_count();
        base::resize_large(begin_, nodes + 1);
        for_crossings(
            begin_, [&](const Ends& e) { std::atomic_ref(begin_[e.low + 1]).fetch_add(1, std::memory_order_relaxed); });
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        base::resize_large(high_, begin_.back());
        first_ = begin_;  // the next of each
        for_crossings(first_, [&](const Ends& e) {
            high_[std::atomic_ref(first_[e.low]).fetch_add(1, std::memory_order_relaxed)] = e.high;
        });
        first_[0] = 0;
        base::parallel_for_each(nodes, grain, [&](std::size_t i) {
            Index* const list = high_.data() + begin_[i];
            Index* const end = high_.data() + begin_[i + 1];
            std::sort(list, end);
            first_[i + 1] = static_cast<std::size_t>(std::unique(list, end) - list);
        });
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
    }

    /// And sets end_: lists without gaps, as they will be looked up at random.
    void write_edges(std::size_t points, Surface& surface, CutCounts& counts) {
        base::resize_large(surface.mesh_edges, 2 * points);
        base::resize_large(end_, points + at_a_time);
        std::atomic<std::uint64_t> at_nodes{0};
        base::parallel_for(mesh_.point_count(), grain, [&](std::size_t from, std::size_t to) {
            std::uint64_t own = 0;
            for (std::size_t i = from; i < to; ++i) {
                for (std::size_t k = 0; k < first_[i + 1] - first_[i]; ++k) {
                    const auto low = static_cast<Index>(i), high = high_[begin_[i] + k];
                    end_[first_[i] + k] = high;
                    Index* const edge = surface.mesh_edges.data() + 2 * (first_[i] + k);
                    const bool low_inside = (states_.of[i] & 1) != 0;
                    edge[0] = low_inside ? low : high;
                    edge[1] = low_inside ? high : low;
                    own += low == high ? 1 : 0;
                }
            }
            at_nodes += own;
        });
        counts.at_nodes = at_nodes;
        counts.on_edges = points - at_nodes;
    }

    /// The place of the end in the list of its node: how many are lower. Eight at a time and without branches, for none
    /// of them could be predicted.
    Index number(const Ends& e) const {
        const std::size_t first = first_[e.low], count = first_[e.low + 1] - first;
        const Index* const list = end_.data() + first;
        std::size_t lower = 0;
        for (std::size_t base = 0; base < count; base += at_a_time) {
            std::uint32_t sum = 0;
            const auto rest = static_cast<std::uint32_t>(std::min(count - base, at_a_time));
            for (std::uint32_t k = 0; k < at_a_time; ++k)
                sum += static_cast<std::uint32_t>(k < rest) & static_cast<std::uint32_t>(list[base + k] < e.high);
            lower += sum;
        }
        return static_cast<Index>(first + lower);
    }

    void write_parts_of(const CutCell<n>& c, std::size_t part, Surface& surface) const {
        const CellCase<n>& what = case_of(c);
        std::array<Index, n> points{};
        for (std::size_t i = 0; i < what.crossing_count; ++i)
            points[i] = number(ends(c.corners.data(), what.crossings[i]));
        for (std::size_t p = 0; p < what.part_count; ++p) {
            Index* const to = surface.cells.data() + (n - 1) * (part + p);
            for (std::size_t i = 0; i < n - 1; ++i) to[i] = points[what.parts[p][i]];
            if (c.sign < 0) std::swap(to[n - 3], to[n - 2]);
            surface.mesh_cells[part + p] = c.cell;
        }
    }

    void write_parts(Surface& surface, CutCounts& counts) const {
        base::resize_large(surface.cells, (n - 1) * part_count_);
        base::resize_large(surface.mesh_cells, part_count_);
        for_cut_cells([&](std::size_t node) { __builtin_prefetch(&first_[node]); },
                      [&](std::size_t node) { __builtin_prefetch(&end_[first_[node]]); },
                      [&](const CutCell<n>& c, std::size_t part) { write_parts_of(c, part, surface); });
        for (const CutCells<n>& block : blocks_) {
            counts.cells += block.cells.size();
            counts.not_finite += block.not_finite;
            counts.degenerate += block.degenerate;
        }
    }

    const Mesh& mesh_;
    const States& states_;
    bool ends_;
    std::vector<CutCells<n>> blocks_;
    std::size_t part_count_ = 0;
    std::vector<std::size_t> begin_, first_;  ///< of each node, and the end of all
    std::vector<Index> high_, end_;
    static constexpr std::size_t at_a_time = 8;
};

}  // namespace

Status cut_cells(const Mesh& mesh, const States& states, bool ends, Surface& surface, CutCounts& counts) {
    surface.dimension = mesh.dimension;
    return mesh.dimension == 2 ? Cutter<3>(mesh, states, ends).cut(surface, counts)
                               : Cutter<4>(mesh, states, ends).cut(surface, counts);
}

}  // namespace barycert::surface
