// What a run of cutting did.

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report.hpp"
#include "barycert/report/common/document.hpp"

namespace barycert {

using namespace report;

namespace {

std::string range_text(double low, double high) {
    return base::shortest(low) + " to " + base::shortest(high);
}

/// What is cut, and at what.
std::string level(const ContourReport& s) {
    if (s.value) return s.field + " = " + base::shortest(*s.value);
    std::string text = "plane ";
    for (const double n : s.plane->normal) text += base::shortest(n) + ",";
    return text + base::shortest(s.plane->offset);
}

void tell_surface(Document& d, const ContourReport& s) {
    const CutCounts& n = s.counts;
    if (s.parts == 0)
        return d.name("surface",
                      fmt::format("empty: {} at the nodes has {}", s.value ? "the field" : "D",
                                  std::isnan(s.low) ? "no finite number" : range_text(s.low, s.high)),
                      Tone::strong);
    d.name("surface", fmt::format("{}, {} ({} of them nodes of the mesh), in {}",
                                  counted(s.parts, s.dimension == 2 ? "segment" : "triangle"),
                                  counted(s.points, "point"), n.at_nodes, counted(n.cells, "cell")));
    d.name("points", fmt::format("exact crossings{}, rounded once; decided by double-double {}, by integers {}",
                                 for_straight_sides(s.curved), n.tiers.double_double, n.tiers.exact));
}

std::string names(const std::vector<std::string>& all) {
    return fmt::format("{}", fmt::join(all, ", "));
}

/// What is not in the file, or is not what it looks like.
void tell_notes(Document& d, const ContourReport& s) {
    const CutCounts& n = s.counts;
    const auto note = [&](std::uint64_t count, std::string_view what, std::string_view text) {
        if (count != 0) d.name("note", counted(count, what) + std::string(text), Tone::strong);
    };
    note(n.not_finite, "cell", " left out: the field is NaN or infinite at a node; the surface ends there");
    note(n.degenerate, "cell", " of zero volume cut, with the orientation of the neighbours");
    note(n.second_order, "cell", " of second order cut as linear ones, by their corners");
    note(n.tiers.not_finite, "point", " with NaN in a field, next to a value that is not finite");
    if (!s.file.left_out.empty())
        d.name("note", "fields that the format cannot hold: " + names(s.file.left_out), Tone::strong);
    if (!s.file.renamed.empty())
        d.name("note", "fields that the format names otherwise: " + names(s.file.renamed), Tone::strong);
    for (const Note& told : s.notes) d.name("note", message(told), Tone::strong);
}

std::string pixels_text(const ContourReport& s) {
    const SliceCounts& n = s.picture;
    const std::string text =
        fmt::format("{} x {} pixels of {:.6g}", s.pixels->width, s.pixels->height, s.pixels->pixel);
    if (std::isnan(n.low)) return text + "; nothing drawn: no point has a finite value";
    const std::uint64_t clear = n.outside + n.not_finite;
    return text + "; colours from " + range_text(n.low, n.high) +
           (n.below + n.above == 0 ? "" : fmt::format("; {} below and {} above", n.below, n.above)) +
           (clear == 0 ? "" : fmt::format("; {} without a value, transparent", clear));
}

std::string view_text(const ContourReport& s) {
    const std::string text = fmt::format("{} x {} pixels", s.view->width, s.view->height);
    if (s.colours.empty()) return text + ", grey: --colours names a field";
    if (std::isnan(s.drawn.low)) return text + "; no value is finite";
    return text + fmt::format("; colours of {} from {}", s.colours, range_text(s.drawn.low, s.drawn.high)) +
           (s.drawn.without_value == 0
                ? ""
                : fmt::format("; {} in grey, without a value", counted(s.drawn.without_value, "triangle")));
}

Json cut_json(const CutCounts& n) {
    return record("cells", n.cells, "not_finite", n.not_finite, "degenerate", n.degenerate, "second_order",
                  n.second_order, "at_nodes", n.at_nodes, "on_edges", n.on_edges, "double_double",
                  n.tiers.double_double, "exact", n.tiers.exact, "nan", n.tiers.not_finite);
}

Document contour_document(const ContourReport& s, const Environment& environment) {
    Document d;
    d.data = record("schema", contour_schema, "command", s.value ? "render iso" : "render slice", "mesh", s.mesh,
                    "curved", curved_json(s.curved), "dimension", s.dimension, "nodes", s.nodes, "cells", s.cells,
                    "field", s.field, "value", s.value);
    if (s.plane) put(d.data, "normal", s.plane->normal, "offset", s.plane->offset);
    put(d.data, "low", s.low, "high", s.high, "output", s.output, "points", s.points, "parts", s.parts, "cut",
        cut_json(s.counts), "fields", s.fields, "left_out", s.file.left_out, "renamed", s.file.renamed, "notes",
        notes_json(s.notes));
    d.curved(s.curved);
    d.name("cut", level(s));
    if (s.pixels) {
        const PixelGrid& p = *s.pixels;
        const SliceCounts& n = s.picture;
        d.figure("picture",
                 record("width", p.width, "height", p.height, "pixel", p.pixel, "origin", p.origin, "right",
                        p.step_right, "up", p.step_up, "low", n.low, "high", n.high, "drawn", n.drawn, "below", n.below,
                        "above", n.above, "outside", n.outside, "not_finite", n.not_finite),
                 "picture", pixels_text(s));
        d.name("values", fmt::format("exact{} at the pixels' middles, which are rounded to doubles; rounded once",
                                     for_straight_sides(s.curved)));
    } else {
        tell_surface(d, s);
    }
    if (s.view) {
        const double none = std::nan("");
        put(d.data, "view",
            record("width", s.view->width, "height", s.view->height, "colours", s.colours, "low",
                   s.colours.empty() ? none : s.drawn.low, "high", s.colours.empty() ? none : s.drawn.high,
                   "without_value", s.drawn.without_value));
        if (!s.pixels) d.name("picture", view_text(s));
    } else if (!s.pixels && !s.fields.empty()) {
        d.name("fields", names(s.fields));
    }
    tell_notes(d, s);
    d.name("mesh", counted(s.cells, "cell") + ", " + counted(s.nodes, "node"));
    const ContourSeconds& t = s.seconds;
    std::string times = fmt::format("{:.3g} s on {}: mesh {:.3g}, cutting {:.3g}", t.total,
                                    counted(static_cast<std::uint64_t>(s.threads), "thread"), t.mesh, t.cut);
    if (s.pixels) times += fmt::format(", sampling {:.3g}", t.sample);
    if (s.view) times += fmt::format(", drawing {:.3g}", t.sample);
    d.figure("seconds", record("mesh", t.mesh, "cut", t.cut, "sample", t.sample, "write", t.write, "total", t.total),
             "time", times + fmt::format(", writing {:.3g}", t.write));
    put(d.data, "threads", s.threads, "environment", environment_json(environment));
    return d;
}

}  // namespace

std::string contour_text(const ContourReport& summary, bool colour) {
    const ExactEnvironment environment;
    return terminal_text(contour_document(summary, {}), colour);
}

std::string contour_json(const ContourReport& summary, const Environment& environment) {
    const ExactEnvironment exact;
    return data_text(contour_document(summary, environment));
}

}  // namespace barycert
