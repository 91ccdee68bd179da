// Report on a check of a mesh, for people.

#include "barycert/check.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "app/report/check/check_data.hpp"
#include "app/report/check/check_document.hpp"
#include "app/report/check/check_measures.hpp"
#include "app/report/check/check_words.hpp"
#include "app/report/common/document.hpp"
#include "app/report/common/terminal_text.hpp"
#include "barycert/check_job.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/report.hpp"
#include "barycert/result.hpp"
#include "barycert/surface_report.hpp"
#include "core/base/text.hpp"

namespace barycert {

using namespace report;

namespace {

/// On a page, however many the report holds: it stays small, and --json has them all.
constexpr std::size_t max_contacts = 8;

/// With where a misplaced point is: it breaks the certificate, and no triangle shows it.
std::string reason_of_surface(const CheckReport& r, const Defect& f) {
    if (f.kind != DefectKind::misplaced_point || f.places.empty()) return reason(f);
    return joined(f.places, ", ", [&](const DefectPlace& p) { return place_text(r, f.kind, p); });
}

void tell_surface_verdict(Document& d, const CheckReport& r, const std::string& name) {
    const SurfaceReport& s = *r.surface;
    const char* const what = s.plc ? "a valid PLC" : "a closed surface without self-intersections";
    if (r.certified()) {
        const std::string size = fmt::format("{} in {}{}", counted(s.plc ? s.facets : r.cells, cell_word(r)),
                                             counted(s.shell_count, "shell"),
                                             s.regions.empty() ? "" : " around " + counted(s.regions.size(), "region"));
        d.add(Headline{Tone::good,
                       name,
                       fmt::format("certified: {}", what),
                       {size},
                       {"Proved in exact arithmetic: any two triangles meet in a common node or edge, or not at all.",
                        tetgen_sentence(r) + "."}});
        return;
    }
    std::vector<std::string> reasons;
    for (const Defect& f : r.defects) {
        if (f.breaks()) reasons.push_back(reason_of_surface(r, f));
    }
    if (reasons.empty()) reasons.emplace_back("no triangles");
    d.add(Headline{Tone::bad, name, fmt::format("NOT certified to be {}", what), std::move(reasons)});
    d.say(tetgen_sentence(r) + ".", Tone::plain, For::all, Breaks::words);
}

void tell_verdict(Document& d, const CheckReport& r, const std::string& name) {
    if (r.surface) return tell_surface_verdict(d, r, name);
    const std::string of(for_straight_sides(r.curved));
    if (r.certified()) {
        if (r.cells == 0) return d.add(Headline{Tone::good, name, "certified, trivially: the mesh has no cells"});
        const std::string how = r.curved.cells == 0 ? "in exact arithmetic: any two " : "exactly: any two straight ";
        return d.add(
            Headline{Tone::good,
                     name,
                     "certified" + of,
                     {fmt::format("{}{} {} a domain of {}", cells_text(r), r.shapes != 0 ? "," : "",
                                  r.cells == 1 ? "is" : "partition", domain_text(r))},
                     {fmt::format("Proved {}cells meet in a common face or not at all. No overlap, no gap.", how)}});
    }
    // Overlaps first: they matter most. An open boundary follows from other defects, if there are any.
    std::vector<std::string> reasons;
    bool files_only = true;
    for (const Defect& f : r.defects) {
        if (!defect_text(f.kind).breaks) continue;
        files_only = files_only && defect_text(f.kind).condition == "P5";
        if (f.kind != DefectKind::open_boundary)
            reasons.insert(f.kind == DefectKind::overlapping_cells ? reasons.begin() : reasons.end(), reason(f));
    }
    const Defect* const open = r.find(DefectKind::open_boundary);
    if (reasons.empty() && open != nullptr) reasons.push_back(reason(*open));
    d.add(Headline{Tone::bad, name, "NOT certified", std::move(reasons)});
    d.say(r.find(DefectKind::bad_structure) != nullptr
              ? "The arrays of the mesh do not make cells: nothing else was checked."
          : files_only ? "The cells partition a domain, but other arrays of the mesh do not fit them."
                       : "The cells do not partition a domain.",
          Tone::plain, For::page);
}

/// Adds the conditions, and how often each does not hold.
void tell_conditions(Document& d, const CheckReport& r, const Mesh& mesh) {
    Listing table{.columns = {left("condition", 75), right("violations", 12)}};
    for (const ConditionRow& row : condition_rows(r, mesh)) {
        const std::string what =
            row.count != 0 ? (row.at_least ? ">= " : "") + std::to_string(row.count) : std::string(row.instead);
        table.rows.push_back({{fmt::format("{:<3} {}", row.name, row.text), what},
                              row.count != 0 ? Tone::bad
                              : what == "ok" ? Tone::good
                                             : Tone::plain});
    }
    d.table(std::move(table), "What was checked");
    if (!r.surface && std::ranges::any_of(r.defects, leaves_cells_out))
        d.say("P2 to P5 leave out cells with an invalid index, a non-finite coordinate or a repeated node.");
}

/// The listed places of a defect. Where each is just one cell or one node, "cells" or "nodes" is said once.
Item::Places places_of(const CheckReport& r, const Defect& f) {
    const auto alone = [](const auto& all) { return all[0] >= 0 && (all[1] < 0 || all[1] == all[0]); };
    const std::string cell = cell_word(r);
    const auto each_is = [&](auto here, auto not_here) {
        return std::ranges::all_of(f.places, [&](const DefectPlace& p) {
            return *p.detail == '\0' && alone(p.*here) && (p.*not_here)[0] < 0;
        });
    };
    const bool plain =
        each_is(&DefectPlace::cells, &DefectPlace::nodes) || each_is(&DefectPlace::nodes, &DefectPlace::cells);
    Item::Places all{.count = f.count, .at_least = f.at_least, .between = plain ? ',' : ';'};
    for (const DefectPlace& p : f.places) {
        std::string text = place_text(r, f.kind, p);
        const std::size_t word = text.starts_with("node") ? 4 : cell.size();
        if (plain && !all.shown.empty()) text.erase(0, word + 1);
        if (plain && all.shown.empty() && f.places.size() > 1) text.insert(word, "s");
        all.shown.push_back(std::move(text));
    }
    return all;
}

void tell_defects(Document& d, const CheckReport& r, bool breaking, const std::string& heading) {
    bool first = true;
    for (const Defect& f : r.defects) {
        if (f.breaks() != breaking) continue;
        if (std::exchange(first, false)) d.section(heading);
        const DefectText& t = defect_text(f.kind);
        Item item{.title = fmt::format("{:<18}", t.name),
                  .text = fmt::format(" {:>11}  {}", (f.at_least ? ">= " : "") + std::to_string(f.count), t.text),
                  .lines = {{.places = places_of(r, f)}}};
        if (f.curved_cells != 0) item.lines.push_back({curved_text(f)});
        // Turning cells, this remedy, repairs no folded cell.
        const bool folded = f.kind == DefectKind::mixed_orientation && r.find(DefectKind::same_side) != nullptr;
        if (!f.remedy().empty())
            item.lines.push_back(
                {fmt::format("-> {}{}", f.remedy(), folded ? "; this does not repair folded cells" : "")});
        d.add(std::move(item));
    }
}

/// A fraction of at most 80 characters, or its ends and its length: of wide coordinates it has thousands of digits.
std::string shortened(const std::string& fraction, bool& cut) {
    constexpr std::size_t longest = 80, end = 24;
    if (fraction.size() <= longest) return fraction;
    cut = true;
    return fmt::format("{}...{} ({} characters)", fraction.substr(0, end), fraction.substr(fraction.size() - end),
                       fraction.size());
}

void tell_contacts(Document& d, const CheckReport& r) {
    if (r.contacts.empty()) return;
    const std::string word = cell_word(r);
    d.section(counted(r.contacts.size(), "pair") + " of " + word +
              "s that meet where they must not, each with a common point");
    bool cut = false;
    for (std::size_t i = 0; i < r.contacts.size(); ++i) {
        const CellContact& c = r.contacts[i];
        const auto cells = r.cell_number(c.cells);
        Item item{.text = fmt::format("{}s {} and {} {}:", word, cells[0], cells[1],
                                      c.overlap ? "overlap" : touch_text(c, r.surface.has_value()))};
        const std::string point =
            fmt::format("({}){}", coordinates(c.common.point, r.dimension), c.common.exact ? "" : ", rounded");
        if (item.text.size() + 1 + point.size() <= 100)
            item.text += " " + point;
        else
            item.lines.push_back({point});
        if (c.common.exact)
            item.lines.push_back({fmt::format("({})", coordinates(c.common.point, r.dimension, base::hexadecimal))});
        for (std::size_t k = 0; !c.common.exact && k < static_cast<std::size_t>(r.dimension); ++k)
            item.lines.push_back({fmt::format("{} = {}", "xyz"[k], shortened(c.common.fraction[k], cut))});
        d.add(std::move(item), i < max_contacts ? For::all : For::terminal);
    }
    if (r.contacts.size() > max_contacts)
        d.say(fmt::format("And {} more, which --json FILE lists.", r.contacts.size() - max_contacts), Tone::soft,
              For::page);
    if (cut) d.say("--json FILE writes the fractions in full.");
}

std::string curved_facets_text(const CheckReport& r) {
    const MapReport& m = *r.maps;
    std::string text = fmt::format("{} at curved cells, ", m.curved_facets);
    if (m.split_facets == 0) return text + "the same in both cells";
    text += fmt::format("of which {} are NOT the same in both cells: up to {:.2g} apart", m.split_facets, m.max_gap);
    if (!m.split.empty())
        text += fmt::format(", first cells {} and {}", r.cell_number(m.split[0][0]), r.cell_number(m.split[0][1]));
    return text;
}

std::string warped_sides_text(const CheckReport& r) {
    const MapReport& m = *r.maps;
    std::string text = fmt::format("{} of hexahedra and the like are not flat, ", m.warped_sides);
    if (m.split_sides == 0) return text + "the same in both cells";
    text += fmt::format("of which {} are NOT the same in both cells: multilinear cells overlap there or leave a gap",
                        m.split_sides);
    if (!m.split_at_sides.empty())
        text += fmt::format(", first cells {} and {}", r.cell_number(m.split_at_sides[0][0]),
                            r.cell_number(m.split_at_sides[0][1]));
    return text;
}

void tell_whole_mesh(Document& d, const CheckReport& r) {
    const BoundaryReport& b = r.boundary;
    const std::string size = r.dimension == 2 ? "area" : "volume";
    d.part("Cells and boundary");
    const std::string cells = r.shapes != 0 ? cells_text(r) : simplices_text(r.cells, r.dimension);
    d.add(Named{"mesh", {cells + ", " + counted(r.nodes, "node")}}, For::page);
    d.name("cells", fmt::format("{} positive, {} negative, {} degenerate, by the exact sign of the {}", r.positive,
                                r.negative, r.degenerate, size));
    std::string domain = domain_text(r);
    if (!b.cavities)
        domain += fmt::format("; {} are not counted where the boundary is {}",
                              r.dimension == 2 ? "holes" : "cavities and tunnels",
                              b.closed ? "pinched along a ridge" : "open");
    d.name("domain", domain);
    d.name("boundary",
           fmt::format("{} in {}, {}, {}", counted(b.facets, "facet"), counted(b.pieces, "piece"),
                       b.closed ? "closed" : "NOT closed", b.manifold ? "manifold" : "touching itself (not manifold)"));
    d.name(size, fmt::format("{} in the cells, {} inside the boundary: {}", base::shortest(r.volume.cells),
                             base::shortest(r.volume.boundary),
                             !r.volume.equal ? "NOT equal"
                             : r.certified() ? "exactly equal"
                                             : "equal, no proof"));
    if (r.maps) {
        const MapReport& m = *r.maps;
        std::string text =
            fmt::format("{} isoparametric maps: Jacobian positive {}, negative {}", m.cells, m.positive, m.negative);
        if (m.changing != 0) text += fmt::format(", changing its sign or zero {}", m.changing);
        if (m.unknown != 0) text += fmt::format(", not known {}", m.unknown);
        if (!m.examples.empty())
            text += "; cells " +
                    joined(m.examples, ", ", [&](Mesh::Index cell) { return std::to_string(r.cell_number(cell)); }) +
                    (m.changing + m.unknown > m.examples.size() ? ", ..." : "");
        d.name("maps", text, m.examples.empty() ? Tone::plain : Tone::strong);
        if (m.curved_facets != 0)
            d.name("facets", curved_facets_text(r), m.split_facets == 0 ? Tone::plain : Tone::strong);
        if (m.warped_sides != 0) d.name("sides", warped_sides_text(r), m.split_sides == 0 ? Tone::plain : Tone::strong);
    }
    if (r.delaunay) d.add(Named{"Delaunay", delaunay_sentences(r)});
    if (r.conformity) d.add(Named{"PLC", conformity_sentences(r, 40)}, For::terminal);
    if (r.conformity) d.add(Named{"PLC", conformity_sentences(r, 400)}, For::page);
}

/// A table has no more rows than a screen.
constexpr std::size_t max_rows = 20;

std::string or_none(std::int64_t number) {
    return number < 0 ? "-" : std::to_string(number);
}

void tell_shells(Document& d, const SurfaceReport& s) {
    Listing table{.columns = {left("shell", 6), right("triangles", 10), left("edges", 7), right("volume", 22),
                              right("area", 12), right("inside", 7)}};
    for (std::size_t i = 0; i < std::min(s.shells.size(), max_rows); ++i) {
        const SurfaceShell& shell = s.shells[i];
        table.rows.push_back(
            {{std::to_string(i), std::to_string(shell.triangles), std::string(shell.closed ? "closed" : "open"),
              shell.volume ? base::shortest(*shell.volume) : "-", fmt::format("{:.6g}", shell.area),
              or_none(shell.inside)}});
    }
    d.table(std::move(table), "Shells");
    if (s.shell_count > max_rows) d.say(fmt::format("And {} more.", s.shell_count - max_rows), Tone::soft);
    d.say(
        "Volumes are exact, rounded once; negative where normals point inwards; - where triangles are not turned "
        "alike.",
        Tone::soft);
}

void tell_regions(Document& d, const SurfaceReport& s) {
    if (s.regions.empty()) return;
    Listing table{.columns = {left("region", 6), right("volume", 22), right("shell", 7), left("points in it", 12)}};
    for (std::size_t i = 0; i < std::min(s.regions.size(), max_rows); ++i) {
        const std::string seeds = joined(s.seeds, ", ", [&](const PlcSeed& seed) {
            if (seed.region != static_cast<std::int64_t>(i)) return std::string();
            return fmt::format("{} {}", seed.hole ? "hole" : "region", seed.number);
        });
        table.rows.push_back({{std::to_string(i), base::shortest(s.regions[i].volume), or_none(s.regions[i].shell),
                               seeds.empty() ? "-" : seeds}});
    }
    d.table(std::move(table), "Regions: what the triangles enclose, less what lies in it");
    if (s.regions.size() > max_rows) d.say(fmt::format("And {} more.", s.regions.size() - max_rows), Tone::soft);
}

/// Its shells, the regions that they enclose, and the points of a PLC.
void tell_surface(Document& d, const CheckReport& r) {
    const SurfaceReport& s = *r.surface;
    d.part("Shells and regions");
    d.name("surface",
           fmt::format("{}{}, {}, {} at {}",
                       s.plc || s.facets != r.cells ? counted(s.facets, s.plc ? "facet" : "polygon") + ", " : "",
                       counted(r.cells, "triangle"), counted(s.edges, "edge"), counted(r.nodes, "node"),
                       counted(s.places, "place")));
    d.name("edges",
           fmt::format("{}, {}, {}", s.closed ? "closed" : "NOT closed", s.manifold ? "manifold" : "not manifold",
                       r.find(DefectKind::misoriented_edge) != nullptr ? "NOT oriented alike"
                       : s.plc                                         ? "turned as the facets are"
                       : !s.oriented                                   ? "NOT oriented alike"
                       : s.outward                                     ? "oriented outward"
                                                                       : "oriented alike"));
    if (!s.shells.empty()) tell_shells(d, s);
    tell_regions(d, s);
    if (!s.plc) d.say(tetgen_sentence(r) + ".", Tone::plain, For::page);
}

void tell_measures(Document& d, const CheckReport& r, const MeasureDistributions& known) {
    const auto rounded = [](double x) { return fmt::format("{:.4g}", x == 0 ? 0.0 : x); };
    Listing table{.columns = {left("measure of a cell", 31), right("min", 11), right("median", 11), right("max", 11),
                              right("worst cell", 11)}};
    for (const Measure& m : measures_of(r)) {
        const Distribution x = m.of == nullptr ? distribution(m.values) : known.of(m.of);
        table.rows.push_back(x.min_cell < 0
                                 ? Row{{m.name, {"-"}, {"-"}, {"-"}, {"-"}}}
                                 : Row{{m.name, rounded(x.min), rounded(x.median), rounded(x.max),
                                        std::to_string(r.cell_number(m.max_is_worst ? x.max_cell : x.min_cell))}});
    }
    d.table(std::move(table), "Shapes and sizes of the cells");
    d.say("Bits: log2 of the condition number; of the 53 bits of a double, plain weights may lose so many.",
          Tone::soft);
}

Document fix_document(const FixedMesh& fixed) {
    Document d;
    d.section("Repaired copy: " + fixed.file);
    for (const std::string& line : fix_sentences(fixed)) d.say(line);
    tell_verdict(d, fixed.after, fixed.file);
    tell_defects(d, fixed.after, true, "What remains in the copy");
    tell_defects(d, fixed.after, false, "Notes on the copy");
    return d;
}

}  // namespace

Document report::check_document(const CheckReport& r, const CheckSubject& of) {
    const Mesh& mesh = of.mesh;
    const std::string& name = of.name;
    const MeasureDistributions measures(r);
    Document d;
    d.title = name + (r.certified() ? fmt::format(": certified{}", for_straight_sides(r.curved)) : ": NOT certified");
    d.heading = (r.surface ? "Surface certificate of " : "Mesh certificate of ") + name;
    // Without a structure there is nothing that could be drawn.
    const bool drawn = r.find(DefectKind::bad_structure) == nullptr && r.cells != 0 &&
                       r.measures.volume.size() == r.cells && mesh.dimension == r.dimension &&
                       mesh.cell_count() == r.cells;
    d.curved(r.curved);
    tell_verdict(d, r, name);
    if (!r.defects.empty() || r.cells != 0)
        d.say(fmt::format("{}s and nodes are numbered from 0 in file order{}{}.",
                          !r.surface       ? "Cell"
                          : r.surface->plc ? "Facet"
                                           : "Triangle",
                          r.surface || r.cell_numbers.empty() ? ""
                          : r.shapes != 0                     ? "; of a cell that is cut, its parts are checked"
                                                              : ", cells that were left out included",
                          mesh.index_base == 1 ? " (the file itself numbers from 1)" : ""));
    tell_conditions(d, r, mesh);
    tell_defects(d, r, true, "Defects and remedies");
    if (of.fixed != nullptr) d.append(fix_document(*of.fixed), For::page);
    if (drawn && of.exhibits) d.add(Pictures{of.exhibits}, For::page);
    if (of.surface) d.add(Pictures{of.surface}, For::page);
    tell_contacts(d, r);
    if (r.surface && r.cells != 0) {
        tell_surface(d, r);
    } else if (r.cells != 0) {
        tell_whole_mesh(d, r);
        tell_measures(d, r, measures);
    }
    if (drawn && of.histograms) d.add(Pictures{of.histograms}, For::page);
    tell_defects(d, r, false, "Notes: these do not affect the certificate");
    std::vector<std::string> notes;
    for (const Note& note : r.notes) notes.push_back(message(note));
    for (const NotFinite& field : r.not_finite) notes.push_back(not_finite_text(field));
    if (!notes.empty()) {
        d.part("The files");
        d.add(Named{"read", std::move(notes)});
    }
    const std::string checked = fmt::format("{}, {}; checked in {:.3g} s on {}", counted(r.nodes, "node"),
                                            r.surface ? counted(r.cells, "triangle") : cells_text(r), r.seconds,
                                            counted(static_cast<std::uint64_t>(r.threads), "thread"));
    d.part();
    d.say(checked, Tone::plain, For::terminal);
    d.footer = fmt::format(
        "Made by barycert {} check: {}. Signs, counts, contacts and the verdict are exact; {} plain double precision.",
        measure_environment().version, checked, r.surface ? "areas and distances are" : "angles and ratios are");
    d.data = check_data(r, measures, name, of.environment, of.fixed);
    return d;
}

std::string check_text(const CheckReport& report, const Mesh& mesh, const std::string& name,
                       const TerminalStyle& style) {
    return written_text([&] { return check_document(report, {mesh, name}); }, style.colour);
}

std::string check_json(const CheckReport& report, const std::string& name, const Environment& environment,
                       const FixedMesh* fixed) {
    // Programs are told nothing of the mesh that is not in the report.
    return written_json([&, none = Mesh()] { return check_document(report, {none, name, environment, fixed}); }, 1);
}

std::string fix_text(const FixedMesh& fixed, const TerminalStyle& style) {
    return written_text([&] { return fix_document(fixed); }, style.colour);
}

}  // namespace barycert
