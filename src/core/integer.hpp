/// Exact integers without heap, for what floating point cannot decide.
///
/// Sign and magnitude in limbs of 64 bits, as many as the number needs, in a fixed place on the stack. Why integers and
/// not floating-point expansions: a finite double is a small integer times a power of two, so after one shift per
/// coordinate every polynomial is plain integer arithmetic. Nothing can under- or overflow, nothing depends on the
/// rounding mode, and each operation is exact by the schoolbook, not by an error analysis.
///
/// Widths. The finite doubles are multiples of 2^-1074 below 2^1024: 2098 bits, a difference of two 2099. The largest
/// polynomial is that of a quadratic field on a tetrahedron, of degree 6 in differences and 1 in nodal values, 14704
/// bits: see exact_fields.cpp. Next comes insphere, of degree 5 in differences, which is not divided: see
/// exact_weights.cpp. The numerator of a value on a triangle in 3-space, of degree 4 in differences and 1 in nodal
/// values, summed over 4 x 18 terms, has 4 * 2099 + 2098 + 7 = 10501 bits. Division shifts one operand left by at most
/// 64 bits more than the other's length and by up to 63 bits: two limbs more.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#if defined(__x86_64__) && defined(__clang__)
#include <immintrin.h>
#elif defined(__x86_64__)
#include <x86gprintrin.h>  // of immintrin.h what is used here: a tenth of its text
#endif

namespace barycert::core {

__extension__ using UInt128 = unsigned __int128;

// One limb of a sum or difference; the carry goes in and out. Intrinsics where there are some: compilers do not find
// the instruction in the wide arithmetic.
#ifdef __x86_64__
using Carry = unsigned char;
inline std::uint64_t add_with_carry(std::uint64_t x, std::uint64_t y, Carry& carry) {
    unsigned long long r;
    carry = _addcarry_u64(carry, x, y, &r);
    return r;
}
inline std::uint64_t subtract_with_borrow(std::uint64_t x, std::uint64_t y, Carry& borrow) {
    unsigned long long r;
    borrow = _subborrow_u64(borrow, x, y, &r);
    return r;
}
#else
using Carry = std::uint64_t;
inline std::uint64_t add_with_carry(std::uint64_t x, std::uint64_t y, Carry& carry) {
    const UInt128 t = static_cast<UInt128>(x) + y + carry;
    carry = static_cast<Carry>(t >> 64);
    return static_cast<std::uint64_t>(t);
}
inline std::uint64_t subtract_with_borrow(std::uint64_t x, std::uint64_t y, Carry& borrow) {
    const UInt128 t = static_cast<UInt128>(x) - y - borrow;
    borrow = static_cast<Carry>(t >> 64) & 1;
    return static_cast<std::uint64_t>(t);
}
#endif

class Integer {
public:
    static constexpr int capacity = 232;
    static_assert(64 * (capacity - 2) >= 14704);

    Integer() {}  // not `= default`: Integer() would then clear all limbs
    Integer(const Integer& other) { assign(other); }
    Integer& operator=(const Integer& other) {
        if (this != &other) assign(other);
        return *this;
    }

    /// mantissa * 2^shift with a sign. Requires: shift + 128 <= 64 * capacity.
    Integer(bool negative, std::uint64_t mantissa, int shift) : negative_(negative) {
        if (mantissa == 0) return;
        const int whole = shift / 64, part = shift % 64;
        std::fill_n(limbs_, whole, 0);
        limbs_[whole] = mantissa << part;
        limbs_[whole + 1] = part == 0 ? 0 : mantissa >> (64 - part);
        size_ = whole + 2;
        // Limbs from size_ on are never read.
        trim();  // NOLINT(clang-analyzer-optin.cplusplus.UninitializedObject)
    }

    /// A magnitude, the least significant limb first.
    Integer(bool negative, std::span<const std::uint64_t> magnitude)
        : size_(static_cast<int>(magnitude.size())), negative_(negative) {
        std::copy(magnitude.begin(), magnitude.end(), limbs_);
        trim();
    }

