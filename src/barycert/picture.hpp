/// Pictures of slices: one scalar on a regular grid in a plane, by colour, as a PNG file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "barycert/result.hpp"

namespace barycert {

struct Slice {
    std::size_t width = 0, height = 0;
    std::span<const double> values = {};  ///< width * height, line after line, the second coordinate ascending
    double aspect = 1;                    ///< spacing of the values along a line over the spacing of lines

    /// What the first and the last colour mean; without one, the least and the greatest of the values that are drawn.
    std::optional<std::pair<double, double>> range = {};
    std::span<const std::uint8_t> valid = {};  ///< empty, or one a value: 0 where there is none (outside)
    bool bar = true;                           ///< a colour bar with the range in numbers, to the right of the slice

    std::string title = {};   ///< a line under the slice; printable ASCII, other characters are drawn as boxes
    double pixel_length = 0;  ///< of a column; if above 0, a scale of lengths stands under the slice
};

/// What became of the values.
struct SliceCounts {
    std::uint64_t drawn = 0;       ///< with a colour
    std::uint64_t below = 0;       ///< of these: below the range, drawn as its low end
    std::uint64_t above = 0;       ///< of these: above it, drawn as its high end
    std::uint64_t not_finite = 0;  ///< valid but NaN or infinite: transparent
    std::uint64_t outside = 0;     ///< not valid: transparent
    double low = 0, high = 0;      ///< the range; NaN if nothing is drawn and none was given
};

/// Writes the slice as 8-bit RGBA in sRGB with colours of colour_map.hpp; the file appears whole or not at all.
///
/// One pixel a value, the second coordinate upwards: values[0] is at the lower left. Where aspect is not 1, columns or
/// lines are repeated so that the picture has the shape of the plane: round(width * aspect) columns if it is above 1,
/// else round(height / aspect) lines, each showing the value whose place holds its middle.
/// The range is divided into 256 equal parts, a colour each; its ends have the first and the last colour. If all that
/// is drawn has one value, or the range is one number, that has the colour in the middle. The bar is a white panel of
/// its own beside the slice; a slice less than 25 pixels high is made so high by transparent lines below it. Without a
/// range there is no bar. Title and scale are a white panel below both; a title that is too long is cut, and there is
/// no scale where there is no place for it. The scale is a line of 1, 2 or 5 times a power of ten, rounded to pixels,
/// with that number.
///
/// `counts`: if given, set. Errors: sizes that do not fit together, no value at all, more than a million pixels a side;
/// an aspect or a range that is none; a file that cannot be written.
Status write_png(const std::string& path, const Slice& slice, SliceCounts* counts = nullptr);

}  // namespace barycert
