#include "mesh/pulling.hpp"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <initializer_list>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/predicates.hpp"
#include "core/base/finite.hpp"
#include "core/base/large_pages.hpp"
#include "core/vtk_cell.hpp"
#include "mesh/cell_rings.hpp"
#include "mesh/cell_types.hpp"
#include "mesh/columns.hpp"
#include "mesh/face_cut.hpp"
#include "mesh/part.hpp"
#include "mesh/solid_cut.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::mesh {
namespace {

using Index = Mesh::Index;

/// Which edges and faces of a type have some of its places.
class Faces {
public:
    explicit Faces(const Rings& rings) : rings_(rings) {}

    bool share(std::initializer_list<Index> places) const {
        return std::ranges::any_of(rings_, [&](const auto& ring) {
            return std::ranges::all_of(places, [&](Index place) { return std::ranges::count(ring, place) != 0; });
        });
    }
    bool is_edge(Index a, Index b) const {
        return std::ranges::any_of(rings_, [&](const auto& ring) {
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const Index from = ring[i], to = ring[(i + 1) % ring.size()];
                if ((from == a && to == b) || (from == b && to == a)) return true;
            }
            return false;
        });
    }

private:
    const Rings& rings_;
};

/// A convex cell of a type from its place of lowest number: `number(place)`.
template <class Number>
Parts pulled(const Rings& rings, Index apex, Number number) {
    Parts parts;
    const Faces faces(rings);
    const auto edge = [&](Index a, Index b) -> unsigned {
        return faces.is_edge(a, b) ? 0 : faces.share({a, b}) ? 1 : 2;
    };
    for (std::vector<Index> ring : rings) {
        if (std::ranges::count(ring, apex) != 0) continue;
        std::rotate(ring.begin(), std::ranges::min_element(ring, {}, number), ring.end());
        for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
            const Index v = apex, w = ring[0], a = ring[i], b = ring[i + 1];
            unsigned bits = (faces.share({v, a, b}) ? 0U : 2U) | (faces.share({v, w, b}) ? 0U : 4U) |
                            (faces.share({v, w, a}) ? 0U : 8U);
            unsigned shift = 4;
            for (const auto& [from, to] : {std::pair(v, w), {v, a}, {v, b}, {w, a}, {w, b}, {a, b}}) {
                bits |= edge(from, to) << shift;
                shift += 2;
            }
            parts.corners.push_back({v, w, a, b});
            parts.inside.push_back(static_cast<std::uint16_t>(bits));
        }
    }
    return parts;
}

/// The triangles of a ring of places at the `first` of these.
Parts fan(const std::vector<Index>& ring, std::size_t first) {
    Parts parts;
    const std::size_t n = ring.size();
    for (std::size_t i = 1; i + 1 < n; ++i) {
        parts.corners.push_back({ring[first], ring[(first + i) % n], ring[(first + i + 1) % n], -1});
        parts.inside.push_back(static_cast<std::uint16_t>((i + 2 == n ? 0U : 2U) | (i == 1 ? 0U : 4U)));
    }
    return parts;
}

/// Every other triangle of a strip is turned.
Parts cut_strip(std::size_t nodes) {
    Parts parts;
    for (std::size_t i = 1; i + 1 < nodes; ++i) {
        const std::size_t odd = (i + 1) % 2;
        parts.corners.push_back(
            {static_cast<Index>(i - 1 + odd), static_cast<Index>(i - odd), static_cast<Index>(i + 1), -1});
        const unsigned before = i == 1 ? 0U : 4U, behind = i + 2 == nodes ? 0U : odd != 0 ? 2U : 1U;
        parts.inside.push_back(static_cast<std::uint16_t>(before | behind));
    }
    return parts;
}

