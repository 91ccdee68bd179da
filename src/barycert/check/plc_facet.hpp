/// A facet of a PLC as a region of its plane.
#pragma once

#include "barycert/check/stages.hpp"

namespace barycert::check {

/// The polygons of a facet, projected along the axis on which its normal is largest. Its region is what lies in them
/// but in holes, as for TetGen: a ring is a hole if one of the facet's hole points lies in it, and of rings one in
/// another the smallest decides. Rings inside that are no holes only cut the region.
///
/// Plain geometry works in a unit of 2^exponent, relative to a vertex, so that nothing over- or underflows; what is
/// said to be exact works on the coordinates as they are.
class PlcRegion {
public:
    using PlcPosition = std::array<double, 2>;
    struct Ring {
        std::vector<const double*> points;
        std::vector<PlcPosition> at;  ///< place() of each
        bool hole = false;
        double area = 0;  ///< projected, in the unit
        int counts = 0;   ///< +1 its area is part of the region, -1 it is taken off, 0 another ring's has it
    };

    PlcRegion(const Plc& plc, const PlcFacet& facet, int exponent);

    /// It has an area.
    bool proper() const { return proper_; }
    const std::vector<Ring>& rings() const { return rings_; }

    /// The two axes of the projection.
    std::array<std::size_t, 2> axes() const { return {(axis_ + 1) % 3, (axis_ + 2) % 3}; }

    /// Distance of a point from the plane, in the unit; and whether it is exactly zero.
    double distance(const double* p) const;
    bool in_plane(const double* p) const;

    /// A place, relative and projected, lies in the region.
    PlcPosition place(const double* p) const;
    bool holds(const PlcPosition& p) const;

    /// How a side of a face passes the sides of the rings: properly across none, across one within `slack` of an end of
    /// either, or else deeply. The first is exact.
    enum class Crossing : unsigned char { none, shallow, deep };
    Crossing crossing(const double* a, const double* b, double slack) const;

    /// The part of the region's area that the triangle has in common with it, in plain double.
    double covered_by(const std::array<const double*, 3>& triangle) const;

    Box box(double margin) const;

private:
    std::array<double, 3> relative(const double* p) const;
    bool in_ring(const Ring& ring, const PlcPosition& p) const;
    const Ring* innermost(const PlcPosition& p, const Ring* but) const;
    PlcPosition inner_place(const Ring& ring) const;
    void set_plane();
    void set_holes(const PlcFacet& facet);

    std::vector<Ring> rings_;
    int exponent_;
    std::array<double, 3> normal_{};        ///< of length 1
    std::array<const double*, 3> plane_{};  ///< three vertices that span it
    bool proper_ = false;
    std::size_t axis_ = 2;
};

}  // namespace barycert::check