    int sign() const { return size_ == 0 ? 0 : negative_ ? -1 : 1; }
    /// The magnitude, the least significant limb first, the last one not zero.
    std::span<const std::uint64_t> magnitude() const { return {limbs_, static_cast<std::size_t>(size_)}; }

    friend Integer operator+(const Integer& x, const Integer& y) { return sum(x, y, y.negative_); }
    friend Integer operator-(const Integer& x, const Integer& y) { return sum(x, y, !y.negative_); }

    friend Integer operator*(const Integer& x, const Integer& y) {
        Integer r;
        if (x.size_ == 0 || y.size_ == 0) return r;
        const Integer& a = x.size_ <= y.size_ ? x : y;  // few long rows instead of many short ones
        const Integer& b = x.size_ <= y.size_ ? y : x;
        r.negative_ = x.negative_ != y.negative_;
        r.size_ = a.size_ + b.size_;
        std::fill_n(r.limbs_, r.size_, 0);
        for (int i = 0; i < a.size_; ++i) {
            if (a.limbs_[i] == 0) continue;  // frequent: numbers far apart in magnitude share one integer
            std::uint64_t carry = 0;
            for (int j = 0; j < b.size_; ++j) {
                // (2^64-1)^2 + 2 (2^64-1) = 2^128 - 1: no overflow
                const UInt128 t = static_cast<UInt128>(a.limbs_[i]) * b.limbs_[j] + r.limbs_[i + j] + carry;
                r.limbs_[i + j] = static_cast<std::uint64_t>(t);
                carry = static_cast<std::uint64_t>(t >> 64);
            }
            r.limbs_[i + b.size_] = carry;
        }
        r.trim();
        return r;
    }

    /// -1, 0, 1 as |x| is less than, equal to, greater than |y|.
    static int compare_magnitudes(const Integer& x, const Integer& y) {
        if (x.size_ != y.size_) return x.size_ < y.size_ ? -1 : 1;
        for (int i = x.size_ - 1; i >= 0; --i) {
            if (x.limbs_[i] != y.limbs_[i]) return x.limbs_[i] < y.limbs_[i] ? -1 : 1;
        }
        return 0;
    }

private:
    void assign(const Integer& other) {
        size_ = other.size_;
        negative_ = other.negative_;
        std::copy_n(other.limbs_, size_, limbs_);
    }

    void trim() {
        while (size_ > 0 && limbs_[size_ - 1] == 0) --size_;
    }

    /// x + y with y's sign replaced.
    static Integer sum(const Integer& x, const Integer& y, bool y_negative) {
        if (x.negative_ == y_negative || x.size_ == 0 || y.size_ == 0) {
            Integer r = x.size_ >= y.size_ ? add(x, y) : add(y, x);
            r.negative_ = x.size_ == 0 ? y_negative : x.negative_;
            return r;
        }
        const int order = compare_magnitudes(x, y);
        if (order == 0) return {};
        Integer r = order > 0 ? subtract(x, y) : subtract(y, x);
        r.negative_ = order > 0 ? x.negative_ : y_negative;
        return r;
    }

    /// |x| + |y|. Requires: x.size_ >= y.size_.
    static Integer add(const Integer& x, const Integer& y) {
        Integer r;
        Carry carry = 0;
        for (int i = 0; i < x.size_; ++i)
            r.limbs_[i] = add_with_carry(x.limbs_[i], i < y.size_ ? y.limbs_[i] : 0, carry);
        r.size_ = x.size_;
        if (carry != 0) r.limbs_[r.size_++] = 1;
        return r;
    }

    /// |x| - |y|. Requires: |x| >= |y|.
    static Integer subtract(const Integer& x, const Integer& y) {
        Integer r;
        Carry borrow = 0;
        for (int i = 0; i < x.size_; ++i)
            r.limbs_[i] = subtract_with_borrow(x.limbs_[i], i < y.size_ ? y.limbs_[i] : 0, borrow);
        r.size_ = x.size_;
        r.trim();
        return r;
    }

