#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <span>
#include <tuple>
#include <variant>
#include <vector>

#include "barycert/defect.hpp"
#include "barycert/mesh.hpp"
#include "mesh/check/stages.hpp"
#include "mesh/index/box_tree.hpp"
#include "mesh/index/candidates.hpp"
#include "mesh/index/facet_contact.hpp"
#include "mesh/index/open_sheets.hpp"
#include "mesh/index/overlap.hpp"

namespace barycert::check {
namespace {

/// Two items, by their numbers, the lower one first.
using Pair = std::array<std::uint32_t, 2>;

Item item_of(const Mesh& mesh, std::size_t cell) {
    Item item{.count = mesh.dimension + 1, .at = corner_points(mesh, cell)};
    std::copy_n(&mesh.cells[cell * mesh.corners()], mesh.corners(), item.nodes.begin());
    return item;
}

/// The pairs of items for which `conflict` holds, up to `limit`; ascending.
template <class Conflict>
LimitedList<Pair> conflicts(int d, const std::vector<Item>& items, Conflict conflict, std::size_t limit) {
    const Candidates candidates(d, items);
    return up_to<Pair>(limit, items.size(), 512, [&](std::size_t first, std::size_t last, auto& part) {
        for (std::size_t i = first; i < last && part.size() <= limit; ++i) {
            const std::size_t begin = part.size();
            candidates.for_each(items[i], [&](std::uint32_t j) {
                if (j > i && conflict(i, j)) part.push_back({static_cast<std::uint32_t>(i), j});
                return part.size() <= limit;
            });
            std::ranges::sort(std::span(part).subspan(begin));
        }
    });
}

}  // namespace

void add_hanging(int d, const PlacedFacet& f, const PlacedFacet& g, Mesh::Index cell, std::vector<HangingNode>& all) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(d); ++i) {
        const auto face = face_around(d, g, f.at[i]);
        if (face[1] >= 0) all.push_back({f.nodes[i], face, cell});
    }
}

void sort_hanging(std::vector<HangingNode>& all) {
    std::ranges::sort(all, {}, [](const HangingNode& h) { return std::tie(h.node, h.face, h.cell); });
    const auto same_place = [](const HangingNode& a, const HangingNode& b) {
        return std::tie(a.node, a.face) == std::tie(b.node, b.face);
    };
    all.erase(std::unique(all.begin(), all.end(), same_place), all.end());
}

BoundaryContacts find_boundary_contacts(Checked& c, std::size_t limit) {
    const int d = c.mesh.dimension;
    std::vector<PlacedFacet> proper_facets;
    std::vector<Mesh::Index> cells;
    std::vector<Item> items;
    for (const BoundaryFacet& facet : c.boundary) {
        const PlacedFacet f = placed(c.mesh, facet);
        if (!proper(d, f)) continue;  // its cell is degenerate, and told
        proper_facets.push_back(f);
        cells.push_back(facet.cell);
        items.push_back(item_of(f, d));
    }
    const LimitedList<Pair> found = conflicts(
        d, items, [&](std::size_t i, std::size_t j) { return facets_conflict(d, proper_facets[i], proper_facets[j]); },
        limit);
    BoundaryContacts out;
    out.complete = found.complete;
    for (const auto& [i, j] : found.list) {
        const PlacedFacet &f = proper_facets[i], &g = proper_facets[j];
        out.cells.push_back({cells[i], cells[j]});
        c.defects.add_marked(DefectKind::boundary_contact,
                             {.cells = out.cells.back(), .nodes = f.nodes, .other_nodes = g.nodes});
        add_hanging(d, f, g, cells[j], out.hanging);
        add_hanging(d, g, f, cells[i], out.hanging);
    }
    sort_hanging(out.hanging);
    if (!out.complete) c.defects[DefectKind::boundary_contact].at_least = true;
    return out;
}

