/// Internal: a facet of a PLC as a region of its plane.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "barycert/check/box_tree.hpp"
#include "barycert/plc/plc.hpp"

namespace barycert::check {

/// Rings of the facet, projected along the axis on which its normal is largest; inside by the even-odd rule.
class PlcRegion {
public:
    PlcRegion(const Plc& plc, const PlcFacet& facet);

    /// It has an area.
    bool proper() const { return length_ > 0; }

    /// Distance of a point from the plane, in plain double, and whether it is exactly zero.
    double distance(const double* p) const;
    bool in_plane(const double* p) const;

    /// A point, projected, is inside the rings: plain double, for points that are not close to them.
    bool holds(const double* p) const;

    Box box(double margin) const;

    /// The two axes of the projection.
    std::array<std::size_t, 2> axes() const { return {(axis_ + 1) % 3, (axis_ + 2) % 3}; }

    struct Ring {
        std::vector<const double*> points;
        bool hole = false;  ///< inside an odd number of other rings
    };
    const std::vector<Ring>& rings() const { return rings_; }

private:
    bool in_ring(const Ring& ring, const double* p) const;

    std::vector<Ring> rings_;
    std::array<double, 3> normal_{};        ///< of length 1
    std::array<const double*, 3> plane_{};  ///< three vertices that span it
    double length_ = 0;
    std::size_t axis_ = 2;
};

}  // namespace barycert::check
