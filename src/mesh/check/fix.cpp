#include "barycert/fix.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "core/base/disjoint_sets.hpp"
#include "core/base/text.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/check/stages.hpp"
#include "mesh/columns.hpp"
#include "mesh/consistency.hpp"
#include "mesh/mid_edges.hpp"
#include "mesh/part.hpp"
#include "mesh/pulling.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert {
namespace {

using Index = Mesh::Index;
using Nodes = std::array<Index, 4>;

/// A node, cell or face that goes, and what is in its place.
struct Twin {
    Index gone, kept;
};

std::size_t at(Index i) {
    return static_cast<std::size_t>(i);
}

/// Splits rows, sorted by their keys: the first of each key is kept; the others go if `twins_go`, else they are kept,
/// too.
template <class Key>
void split(const std::vector<std::pair<Key, Index>>& rows, bool twins_go, std::vector<Index>& kept,
           std::vector<Twin>& twins) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (twins_go && i > 0 && rows[i].first == rows[i - 1].first)
            twins.push_back({rows[i].second, kept.back()});
        else
            kept.push_back(rows[i].second);
    }
}

class Fix {
public:
    Fix(const Mesh& mesh, const FixOptions& options, FixReport& report)
        : old_(mesh), options_(options), report_(report), mesh_(mesh), same_(mesh.point_count()) {}

    Result<Mesh> run() {
        if (options_.nodes && !merge_nodes())
            return Error{.code = "option.value",
                         .what = "so large a distance would merge nodes throughout the mesh",
                         .found = base::shortest(options_.merge_within),
                         .remedy = "take one that is small beside the edges of the cells"};
        cut_again();
        mesh_.shapes = {};  // the copy has their parts
        renumber();
        if (options_.cells) drop_cells();
        if (options_.nodes || options_.cells) drop_faces();
        renew_neighbours();
        if (options_.orientation) turn_cells();
        return std::move(mesh_);
    }

private:
    /// Vertices of cells by themselves, and the other nodes of edges: a node that no cell has may have any values.
    /// False if too many are near.
    bool merge_nodes() {
        std::vector<std::uint8_t> role(old_.point_count(), 0);
        for (const Index n : old_.mid_nodes) role[at(n)] = 1;
        for (const Index n : old_.cells) role[at(n)] = 2;
        for (const int kind : {1, 2}) {
            std::vector<Index> nodes;
            for (std::size_t n = 0; n < role.size(); ++n) {
                if (role[n] == kind) nodes.push_back(static_cast<Index>(n));
            }
            const auto coincident = check::coincident_nodes(old_, nodes);
            for (const auto& [first, second] : coincident) same_.join(at(first), at(second));
            if (options_.merge_within == 0) continue;
            std::erase_if(nodes, [&](Index n) { return same_.find(at(n)) != at(n); });
            const auto join = [&](const check::NearPair& p) { same_.join(at(p.first), at(p.second)); };
            const std::vector<double> radius(nodes.size(), options_.merge_within);
            if (!check::for_each_near(old_, nodes, radius, 50 * nodes.size(), join)) return false;
        }
        if (!old_.mid_nodes.empty()) merge_mid_nodes(role);
        return true;
    }

