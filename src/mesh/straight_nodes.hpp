/// Whether a node of a higher order is where the straight cell has it: at the middle of its edge; of orders 3 and 4 at
/// a sum of corners, times whole numbers, over the order.
///
/// Files seldom have that place exactly, for it was rounded when it was computed or written. A coordinate counts as
/// that of the place if it is one of the two numbers nearest to it, or to one that corners may have had, among
///   doubles;
///   floats, if all coordinates of the mesh are floats;
///   decimal numbers of as many digits as the mesh has, if its coordinates have at most 16, and one at least 5: of 17
///   digits nothing is told, and fewer than 5 come from round numbers. Their unit is that of the lowest decimal place
///   of any coordinate, or of as many digits as any has, counted from the coordinate's own first: the larger one, as
///   files have the same number of places, or of digits, all over. Doubles do not keep trailing zeros of a text: so the
///   mesh tells the digits, not the coordinate. Corners are then what their texts say, the shortest that are read as
///   they are.
///
/// So a node may be off by half a unit of its own, where the place has a digit more than the file. For floats and
/// decimal numbers it may also be off by half a unit of each corner times the corner's share of the place, because
/// corners were rounded when they were written, after the place was computed; all together it must be off by less than
/// the sum of these. The corners' part matters only where units differ: if all are equal, a node is off by a whole
/// number of half units. From 15 digits on, the sum also has the error of rounding the place to double.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace barycert::mesh {

/// How coordinates of a mesh were written, as far as all of them tell.
struct Written {
    bool single = false;  ///< they are floats
    int digits = 0;       ///< the most that one has; 0: they are no decimal numbers
    int lowest = 0;       ///< power of ten of the lowest place
};
Written how_written(std::span<const double> coordinates);

/// The sum of times[i] * corners[i], over `over`, which is the sum of `times`, at most 4.
struct StraightPlace {
    std::array<double, 4> corners{};
    std::array<int, 4> times{};
    std::size_t count = 0;
    int over = 0;

    void add(double corner, int factor) {
        corners[count] = corner;
        times[count++] = factor;
        over += factor;
    }
};

/// `rounded` to double; `written` as a float or in decimal digits.
enum class Straight : std::uint8_t { exactly, rounded, written, no };
/// Requires: all numbers are finite.
Straight straightness(double coordinate, const StraightPlace& place, const Written& written);

}  // namespace barycert::mesh
