// Accuracy against speed, and sizes of errors, as markup of the audit's page.

#include <algorithm>
#include <cmath>

#include "barycert/base/decades.hpp"
#include "barycert/report/audit/audit_words.hpp"
#include "barycert/report/common/picture.hpp"

namespace barycert::report {
namespace {

double wrong_share(const KernelResult& k) {
    return static_cast<double>(k.total.wrong_cases) / static_cast<double>(k.total.cases);
}

/// Those that no kernel beats in both: faster ones are wrong more often. By time.
std::vector<const KernelResult*> front_of(std::vector<const KernelResult*> kernels) {
    std::ranges::stable_sort(kernels, {}, [](const auto* k) { return std::pair(k->ns, wrong_share(*k)); });
    std::vector<const KernelResult*> front;
    for (const KernelResult* k : kernels) {
        if (front.empty() || wrong_share(*k) < wrong_share(*front.back())) front.push_back(k);
    }
    return front;
}

/// Times, in log10; and shares of wrong cases, likewise, with a line of its own below for kernels that are never wrong.
struct ParetoAxes {
    Axis x{.from = 62, .to = 486, .title = "ns an evaluation", .grid = false};
    Axis y{.from = 268, .to = 16, .title = "wrong cases"};

    explicit ParetoAxes(const std::vector<const KernelResult*>& kernels) {
        double fast = kernels.front()->ns, slow = fast, least = 1;
        for (const KernelResult* k : kernels) {
            fast = std::min(fast, k->ns);
            slow = std::max(slow, k->ns);
            if (k->total.wrong_cases != 0) least = std::min(least, wrong_share(*k));
        }
        x.low = std::log10(fast) - 0.35;
        x.high = std::log10(slow) + 0.25;
        x.ticks = decade_ticks(x.low, x.high);
        const double floor = std::min(std::floor(std::log10(least)), -1.0);
        none = floor * 7 / 6;  // a sixth of the decades below
        y.low = floor * 4 / 3;
        y.high = 0;
        for (double e = floor; e <= 0; ++e) y.ticks.push_back({e, brief(std::pow(10, e + 2)) + " %"});
        y.ticks.push_back({none, "none"});
    }

    Pixel at(const KernelResult& k) const {
        return {x.at(std::log10(k.ns)), y.at(k.total.wrong_cases == 0 ? none : std::log10(wrong_share(k)))};
    }

