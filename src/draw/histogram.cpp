#include "draw/histogram.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/result.hpp"
#include "core/base/text.hpp"
#include "draw/axes.hpp"
#include "draw/files.hpp"
#include "draw/picture.hpp"

namespace barycert::draw {
namespace {

/// Counts as parts of the largest.
struct CountAxis : Axis {
    double max = 1;
    bool logarithmic = false;

    CountAxis(const std::vector<std::uint64_t>& counts, const std::string& counted) {
        from = 214;
        to = 40;
        title = counted + "s";
        double min = std::numeric_limits<double>::infinity();
        for (const std::uint64_t c : counts) {
            max = std::max(max, static_cast<double>(c));
            if (c > 0) min = std::min(min, static_cast<double>(c));
        }
        logarithmic = min < std::floor(max / 100);
        if (logarithmic) title += ", logarithmic";
        std::vector<double> at = logarithmic ? std::vector<double>{} : round_numbers(0, max, 6);
        for (double t = 1; logarithmic && t <= max; t *= 10) at.push_back(t);
        for (const double t : at)
            if (t > 0 && t == std::floor(t))
                ticks.push_back({height(t), base::brief_count(static_cast<std::uint64_t>(t))});
    }
    double height(double count) const {
        return count <= 0 ? 0 : logarithmic ? std::log(2 * count) / std::log(2 * max) : count / max;
    }
};

}  // namespace

Picture histogram(const Histogram& of) {
    Picture picture(520, 262, of.title);
    const CountAxis y(of.counts, of.counted);
    Axis x = of.x;
    x.from = 58, x.to = 498, x.grid = false;
    draw_axes(picture, x, y);
    const double wide = (x.to - x.from) / static_cast<double>(of.counts.size());
    for (std::size_t i = 0; i < of.counts.size(); ++i) {
        const std::uint64_t count = of.counts[i];
        if (count == 0) continue;
        const double tall = std::max(y.from - y.at(y.height(static_cast<double>(count))), 1.0);
        const double at = x.from + wide * static_cast<double>(i);
        picture.bar({at + 0.5, y.from - tall}, wide - 1, tall, of.bad && of.bad(i) ? "bar bad" : "bar",
                    fmt::format("{}: {} {}{}", of.range(i), base::grouped(count), of.counted, count == 1 ? "" : "s"));
        picture.text({at + wide / 2 + 3, y.from - tall - 3}, base::brief_count(count), "count", true);
    }
    return picture;
}

Result<std::string> rows_text(std::string_view path, const std::vector<Picture>& all, const std::string& title) {
    if (all.empty())
        return Error{.code = "picture.empty",
                     .what = "there is nothing to plot",
                     .found = "no value",
                     .remedy = "leave the plot out"};
    constexpr double head = 48, left = 12;
    double wide = 0, tall = 0;
    for (const Picture& p : all) wide = std::max(wide, p.width), tall = std::max(tall, p.height);
    const std::size_t rows = (all.size() + 1) / 2, columns = std::min<std::size_t>(all.size(), 2);
    Picture out(left + static_cast<double>(columns) * wide, head + static_cast<double>(rows) * tall, title);
    out.text({out.width / 2, 30}, title, "head m");
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::size_t column = i % 2, row = i / 2;
        out.add(all[i], {left + wide * static_cast<double>(column), head + tall * static_cast<double>(row)});
    }
    return file_text(path, out);
}

}  // namespace barycert::draw
