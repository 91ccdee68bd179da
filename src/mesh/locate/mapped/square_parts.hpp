/// Where on a patch can the nearest point be? The square of the distance over the patch, in Bernstein form, on smaller
/// and smaller parts of it: no value on a part is below its least coefficient.
///
/// Squares are less that of the distance to a place o, as in near_bounds.hpp: with y = X - o
///   |p - X|^2 - |p - o|^2 = y.y + 2 y.(o - p).
/// They are computed in Real, of 53 bits or more. With S the sum of the sizes of the coefficients of y in monomials and
/// W the largest of |o - p|, all numbers on the way are at most S^2 + 2 S W: Bernstein coefficients are means of values
/// (factors of at most 1 in at most 45 terms), halves of parts are means again. Each number comes from fewer than 2^9
/// roundings, and 2^10 where parts are cut 64 times: 2^-40 of that bound holds for all.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/isoparametric/patch.hpp"
#include "mesh/index/box_tree.hpp"
#include "mesh/locate/near_bounds.hpp"
#include "mesh/locate/near_feature.hpp"

namespace barycert::locate {

/// y, and from it the square, of a patch.
class SquareOfDistance {
public:
    static constexpr std::size_t degrees = 9;
    using Coefficients = std::array<std::array<Real, degrees>, degrees>;

    SquareOfDistance(const core::isoparametric::Patch& patch, const Point3& p, const Point3& o);

    /// How much any of its numbers may be off.
    Real error() const { return error_; }
    Real at(const core::isoparametric::Params<double>& x) const;
    std::size_t degree() const { return degree_; }
    /// In Bernstein form over the patch: [i][j] of a triangle's corners 1 and 2, or of degrees i and j.
    Coefficients bernstein() const;

private:
    const core::isoparametric::PatchBasis& basis_;
    core::isoparametric::PatchKind kind_;
    std::array<std::vector<Real>, 3> y_;  ///< by terms
    Real3 from_{};                        ///< o - p
    Real error_ = 0;
    std::size_t degree_;  ///< of the square: in all, or of a square patch in each variable
};

/// A part of a patch: an interval, a triangle, or a rectangle between two of its corners.
struct SquarePart {
    core::isoparametric::PatchKind kind{};
    std::size_t degree = 0;
    SquareOfDistance::Coefficients b{};
    std::array<core::isoparametric::Params<double>, 3> corner{};  ///< of a rectangle the lowest and the highest

    explicit SquarePart(const SquareOfDistance& of, core::isoparametric::PatchKind kind);
    SquarePart() = default;

    Real least() const;
    Real most() const;
    /// The corner with the least value.
    core::isoparametric::Params<double> lowest_corner(Real& value) const;
    core::isoparametric::Params<double> middle() const;
    double width() const;
    /// Certainly no derivative vanishes there, along some direction.
    bool slopes(Real error) const;
    /// Within a box around x.
    bool within(const core::isoparametric::Params<double>& x, double radius) const;
    /// Cut in the middle of the longest edge.
    std::array<SquarePart, 2> halves() const;

private:
    template <class Use>
    void for_each(Use use) const;
    bool slopes_in_triangle(Real error) const;
    bool slopes_in_rectangle(Real error) const;
};

/// A box of the patch.
index::Box box_of_patch(const core::isoparametric::Patch& patch);

}  // namespace barycert::locate
