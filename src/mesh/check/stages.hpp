/// The stages of a check, in their order. Each reads what those before it have found of the mesh, and adds to it.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh.hpp"
#include "barycert/predicates.hpp"
#include "core/integer.hpp"
#include "mesh/index/box_tree.hpp"
#include "mesh/index/exact_volumes.hpp"
#include "mesh/index/facet_contact.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::check {

using namespace index;  // what meets what
using core::Integer;

// Gathering what several threads find, in an order that does not depend on them.

/// Defects of each kind, each with its count and its first places.
class DefectList {
public:
    /// `of_cells`: the kinds of defects that each cell is part of.
    DefectList(std::size_t examples, std::vector<DefectSet>& of_cells)
        : examples_(examples), of_cells_(of_cells), all_(defect_kind_count) {
        for (std::size_t i = 0; i < defect_kind_count; ++i) all_[i].kind = defect_texts[i].kind;
    }

    /// An empty one, for a block of the work.
    DefectList part() const { return {examples_, of_cells_}; }

    Defect& operator[](DefectKind p) { return all_[static_cast<std::size_t>(p)]; }

    /// Notes that the cell is part of a defect, from any thread.
    void mark(Mesh::Index cell, DefectKind p) const {
        std::atomic_ref(of_cells_[static_cast<std::size_t>(cell)]).fetch_or(defect_bit(p), std::memory_order_relaxed);
    }

    void add(DefectKind p, const DefectPlace& place) {
        Defect& f = (*this)[p];
        ++f.count;
        if (f.places.size() < examples_) f.places.push_back(place);
    }

    /// The same, its cells marked.
    void add_marked(DefectKind p, const DefectPlace& place) {
        for (const Mesh::Index cell : place.cells) {
            if (cell >= 0) mark(cell, p);
        }
        add(p, place);
    }

    /// Appends what another block of the same work found.
    void append(const DefectList& other) {
        for (std::size_t i = 0; i < defect_kind_count; ++i) {
            Defect& f = all_[i];
            const Defect& g = other.all_[i];
            f.count += g.count;
            f.at_least |= g.at_least;
            f.cause |= g.cause;
            const std::size_t room = std::min(examples_ - std::min(examples_, f.places.size()), g.places.size());
            f.places.insert(f.places.end(), g.places.begin(), g.places.begin() + static_cast<std::ptrdiff_t>(room));
        }
    }

    /// One of the kinds for which `asked` holds has been found.
    template <class Asked>
    bool has(Asked asked) const {
        return std::ranges::any_of(all_, [&](const Defect& f) { return f.count > 0 && asked(defect_text(f.kind)); });
    }

    /// One that breaks the certificate, whatever it is the cause of, has been found.
    bool breaks() const {
        return has([](const DefectText& t) { return t.breaks; });
    }

    /// Returns the defects that occur, first those that break the certificate.
    std::vector<Defect> list() && {
        std::erase_if(all_, [](const Defect& f) { return f.count == 0; });
        std::stable_partition(all_.begin(), all_.end(), std::mem_fn(&Defect::breaks));
        return std::move(all_);
    }

private:
    std::size_t examples_;
    std::vector<DefectSet>& of_cells_;
    std::vector<Defect> all_;
};

/// A check's questions about a mesh or a surface, and its findings, one stage after the other.
struct CheckRun {
    const CheckOptions& options;
    CheckReport& report;
    DefectList defects{options.examples, report.measures.defects};

    void stage(const char* name) const {
        if (!options.progress) return;
        options.progress(name);
        ExactEnvironment::renew();
    }

    /// The verdict is known, and nothing else is asked for.
    bool enough() const { return options.verdict_only && defects.breaks(); }

    /// After the last stage.
    Verdict report_defects() {
        report.defects = std::move(defects).list();
        const bool whole = std::ranges::none_of(report.defects, &Defect::breaks);
        return whole ? Verdict::certified : Verdict::not_certified;
    }
};

/// work(first, last, part) for blocks of [0, count), on all threads of the calling arena, each part a copy of `empty`;
/// then join(part) for each block in order.
template <class Part, class Work, class Join>
void in_blocks(std::size_t count, std::size_t block, const Part& empty, Work work, Join join) {
    std::vector<Part> parts((count + block - 1) / block, empty);
    base::parallel_for(parts.size(),
                       [&](std::size_t i) { work(i * block, std::min(count, (i + 1) * block), parts[i]); });
    for (const Part& part : parts) join(part);
}

