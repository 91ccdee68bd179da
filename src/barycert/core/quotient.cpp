#include "barycert/core/quotient.hpp"

namespace barycert {
namespace {

/// Rounds (q + t) * 2^exponent, 0 <= t < 1, where t > 0 exactly if `inexact`. Precondition: q >= 2^62.
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

}  // namespace

double round_quotient(const Integer& numerator, const Integer& denominator, int exponent) {
    if (numerator.sign() == 0) return 0.0;
    const bool negative = numerator.sign() != denominator.sign();
    // Shift both so that the divisor fills its k limbs to the last bit and the dividend has 64 k + 63 bits: then
    // 2^62 < quotient < 2^64, one digit in base 2^64.
    const int filled = (std::max(denominator.bit_length(), numerator.bit_length() - 63) + 63) / 64 * 64;
    const Integer divisor = denominator.shifted_left(filled - denominator.bit_length());
    const int dividend_shift = filled + 63 - numerator.bit_length();
    const Integer dividend = numerator.shifted_left(dividend_shift);
    const int k = filled / 64;

    // The leading two limbs over the leading one: never below the true digit and at most 2 above it (Knuth, The Art of
    // Computer Programming 2, 4.3.1, theorem B: the divisor's leading bit is set).
    const UInt128 leading = static_cast<UInt128>(dividend.limb(k)) << 64 | dividend.limb(k - 1);
    std::uint64_t q = static_cast<std::uint64_t>(leading / divisor.limb(k - 1));  // fits: dividend.limb(k) < 2^63
    const Integer product = divisor * Integer(false, q, 0);
    Integer remainder = (dividend.sign() < 0 ? -dividend : dividend) - (divisor.sign() < 0 ? -product : product);
    while (remainder.sign() < 0) {
        --q;
        remainder = divisor.sign() < 0 ? remainder - divisor : remainder + divisor;
    }
    return round_bits(negative, q, remainder.sign() != 0,
                      exponent + (filled - denominator.bit_length()) - dividend_shift);
}

double round_integer(const Integer& number, int exponent) {
    if (number.sign() == 0) return 0.0;
    const int shift = 64 - number.bit_length();
    if (shift >= 0) return round_bits(number.sign() < 0, number.limb(0) << shift, false, exponent - shift);
    const int whole = -shift / 64, part = -shift % 64;
    std::uint64_t q = number.limb(whole) >> part;
    if (part != 0) q |= number.limb(whole + 1) << (64 - part);
    bool inexact = (number.limb(whole) & ((std::uint64_t{1} << part) - 1)) != 0;
    for (int i = 0; i < whole && !inexact; ++i) inexact = number.limb(i) != 0;
    return round_bits(number.sign() < 0, q, inexact, exponent - shift);
}

}  // namespace barycert
