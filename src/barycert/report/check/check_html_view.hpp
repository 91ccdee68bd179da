/// Cells of a mesh as points that can be drawn, and the directions to draw them from.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert::report {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b);
Vector cross(const Vector& a, const Vector& b);
Vector minus(const Vector& a, const Vector& b);
Vector unit(const Vector& a);  ///< or any unit vector, if `a` is zero

/// True if all corners are nodes and have finite coordinates.
bool drawable(const Mesh& mesh, std::size_t cell);

/// Points in a box of edge 2 around the origin, whatever their coordinates: their differences, rounded, as large as
/// they go. In 2D z = 0.
class Normalised {
public:
    /// Of `d` coordinates each.
    Normalised(int d, const std::vector<const double*>& points);

    const std::vector<Vector>& points() const { return points_; }
    Vector place(const double* point) const;  ///< of a further point, mapped alike

private:
    int d_;
    Vector low_{};     // corner of their box
    Vector middle_{};  // of half their box, from there, in units of 2^exponent_
    int exponent_ = 0;
    double extent_ = 0;  // half of the largest one, in the same unit
    std::vector<Vector> points_;
};

/// An orthographic projection: x to the right, y up on the paper, z towards the eye.
struct View {
    Vector x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    Vector operator()(const Vector& p) const { return {dot(p, x), dot(p, y), dot(p, z)}; }
};

/// Directions of largest, middle and least extent of the points, orthonormal (principal axes).
std::array<Vector, 3> extents(const std::vector<Vector>& points);

/// From where the points are broadest, and from the side, along their middle extent.
View from_above(const std::vector<Vector>& points);
View from_the_side(const std::vector<Vector>& points);

/// The edge of a tetrahedron with the smallest dihedral angle, as two corners.
std::array<std::size_t, 2> sharpest_edge(const std::vector<Vector>& tetrahedron);

/// Along an edge of a tetrahedron, which so is a point, and its angle opens to the right.
View along_edge(const std::vector<Vector>& tetrahedron, std::array<std::size_t, 2> edge);

/// From somewhat above and aside, z upwards.
View oblique();

}  // namespace barycert::report
