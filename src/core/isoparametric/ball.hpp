/// Numbers of any precision with a bound on their error: balls.
///
/// A ball stands for all numbers at most `radius` from `mid`. Each operation yields a ball that has all exact results
/// of numbers of its operands: the radii add up as products and sums do, and the rounding of the middle is added, with
/// u = 2^-53:
///   double         u |result|
///   double-double  a sum by 4 u^2 (|x| + |y|), a product by 9 u^2 |x y| (error_free-inl.hpp)
///   wide           2^-(bits - 2) |result|
/// Radii are computed in double: each is at most 8 roundings off, for which it is multiplied by 1 + 2^-48, and what
/// underflows is less than 2^-1000, which is added. That also covers what the products of double-double lose there.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>

namespace barycert::core::isoparametric {

using Rational =
    boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;
using Whole = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>, boost::multiprecision::et_off>;
template <unsigned bits>
using Wide = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<bits, boost::multiprecision::digit_base_2, std::allocator<char>, std::int64_t>,
    boost::multiprecision::et_off>;

/// high + low, |low| at most half a unit of the last place of high.
struct TwoDoubles {
    double high = 0, low = 0;

    TwoDoubles() = default;
    TwoDoubles(double x) : high(x) {}  // NOLINT(google-explicit-constructor): as the other numbers
    TwoDoubles(double x, double y) : high(x), low(y) {}

    static TwoDoubles sum(double x, double y) {
        const double s = x + y, y_part = s - x, x_part = s - y_part;
        return {s, (x - x_part) + (y - y_part)};
    }
    static TwoDoubles product(double x, double y) {
        const double p = x * y;
        return {p, __builtin_fma(x, y, -p)};
    }
    friend TwoDoubles operator+(TwoDoubles x, TwoDoubles y) {
        const TwoDoubles s = sum(x.high, y.high);
        return sum(s.high, s.low + (x.low + y.low));
    }
    friend TwoDoubles operator-(TwoDoubles x) { return {-x.high, -x.low}; }
    friend TwoDoubles operator-(TwoDoubles x, TwoDoubles y) { return x + -y; }
    friend bool operator<(TwoDoubles x, TwoDoubles y) { return x.high < y.high || (x.high == y.high && x.low < y.low); }
    friend TwoDoubles operator*(TwoDoubles x, TwoDoubles y) {
        const TwoDoubles p = product(x.high, y.high);
        const double low = p.low + (x.high * y.low + x.low * y.high), s = p.high + low;
        return {s, low - (s - p.high)};
    }
};

/// Traits of the number types of balls: size(x), |x| as a double that is not below it, and the errors of operations,
/// relative to that.
template <class T>
struct NumberTraits;
template <>
struct NumberTraits<double> {
    static constexpr double of_sum = 0x1p-53, of_product = 0x1p-53;
    static double size(double x) { return std::abs(x); }
};
template <>
struct NumberTraits<TwoDoubles> {
    static constexpr double of_sum = 0x1p-104, of_product = 0x1p-102;
    static double size(const TwoDoubles& x) { return std::abs(x.high) * (1 + 0x1p-50); }
};
template <unsigned bits>
struct NumberTraits<Wide<bits>> {
    static constexpr double of_sum = bits > 1000 ? 0x1p-998 : bits > 500 ? 0x1p-498 : 0x1p-198;
    static constexpr double of_product = of_sum;
    static double size(const Wide<bits>& x) { return std::abs(x.template convert_to<double>()) * (1 + 0x1p-50); }
};

template <class T>
struct Ball {
    T mid{};
    double radius = 0;

    Ball() = default;
    Ball(T m) : mid(std::move(m)) {}  // NOLINT(google-explicit-constructor): an exact number
    Ball(int n) requires(!std::is_same_v<T, int>) : mid(T(n)) {}  // NOLINT(google-explicit-constructor)
    Ball(T m, double r) : mid(std::move(m)), radius(r) {}

    double size() const { return NumberTraits<T>::size(mid); }
    /// -1, 1, or nothing where zero may be one of its numbers.
    std::optional<int> sign() const {
        if (!(size() * (1 - 0x1p-40) > radius)) return std::nullopt;
        return mid < T(0) ? -1 : 1;
    }
    /// |x| is at most that for all of its numbers.
    double most() const { return (size() + radius) * (1 + 0x1p-50); }

    friend Ball operator+(const Ball& x, const Ball& y) { return sum_of(T(x.mid + y.mid), x, y); }
    friend Ball operator-(const Ball& x) { return {T(-x.mid), x.radius}; }
    friend Ball operator-(const Ball& x, const Ball& y) { return sum_of(T(x.mid - y.mid), x, y); }
    friend Ball operator*(const Ball& x, const Ball& y) {
        Ball r(x.mid * y.mid);
        const double a = x.size(), b = y.size();
        return r.grown(a * y.radius + b * x.radius + x.radius * y.radius + NumberTraits<T>::of_product * (a * b));
    }

private:
    static Ball sum_of(T sum, const Ball& x, const Ball& y) {
        Ball r(std::move(sum));
        const double size = std::is_same_v<T, double> ? r.size() : x.size() + y.size();
        return r.grown(x.radius + y.radius + NumberTraits<T>::of_sum * size);
    }
    Ball& grown(double by) {
        radius = by * (1 + 0x1p-48) + 0x1p-1000;
        return *this;
    }
};

}  // namespace barycert::core::isoparametric