    /// Edges that merging their ends made one have one node in the middle, wherever theirs were.
    void merge_mid_nodes(const std::vector<std::uint8_t>& role) {
        struct Edge {
            std::array<Index, 2> ends, given;
            Index mid;
            auto operator<=>(const Edge&) const = default;  // NOLINT(modernize-use-nullptr)
        };
        std::vector<std::uint8_t> merged(old_.point_count(), 0);
        for (std::size_t n = 0; n < merged.size(); ++n) {
            if (same_.find(n) != n) merged[n] = merged[same_.find(n)] = 1;
        }
        std::vector<Edge> all;
        const auto edges = mesh::edges_of(old_.dimension);
        for (std::size_t i = 0; i < old_.mid_nodes.size(); ++i) {
            const Index* const cell = &old_.cells[i / edges.size() * old_.corners()];
            const auto& [first, second] = edges[i % edges.size()];
            const Index a = cell[first], b = cell[second];
            const auto x = static_cast<Index>(same_.find(at(a))), y = static_cast<Index>(same_.find(at(b)));
            if (x == y || (merged[at(a)] == 0 && merged[at(b)] == 0) || role[at(old_.mid_nodes[i])] == 2) continue;
            all.push_back({{std::min(x, y), std::max(x, y)}, {std::min(a, b), std::max(a, b)}, old_.mid_nodes[i]});
        }
        std::sort(all.begin(), all.end());
        for (std::size_t i = 0, next = 0; i < all.size(); i = next) {
            while (next < all.size() && all[next].ends == all[i].ends) ++next;
            if (all[next - 1].given == all[i].given) continue;  // they were one before
            for (std::size_t k = i; k < next; ++k) same_.join(at(all[i].mid), at(all[k].mid));
        }
    }

    /// Cells of other shapes are those of the merged nodes, which may be other parts: they are cut at other nodes.
    void cut_again() {
        Mesh::Shapes& shapes = mesh_.shapes;
        bool merged = false;
        for (std::vector<Index>* const nodes : {&shapes.nodes, &shapes.rings}) {
            for (Index& node : *nodes) {
                const auto into = static_cast<Index>(same_.find(at(node)));
                merged |= into != node;
                node = into;
            }
        }
        if (merged) {
            Mesh rows = mesh::rows_of_wholes(mesh_);
            mesh_.cell_fields = std::move(rows.cell_fields);
            mesh_.cell_labels = std::move(rows.cell_labels);
            mesh::keep_rows(mesh_.cell_numbers, 1, std::vector(shapes.parts.begin(), shapes.parts.end() - 1));
            mesh_.neighbours.clear();
            mesh::cut_into_simplices(mesh_);
        }
        wholes_ = mesh::whole_of_parts(mesh_);
        uncut_ = mesh::uncut_parts(mesh_);
    }

    /// Nodes of a cell of the copy, or of the cell that it is a part of, as they were.
    std::span<const Index> given_nodes(Index cell) const {
        return wholes_.empty() ? old_.corners_of(at(cell)) : old_.shapes.nodes_of(at(wholes_[at(cell)]));
    }
    /// The cell of the mesh as it was, the first part of a shape.
    Index given_cell(Index cell) const { return wholes_.empty() ? cell : old_.shapes.parts[at(wholes_[at(cell)])]; }

    void renew_neighbours() {
        if (mesh_.neighbours.empty()) return;
        std::vector<Index> made = mesh::compute_neighbours(mesh_);
        for (std::size_t i = 0; i < made.size() && report_.dropped.empty(); ++i)
            report_.changed_neighbours += made[i] != mesh_.neighbours[i] ? 1 : 0;
        mesh_.neighbours = std::move(made);
    }

    void renumber() {
        std::vector<Index> kept, number(old_.point_count());
        for (std::size_t n = 0; n < number.size(); ++n) {
            const std::uint32_t into = same_.find(n);
            if (into == n) {
                number[n] = static_cast<Index>(kept.size());
                kept.push_back(static_cast<Index>(n));
                continue;
            }
            number[n] = number[into];
            report_.merged.push_back({static_cast<Index>(n), static_cast<Index>(into),
                                      check::node_distance(old_, static_cast<Index>(n), static_cast<Index>(into))});
        }
        if (report_.merged.empty()) return;
        std::vector<Twin> twins;
        for (const MergedNode& m : report_.merged) twins.push_back({m.node, m.into});
        for (const Field& f : old_.point_fields) compare_values(f, twins, report_.fields);
        report_.differing_markers = count_differing(old_.point_markers, twins);
        for (auto* list : {&mesh_.cells, &mesh_.mid_nodes, &mesh_.faces, &mesh_.face_mid_nodes}) {
            for (Index& n : *list) n = number[at(n)];
        }
        mesh::keep_rows(mesh_.points, at(old_.dimension), kept);
        mesh::keep_rows(mesh_.point_markers, 1, kept);
        for (Field& f : mesh_.point_fields) mesh::keep_rows(f.data, at(f.components), kept);
    }

