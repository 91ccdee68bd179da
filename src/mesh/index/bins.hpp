/// Coordinates as integers, and a space-filling curve through the bins of a box.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace barycert::index {

/// Maps each axis of a box onto integers of 31 bits. The map is monotone: x <= y gives at(k, x) <= at(k, y), whatever
/// is rounded, because halving, subtracting, multiplying by a positive number, cutting off and clamping all are. So
/// what lies in a box lies in its image, and comparing images excludes no cell that holds a point.
class Quantizer {
public:
    static constexpr int bits = 31;
    static constexpr std::int32_t max = std::numeric_limits<std::int32_t>::max();

    Quantizer() = default;

    /// Requires: the box from low to high, d coordinates each, is finite and ordered.
    Quantizer(std::size_t d, const double* low, const double* high) {
        for (std::size_t k = 0; k < d; ++k) {
            half_low_[k] = low[k] * 0.5;
            // Halves, for the difference of two doubles may be none.
            const double half = high[k] * 0.5 - half_low_[k];
            const double scale = static_cast<double>(max) / half;  // the clamp takes what rounding puts above
            scale_[k] = half > 0 ? std::min(scale, std::numeric_limits<double>::max()) : 0;
        }
    }

    /// Requires: x is finite.
    std::int32_t at(std::size_t k, double x) const {
        return static_cast<std::int32_t>(std::clamp(before_rounding(k, x), 0.0, static_cast<double>(max)));
    }

    /// The number that at() rounds down: (x / 2 - half_low) * scale, rounded as written.
    double before_rounding(std::size_t k, double x) const { return (x * 0.5 - half_low_[k]) * scale_[k]; }
    double half_low(std::size_t k) const { return half_low_[k]; }
    double scale(std::size_t k) const { return scale_[k]; }

private:
    std::array<double, 3> half_low_{}, scale_{};
};

/// The axes along which a box of d dimensions is halved, one after the other, for about `bins` of them, at most 2^27:
/// that of the longest side of a bin each time, so bins are as near to cubes as can be.
std::vector<std::size_t> halved_axes(std::size_t d, const double* low, const double* high, std::size_t bins);

/// A box cut into 2^bits bins along its `halved_axes`, in the order of Morton's curve.
class Bins {
public:
    /// One bin, for everything.
    Bins() = default;

    /// About `bins` of them.
    Bins(std::size_t d, const double* low, const double* high, std::size_t bins);

    const Quantizer& quantizer() const { return quantizer_; }
    std::size_t count() const { return std::size_t{1} << bits_; }
    int bits() const { return bits_; }

    /// The steps of `of` on axis k: the table entry of a coordinate's whole number without its last `shift` bits.
    int shift(std::size_t k) const { return shift_[k]; }
    const std::uint32_t* curve(std::size_t k) const { return curve_[k].data(); }

    /// The bin of a point with d coordinates, d as given; the nearest one of a point outside the box.
    std::uint32_t of(const double* point) const {
        std::uint32_t bin = 0;
        for (std::size_t k = 0; k < d_; ++k)
            bin |= curve_[k][static_cast<std::size_t>(quantizer_.at(k, point[k]) >> shift_[k])];
        return bin;
    }

    /// The bin of a point given in whole numbers of the quantizer.
    template <class T, std::size_t d>
    std::uint32_t of_quantized(const std::array<T, d>& point) const {
        std::uint32_t bin = 0;
        for (std::size_t k = 0; k < d; ++k) bin |= curve_[k][static_cast<std::size_t>(point[k] >> shift_[k])];
        return bin;
    }

private:
    Quantizer quantizer_;
    std::size_t d_ = 0;
    int bits_ = 0;
    std::array<int, 3> shift_{Quantizer::bits, Quantizer::bits, Quantizer::bits};
    using Curve = std::vector<std::uint32_t>;
    std::array<Curve, 3> curve_{Curve(1), Curve(1),
                                Curve(1)};  ///< by place on the axis: its bits where they stand in a bin
};

}  // namespace barycert::index
