#include "barycert/io.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "barycert/base/strict_math.hpp"
#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/io/png/panels.hpp"
#include "barycert/io/png/png_file.hpp"

namespace barycert {
namespace {

using namespace io;

std::string by(std::size_t width, std::size_t height) {
    return std::to_string(width) + " by " + std::to_string(height);
}

Error too_long(const std::string& path, const char* what, const std::string& found, const char* remedy) {
    return file_error(path, what, "at most " + std::to_string(longest_png_side) + " pixels a side", found, remedy);
}

Status check(const std::string& path, const Slice& s) {
    if (s.width < 1 || s.height < 1 || std::max(s.width, s.height) > longest_png_side)
        return file_error(path, "a slice of that size cannot be a picture",
                          "1 to " + std::to_string(longest_png_side) + " values a side", by(s.width, s.height),
                          "choose fewer points, or at least one, on each axis");
    if (s.values.size() != s.width * s.height || (!s.valid.empty() && s.valid.size() != s.values.size()))
        return file_error(path, "the arrays of the slice do not fit together", by(s.width, s.height) + " values",
                          std::to_string(s.values.size()) + " values and " + std::to_string(s.valid.size()) +
                              " marks of which are valid",
                          "give one value, and one mark or none, for each point");
    if (!(s.aspect > 0) || !std::isfinite(s.aspect))
        return file_error(path, "the aspect of a slice is not valid", "a positive number", base::shortest(s.aspect),
                          "divide the spacing along a line by the spacing of lines");
    if (!(s.pixel_length >= 0) || !std::isfinite(s.pixel_length))
        return file_error(path, "the length of a pixel is not valid", "a finite number, 0 or more",
                          base::shortest(s.pixel_length), "leave it at 0 for a picture without a scale");
    const auto [low, high] = s.range.value_or(std::pair(0.0, 0.0));
    if (!std::isfinite(low) || !std::isfinite(high) || low > high)
        return file_error(path, "the range of colours is not valid", "two finite numbers, the lower one first",
                          base::shortest(low) + " and " + base::shortest(high), "choose another range");
    return Done{};
}

bool has_colour(const Slice& s, std::size_t i) {
    return (s.valid.empty() || s.valid[i] != 0) && std::isfinite(s.values[i]);
}

SliceCounts count(const Slice& s) {
    SliceCounts c;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = 0; i < s.values.size(); ++i) {
        if (!has_colour(s, i)) {
            ++(s.valid.empty() || s.valid[i] != 0 ? c.not_finite : c.outside);
            continue;
        }
        ++c.drawn;
        low = std::min(low, s.values[i]);
        high = std::max(high, s.values[i]);
        if (s.range && s.values[i] < s.range->first) ++c.below;
        if (s.range && s.values[i] > s.range->second) ++c.above;
    }
    if (c.drawn == 0) low = high = std::numeric_limits<double>::quiet_NaN();
    std::tie(c.low, c.high) = s.range.value_or(std::pair(low, high));
    // A zero may come with either sign, and first come is what std::min keeps: the bar says 0.
    c.low += 0.0;
    c.high += 0.0;
    return c;
}

}  // namespace

Status write_png(const std::string& path, const Slice& s, SliceCounts* counts) {
    const ExactEnvironment environment;
    if (Status good = check(path, s); !good) return good;
    const double stretch = std::max(s.aspect, 1.0), squeeze = std::min(s.aspect, 1.0);
    const double wide = std::round(static_cast<double>(s.width) * stretch);
    const double tall = std::round(static_cast<double>(s.height) / squeeze);
    if (std::max(wide, tall) > static_cast<double>(longest_png_side))
        return too_long(path, "a slice of that aspect cannot be a picture", base::shortest(std::max(wide, tall)),
                        "choose spacings that differ less");
    const auto columns = static_cast<std::size_t>(wide), lines = static_cast<std::size_t>(tall);

    const SliceCounts told = count(s);
    const bool with_bar = s.bar && !std::isnan(told.low);
    const std::size_t height = with_bar ? std::max(lines, min_bar_height) : lines;
    const ColourBar bar(told.low, told.high, std::max(height, min_bar_height));
    const std::size_t width = columns + (with_bar ? bar.width() : 0);
    if (width > longest_png_side)
        return too_long(path, "there is no room for the colour bar", std::to_string(width),
                        "leave out the bar, or choose fewer points");
    const Caption caption(s.title, s.pixel_length / stretch, columns, width, bar.scale());
    if (height + caption.height() > longest_png_side)
        return too_long(path, "there is no room for the caption", std::to_string(height + caption.height()),
                        "leave it out, or choose fewer points");
    const auto row = [&](std::size_t r, std::uint8_t* pixels) {
        if (r >= height) return caption.row(r - height, pixels);
        std::fill_n(pixels, 4 * columns, std::uint8_t{0});
        if (r < lines) {
            const std::size_t upwards = lines - 1 - r;
            const std::size_t first = (2 * upwards + 1) * s.height / (2 * lines) * s.width;
            for (std::size_t x = 0; x < columns; ++x) {
                const std::size_t i = first + (2 * x + 1) * s.width / (2 * columns);
                if (!has_colour(s, i)) continue;
                const double part = std::clamp(place_in_range(s.values[i], told.low, told.high), 0.0, 1.0);
                put_pixel(colour(std::min(colour_count - 1, static_cast<int>(colour_count * part))), pixels + 4 * x);
            }
        }
        if (with_bar) bar.row(r, pixels + 4 * columns);
    };
    if (Status written = write_png_rows(path, width, height + caption.height(), row); !written) return written;
    if (counts != nullptr) *counts = told;
    return Done{};
}

}  // namespace barycert