    static void compare_values(const Field& f, const std::vector<Twin>& twins, std::vector<MergedField>& to) {
        MergedField told{f.name};
        for (const auto& [gone, kept] : twins) {
            bool differs = false;
            for (std::size_t c = 0; c < at(f.components); ++c) {
                const double a = f.data[at(gone) * at(f.components) + c];
                const double b = f.data[at(kept) * at(f.components) + c];
                differs |= a != b && !(std::isnan(a) && std::isnan(b));
                if (std::isfinite(a) && std::isfinite(b))
                    told.max_difference = std::max(told.max_difference, std::fabs(a - b));
            }
            told.differ += differs ? 1 : 0;
        }
        if (told.differ != 0) to.push_back(std::move(told));
    }

    /// Counts the pairs whose values differ, of nodes, cells or faces; 0 if there are no values.
    template <class T>
    static std::uint64_t count_differing(const std::vector<T>& values, const std::vector<Twin>& twins) {
        if (values.empty()) return 0;
        return static_cast<std::uint64_t>(
            std::ranges::count_if(twins, [&](const Twin& t) { return values[at(t.gone)] != values[at(t.kept)]; }));
    }

    int sign(std::size_t cell) const { return check::exact_sign(mesh_.dimension, check::corner_points(mesh_, cell)); }

    Nodes sorted_nodes(std::size_t cell) const {
        Nodes nodes{-1, -1, -1, -1};
        std::ranges::copy(mesh_.corners_of(cell), nodes.begin());
        std::ranges::sort(nodes);  // a triangle's first is -1
        return nodes;
    }

    void drop_cells() {
        std::vector<std::pair<Nodes, Index>> good;
        const auto is_merged = [&](Index n) {
            return std::ranges::binary_search(report_.merged, n, {}, &MergedNode::node);
        };
        const auto drop = [&](Index cell, DefectKind why) {
            report_.dropped.push_back({given_cell(cell), why});
            report_.collapsed += std::ranges::any_of(given_nodes(cell), is_merged) ? 1 : 0;
        };
        for (std::size_t cell = 0; cell < mesh_.cell_count(); ++cell) {
            const Nodes nodes = sorted_nodes(cell);
            const auto number = static_cast<Index>(cell);
            if (std::ranges::binary_search(uncut_, number))
                drop(number, DefectKind::uncut_cell);
            else if (std::ranges::adjacent_find(nodes) != nodes.end())
                drop(number, DefectKind::repeated_node);
            else if (sign(cell) == 0)
                drop(number, DefectKind::degenerate_cell);
            else
                good.emplace_back(nodes, number);
        }
        std::ranges::sort(good);
        std::vector<Index> kept;
        std::vector<Twin> twins;
        split(good, true, kept, twins);
        for (const Twin& twin : twins) drop(twin.gone, DefectKind::duplicate_cell);
        for (const Field& f : mesh_.cell_fields) compare_values(f, twins, report_.cell_fields);
        for (const Column& labels : mesh_.cell_labels) {
            const auto differ = std::visit([&](const auto& v) { return count_differing(v, twins); }, labels.values);
            if (differ != 0) report_.cell_fields.push_back({labels.name, differ});
        }
        if (report_.dropped.empty()) return;
        std::ranges::sort(kept);
        std::ranges::sort(report_.dropped, {}, &DroppedCell::cell);
        mesh::keep_rows(mesh_.cells, mesh_.corners(), kept);
        mesh::keep_rows(mesh_.mid_nodes, mesh::edges_of(mesh_.dimension).size(), kept);
        for (Field& f : mesh_.cell_fields) mesh::keep_rows(f.data, at(f.components), kept);
        for (Column& labels : mesh_.cell_labels) labels = mesh::labels_at(labels, kept);
        if (mesh_.cell_numbers.empty())
            mesh_.cell_numbers = kept;
        else
            mesh::keep_rows(mesh_.cell_numbers, 1, kept);
    }