/// Parts of polygons in the plane.
Parts cut_polygons(const NumberedNodes& nodes, const Rings& rings) {
    std::vector<NodeTriangle> triangles;
    std::vector<std::array<Index, 2>> edges;
    const auto edge_of = [](Index a, Index b) { return std::array<Index, 2>{std::min(a, b), std::max(a, b)}; };
    Parts parts;
    int turned = 0;
    for (const auto& ring : rings) {
        const std::size_t first = triangles.size();
        if (!cut_face(nodes, ring, triangles)) return {};
        // Loops of one ring that turn against each other are no polygon.
        const NodeTriangle& t = triangles[first];
        const int way = static_cast<int>(orient2d(nodes.at(t[0]), nodes.at(t[1]), nodes.at(t[2])));
        if (turned * way < 0) return {};
        turned = way;
        parts.at_lowest = parts.at_lowest && is_cut_from_lowest(nodes, ring);
        for (std::size_t i = 0; i < ring.size(); ++i) edges.push_back(edge_of(ring[i], ring[(i + 1) % ring.size()]));
    }
    std::ranges::sort(edges);
    for (const auto& [a, b, c] : triangles) {
        unsigned bits = std::ranges::binary_search(edges, edge_of(b, c)) ? 0U : 1U;
        bits |= std::ranges::binary_search(edges, edge_of(a, c)) ? 0U : 2U;
        bits |= std::ranges::binary_search(edges, edge_of(a, b)) ? 0U : 4U;
        parts.corners.push_back({a, b, c, -1});
        parts.inside.push_back(static_cast<std::uint16_t>(bits));
    }
    return parts;
}

/// The parts of a solid with the last two corners swapped.
Parts turn(Parts parts) {
    for (std::size_t i = 0; i < parts.corners.size(); ++i) {
        std::swap(parts.corners[i][2], parts.corners[i][3]);
        const unsigned bits = parts.inside[i];
        const auto at = [&](unsigned from, unsigned to, unsigned width) {
            return (bits >> from & ((1U << width) - 1)) << to;
        };
        // Facets opposite to 2 and 3, edges 02 and 03, 12 and 13 change places.
        parts.inside[i] =
            static_cast<std::uint16_t>(at(0, 0, 2) | at(2, 3, 1) | at(3, 2, 1) | at(4, 4, 2) | at(6, 8, 2) |
                                       at(8, 6, 2) | at(10, 12, 2) | at(12, 10, 2) | at(14, 14, 2));
    }
    return parts;
}

/// Cells that are cut alike, by type, number of nodes and which of these are lowest.
using KnownParts = std::unordered_map<std::uint64_t, Parts>;

/// Cuts cells one after the other. Cells that are cut alike, as most convex cells are, are cut once; exact signs tell
/// whether a cell is.
class Cutter {
public:
    Cutter(const Mesh& mesh, std::span<const Index> numbers, KnownParts& known)
        : mesh_(mesh), nodes_{mesh.points.data(), mesh.dimension, numbers}, known_(known) {}

    std::size_t part_count = 0;
    std::optional<std::size_t> open;  ///< the first polyhedron whose faces do not close
    std::size_t otherwise = 0;        ///< cells that are cut, but not all at their node of lowest number

