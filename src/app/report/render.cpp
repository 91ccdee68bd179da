// Reports on pictures and on runs of cutting.

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/report/common/document.hpp"
#include "app/report/common/json.hpp"
#include "app/report/common/terminal_text.hpp"
#include "barycert/contour_job.hpp"
#include "barycert/environment.hpp"
#include "barycert/figure.hpp"
#include "barycert/job.hpp"
#include "barycert/raster.hpp"
#include "barycert/render_job.hpp"
#include "barycert/report.hpp"
#include "barycert/result.hpp"
#include "barycert/scene.hpp"
#include "barycert/surface.hpp"
#include "barycert/weights.hpp"
#include "core/base/text.hpp"

namespace barycert {

using namespace report;

JSON_OF(ColourRange, field, low, high, without_value)
JSON_OF(TexelError, texels, column, row)

namespace {

std::string range_text(double low, double high) {
    return base::shortest(low) + " to " + base::shortest(high);
}

// Words for what a picture was made with, as on the command line.
std::string_view word(FillMethod method) {
    return method == FillMethod::scanline ? "scanline" : method == FillMethod::bilinear ? "bilinear" : "barycentric";
}
std::string_view word(Interpolation interpolation) {
    return interpolation == Interpolation::affine        ? "affine"
           : interpolation == Interpolation::projected_z ? "projected-z"
                                                         : "perspective";
}

void tell_triangles(Document& d, const RenderCounts& n) {
    const std::string others = clauses({{n.outside, "out of sight"},
                                        {n.degenerate, "without area"},
                                        {n.between_pixels, "too small for the middle of a pixel"}},
                                       ", ");
    std::string text = fmt::format("{}: {} drawn{}{}", n.triangles, n.drawn, others.empty() ? "" : ", ", others);
    if (n.clipped != 0) text += fmt::format("; {} clipped", n.clipped);
    d.figure("triangles", record("count", n.triangles, MEMBERS(n, drawn, outside, degenerate, between_pixels, clipped)),
             "triangles", text);
}

void tell_pixels(Document& d, const RenderCounts& n, int samples) {
    std::string text = n.pixels == 0 && n.drawn != 0 ? "none: polygons" : fmt::format("{} drawn", n.pixels);
    if (n.hidden != 0 || n.covered != n.pixels)
        text += fmt::format("; triangles cover {} one by one, the nearest is seen", n.covered);
    d.figure("pixels", record("count", n.pixels, MEMBERS(n, covered, hidden)), samples == 1 ? "pixels" : "samples",
             text);
}

void tell_colours(Document& d, const ColourRange& c) {
    std::string text =
        c.field + " " + (std::isnan(c.low) ? "none: no value is finite" : "from " + range_text(c.low, c.high));
    if (c.without_value != 0) text += fmt::format("; {} without a value, grey", c.without_value);
    d.figure("colours", c, "colours", text, c.without_value == 0 ? Tone::plain : Tone::strong);
}

Document render_document(const RenderReport& s, const Environment& environment) {
    Document d;
    const bool correct = s.rounding == Rounding::correct;
    d.data = record("schema", render_schema, MEMBERS(s, picture, input));
    if (s.picture == "mesh") put(d.data, MEMBERS(s, curved));
    put(d.data, MEMBERS(s, output), MEMBERS(s.size, width, height), MEMBERS(s, samples), "method", word(s.method),
        "interpolation", word(s.interpolation), "rounding", correct ? "correct" : "plain");
    d.curved(s.curved);
    std::string text =
        fmt::format("{}, {} x {} pixels{}: {}", s.picture, s.size.width, s.size.height,
                    s.samples == 1 ? "" : fmt::format(" of {0} x {0} samples", s.samples), word(s.method));
    if (s.interpolation != Interpolation::perspective || s.texel_error)
        text += fmt::format(", {}", word(s.interpolation));
    d.name("picture", text + (correct ? ", correctly rounded" : ""));
    tell_triangles(d, s.counts);
    tell_pixels(d, s.counts, s.samples);
    if (s.colours) tell_colours(d, *s.colours);
    if (s.texel_error) {
        const TexelError& e = *s.texel_error;
        d.figure("texel_error", e, "error",
                 fmt::format("at most {:.3g} texels, in column {}, row {} from the bottom", e.texels, e.column, e.row));
    }
    put(d.data, MEMBERS(s, notes));
    for (const Note& note : s.notes) d.name("note", message(note));
    d.figure("seconds", s.seconds, "time", fmt::format("{:.3g} s", s.seconds));
    put(d.data, "environment", environment);
    return d;
}

// Contours and slices.

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

/// Adds what is not in the file, or is not what it looks like.
void tell_notes(Document& d, const ContourReport& s) {
    const CutCounts& n = s.counts;
    const auto note = [&](std::uint64_t count, std::string_view what, std::string_view text) {
        if (count != 0) d.name("note", counted(count, what) + std::string(text), Tone::strong);
    };
    note(n.not_finite, "cell", " left out: the field is NaN or infinite at a node; the surface ends there");
    note(n.degenerate, "cell", " of zero volume cut, with the orientation of the neighbours");
    note(n.second_order, "cell", " of second order cut as linear ones, by their corners");
    note(n.tiers.not_finite, "point", " with NaN in a field, next to a value that is not finite");
    for (const auto& [fields, what] :
         {std::pair(&s.file.left_out, "cannot hold"), {&s.file.renamed, "names otherwise"}})
        if (!fields->empty())
            d.name("note", fmt::format("fields that the format {}: {}", what, fmt::join(*fields, ", ")), Tone::strong);
    for (const Note& told : s.notes) d.name("note", message(told), Tone::strong);
}

/// Describes a section: with values at pixels, or of triangles.
std::string pixels_text(const ContourReport& s) {
    const FigureCounts& n = s.drawn;
    const std::string text =
        fmt::format("{} x {} pixels of {:.6g}", s.pixels->width, s.pixels->height, s.pixels->pixel);
    const std::uint64_t clear = n.grid.outside + n.grid.not_finite;
    return text + "; colours from " + range_text(n.low, n.high) +
           (n.below + n.above == 0 ? "" : fmt::format("; {} below and {} above", n.below, n.above)) +
           (clear == 0 ? "" : fmt::format("; {} without a value", clear));
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

Document contour_document(const ContourReport& s, const Environment& environment) {
    Document d;
    d.data = record("schema", contour_schema, "command", s.value ? "render iso" : "render slice",
                    MEMBERS(s, mesh, curved, dimension, nodes, cells, field, value));
    if (s.simplices != 0) put(d.data, MEMBERS(s, simplices));
    if (s.plane) put(d.data, MEMBERS(*s.plane, normal, offset));
    const CutCounts& cut = s.counts;
    put(d.data, MEMBERS(s, low, high, output, points, parts), "cut",
        record(MEMBERS(cut, cells, not_finite, degenerate, second_order, at_nodes, on_edges),
               MEMBERS(cut.tiers, double_double, exact), "nan", cut.tiers.not_finite),
        MEMBERS(s, fields), MEMBERS(s.file, left_out, renamed), MEMBERS(s, notes));
    d.curved(s.curved);
    d.name("cut", s.value ? s.field + " = " + base::shortest(*s.value)
                          : fmt::format("plane {},{}", coordinates(s.plane->normal, 3, base::shortest, ","),
                                        base::shortest(s.plane->offset)));
    if (s.pixels) {
        const PixelGrid& p = *s.pixels;
        Json picture = record(MEMBERS(p, width, height, pixel, origin), "right", p.step_right, "up", p.step_up,
                              MEMBERS(s.drawn, low, high, below, above));
        const GridCounts& n = s.drawn.grid;
        if (!s.view) put(picture, MEMBERS(n, drawn, outside, not_finite));
        d.figure("picture", std::move(picture), "picture", pixels_text(s));
        if (!s.view)
            d.name("values", fmt::format("exact{} at the pixels' middles, which are rounded to doubles; rounded once",
                                         for_straight_sides(s.curved)));
    }
    if (!s.pixels || s.view) tell_surface(d, s);
    if (s.view) {
        const double none = std::nan("");
        put(d.data, "view",
            record(MEMBERS(*s.view, width, height), "colours", s.colours, "low", s.colours.empty() ? none : s.drawn.low,
                   "high", s.colours.empty() ? none : s.drawn.high, "without_value", s.drawn.without_value));
        if (!s.pixels) d.name("picture", view_text(s));
    } else if (!s.pixels && !s.fields.empty()) {
        d.name("fields", fmt::format("{}", fmt::join(s.fields, ", ")));
    }
    tell_notes(d, s);
    d.name("mesh", cells_text(s.cells, s.simplices, s.dimension) + ", " + counted(s.nodes, "node"));
    const JobSeconds& t = s.seconds;
    std::vector<std::pair<std::string_view, double>> parts{{"mesh", t.mesh}, {"cutting", t.build}};
    if (s.pixels || s.view) parts.emplace_back(s.view ? "drawing" : "sampling", t.sample);
    parts.emplace_back("writing", t.write);
    d.figure("seconds", record(MEMBERS(t, mesh), "cut", t.build, MEMBERS(t, sample, write, total)), "time",
             time_text(t.total, s.threads, parts));
    put(d.data, MEMBERS(s, threads), "environment", environment);
    return d;
}

}  // namespace

std::string render_text(const RenderReport& report, bool colour) {
    return written_text([&] { return render_document(report, {}); }, colour);
}

std::string render_json(const RenderReport& report, const Environment& environment) {
    return written_json([&] { return render_document(report, environment); }, 2);
}

std::string contour_text(const ContourReport& report, bool colour) {
    return written_text([&] { return contour_document(report, {}); }, colour);
}

std::string contour_json(const ContourReport& report, const Environment& environment) {
    return written_json([&] { return contour_document(report, environment); }, 2);
}

}  // namespace barycert
