#include "barycert/report/check/check_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "barycert/base/text.hpp"
#include "barycert/report/common/not_finite.hpp"

namespace barycert::report {
namespace {

template <std::size_t N>
std::vector<Mesh::Index> used(const std::array<Mesh::Index, N>& indices) {
    std::vector<Mesh::Index> list;
    for (const Mesh::Index i : indices) {
        if (i >= 0 && (list.empty() || list.back() != i)) list.push_back(i);
    }
    return list;
}

}  // namespace

std::vector<ConditionRow> condition_rows(const CheckReport& report, const Mesh& mesh) {
    const bool plane = report.dimension == 2;
    std::vector<ConditionRow> rows{
        {"P1", plane ? "every cell has 3 different nodes, finite coordinates and an area"
                     : "every cell has 4 different nodes, finite coordinates and a volume"},
        {"P2", "a facet belongs to one cell, or to two on opposite sides of it"},
        {"P3", plane ? "boundary facets meet only in nodes that they share"
                     : "boundary facets meet only in nodes and edges that they share"},
        {"P4", "no piece of the boundary lies inside cells"},
        {"", "hence, by P1 to P4: no two cells overlap"},
        {"P5", plane ? "neighbours in the files are those of the cells"
                     : "neighbours and faces in the files are those of the cells"},
    };
    const bool files = !mesh.neighbours.empty() || !mesh.faces.empty();
    const bool looked_at = report.find(DefectKind::bad_structure) == nullptr;
    for (ConditionRow& row : rows) {
        for (const Defect& f : report.defects) {
            const bool here =
                row.name.empty() ? f.kind == DefectKind::overlapping_cells : defect_text(f.kind).condition == row.name;
            if (!defect_text(f.kind).breaks || !here) continue;
            row.count += f.count;
            row.at_least |= f.at_least;
        }
        row.instead = !looked_at ? "not checked" : row.name == "P5" && !files ? "not provided" : "ok";
    }
    return rows;
}

std::string_view left_out_sentence(const CheckReport& report) {
    const bool some = std::any_of(report.defects.begin(), report.defects.end(), [](const Defect& f) {
        return f.kind == DefectKind::index_out_of_range || f.kind == DefectKind::not_finite ||
               f.kind == DefectKind::repeated_node;
    });
    return some ? "P2 to P5 leave out cells with an invalid index, a non-finite coordinate or a repeated node." : "";
}

std::string place_text(const CheckReport& report, DefectKind kind, const DefectPlace& p) {
    const auto cells = used(report.cell_number(p.cells));
    auto nodes = used(p.nodes), others = used(p.other_nodes);
    const std::string on = fmt::format("{} {} of cell {}", others.size() == 2 ? "edge" : "facet",
                                       fmt::join(others, " "), fmt::join(cells, " "));
    if (kind == DefectKind::hanging_node) return fmt::format("node {} within {}", fmt::join(nodes, " "), on);
    if (kind == DefectKind::near_hanging)
        return fmt::format("node {}, {:.3g} off {} ({:.3g} of an edge)", fmt::join(nodes, " "), p.distance, on,
                           p.relative);
    if (kind == DefectKind::near_nodes)
        return fmt::format("nodes {}, {:.3g} apart ({:.3g} of an edge)", fmt::join(nodes, " and "), p.distance,
                           p.relative);
    if (kind == DefectKind::missing_cell) nodes.insert(nodes.end(), others.begin(), others.end()), others.clear();
    std::string out;
    if (!cells.empty()) out += fmt::format("cell{} {}", cells.size() == 1 ? "" : "s", fmt::join(cells, " and "));
    if (!nodes.empty())
        out += fmt::format("{}node{} {}{}{}", out.empty() ? "" : ", ", nodes.size() == 1 ? "" : "s",
                           fmt::join(nodes, " "), others.empty() ? "" : " and ", fmt::join(others, " "));
    if (*p.detail != '\0') out += fmt::format("{}({})", out.empty() ? "" : " ", p.detail);
    return out;
}

std::string numbering_sentence(const CheckReport& report, const Mesh& mesh) {
    return fmt::format("Cells and nodes are numbered from 0 in file order{}{}.",
                       report.cell_numbers.empty() ? "" : ", cells that were left out included",
                       mesh.index_base == 1 ? " (the file itself numbers from 1)" : "");
}

std::vector<std::string> note_sentences(const CheckReport& report) {
    std::vector<std::string> all;
    all.reserve(report.notes.size());
    for (const Note& note : report.notes) all.push_back(message(note));
    for (const NotFinite& field : report.not_finite) all.push_back(not_finite_text(field));
    return all;
}

std::vector<std::string> fix_sentences(const FixedMesh& fixed) {
    const FixReport& done = fixed.done;
    const auto counted = [](std::uint64_t n, std::string_view one, std::string_view more) {
        return fmt::format("{} {}", n, n == 1 ? one : more);
    };
    std::vector<std::string> all;
    const auto tell_differing = [&](const std::vector<MergedField>& fields, std::string_view one, std::string_view more,
                                    std::string_view than) {
        for (const MergedField& f : fields)
            all.push_back(fmt::format("field {}: {} than the {} that is kept{}: those are left out",
                                      base::printable(f.name), counted(f.differ, one, more), than,
                                      f.max_difference == 0 ? "" : ", by up to " + base::shortest(f.max_difference)));
    };
    if (!done.merged.empty()) {
        const auto far = std::max_element(done.merged.begin(), done.merged.end(),
                                          [](const MergedNode& a, const MergedNode& b) { return a.moved < b.moved; });
        all.push_back(fmt::format("{} merged into the lowest at their place{}",
                                  counted(done.merged.size(), "node", "nodes"),
                                  far->moved == 0 ? "; none moved"
                                                  : fmt::format(", moved by at most {} (node {} to node {})",
                                                                base::shortest(far->moved), far->node, far->into)));
    }
    tell_differing(done.fields, "merged node has another value", "merged nodes have other values", "node");
    if (done.differing_markers != 0)
        all.push_back(
            counted(done.differing_markers, "merged node has another marker", "merged nodes have other markers") +
            " than the node that is kept: those are left out");
    if (!done.dropped.empty()) {
        std::vector<std::string> kinds;
        for (const DefectKind kind :
             {DefectKind::repeated_node, DefectKind::degenerate_cell, DefectKind::duplicate_cell}) {
            const auto count = std::count_if(done.dropped.begin(), done.dropped.end(),
                                             [&](const DroppedCell& c) { return c.why == kind; });
            if (count != 0) kinds.push_back(fmt::format("{} {}", count, defect_text(kind).name));
        }
        all.push_back(
            fmt::format("{} dropped: {}{}", counted(done.dropped.size(), "cell", "cells"), fmt::join(kinds, ", "),
                        done.collapsed == 0 ? "" : fmt::format("; {} of them have merged nodes", done.collapsed)));
    }
    tell_differing(done.cell_fields, "duplicate has another value", "duplicates have other values", "cell");
    if (done.dropped_faces != 0)
        all.push_back(counted(done.dropped_faces, "face", "faces") +
                      " dropped: no cell has them, or they became twins");
    if (done.differing_face_markers != 0)
        all.push_back(counted(done.differing_face_markers, "twin has another marker", "twins have other markers") +
                      " than the face that is kept: those are left out");
    if (done.changed_neighbours != 0)
        all.push_back(counted(done.changed_neighbours, "entry", "entries") + " of neighbours corrected");
    if (done.turned != 0) all.push_back(counted(done.turned, "cell", "cells") + " turned to positive orientation");
    if ((!done.merged.empty() || !done.dropped.empty()) && fixed.after.cells != 0)
        all.emplace_back("nodes and cells behind those that went are numbered anew; --json FILE lists which went");
    if (all.empty())
        all.emplace_back(fixed.notes.empty() ? "nothing to repair: the copy is as the mesh is" : "nothing to repair");
    for (const Note& note : fixed.notes) all.push_back(message(note));
    return all;
}

std::string_view meeting_text(const CellContact& c) {
    static constexpr std::array<std::string_view, 3> extents{"touch in a point", "touch along a segment",
                                                             "touch in an area"};
    return c.overlap ? "overlap" : extents[static_cast<std::size_t>(std::clamp(c.dimension, 0, 2))];
}

std::string shortened_fraction(const std::string& fraction, std::size_t longest) {
    if (fraction.size() <= longest) return fraction;
    const std::size_t end = longest * 3 / 10;
    return fmt::format("{}...{} ({} characters)", fraction.substr(0, end), fraction.substr(fraction.size() - end),
                       fraction.size());
}

std::vector<double> cell_sizes(const CellMeasures& measures) {
    std::vector<double> sizes(measures.volume);
    for (double& x : sizes) x = std::fabs(x);
    return sizes;
}

std::vector<double> lost_bits(const CellMeasures& measures) {
    std::vector<double> bits(measures.condition);
    for (double& x : bits) x = std::isnan(x) ? x : std::log2(std::max(1.0, x));  // kappa is at least 1, but rounded
    return bits;
}

std::string grouped(std::uint64_t n) {
    std::string digits = std::to_string(n);
    for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, ",");
    return digits;
}

