#include "app/report/check/check_words.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/report/common/terminal_text.hpp"
#include "barycert/check.hpp"
#include "barycert/check_job.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/fix.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/surface_report.hpp"
#include "core/base/text.hpp"

namespace barycert::report {
namespace {

/// Returns the indices that are given, once each.
std::vector<Mesh::Index> used(const auto& indices) {
    std::vector<Mesh::Index> list;
    for (const Mesh::Index i : indices) {
        if (i >= 0 && (list.empty() || list.back() != i)) list.push_back(i);
    }
    return list;
}

void tell_differing(std::vector<std::string>& all, const std::vector<MergedField>& fields, std::string_view one,
                    std::string_view more, std::string_view than) {
    for (const MergedField& f : fields)
        all.push_back(fmt::format("field {}: {} than the {} that is kept{}: those are left out",
                                  base::printable(f.name), counted(f.differ, one, more), than,
                                  f.max_difference == 0 ? "" : ", by up to " + base::shortest(f.max_difference)));
}

std::vector<ConditionRow> conditions_of(const CheckReport& report) {
    if (report.surface) {
        const bool plc = report.surface->plc;
        return {
            {"S1", plc ? "every facet is simple, with finite coordinates and an area"
                       : "every triangle has 3 different nodes, finite coordinates and an area"},
            {"S2", plc ? "facets, segments and nodes meet only in nodes and segments that they share"
                       : "triangles meet only in nodes and edges that they share"},
            {"S3", plc ? "the facets enclose a region" : "the surface is closed: each edge has two triangles or more"}};
    }
    const bool plane = report.dimension == 2;
    return {{"P1", plane ? "every cell has 3 different nodes, finite coordinates and an area"
                         : "every cell has 4 different nodes, finite coordinates and a volume"},
            {"P2", "a facet belongs to one cell, or to two on opposite sides of it"},
            {"P3", plane ? "boundary facets meet only in nodes that they share"
                         : "boundary facets meet only in nodes and edges that they share"},
            {"P4", "no piece of the boundary lies inside cells"},
            {"", "hence, by P1 to P4: no two cells overlap"},
            {"P5", plane ? "neighbours in the files are those of the cells"
                         : "neighbours and faces in the files are those of the cells"}};
}

/// A condition that cells and surfaces share has the name of P1.
bool violates(const Defect& f, const ConditionRow& row) {
    if (row.name.empty()) return f.kind == DefectKind::overlapping_cells;
    const std::string_view of = defect_text(f.kind).condition;
    return of == row.name || (of == "P1" && row.name == "S1");
}

}  // namespace

std::vector<ConditionRow> condition_rows(const CheckReport& report, const Mesh& mesh) {
    std::vector<ConditionRow> rows = conditions_of(report);
    const bool files = !mesh.neighbours.empty() || !mesh.faces.empty();
    const bool looked_at = report.find(DefectKind::bad_structure) == nullptr;
    for (ConditionRow& row : rows) {
        for (const Defect& f : report.defects) {
            if (!f.breaks() || !violates(f, row)) continue;
            row.count += f.count;
            row.at_least |= f.at_least;
        }
        const bool unknown = row.name == "S3" && row.count == 0 && !report.surface->closed;
        row.instead = !looked_at || unknown ? "not checked" : row.name == "P5" && !files ? "not provided" : "ok";
    }
    return rows;
}

std::string place_text(const CheckReport& report, DefectKind kind, const DefectPlace& p) {
    const auto cells = used(report.cell_number(p.cells));
    const char* const cell = cell_word(report);
    auto nodes = used(p.nodes), others = used(p.other_nodes);
    const std::string on = fmt::format("{} {} of {} {}", others.size() == 2 ? "edge" : "facet", fmt::join(others, " "),
                                       cell, fmt::join(cells, " "));
    if (kind == DefectKind::hanging_node || (kind == DefectKind::node_on_facet && !others.empty()))
        return fmt::format("node {} within {}", fmt::join(nodes, " "),
                           cells.empty() ? fmt::format("segment {}", fmt::join(others, " ")) : on);
    if (kind == DefectKind::near_hanging)
        return fmt::format("node {}, {:.3g} off {} ({:.3g} of an edge)", fmt::join(nodes, " "), p.distance, on,
                           p.relative);
    if (kind == DefectKind::near_nodes)
        return fmt::format("nodes {}, {:.3g} apart ({:.3g} of an edge)", fmt::join(nodes, " and "), p.distance,
                           p.relative);
    if (kind == DefectKind::missing_cell) nodes.insert(nodes.end(), others.begin(), others.end()), others.clear();
    std::string out;
    if (kind == DefectKind::facet_off_plane)
        return fmt::format("{} {}, by {:.3g} ({:.3g} of the extent)", cell, fmt::join(cells, " "), p.distance,
                           p.relative);
    if (!cells.empty()) out += fmt::format("{}{} {}", cell, cells.size() == 1 ? "" : "s", fmt::join(cells, " and "));
    if (!nodes.empty())
        out += fmt::format("{}node{} {}{}{}", out.empty() ? "" : ", ", nodes.size() == 1 ? "" : "s",
                           fmt::join(nodes, " "), others.empty() ? "" : " and ", fmt::join(others, " "));
    if (p.point) return fmt::format("{} at ({})", p.detail, base::joined(*p.point, ", ", base::shortest));
    if (*p.detail != '\0') out += fmt::format("{}({})", out.empty() ? "" : " ", p.detail);
    return out;
}

std::string domain_text(const CheckReport& r) {
    std::string text = counted(r.parts, "part");
    if (const auto& n = r.boundary.cavities)
        text += ", " + (r.dimension == 2 ? counted(*n, "hole") : counted(*n, "cavity", "cavities"));
    if (const auto& n = r.boundary.tunnels) text += ", " + counted(static_cast<std::uint64_t>(*n), "tunnel");
    return text;
}

std::vector<std::string> delaunay_sentences(const CheckReport& r) {
    const DelaunayReport& d = *r.delaunay;
    std::string outcome = fmt::format(
        "{} tested: {}", counted(d.facets, "interior facet"),
        d.violations == 0 ? "all are locally Delaunay" : counted(d.violations, "is", "are") + " not locally Delaunay");
    if (d.cospherical != 0)
        outcome += fmt::format("; {} {}", d.cospherical, r.dimension == 2 ? "cocircular" : "cospherical");
    std::vector<std::string> all{std::move(outcome)};
    if (d.violations != 0)
        all.push_back(fmt::format("worst: node {} lies inside the circum{} of cell {}, {:.3g} of its radius deep",
                                  d.worst_node, r.dimension == 2 ? "circle" : "sphere", r.cell_number(d.worst_cell),
                                  d.worst_depth));
    return all;
}

std::vector<std::string> conformity_sentences(const CheckReport& r, std::size_t room) {
    const ConformityReport& c = *r.conformity;
    std::vector<std::string> all{fmt::format("{} of the PLC: {} respected exactly, {} up to rounding, {} violated",
                                             counted(c.facets, "facet"), c.exact, c.rounded, c.violated)};
    if (c.rounded != 0)
        all.push_back(fmt::format("nodes lie up to {:.3g} from the plane of their facet, {:.3g} of the PLC's extent",
                                  c.max_distance, c.relative_distance));
    if (c.missing_vertices != 0)
        all.push_back(counted(c.missing_vertices, "vertex of these facets is not a node",
                              "vertices of these facets are not nodes"));
    std::string violated;
    std::size_t shown = 0;
    for (; shown < c.examples.size(); ++shown) {
        const ViolatedFacet& f = c.examples[shown];
        const std::string one = fmt::format("{}{} ({:.3g} %)", violated.empty() ? "" : ", ", f.facet, 100 * f.covered);
        if (violated.size() + one.size() > room) break;
        violated += one;
    }
    if (shown == 0) return all;
    if (c.violated > shown) violated += fmt::format(", and {} more", c.violated - shown);
    all.push_back("violated facets (area of faces centred on them): " + violated);
    return all;
}

constexpr double tetgen_tolerance = 1e-8;

std::string tetgen_sentence(const CheckReport& r) {
    const SurfaceReport& s = *r.surface;
    const std::string reasons = joined(r.defects, ", ", [](const Defect& f) {
        // TetGen makes one node of two at one place, and leaves out what collapses.
        const bool minor = f.kind == DefectKind::open_edge || f.kind == DefectKind::repeated_node;
        return minor || !f.breaks() ? "" : reason(f);
    });
    if (!reasons.empty()) return "TetGen will not get a valid PLC: " + reasons;
    const auto left = std::ranges::count(s.regions, false, &SurfaceRegion::hole);
    if (s.regions.empty()) return "TetGen will have nothing to mesh: the triangles enclose no region";
    if (left == 0) return "TetGen will have nothing to mesh: hole points lie in all regions";
    std::string off;
    // A smaller distance does not matter to TetGen; notes tell it.
    if (s.relative_off_plane > tetgen_tolerance)
        off = fmt::format("; {} up to {:.3g} of its extent off {} plane, where TetGen's own tolerance is 1e-8",
                          counted(s.off_plane, "facet is", "facets are"), s.relative_off_plane,
                          s.off_plane == 1 ? "its" : "their");
    return fmt::format("TetGen will get a valid PLC that bounds {}{}",
                       counted(static_cast<std::uint64_t>(left), "region"), off);
}

std::vector<std::string> fix_sentences(const FixedMesh& fixed) {
    const FixReport& done = fixed.done;
    std::vector<std::string> all;
    const auto add = [&](std::uint64_t n, std::string_view one, std::string_view more, std::string_view text) {
        if (n != 0) all.push_back(counted(n, one, more) + std::string(text));
    };
    if (!done.merged.empty()) {
        const auto far = std::ranges::max_element(done.merged, {}, &MergedNode::moved);
        all.push_back(counted(done.merged.size(), "node") + " merged into the lowest at their place" +
                      (far->moved == 0 ? "; none moved"
                                       : fmt::format(", moved by at most {} (node {} to node {})",
                                                     base::shortest(far->moved), far->node, far->into)));
    }
    tell_differing(all, done.fields, "merged node has another value", "merged nodes have other values", "node");
    add(done.differing_markers, "merged node has another marker", "merged nodes have other markers",
        " than the node that is kept: those are left out");
    if (!done.dropped.empty()) {
        constexpr std::array kinds{DefectKind::repeated_node, DefectKind::degenerate_cell, DefectKind::duplicate_cell,
                                   DefectKind::uncut_cell};
        const std::string why = joined(kinds, ", ", [&](DefectKind kind) {
            const auto count = std::ranges::count(done.dropped, kind, &DroppedCell::why);
            return count == 0 ? "" : fmt::format("{} {}", count, defect_text(kind).name);
        });
        all.push_back(
            fmt::format("{} dropped: {}{}", counted(done.dropped.size(), "cell"), why,
                        done.collapsed == 0 ? "" : fmt::format("; {} of them have merged nodes", done.collapsed)));
    }
    tell_differing(all, done.cell_fields, "duplicate has another value", "duplicates have other values", "cell");
    add(done.dropped_faces, "face", "faces", " dropped: no cell has them, or they became twins");
    add(done.differing_face_markers, "twin has another marker", "twins have other markers",
        " than the face that is kept: those are left out");
    add(done.changed_neighbours, "entry", "entries", " of neighbours corrected");
    add(done.turned, "cell", "cells", " turned to positive orientation");
    if ((!done.merged.empty() || !done.dropped.empty()) && fixed.after.cells != 0)
        all.emplace_back("nodes and cells behind those that went are numbered anew; --json FILE lists which went");
    if (all.empty())
        all.emplace_back(fixed.notes.empty() ? "nothing to repair: the copy is as the mesh is" : "nothing to repair");
    for (const Note& note : fixed.notes) all.push_back(message(note));
    return all;
}

}  // namespace barycert::report