std::vector<CellPair> find_nested_parts(Checked& c, const std::vector<std::uint32_t>& pieces, std::size_t limit) {
    const Mesh& mesh = c.mesh;
    const int d = mesh.dimension;
    std::vector<Mesh::Index> inner;  // a cell at each piece
    std::vector<Item> items;
    for (const std::uint32_t piece : pieces) {
        const Mesh::Index cell = c.boundary[piece].cell;
        if (c.degenerate(cell)) continue;  // and told
        inner.push_back(cell);
        items.push_back(item_of(mesh, static_cast<std::size_t>(cell)));
    }
    const Candidates candidates(d, items);
    if (candidates.bounds() == nullptr) return {};
    // Most cells are far from the few that are asked for: one byte a node tells.
    std::vector<std::uint8_t> codes(mesh.point_count());
    for (std::size_t i = 0; i < codes.size(); ++i)
        codes[i] = outcode(d, *candidates.bounds(), mesh.point(static_cast<Mesh::Index>(i)));
    const auto is_far = [&](std::size_t cell) {
        unsigned common = ~0U;
        for (const Mesh::Index node : mesh.corners_of(cell)) common &= codes[static_cast<std::size_t>(node)];
        return common != 0;
    };
    // For each piece the lowest cell that overlaps: no cell above it needs to be asked, and threads agree on it.
    constexpr Mesh::Index none = std::numeric_limits<Mesh::Index>::max();
    std::vector<Mesh::Index> lowest(inner.size(), none);
    const auto ask = [&](Mesh::Index cell, std::size_t piece, const Corners& corners) {
        const std::atomic_ref<Mesh::Index> known(lowest[piece]);
        if (inner[piece] == cell || known.load(std::memory_order_relaxed) <= cell ||
            !interiors_meet(d, items[piece].at, corners))
            return;
        Mesh::Index now = known.load(std::memory_order_relaxed);
        while (now > cell && !known.compare_exchange_weak(now, cell, std::memory_order_relaxed)) {
        }
    };
    bool complete = true;
    in_waves(
        mesh.cell_count(), 1024, std::monostate(),
        [&](std::size_t first, std::size_t last, std::monostate) {
            for (std::size_t cell = first; cell < last; ++cell) {
                if (c.orientation[cell] == 0 || is_far(cell)) continue;
                const Item item = item_of(mesh, cell);
                candidates.for_each(item, [&](std::uint32_t piece) {
                    ask(static_cast<Mesh::Index>(cell), piece, item.at);
                    return true;
                });
            }
        },
        [](std::monostate) {},
        [&] {
            const auto found = lowest.size() - static_cast<std::size_t>(std::ranges::count(lowest, none));
            return complete = found <= limit;
        });
    std::vector<CellPair> pairs;
    for (std::size_t i = 0; i < inner.size() && pairs.size() < limit; ++i) {
        if (lowest[i] == none) continue;
        pairs.push_back({inner[i], lowest[i]});
        c.defects.add_marked(DefectKind::nested_part, {.cells = pairs.back()});
    }
    if (!complete) c.defects[DefectKind::nested_part].at_least = true;
    return pairs;
}

std::vector<CellPair> find_overlapping_cells(Checked& c) {
    const int d = c.mesh.dimension;
    std::vector<Mesh::Index> cells;
    std::vector<Item> items;
    for (std::size_t cell = 0; cell < c.mesh.cell_count(); ++cell) {
        if (c.orientation[cell] == 0) continue;
        cells.push_back(static_cast<Mesh::Index>(cell));
        items.push_back(item_of(c.mesh, cell));
    }
    const LimitedList<Pair> found = conflicts(
        d, items, [&](std::size_t i, std::size_t j) { return interiors_meet(d, items[i].at, items[j].at); },
        pair_limit);
    std::vector<CellPair> pairs;
    std::set<CellPair> told;  // of cells as users know them, of which several parts may meet
    for (const auto& [i, j] : found.list) {
        pairs.push_back({cells[i], cells[j]});
        c.defects.mark(cells[i], DefectKind::overlapping_cells);
        c.defects.mark(cells[j], DefectKind::overlapping_cells);
        if (told.insert({c.mesh.cell_number(cells[i]), c.mesh.cell_number(cells[j])}).second)
            c.defects.add(DefectKind::overlapping_cells, {.cells = pairs.back()});
    }
    if (!found.complete) c.defects[DefectKind::overlapping_cells].at_least = true;
    return pairs;
}

}  // namespace barycert::check
