#include "barycert/report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report/check/check_words.hpp"
#include "barycert/report/common/terminal_text.hpp"

namespace barycert {

using namespace report;

namespace {

constexpr std::size_t columns = 100;

/// What a defect means for the verdict, after its count.
struct Clause {
    DefectKind kind;
    std::string_view one, more;
};
constexpr std::array<Clause, 16> clauses{{
    {DefectKind::bad_structure, "array has a wrong size", "arrays have a wrong size"},
    {DefectKind::index_out_of_range, "cell has an invalid index", "cells have an invalid index"},
    {DefectKind::not_finite, "node is not finite", "nodes are not finite"},
    {DefectKind::repeated_node, "cell has a node twice", "cells have a node twice"},
    {DefectKind::degenerate_cell, "cell is degenerate", "cells are degenerate"},
    {DefectKind::duplicate_cell, "cell is a duplicate", "cells are duplicates"},
    {DefectKind::overfull_facet, "facet belongs to more than two cells", "facets belong to more than two cells"},
    {DefectKind::same_side, "facet has both cells on the same side", "facets have both cells on the same side"},
    {DefectKind::open_boundary, "ridge leaves the boundary open", "ridges leave the boundary open"},
    {DefectKind::boundary_contact, "pair of boundary facets meets", "pairs of boundary facets meet"},
    {DefectKind::nested_part, "piece of the boundary lies in cells", "pieces of the boundary lie in cells"},
    {DefectKind::overlapping_cells, "pair of cells overlaps", "pairs of cells overlap"},
    {DefectKind::wrong_neighbour, "entry of .neigh is wrong", "entries of .neigh are wrong"},
    {DefectKind::wrong_face, "face in the files is not a facet", "faces in the files are not facets"},
    {DefectKind::unfit_array, "array does not fit nodes and cells", "arrays do not fit nodes and cells"},
    {DefectKind::hanging_node, "node hangs on a cell", "nodes hang on cells"},
}};

std::string clause(const Defect& f) {
    const auto c = std::find_if(clauses.begin(), clauses.end(), [&](const Clause& x) { return x.kind == f.kind; });
    return fmt::format("{}{} {}", f.at_least ? "at least " : "", f.count, f.count == 1 ? c->one : c->more);
}

CheckWords words(const CheckReport& report) {
    return {report, CheckWords::Digits::plain};
}

std::string certified(const CheckReport& r, const std::string& name, const Colours& paint) {
    if (r.cells == 0) return paint.good(name + ": certified, trivially: the mesh has no cells") + "\n";
    return paint.good(fmt::format("{}: certified{}: {}", name, for_straight_sides(r.curved), words(r).certified())) +
           fmt::format("\n{}\n", words(r).proof());
}

/// As many reasons as fit in a line, at least one.
std::string not_certified(const CheckReport& r, const std::string& name, const Colours& paint) {
    // Overlaps first: they matter most. An open boundary follows from other defects, if there are any.
    std::vector<std::string> reasons;
    for (const Defect& f : r.defects) {
        if (!defect_text(f.kind).breaks || f.kind == DefectKind::open_boundary) continue;
        reasons.insert(f.kind == DefectKind::overlapping_cells ? reasons.begin() : reasons.end(), clause(f));
    }
    const Defect* const open = r.find(DefectKind::open_boundary);
    if (reasons.empty() && open != nullptr) reasons.push_back(clause(*open));
    std::string text = ": NOT certified";
    for (std::size_t i = 0; i < reasons.size(); ++i) {
        const std::size_t left = reasons.size() - i;
        constexpr std::size_t room = columns - std::string_view(", and 20 more defects").size();
        if (i > 0 && text.size() + 2 + reasons[i].size() > (left == 1 ? columns : room)) {
            text += ", and " + words(r).counted(left, "more defect", "more defects");
            break;
        }
        text += (i == 0 ? ": " : ", ") + reasons[i];
    }
    return paint.bad(name + text) + "\n";
}

/// What must hold, and how often it does not.
std::string condition_table(const CheckReport& r, const Mesh& mesh, const Colours& paint) {
    std::string out = paint.bold(fmt::format("{:<75}{:>13}", "condition", "violations")) + "\n";
    for (const ConditionRow& row : condition_rows(r, mesh)) {
        const std::string what =
            row.count != 0 ? (row.at_least ? ">= " : "") + std::to_string(row.count) : std::string(row.instead);
        const std::string line = fmt::format("{:<3} {:<71}{:>13}", row.name, row.text, what);
        out += (row.count != 0 ? paint.bad(line) : what == "ok" ? paint.good(line) : line) + "\n";
    }
    const std::string_view left_out = left_out_sentence(r);
    return left_out.empty() ? out : fmt::format("{}{}\n", out, left_out);
}

/// The pieces one after the other, as many a line as fit.
std::string wrapped(const std::vector<std::string>& pieces, char between) {
    constexpr std::string_view indent = "    ";
    std::string out, line;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        std::string piece = pieces[i];
        if (i + 1 < pieces.size()) piece += between;
        if (!line.empty() && line.size() + 1 + piece.size() > columns) {
            out += line + "\n";
            line.clear();
        }
        line += (line.empty() ? std::string(indent) : " ") + piece;
    }
    return line.empty() ? out : out + line + "\n";
}

/// The listed places of a defect. Where each is just one cell or one node, "cells" or "nodes" is said once.
std::string places(const CheckReport& r, const Defect& f) {
    if (f.places.empty()) return "";
    const auto plain = [&](bool cells) {
        return std::all_of(f.places.begin(), f.places.end(), [&](const DefectPlace& p) {
            const auto alone = [](const auto& all) { return all[0] >= 0 && (all[1] < 0 || all[1] == all[0]); };
            return *p.detail == '\0' && (cells ? alone(p.cells) && p.nodes[0] < 0 : alone(p.nodes) && p.cells[0] < 0);
        });
    };
    const bool cells = plain(true), nodes = !cells && plain(false);
    std::vector<std::string> pieces;
    for (const DefectPlace& p : f.places) {
        std::string text = place_text(r, f.kind, p);
        if (cells || nodes) {
            const std::string number = text.substr(text.find(' ') + 1);
            const std::string what = cells ? "cell" : "node";
            text = pieces.empty() ? fmt::format("{}{} {}", what, f.places.size() > 1 ? "s" : "", number) : number;
        }
        pieces.push_back(std::move(text));
    }
    if (f.places.size() < f.count)
        pieces.push_back(f.at_least ? "and more" : fmt::format("and {} more", f.count - f.places.size()));
    return wrapped(pieces, cells || nodes ? ',' : ';');
}

std::string defect_lines(const CheckReport& r, const Defect& f, const Colours& paint) {
    const DefectText& t = defect_text(f.kind);
    const std::string count = (f.at_least ? ">= " : "") + std::to_string(f.count);
    std::string out = fmt::format("{} {:>11}  {}\n", paint.bold(fmt::format("{:<18}", t.name)), count, t.text);
    out += places(r, f);
    if (f.curved_cells != 0) out += fmt::format("    {}\n", words(r).curved(f));
    // That remedy repairs no folded cell.
    const bool folded = f.kind == DefectKind::mixed_orientation && r.find(DefectKind::same_side) != nullptr;
    return f.remedy().empty()
               ? out
               : out + fmt::format("    -> {}{}\n", f.remedy(), folded ? "; this does not repair folded cells" : "");
}

std::string defect_list(const CheckReport& r, bool breaking, std::string_view heading, const Colours& paint) {
    std::string out;
    for (const Defect& f : r.defects) {
        if (f.breaks() == breaking) out += defect_lines(r, f, paint);
    }
    if (out.empty()) return out;
    return "\n" + paint.bold(std::string(heading)) + "\n" + out;
}

constexpr std::size_t max_fraction = 80;

std::string contact(const CheckReport& r, const CellContact& c, bool& cut) {
    const int d = r.dimension;
    const auto cells = r.cell_number(c.cells);
    std::vector<std::string> decimal, hex;
    for (std::size_t k = 0; k < static_cast<std::size_t>(d); ++k) {
        decimal.push_back(base::shortest(c.common.point[k]));
        hex.push_back(base::hexadecimal(c.common.point[k]));
    }
    std::string out = fmt::format("cells {} and {} {}:", cells[0], cells[1], meeting_text(c));
    const std::string point = fmt::format("({}){}", fmt::join(decimal, ", "), c.common.exact ? "" : ", rounded");
    out += (out.size() + 1 + point.size() <= columns ? " " : "\n    ") + point + "\n";
    if (c.common.exact) return out + fmt::format("    ({})\n", fmt::join(hex, ", "));
    for (std::size_t k = 0; k < static_cast<std::size_t>(d); ++k) {
        const std::string& fraction = c.common.fraction[k];
        cut = cut || fraction.size() > max_fraction;
        out += fmt::format("    {} = {}\n", "xyz"[k], shortened_fraction(fraction, max_fraction));
    }
    return out;
}

std::string contact_list(const CheckReport& r, const Colours& paint) {
    if (r.contacts.empty()) return "";
    std::string out = "\n" +
                      paint.bold(words(r).counted(r.contacts.size(), "pair", "pairs") +
                                 " of cells that meet where they must not, each with a common point") +
                      "\n";
    bool cut = false;
    for (const CellContact& c : r.contacts) out += contact(r, c, cut);
    if (cut) out += "--json FILE writes the fractions in full.\n";
    return out;
}

std::string rounded(double x) {
    return fmt::format("{:.4g}", x == 0 ? 0.0 : x);
}

std::string measure_row(const CheckReport& r, std::string_view name, const std::vector<double>& values,
                        bool max_is_worst) {
    const Distribution d = distribution(values);
    if (d.min_cell < 0) return fmt::format("{:<31}{:>12}{:>12}{:>12}{:>12}", name, "-", "-", "-", "-");
    return fmt::format("{:<31}{:>12}{:>12}{:>12}{:>12}", name, rounded(d.min), rounded(d.median), rounded(d.max),
                       r.cell_number(max_is_worst ? d.max_cell : d.min_cell));
}

std::string measure_table(const CheckReport& r, const Colours& paint) {
    const CellMeasures& m = r.measures;
    const bool plane = r.dimension == 2;
    std::string out = "\n" +
                      paint.bold(fmt::format("{:<31}{:>12}{:>12}{:>12}{:>12}", "measure of a cell", "min", "median",
                                             "max", "worst cell")) +
                      "\n";
    out += measure_row(r, plane ? "area" : "volume", cell_sizes(m), false) + "\n";
    out += measure_row(r, "accuracy lost to shape, bits", lost_bits(m), true) + "\n";
    out += measure_row(r, "circumradius / shortest edge", m.radius_edge, true) + "\n";
    out += measure_row(r, "aspect (regular cell: 1)", m.aspect, true) + "\n";
    out +=
        measure_row(r, plane ? "smallest angle, degrees" : "smallest dihedral angle, deg", m.min_angle, false) + "\n";
    out += measure_row(r, plane ? "largest angle, degrees" : "largest dihedral angle, deg", m.max_angle, true) + "\n";
    return out +
           paint.dim(
               "Bits: log2 of the condition number; of the 53 bits of a double, plain weights may lose so many.") +
           "\n";
}

/// The first line beside the name, the others below it.
std::string named_lines(std::string_view name, const std::vector<std::string>& lines) {
    std::string out;
    for (const std::string& line : lines) out += fmt::format("{:<10} {}\n", out.empty() ? name : "", line);
    return out;
}

std::string whole_mesh(const CheckReport& r) {
    const BoundaryReport& b = r.boundary;
    const CheckWords w = words(r);
    const std::string uncounted = w.uncounted();
    std::string out = "\n" + named_lines("cells", {w.orientations()});
    out += named_lines("domain", {w.domain() + (uncounted.empty() ? "" : "; " + uncounted)});
    out += named_lines(
        "boundary",
        {fmt::format("{} in {}, {}, {}", w.counted(b.facets, "facet", "facets"), w.counted(b.pieces, "piece", "pieces"),
                     b.closed ? "closed" : "NOT closed", b.manifold ? "manifold" : "touching itself (not manifold)")});
    out += named_lines(r.dimension == 2 ? "area" : "volume",
                       {fmt::format("{}: {}", w.volumes(), r.volume.equal ? "exactly equal" : "NOT equal")});
    if (r.delaunay) out += named_lines("Delaunay", w.delaunay());
    if (r.conformity) out += named_lines("PLC", w.conformity(columns - 60));
    return out;
}

}  // namespace

