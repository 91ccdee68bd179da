#include <algorithm>
#include <tuple>

#include "barycert/check/stages.hpp"
#include "barycert/index/candidates.hpp"

namespace barycert::check {
namespace {

struct Pair {
    std::uint32_t first, second;
};

Item item_of(const PlacedFacet& f, int d) {
    Item item{.count = d};
    std::copy(f.nodes.begin(), f.nodes.end(), item.nodes.begin());
    std::copy(f.at.begin(), f.at.end(), item.at.begin());
    return item;
}

Item item_of(const Mesh& mesh, std::size_t cell) {
    Item item{.count = mesh.dimension + 1, .at = corner_points(mesh, cell)};
    std::copy_n(&mesh.cells[cell * mesh.corners()], mesh.corners(), item.nodes.begin());
    return item;
}

/// Pairs (i, j), i < j, of the items for which `conflict` holds, up to `limit`; ascending.
template <class Conflict>
Found<Pair> conflicts(int d, const std::vector<Item>& items, Conflict conflict, std::size_t limit) {
    const Candidates candidates(d, items);
    return up_to<Pair>(limit, items.size(), 512, [&](std::size_t first, std::size_t last, auto& part) {
        for (std::size_t i = first; i < last && part.size() <= limit; ++i) {
            const std::size_t begin = part.size();
            candidates.for_each(items[i], [&](std::uint32_t j) {
                if (j > i && conflict(i, j)) part.push_back({static_cast<std::uint32_t>(i), j});
                return part.size() <= limit;
            });
            std::ranges::sort(std::span(part).subspan(begin), {}, &Pair::second);
        }
    });
}

std::vector<std::uint8_t> outcodes(const Mesh& mesh, const Box& box) {
    std::vector<std::uint8_t> codes(mesh.point_count());
    for (std::size_t i = 0; i < codes.size(); ++i)
        codes[i] = outcode(mesh.dimension, box, &mesh.points[i * static_cast<std::size_t>(mesh.dimension)]);
    return codes;
}

unsigned common_outcode(const Mesh& mesh, const std::vector<std::uint8_t>& codes, std::size_t cell) {
    unsigned common = ~0U;
    for (std::size_t i = 0; i < mesh.corners(); ++i)
        common &= codes[static_cast<std::size_t>(mesh.cells[cell * mesh.corners() + i])];
    return common;
}

/// The nodes of f within g, or within an edge of it: not those at the place of a node of g.
void add_hanging(int d, const PlacedFacet& f, const PlacedFacet& g, Mesh::Index cell, std::vector<HangingNode>& all) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(d); ++i) {
        const auto face = face_around(d, g, f.at[i]);
        if (face[1] >= 0) all.push_back({f.nodes[i], face, cell});
    }
}

}  // namespace

void sort_hanging(std::vector<HangingNode>& all) {
    std::sort(all.begin(), all.end(), [](const HangingNode& a, const HangingNode& b) {
        return std::tie(a.node, a.face, a.cell) < std::tie(b.node, b.face, b.cell);
    });
    const auto same = [](const HangingNode& a, const HangingNode& b) { return a.node == b.node && a.face == b.face; };
    all.erase(std::unique(all.begin(), all.end(), same), all.end());
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
    const auto conflict = [&](std::size_t i, std::size_t j) {
        return facets_conflict(d, proper_facets[i], proper_facets[j]);
    };
    BoundaryContacts out;
    const Found<Pair> found = conflicts(d, items, conflict, limit);
    out.complete = found.complete;
    for (const Pair& p : found.list) {
        const PlacedFacet &f = proper_facets[p.first], &g = proper_facets[p.second];
        out.cells.push_back({cells[p.first], cells[p.second]});
        c.defects.add_marked(DefectKind::boundary_contact,
                             {.cells = out.cells.back(), .nodes = f.nodes, .other_nodes = g.nodes});
        add_hanging(d, f, g, cells[p.second], out.hanging);
        add_hanging(d, g, f, cells[p.first], out.hanging);
    }
    sort_hanging(out.hanging);
    if (!out.complete) c.defects.add_at_least(DefectKind::boundary_contact);
    return out;
}

std::vector<CellPair> find_nested_parts(Checked& c, const std::vector<std::uint32_t>& pieces, std::size_t limit) {
    const Mesh& mesh = c.mesh;
    std::vector<std::size_t> inner;  // a cell at each piece
    std::vector<Item> items;
    for (const std::uint32_t piece : pieces) {
        const auto cell = static_cast<std::size_t>(c.boundary[piece].cell);
        if (c.orientation[cell] == 0) continue;  // degenerate, and told
        inner.push_back(cell);
        items.push_back(item_of(mesh, cell));
    }
    const Candidates candidates(mesh.dimension, items);
    if (candidates.bounds() == nullptr) return {};
    // Most cells are far from the few that are asked for: one byte a node tells.
    const std::vector<std::uint8_t> codes = outcodes(mesh, *candidates.bounds());
    // For each piece the lowest cell that overlaps: no cell above it needs to be asked, and threads agree on it.
    constexpr std::uint32_t none = ~std::uint32_t{0};
    std::vector<std::uint32_t> lowest(inner.size(), none);
    const auto ask = [&](std::size_t cell, std::size_t piece, const Corners& corners) {
        const std::atomic_ref<std::uint32_t> known(lowest[piece]);
        const auto number = static_cast<std::uint32_t>(cell);
        if (inner[piece] == cell || known.load(std::memory_order_relaxed) <= number ||
            !interiors_meet(mesh.dimension, items[piece].at, corners))
            return;
        std::uint32_t now = known.load(std::memory_order_relaxed);
        while (now > number && !known.compare_exchange_weak(now, number, std::memory_order_relaxed)) {
        }
    };
    bool complete = true;
    struct Nothing {};
    in_waves(
        mesh.cell_count(), 1024, [] { return Nothing(); },
        [&](std::size_t first, std::size_t last, Nothing&) {
            for (std::size_t cell = first; cell < last; ++cell) {
                if (c.orientation[cell] == 0 || common_outcode(mesh, codes, cell) != 0) continue;
                const Item item = item_of(mesh, cell);
                candidates.for_each(item, [&](std::uint32_t i) {
                    ask(cell, i, item.at);
                    return true;
                });
            }
        },
        [](const Nothing&) {},
        [&] {
            const auto found = lowest.size() - static_cast<std::size_t>(std::count(lowest.begin(), lowest.end(), none));
            return complete = found <= limit;
        });
    std::vector<CellPair> pairs;
    for (std::size_t i = 0; i < inner.size() && pairs.size() < limit; ++i) {
        if (lowest[i] == none) continue;
        const DefectPlace place{.cells = {static_cast<Mesh::Index>(inner[i]), static_cast<Mesh::Index>(lowest[i])}};
        c.defects.add_marked(DefectKind::nested_part, place);
        pairs.push_back(place.cells);
    }
    if (!complete) c.defects.add_at_least(DefectKind::nested_part);
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
    const auto conflict = [&](std::size_t i, std::size_t j) { return interiors_meet(d, items[i].at, items[j].at); };
    std::vector<CellPair> pairs;
    const Found<Pair> found = conflicts(d, items, conflict, pair_limit);
    for (const Pair& p : found.list) {
        pairs.push_back({cells[p.first], cells[p.second]});
        c.defects.add_marked(DefectKind::overlapping_cells, {.cells = pairs.back()});
    }
    if (!found.complete) c.defects.add_at_least(DefectKind::overlapping_cells);
    return pairs;
}

}  // namespace barycert::check
