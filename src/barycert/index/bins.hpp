/// A space-filling curve through the bins of a box.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "barycert/index/quantizer.hpp"

namespace barycert::index {

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

    /// What `of` does on axis k: the table entry of a coordinate's whole number without its last `shift` bits.
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
