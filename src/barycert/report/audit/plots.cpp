// Pictures that are files of their own: errors over condition numbers, and over sizes of triangles.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "barycert/audit_report.hpp"
#include "barycert/environment.hpp"
#include "barycert/report/common/picture.hpp"

namespace barycert {

using namespace report;

namespace {

/// The whole of such a picture: a title above, axes, a legend to the right, notes below.
struct Plot {
    Axis x{.from = 76, .to = 700}, y{.from = 500, .to = 60};
    Picture svg;
    double legend = 76;  ///< where its next entry stands

    explicit Plot(const std::string& title) : svg(980, 620, title, plot_style) { svg.text({70, 34}, title, "head"); }
    void curve(std::size_t i, const std::vector<Pixel>& points, std::string_view style = {}) {
        svg.path(points, fmt::format("{} {}", curve_style(i), style));
        for (const Pixel& p : points) svg.mark(p, curve_mark(i), 3.4, curve_style(i));
    }
    /// Of a curve, with a second line; names are without the simplex, which the title tells, and not too long.
    void entry(std::size_t i, const std::string& name, const std::string& below, std::string_view style = {}) {
        svg.line({720, legend}, {748, legend}, fmt::format("{} {}", curve_style(i), style));
        svg.mark({734, legend}, curve_mark(i), 4, curve_style(i));
        const std::string rest = name.substr(name.find('.') + 1);
        svg.text({758, legend + 4}, rest.size() <= 27 ? rest : rest.substr(0, 26) + "…", "title");
        svg.text({758, legend + 20}, below, "small");
        legend += 40;
    }
    void entry(std::string_view style, std::string_view what) {
        svg.line({720, legend + 10}, {748, legend + 10}, style);
        svg.text({758, legend + 14}, what, "small");
        legend += 22;
    }
    void notes(const std::vector<std::string>& lines) {
        double at = 568;
        for (const std::string& line : lines) {
            svg.text({70, at}, line, "small");
            at += 18;
        }
    }
};

/// An error in bits above 2^-53. Below half of that it says nothing: exact weights are rounded that far themselves.
constexpr double min_bits = -1;
double error_bits(double units) {
    return std::max(std::log2(units), min_bits);
}

/// Those with something to show, largest worst factor first.
std::vector<const KernelResult*> candidates(const AuditReport& report, Simplex simplex) {
    std::vector<const KernelResult*> list;
    for (const KernelResult& k : report.kernels) {
        const auto bins = k.prediction.bins();
        const bool off = std::any_of(bins.begin(), bins.end(), [](const auto& bin) { return bin.worst > 0.5; });
        if (k.kernel.simplex == simplex && off) list.push_back(&k);
    }
    std::stable_sort(list.begin(), list.end(), [](const KernelResult* a, const KernelResult* b) {
        return a->prediction.worst_factor() > b->prediction.worst_factor();
    });
    return list;
}

bool is_variant(const KernelResult* k) {
    return std::count(k->kernel.name.begin(), k->kernel.name.end(), '.') > 1;
}

std::vector<const KernelResult*> chosen(std::vector<const KernelResult*> list) {
    if (list.size() > max_curves && !std::all_of(list.begin(), list.end(), is_variant)) std::erase_if(list, is_variant);
    if (list.size() <= max_curves) return list;
    std::vector<const KernelResult*> some;
    for (std::size_t i = 0; i < max_curves; ++i) some.push_back(list[i * (list.size() - 1) / (max_curves - 1)]);
    return some;
}

std::string factor_text(double factor) {
    if (factor < 0) return "unknown";  // no case within first order
    return factor < 1000 ? fmt::format("{:.2f}", factor) : "2" + superscript(std::log2(factor));
}

/// Where the logarithm of no error is drawn. An error that is not zero is half an ulp at least.
constexpr double no_error = -2;

double log_error(double ulps) {
    return ulps > 0 ? std::log2(ulps) : no_error;
}

}  // namespace

std::string condition_plot(const AuditReport& report) {
    const ExactEnvironment environment;
    Simplex simplex = Simplex::tetrahedron;
    std::vector<const KernelResult*> all = candidates(report, simplex);
    if (all.empty()) all = candidates(report, simplex = Simplex::triangle);
    const std::vector<const KernelResult*> kernels = chosen(all);
    Plot plot(std::string("Error of the weights over the condition number of the cell: ") +
              (simplex == Simplex::triangle ? "triangles" : "tetrahedra"));
    if (kernels.empty()) {
        plot.svg.text({70, 80}, "Nothing to show: no kernel on triangles or tetrahedra was off in a proper cell.", "");
        return std::move(plot.svg).finish();
    }
    // Axes that fit what there is, and show four bits at least.
    Axis &x = plot.x, &y = plot.y;
    double bits = 0;
    std::uint64_t cases = 0;
    x.low = Prediction::last_bits;
    y.low = min_bits - 1;
    y.high = 3;
    for (const KernelResult* k : kernels) {
        cases = std::max(cases, k->prediction.cases());
        for (const Prediction::Bin& bin : k->prediction.bins()) {
            x.low = std::min(x.low, static_cast<double>(bin.bits));
            bits = std::max(bits, bin.bits + 1.0);
            y.high = std::max(y.high, std::ceil(error_bits(bin.worst)) + 1);
        }
    }
    x.high = std::max(bits, x.low + 4);
    x.title = "log2 κ: accuracy at risk from the cell's shape, bits";
    y.title = "log2 (error / 2⁻⁵³): accuracy lost, bits";
    x.ticks = number_ticks(x.low, x.high);
    y.ticks = number_ticks(y.low, y.high);
    draw_axes(plot.svg, x, y);
    draw_line_through(plot.svg, x, y, {0, 53}, {1, 53}, "level");
    draw_line_through(plot.svg, x, y, {0, 0}, {1, 1}, "prediction");
    for (std::size_t i = kernels.size(); i-- > 0;) {
        std::vector<Pixel> worst, median;
        for (const Prediction::Bin& bin : kernels[i]->prediction.bins()) {
            worst.push_back({x.at(bin.bits + 0.5), y.at(error_bits(bin.worst))});
            median.push_back({x.at(bin.bits + 0.5), y.at(error_bits(bin.median))});
        }
        plot.svg.path(median, curve_style(i) + " median");
        plot.curve(i, worst, "worst");
    }
    for (std::size_t i = 0; i < kernels.size(); ++i)
        plot.entry(i, kernels[i]->kernel.name, "worst factor " + factor_text(kernels[i]->prediction.worst_factor()),
                   "worst");
    plot.entry("axis", "marks: worst case of a bin");
    plot.entry("axis median", "median case of a bin");
    plot.entry("prediction", "prediction: κ · 2⁻⁵³");
    if (y.high >= 53) plot.entry("level", "error of 1");
    plot.notes({fmt::format("Up to {} cases a kernel (seed {}, {} a family), the point in the cell or on its boundary.",
                            cases, report.seed, report.count),
                "Error: the largest |weight - exact weight| of a case. Factor: error / (κ · 2⁻⁵³) where κ < 2⁴⁷.",
                kernels.size() == all.size()
                    ? ""
                    : fmt::format("{} of {} kernels: selected evenly by worst factor, without variants.",
                                  kernels.size(), all.size())});
    return std::move(plot.svg).finish();
}

std::string drift_plot(const DriftReport& report) {
    const ExactEnvironment environment;
    Plot plot("Drift: error of an attribute over the size of the triangle");
    std::vector<DriftCurve> curves = report.curves;
    if (curves.size() > max_curves) curves.resize(max_curves);
    Axis &x = plot.x, &y = plot.y;
    x.low = 2;
    x.high = 12;
    y.low = no_error;
    y.high = 4;
    for (const DriftCurve& curve : curves) {
        for (const DriftPoint& p : curve.points) {
            x.low = std::min(x.low, std::log2(p.size));
            x.high = std::max(x.high, std::log2(p.size));
            y.high = std::max(y.high, std::ceil(log_error(p.worst_ulp)) + 1);
        }
    }
    // A step of eight bits of colour, where an ulp is 2^-52: shown where errors come near it.
    const double colour = 52 - std::log2(255);
    const bool colour_step = y.high > colour - 16;
    if (colour_step) y.high = std::max(y.high, std::ceil(colour) + 1);
    x.title = "size of the triangle, pixels across (logarithmic)";
    y.title = "largest error of the value, ulps (logarithmic)";
    for (const double t : round_ticks(x.low, x.high, 12)) x.ticks.push_back({t, fmt::format("{:.0f}", std::exp2(t))});
    for (const double t : round_ticks(y.low, y.high, 12)) {
        if (t != no_error) y.ticks.push_back({t, "2" + superscript(t)});
    }
    y.ticks.push_back({no_error, "0"});
    draw_axes(plot.svg, x, y);
    if (colour_step) draw_line_through(plot.svg, x, y, {0, colour}, {1, colour}, "level");
    for (std::size_t i = curves.size(); i-- > 0;) {
        std::vector<Pixel> line;
        for (const DriftPoint& p : curves[i].points) {
            if (p.cases != 0) line.push_back({x.at(std::log2(p.size)), y.at(log_error(p.worst_ulp))});
        }
        plot.curve(i, line);
    }
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const auto& points = curves[i].points;
        plot.entry(i, curves[i].kernel.name,
                   points.empty() || points.back().cases == 0
                       ? ""
                       : fmt::format("relative {:.2g} at {}", points.back().worst_relative, points.back().size));
    }
    if (colour_step) plot.entry("level", "a step of 1/255: 8-bit colour");
    plot.notes({fmt::format("Largest of {} cases a size (seed {}): attributes of 1 to 2 at the vertices, the point a "
                            "pixel centre in the triangle.",
                            report.count, report.seed),
                "Vertices lie on the grid of 1/256 pixel. An ulp of the value is 2⁻⁵², about 2.2e-16."});
    return std::move(plot.svg).finish();
}

}  // namespace barycert