std::string check_text(const CheckReport& r, const Mesh& mesh, const std::string& path, const TerminalStyle& style) {
    const ExactEnvironment environment;
    const Colours paint(style.colour);
    const std::string name = base::printable(path);
    std::string out = curved_lines(r.curved, paint);
    out += r.certified() ? certified(r, name, paint) : not_certified(r, name, paint);
    if (!r.defects.empty() || r.cells != 0) {
        out += numbering_sentence(r, mesh) + "\n";
    }
    out += "\n" + condition_table(r, mesh, paint);
    out += defect_list(r, true, breaking_heading, paint) + contact_list(r, paint);
    if (r.cells != 0) out += whole_mesh(r) + measure_table(r, paint);
    out += defect_list(r, false, harmless_heading, paint);
    out += named_lines("\nread", note_sentences(r));
    return out + fmt::format("\n{}\n", words(r).checked());
}

std::string fix_text(const FixedMesh& fixed, const TerminalStyle& style) {
    const ExactEnvironment environment;
    const Colours paint(style.colour);
    const std::string name = base::printable(fixed.file);
    const CheckReport& after = fixed.after;
    std::string out = "\n" + paint.bold(fmt::format("Repaired copy: {}", name)) + "\n";
    for (const std::string& line : fix_sentences(fixed)) out += line + "\n";
    out += after.certified() ? certified(after, name, paint) : not_certified(after, name, paint);
    return after.certified() ? out : out + defect_list(after, true, "What remains in the copy", paint);
}

}  // namespace barycert