std::string CheckWords::number(std::uint64_t n) const {
    return digits_ == Digits::grouped ? grouped(n) : std::to_string(n);
}

std::string CheckWords::counted(std::uint64_t n, std::string_view one, std::string_view more) const {
    return fmt::format("{} {}", number(n), n == 1 ? one : more);
}

std::string CheckWords::count_of(const Defect& defect) const {
    return (defect.at_least ? "at least " : "") + number(defect.count);
}

std::string CheckWords::domain() const {
    std::string text = counted(r_.parts, "part", "parts");
    if (r_.boundary.cavities) {
        text += ", " + (r_.dimension == 2 ? counted(*r_.boundary.cavities, "hole", "holes")
                                          : counted(*r_.boundary.cavities, "cavity", "cavities"));
    }
    if (r_.boundary.tunnels) {
        text += ", " + counted(static_cast<std::uint64_t>(*r_.boundary.tunnels), "tunnel", "tunnels");
    }
    return text;
}

std::string CheckWords::certified() const {
    return fmt::format("{} {} a domain of {}", counted(r_.cells, "cell", "cells"), r_.cells == 1 ? "is" : "partition",
                       domain());
}

std::string CheckWords::proof() const {
    return fmt::format("Proved {}cells meet in a common face or not at all. No overlap, no gap.",
                       r_.curved.cells == 0 ? "in exact arithmetic: any two " : "exactly: any two straight ");
}

