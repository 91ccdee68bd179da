// Accuracy against speed, on the audit's HTML page.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "barycert/report/audit/audit_html_parts.hpp"
#include "barycert/report/audit/audit_words.hpp"
#include "barycert/report/common/html_text.hpp"
#include "barycert/report/common/picture.hpp"
#include "barycert/report/common/svg.hpp"
#include "barycert/report/common/terminal_text.hpp"

namespace barycert::report {
namespace {

constexpr double pareto_width = 500, pareto_height = 320, pareto_left = 62, pareto_right = 486, pareto_top = 16,
                 pareto_bottom = 268;

double wrong_share(const KernelResult& k) {
    return static_cast<double>(k.total.wrong_cases) / static_cast<double>(k.total.cases);
}

/// Those that no kernel beats in both: faster ones are wrong more often. By time.
std::vector<const KernelResult*> front_of(std::vector<const KernelResult*> kernels) {
    std::stable_sort(kernels.begin(), kernels.end(), [](const KernelResult* a, const KernelResult* b) {
        return a->ns != b->ns ? a->ns < b->ns : wrong_share(*a) < wrong_share(*b);
    });
    std::vector<const KernelResult*> front;
    for (const KernelResult* k : kernels) {
        if (front.empty() || wrong_share(*k) < wrong_share(*front.back())) front.push_back(k);
    }
    return front;
}

/// Both axes logarithmic; kernels that are never wrong lie on a line of their own below.
class ParetoPlane {
public:
    explicit ParetoPlane(const std::vector<const KernelResult*>& kernels) {
        double fast = kernels.front()->ns, slow = fast, least = 1;
        for (const KernelResult* k : kernels) {
            fast = std::min(fast, k->ns);
            slow = std::max(slow, k->ns);
            if (k->total.wrong_cases != 0) least = std::min(least, wrong_share(*k));
        }
        low_ = std::log10(fast) - 0.35;
        high_ = std::log10(slow) + 0.25;
        floor_ = std::min(std::floor(std::log10(least)), -1.0);
    }

    Pixel at(double ns, double share) const { return {x(ns), y(share)}; }
    double x(double ns) const {
        return pareto_left + (pareto_right - pareto_left) * (std::log10(ns) - low_) / (high_ - low_);
    }
    double y(double share) const {
        const double none = pareto_bottom - 24, lowest = pareto_bottom - 56;
        return share <= 0 ? none : lowest - (lowest - pareto_top) * (std::log10(share) - floor_) / -floor_;
    }

    void draw_axes(Picture& svg) const {
        const auto across = [&](double share, const std::string& text) {
            svg.line({pareto_left, y(share)}, {pareto_right, y(share)}, "grid");
            svg.text({pareto_left - 7, y(share) + 4}, text, "tick e");
        };
        for (int e = static_cast<int>(floor_); e <= 0; ++e) across(std::pow(10, e), brief(std::pow(10, e + 2)) + " %");
        across(0, "none");
        for (int decade = static_cast<int>(std::floor(low_)); decade <= high_; ++decade) {
            for (const double digit : {1.0, 2.0, 5.0}) {
                const double ns = digit * std::pow(10, decade);
                if (std::log10(ns) < low_ || std::log10(ns) > high_) continue;
                svg.line({x(ns), pareto_bottom}, {x(ns), pareto_bottom + 5}, "axis");
                svg.text({x(ns), pareto_bottom + 19}, brief(ns), "tick m");
            }
        }
        svg.line({pareto_left, pareto_bottom}, {pareto_right, pareto_bottom}, "axis");
        svg.line({pareto_left, pareto_bottom}, {pareto_left, pareto_top}, "axis");
        svg.text({(pareto_left + pareto_right) / 2, pareto_bottom + 42}, "ns an evaluation", "title m");
        svg.text({14, (pareto_top + pareto_bottom) / 2}, "wrong cases", "title m", true);
    }

private:
    double low_ = 0, high_ = 1;  // log10 of times
    double floor_ = -1;          // log10 of shares
};

std::string without_simplex(const std::string& name) {
    const std::size_t dot = name.find('.');
    return dot == std::string::npos ? name : name.substr(dot + 1);
}

std::string figure_of(const std::string& kind, const std::vector<const KernelResult*>& kernels) {
    const ParetoPlane plane(kernels);
    const std::vector<const KernelResult*> front = front_of(kernels);
    Picture svg(pareto_width, pareto_height, "Wrong cases over time of the kernels for " + kind);
    plane.draw_axes(svg);
    std::vector<std::pair<Pixel, Pixel>> steps;
    for (std::size_t i = 0; i < front.size(); ++i) {
        const Pixel p = plane.at(front[i]->ns, wrong_share(*front[i]));
        const double until = i + 1 < front.size() ? plane.x(front[i + 1]->ns) : pareto_right;
        steps.emplace_back(p, Pixel{until, p.y});
        if (i + 1 < front.size())
            steps.emplace_back(Pixel{until, p.y}, Pixel{until, plane.y(wrong_share(*front[i + 1]))});
    }
    svg.lines(steps, "front");
    std::vector<Label> labels;
    for (const KernelResult* k : kernels) {
        const bool best = std::find(front.begin(), front.end(), k) != front.end();
        const Pixel p = plane.at(k->ns, wrong_share(*k));
        svg.dot(p, best ? 5 : 4, best ? "dot front" : "dot",
                fmt::format("{}: {} ns, {} % wrong", k->kernel.name, brief_time(k->ns),
                            percent(k->total.wrong_cases, k->total.cases)));
        if (best) labels.push_back({p, without_simplex(k->kernel.name), "front"});
    }
    place_labels(svg, std::move(labels), pareto_top);
    std::string text;
    for (const KernelResult* k : front)
        text += fmt::format("{}{} ({} ns, {} %)", text.empty() ? "" : "; ", k->kernel.name, brief_time(k->ns),
                            percent(k->total.wrong_cases, k->total.cases));
    return fmt::format("<figure><h3>{}</h3>{}<figcaption>Front: {}.</figcaption></figure>\n", html_escaped(kind),
                       std::move(svg).finish(), html_escaped(text));
}

}  // namespace

std::string kind_of(Simplex simplex, bool perspective) {
    return std::string(name(simplex)) + (perspective ? ", perspective" : "");
}

std::string pareto_html(const AuditReport& r) {
    std::string figures;
    for (const Simplex s : all_simplices) {
        for (const bool perspective : {false, true}) {
            std::vector<const KernelResult*> kernels;
            for (const KernelResult& k : r.kernels) {
                if (k.kernel.simplex == s && k.kernel.perspective == perspective && k.ns > 0) kernels.push_back(&k);
            }
            if (kernels.size() > 1) figures += figure_of(kind_of(s, perspective), kernels);
        }
    }
    if (figures.empty()) return "";
    return "<h2>Accuracy against speed</h2>\n<p class=\"small\">A dot is a kernel; both axes are logarithmic. The "
           "line is the front: kernels that no other beats in time and in wrong cases at once.</p>\n"
           "<div class=\"figures\">\n" +
           figures + "</div>\n";
}

}  // namespace barycert::report
