#include "mesh/straight_nodes.hpp"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <span>

namespace barycert::mesh {
namespace {

using Integer = boost::multiprecision::cpp_int;

/// digits * 10^exponent, of the shortest text that is read as a double.
struct Decimal {
    std::int64_t digits = 0;
    int count = 0;     ///< of digits; 0 of zero
    int exponent = 0;  ///< power of ten of the last digit
};

Decimal decimal(double x) {
    if (x == 0) return {};
    std::array<char, 32> text{};  // d.ddde-xx, and zero bytes
    std::to_chars(text.data(), text.data() + text.size(), std::fabs(x), std::chars_format::scientific);
    Decimal out;
    const char* at = text.data();
    for (; *at != 'e'; ++at) {
        if (*at == '.') continue;
        out.digits = 10 * out.digits + (*at - '0');
        ++out.count;
    }
    out.exponent = std::atoi(at + 1) - out.count + 1;
    if (x < 0) out.digits = -out.digits;
    return out;
}

/// A sum of up to 14 doubles times whole numbers below 16.
class ExactSum {
    static constexpr std::size_t most = 14;

public:
    /// `times` times the place's own sum.
    ExactSum(const StraightPlace& place, int times) {
        for (std::size_t i = 0; i < place.count; ++i) add(place.corners[i], times * place.times[i]);
    }
    void add(double x, int times) {
        terms_[count_] = x;
        times_[count_++] = times;
    }

    int sign() const {
        // Products are below 2^1024, and off by u = 2^-53 of each or, subnormal, by 2^-1075; sums by u of all so far.
        // Together that is less than 15 u of the sum of all sizes, and 2^-1070.
        double sum = 0, size = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            const double own = terms_[i] * 0x1p-8 * times_[i];
            sum += own;
            size += std::fabs(own);
        }
        if (std::fabs(sum) > 0x1p-49 * size + 0x1p-1060) return sum < 0 ? -1 : 1;
        return exactly();
    }

private:
    int exactly() const {
        std::array<std::int64_t, most> mantissa{};
        std::array<int, most> exponent{};
        int lowest = std::numeric_limits<int>::max();
        for (std::size_t i = 0; i < count_; ++i) {
            mantissa[i] = static_cast<std::int64_t>(std::ldexp(std::frexp(terms_[i], &exponent[i]), 53));
            if (mantissa[i] != 0) lowest = std::min(lowest, exponent[i]);
        }
        Integer sum = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            if (mantissa[i] != 0)
                sum += Integer(mantissa[i] * times_[i]) << static_cast<unsigned>(exponent[i] - lowest);
        }
        return sum.sign();
    }

    std::array<double, most> terms_{};
    std::array<int, most> times_{};
    std::size_t count_ = 0;
};

/// Whether the place is between the middles of a coordinate and its neighbours among numbers of a type. `corners`: it
/// may be beyond by less than rounding the corners may have moved it.
template <class Number>
bool is_rounded_to(double coordinate, const StraightPlace& place, bool corners) {
    constexpr Number inf = std::numeric_limits<Number>::infinity();
    const auto own = static_cast<Number>(coordinate);
    const auto sign_beyond = [&](Number next, int side) {  // of the place less what is excused, times 2 over
        ExactSum sum(place, 2);
        sum.add(coordinate, -place.over);
        sum.add(std::isfinite(next) ? static_cast<double>(next) : coordinate, -place.over);
        for (std::size_t i = 0; corners && i < place.count; ++i) {
            const double size = std::fabs(place.corners[i]);
            const Number beyond = std::nextafter(static_cast<Number>(size), inf);
            if (!std::isfinite(beyond)) continue;
            sum.add(static_cast<double>(beyond), -side * place.times[i]);
            sum.add(size, side * place.times[i]);
        }
        return sum.sign();
    };
    const int least = corners ? 1 : 0;
    return sign_beyond(std::nextafter(own, -inf), -1) >= least && sign_beyond(std::nextafter(own, inf), 1) <= -least;
}

