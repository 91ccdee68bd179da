#include "draw/axes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "core/base/text.hpp"
#include "draw/picture.hpp"

namespace barycert::draw {
namespace {

/// As text, so that it is the number that is written: powers of ten have rounding errors. 0 if no double is so large.
double times_power_of_ten(double digits, int exponent) {
    return base::parse_double(base::shortest(digits) + "e" + std::to_string(exponent)).value_or(0);
}

/// The power of ten of the first digit.
int exponent_of(double x) {
    return x == 0 ? 0 : static_cast<int>(std::floor(std::log10(std::fabs(x))));
}

/// Steps of a 1, 2 or 5 times a power of ten.
struct Steps {
    int digit = 1, exponent = 0;
    std::int64_t first = 0, last = -1;  ///< the round numbers: k steps

    Steps(double low, double high, int max) {
        const double span = high / 2 - low / 2;  // half of it: the whole may overflow
        if (!(span > 0) || !std::isfinite(span)) return;
        exponent = std::max(exponent_of(2 / static_cast<double>(max) * span), -323);
        for (int tries = 0; tries < 6; ++tries) {
            const double step = times_power_of_ten(digit, exponent);
            const double k = std::ceil(low / step), n = std::floor(high / step);
            if (step > 0 && std::fabs(k) < 0x1p52 && std::fabs(n) < 0x1p52 && n - k < max) {
                first = static_cast<std::int64_t>(k), last = static_cast<std::int64_t>(n);
                // Quotients are rounded.
                if (at(first - 1) >= low) --first;
                if (at(first) < low) ++first;
                if (at(last + 1) <= high) ++last;
                if (at(last) > high) --last;
                if (last - first < max) return;
            }
            digit = digit == 1 ? 2 : digit == 2 ? 5 : 1;
            exponent += digit == 1 ? 1 : 0;
        }
    }
    double at(std::int64_t k) const { return times_power_of_ten(static_cast<double>(k * digit), exponent) + 0.0; }
};

std::string with_minus(std::string text) {
    base::replace_all(text, "-", "−");
    return text;
}

}  // namespace

std::vector<double> round_numbers(double low, double high, int max) {
    const Steps steps(low, high, max);
    std::vector<double> numbers;
    for (std::int64_t k = steps.first; k <= steps.last; ++k) numbers.push_back(steps.at(k));
    return numbers;
}

std::string superscript(double exponent) {
    constexpr std::array digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string out;
    for (const char c : fmt::format("{:.0f}", exponent))
        out += c == '-' ? "⁻" : digits[static_cast<std::size_t>(c - '0')];
    return out;
}

std::string number_text(double x) {
    std::string text = fmt::format("{:.4g}", x);
    const std::size_t e = text.find('e');
    if (e == std::string::npos) return with_minus(text);
    const std::string mantissa = text.substr(0, e);
    return with_minus((mantissa == "1" ? "" : mantissa + "×") + "10") + superscript(std::atoi(text.c_str() + e + 1));
}

Ticks round_ticks(double low, double high, int max) {
    const Steps steps(low, high, max);
    Ticks out;
    if (steps.last < steps.first) return out;
    // Digits from the first of the largest to that of the step.
    constexpr int most = 4;
    const double largest = std::max(std::fabs(steps.at(steps.first)), std::fabs(steps.at(steps.last)));
    std::int64_t base = 0;
    int top = largest == 0 ? steps.exponent : exponent_of(largest);
    if (top - steps.exponent >= most) {
        base = steps.first;
        top = steps.last == base ? steps.exponent : exponent_of(steps.at(steps.last - base));
        out.common = with_minus((base > 0 ? "+" : "") + base::shortest(steps.at(base)));
    }
    const bool scaled = top < -3 || top > 4;
    const int unit = scaled ? top : 0, decimals = std::max(0, unit - steps.exponent);
    if (scaled) out.common = "×10" + superscript(unit) + (out.common.empty() ? "" : " " + out.common);
    for (std::int64_t k = steps.first; k <= steps.last; ++k) {
        const double own = times_power_of_ten(static_cast<double>((k - base) * steps.digit), steps.exponent - unit);
        out.ticks.push_back({steps.at(k), with_minus(fmt::format("{:.{}f}", own + 0.0, decimals))});
    }
    return out;
}

std::vector<Tick> log_ticks(double low, double high) {
    std::vector<Tick> ticks;
    const bool few = high - low <= 3;
    const int every = std::max(1, static_cast<int>((high - low) / 8));
    for (int k = static_cast<int>(std::floor(low)); k <= static_cast<int>(std::floor(high)); ++k) {
        for (const double factor : {1.0, 2.0, 5.0}) {
            const double t = k + std::log10(factor);
            if (t < low || t > high || (factor > 1 && !few) || k % every != 0) continue;
            const std::string power = "10" + superscript(k);
            ticks.push_back({t, few && std::abs(k) <= 3 ? number_text(times_power_of_ten(factor, k))
                                : factor > 1            ? fmt::format("{:g}×{}", factor, power)
                                                        : power});
        }
    }
    return ticks;
}

void draw_axes(Picture& picture, const Axis& x, const Axis& y) {
    for (const Tick& t : y.ticks) {
        if (y.grid) picture.line({x.from, y.at(t.at)}, {x.to, y.at(t.at)}, "grid");
        picture.text({x.from - 7, y.at(t.at) + 4}, t.text, "tick e");
    }
    for (const Tick& t : x.ticks) {
        if (x.grid) picture.line({x.at(t.at), y.from}, {x.at(t.at), y.to}, "grid");
        picture.line({x.at(t.at), y.from}, {x.at(t.at), y.from + 5}, "axis");
        picture.text({x.at(t.at), y.from + 19}, t.text, "tick m");
    }
    picture.line({x.from, y.from}, {x.to, y.from}, "axis");
    picture.line({x.from, y.from}, {x.from, y.to}, "axis");
    picture.text({(x.from + x.to) / 2, y.from + 42}, x.title, "title m");
    picture.text({x.from - 46, (y.from + y.to) / 2}, y.title, "title m", true);
    if (!x.common.empty()) picture.text({x.to, y.from + 36}, x.common, "tick e");
    if (!y.common.empty()) picture.text({x.from - 30, y.to - 8}, y.common, "tick");
}

void draw_line_through(Picture& picture, const Axis& x, const Axis& y, Pixel a, Pixel b, std::string style) {
    // Liang and Barsky: the line a + t (b - a), cut by each side in turn.
    const double dx = b.x - a.x, dy = b.y - a.y;
    double first = -1e9, last = 1e9;
    const auto cut = [&](double direction, double room) {  // keeps t * direction <= room
        if (direction > 0) last = std::min(last, room / direction);
        if (direction < 0) first = std::max(first, room / direction);
        if (direction == 0 && room < 0) last = -1e9;
    };
    cut(dx, x.high - a.x);
    cut(-dx, a.x - x.low);
    cut(dy, y.high - a.y);
    cut(-dy, a.y - y.low);
    if (first >= last) return;
    picture.line({x.at(a.x + first * dx), y.at(a.y + first * dy)}, {x.at(a.x + last * dx), y.at(a.y + last * dy)},
                 std::move(style));
}

void Plot::curves(const std::vector<Curve>& all, const std::string& style, bool marks) {
    constexpr std::array shapes{Mark::up, Mark::circle, Mark::square, Mark::diamond, Mark::down, Mark::cross};
    const auto draw_line = [&](const std::vector<Pixel>& points, const std::string& look) {
        std::vector<Pixel> run;
        for (const Pixel& p : points) {
            if (std::isfinite(p.y)) {
                run.push_back({x.at(p.x), y.at(p.y)});
            } else {
                picture.path(std::exchange(run, {}), look);
            }
        }
        picture.path(std::move(run), look);
    };
    for (std::size_t i = all.size(); i-- > 0;) {
        const std::string own = fmt::format("k{}", i % max_curves);
        draw_line(all[i].median, own + " median");
        draw_line(all[i].line, fmt::format("{} {}", own, style));
        for (const Pixel& p : all[i].line) {
            if (marks && std::isfinite(p.y)) picture.mark({x.at(p.x), y.at(p.y)}, shapes[i % max_curves], 3.4, own);
        }
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::string own = fmt::format("k{}", i % max_curves);
        picture.line({x.to + 20, legend}, {x.to + 48, legend}, fmt::format("{} {}", own, style));
        if (marks) picture.mark({x.to + 34, legend}, shapes[i % max_curves], 4, own);
        picture.text({x.to + 58, legend + 4}, all[i].name, "title");
        if (!all[i].below.empty()) picture.text({x.to + 58, legend + 20}, all[i].below, "small");
        legend += all[i].below.empty() ? 24 : 40;
    }
}

void Plot::entry(std::string style, std::string what) {
    picture.line({x.to + 20, legend + 10}, {x.to + 48, legend + 10}, std::move(style));
    picture.text({x.to + 58, legend + 14}, std::move(what), "small");
    legend += 22;
}

void Plot::notes(const std::vector<std::string>& lines) {
    for (std::size_t i = 0; i < lines.size(); ++i)
        picture.text({70, y.from + 68 + 18 * static_cast<double>(i)}, lines[i], "small");
}

}  // namespace barycert::draw
