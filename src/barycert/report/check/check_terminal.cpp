#include "barycert/report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report/check/check_conditions.hpp"
#include "barycert/report/common/terminal_text.hpp"

namespace barycert {

using namespace report;

namespace {

constexpr std::size_t columns = 100;

std::string plural(std::uint64_t n, std::string_view one, std::string_view more) {
    return fmt::format("{} {}", n, n == 1 ? one : more);
}

/// What a problem means for the verdict, after its count.
struct Clause {
    DefectKind kind;
    std::string_view one, more;
};
constexpr std::array<Clause, 15> clauses{{
    {DefectKind::bad_structure, "fault in its arrays", "faults in its arrays"},
    {DefectKind::index_out_of_range, "cell has a corner that is no node", "cells have a corner that is no node"},
    {DefectKind::not_finite, "node is not finite", "nodes are not finite"},
    {DefectKind::repeated_node, "cell has a node twice", "cells have a node twice"},
    {DefectKind::degenerate_cell, "cell is degenerate", "cells are degenerate"},
    {DefectKind::duplicate_cell, "cell is there again", "cells are there again"},
    {DefectKind::overfull_facet, "facet belongs to more than two cells", "facets belong to more than two cells"},
    {DefectKind::same_side, "facet has both cells on the same side", "facets have both cells on the same side"},
    {DefectKind::open_boundary, "ridge leaves the boundary open", "ridges leave the boundary open"},
    {DefectKind::boundary_contact, "pair of boundary facets meets", "pairs of boundary facets meet"},
    {DefectKind::nested_part, "piece of the boundary lies in cells", "pieces of the boundary lie in cells"},
    {DefectKind::overlapping_cells, "pair of cells overlaps", "pairs of cells overlap"},
    {DefectKind::wrong_neighbour, "entry of .neigh is wrong", "entries of .neigh are wrong"},
    {DefectKind::wrong_face, "triangle of .face is no facet", "triangles of .face are no facets"},
    {DefectKind::unfit_array, "array does not fit nodes and cells", "arrays do not fit nodes and cells"},
}};

std::string clause(const Defect& f) {
    const auto c = std::find_if(clauses.begin(), clauses.end(), [&](const Clause& x) { return x.kind == f.kind; });
    return (f.at_least ? "at least " : "") + plural(f.count, c->one, c->more);
}

/// "1 part, 0 cavities, 7 tunnels"; in the plane a cavity is a hole.
std::string domain(const CheckReport& r) {
    std::string text = plural(r.parts, "part", "parts");
    if (r.boundary.cavities) {
        text += ", " + (r.dimension == 2 ? plural(*r.boundary.cavities, "hole", "holes")
                                         : plural(*r.boundary.cavities, "cavity", "cavities"));
    }
    if (r.boundary.tunnels) {
        text += ", " + plural(static_cast<std::uint64_t>(*r.boundary.tunnels), "tunnel", "tunnels");
    }
    return text;
}

std::string certified(const CheckReport& r, const std::string& name, const Colours& paint) {
    if (r.cells == 0) return paint.good(name + ": certified, trivially: the mesh has no cells") + "\n";
    return paint.good(fmt::format("{}: certified: {} {} a domain of {}", name, plural(r.cells, "cell", "cells"),
                                  r.cells == 1 ? "is" : "partition", domain(r))) +
           "\nProved in exact arithmetic: any two cells meet in a common face or not at all. No overlap, no crack.\n";
}

/// As many reasons as fit in a line, at least one.
std::string not_certified(const CheckReport& r, const std::string& name, const Colours& paint) {
    // Overlaps first: they are what it is about. What follows from other problems is left to the list below.
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
        constexpr std::size_t room = columns - std::string_view(", and 20 more problems").size();
        if (i > 0 && text.size() + 2 + reasons[i].size() > (left == 1 ? columns : room)) {
            text += ", and " + plural(left, "more problem", "more problems");
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
    if (left_cells_out(r)) {
        out +=
            "Cells with a corner that is no node, a coordinate that is not finite or a node twice take no part in\n"
            "P2 to P5.\n";
    }
    return out;
}

template <std::size_t N>
std::vector<Mesh::Index> used(const std::array<Mesh::Index, N>& indices) {
    std::vector<Mesh::Index> list;
    for (const Mesh::Index i : indices) {
        if (i >= 0 && (list.empty() || list.back() != i)) list.push_back(i);
    }
    return list;
}

/// "cells 3 and 17, nodes 4 5 6 (coplanar)".
std::string place(const DefectPlace& p) {
    const auto cells = used(p.cells), nodes = used(p.nodes);
    std::vector<std::string> parts;
    if (!cells.empty())
        parts.push_back(fmt::format("cell{} {}", cells.size() == 1 ? "" : "s", fmt::join(cells, " and ")));
    if (!nodes.empty()) parts.push_back(fmt::format("node{} {}", nodes.size() == 1 ? "" : "s", fmt::join(nodes, " ")));
    const std::string text = fmt::format("{}", fmt::join(parts, ", "));
    return *p.detail == '\0' ? text : fmt::format("{}{}({})", text, text.empty() ? "" : " ", p.detail);
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

/// The places that are listed of a finding. Where each is just a cell or a node, so much need not be said of each.
std::string places(const Defect& f) {
    if (f.places.empty()) return "";
    const auto plain = [&](bool cells) {
        return std::all_of(f.places.begin(), f.places.end(), [&](const DefectPlace& p) {
            return *p.detail == '\0' && used(p.cells).size() == (cells ? 1U : 0U) &&
                   used(p.nodes).size() == (cells ? 0U : 1U);
        });
    };
    const bool cells = plain(true), nodes = !cells && plain(false);
    std::vector<std::string> pieces;
    for (const DefectPlace& p : f.places) {
        std::string text = place(p);
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

std::string finding(const CheckReport& r, const Defect& f, const Colours& paint) {
    const DefectText& t = defect_text(f.kind);
    const std::string count = (f.at_least ? ">= " : "") + std::to_string(f.count);
    std::string out = fmt::format("{} {:>11}  {}\n", paint.bold(fmt::format("{:<18}", t.name)), count, t.text);
    out += places(f);
    constexpr std::string_view none = "none needed";
    std::string_view remedy = t.remedy;
    if (remedy.starts_with(none)) remedy.remove_prefix(std::min(remedy.size(), none.size() + 2));
    // Beside a folded cell that remedy could be taken for more than it is.
    const bool folded = f.kind == DefectKind::mixed_orientation && r.find(DefectKind::same_side) != nullptr;
    return remedy.empty() ? out
                          : out + fmt::format("    -> {}{}\n", remedy, folded ? "; that mends no folded cell" : "");
}

std::string finding_list(const CheckReport& r, bool breaking, const Colours& paint) {
    std::string out;
    for (const Defect& f : r.defects) {
        if (defect_text(f.kind).breaks == breaking) out += finding(r, f, paint);
    }
    if (out.empty()) return out;
    return "\n" + paint.bold(breaking ? "What is wrong, and what to do" : "Notes, harmless to a partition") + "\n" +
           out;
}

/// Fractions grow with the widths of coordinates: thousands of digits are no help in a terminal.
std::string shortened(const std::string& fraction, bool& cut) {
    constexpr std::size_t longest = 80;
    if (fraction.size() <= longest) return fraction;
    cut = true;
    return fmt::format("{}...{} ({} characters)", fraction.substr(0, 24), fraction.substr(fraction.size() - 24),
                       fraction.size());
}

std::string contact(const CellContact& c, int d, bool& cut) {
    static constexpr std::array<std::string_view, 3> extents{"in a point", "along a segment", "in an area"};
    const std::string_view meet =
        c.overlap ? "overlap" : extents[static_cast<std::size_t>(std::clamp(c.dimension, 0, 2))];
    std::vector<std::string> decimal, hex;
    for (std::size_t k = 0; k < static_cast<std::size_t>(d); ++k) {
        decimal.push_back(shortest(c.witness.point[k]));
        hex.push_back(hexadecimal(c.witness.point[k]));
    }
    std::string out = fmt::format("cells {} and {} {}{}:", c.cells[0], c.cells[1], c.overlap ? "" : "touch ", meet);
    const std::string point = fmt::format("({}){}", fmt::join(decimal, ", "), c.witness.exact ? "" : ", rounded");
    out += (out.size() + 1 + point.size() <= columns ? " " : "\n    ") + point + "\n";
    if (c.witness.exact) return out + fmt::format("    ({})\n", fmt::join(hex, ", "));
    for (std::size_t k = 0; k < static_cast<std::size_t>(d); ++k)
        out += fmt::format("    {} = {}\n", "xyz"[k], shortened(c.witness.fraction[k], cut));
    return out;
}

std::string contact_list(const CheckReport& r, const Colours& paint) {
    if (r.contacts.empty()) return "";
    std::string out = "\n" +
                      paint.bold(plural(r.contacts.size(), "pair", "pairs") +
                                 " of cells that meet where they must not, each with an exact point of both") +
                      "\n";
    bool cut = false;
    for (const CellContact& c : r.contacts) out += contact(c, r.dimension, cut);
    if (cut) out += "--json FILE has the fractions whole.\n";
    return out;
}

std::string rounded(double x) {
    return fmt::format("{:.4g}", x == 0 ? 0.0 : x);
}

std::string measure_row(std::string_view name, const std::vector<double>& values, bool most_is_worst) {
    const Distribution d = distribution(values);
    if (d.min_cell < 0) return fmt::format("{:<31}{:>12}{:>12}{:>12}{:>12}", name, "-", "-", "-", "-");
    return fmt::format("{:<31}{:>12}{:>12}{:>12}{:>12}", name, rounded(d.min), rounded(d.median), rounded(d.max),
                       most_is_worst ? d.max_cell : d.min_cell);
}

std::string measure_table(const CheckReport& r, const Colours& paint) {
    const CellMeasures& m = r.measures;
    const bool plane = r.dimension == 2;
    std::vector<double> size(m.volume), bits(m.condition);
    for (double& x : size) x = std::fabs(x);
    for (double& x : bits) x = std::log2(x);
    std::string out = "\n" +
                      paint.bold(fmt::format("{:<31}{:>12}{:>12}{:>12}{:>12}", "measure of a cell", "least", "median",
                                             "most", "worst cell")) +
                      "\n";
    out += measure_row(plane ? "area" : "volume", size, false) + "\n";
    out += measure_row("bits that its shape may cost", bits, true) + "\n";
    out += measure_row("circumradius / shortest edge", m.radius_edge, true) + "\n";
    out += measure_row("aspect (regular cell: 1)", m.aspect, true) + "\n";
    out += measure_row(plane ? "smallest angle, degrees" : "smallest dihedral angle, deg", m.min_angle, false) + "\n";
    out += measure_row(plane ? "largest angle, degrees" : "largest dihedral angle, deg", m.max_angle, true) + "\n";
    return out +
           paint.dim(
               "bits: log2 of the condition number, what weights from differences of coordinates may lose of 53.") +
           "\n";
}

std::string conformity_lines(const ConformityReport& c) {
    std::string out = fmt::format("PLC        {} of the PLC: {} respected exactly, {} by rounding, {} violated\n",
                                  plural(c.facets, "facet", "facets"), c.exact, c.rounded, c.violated);
    if (c.rounded != 0)
        out += fmt::format("           nodes lie up to {:.3g} off their facet's plane, {:.3g} of the PLC's extent\n",
                           c.largest_distance, c.relative_distance);
    if (c.missing_vertices != 0)
        out += fmt::format("           {} of these facets {} no node\n",
                           plural(c.missing_vertices, "vertex", "vertices"), c.missing_vertices == 1 ? "is" : "are");
    std::string violated;
    std::size_t shown = 0;
    for (const ViolatedFacet& f : c.examples) {
        const std::string one = fmt::format("{}{} ({:.3g} %)", violated.empty() ? "" : ", ", f.facet, 100 * f.covered);
        if (violated.size() + one.size() > columns - 60) break;
        violated += one;
        ++shown;
    }
    if (c.violated > shown && shown > 0) violated += fmt::format(", and {} more", c.violated - shown);
    if (!violated.empty()) out += "           violated (share that is covered): " + violated + "\n";
    return out;
}

std::string whole_mesh(const CheckReport& r) {
    const BoundaryReport& b = r.boundary;
    const std::string_view what = r.dimension == 2 ? "area" : "volume";
    std::string out = fmt::format("\ncells      {} positive, {} negative, {} degenerate, by the exact sign of the {}\n",
                                  r.positive, r.negative, r.degenerate, what);
    out += fmt::format("domain     {}{}\n", domain(r),
                       b.cavities ? ""
                                  : fmt::format("; {} are not counted where the boundary is {}",
                                                r.dimension == 2 ? "holes" : "cavities and tunnels",
                                                b.closed ? "pinched along a ridge" : "open"));
    out += fmt::format("boundary   {} in {}, {}, {}\n", plural(b.facets, "facet", "facets"),
                       plural(b.pieces, "piece", "pieces"), b.closed ? "closed" : "NOT closed",
                       b.manifold ? "manifold" : "touching itself (not manifold)");
    out += fmt::format("{:<10} {} in the cells, {} within the boundary: {}\n", what, shortest(r.volume.cells),
                       shortest(r.volume.boundary), r.volume.equal ? "equal, exactly" : "NOT equal");
    if (r.delaunay) {
        const DelaunayReport& d = *r.delaunay;
        out += fmt::format("Delaunay   {} tested: {}", plural(d.facets, "interior facet", "interior facets"),
                           d.violations == 0 ? "all are locally Delaunay"
                                             : plural(d.violations, "is", "are") + " not locally Delaunay");
        if (d.cospherical != 0)
            out += fmt::format("; {} {}", d.cospherical, r.dimension == 2 ? "cocircular" : "cospherical");
        out += "\n";
        if (d.violations != 0) {
            out += fmt::format("           worst: node {} lies in the sphere of cell {}, {:.3g} of its radius deep\n",
                               d.worst_node, d.worst_cell, d.worst_depth);
        }
    }
    if (r.conformity) out += conformity_lines(*r.conformity);
    return out;
}

}  // namespace

std::string check_text(const CheckReport& r, const Mesh& mesh, const std::string& path, const TerminalStyle& style) {
    const ExactEnvironment environment;
    const Colours paint(style.colour);
    const std::string name = printable(path);
    std::string out = r.certified() ? certified(r, name, paint) : not_certified(r, name, paint);
    if (!r.defects.empty() || r.cells != 0) {
        out += fmt::format("Cells and nodes are counted from 0, in the order of the file{}.\n",
                           mesh.index_base == 1 ? " (which counts from 1)" : "");
    }
    out += "\n" + condition_table(r, mesh, paint);
    out += finding_list(r, true, paint) + contact_list(r, paint);
    if (r.cells != 0) out += whole_mesh(r) + measure_table(r, paint);
    out += finding_list(r, false, paint);
    return out + fmt::format("\n{}, {}; checked in {:.3g} s on {}\n", plural(r.nodes, "node", "nodes"),
                             plural(r.cells, "cell", "cells"), r.seconds,
                             plural(static_cast<std::uint64_t>(r.threads), "thread", "threads"));
}

}  // namespace barycert