    int size_ = 0;
    bool negative_ = false;          ///< of no meaning for zero
    std::uint64_t limbs_[capacity];  ///< set below size_ alone: most numbers need three or four
};

/// An integer of a width known when compiling, for the frequent case of coordinates of like magnitude.
///
/// Two's complement in N limbs of 64 bits, no branches. A product has the limbs of both factors and cannot overflow; a
/// sum keeps its width, so that whoever adds has to show that there is room.
template <int N>
struct Fixed {
    std::array<std::uint64_t, N> limbs;  ///< the least significant first

    bool negative() const { return (limbs[N - 1] >> 63) != 0; }
    int sign() const {
        return negative() ? -1 : std::any_of(limbs.begin(), limbs.end(), [](auto limb) { return limb != 0; }) ? 1 : 0;
    }

    [[gnu::always_inline]] friend inline Fixed operator+(const Fixed& x, const Fixed& y) {
        Fixed r;
        Carry carry = 0;
        for (std::size_t i = 0; i < N; ++i) r.limbs[i] = add_with_carry(x.limbs[i], y.limbs[i], carry);
        return r;
    }

    [[gnu::always_inline]] friend inline Fixed operator-(const Fixed& x, const Fixed& y) {
        Fixed r;
        Carry borrow = 0;
        for (std::size_t i = 0; i < N; ++i) r.limbs[i] = subtract_with_borrow(x.limbs[i], y.limbs[i], borrow);
        return r;
    }
};

/// The unsigned product, less 2^(64 N) y if x is negative and 2^(64 M) x if y is: a negative number stands for itself
/// plus 2^(64 N).
template <int N, int M>
[[gnu::always_inline]] inline Fixed<N + M> operator*(const Fixed<N>& x, const Fixed<M>& y) {
    Fixed<N + M> r{};
    for (std::size_t i = 0; i < N; ++i) {
        std::uint64_t carry = 0;
        for (std::size_t j = 0; j < M; ++j) {
            const UInt128 t = static_cast<UInt128>(x.limbs[i]) * y.limbs[j] + r.limbs[i + j] + carry;
            r.limbs[i + j] = static_cast<std::uint64_t>(t);
            carry = static_cast<std::uint64_t>(t >> 64);
        }
        r.limbs[i + M] = carry;
    }
    const std::uint64_t x_mask = x.negative() ? ~std::uint64_t{0} : 0, y_mask = y.negative() ? ~std::uint64_t{0} : 0;
    Carry borrow = 0;
    for (std::size_t i = 0; i < M; ++i)
        r.limbs[N + i] = subtract_with_borrow(r.limbs[N + i], y.limbs[i] & x_mask, borrow);
    borrow = 0;
    for (std::size_t i = 0; i < N; ++i)
        r.limbs[M + i] = subtract_with_borrow(r.limbs[M + i], x.limbs[i] & y_mask, borrow);
    return r;
}

/// The same number without a fixed width.
template <int N>
inline Integer as_integer(const Fixed<N>& x) {
    if (!x.negative()) return {false, x.limbs};
    const Fixed<N> magnitude = Fixed<N>{} - x;
    return {true, magnitude.limbs};
}
inline const Integer& as_integer(const Integer& x) {
    return x;
}

// Quotients of exact integers, rounded to the nearest double.

/// A magnitude: limbs of 64 bits, the least significant first; leading zeros are allowed.
using Magnitude = std::span<const std::uint64_t>;

/// (numerator / denominator) * 2^exponent with a sign, rounded to nearest, ties to even, subnormal results and overflow
/// to infinity included. An exact zero gives +0; what is smaller than half of the smallest subnormal gives a zero with
/// its sign. Works on bits alone: the floating-point environment has no influence. Requires: denominator not zero;
/// both fit an Integer.
double round_quotient(bool negative, Magnitude numerator, Magnitude denominator, int exponent);

/// The same of two numbers with their signs.
inline double round_quotient(const Integer& numerator, const Integer& denominator, int exponent) {
    return round_quotient(numerator.sign() != denominator.sign(), numerator.magnitude(), denominator.magnitude(),
                          exponent);
}

/// number * 2^exponent rounded in the same way.
double round_integer(const Integer& number, int exponent);

}  // namespace barycert::core
