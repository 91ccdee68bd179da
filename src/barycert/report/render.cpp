// What a picture shows.

#include <fmt/format.h>

#include <cmath>

#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report.hpp"
#include "barycert/report/common/document.hpp"

namespace barycert {

using namespace report;

namespace {

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
    std::string text = fmt::format("{}: {} drawn", n.triangles, n.drawn);
    for (const auto& [count, what] : {std::pair(n.outside, "out of sight"),
                                      {n.degenerate, "without area"},
                                      {n.between_pixels, "too small for the middle of a pixel"}}) {
        if (count != 0) text += fmt::format(", {} {}", count, what);
    }
    if (n.clipped != 0) text += fmt::format("; {} clipped", n.clipped);
    d.figure("triangles",
             record("count", n.triangles, "drawn", n.drawn, "outside", n.outside, "degenerate", n.degenerate,
                    "between_pixels", n.between_pixels, "clipped", n.clipped),
             "triangles", text);
}

void tell_pixels(Document& d, const RenderCounts& n) {
    std::string text = fmt::format("{} drawn", n.pixels);
    if (n.hidden != 0 || n.covered != n.pixels)
        text += fmt::format("; triangles cover {} one by one, the nearest is seen", n.covered);
    d.figure("pixels", record("count", n.pixels, "covered", n.covered, "hidden", n.hidden), "pixels", text);
}

void tell_colours(Document& d, const ColourRange& c) {
    std::string text =
        c.field + " " +
        (std::isnan(c.low) ? "none: no value is finite"
                           : fmt::format("from {} to {}", base::shortest(c.low), base::shortest(c.high)));
    if (c.without_value != 0) text += fmt::format("; {} triangles without a value, grey", c.without_value);
    d.figure("colours", record("field", c.field, "low", c.low, "high", c.high, "without_value", c.without_value),
             "colours", text, c.without_value == 0 ? Tone::plain : Tone::strong);
}

Document render_document(const RenderReport& s, const Environment& environment) {
    Document d;
    d.data = record("schema", render_schema, "picture", s.picture, "input", s.input);
    if (s.picture == "mesh") d.data["curved"] = curved_json(s.curved);
    const bool correct = s.rounding == Rounding::correct;
    put(d.data, "output", s.output, "width", s.size.width, "height", s.size.height, "method", word(s.method),
        "interpolation", word(s.interpolation), "rounding", correct ? "correct" : "plain");
    d.curved(s.curved);
    std::string text = fmt::format("{}, {} x {} pixels: {}", s.picture, s.size.width, s.size.height, word(s.method));
    if (s.interpolation != Interpolation::perspective || s.texel_error)
        text += fmt::format(", {}", word(s.interpolation));
    d.name("picture", text + (correct ? ", correctly rounded" : ""));
    tell_triangles(d, s.counts);
    tell_pixels(d, s.counts);
    if (s.colours) tell_colours(d, *s.colours);
    if (s.texel_error) {
        const TexelError& e = *s.texel_error;
        d.figure("texel_error", record("texels", e.texels, "column", e.column, "row", e.row), "error",
                 fmt::format("at most {:.3g} texels, in column {}, row {} from the bottom", e.texels, e.column, e.row));
    }
    d.data["notes"] = notes_json(s.notes);
    for (const Note& note : s.notes) d.name("note", message(note));
    d.figure("seconds", s.seconds, "time", fmt::format("{:.3g} s", s.seconds));
    d.data["environment"] = environment_json(environment);
    return d;
}

}  // namespace

std::string render_text(const RenderReport& summary, bool colour) {
    const ExactEnvironment environment;
    return terminal_text(render_document(summary, {}), colour);
}

std::string render_json(const RenderReport& summary, const Environment& environment) {
    const ExactEnvironment exact;
    return data_text(render_document(summary, environment));
}

}  // namespace barycert
