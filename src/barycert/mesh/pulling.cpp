#include "barycert/mesh/pulling.hpp"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <deque>
#include <numeric>
#include <unordered_map>

#include "barycert/base/arena.hpp"
#include "barycert/base/large_pages.hpp"
#include "barycert/mesh/cell_types.hpp"
#include "barycert/mesh/columns.hpp"
#include "barycert/mesh/part.hpp"

namespace barycert::mesh {
namespace {

using Index = Mesh::Index;

constexpr auto known_shapes = [] {
    std::array<Shape, 72> all{};
    all[vtk_triangle] = all[vtk_quadratic_triangle] = all[69] = {2, 3, "012"};
    all[vtk_triangle_strip] = all[vtk_polygon] = {2, 0, {}};
    all[8] = {2, 4, "0132"};
    all[vtk_quad] = {2, 4, "0123"};
    all[vtk_tetra] = all[vtk_quadratic_tetra] = all[71] = {3, 4, "013 123 203 021"};
    all[11] = {3, 8, "0462 1375 0154 2673 0231 4576"};
    all[12] = {3, 8, "0473 1265 0154 3762 0321 4567"};
    all[13] = {3, 6, "012 354 0341 1452 2530"};
    all[14] = {3, 5, "0321 014 124 234 304"};
    all[15] = {3, 10, "04321 56789 0165 1276 2387 3498 4059"};
    all[16] = {3, 12, "054321 6789ab 0176 1287 2398 34a9 45ba 506b"};
    all[vtk_polyhedron] = {3, 0, {}};
    return all;
}();

/// The parts of a cell, by the places of their nodes among its own.
struct Parts {
    std::vector<std::array<Index, 4>> corners;
    std::vector<std::uint16_t> inside;
};

/// Rings of a cell, by places among its nodes, and which of them have each node.
class Faces {
public:
    Faces(std::vector<std::vector<Index>> rings, std::size_t nodes) : rings_(std::move(rings)), of_node_(nodes) {
        for (std::size_t r = 0; r < rings_.size(); ++r) {
            for (const Index node : rings_[r]) {
                auto& own = of_node_[static_cast<std::size_t>(node)];
                if (own.empty() || own.back() != r) own.push_back(r);  // a ring may have a node twice
            }
        }
    }

    const std::vector<std::vector<Index>>& rings() const { return rings_; }

    bool share(std::initializer_list<Index> nodes) const {
        return std::ranges::any_of(of(*nodes.begin()), [&](std::size_t ring) {
            return std::all_of(nodes.begin() + 1, nodes.end(),
                               [&](Index node) { return std::ranges::count(of(node), ring) != 0; });
        });
    }
    bool is_edge(Index a, Index b) const {
        return std::ranges::any_of(of(a),
                                   [&](std::size_t r) { return follows(rings_[r], a, b) || follows(rings_[r], b, a); });
    }

    /// Turns rings so that each edge is passed both ways. False if an edge is not one of two faces.
    bool orient() {
        std::vector<std::size_t> known(rings_.size(), 0), next;
        for (std::size_t first = 0; first < rings_.size(); ++first) {
            if (known[first] != 0) continue;
            known[first] = 1;
            next.push_back(first);
            while (!next.empty()) {
                const std::size_t own = next.back();
                next.pop_back();
                for (std::size_t i = 0; i < rings_[own].size(); ++i) {
                    const Index a = rings_[own][i], b = rings_[own][(i + 1) % rings_[own].size()];
                    std::size_t others = 0;
                    for (const std::size_t r : of(a)) {
                        if (r == own) continue;
                        const bool same = follows(rings_[r], a, b);
                        if (!same && !follows(rings_[r], b, a)) continue;
                        ++others;
                        if (known[r] != 0 && same) return false;
                        if (known[r] != 0) continue;
                        if (same) std::ranges::reverse(rings_[r]);
                        known[r] = 1;
                        next.push_back(r);
                    }
                    if (others != 1) return false;
                }
            }
        }
        return !rings_.empty();
    }

private:
    const std::vector<std::size_t>& of(Index node) const { return of_node_[static_cast<std::size_t>(node)]; }
    static bool follows(const std::vector<Index>& ring, Index a, Index b) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            if (ring[i] == a && ring[(i + 1) % ring.size()] == b) return true;
        }
        return false;
    }

    std::vector<std::vector<Index>> rings_;
    std::vector<std::vector<std::size_t>> of_node_;
};

/// The ring from its lowest node on; `rank`: numbers of nodes.
template <class Rank>
std::vector<Index> from_lowest(std::vector<Index> ring, Rank rank) {
    std::rotate(ring.begin(), std::ranges::min_element(ring, {}, rank), ring.end());
    return ring;
}

