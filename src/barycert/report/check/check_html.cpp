#include "barycert/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report/check/check_html_cells.hpp"
#include "barycert/report/check/check_html_histogram.hpp"
#include "barycert/report/check/check_html_style.hpp"
#include "barycert/report/check/check_words.hpp"
#include "barycert/report/common/html_text.hpp"
#include "barycert/report/common/page.hpp"
#include "barycert/report/common/terminal_text.hpp"

namespace barycert {

using namespace report;

namespace {

/// However many the report holds: the page stays small, and --json has them all.
constexpr std::size_t max_places = 12, max_contacts = 8, max_drawn = 6;

CheckWords words(const CheckReport& report) {
    return {report, CheckWords::Digits::grouped};
}

/// "degenerate_cell" for people.
std::string spaced(std::string_view name) {
    std::string out(name);
    std::replace(out.begin(), out.end(), '_', ' ');
    return out;
}

std::string verdict_section(const CheckReport& r) {
    if (r.certified()) {
        const std::string what = r.cells == 0 ? "The mesh has no cells, so the conditions hold trivially."
                                              : fmt::format("{}.</p><p>{}", words(r).certified(), words(r).proof());
        return fmt::format("<section class=\"verdict good\"><b>Certified{}</b><p>{}</p></section>\n",
                           for_straight_sides(r.curved), what);
    }
    // An open boundary follows from other defects, if there are any.
    std::string reasons, open;
    for (const Defect& f : r.defects) {
        if (!defect_text(f.kind).breaks) continue;
        (f.kind == DefectKind::open_boundary ? open : reasons) +=
            fmt::format("<li>{}: {}</li>", html_escaped(defect_text(f.kind).text), words(r).count_of(f));
    }
    const bool files_only = std::all_of(r.defects.begin(), r.defects.end(), [](const Defect& f) {
        return !defect_text(f.kind).breaks || defect_text(f.kind).condition == "P5";
    });
    const std::string_view what = r.find(DefectKind::bad_structure) != nullptr
                                      ? "The arrays of the mesh do not make cells: nothing else was checked."
                                  : files_only
                                      ? "The cells partition a domain, but other arrays of the mesh do not fit them."
                                      : "The cells do not partition a domain.";
    return fmt::format("<section class=\"verdict bad\"><b>NOT certified</b><p>{} Found:</p><ul>{}</ul></section>\n",
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
    const CheckWords w = words(r);
    std::string out = "<table>\n";
    const auto row = [&](std::string_view what, const std::vector<std::string>& sentences) {
        out += fmt::format("<tr><th class=\"k\">{}</th><td>{}</td></tr>\n", what, fmt::join(sentences, "<br/>"));
    };
    row(r.dimension == 2 ? "Area" : "Volume",
        {w.volumes() + (!r.volume.equal ? ": <b class=\"bad\">NOT equal</b>"
                        : r.certified() ? ": <span class=\"ok\">exactly equal</span>"
                                        : ": equal, which alone proves nothing")});
    row("Cells", {w.orientations()});
    const std::string uncounted = w.uncounted();
    row("Boundary", {fmt::format("{}, {}{}{}", b.closed ? "closed" : "<b class=\"bad\">not closed</b>",
                                 b.manifold ? "manifold" : "touching itself (not manifold)",
                                 uncounted.empty() ? "" : "; ", uncounted)});
    if (r.delaunay) row("Delaunay", w.delaunay());
    constexpr std::size_t max_violated = 400;  // characters
    if (r.conformity) row("PLC", w.conformity(max_violated));
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
    const std::string_view left_out = left_out_sentence(r);
    return left_out.empty() ? out : fmt::format("{}<p class=\"small\">{}</p>\n", out, left_out);
}

std::string defects(const CheckReport& r, bool breaking) {
    std::string rows;
    for (const Defect& f : r.defects) {
        const DefectText& t = defect_text(f.kind);
        if (f.breaks() != breaking) continue;
        std::string where;
        const std::size_t shown = std::min(f.places.size(), max_places);
        for (std::size_t i = 0; i < shown; ++i)
            where += (i == 0 ? "" : "; ") + html_escaped(place_text(r, f.kind, f.places[i]));
        if (shown > 0 && shown < f.count)
            where += f.at_least ? "; and more" : fmt::format("; and {} more", grouped(f.count - shown));
        if (f.curved_cells != 0) where += (where.empty() ? "" : "<br/>") + words(r).curved(f);
        rows += fmt::format(
            "<tr><td class=\"k\"><b>{}</b></td><td>{}{}{}</td><td class=\"n\" data-l=\"count\">{}</td></tr>\n",
            spaced(t.name), html_escaped(t.text),
            f.remedy().empty() ? "" : fmt::format("<div class=\"remedy\">→ {}</div>", html_escaped(f.remedy())),
            where.empty() ? "" : fmt::format("<div class=\"places\">{}</div>", where), words(r).count_of(f));
    }
    if (rows.empty()) return "";
    return fmt::format(
        "<h2>{}</h2>\n<table class=\"stack\"><tr><th class=\"h\">defect</th><th class=\"h\">what it is, what to do, "
        "and where</th>"
        "<th class=\"h n\">count</th></tr>\n{}</table>\n",
        breaking ? breaking_heading : harmless_heading, rows);
}

std::string repaired(const FixedMesh& fixed) {
    std::string done;
    for (const std::string& line : fix_sentences(fixed)) done += fmt::format("<li>{}</li>", html_escaped(line));
    return fmt::format("<h2>Repaired copy: {}</h2>\n<ul>{}</ul>\n", html_escaped(fixed.file), done) +
           verdict_section(fixed.after);
}

std::string contacts(const CheckReport& r) {
    if (r.contacts.empty()) return "";
    std::string out =
        "<h2>Pairs of cells that overlap or touch</h2>\n"
        "<p class=\"small\">Each with an exact common point: in hexadecimal where doubles are such a point, else "
        "rounded and as exact fractions.</p>\n"
        "<table class=\"stack\"><tr><th class=\"h\">cells</th><th class=\"h\">how they meet</th><th class=\"h\">common "
        "point</th></tr>\n";
    const std::size_t shown = std::min(r.contacts.size(), max_contacts);
    for (std::size_t i = 0; i < shown; ++i) {
        const CellContact& c = r.contacts[i];
        const auto cells = r.cell_number(c.cells);
        std::vector<std::string> decimal, exact;
        for (std::size_t k = 0; k < static_cast<std::size_t>(r.dimension); ++k) {
            const double x = c.common.point[k];
            decimal.push_back(base::shortest(x));
            exact.push_back(c.common.exact
                                ? base::hexadecimal(x)
                                : fmt::format("{} = {}", "xyz"[k], shortened_fraction(c.common.fraction[k], 120)));
        }
        out += fmt::format(
            "<tr><td class=\"k\">{} and {}</td><td class=\"k\">{}</td><td "
            "class=\"witness-at\">({}){}<br/><code>{}</code></td></tr>\n",
            cells[0], cells[1], meeting_text(c), fmt::join(decimal, ", "), c.common.exact ? "" : ", rounded",
            fmt::join(exact, c.common.exact ? ", " : "<br/>"));
    }
    out += "</table>\n";
    if (shown < r.contacts.size())
        out += fmt::format("<p class=\"small\">And {} more, which the JSON report lists.</p>\n",
                           grouped(r.contacts.size() - shown));
    return out;
}

std::string histograms(const CheckReport& r) {
    const CellMeasures& m = r.measures;
    const bool plane = r.dimension == 2;
    const std::string unit = plane ? "squared" : "cubed";
    using Kind = BinRule::Kind;
    std::string out;
    // From flat to regular: 70.53 degrees, in 2D 60.
    out += histogram_figure(
        r, m.min_angle, {Kind::given, 0, plane ? 60.0 : 72.0, plane ? 1.5 : 2.0},
        {.title = plane ? "Smallest angle" : "Smallest dihedral angle",
         .axis = plane ? "smallest angle, degrees (regular: 60)" : "smallest dihedral angle, degrees (regular: 70.5)",
         .infinite = "",
         .zero = "",
         .max_is_worst = false});
    out += histogram_figure(
        r, m.max_angle, {Kind::given, plane ? 60.0 : 70.0, 180, plane ? 3.0 : 2.5},
        {.title = plane ? "Largest angle" : "Largest dihedral angle",
         .axis = plane ? "largest angle, degrees (regular: 60)" : "largest dihedral angle, degrees (regular: 70.5)",
         .infinite = "",
         .zero = ""});
    const std::string_view degenerate = "infinite (degenerate cells)";
    out += histogram_figure(r, m.radius_edge, {.kind = Kind::chosen},
                            {.title = "Circumradius over shortest edge",
                             .axis = plane ? "circumradius / shortest edge (regular: 0.577)"
                                           : "circumradius / shortest edge (regular: 0.612)",
                             .infinite = degenerate,
                             .zero = ""});
    out += histogram_figure(r, m.aspect, {.kind = Kind::chosen},
                            {.title = "Aspect",
                             .axis = "longest edge / inradius, scaled (regular: 1)",
                             .infinite = degenerate,
                             .zero = ""});
    out += histogram_figure(r, lost_bits(m), {Kind::linear, 0, 10, 0},
                            {.title = "Accuracy lost to the cell's shape, of 53 bits",
                             .axis = "log2 of the condition number, bits",
                             .infinite = degenerate,
                             .zero = ""});
    out += histogram_figure(r, cell_sizes(m), {.kind = Kind::logarithmic},
                            {.title = plane ? "Area" : "Volume",
                             .axis = (plane ? "area, unit of coordinates " : "volume, unit of coordinates ") + unit,
                             .infinite = "overflow",
                             .zero = "zero, or underflow",
                             .max_is_worst = false});
    if (out.empty()) return out;
    return "<h2>Shapes and sizes of the cells</h2>\n<div class=\"figures\">\n" + out + "</div>\n";
}

std::string exhibits(const CheckReport& r, const Mesh& mesh) {
    const std::vector<Exhibit> worst = worst_cells(r, mesh, max_drawn), bad = defect_cells(r, mesh, max_drawn);
    std::vector<Exhibit> all = bad;
    all.insert(all.end(), worst.begin(), worst.end());
    std::string out = "<h2>Where the worst cells are</h2>\n" + exhibit_map(r, mesh, all);
    const auto cards = [&](std::string_view title, std::size_t first, std::size_t last) {
        if (first == last) return;
        out += fmt::format("<h2>{}</h2>\n<div class=\"figures\">\n", title);
        for (std::size_t i = first; i < last; ++i) out += exhibit_card(r, mesh, all[i], i + 1);
        out += "</div>\n";
    };
    cards("Cells with defects", 0, bad.size());
    cards(r.dimension == 2 ? "The cells with the smallest angles" : "The cells with the smallest dihedral angles",
          bad.size(), all.size());
    return all.empty() ? "" : out;
}

}  // namespace

std::string check_html(const CheckReport& r, const Mesh& mesh, const std::string& mesh_name, const FixedMesh* fixed) {
    const ExactEnvironment environment;
    const std::string verdict =
        r.certified() ? fmt::format(": certified{}", for_straight_sides(r.curved)) : ": NOT certified";
    std::string out = page_head(mesh_name + verdict, html_style) +
                      fmt::format("<h1>Mesh certificate of <b>{}</b></h1>\n", html_escaped(mesh_name));
    out += curved_section(r.curved) + verdict_section(r);
    // Without a structure there are no measures, and nothing that could be drawn.
    const bool looked_at = r.find(DefectKind::bad_structure) == nullptr;
    const bool cells = looked_at && r.cells != 0 && r.measures.volume.size() == r.cells &&
                       mesh.dimension == r.dimension && mesh.cell_count() == r.cells;
    if (looked_at) out += tiles(r);
    if (cells) out += whole_mesh(r);
    if (!r.defects.empty() || r.cells != 0)
        out += fmt::format("<p class=\"small\">{}</p>\n", numbering_sentence(r, mesh));
    for (const std::string& note : note_sentences(r))
        out += fmt::format("<p class=\"small\">{}</p>\n", html_escaped(note));
    out += conditions(r, mesh) + defects(r, true);
    if (fixed != nullptr) out += repaired(*fixed);
    if (cells) out += exhibits(r, mesh);
    out += contacts(r);
    if (cells) out += histograms(r);
    out += defects(r, false);
    return out + page_foot(fmt::format(
                     "Made by barycert {} check: {}. Signs, counts, contacts and the verdict are exact; angles and "
                     "ratios are plain double precision.",
                     measure_environment().version, words(r).checked()));
}

}  // namespace barycert
