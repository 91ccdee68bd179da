/// Axes with round numbers, and plots of curves over them.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "draw/picture.hpp"

namespace barycert::draw {

struct Tick {
    double at;
    std::string text;
};

/// Round numbers in [low, high], finite: multiples of 1, 2 or 5 times a power of ten, each the nearest double, at most
/// `max` of them (at least 2).
std::vector<double> round_numbers(double low, double high, int max);

/// Ticks with labels, of four digits at most. `common` has what these leave out: a power of ten by which all are to be
/// multiplied, "×10⁻³", or a number to be added, "+1234500".
struct Ticks {
    std::vector<Tick> ticks;
    std::string common = {};
};
Ticks round_ticks(double low, double high, int max);

/// Ticks of an axis of log10: powers of ten in [low, high], with 2 and 5 times each where they are few.
std::vector<Tick> log_ticks(double low, double high);

/// "⁻¹²": the number, rounded, as an exponent.
std::string superscript(double exponent);

/// At most four digits, with a minus sign; "1.5×10⁻⁷".
std::string number_text(double x);

/// A linear axis: numbers [low, high] onto pixels [from, to].
struct Axis {
    double low = 0, high = 1;
    double from = 0, to = 1;
    std::string title = {};
    std::vector<Tick> ticks = {};
    bool grid = true;  ///< a line across the picture at each tick
    std::string common = {};

    double at(double x) const { return from + (to - from) * (x - low) / (high - low); }
    void set(Ticks t) { ticks = std::move(t.ticks), common = std::move(t.common); }
};

/// The line across, ticks with their numbers, the grid, and the titles below and to the left, which take 60 pixels.
void draw_axes(Picture& picture, const Axis& x, const Axis& y);

/// The part of the line through `a` and `b` (numbers, not pixels) that lies between the axes; nothing if none does.
void draw_line_through(Picture& picture, const Axis& x, const Axis& y, Pixel a, Pixel b, std::string style);

/// Numbers, not pixels. NaN breaks a line.
struct Curve {
    std::string name, below = {};  ///< in the legend
    std::vector<Pixel> line = {}, median = {};
};

inline constexpr std::size_t max_curves = 6;

/// A title above, axes, a legend to the right, notes below.
struct Plot {
    Axis x, y;
    Picture picture;
    double legend = 76;  ///< where its next entry stands

    /// `beside`, `below`: for legend and notes.
    explicit Plot(const std::string& title, double wide = 980, double tall = 620, double beside = 280,
                  double below = 120)
        : x{.from = 76, .to = wide - beside}, y{.from = tall - below, .to = 60}, picture(wide, tall, title) {
        picture.text({70, 34}, title, "head");
    }

    /// The first on top; with a legend. `marks`: at each point.
    void curves(const std::vector<Curve>& all, const std::string& style = {}, bool marks = true);
    void entry(std::string style, std::string what);
    void notes(const std::vector<std::string>& lines);
};

}  // namespace barycert::draw
