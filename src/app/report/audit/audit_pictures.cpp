// Accuracy against speed, sizes of errors, signs and maps of meshes, as markup of the audit's page.

#include "barycert/audit_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "app/report/audit/audit_words.hpp"
#include "app/report/common/terminal_text.hpp"
#include "barycert/audit.hpp"
#include "barycert/raster.hpp"
#include "barycert/simplex.hpp"
#include "barycert/statistics.hpp"
#include "core/base/decades.hpp"
#include "core/base/text.hpp"
#include "draw/axes.hpp"
#include "draw/colour_map.hpp"
#include "draw/picture.hpp"
#include "draw/png/png_file.hpp"

namespace barycert::report {
namespace {

double wrong_share(const KernelResult& k) {
    return static_cast<double>(k.total.wrong_cases) / static_cast<double>(k.total.cases);
}

/// Returns, by time, the kernels that no other beats in both: faster ones are wrong more often.
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
        const auto [fastest, slowest] = std::ranges::minmax(kernels, {}, &KernelResult::ns);
        double least = 1;
        for (const KernelResult* k : kernels)
            if (k->total.wrong_cases != 0) least = std::min(least, wrong_share(*k));
        x.low = std::log10(fastest->ns) - 0.35;
        x.high = std::log10(slowest->ns) + 0.25;
        x.ticks = log_ticks(x.low, x.high);
        const double floor = std::min(std::floor(std::log10(least)), -1.0);
        none = floor * 7 / 6;  // a sixth of the decades below
        y.low = floor * 4 / 3;
        y.high = 0;
        for (int e = static_cast<int>(floor); e <= 0; ++e)
            y.ticks.push_back({1.0 * e, brief(std::pow(10, e + 2)) + " %"});
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
        const bool best = std::ranges::find(front, k) != front.end();
        const Pixel p = axes.at(*k);
        svg.circle(p, best ? 5 : 4, best ? "dot front" : "dot",
                   fmt::format("{}: {} ns, {} % wrong", k->kernel.name, brief_time(k->ns),
                               percent(k->total.wrong_cases, k->total.cases)));
        if (best) labels.push_back({p, k->kernel.name.substr(k->kernel.name.find('.') + 1), "front"});
    }
    place_labels(svg, std::move(labels), axes.y.to);
    const std::string text = joined(front, "; ", [](const KernelResult* k) {
        return fmt::format("{} ({} ns, {} %)", k->kernel.name, brief_time(k->ns),
                           percent(k->total.wrong_cases, k->total.cases));
    });
    return fmt::format("<figure><h3>{}</h3>{}<figcaption>Front: {}.</figcaption></figure>\n", xml_escaped(kind),
                       svg_markup(svg), xml_escaped(text));
}

/// Bars on a logarithmic axis, for few cases with large errors are what matters.
std::string error_histogram(const KernelResult& k) {
    constexpr double histogram_width = 236, histogram_height = 92, histogram_floor = 74, histogram_top = 6;
    const ErrorSizes& e = k.total.errors;
    Picture svg(histogram_width, histogram_height, k.kernel.name + ": number of cases by the size of the error");
    const std::uint64_t most = *std::ranges::max_element(e.counts);
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
    return svg_markup(svg);
}

std::string swatch(const png::Colour& c, std::string_view text) {
    return fmt::format("<span><i style=\"background:#{:02x}{:02x}{:02x}\"></i>{}</span> ", c[0], c[1], c[2], text);
}

struct SignColour {
    png::Colour colour;
    std::string_view text;
};
/// Colours of the signs -1, 0, 1 and of no answer.
constexpr std::array<SignColour, 4> sign_colours{{{{0xe6, 0x9f, 0x00}, "negative"},
                                                  {{0xff, 0xff, 0xff}, "zero"},
                                                  {{0x00, 0x72, 0xb2}, "positive"},
                                                  {{0x20, 0x20, 0x20}, "no answer"}}};

/// PNG; y grows upwards.
std::string png_of(const SignPicture& p) {
    constexpr std::size_t side = SignPicture::side;
    std::vector<std::uint8_t> pixels(side * side);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = static_cast<std::uint8_t>(p.signs[(side - 1 - i / side) * side + i % side] + 1);
    std::array<png::Colour, sign_colours.size()> colours{};
    std::ranges::transform(sign_colours, colours.begin(), &SignColour::colour);
    return png::indexed_png(side, pixels, colours).value();
}

