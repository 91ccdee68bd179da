/// What stands under a picture: a white panel with a title and the scale of lengths.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace barycert::io {

/// Largest of 1, 2 and 5 times a power of ten that is at most `limit`. Precondition: limit > 0, finite.
double round_length(double limit);

class Caption {
public:
    /// For a picture `width` pixels wide, of which the first `drawn` have the length `pixel_length` each (0: no scale);
    /// `dot` pixels for each dot of the text. A title that is too long for the place is cut.
    Caption(const std::string& title, double pixel_length, std::size_t drawn, std::size_t width, std::size_t dot);

    std::size_t height() const { return height_; }  ///< 0 if there is nothing to say

    /// Sets the 4 * width bytes of a row, counted from the top of the panel.
    void row(std::size_t r, std::uint8_t* pixels) const;

private:
    std::string title_, length_text_;
    std::size_t width_, scale_, height_ = 0;
    std::size_t bar_ = 0;  ///< pixels of the bar; 0: none
};

}  // namespace barycert::io