/// The same in waves of a fixed number of blocks, for searches that may find more than anybody wants: when more()
/// returns false after a wave, nothing else is done. So the outcome does not depend on threads.
template <class Part, class Work, class Join, class More>
void in_waves(std::size_t count, std::size_t block, const Part& empty, Work work, Join join, More more) {
    constexpr std::size_t blocks = 64;
    for (std::size_t from = 0; from < count; from += block * blocks) {
        in_blocks(
            std::min(count - from, block * blocks), block, empty,
            [&](std::size_t first, std::size_t last, Part& part) { work(from + first, from + last, part); }, join);
        if (!more()) return;
    }
}

/// Results of a search, and whether they are all: a search stops where it finds more than anybody wants.
template <class T>
struct LimitedList {
    std::vector<T> list;
    bool complete = true;
};

/// Collects what work(first, last, part) adds to the parts, in order, up to `limit`. A part with more need not go on.
template <class T, class Work>
LimitedList<T> up_to(std::size_t limit, std::size_t count, std::size_t block, Work work) {
    LimitedList<T> found;
    in_waves(
        count, block, std::vector<T>(), work,
        [&](const std::vector<T>& part) { found.list.insert(found.list.end(), part.begin(), part.end()); },
        [&] { return found.complete = found.list.size() <= limit; });
    found.list.resize(std::min(found.list.size(), limit));
    return found;
}

/// Where the corners of a cell stand. Requires: it is usable.
inline std::array<const double*, 4> corner_points(const Mesh& mesh, std::size_t cell) {
    std::array<const double*, 4> p{};
    for (std::size_t i = 0; i < mesh.corners(); ++i) p[i] = mesh.point(mesh.cells[cell * mesh.corners() + i]);
    return p;
}

inline int exact_sign(int d, const std::array<const double*, 4>& p) {
    return static_cast<int>(d == 2 ? orient2d(p[0], p[1], p[2]) : orient3d(p[0], p[1], p[2], p[3]));
}

/// A facet of exactly one cell.
struct BoundaryFacet {
    Mesh::Index cell = -1;
    std::int32_t corner = 0;  ///< opposite to it
    /// In the order that turns its normal outward (2D: two, the cell to their left).
    std::array<Mesh::Index, 3> nodes{};
    bool oriented = true;  ///< false if the cell is degenerate, and the order of the nodes by chance
};

inline PlacedFacet placed(const Mesh& mesh, const BoundaryFacet& facet) {
    PlacedFacet f{facet.nodes, {}};
    for (std::size_t i = 0; i < mesh.corners() - 1; ++i) f.at[i] = mesh.point(f.nodes[i]);
    return f;
}

/// A mesh whose arrays make nodes and cells, and what is known of it.
struct Checked : CheckRun {
    const Mesh& mesh;
    const ExactVolumes volumes{mesh.dimension, mesh.points};
    const std::vector<std::int8_t>& orientation = report.measures.orientation;
    std::vector<std::uint8_t> finite = {};     ///< 1 for each node whose coordinates are all finite
    std::vector<std::uint8_t> usable = {};     ///< 1 for each cell with d + 1 different nodes that are finite
    Integer total = {};                        ///< d! times the sum of all |volume|, in the unit of `volumes`
    std::vector<Mesh::Index> neighbours = {};  ///< as compute_neighbours gives them, of usable cells
    std::vector<BoundaryFacet> boundary = {};  ///< ordered by their nodes

    bool degenerate(Mesh::Index cell) const { return orientation[static_cast<std::size_t>(cell)] == 0; }
};

// The stages. Each says which defects it finds.

/// Finds not_finite, coincident_nodes, unused_node.
void check_nodes(Checked& c);

/// Fills the report's measures, without shapes if the verdict alone is asked for. Finds index_out_of_range,
/// repeated_node, degenerate_cell, plain_sign_wrong, mixed_orientation.
void check_cells(Checked& c);

/// How cells meet at their facets, and which are the boundary. True if the cells partition a domain, proved by the
/// index (mesh/index/proof.hpp) in less time than the search takes, which finds duplicate_cell, overfull_facet,
/// same_side.
bool check_facets(Checked& c);

/// The boundary as a complex: ridges, pieces, cavities, tunnels. Returns one of the boundary facets of each piece.
/// Finds open_boundary, pinched_ridge, pinched_node, missing_cell.
std::vector<std::uint32_t> check_boundary(Checked& c);

/// P5: finds wrong_neighbour and wrong_face. Nothing where the mesh has none.
void check_files(Checked& c);

/// 1 for each of Mesh::faces that a usable cell has.
std::vector<std::uint8_t> faces_of_cells(const Mesh& mesh, const std::vector<std::uint8_t>& usable);

// Facets and cells that meet where they must not (pairs.cpp).

/// A search is given up after so many pairs: a mesh that is wrong throughout has as many as the square of its cells.
inline constexpr std::size_t pair_limit = 1000;

using CellPair = std::array<Mesh::Index, 2>;