/// Pictures that are the same, in the order of the first.
struct SameSigns {
    const SignPicture* picture = nullptr;
    std::vector<std::string> kernels;  ///< without the exact picture's empty name
};

/// Groups pictures with the same signs, of the kind of case of `exact`.
std::vector<SameSigns> grouped_pictures(const std::vector<SignPicture>& pictures, const SignPicture& exact) {
    std::vector<SameSigns> groups;
    for (const SignPicture& p : pictures) {
        if (p.simplex != exact.simplex || p.perspective != exact.perspective) continue;
        auto same = std::ranges::find_if(groups, [&](const SameSigns& g) { return g.picture->signs == p.signs; });
        if (same == groups.end()) same = groups.insert(groups.end(), {&p, {}});
        if (!p.kernel.empty()) same->kernels.push_back(p.kernel);
    }
    return groups;
}

std::string figure_of_signs(const SameSigns& group) {
    const bool exact = group.picture->kernel.empty();
    const std::string names = xml_escaped(fmt::format("{}", fmt::join(group.kernels, ", ")));
    const auto all = static_cast<std::uint64_t>(SignPicture::side) * SignPicture::side;
    const std::string caption =
        exact ? "<b>exact</b>" + (names.empty() ? "" : "; the same: " + names)
              : fmt::format("{}<br/><b>{} %</b> wrong", names, percent(group.picture->wrong, all));
    return fmt::format(
        "<figure{}><img alt=\"Signs on the grid: {}, {} of {} points wrong\" src=\"{}\" width=\"256\" "
        "height=\"256\"/><figcaption>{}</figcaption></figure>\n",
        exact ? " class=\"exact\"" : "", exact ? "exact" : names, group.picture->wrong, all,
        data_uri("image/png", png_of(*group.picture)), caption);
}

/// Colours by the power of ten of an error, the darker the larger; and those without.
struct MapScale {
    static constexpr std::uint8_t beside = 0, right = 1, unanswered = 2, first = 3;

    explicit MapScale(const MeshMap& map) {
        for (const MeshMap::OfKernel& k : map.kernels) {
            for (const double e : k.errors) {
                if (!(e > 0) || std::isinf(e)) continue;
                low = std::min(low, decade(e));
                high = std::max(high, decade(e));
            }
        }
        const ColourMap viridis = *colour_map("viridis");
        for (int d = low; d <= high; ++d) {
            const int span = std::max(high - low, 1);
            const Rgba& c = viridis[static_cast<std::size_t>(255 - 255 * (d - low) / span)];
            colours.push_back({c[0], c[1], c[2]});
        }
    }

    std::uint8_t index_of(double error) const {
        if (error < 0) return beside;
        if (error == 0) return right;
        if (std::isinf(error)) return unanswered;
        return static_cast<std::uint8_t>(first + decade(error) - low);
    }

    /// A swatch for each colour of errors.
    std::string key() const {
        std::string out = swatch(colours[right], "no error");
        for (int d = low; d <= high; ++d)
            out += swatch(colours[static_cast<std::size_t>(first + d - low)], fmt::format("&lt; 1e{}", d + 1));
        return out + swatch(colours[unanswered], "no finite answer");
    }

    /// The power of ten at or below it: as many as fit the colours of a picture, from far below an ulp of 1 on.
    static int decade(double error) { return std::clamp(static_cast<int>(std::floor(std::log10(error))), -40, 60); }
    std::vector<png::Colour> colours{{0xc4, 0xcb, 0xd1}, {0xff, 0xff, 0xff}, {0xc8, 0x10, 0x2e}};
    int low = std::numeric_limits<int>::max(), high = std::numeric_limits<int>::min();
};

