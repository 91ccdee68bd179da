#include "barycert/audit_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "barycert/environment.hpp"
#include "barycert/report/common/svg.hpp"

namespace barycert {

using namespace report;

namespace {

struct DriftLook {
    std::string_view colour;
    Mark mark;
};
// As in the picture of condition numbers.
constexpr std::array<DriftLook, 6> drift_looks{{{"#d55e00", Mark::up},
                                                {"#0072b2", Mark::circle},
                                                {"#009e73", Mark::square},
                                                {"#cc79a7", Mark::diamond},
                                                {"#e69f00", Mark::down},
                                                {"#56b4e9", Mark::cross}}};

/// Where the logarithm of no error is drawn. An error that is not zero is half an ulp at least.
constexpr double no_error = -2;

double log_error(double ulps) {
    return ulps > 0 ? std::log2(ulps) : no_error;
}

std::string pixels_text(double log_size) {
    return fmt::format("{:.0f}", std::exp2(log_size));
}

std::string ulps_text(double log_ulps) {
    if (log_ulps == no_error) return "";  // has its own label
    constexpr std::array digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string out = "2";
    for (const char c : fmt::format("{:.0f}", log_ulps))
        out += c == '-' ? "⁻" : digits[static_cast<std::size_t>(c - '0')];
    return out;
}

void draw_curve(Svg& svg, const Axis& x, const Axis& y, const DriftCurve& curve, const DriftLook& look) {
    std::vector<Svg::Point> line;
    for (const DriftPoint& p : curve.points) {
        if (p.cases != 0) line.emplace_back(x.at(std::log2(p.size)), y.at(log_error(p.worst_ulp)));
    }
    svg.polyline(line, {.colour = look.colour, .width = 1.6});
    for (const Svg::Point& p : line) svg.mark(p, look.mark, 3.6, look.colour);
}

void draw_drift_legend(Svg& svg, const std::vector<DriftCurve>& curves, bool colour_step, double left, double top) {
    double at = top;
    for (std::size_t i = 0; i < curves.size(); ++i, at += 42) {
        svg.line({left, at}, {left + 28, at}, {.colour = drift_looks[i].colour, .width = 1.6});
        svg.mark({left + 14, at}, drift_looks[i].mark, 4, drift_looks[i].colour);
        const std::string& name = curves[i].kernel.name;
        svg.text({left + 38, at + 4}, name.substr(name.find('.') + 1), {.size = 13});
        if (!curves[i].points.empty() && curves[i].points.back().cases != 0)
            svg.text({left + 38, at + 20},
                     fmt::format("relative {:.2g} at {}", curves[i].points.back().worst_relative,
                                 curves[i].points.back().size),
                     {.size = 12, .colour = "#555"});
    }
    if (!colour_step) return;
    at += 8;
    svg.line({left, at}, {left + 28, at}, {.colour = "#888", .width = 1.2, .dashes = "8 4"});
    svg.text({left + 38, at + 4}, "a step of 1/255: 8-bit colour", {.size = 12, .colour = "#555"});
}

}  // namespace

std::string drift_plot(const DriftReport& report) {
    const ExactEnvironment environment;
    const std::string title = "Drift: error of an attribute over the size of the triangle";
    std::vector<DriftCurve> curves = report.curves;
    if (curves.size() > drift_looks.size()) curves.resize(drift_looks.size());
    double low = 2, high = 12, error = 4;
    for (const DriftCurve& curve : curves) {
        for (const DriftPoint& p : curve.points) {
            low = std::min(low, std::log2(p.size));
            high = std::max(high, std::log2(p.size));
            error = std::max(error, std::ceil(log_error(p.worst_ulp)) + 1);
        }
    }
    // A step of eight bits of colour, where an ulp is 2^-52: shown where errors come near it.
    const double colour = 52 - std::log2(255);
    const bool colour_step = error > colour - 16;
    if (colour_step) error = std::max(error, std::ceil(colour) + 1);
    Svg svg(980, 620, title);
    svg.text({70, 34}, title, {.size = 18, .bold = true});
    const Axis x{.low = low,
                 .high = high,
                 .from = 80,
                 .to = 690,
                 .title = "size of the triangle, pixels across (logarithmic)",
                 .label = pixels_text};
    const Axis y{.low = no_error,
                 .high = error,
                 .from = 500,
                 .to = 60,
                 .title = "largest error of the value, ulps (logarithmic)",
                 .label = ulps_text};
    draw_frame(svg, x, y);
    svg.text({x.from - 9, y.at(no_error) + 4.5}, "0", {.anchor = Anchor::end});
    if (colour_step)
        draw_line_through(svg, x, y, {0, colour}, {1, colour}, {.colour = "#888", .width = 1.2, .dashes = "8 4"});
    for (std::size_t i = curves.size(); i-- > 0;) draw_curve(svg, x, y, curves[i], drift_looks[i]);
    draw_drift_legend(svg, curves, colour_step, 706, 76);
    const TextStyle small{.size = 12, .colour = "#555"};
    svg.text(
        {70, 568},
        fmt::format("Largest of {} cases a size (seed {}): attributes of 1 to 2 at the vertices, the point a pixel "
                    "centre in the triangle.",
                    report.count, report.seed),
        small);
    svg.text({70, 586}, "Vertices lie on the grid of 1/256 pixel. An ulp of the value is 2⁻⁵², about 2.2e-16.", small);
    return std::move(svg).finish();
}

}  // namespace barycert