struct HangingNode {
    Mesh::Index node = -1;
    std::array<Mesh::Index, 3> face{-1, -1, -1};  ///< that it lies within, or nearly; ascending
    Mesh::Index cell = -1;                        ///< of the face
    double distance = 0;                          ///< from it, rounded
};

/// The nodes of f within g, or within an edge of it: not those at the place of a node of g. `cell`: that of g.
void add_hanging(int d, const PlacedFacet& f, const PlacedFacet& g, Mesh::Index cell, std::vector<HangingNode>& all);

/// Sorts by node and face. Of entries with the same node and face, keeps the one with the lowest cell.
void sort_hanging(std::vector<HangingNode>& all);

struct BoundaryContacts {
    std::vector<CellPair> cells;       ///< of the facets of each
    std::vector<HangingNode> hanging;  ///< at these facets
    bool complete = true;              ///< there are no more
};

/// P3: finds boundary_contact, up to `limit` of them.
BoundaryContacts find_boundary_contacts(Checked& c, std::size_t limit);

/// P4: finds nested_part, up to `limit`, each with the lowest cell that overlaps. `pieces`: those of check_boundary.
std::vector<CellPair> find_nested_parts(Checked& c, const std::vector<std::uint32_t>& pieces, std::size_t limit);

/// Finds overlapping_cells among all that are not degenerate.
std::vector<CellPair> find_overlapping_cells(Checked& c);

/// The intersection of two closed cells: its dimension (-1: empty) and a point in its relative interior, computed in
/// integers. If the interiors meet, that point lies in both. Requires: finite, and neither degenerate. Slow: tens
/// of microseconds, or up to some milliseconds (coordinates over the whole range of doubles, numbers of 30,000 bits).
CellContact common_part(const Mesh& mesh, const CellPair& cells);

// Nodes near each other, or near what is between others (nodes.cpp, hanging_nodes.cpp, cracks.cpp).

/// Sets 1 for those of the indices that are nodes.
void mark_used(const std::vector<Mesh::Index>& indices, std::vector<std::uint8_t>& used);

/// 1 for each node whose d coordinates are all finite. Finds not_finite, and of those that are not used unused_node.
std::vector<std::uint8_t> find_finite(const std::vector<double>& points, int d, const std::vector<std::uint8_t>& used,
                                      DefectList& defects);

/// Returns pairs of `nodes` at one place: each node that is not the lowest there comes second, after the lowest; sorted
/// by the second. 0 and -0 are one place. Requires: their coordinates are finite.
std::vector<std::array<Mesh::Index, 2>> coincident_nodes(const Mesh& mesh, const std::vector<Mesh::Index>& nodes);

/// Around a node. Rounding keeps the order: no double within the radius is left out.
Box box_around(const Mesh& mesh, Mesh::Index node, double radius);

/// The distance of two nodes, rounded.
double node_distance(const Mesh& mesh, Mesh::Index a, Mesh::Index b);

struct NearPair {
    Mesh::Index first = -1, second = -1;
    double distance = 0;
};

/// found(pair) for the pairs of `nodes`, ascending, that lie no farther apart than `radius` of both, an entry a node,
/// the lower node first; in an order that does not depend on threads. False if there are more than `limit` of them, or
/// on average more than 64 a node over many nodes: those beyond are not found. Memory is bounded by that.
bool for_each_near(const Mesh& mesh, const std::vector<Mesh::Index>& nodes, const std::vector<double>& radius,
                   std::size_t limit, const std::function<void(const NearPair&)>& found);

/// Returns the nodes that nearly lie within an edge or a facet of the boundary: no farther from it than the least
/// radius of the node and the facet's nodes, but farther than that from each of the facet's nodes. Leaves out an edge
/// or facet if one of its cells has the node, too. `radius`: for each node; 0 if it is not on the boundary. Ascending,
/// up to `limit`.
LimitedList<HangingNode> nearly_hanging(const Checked& c, const std::vector<double>& radius, std::size_t limit);

/// Finds near_nodes and near_hanging, as CheckOptions::near has them, crack, and of touching.hanging those that are no
/// near nodes. `meeting`: cells that meet where they must not; what two of them have of these is the cause.
void find_cracks(Checked& c, const BoundaryContacts& touching, const std::vector<CellPair>& meeting);

// Further questions about a mesh, each answered on all threads of the calling arena.

/// Sets CellMeasures::jacobian. Nothing if no cell has a map, or the arrays of the mesh do not fit.
std::optional<MapReport> check_maps(const Checked& c);
DelaunayReport check_delaunay(const Checked& c);

/// Areas mean little where the mesh is not certified. Requires: tetrahedra.
ConformityReport check_conformity(const Checked& c);

}  // namespace barycert::check
