/// The colour bar of a picture: a white panel with the colours from bottom to top, the numbers at its ends and, where
/// there is room, round numbers between them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace barycert::io {

/// Least height of a panel: two lines of text and what is around them.
inline constexpr std::size_t min_bar_height = 25;

class ColourBar {
public:
    /// For numbers low <= high, as high as asked for (at least min_bar_height). Text grows with the height.
    ColourBar(double low, double high, std::size_t height);

    std::size_t width() const { return width_; }

    /// Pixels for each dot of the text.
    std::size_t scale() const { return scale_; }

    /// Sets the 4 * width() bytes of a row, counted from the top.
    void row(std::size_t r, std::uint8_t* pixels) const;

private:
    void put_text(const std::string& text, std::size_t r, std::size_t top, std::uint8_t* pixels) const;

    struct Tick {
        std::size_t row;  ///< from the top
        std::string text;
    };
    void add_ticks(double low, double high);

    std::string low_, high_;
    bool one_number_;
    std::size_t height_, scale_, width_;
    std::vector<Tick> ticks_;
};

}  // namespace barycert::io