std::string CheckWords::curved(const Defect& defect) const {
    return counted(defect.curved_cells, "cell of these is", "cells of these are") +
           " curved: sides of curved cells were taken as straight";
}

std::string CheckWords::orientations() const {
    return fmt::format("{} positive, {} negative, {} degenerate, by the exact sign of the {}", number(r_.positive),
                       number(r_.negative), number(r_.degenerate), size_word());
}

std::string CheckWords::volumes() const {
    return fmt::format("{} in the cells, {} inside the boundary", base::shortest(r_.volume.cells),
                       base::shortest(r_.volume.boundary));
}

std::string CheckWords::uncounted() const {
    if (r_.boundary.cavities) return "";
    return fmt::format("{} are not counted where the boundary is {}",
                       r_.dimension == 2 ? "holes" : "cavities and tunnels",
                       r_.boundary.closed ? "pinched along a ridge" : "open");
}

std::string CheckWords::checked() const {
    return fmt::format("{}, {}; checked in {:.3g} s on {}", counted(r_.nodes, "node", "nodes"),
                       counted(r_.cells, "cell", "cells"), r_.seconds,
                       counted(static_cast<std::uint64_t>(r_.threads), "thread", "threads"));
}

std::vector<std::string> CheckWords::delaunay() const {
    const DelaunayReport& d = *r_.delaunay;
    std::string outcome = fmt::format(
        "{} tested: {}", counted(d.facets, "interior facet", "interior facets"),
        d.violations == 0 ? "all are locally Delaunay" : counted(d.violations, "is", "are") + " not locally Delaunay");
    if (d.cospherical != 0)
        outcome += fmt::format("; {} {}", number(d.cospherical), r_.dimension == 2 ? "cocircular" : "cospherical");
    std::vector<std::string> all{std::move(outcome)};
    if (d.violations != 0)
        all.push_back(fmt::format("worst: node {} lies inside the circum{} of cell {}, {:.3g} of its radius deep",
                                  d.worst_node, r_.dimension == 2 ? "circle" : "sphere", r_.cell_number(d.worst_cell),
                                  d.worst_depth));
    return all;
}

std::vector<std::string> CheckWords::conformity(std::size_t columns) const {
    const ConformityReport& c = *r_.conformity;
    std::vector<std::string> all{fmt::format("{} of the PLC: {} respected exactly, {} up to rounding, {} violated",
                                             counted(c.facets, "facet", "facets"), number(c.exact), number(c.rounded),
                                             number(c.violated))};
    if (c.rounded != 0)
        all.push_back(fmt::format("nodes lie up to {:.3g} from the plane of their facet, {:.3g} of the PLC's extent",
                                  c.max_distance, c.relative_distance));
    if (c.missing_vertices != 0)
        all.push_back(counted(c.missing_vertices, "vertex of these facets is not a node",
                              "vertices of these facets are not nodes"));
    std::string violated;
    std::size_t shown = 0;
    for (const ViolatedFacet& f : c.examples) {
        const std::string one = fmt::format("{}{} ({:.3g} %)", violated.empty() ? "" : ", ", f.facet, 100 * f.covered);
        if (violated.size() + one.size() > columns) break;
        violated += one;
        ++shown;
    }
    if (c.violated > shown && shown > 0) violated += fmt::format(", and {} more", number(c.violated - shown));
    if (!violated.empty()) all.push_back("violated facets (area of faces centred on them): " + violated);
    return all;
}

}  // namespace barycert::report
