#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/integer.hpp"

namespace barycert::core {
namespace {

/// Rounds (q + t) * 2^exponent, 0 <= t < 1, where t > 0 exactly if `inexact`. Requires: q >= 2^62.
double round_bits(bool negative, std::uint64_t q, bool inexact, int exponent) {
    const std::uint64_t sign = negative ? std::uint64_t{1} << 63 : 0;
    const int top = static_cast<int>(std::bit_width(q)) - 1 + exponent;  // 2^top <= value < 2^(top + 1)
    if (top > 1023) return std::bit_cast<double>(sign | std::uint64_t{0x7ff} << 52);
    const int last = std::max(top - 52, -1074);            // exponent of the last bit that a double has there
    const int dropped = last - exponent;                   // at least 10, since q has at least 63 bits and a double 53
    if (dropped > 64) return std::bit_cast<double>(sign);  // value < 2^(64 + exponent) <= 2^(last - 1): below the half
    const std::uint64_t half = std::uint64_t{1} << (dropped - 1);
    const std::uint64_t rest = q & (half - 1 + half);
    std::uint64_t mantissa = dropped == 64 ? 0 : q >> dropped;
    if (rest > half || (rest == half && (inexact || (mantissa & 1) != 0))) ++mantissa;
    // The leading bit of a normal mantissa, 2^52, adds the one by which a biased exponent differs from last + 1074. A
    // carry to 2^53 runs into the exponent: to the next binade, from subnormal to normal, from the largest to infinity.
    return std::bit_cast<double>(sign | (mantissa + (static_cast<std::uint64_t>(last + 1074) << 52)));
}

int bit_length(Magnitude x) {
    std::size_t size = x.size();
    while (size > 0 && x[size - 1] == 0) --size;
    return size == 0 ? 0 : static_cast<int>(64 * size) - std::countl_zero(x[size - 1]);
}

/// x * 2^bits in `size` limbs. Requires: it fits, bits >= 0.
void shift_left(Magnitude x, int bits, std::uint64_t* out, int size) {
    const int whole = bits / 64, part = bits % 64;
    std::fill_n(out, whole, 0);
    std::uint64_t below = 0;
    for (int i = 0; i < size - whole; ++i) {
        const std::uint64_t limb = i < static_cast<int>(x.size()) ? x[static_cast<std::size_t>(i)] : 0;
        out[whole + i] = part == 0 ? limb : limb << part | below >> (64 - part);
        below = limb;
    }
}

}  // namespace

double round_quotient(bool negative, Magnitude numerator, Magnitude denominator, int exponent) {
    const int n_bits = bit_length(numerator), d_bits = bit_length(denominator);
    if (n_bits == 0) return 0.0;
    // Shift both so that the divisor fills its k limbs to the last bit and the dividend has 64 k + 63 bits: then
    // 2^62 < quotient < 2^64, one digit in base 2^64.
    const int k = (std::max(d_bits, n_bits - 63) + 63) / 64;
    std::uint64_t divisor[Integer::capacity], rest[Integer::capacity + 1];
    shift_left(denominator, 64 * k - d_bits, divisor, k);
    shift_left(numerator, 64 * k + 63 - n_bits, rest, k + 1);

    // The leading two limbs over the leading one: never below the true digit and at most 2 above it (Knuth, The Art of
    // Computer Programming 2, 4.3.1, theorem B: the divisor's leading bit is set).
    const UInt128 leading = static_cast<UInt128>(rest[k]) << 64 | rest[k - 1];
    auto q = static_cast<std::uint64_t>(leading / divisor[k - 1]);  // fits: rest[k] < 2^63 <= divisor[k - 1]
    std::uint64_t carry = 0;
    Carry borrow = 0;
    for (int i = 0; i < k; ++i) {
        const UInt128 t = static_cast<UInt128>(q) * divisor[i] + carry;
        carry = static_cast<std::uint64_t>(t >> 64);
        rest[i] = subtract_with_borrow(rest[i], static_cast<std::uint64_t>(t), borrow);
    }
    rest[k] = subtract_with_borrow(rest[k], carry, borrow);
    while (borrow != 0) {  // the rest is negative: the digit was too large
        --q;
        Carry over = 0;
        for (int i = 0; i < k; ++i) rest[i] = add_with_carry(rest[i], divisor[i], over);
        rest[k] = add_with_carry(rest[k], 0, over);
        if (over != 0) borrow = 0;
    }
    const bool inexact = std::any_of(rest, rest + k, [](std::uint64_t limb) { return limb != 0; });
    return round_bits(negative, q, inexact, exponent + n_bits - d_bits - 63);
}

double round_integer(const Integer& number, int exponent) {
    const std::uint64_t one[1] = {1};
    return round_quotient(number.sign() < 0, number.magnitude(), one, exponent);
}

}  // namespace barycert::core
