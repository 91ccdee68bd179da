// Pictures that are files of their own: errors over condition numbers, and over sizes of triangles.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "audit/asking.hpp"
#include "barycert/audit.hpp"
#include "barycert/audit_pictures.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/environment.hpp"
#include "barycert/kernels.hpp"
#include "barycert/simplex.hpp"
#include "barycert/statistics.hpp"
#include "core/base/text.hpp"
#include "draw/axes.hpp"
#include "draw/picture.hpp"

namespace barycert {

using namespace draw;

namespace {

/// Without the simplex, which the title tells, and not too long.
std::string short_name(const Kernel& kernel) {
    const std::string rest = kernel.name.substr(kernel.name.find('.') + 1);
    return rest.size() <= 27 ? rest : rest.substr(0, 26) + "…";
}

/// An error in bits above 2^-53. Below half of that it says nothing: exact weights are rounded that far themselves.
constexpr double min_bits = -1;
double error_bits(double units) {
    return std::max(std::log2(units), min_bits);
}

/// Returns the kernels with something to show, largest worst factor first.
std::vector<const KernelResult*> candidates(const AuditReport& report, Simplex simplex) {
    std::vector<const KernelResult*> list;
    for (const KernelResult& k : report.kernels) {
        const bool off = std::ranges::any_of(k.prediction.bins(), [](const auto& bin) { return bin.worst > 0.5; });
        if (k.kernel.simplex == simplex && off) list.push_back(&k);
    }
    std::ranges::stable_sort(list, std::greater<>(), [](const auto* k) { return k->prediction.worst_factor(); });
    return list;
}

std::vector<const KernelResult*> chosen(std::vector<const KernelResult*> list) {
    const auto variant = [](const KernelResult* k) { return audit::is_variant(k->kernel); };
    if (list.size() > max_curves && !std::ranges::all_of(list, variant)) std::erase_if(list, variant);
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
        plot.picture.text({70, 80}, "Nothing to show: no kernel on triangles or tetrahedra was off in a proper cell.",
                          "");
        return svg_text(plot.picture);
    }
    // Axes that fit what there is, and show four bits at least.
    Axis &x = plot.x, &y = plot.y;
    double bits = 0;
    std::uint64_t cases = 0;
    x.low = Prediction::last_bits;
    y.low = min_bits - 1;
    y.high = 3;
    std::vector<Curve> curves;
    for (const KernelResult* k : kernels) {
        cases = std::max(cases, k->prediction.cases());
        Curve& curve = curves.emplace_back(
            Curve{short_name(k->kernel), "worst factor " + factor_text(k->prediction.worst_factor())});
        for (const Prediction::Bin& bin : k->prediction.bins()) {
            x.low = std::min(x.low, static_cast<double>(bin.bits));
            bits = std::max(bits, bin.bits + 1.0);
            y.high = std::max(y.high, std::ceil(error_bits(bin.worst)) + 1);
            curve.line.push_back({bin.bits + 0.5, error_bits(bin.worst)});
            curve.median.push_back({bin.bits + 0.5, error_bits(bin.median)});
        }
    }
    x.high = std::max(bits, x.low + 4);
    x.title = "log2 κ: accuracy at risk from the cell's shape, bits";
    y.title = "log2 (error / 2⁻⁵³): accuracy lost, bits";
    for (Axis* axis : {&x, &y})
        for (const double t : round_numbers(axis->low, axis->high, 12)) axis->ticks.push_back({t, base::shortest(t)});
    draw_axes(plot.picture, x, y);
    draw_line_through(plot.picture, x, y, {0, 53}, {1, 53}, "level");
    draw_line_through(plot.picture, x, y, {0, 0}, {1, 1}, "prediction");
    plot.curves(curves, "worst");
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
    return svg_text(plot.picture);
}

std::string drift_plot(const DriftReport& report) {
    const ExactEnvironment environment;
    Plot plot("Drift: error of an attribute over the size of the triangle");
    Axis &x = plot.x, &y = plot.y;
    x.low = 2;
    x.high = 12;
    y.low = no_error;
    y.high = 4;
    std::vector<Curve> curves;
    for (const DriftCurve& of : std::span(report.curves).first(std::min(report.curves.size(), max_curves))) {
        Curve& curve = curves.emplace_back(Curve{short_name(of.kernel)});
        for (const DriftPoint& p : of.points) {
            x.low = std::min(x.low, std::log2(p.size));
            x.high = std::max(x.high, std::log2(p.size));
            y.high = std::max(y.high, std::ceil(log_error(p.worst_ulp)) + 1);
            if (p.cases != 0) curve.line.push_back({std::log2(p.size), log_error(p.worst_ulp)});
        }
        if (!of.points.empty() && of.points.back().cases != 0)
            curve.below = fmt::format("relative {:.2g} at {}", of.points.back().worst_relative, of.points.back().size);
    }
    // A step of eight bits of colour, where an ulp is 2^-52: shown where errors come near it.
    const double colour = 52 - std::log2(255);
    const bool colour_step = y.high > colour - 16;
    if (colour_step) y.high = std::max(y.high, std::ceil(colour) + 1);
    x.title = "size of the triangle, pixels across (logarithmic)";
    y.title = "largest error of the value, ulps (logarithmic)";
    for (const double t : round_numbers(x.low, x.high, 12)) x.ticks.push_back({t, fmt::format("{:.0f}", std::exp2(t))});
    for (const double t : round_numbers(y.low, y.high, 12)) {
        if (t != no_error) y.ticks.push_back({t, "2" + superscript(t)});
    }
    y.ticks.push_back({no_error, "0"});
    draw_axes(plot.picture, x, y);
    if (colour_step) draw_line_through(plot.picture, x, y, {0, colour}, {1, colour}, "level");
    plot.curves(curves);
    if (colour_step) plot.entry("level", "a step of 1/255: 8-bit colour");
    plot.notes({fmt::format("Largest of {} cases a size (seed {}): attributes of 1 to 2 at the vertices, the point a "
                            "pixel centre in the triangle.",
                            report.count, report.seed),
                "Vertices lie on the grid of 1/256 pixel. An ulp of the value is 2⁻⁵², about 2.2e-16."});
    return svg_text(plot.picture);
}

}  // namespace barycert