    void cut(std::size_t cell) {
        const std::uint8_t type = mesh_.shapes.types[cell];
        std::span<const Index> nodes = mesh_.shapes.nodes_of(cell);
        if (is_curved_simplex(type)) nodes = nodes.first(mesh_.corners());
        const CellType& known = cell_type(type);
        if (!known.in_shapes || known.dimension() != mesh_.dimension) return cut_rings(cell, {});
        if (type == vtk_polyhedron) return cut_polyhedron(cell);
        const std::uint64_t kind = type == vtk_triangle_strip ? 2 : 1;  // no other key has such bits
        if (type == vtk_triangle_strip) {
            Parts& parts = known_[kind << 62U | nodes.size() << 31U];
            if (parts.corners.empty()) parts = cut_strip(nodes.size());
            return add(parts, false);
        }
        const Rings& rings = rings_of(type);
        const auto number = [&](Index place) { return nodes_.number(nodes[static_cast<std::size_t>(place)]); };
        // Which node is lowest, of all and of each face, tells how a convex cell is cut.
        std::size_t apex = 0;
        for (std::size_t i = 1; i < nodes.size(); ++i) apex = nodes_.lower(nodes[i], nodes[apex]) ? i : apex;
        if (rings.empty()) {
            if (nodes.size() < 3 || !is_cut_from_lowest(nodes_, nodes))
                return cut_rings(cell, {{nodes.begin(), nodes.end()}});
            Parts& parts = known_[kind << 62U | nodes.size() << 31U | apex];
            if (parts.corners.empty()) parts = fan(places_of(nodes.size()), apex);
            return add(parts, false);
        }
        std::uint64_t key = type;
        for (const auto& ring : rings)
            key = key << 3U | static_cast<std::uint64_t>(std::ranges::min_element(ring, {}, number) - ring.begin());
        Parts& parts = known_[key << 4U | apex];
        if (parts.corners.empty())
            parts =
                mesh_.dimension == 3 ? pulled(rings, static_cast<Index>(apex), number) : fan(rings.front(), key & 7U);
        const Sign side = has_node_twice(nodes)       ? Sign::zero
                          : parts.corners.size() == 1 ? Sign::positive
                                                      : common_side(parts, rings, nodes);
        if (side == Sign::zero) {
            Rings own = rings;
            for (auto& ring : own) {
                for (Index& place : ring) place = nodes[static_cast<std::size_t>(place)];
            }
            return cut_rings(cell, std::move(own));
        }
        if (type != vtk_wedge || side == Sign::positive) return add(parts, false);
        Parts& turned = known_[std::uint64_t{1} << 61U | key << 4U | apex];
        if (turned.corners.empty()) turned = turn(parts);
        add(turned, false);
    }

    /// The parts of what was cut, the first of which has that number, where the mesh has them.
    void write(Mesh& mesh, std::size_t first_cell, std::size_t part) const {
        Index* next = mesh.cells.data() + mesh.corners() * part;
        for (std::size_t i = 0; i < cuts_.size(); ++i) {
            const auto& [parts, numbered] = cuts_[i];
            const std::span nodes = mesh.shapes.nodes_of(first_cell + i);
            for (const auto& corners : parts->corners) {
                for (std::size_t k = 0; k < mesh.corners(); ++k)
                    *next++ = numbered ? corners[k] : nodes[static_cast<std::size_t>(corners[k])];
            }
            std::ranges::copy(parts->inside, &mesh.shapes.inside[part]);
            mesh.shapes.parts[first_cell + i] = static_cast<Index>(part);
            part += parts->corners.size();
        }
    }

private:
    static std::vector<Index> places_of(std::size_t count) {
        std::vector<Index> places(count);
        std::iota(places.begin(), places.end(), 0);
        return places;
    }

    bool is_negative(const Parts& parts) const {
        const auto& c = parts.corners.front();
        return orient3d(nodes_.at(c[0]), nodes_.at(c[1]), nodes_.at(c[2]), nodes_.at(c[3])) == Sign::negative;
    }

    bool is_finite(Index node) const {
        return base::all_finite({nodes_.at(node), static_cast<std::size_t>(nodes_.dimension)});
    }