/// From so many digits on the middle was rounded to double, before it was written, by no small part of a unit.
constexpr int own_rounding_digits = 15;

bool is_decimal_rounded(double coordinate, const StraightPlace& place, const Written& written) {
    // Far off, in double: a number's unit is at most 10^lowest, or 10^(1 - digits) of itself. Twice what would be
    // enough.
    double off = -place.over * (coordinate * 0x1p-8), size = std::fabs(off);
    for (std::size_t i = 0; i < place.count; ++i) {
        const double term = place.times[i] * (place.corners[i] * 0x1p-8);
        off += term;
        size += std::fabs(term);
    }
    const double units =
        2 * place.over * 0x1p-8 * std::pow(10.0, written.lowest) + 1.5 * size * std::pow(10.0, 1 - written.digits);
    if (std::fabs(off) - 0x1p-48 * size > units) return false;

    std::array<Decimal, 5> numbers;  // the corners, and the node
    std::array<int, 5> unit{};
    int lowest = written.lowest;
    for (std::size_t i = 0; i <= place.count; ++i) {
        const Decimal& own = numbers[i] = decimal(i == place.count ? coordinate : place.corners[i]);
        const int first = own.exponent + own.count - 1;
        unit[i] = own.count == 0 ? written.lowest : std::max(written.lowest, first - written.digits + 1);
        if (own.count != 0) lowest = std::min(lowest, own.exponent);
    }
    const auto shifted = [&](std::int64_t digits, int exponent) {
        using boost::multiprecision::pow;
        return digits == 0 ? Integer(0) : Integer(digits * pow(Integer(10), static_cast<unsigned>(exponent - lowest)));
    };
    Integer sum = 0, excused = 0;
    for (std::size_t i = 0; i <= place.count; ++i) {
        const int times = i == place.count ? -place.over : place.times[i];
        sum += times * shifted(numbers[i].digits, numbers[i].exponent);
        excused += std::abs(times) * shifted(1, unit[i]);
    }
    if (written.digits < own_rounding_digits) return 2 * abs(sum) < excused;
    const Decimal& own = numbers[place.count];
    const Integer in_double = place.over * abs(shifted(own.digits, own.exponent));  // over 2^52: twice half an ulp
    return (2 * abs(sum) << 52U) < (excused << 52U) + in_double;
}

}  // namespace

Written how_written(std::span<const double> coordinates) {
    constexpr int least = 5, most = 16;
    Written written{.single = true, .digits = 0, .lowest = std::numeric_limits<int>::max()};
    for (const double x : coordinates) {
        if (x == 0 || !std::isfinite(x)) continue;
        written.single = written.single && static_cast<double>(static_cast<float>(x)) == x;
        if (written.digits <= most) {
            const Decimal own = decimal(x);
            written.digits = std::max(written.digits, own.count);
            written.lowest = std::min(written.lowest, own.exponent);
        } else if (!written.single) {
            break;
        }
    }
    if (written.digits < least || written.digits > most) written.digits = written.lowest = 0;
    return written;
}

Straight straightness(double coordinate, const StraightPlace& place, const Written& written) {
    if (place.count == 2 && place.over == 2) {
        // The sum and what it leaves; half of a sum that is rounded is rounded, too, unless it is subnormal.
        const double a = place.corners[0], b = place.corners[1], sum = a + b;
        const double of_b = sum - a, left = (a - (sum - of_b)) + (b - of_b);
        if (std::isfinite(sum) && sum == 2 * coordinate) return left == 0 ? Straight::exactly : Straight::rounded;
    }
    ExactSum off(place, 1);
    off.add(coordinate, -place.over);
    if (off.sign() == 0) return Straight::exactly;
    if (is_rounded_to<double>(coordinate, place, false)) return Straight::rounded;
    const bool as_written = (written.single && is_rounded_to<float>(coordinate, place, true)) ||
                            (written.digits != 0 && is_decimal_rounded(coordinate, place, written));
    return as_written ? Straight::written : Straight::no;
}

}  // namespace barycert::mesh
