/// Seeded random numbers that are the same on every machine; hashes of words, texts and places.
///
/// The standard library's distributions differ between implementations, so both the generator and the maps to
/// doubles stand here. Counter-based use: stream(seed, a, b) is independent of every other (a, b), so that case
/// number b of family a can be made alone, in any order, on any thread.
/// Source: S. Vigna, G. Steele, D. Lea, "Fast splittable pseudorandom number generators", OOPSLA 2014 (SplitMix64).
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace barycert::base {

/// The finaliser of SplitMix64: a bijection of 64-bit words whose output bits all depend on all input bits.
constexpr std::uint64_t mix64(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
}

/// A 64-bit hash of a name (FNV-1a, then mixed).
constexpr std::uint64_t hash64(std::string_view text) {
    std::uint64_t h = 0xcbf29ce484222325ULL;
    for (const char c : text) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
    return mix64(h);
}

/// A place as the key of a table: the bits of up to three coordinates. Zeros of either sign are one place.
using PointBits = std::array<std::uint64_t, 3>;
inline PointBits bits_of_point(const double* point, std::size_t dimension = 3) {
    PointBits bits{};
    for (std::size_t k = 0; k < dimension; ++k) bits[k] = std::bit_cast<std::uint64_t>(point[k] + 0.0);
    return bits;
}
struct HashOfBits {
    std::size_t operator()(const PointBits& x) const { return mix64(mix64(mix64(x[0]) ^ x[1]) ^ x[2]); }
};

class Random {
public:
    explicit constexpr Random(std::uint64_t seed) : state_(seed) {}

    static constexpr Random stream(std::uint64_t seed, std::uint64_t a, std::uint64_t b) {
        return Random(mix64(mix64(mix64(seed + golden) ^ a) + b * golden));
    }

    constexpr std::uint64_t bits() { return mix64(state_ += golden); }

    /// A multiple of 2^-53 in [0, 1).
    constexpr double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

    /// fl(lo + (hi - lo) * unit()).
    double uniform(double lo, double hi);

    /// An integer in [0, n), n >= 1. The bias is below n / 2^64.
    constexpr std::uint64_t below(std::uint64_t n) {
        return static_cast<std::uint64_t>((static_cast<Wide>(bits()) * n) >> 64);
    }

    constexpr int integer(int lo, int hi) {
        return lo + static_cast<int>(below(static_cast<std::uint64_t>(hi - lo) + 1));
    }

    /// uniform(lo, hi) * 2^k, k an integer in [low, high]. (Two draws in one expression would have no fixed order.)
    double scaled(double lo, double hi, int low, int high);

    constexpr bool coin() { return (bits() >> 63) != 0; }

private:
    __extension__ using Wide = unsigned __int128;
    static constexpr std::uint64_t golden = 0x9e3779b97f4a7c15ULL;
    std::uint64_t state_;
};

}  // namespace barycert::base
