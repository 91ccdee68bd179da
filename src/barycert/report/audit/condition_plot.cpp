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

constexpr std::size_t max_kernels = 6;

struct Look {
    std::string_view colour;
    Mark mark;
};
// Okabe and Ito's colours, told apart by most eyes, and by their marks without colour.
constexpr std::array<Look, max_kernels> looks{{{"#d55e00", Mark::up},
                                               {"#0072b2", Mark::circle},
                                               {"#009e73", Mark::square},
                                               {"#cc79a7", Mark::diamond},
                                               {"#e69f00", Mark::down},
                                               {"#56b4e9", Mark::cross}}};

/// An error in bits above 2^-53. Below half of that it says nothing: exact weights are rounded that far themselves.
constexpr double min_bits = -1;
double error_bits(double units) {
    return std::max(std::log2(units), min_bits);
}

double max_error(const KernelResult& k) {
    double max = 0;
    for (const Prediction::Bin& bin : k.prediction.bins()) max = std::max(max, bin.worst);
    return max;
}

/// Those with something to show, largest worst factor first.
std::vector<const KernelResult*> candidates(const AuditReport& report, Simplex simplex) {
    std::vector<const KernelResult*> list;
    for (const KernelResult& k : report.kernels) {
        if (k.kernel.simplex == simplex && k.prediction.cases() > 0 && max_error(k) > 0.5) list.push_back(&k);
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
    if (list.size() > max_kernels && !std::all_of(list.begin(), list.end(), is_variant))
        std::erase_if(list, is_variant);
    if (list.size() <= max_kernels) return list;
    std::vector<const KernelResult*> some;
    for (std::size_t i = 0; i < max_kernels; ++i) some.push_back(list[i * (list.size() - 1) / (max_kernels - 1)]);
    return some;
}

std::uint64_t max_cases(const std::vector<const KernelResult*>& kernels) {
    std::uint64_t cases = 0;
    for (const KernelResult* k : kernels) cases = std::max(cases, k->prediction.cases());
    return cases;
}

std::string factor_text(double factor) {
    if (factor < 0) return "unknown";  // no case within first order
    if (factor < 1000) return fmt::format("{:.2f}", factor);
    constexpr std::array digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string out = "2";
    for (const char c : fmt::format("{:.0f}", std::log2(factor))) out += digits[static_cast<std::size_t>(c - '0')];
    return out;
}

/// Names without the simplex, which the title tells, and no longer than the legend.
std::string short_name(const std::string& name) {
    const std::size_t dot = name.find('.');
    const std::string rest = dot == std::string::npos ? name : name.substr(dot + 1);
    return rest.size() <= 25 ? rest : rest.substr(0, 24) + "…";
}

void draw_kernel(Svg& svg, const Axis& x, const Axis& y, const KernelResult& k, const Look& look) {
    std::vector<Svg::Point> worst, median;
    for (const Prediction::Bin& bin : k.prediction.bins()) {
        const double middle = x.at(bin.bits + 0.5);
        worst.emplace_back(middle, y.at(error_bits(bin.worst)));
        median.emplace_back(middle, y.at(error_bits(bin.median)));
    }
    svg.polyline(median, {.colour = look.colour, .width = 1.2, .dashes = "3 3"});
    svg.polyline(worst, {.colour = look.colour, .width = 1.2, .opacity = 0.6});
    for (const Svg::Point& p : worst) svg.mark(p, look.mark, 3.2, look.colour);
}

void draw_legend(Svg& svg, const std::vector<const KernelResult*>& kernels, double left, double top,
                 bool error_of_one) {
    const TextStyle small{.size = 12, .colour = "#555"};
    const auto sample = [&](double at, const Stroke& stroke) { svg.line({left, at}, {left + 28, at}, stroke); };
    double at = top;
    for (std::size_t i = 0; i < kernels.size(); ++i, at += 40) {
        sample(at, {.colour = looks[i].colour, .width = 1.2, .opacity = 0.6});
        svg.mark({left + 14, at}, looks[i].mark, 4, looks[i].colour);
        svg.text({left + 38, at + 4}, short_name(kernels[i]->kernel.name), {.size = 14});
        svg.text({left + 38, at + 20}, "worst factor " + factor_text(kernels[i]->prediction.worst_factor()), small);
    }
    at += 10;
    sample(at, {.colour = "#444", .width = 1.2});
    svg.text({left + 38, at + 4}, "marks: worst case of a bin", small);
    sample(at + 22, {.colour = "#444", .width = 1.2, .dashes = "3 3"});
    svg.text({left + 38, at + 26}, "median case of a bin", small);
    sample(at + 44, {.colour = "#000", .width = 2});
    svg.text({left + 38, at + 48}, "prediction: κ · 2⁻⁵³", small);
    if (!error_of_one) return;
    sample(at + 66, {.colour = "#888", .width = 1.2, .dashes = "8 4"});
    svg.text({left + 38, at + 70}, "error of 1", small);
}

}  // namespace

