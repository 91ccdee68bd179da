/// Volumes of simplices as exact integers.
#pragma once

#include <span>

#include "core/integer.hpp"
#include "core/scaled_double.hpp"

namespace barycert::index {

using core::Integer;

/// Signed volumes (areas in 2D) of the simplices of one mesh, as exact integers in one unit.
///
/// All coordinates of an axis become multiples of the largest power of two that divides them all, so volumes of
/// different cells can be added up and compared exactly. As narrow integers as the whole mesh needs are used: one limb
/// a coordinate if none needs more than 61 bits, two for 125, else as many as it takes.
class ExactVolumes {
public:
    /// `points` holds d coordinates a node; what is not finite is left out, and must not be asked for.
    ExactVolumes(int d, std::span<const double> points);

    /// d! times the signed volume of the cell with d + 1 corners at p[0], p[1], ...: det(p1 - p0, p2 - p0, ...).
    Integer cell(const double* const* p) const { return determinant_from(p + 1, p[0]); }

    /// d! times the signed volume of the cone from the origin over the facet with d corners: det(p0, p1, ...).
    Integer cone(const double* const* p) const { return determinant_from(p, nullptr); }

    /// The integers from above count 2^unit().
    int unit() const { return exponent_; }

    /// floor(log2) of the volume that `n` from above stands for, to within d. Requires: not zero.
    int exponent(const Integer& n) const;

    /// The volume that `n` from above stands for, divided by 2^(d * scale), correctly rounded.
    double rounded(const Integer& n, int scale = 0) const;

private:
    Integer determinant_from(const double* const* p, const double* origin) const;

    int d_;
    int bits_ = 0;  ///< of the widest coordinate
    core::Unit units_[3];
    int exponent_ = 0;  ///< the integers count 2^exponent_
};

}  // namespace barycert::index