std::string map_figure(const MeshMap& map, const MeshMap::OfKernel& k, const MapScale& scale) {
    std::vector<std::uint8_t> pixels;
    for (const std::int32_t p : map.pixels)
        pixels.push_back(p < 0 ? MapScale::beside : scale.index_of(k.errors[static_cast<std::size_t>(p)]));
    const std::string png = png::indexed_png(map.width, pixels, scale.colours).value();
    const auto worst = static_cast<std::size_t>(std::ranges::max_element(k.errors) - k.errors.begin());
    const double largest = k.errors[worst];
    const std::string name = xml_escaped(base::printable(k.kernel));
    const std::string error =
        largest < 0           ? "given up"
        : largest == 0        ? "no error"
        : std::isinf(largest) ? fmt::format("no finite answer in cell {}", map.cells[worst])
                              : fmt::format("largest error <b>{}</b>, in cell {}", brief(largest), map.cells[worst]);
    return fmt::format(
        "<figure><img alt=\"Largest error of {} in each cell\" src=\"{}\" width=\"{}\" height=\"{}\"/>"
        "<figcaption>{}<br/>{}; {} % of the points wrong</figcaption></figure>\n",
        name, data_uri("image/png", png), map.width, map.height, name, error, percent(k.wrong, k.cases));
}

std::string what_is_seen(const MeshMap& map) {
    const auto axis_name = [](int axis) { return "xyz"[static_cast<std::size_t>(axis)]; };
    const auto range = [&](int axis, std::size_t side) {
        return fmt::format("{} from {:.6g} to {:.6g}", axis_name(axis), map.low[side], map.high[side]);
    };
    const std::string across = range(map.axis == 0 ? 1 : 0, 0), up = range(map.axis < 0 || map.axis == 2 ? 1 : 2, 1);
    const std::string section =
        map.axis < 0 ? "the mesh" : fmt::format("section at {} = {:.6g}", axis_name(map.axis), map.at);
    return fmt::format("{}, {} to the right, {} upwards; {} cells are seen", section, across, up, map.cells.size());
}

}  // namespace

std::string sign_figures(const std::vector<SignPicture>& pictures) {
    if (pictures.empty()) return "";
    std::string out =
        "<h2>Pictures of signs</h2>\n<p class=\"small\">What a kernel says of 256 × 256 neighbouring points beside a "
        "side on the diagonal: the sign of one weight, at points 2⁻⁵³ apart around (1/2, 1/2), the side from 12 to 24 "
        "(after Kettner, Mehlhorn, Pion, Schirra and Yap, 2008).</p>\n<p class=\"small key\">";
    for (const auto& [colour, text] : sign_colours) out += swatch(colour, text);
    out += "</p>\n";
    for (const SignPicture& exact : pictures) {
        if (!exact.kernel.empty()) continue;
        out += fmt::format("<h3>{}{}</h3>\n<div class=\"signs\">\n", name(exact.simplex),
                           exact.perspective ? ", perspective" : "");
        out += joined(grouped_pictures(pictures, exact), "", figure_of_signs) + "</div>\n";
    }
    return out;
}

std::string map_figures(const AuditReport& r, const std::vector<MeshMap>& maps) {
    if (maps.empty()) return "";
    std::string out = fmt::format(
        "<h2>Maps of the {}</h2>\n<p class=\"small\">Cells by the largest error of a weight in them, at a point "
        "inside, at points computed on the facets, and at points an ulp beside these; relative to 1 or to the largest "
        "weight. Grey: beside the mesh.{}</p>\n",
        maps.size() == 1 ? "mesh" : "meshes",
        maps.size() < r.meshes.size()
            ? fmt::format(" Of {} of {} meshes: name others to see them.", maps.size(), r.meshes.size())
            : "");
    for (const MeshMap& map : maps) {
        out += fmt::format("<h3>{}</h3>\n", xml_escaped(base::printable(map.mesh)));
        if (!map.why_not.empty()) {
            out += fmt::format("<p>No map: {}</p>\n", xml_escaped(map.why_not));
            continue;
        }
        const MapScale scale(map);
        out += fmt::format(
            "<p class=\"small\">{}.{}</p>\n<p class=\"small key\">{}</p>\n<div class=\"maps\">\n", what_is_seen(map),
            map.left_out == 0 ? ""
                              : fmt::format(" {} of {} kernels, worst first, without variants; others: --kernel NAME.",
                                            map.kernels.size(), map.kernels.size() + map.left_out),
            scale.key());
        out += joined(map.kernels, "", [&](const auto& k) { return map_figure(map, k, scale); }) + "</div>\n";
    }
    return out;
}

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
                           xml_escaped(k.kernel.name), xml_escaped(usual_error(k.total)),
                           brief(k.total.errors.worst.value), error_histogram(k));
    }
    return out + "</div>\n";
}

}  // namespace barycert::report