    static bool has_node_twice(std::span<const Index> nodes) {
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                if (nodes[i] == nodes[j]) return true;
            }
        }
        return false;
    }

    /// The sign that all parts have, if each lies strictly on that side of its node, and the faces are cut from their
    /// node of lowest number; else zero.
    Sign common_side(const Parts& parts, const Rings& rings, std::span<const Index> nodes) const {
        std::array<Index, 6> own{};
        for (const auto& ring : rings) {
            if (ring.size() < 4) continue;
            for (std::size_t i = 0; i < ring.size(); ++i) own[i] = nodes[static_cast<std::size_t>(ring[i])];
            if (!is_cut_from_lowest(nodes_, std::span(own).first(ring.size()))) return Sign::zero;
        }
        Sign side = mesh_.dimension == 2 ? Sign::positive : Sign::zero;
        for (std::size_t i = 0; mesh_.dimension == 3 && i < parts.corners.size(); ++i) {
            const auto at = [&](std::size_t k) {
                return nodes_.at(nodes[static_cast<std::size_t>(parts.corners[i][k])]);
            };
            const Sign sign = orient3d(at(0), at(1), at(2), at(3));
            if (sign == Sign::zero || sign == -side) return Sign::zero;
            side = sign;
        }
        return side;
    }

    void cut_polyhedron(std::size_t cell) {
        const Mesh::Shapes& s = mesh_.shapes;
        Rings rings;
        for (auto face = cell == 0 ? 0 : s.face_ends[cell - 1]; face != s.face_ends[cell]; ++face) {
            const auto f = static_cast<std::size_t>(face);
            rings.emplace_back(s.rings.begin() + (f == 0 ? 0 : s.ring_ends[f - 1]), s.rings.begin() + s.ring_ends[f]);
        }
        drop_repeated(rings);
        if (!turn_alike(rings) && !open) open = cell;
        cut_rings(cell, std::move(rings));
    }

    /// A cell that no pattern fits, by its faces.
    void cut_rings(std::size_t cell, Rings rings) {
        std::vector<Index> all;
        for (const auto& ring : rings) all.insert(all.end(), ring.begin(), ring.end());
        const std::span nodes = mesh_.shapes.nodes_of(cell);
        if (all.empty()) all.assign(nodes.begin(), nodes.end());
        std::ranges::sort(all);
        all.erase(std::unique(all.begin(), all.end()), all.end());
        if (const auto bad = std::ranges::find_if(all, [&](Index node) { return !is_finite(node); });
            bad != all.end()) {
            std::iter_swap(all.begin(), bad);  // so that the part has it, and is told
            return add_degenerate(all);
        }
        if (all.empty() || are_flat(nodes_, all)) return add_degenerate(all);
        drop_repeated(rings);
        collapse(nodes_, rings);
        Parts parts = mesh_.dimension == 3 ? cut_solid(nodes_, rings) : cut_polygons(nodes_, rings);
        if (!parts.corners.empty()) {
            otherwise += parts.at_lowest ? 0 : 1;
            if (mesh_.shapes.types[cell] == vtk_wedge && is_negative(parts)) parts = turn(std::move(parts));
            return add(own_.emplace_back(std::move(parts)), true);
        }
        add_degenerate(std::span(all).first(1), uncut_part);
    }

    /// A cell without parts has one that is degenerate, so that it is counted: of flat ones between some nodes.
    void add_degenerate(std::span<const Index> nodes, std::uint16_t inside = 0) {
        std::array<Index, 4> corners{};
        for (std::size_t k = 0; k < 4 && !nodes.empty(); ++k) corners[k] = nodes[std::min(k, nodes.size() - 1)];
        add(own_.emplace_back(Parts{{corners}, {inside}}), true);
    }

    void add(const Parts& parts, bool numbered) {
        cuts_.push_back({&parts, numbered});
        part_count += parts.corners.size();
    }

    struct Cut {
        const Parts* parts;
        bool numbered;  ///< by nodes of the mesh; else by places in the cell
    };
    const Mesh& mesh_;
    NumberedNodes nodes_;
    KnownParts& known_;
    std::vector<Cut> cuts_;
    std::deque<Parts> own_;  ///< of cells that no other is like
};

}  // namespace

std::optional<std::size_t> pull(Mesh& mesh, std::span<const Index> numbers, std::size_t* otherwise) {
    constexpr std::size_t step = std::size_t{1} << 14;
    Mesh::Shapes& shapes = mesh.shapes;
    const std::size_t count = shapes.count(), blocks = (count + step - 1) / step;
    tbb::enumerable_thread_specific<KnownParts> known;
    std::vector<std::optional<Cutter>> cutters(blocks);
    base::parallel_for(blocks, [&](std::size_t b) {
        Cutter& cutter = cutters[b].emplace(mesh, numbers, known.local());
        for (std::size_t cell = b * step; cell < std::min(count, (b + 1) * step); ++cell) cutter.cut(cell);
    });
    std::vector<std::size_t> first(blocks + 1);
    for (std::size_t b = 0; b < blocks; ++b) first[b + 1] = first[b] + cutters[b]->part_count;
    mesh.cells.resize(first[blocks] * mesh.corners());
    base::resize_large(shapes.inside, first[blocks]);
    base::resize_large(shapes.parts, count + 1);
    shapes.parts[count] = static_cast<Index>(first[blocks]);
    base::parallel_for(blocks, [&](std::size_t b) { cutters[b]->write(mesh, b * step, first[b]); });
    std::size_t others = 0;
    for (const auto& cutter : cutters) {
        others += cutter->otherwise;
    }
    if (otherwise != nullptr) *otherwise = others;
    const auto open = std::ranges::find_if(cutters, [](const auto& cutter) { return cutter->open.has_value(); });
    return open == cutters.end() ? std::nullopt : (*open)->open;
}