    double none = 0;
};

std::string figure_of(const std::string& kind, const std::vector<const KernelResult*>& kernels) {
    const ParetoAxes axes(kernels);
    const std::vector<const KernelResult*> front = front_of(kernels);
    Picture svg(500, 320, "Wrong cases over time of the kernels for " + kind);
    draw_axes(svg, axes.x, axes.y);
    std::vector<std::pair<Pixel, Pixel>> steps;
    for (std::size_t i = 0; i < front.size(); ++i) {
        const Pixel p = axes.at(*front[i]),
                    next = i + 1 < front.size() ? axes.at(*front[i + 1]) : Pixel{axes.x.to, p.y};
        steps.emplace_back(p, Pixel{next.x, p.y});
        steps.emplace_back(Pixel{next.x, p.y}, next);
    }
    svg.lines(steps, "front");
    std::vector<Label> labels;
    for (const KernelResult* k : kernels) {
        const bool best = std::find(front.begin(), front.end(), k) != front.end();
        const Pixel p = axes.at(*k);
        svg.dot(p, best ? 5 : 4, best ? "dot front" : "dot",
                fmt::format("{}: {} ns, {} % wrong", k->kernel.name, brief_time(k->ns),
                            percent(k->total.wrong_cases, k->total.cases)));
        if (best) labels.push_back({p, k->kernel.name.substr(k->kernel.name.find('.') + 1), "front"});
    }
    place_labels(svg, std::move(labels), axes.y.to);
    const std::string text = joined(front, "; ", [](const KernelResult* k) {
        return fmt::format("{} ({} ns, {} %)", k->kernel.name, brief_time(k->ns),
                           percent(k->total.wrong_cases, k->total.cases));
    });
    return fmt::format("<figure><h3>{}</h3>{}<figcaption>Front: {}.</figcaption></figure>\n", html_escaped(kind),
                       std::move(svg).finish(), html_escaped(text));
}

/// Bars on a logarithmic axis, for few cases with large errors are what matters.
std::string error_histogram(const KernelResult& k) {
    constexpr double histogram_width = 236, histogram_height = 92, histogram_floor = 74, histogram_top = 6;
    const ErrorSizes& e = k.total.errors;
    Picture svg(histogram_width, histogram_height, k.kernel.name + ": number of cases by the size of the error");
    const std::uint64_t most = *std::max_element(e.counts.begin(), e.counts.end());
    const double wide = histogram_width / static_cast<double>(ErrorSizes::bins);
    const double scale = (histogram_floor - histogram_top) / std::log10(2.0 * static_cast<double>(most) + 2);
    for (std::size_t b = 0; b < ErrorSizes::bins; ++b) {
        if (e.counts[b] == 0) continue;
        const double tall = std::max(scale * std::log10(2.0 * static_cast<double>(e.counts[b])), 1.0);
        svg.bar({wide * static_cast<double>(b) + 0.5, histogram_floor - tall}, wide - 1, tall,
                b >= 19 ? "bar bad" : "bar",
                fmt::format("{}: {} cases",
                            b == 0                      ? "no error"
                            : b == ErrorSizes::bins - 1 ? "no finite answer"
                                                        : base::decade_label(b),
                            e.counts[b]));
    }
    svg.line({0, histogram_floor}, {histogram_width, histogram_floor}, "axis");
    for (const auto& [bin, text, style] :
         {std::tuple(0.0, "0", "tick"), {3, "1e-16", "tick m"}, {11, "1e-8", "tick m"}, {19, "1", "tick m"}})
        svg.text({wide * bin, histogram_height - 4}, text, style);
    svg.text({histogram_width, histogram_height - 4}, "none", "tick e");
    return std::move(svg).finish();
}

}  // namespace

std::string pareto_figures(const AuditReport& r) {
    std::string figures;
    for (const Simplex s : all_simplices) {
        for (const bool perspective : {false, true}) {
            std::vector<const KernelResult*> kernels;
            for (const KernelResult& k : r.kernels) {
                if (k.kernel.simplex == s && k.kernel.perspective == perspective && k.ns > 0) kernels.push_back(&k);
            }
            if (kernels.size() > 1)
                figures += figure_of(std::string(name(s)) + (perspective ? ", perspective" : ""), kernels);
        }
    }
    if (figures.empty()) return "";
    return "<h2>Accuracy against speed</h2>\n<p class=\"small\">A dot is a kernel; both axes are logarithmic. The "
           "line is the front: kernels that no other beats in time and in wrong cases at once.</p>\n"
           "<div class=\"figures\">\n" +
           figures + "</div>\n";
}

std::string error_histograms(const AuditReport& r) {
    std::string out =
        "<h2>Sizes of errors</h2>\n<p class=\"small\">Cases by the largest error of a weight, in powers of ten from no "
        "error (left) to 100 and more, and without a finite answer (right); heights are logarithmic. Red: errors of 1 "
        "and more, and no answer. Simplices that are degenerate are not counted.</p>\n<div class=\"small-figures\">\n";
    for (const KernelResult& k : r.kernels) {
        if (k.total.errors.total() == 0) continue;
        out += fmt::format("<figure><figcaption>{}<br/><small>99 %: {}, largest {}</small></figcaption>{}</figure>\n",
                           html_escaped(k.kernel.name), html_escaped(usual_error(k.total)),
                           brief(k.total.errors.worst.value), error_histogram(k));
    }
    return out + "</div>\n";
}

}  // namespace barycert::report