/// Places are of nodes whose numbers are rank(place).
template <class Rank>
Parts cut_solid(const Faces& faces, std::size_t nodes, Rank rank) {
    Parts parts;
    Index apex = 0;
    for (Index i = 1; static_cast<std::size_t>(i) < nodes; ++i) apex = rank(i) < rank(apex) ? i : apex;
    const auto edge = [&](Index a, Index b) -> unsigned {
        return faces.is_edge(a, b) ? 0 : faces.share({a, b}) ? 1 : 2;
    };
    for (const auto& given : faces.rings()) {
        if (std::ranges::count(given, apex) != 0) continue;
        const std::vector<Index> ring = from_lowest(given, rank);
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

template <class Rank>
Parts cut_polygon(std::uint8_t type, std::vector<Index> nodes, Rank rank) {
    Parts parts;
    const std::size_t n = nodes.size();
    if (type != vtk_triangle_strip) nodes = from_lowest(std::move(nodes), rank);
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const bool first = i == 1, last = i + 2 == n;
        if (type == vtk_triangle_strip) {
            // Every other triangle is turned.
            const std::size_t odd = (i + 1) % 2;
            parts.corners.push_back({nodes[i - 1 + odd], nodes[i - odd], nodes[i + 1], -1});
            const unsigned before = first ? 0U : 4U, behind = last ? 0U : odd != 0 ? 2U : 1U;
            parts.inside.push_back(static_cast<std::uint16_t>(before | behind));
        } else {
            parts.corners.push_back({nodes[0], nodes[i], nodes[i + 1], -1});
            parts.inside.push_back(static_cast<std::uint16_t>((last ? 0U : 2U) | (first ? 0U : 4U)));
        }
    }
    return parts;
}

/// Cells that are cut alike, by type, number of nodes and which of these are lowest.
using KnownParts = std::unordered_map<std::uint64_t, Parts>;

/// Cuts cells one after the other. What is cut alike is cut once.
class Cutter {
public:
    Cutter(const Mesh& mesh, KnownParts& known) : mesh_(mesh), known_(known) {}

    std::size_t part_count = 0;
    std::optional<std::size_t> open;  ///< the first polyhedron whose faces do not close

    void cut(std::size_t cell) {
        const Mesh::Shapes& shapes = mesh_.shapes;
        const std::uint8_t type = shapes.types[cell];
        std::span<const Index> nodes = shapes.nodes_of(cell);
        if (is_curved_simplex(type)) nodes = nodes.first(mesh_.corners());
        const auto& of_type = rings_of(type);
        any_ = nodes.empty() ? 0 : nodes.front();
        if (type == vtk_polyhedron) return cut_rings(cell, rings_of_polyhedron(cell), true);
        const auto rank = [&](Index place) { return nodes[static_cast<std::size_t>(place)]; };
        // Which node is lowest, of all and of each face, tells how the cell is cut.
        const auto apex = static_cast<std::uint64_t>(std::ranges::min_element(nodes) - nodes.begin());
        if (mesh_.dimension == 2 && of_type.empty()) {
            const std::uint64_t kind = type == vtk_triangle_strip ? 2 : 1;  // no other key has such bits
            Parts& parts = known_[kind << 62U | nodes.size() << 31U | apex];
            if (parts.corners.empty()) {
                std::vector<Index> places(nodes.size());
                std::iota(places.begin(), places.end(), 0);
                parts = cut_polygon(type, std::move(places), rank);
            }
            return add(parts, false);
        }
        std::uint64_t key = type;
        bool twice = false;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) twice |= nodes[i] == nodes[j];
        }
        for (const auto& ring : of_type)
            key = key << 3U | static_cast<std::uint64_t>(std::ranges::min_element(ring, {}, rank) - ring.begin());
        if (twice) {
            std::vector<std::vector<Index>> rings = of_type;
            for (auto& ring : rings) std::ranges::transform(ring, ring.begin(), rank);
            return cut_rings(cell, std::move(rings), false);
        }
        Parts& parts = known_[key << 4U | apex];
        if (parts.corners.empty())
            parts = mesh_.dimension == 3 ? cut_solid(Faces(of_type, nodes.size()), nodes.size(), rank)
                                         : cut_polygon(type, of_type.front(), rank);
        add(parts, false);
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
    std::vector<std::vector<Index>> rings_of_polyhedron(std::size_t cell) const {
        const Mesh::Shapes& s = mesh_.shapes;
        std::vector<std::vector<Index>> rings;
        for (auto face = cell == 0 ? 0 : s.face_ends[cell - 1]; face != s.face_ends[cell]; ++face) {
            const auto f = static_cast<std::size_t>(face);
            rings.emplace_back(s.rings.begin() + (f == 0 ? 0 : s.ring_ends[f - 1]), s.rings.begin() + s.ring_ends[f]);
        }
        return rings;
    }

    /// Rings of nodes of the mesh, with some twice.
    void cut_rings(std::size_t cell, std::vector<std::vector<Index>> rings, bool must_close) {
        std::vector<Index> nodes;
        for (auto& ring : rings) {
            nodes.insert(nodes.end(), ring.begin(), ring.end());
            ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
            if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
        }
        std::erase_if(rings, [](const auto& ring) { return ring.size() < 3; });
        std::ranges::sort(nodes);
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        const auto own = [&](Index place) { return nodes[static_cast<std::size_t>(place)]; };
        for (auto& ring : rings) {
            for (Index& node : ring) node = static_cast<Index>(std::ranges::lower_bound(nodes, node) - nodes.begin());
        }
        Parts parts;
        if (mesh_.dimension == 3) {
            Faces faces(std::move(rings), nodes.size());
            if (must_close && !faces.orient() && !open) open = cell;
            parts = cut_solid(faces, nodes.size(), own);
        } else if (!rings.empty()) {
            parts = cut_polygon(0, rings.front(), own);
        }
        for (auto& corners : parts.corners) {
            for (std::size_t k = 0; k < mesh_.corners(); ++k) corners[k] = own(corners[k]);
        }
        add(own_.emplace_back(std::move(parts)), true);
    }

    void add(const Parts& parts, bool numbered) {
        // A cell that is flat has one degenerate part, so that it is counted.
        if (parts.corners.empty()) return add(own_.emplace_back(Parts{{{any_, any_, any_, any_}}, {0}}), true);
        cuts_.push_back({&parts, numbered});
        part_count += parts.corners.size();
    }

    struct Cut {
        const Parts* parts;
        bool numbered;  ///< by nodes of the mesh; else by places in the cell
    };
    const Mesh& mesh_;
    Index any_ = 0;  ///< a node of the cell
    KnownParts& known_;
    std::vector<Cut> cuts_;
    std::deque<Parts> own_;  ///< of cells that no other is like
};

}  // namespace

