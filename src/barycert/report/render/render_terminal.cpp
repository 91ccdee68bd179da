#include <cmath>

#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report.hpp"
#include "barycert/report/common/terminal_text.hpp"
#include "barycert/report/render/render_words.hpp"

namespace barycert {
namespace {

std::string row(std::string_view name, const std::string& text) {
    return fmt::format("{:<10} {}\n", name, text);
}

std::string picture_row(const RenderReport& s) {
    std::string text =
        fmt::format("{}, {} x {} pixels: {}", s.picture, s.size.width, s.size.height, report::word(s.method));
    if (s.interpolation != Interpolation::perspective || s.texel_error)
        text += fmt::format(", {}", report::word(s.interpolation));
    if (s.rounding == Rounding::correct) text += ", correctly rounded";
    return row("picture", text);
}

std::string triangles_row(const RenderCounts& n) {
    std::string text = fmt::format("{}: {} drawn", n.triangles, n.drawn);
    const auto add = [&](std::uint64_t count, const char* what) {
        if (count != 0) text += fmt::format(", {} {}", count, what);
    };
    add(n.outside, "out of sight");
    add(n.degenerate, "without area");
    add(n.between_pixels, "too small for the middle of a pixel");
    if (n.clipped != 0) text += fmt::format("; {} clipped", n.clipped);
    return row("triangles", text);
}

std::string pixels_row(const RenderCounts& n) {
    std::string text = fmt::format("{} drawn", n.pixels);
    if (n.hidden != 0 || n.covered != n.pixels)
        text += fmt::format("; triangles cover {} one by one, the nearest is seen", n.covered);
    return row("pixels", text);
}

}  // namespace

std::string render_text(const RenderReport& s, bool colour) {
    const ExactEnvironment environment;
    const report::Colours paint(colour);
    std::string out =
        report::curved_lines(s.curved, paint) + picture_row(s) + triangles_row(s.counts) + pixels_row(s.counts);
    if (s.colours) {
        const ColourRange& c = *s.colours;
        std::string text = std::isnan(c.low)
                               ? "none: no value is finite"
                               : fmt::format("from {} to {}", base::shortest(c.low), base::shortest(c.high));
        if (c.without_value != 0)
            text += paint.bold(fmt::format("; {} triangles without a value, grey", c.without_value));
        out += row("colours", base::printable(c.field) + " " + text);
    }
    if (s.texel_error) {
        const TexelError& e = *s.texel_error;
        out += row("error", fmt::format("at most {:.3g} texels, in column {}, row {} from the bottom", e.texels,
                                        e.column, e.row));
    }
    for (const Note& note : s.notes) out += row("note", message(note));
    return out + row("time", fmt::format("{:.3g} s", s.seconds));
}

}  // namespace barycert