    /// Drops faces that no cell has, and all but the first of those that merging made the same.
    void drop_faces() {
        if (mesh_.faces.empty()) return;
        const auto found = check::faces_of_cells(mesh_, std::vector<std::uint8_t>(mesh_.cell_count(), 1));
        std::vector<std::pair<std::array<Index, 3>, Index>> faces;
        for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
            std::array<Index, 3> face{mesh_.faces[3 * f], mesh_.faces[3 * f + 1], mesh_.faces[3 * f + 2]};
            std::ranges::sort(face);
            if (found[f] != 0) faces.emplace_back(face, static_cast<Index>(f));
        }
        std::ranges::sort(faces);
        std::vector<Index> kept;
        std::vector<Twin> twins;
        split(faces, !report_.merged.empty(), kept, twins);
        report_.differing_face_markers = count_differing(mesh_.face_markers, twins);
        report_.dropped_faces = mesh_.face_count() - kept.size();
        if (report_.dropped_faces == 0) return;
        std::ranges::sort(kept);
        mesh::keep_rows(mesh_.faces, 3, kept);
        mesh::keep_rows(mesh_.face_mid_nodes, 3, kept);
        mesh::keep_rows(mesh_.face_markers, 1, kept);
    }

    /// The last two vertices of negative cells swapped, and their mid-edge nodes and neighbours with them.
    void turn_cells() {
        const std::size_t corners = mesh_.corners(), edges = mesh::edges_of(mesh_.dimension).size();
        for (std::size_t cell = 0; cell < mesh_.cell_count(); ++cell) {
            if (sign(cell) >= 0) continue;
            ++report_.turned;
            for (auto* list : {&mesh_.cells, &mesh_.neighbours}) {
                if (list->empty()) continue;
                Index* const end = list->data() + (cell + 1) * corners;
                std::swap(end[-2], end[-1]);
            }
            if (mesh_.mid_nodes.empty()) continue;
            // Edges that change places, by the order of edges_of: 12 and 13, 02 and 03; of a triangle 01 and 02.
            Index* const mid = &mesh_.mid_nodes[cell * edges];
            std::swap(mid[mesh_.dimension == 3 ? 1 : 0], mid[mesh_.dimension == 3 ? 4 : 2]);
            if (mesh_.dimension == 3) std::swap(mid[2], mid[3]);
        }
    }

    const Mesh& old_;
    const FixOptions& options_;
    FixReport& report_;
    Mesh mesh_;
    std::vector<Index> wholes_;  ///< the shape of each cell; empty without shapes
    std::vector<Index> uncut_;   ///< cells that stand for shapes that cannot be cut
    base::DisjointSets same_;
};

}  // namespace

Result<Mesh> fix_mesh(const Mesh& mesh, const FixOptions& options, FixReport& report) {
    const ExactEnvironment environment;
    report = {};
    if (const char* fault = mesh::inconsistency(mesh, mesh::FieldValues::any); fault != nullptr)
        return Error{.code = "mesh.inconsistent", .what = "this mesh cannot be fixed", .found = fault};
    if (!(options.merge_within >= 0) || !std::isfinite(options.merge_within))
        return Error{.code = "option.value",
                     .what = "the distance within which nodes are merged is not one",
                     .expected = "a finite number from 0 on",
                     .found = base::shortest(options.merge_within)};
    return base::in_arena(options.threads, mesh.cells.size(), [&] { return Fix(mesh, options, report).run(); });
}

}  // namespace barycert