std::vector<Index> whole_of_parts(const Mesh& mesh) {
    std::vector<Index> wholes;
    base::resize_large(wholes, mesh.shapes.types.empty() ? 0 : mesh.cell_count());
    base::parallel_for_each(mesh.shapes.count(), std::size_t{1} << 14, [&](std::size_t i) {
        const auto begin = wholes.begin() + mesh.shapes.parts[i], end = wholes.begin() + mesh.shapes.parts[i + 1];
        std::fill(begin, end, static_cast<Index>(i));
    });
    return wholes;
}

std::optional<std::size_t> cut_into_simplices(Mesh& mesh, std::span<const Index> numbers, std::size_t* otherwise) {
    const std::optional<std::size_t> open = pull(mesh, numbers, otherwise);
    std::vector<Index> of_part = whole_of_parts(mesh);
    for (Field& field : mesh.cell_fields) field = rows_of(field, of_part);
    for (Column& labels : mesh.cell_labels) labels = labels_at(labels, of_part);
    if (mesh.cell_numbers.empty())
        mesh.cell_numbers = std::move(of_part);
    else
        keep_rows(mesh.cell_numbers, 1, of_part);
    return open;
}

std::vector<Index> uncut_parts(const Mesh& mesh) {
    std::vector<Index> uncut;
    const std::vector<std::uint16_t>& inside = mesh.shapes.inside;
    for (auto at = std::ranges::find(inside, uncut_part); at != inside.end();
         at = std::find(at + 1, inside.end(), uncut_part))
        uncut.push_back(static_cast<Index>(at - inside.begin()));
    return uncut;
}

std::string told_uncut(const Mesh& mesh) {
    constexpr std::size_t most = 10;
    const std::vector<Index> uncut = uncut_parts(mesh);
    if (uncut.empty()) return {};
    std::string numbers;
    for (std::size_t i = 0; i < std::min(most, uncut.size()); ++i)
        numbers += (i == 0 ? "" : ", ") + std::to_string(mesh.cell_number(uncut[i]));
    const bool one = uncut.size() == 1;
    const bool may_have_map = std::ranges::any_of(uncut, [&, wholes = whole_of_parts(mesh)](Index part) {
        const std::uint8_t type = mesh.shapes.types[static_cast<std::size_t>(wholes[static_cast<std::size_t>(part)])];
        return type == vtk_hexahedron || type == vtk_wedge || type == vtk_pyramid;
    });
    return std::to_string(uncut.size()) + (one ? " cell" : " cells") + " cannot be cut into " +
           (mesh.dimension == 3 ? "tetrahedra" : "triangles") + " without new points, and own" + (one ? "s" : "") +
           " nothing: " + (one ? "cell " : "cells ") + numbers + (uncut.size() > most ? ", ..." : "") + " (from 0)" +
           (may_have_map ? "; hexahedra, wedges and pyramids may own points as multilinear cells" : "");
}

Mesh rows_of_wholes(const Mesh& mesh) {
    Mesh rows;
    const std::vector<Index> firsts(mesh.shapes.parts.begin(), mesh.shapes.parts.end() - 1);
    for (const Field& field : mesh.cell_fields) rows.cell_fields.push_back(rows_of(field, firsts));
    for (const Column& labels : mesh.cell_labels) rows.cell_labels.push_back(labels_at(labels, firsts));
    return rows;
}

}  // namespace barycert::mesh