std::string condition_plot(const AuditReport& report) {
    const ExactEnvironment environment;
    Simplex simplex = Simplex::tetrahedron;
    std::vector<const KernelResult*> all = candidates(report, simplex);
    if (all.empty()) all = candidates(report, simplex = Simplex::triangle);
    const std::vector<const KernelResult*> kernels = chosen(all);
    const std::string what = simplex == Simplex::triangle ? "triangles" : "tetrahedra";
    const std::string title = "Error of the weights over the condition number of the cell: " + what;
    Svg svg(980, 620, title);
    svg.text({70, 34}, title, {.size = 18, .bold = true});
    if (kernels.empty()) {
        svg.text({70, 80}, "Nothing to show: no kernel on triangles or tetrahedra was off in a proper cell.");
        return std::move(svg).finish();
    }
    // Axes that fit what there is, and show four bits at least.
    double low = Prediction::last_bits, bits = 0, error = 3;
    for (const KernelResult* k : kernels) {
        for (const Prediction::Bin& bin : k->prediction.bins()) {
            low = std::min(low, static_cast<double>(bin.bits));
            bits = std::max(bits, bin.bits + 1.0);
            error = std::max(error, std::ceil(error_bits(bin.worst)) + 1);
        }
    }
    const Axis x{.low = low,
                 .high = std::max(bits, low + 4),
                 .from = 70,
                 .to = 710,
                 .title = "log2 κ: accuracy at risk from the cell's shape, bits"};
    const Axis y{
        .low = min_bits - 1, .high = error, .from = 500, .to = 60, .title = "log2 (error / 2⁻⁵³): accuracy lost, bits"};
    draw_frame(svg, x, y);
    draw_line_through(svg, x, y, {0, 53}, {1, 53}, {.colour = "#888", .width = 1.2, .dashes = "8 4"});
    draw_line_through(svg, x, y, {0, 0}, {1, 1}, {.colour = "#000", .width = 2});
    for (std::size_t i = kernels.size(); i-- > 0;) draw_kernel(svg, x, y, *kernels[i], looks[i]);
    draw_legend(svg, kernels, 730, 76, y.high >= 53);

    const TextStyle small{.size = 12, .colour = "#555"};
    svg.text({70, 568},
             fmt::format("Up to {} cases a kernel (seed {}, {} a family), the point in the cell or on its boundary.",
                         max_cases(kernels), report.seed, report.count),
             small);
    svg.text({70, 586},
             "Error: the largest |weight - exact weight| of a case. Factor: error / (κ · 2⁻⁵³) where κ < 2⁴⁷.", small);
    if (kernels.size() < all.size())
        svg.text({70, 604},
                 fmt::format("{} of {} kernels: selected evenly by worst factor, without variants.", kernels.size(),
                             all.size()),
                 small);
    return std::move(svg).finish();
}

}  // namespace barycert
