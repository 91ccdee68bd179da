// Pictures that are files of their own: errors over condition numbers, and over sizes of triangles.

#include "barycert/audit/asking.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/report/common/picture.hpp"

namespace barycert {

using namespace report;

namespace {

/// Of a picture that is a file of its own. Up to six curves with marks, in colours that most eyes tell apart (Okabe's
/// and Ito's), classes k0 to k5, and in marks that differ without colour.
constexpr std::string_view plot_style = R"(
svg{font-family:Helvetica,Arial,"DejaVu Sans",sans-serif}
text{font-size:13px;fill:#222}.m{text-anchor:middle}.e{text-anchor:end}
.head{font-size:18px;font-weight:bold}.title{font-size:14px}.small{font-size:12px;fill:#555}
path{fill:none;stroke-width:1.2px;stroke-linejoin:round}path.mark{stroke:none}
.grid{stroke:#e4e4e4}.axis{stroke:#444}.median{stroke-dasharray:3 3}.worst{stroke-opacity:.6}
.prediction{stroke:#000;stroke-width:2px}.level{stroke:#888;stroke-dasharray:8 4}
path.k0{stroke:#d55e00}path.k1{stroke:#0072b2}path.k2{stroke:#009e73}
path.k3{stroke:#cc79a7}path.k4{stroke:#e69f00}path.k5{stroke:#56b4e9}
.k0.mark{fill:#d55e00}.k1.mark{fill:#0072b2}.k2.mark{fill:#009e73}
.k3.mark{fill:#cc79a7}.k4.mark{fill:#e69f00}.k5.mark{fill:#56b4e9}
)";

constexpr std::array marks{Mark::up, Mark::circle, Mark::square, Mark::diamond, Mark::down, Mark::cross};
constexpr std::size_t max_curves = marks.size();

/// Numbers, not pixels. Names are shown without the simplex, which the title tells, and not too long.
struct Curve {
    std::string name, below;
    std::vector<Pixel> line = {}, median = {};
};

/// The whole of such a picture: a title above, axes, a legend to the right, notes below.
struct Plot {
    Axis x{.from = 76, .to = 700}, y{.from = 500, .to = 60};
    Picture svg;
    double legend = 76;  ///< where its next entry stands

    explicit Plot(const std::string& title) : svg(980, 620, title, plot_style) { svg.text({70, 34}, title, "head"); }
    /// The first on top; with a legend.
    void curves(const std::vector<Curve>& all, std::string_view style = {}) {
        const auto on_picture = [&](std::vector<Pixel> points) {
            for (Pixel& p : points) p = {x.at(p.x), y.at(p.y)};
            return points;
        };
        for (std::size_t i = all.size(); i-- > 0;) {
            svg.path(on_picture(all[i].median), fmt::format("k{} median", i));
            svg.path(on_picture(all[i].line), fmt::format("k{} {}", i, style));
            for (const Pixel& p : on_picture(all[i].line)) svg.mark(p, marks[i], 3.4, fmt::format("k{}", i));
        }
        for (std::size_t i = 0; i < all.size(); ++i) {
            svg.line({720, legend}, {748, legend}, fmt::format("k{} {}", i, style));
            svg.mark({734, legend}, marks[i], 4, fmt::format("k{}", i));
            const std::string rest = all[i].name.substr(all[i].name.find('.') + 1);
            svg.text({758, legend + 4}, rest.size() <= 27 ? rest : rest.substr(0, 26) + "…", "title");
            svg.text({758, legend + 20}, all[i].below, "small");
            legend += 40;
        }
    }
    void entry(std::string_view style, std::string_view what) {
        svg.line({720, legend + 10}, {748, legend + 10}, style);
        svg.text({758, legend + 14}, what, "small");
        legend += 22;
    }
    void notes(const std::vector<std::string>& lines) {
        for (std::size_t i = 0; i < lines.size(); ++i)
            svg.text({70, 568 + 18 * static_cast<double>(i)}, lines[i], "small");
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
    std::vector<Curve> curves;
    for (const KernelResult* k : kernels) {
        cases = std::max(cases, k->prediction.cases());
        Curve& curve =
            curves.emplace_back(Curve{k->kernel.name, "worst factor " + factor_text(k->prediction.worst_factor())});
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
        for (const double t : round_ticks(axis->low, axis->high, 12)) axis->ticks.push_back({t, base::shortest(t)});
    draw_axes(plot.svg, x, y);
    draw_line_through(plot.svg, x, y, {0, 53}, {1, 53}, "level");
    draw_line_through(plot.svg, x, y, {0, 0}, {1, 1}, "prediction");
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
    return std::move(plot.svg).finish();
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
    for (const DriftCurve& of : report.curves) {
        if (curves.size() == max_curves) break;
        Curve& curve = curves.emplace_back(Curve{of.kernel.name, ""});
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
    for (const double t : round_ticks(x.low, x.high, 12)) x.ticks.push_back({t, fmt::format("{:.0f}", std::exp2(t))});
    for (const double t : round_ticks(y.low, y.high, 12)) {
        if (t != no_error) y.ticks.push_back({t, "2" + superscript(t)});
    }
    y.ticks.push_back({no_error, "0"});
    draw_axes(plot.svg, x, y);
    if (colour_step) draw_line_through(plot.svg, x, y, {0, colour}, {1, colour}, "level");
    plot.curves(curves);
    if (colour_step) plot.entry("level", "a step of 1/255: 8-bit colour");
    plot.notes({fmt::format("Largest of {} cases a size (seed {}): attributes of 1 to 2 at the vertices, the point a "
                            "pixel centre in the triangle.",
                            report.count, report.seed),
                "Vertices lie on the grid of 1/256 pixel. An ulp of the value is 2⁻⁵², about 2.2e-16."});
    return std::move(plot.svg).finish();
}

}  // namespace barycert
