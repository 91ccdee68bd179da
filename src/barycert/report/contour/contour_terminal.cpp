#include <cmath>
#include <vector>

#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report.hpp"
#include "barycert/report/common/terminal_text.hpp"

namespace barycert {

using namespace report;

namespace {

std::string plural(std::uint64_t n, std::string_view one, std::string_view more) {
    return fmt::format("{} {}", n, n == 1 ? one : more);
}

std::string line(std::string_view name, const std::string& text) {
    return fmt::format("{:<10} {}\n", name, text);
}

/// What is cut, and at what.
std::string level(const ContourReport& s) {
    if (s.value) return base::printable(s.field) + " = " + base::shortest(*s.value);
    std::string text = "plane ";
    for (const double n : s.plane->normal) text += base::shortest(n) + ",";
    return text + base::shortest(s.plane->offset);
}

std::string surface(const ContourReport& s, const Colours& paint) {
    const bool flat = s.dimension == 2;
    if (s.parts == 0) {
        const std::string range =
            std::isnan(s.low) ? "no finite number" : base::shortest(s.low) + " to " + base::shortest(s.high);
        return paint.bold(fmt::format("empty: {} at the nodes has {}", s.value ? "the field" : "D", range));
    }
    return fmt::format("{}, {} ({} of them nodes of the mesh), in {}",
                       flat ? plural(s.parts, "segment", "segments") : plural(s.parts, "triangle", "triangles"),
                       plural(s.points, "point", "points"), s.counts.at_nodes, plural(s.counts.cells, "cell", "cells"));
}

std::string points(const ContourReport& s) {
    const TierCounts& t = s.counts.tiers;
    return fmt::format("exact crossings{}, rounded once; decided by double-double {}, by integers {}",
                       for_straight_sides(s.curved), t.double_double, t.exact);
}

std::string names(const std::vector<std::string>& all) {
    std::vector<std::string> shown;
    shown.reserve(all.size());
    for (const std::string& name : all) shown.push_back(base::printable(name));
    return fmt::format("{}", fmt::join(shown, ", "));
}

/// What is not in the file, or is not what it looks like.
std::vector<std::string> notes(const ContourReport& s) {
    std::vector<std::string> all;
    const CutCounts& n = s.counts;
    if (n.not_finite != 0)
        all.push_back(fmt::format("{} left out: the field is NaN or infinite at a node; the surface ends there",
                                  plural(n.not_finite, "cell", "cells")));
    if (n.degenerate != 0)
        all.push_back(fmt::format("{} of zero volume cut, with the orientation of the neighbours",
                                  plural(n.degenerate, "cell", "cells")));
    if (n.second_order != 0)
        all.push_back(fmt::format("{} of second order cut as linear ones, by their corners",
                                  plural(n.second_order, "cell", "cells")));
    if (n.tiers.not_finite != 0)
        all.push_back(fmt::format("{} with NaN in a field, next to a value that is not finite",
                                  plural(n.tiers.not_finite, "point", "points")));
    if (!s.file.left_out.empty()) all.push_back("fields that the format cannot hold: " + names(s.file.left_out));
    if (!s.file.renamed.empty()) all.push_back("fields that the format names otherwise: " + names(s.file.renamed));
    for (const Note& note : s.notes) all.push_back(message(note));
    return all;
}

std::string picture(const ContourReport& s) {
    const SliceCounts& n = s.picture;
    std::string text = fmt::format("{} x {} pixels of {:.6g}", s.pixels->width, s.pixels->height, s.pixels->pixel);
    if (std::isnan(n.low)) return text + "; nothing drawn: no point has a finite value";
    text += fmt::format("; colours from {} to {}", base::shortest(n.low), base::shortest(n.high));
    if (n.below + n.above != 0) text += fmt::format("; {} below and {} above", n.below, n.above);
    const std::uint64_t clear = n.outside + n.not_finite;
    return text + (clear == 0 ? "" : fmt::format("; {} without a value, transparent", clear));
}

std::string view(const ContourReport& s) {
    std::string text = fmt::format("{} x {} pixels", s.view->width, s.view->height);
    if (s.colours.empty()) return text + ", grey: --colours names a field";
    if (std::isnan(s.drawn.low)) return text + "; no value is finite";
    text += fmt::format("; colours of {} from {} to {}", base::printable(s.colours), base::shortest(s.drawn.low),
                        base::shortest(s.drawn.high));
    if (s.drawn.without_value != 0)
        text += fmt::format("; {} in grey, without a value", plural(s.drawn.without_value, "triangle", "triangles"));
    return text;
}

std::string times(const ContourReport& s) {
    std::string text =
        fmt::format("{:.3g} s on {}: mesh {:.3g}, cutting {:.3g}", s.seconds.total,
                    plural(static_cast<std::uint64_t>(s.threads), "thread", "threads"), s.seconds.mesh, s.seconds.cut);
    if (s.pixels) text += fmt::format(", sampling {:.3g}", s.seconds.sample);
    if (s.view) text += fmt::format(", drawing {:.3g}", s.seconds.sample);
    return text + fmt::format(", writing {:.3g}", s.seconds.write);
}

}  // namespace

std::string contour_text(const ContourReport& s, bool colour) {
    const ExactEnvironment environment;
    const Colours paint(colour);
    std::string out = curved_lines(s.curved, paint) + line("cut", level(s));
    if (s.pixels) {
        out += line("picture", picture(s));
        out += line("values", fmt::format("exact{} at the pixels' middles, which are rounded to doubles; rounded once",
                                          for_straight_sides(s.curved)));
    } else {
        out += line("surface", surface(s, paint));
        if (s.parts != 0) out += line("points", points(s));
        if (s.view) out += line("picture", view(s));
        if (!s.view && !s.fields.empty()) out += line("fields", names(s.fields));
    }
    for (const std::string& note : notes(s)) out += line("note", paint.bold(note));
    out += line("mesh", plural(s.cells, "cell", "cells") + ", " + plural(s.nodes, "node", "nodes"));
    out += line("time", times(s));
    return out;
}

}  // namespace barycert