Shape shape_of(std::uint8_t type) {
    return type < known_shapes.size() ? known_shapes[type] : Shape();
}

const std::vector<std::vector<Index>>& rings_of(std::uint8_t type) {
    static const auto all = [] {
        std::array<std::vector<std::vector<Index>>, known_shapes.size()> types;
        for (std::size_t i = 0; i < types.size(); ++i) {
            if (!known_shapes[i].faces.empty()) types[i].emplace_back();
            for (const char c : known_shapes[i].faces) {
                if (c == ' ')
                    types[i].emplace_back();
                else
                    types[i].back().push_back(c <= '9' ? c - '0' : c - 'a' + 10);
            }
        }
        return types;
    }();
    return all[type < all.size() ? type : 0];
}

std::optional<std::size_t> pull(Mesh& mesh) {
    constexpr std::size_t step = std::size_t{1} << 14;
    Mesh::Shapes& shapes = mesh.shapes;
    const std::size_t count = shapes.count(), blocks = (count + step - 1) / step;
    tbb::enumerable_thread_specific<KnownParts> known;
    std::vector<std::optional<Cutter>> cutters(blocks);
    base::parallel_for(blocks, [&](std::size_t b) {
        Cutter& cutter = cutters[b].emplace(mesh, known.local());
        for (std::size_t cell = b * step; cell < std::min(count, (b + 1) * step); ++cell) cutter.cut(cell);
    });
    std::vector<std::size_t> first(blocks + 1);
    for (std::size_t b = 0; b < blocks; ++b) first[b + 1] = first[b] + cutters[b]->part_count;
    mesh.cells.resize(first[blocks] * mesh.corners());
    base::resize_large(shapes.inside, first[blocks]);
    base::resize_large(shapes.parts, count + 1);
    shapes.parts[count] = static_cast<Index>(first[blocks]);
    base::parallel_for(blocks, [&](std::size_t b) { cutters[b]->write(mesh, b * step, first[b]); });
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

std::optional<std::size_t> cut_into_simplices(Mesh& mesh) {
    const std::optional<std::size_t> open = pull(mesh);
    std::vector<Index> of_part = whole_of_parts(mesh);
    for (Field& field : mesh.cell_fields) field = rows_of(field, of_part);
    for (Column& labels : mesh.cell_labels) labels = labels_at(labels, of_part);
    if (mesh.cell_numbers.empty())
        mesh.cell_numbers = std::move(of_part);
    else
        keep_rows(mesh.cell_numbers, 1, of_part);
    return open;
}

Mesh rows_of_wholes(const Mesh& mesh) {
    Mesh rows;
    const std::vector<Index> firsts(mesh.shapes.parts.begin(), mesh.shapes.parts.end() - 1);
    for (const Field& field : mesh.cell_fields) rows.cell_fields.push_back(rows_of(field, firsts));
    for (const Column& labels : mesh.cell_labels) rows.cell_labels.push_back(labels_at(labels, firsts));
    return rows;
}

}  // namespace barycert::mesh
