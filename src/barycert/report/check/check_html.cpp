#include "barycert/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report/check/check_conditions.hpp"
#include "barycert/report/check/check_html_cells.hpp"
#include "barycert/report/check/check_html_histogram.hpp"
#include "barycert/report/check/check_html_picture.hpp"
#include "barycert/report/check/check_html_style.hpp"

namespace barycert {

using namespace report;

namespace {

/// However many the report holds: the page stays small, and --json has them all.
constexpr std::size_t most_places = 12, most_contacts = 8, most_drawn = 6;

std::string counted(std::uint64_t n, std::string_view one, std::string_view more) {
    return fmt::format("{} {}", grouped(n), n == 1 ? one : more);
}

/// A count that may be a lower bound, escaped.
std::string count_of(const Defect& f) {
    return (f.at_least ? "at least " : "") + grouped(f.count);
}

/// "degenerate_cell" for people.
std::string words(std::string_view name) {
    std::string out(name);
    std::replace(out.begin(), out.end(), '_', ' ');
    return out;
}

std::string domain(const CheckReport& r) {
    std::string text = counted(r.parts, "part", "parts");
    if (!r.boundary.cavities) return text;
    text += " with " + (r.dimension == 2 ? counted(*r.boundary.cavities, "hole", "holes")
                                         : counted(*r.boundary.cavities, "cavity", "cavities"));
    if (r.boundary.tunnels)
        text += " and " + counted(static_cast<std::uint64_t>(*r.boundary.tunnels), "tunnel", "tunnels");
    return text;
}

std::string verdict(const CheckReport& r) {
    if (r.certified()) {
        const std::string what =
            r.cells == 0 ? "The mesh has no cells, so there is nothing that could be wrong with them."
                         : fmt::format(
                               "{} {} a domain of {}.</p><p>Proved in exact arithmetic: any two cells meet in "
                               "a common face or not at all. No overlap, no crack.",
                               counted(r.cells, "cell", "cells"), r.cells == 1 ? "is" : "partition", domain(r));
        return fmt::format("<section class=\"verdict certified\"><b>Certified</b><p>{}</p></section>\n", what);
    }
    // An open boundary follows from other problems, if there are any.
    std::string reasons, open;
    for (const Defect& f : r.defects) {
        if (!defect_text(f.kind).breaks) continue;
        (f.kind == DefectKind::open_boundary ? open : reasons) +=
            fmt::format("<li>{}: {}</li>", html_escaped(defect_text(f.kind).text), count_of(f));
    }
    const bool files_only = std::all_of(r.defects.begin(), r.defects.end(), [](const Defect& f) {
        return !defect_text(f.kind).breaks || defect_text(f.kind).condition == "P5";
    });
    const std::string_view what =
        r.find(DefectKind::bad_structure) != nullptr
            ? "The arrays of the mesh do not make cells: nothing else was looked at."
        : files_only ? "The cells partition a domain, but other arrays of the mesh do not belong to them."
                     : "The cells are no partition of a domain.";
    return fmt::format("<section class=\"verdict broken\"><b>NOT certified</b><p>{} Found:</p><ul>{}</ul></section>\n",
                       what, reasons.empty() ? open : reasons);
}

std::string tiles(const CheckReport& r) {
    std::string out = "<div class=\"tiles\">";
    const auto tile = [&](std::string_view what, const std::string& value) {
        out += fmt::format("<div><b>{}</b><span>{}</span></div>", value, what);
    };
    const BoundaryReport& b = r.boundary;
    tile("dimension", std::to_string(r.dimension));
    tile(r.dimension == 2 ? "triangles" : "tetrahedra", grouped(r.cells));
    tile("nodes", grouped(r.nodes));
    tile("parts", grouped(r.parts));
    tile(r.dimension == 2 ? "holes" : "cavities", b.cavities ? grouped(*b.cavities) : "–");
    if (r.dimension == 3) tile("tunnels", b.tunnels ? std::to_string(*b.tunnels) : "–");
    tile(r.dimension == 2 ? "boundary edges" : "boundary faces", grouped(b.facets));
    tile("pieces of boundary", grouped(b.pieces));
    return out + "</div>\n";
}

std::string whole_mesh(const CheckReport& r) {
    const BoundaryReport& b = r.boundary;
    const std::string_view size = r.dimension == 2 ? "Area" : "Volume";
    const auto row = [](std::string_view what, const std::string& text) {
        return fmt::format("<tr><th class=\"k\">{}</th><td>{}</td></tr>\n", what, text);
    };
    std::string out = "<table>\n";
    out += row(size, fmt::format("{} in the cells, {} within the boundary: {}", base::shortest(r.volume.cells),
                                 base::shortest(r.volume.boundary),
                                 r.volume.equal ? "<span class=\"ok\">equal, exactly</span>"
                                                : "<b class=\"bad\">NOT equal</b>"));
    out += row("Cells",
               fmt::format("{} positive, {} negative, {} degenerate, by the exact sign of the {}", grouped(r.positive),
                           grouped(r.negative), grouped(r.degenerate), r.dimension == 2 ? "area" : "volume"));
    out +=
        row("Boundary", fmt::format("{}, {}{}", b.closed ? "closed" : "<b class=\"bad\">not closed</b>",
                                    b.manifold ? "manifold" : "touching itself (not manifold)",
                                    b.cavities ? ""
                                               : "; cavities and tunnels are counted only where it is closed and does "
                                                 "not touch itself along a ridge"));
    if (r.delaunay) {
        const DelaunayReport& d = *r.delaunay;
        std::string text = counted(d.facets, "interior facet", "interior facets") + " tested, exactly: ";
        text += d.violations == 0 ? "all are locally Delaunay" : grouped(d.violations) + " not locally Delaunay";
        if (d.cospherical != 0)
            text += fmt::format("; {} {}", grouped(d.cospherical), r.dimension == 2 ? "cocircular" : "cospherical");
        if (d.violations != 0)
            text += fmt::format(". Worst: node {} lies in the sphere of cell {}, {:.3g} of its radius deep",
                                d.worst_node, d.worst_cell, d.worst_depth);
        out += row("Delaunay", text);
    }
    if (r.conformity) {
        const ConformityReport& c = *r.conformity;
        std::string text = fmt::format("of {}: {} respected exactly, {} by rounding, {} violated",
                                       counted(c.facets, "facet", "facets"), grouped(c.exact), grouped(c.rounded),
                                       grouped(c.violated));
        if (c.rounded != 0)
            text += fmt::format(". Nodes lie up to {:.3g} off their facet's plane, {:.3g} of the PLC's extent",
                                c.largest_distance, c.relative_distance);
        if (c.missing_vertices != 0)
            text += fmt::format(". Vertices that are no node: {}", grouped(c.missing_vertices));
        for (const ViolatedFacet& f : c.examples)
            text += fmt::format("{}{} ({:.3g} %)",
                                &f == c.examples.data() ? ". Violated facets (share that is covered): " : ", ", f.facet,
                                100 * f.covered);
        if (c.violated > c.examples.size() && !c.examples.empty())
            text += fmt::format(", and {} more", grouped(c.violated - c.examples.size()));
        out += row("PLC", text);
    }
    return out + "</table>\n";
}

std::string conditions(const CheckReport& r, const Mesh& mesh) {
    std::string out =
        "<h2>What was checked</h2>\n<table><tr><th>condition</th><th></th><th class=\"n\">violations</th></tr>\n";
    for (const ConditionRow& row : condition_rows(r, mesh)) {
        const std::string what =
            row.count != 0 ? (row.at_least ? "at least " : "") + grouped(row.count) : std::string(row.instead);
        out += fmt::format("<tr><td class=\"k\">{}</td><td>{}</td><td class=\"n{}\">{}</td></tr>\n", row.name, row.text,
                           row.count != 0 ? " bad"
                           : what == "ok" ? " ok"
                                          : "",
                           what);
    }
    out += "</table>\n";
    if (left_cells_out(r))
        out +=
            "<p class=\"small\">Cells with a corner that is no node, a coordinate that is not finite or a node twice "
            "take no part in P2 to P5.</p>\n";
    return out;
}

/// "cells 3 and 17, nodes 4 5 6 (coplanar)".
std::string place(const DefectPlace& p) {
    std::vector<Mesh::Index> cells, nodes;
    for (const Mesh::Index i : p.cells) {
        if (i >= 0) cells.push_back(i);
    }
    for (const Mesh::Index i : p.nodes) {
        if (i >= 0) nodes.push_back(i);
    }
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    std::string out;
    if (!cells.empty()) out += fmt::format("{} {}", cells.size() == 1 ? "cell" : "cells", fmt::join(cells, " and "));
    if (!nodes.empty())
        out += fmt::format("{}{} {}", out.empty() ? "" : ", ", nodes.size() == 1 ? "node" : "nodes",
                           fmt::join(nodes, " "));
    if (*p.detail != '\0') out += fmt::format("{}({})", out.empty() ? "" : " ", html_escaped(p.detail));
    return out;
}

std::string defects(const CheckReport& r, bool breaking) {
    std::string rows;
    for (const Defect& f : r.defects) {
        const DefectText& t = defect_text(f.kind);
        if (t.breaks != breaking) continue;
        std::string where;
        const std::size_t shown = std::min(f.places.size(), most_places);
        for (std::size_t i = 0; i < shown; ++i) where += (i == 0 ? "" : "; ") + place(f.places[i]);
        if (shown > 0 && shown < f.count)
            where += f.at_least ? "; and more" : fmt::format("; and {} more", grouped(f.count - shown));
        std::string_view remedy = t.remedy;
        constexpr std::string_view none = "none needed";
        if (remedy.starts_with(none)) remedy.remove_prefix(std::min(remedy.size(), none.size() + 2));
        rows += fmt::format("<tr><td class=\"k\"><b>{}</b></td><td>{}{}</td><td>{}</td><td class=\"n\">{}</td></tr>\n",
                            words(t.name), html_escaped(t.text),
                            where.empty() ? "" : fmt::format("<div class=\"places\">{}</div>", where),
                            html_escaped(remedy), count_of(f));
    }
    if (rows.empty()) return "";
    return fmt::format(
        "<h2>{}</h2>\n<table><tr><th>finding</th><th>what it is, and where</th><th>{}</th><th "
        "class=\"n\">count</th></tr>\n"
        "{}</table>\n",
        breaking ? "What is wrong, and what to do" : "Notes, harmless to a partition", breaking ? "remedy" : "", rows);
}

/// Fractions grow with the widths of coordinates: thousands of digits are no help on a page.
std::string shortened(const std::string& fraction) {
    constexpr std::size_t longest = 120;
    if (fraction.size() <= longest) return fraction;
    return fmt::format("{}…{} ({} characters)", fraction.substr(0, 40), fraction.substr(fraction.size() - 40),
                       fraction.size());
}

std::string contacts(const CheckReport& r) {
    if (r.contacts.empty()) return "";
    static constexpr std::array<std::string_view, 3> extents{"touch in a point", "touch along a segment",
                                                             "touch in an area"};
    std::string out =
        "<h2>Pairs of cells that meet where they must not</h2>\n"
        "<p class=\"small\">Each with an exact point of both: coordinates that are such a point themselves also in "
        "hexadecimal, others, rounded, with the exact fractions.</p>\n"
        "<table><tr><th>cells</th><th>how they meet</th><th>a point of both</th></tr>\n";
    const std::size_t shown = std::min(r.contacts.size(), most_contacts);
    for (std::size_t i = 0; i < shown; ++i) {
        const CellContact& c = r.contacts[i];
        std::vector<std::string> decimal, exact;
        for (std::size_t k = 0; k < static_cast<std::size_t>(r.dimension); ++k) {
            const double x = c.witness.point[k];
            decimal.push_back(base::shortest(x));
            exact.push_back(c.witness.exact ? base::hexadecimal(x)
                                            : fmt::format("{} = {}", "xyz"[k], shortened(c.witness.fraction[k])));
        }
        out += fmt::format(
            "<tr><td class=\"k\">{} and {}</td><td class=\"k\">{}</td><td "
            "class=\"witness-at\">({}){}<br/><code>{}</code></td></tr>\n",
            c.cells[0], c.cells[1],
            c.overlap ? "overlap" : extents[static_cast<std::size_t>(std::clamp(c.dimension, 0, 2))],
            fmt::join(decimal, ", "), c.witness.exact ? "" : ", rounded",
            fmt::join(exact, c.witness.exact ? ", " : "<br/>"));
    }
    out += "</table>\n";
    if (shown < r.contacts.size())
        out += fmt::format("<p class=\"small\">And {} more, which the JSON report has.</p>\n",
                           grouped(r.contacts.size() - shown));
    return out;
}

std::string histograms(const CheckReport& r) {
    const CellMeasures& m = r.measures;
    const bool plane = r.dimension == 2;
    const std::string unit = plane ? "squared" : "cubed";
    std::vector<double> size(m.volume), bits(m.condition);
    for (double& x : size) x = std::fabs(x);
    for (double& x : bits) x = std::isnan(x) ? x : std::log2(std::max(1.0, x));  // kappa is at least 1, and rounded
    using Kind = BinRule::Kind;
    std::string out = "<h2>Shapes and sizes of the cells</h2>\n<div class=\"figures\">\n";
    // From flat to regular: 70.53 degrees, in 2D 60.
    out += histogram_figure(
        m.min_angle, {Kind::given, 0, plane ? 60.0 : 72.0, plane ? 1.5 : 2.0},
        {.title = plane ? "Smallest angle" : "Smallest dihedral angle",
         .axis = plane ? "smallest angle, degrees (regular: 60)" : "smallest dihedral angle, degrees (regular: 70.5)",
         .infinite = "",
         .zero = "",
         .most_is_worst = false});
    out += histogram_figure(
        m.max_angle, {Kind::given, plane ? 60.0 : 70.0, 180, plane ? 3.0 : 2.5},
        {.title = plane ? "Largest angle" : "Largest dihedral angle",
         .axis = plane ? "largest angle, degrees (regular: 60)" : "largest dihedral angle, degrees (regular: 70.5)",
         .infinite = "",
         .zero = ""});
    const std::string_view degenerate = "infinite (degenerate cells)";
    out += histogram_figure(m.radius_edge, {.kind = Kind::chosen},
                            {.title = "Circumradius over shortest edge",
                             .axis = plane ? "circumradius / shortest edge (regular: 0.577)"
                                           : "circumradius / shortest edge (regular: 0.612)",
                             .infinite = degenerate,
                             .zero = ""});
    out += histogram_figure(m.aspect, {.kind = Kind::chosen},
                            {.title = "Aspect",
                             .axis = "longest edge / inradius, scaled (regular: 1)",
                             .infinite = degenerate,
                             .zero = ""});
    out += histogram_figure(bits, {Kind::linear, 0, 10, 0},
                            {.title = "Bits that the shape may cost a plain kernel, of 53",
                             .axis = "log2 of the condition number, bits",
                             .infinite = degenerate,
                             .zero = ""});
    out += histogram_figure(size, {.kind = Kind::logarithmic},
                            {.title = plane ? "Area" : "Volume",
                             .axis = (plane ? "area, unit of coordinates " : "volume, unit of coordinates ") + unit,
                             .infinite = "beyond the largest double",
                             .zero = "zero, or too small for a double",
                             .most_is_worst = false});
    return out + "</div>\n";
}

std::string exhibits(const CheckReport& r, const Mesh& mesh) {
    const std::vector<Exhibit> worst = worst_cells(r, mesh, most_drawn), bad = defect_cells(r, mesh, most_drawn);
    std::vector<Exhibit> all = bad;
    all.insert(all.end(), worst.begin(), worst.end());
    std::string out = "<h2>Where the worst cells are</h2>\n" + exhibit_map(r, mesh, all);
    const auto cards = [&](std::string_view title, std::size_t first, std::size_t last) {
        if (first == last) return;
        out += fmt::format("<h2>{}</h2>\n<div class=\"figures\">\n", title);
        for (std::size_t i = first; i < last; ++i) out += exhibit_card(r, mesh, all[i], i + 1);
        out += "</div>\n";
    };
    cards("Cells with problems", 0, bad.size());
    cards(r.dimension == 2 ? "The cells with the smallest angles" : "The cells with the smallest dihedral angles",
          bad.size(), all.size());
    return all.empty() ? "" : out;
}

}  // namespace

std::string check_html(const CheckReport& r, const Mesh& mesh, const std::string& mesh_name) {
    const ExactEnvironment environment;
    const std::string name = html_escaped(mesh_name);
    std::string out = fmt::format(
        "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\"><head><meta charset=\"utf-8\"/>\n"
        "<meta name=\"viewport\" content=\"width=device-width\"/>\n<title>{}: {}</title>\n<style>{}</style></head>\n"
        "<body>\n<h1>Mesh certificate of <b>{}</b></h1>\n",
        name, r.certified() ? "certified" : "NOT certified", html_style, name);
    out += verdict(r);
    // Without a structure there are no measures, and nothing that could be drawn.
    const bool looked_at = r.find(DefectKind::bad_structure) == nullptr;
    const bool cells = looked_at && r.cells != 0 && r.measures.volume.size() == r.cells &&
                       mesh.dimension == r.dimension && mesh.cell_count() == r.cells;
    if (looked_at) out += tiles(r);
    if (cells) out += whole_mesh(r);
    if (!r.defects.empty() || r.cells != 0)
        out += fmt::format(
            "<p class=\"small\">Cells and nodes are named by their positions in the file, counted from 0{}.</p>\n",
            mesh.index_base == 1 ? "; the file itself counts from 1" : "");
    out += conditions(r, mesh) + defects(r, true) + contacts(r);
    if (cells) out += exhibits(r, mesh) + histograms(r);
    out += defects(r, false);
    return out + fmt::format(
                     "<footer>Made by barycert {} check: {} and {}, checked in {:.3g} s on {}. Signs, counts, "
                     "contacts and the verdict are exact; angles and ratios are plain double precision."
                     "</footer>\n</body></html>\n",
                     html_escaped(measure_environment().version), counted(r.nodes, "node", "nodes"),
                     counted(r.cells, "cell", "cells"), r.seconds,
                     counted(static_cast<std::uint64_t>(r.threads), "thread", "threads"));
}

}  // namespace barycert
