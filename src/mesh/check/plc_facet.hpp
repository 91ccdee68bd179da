/// A facet of a PLC as a region of its plane.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/plc.hpp"
#include "barycert/predicates.hpp"
#include "core/base/vectors.hpp"
#include "mesh/check/stages.hpp"  // IWYU pragma: keep
#include "mesh/facets/facet_triangles.hpp"
#include "mesh/index/box_tree.hpp"

namespace barycert::check {

/// The polygons of a facet, projected along the axis on which its normal is largest. Its region is what its triangles
/// fill (mesh/facets/facet_triangles.hpp): none if its polygons cross each other.
///
/// Plain geometry works in a unit of 2^exponent, relative to a vertex, so that nothing over- or underflows; what is
/// said to be exact works on the coordinates as they are.
class PlcRegion {
public:
    using PlcPosition = std::array<double, 2>;
    using Triangle = std::array<const double*, 3>;

    PlcRegion(const Plc& plc, const PlcFacet& facet, int exponent) : exponent_(exponent) {
        const auto point = [&](Mesh::Index node) { return &plc.points[static_cast<std::size_t>(node) * 3]; };
        for (const auto& polygon : facet.polygons) {
            if (polygon.size() < 3) continue;
            std::vector<const double*>& ring = rings_.emplace_back();
            for (const auto node : polygon) ring.push_back(point(node));
            vertices_.insert(vertices_.end(), ring.begin(), ring.end());
        }
        if (rings_.empty()) return;
        set_plane();
        if (!proper_) return;
        for (const auto& [a, b, c] : surface::triangles_of_facet(plc.points, facet.polygons, facet.holes).triangles) {
            triangles_.push_back({point(a), point(b), point(c)});
            area_ += std::fabs(twice_area(places(triangles_.back())));
        }
    }

    /// It has an area.
    bool proper() const { return proper_; }
    const std::vector<Triangle>& triangles() const { return triangles_; }
    /// The vertices of all rings, one ring after the other.
    const std::vector<const double*>& vertices() const { return vertices_; }

    /// The two axes of the projection.
    std::array<std::size_t, 2> axes() const { return {(axis_ + 1) % 3, (axis_ + 2) % 3}; }

    /// Distance of a point from the plane, in the unit; and whether it is exactly zero.
    double distance(const double* p) const {
        return std::fabs(base::dot(normal_, base::minus(relative(p), relative(plane_[0]))));
    }
    bool in_plane(const double* p) const { return orient3d(plane_[0], plane_[1], plane_[2], p) == Sign::zero; }

    /// A place, relative and projected, lies in the region.
    PlcPosition place(const double* p) const {
        const Vector v = relative(p);
        return {v[axes()[0]], v[axes()[1]]};
    }
    bool holds(const PlcPosition& p) const {
        return std::ranges::any_of(triangles_, [&](const Triangle& t) {
            const std::vector<PlcPosition> at = places(t);
            const double turn = twice_area(at) < 0 ? -1 : 1;
            return turn * twice_area(at[0], at[1], p) >= 0 && turn * twice_area(at[1], at[2], p) >= 0 &&
                   turn * twice_area(at[2], at[0], p) >= 0;
        });
    }

    /// How deeply a side of a face passes the sides of the rings: -1 if it is properly across none, which is exact;
    /// else the distance of a crossing from the nearest end of either, the largest of all.
    double crossing(const double* a, const double* b) const {
        const std::array<std::size_t, 2> axis = axes();
        const auto projected = [&](const double* p) { return std::array<double, 2>{p[axis[0]], p[axis[1]]}; };
        const auto turn = [](const auto& u, const auto& v, const auto& w) {
            return orient2d(u.data(), v.data(), w.data());
        };
        const auto pa = projected(a), pb = projected(b);
        double deepest = -1;
        for (const auto& ring : rings_) {
            for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
                const double *const c = ring[i], *const d = ring[j];
                const auto pc = projected(c), pd = projected(d);
                if (std::max(pa[0], pb[0]) < std::min(pc[0], pd[0]) || std::min(pa[0], pb[0]) > std::max(pc[0], pd[0]))
                    continue;
                if (turn(pa, pb, pc) * turn(pa, pb, pd) != Sign::negative ||
                    turn(pc, pd, pa) * turn(pc, pd, pb) != Sign::negative)
                    continue;
                const PlcPosition u = place(a), v = place(b), w = place(c), z = place(d);
                deepest = std::max(deepest, 0.0);  // whatever the distances below, which are rounded
                deepest = std::max(deepest, std::min({distance_from(u, w, z), distance_from(v, w, z),
                                                      distance_from(w, u, v), distance_from(z, u, v)}));
            }
        }
        return deepest;
    }

    /// The part of the region's area that the triangle has in common with it, in plain double.
    double covered_by(const Triangle& face) const {
        double twice = 0;
        for (const Triangle& t : triangles_) twice += common_area(places(face), places(t));
        return twice / area_;
    }

    Box box(double margin) const {
        Box box = box_of(3, vertices_.data(), static_cast<int>(vertices_.size()));
        for (double& x : box.low) x -= margin;
        for (double& x : box.high) x += margin;
        return box;
    }

private:
    using Vector = base::Vector3<double>;

    static double length(const Vector& v) { return std::hypot(v[0], v[1], v[2]); }
    static double twice_area(const PlcPosition& o, const PlcPosition& a, const PlcPosition& b) {
        return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
    }

    static double twice_area(const std::vector<PlcPosition>& polygon) {
        double twice = 0;
        for (std::size_t i = 2; i < polygon.size(); ++i) twice += twice_area(polygon[0], polygon[i - 1], polygon[i]);
        return twice;
    }

    /// Distance of p from the segment ab.
    static double distance_from(const PlcPosition& p, const PlcPosition& a, const PlcPosition& b) {
        const double x = b[0] - a[0], y = b[1] - a[1], square = x * x + y * y;
        const double t = square > 0 ? std::clamp(((p[0] - a[0]) * x + (p[1] - a[1]) * y) / square, 0.0, 1.0) : 0;
        return std::hypot(a[0] + t * x - p[0], a[1] + t * y - p[1]);
    }

    /// Twice the area that a convex polygon has in common with a triangle, whose sides cut it, one after the other.
    static double common_area(std::vector<PlcPosition> polygon, const std::vector<PlcPosition>& t) {
        const double turn = twice_area(t) < 0 ? -1 : 1;
        for (std::size_t k = 0; k < 3; ++k) {
            std::vector<PlcPosition> left;
            for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
                const PlcPosition &p = polygon[j], &q = polygon[i];
                const double from = turn * twice_area(t[k], t[(k + 1) % 3], p),
                             to = turn * twice_area(t[k], t[(k + 1) % 3], q);
                const double s = from / (from - to);
                if ((from > 0) != (to > 0)) left.push_back({p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])});
                if (to > 0) left.push_back(q);
            }
            polygon = std::move(left);
        }
        return std::fabs(twice_area(polygon));
    }

    /// Less the first vertex. Halved first: a difference may overflow.
    Vector relative(const double* p) const {
        const double* const o = vertices_.front();
        Vector v{};
        for (std::size_t k = 0; k < 3; ++k) v[k] = std::scalbn(p[k] / 2 - o[k] / 2, 1 - exponent_);
        return v;
    }

    /// The plane through the widest triangle, at the first vertex of a ring, of all rings.
    void set_plane() {
        double widest = 0;
        for (const auto& ring : rings_) {
            const Vector o = relative(ring.front());
            const auto from = [&](const double* p) { return base::minus(relative(p), o); };
            const double* const a = *std::ranges::max_element(ring, {}, [&](auto p) { return length(from(p)); });
            const double* const b =
                *std::ranges::max_element(ring, {}, [&](auto p) { return length(base::cross(from(a), from(p))); });
            const Vector normal = base::cross(from(a), from(b));
            if (length(normal) <= widest) continue;
            widest = length(normal);
            normal_ = normal;
            plane_ = {ring.front(), a, b};
        }
        proper_ = widest > 0;
        if (!proper_) return;
        for (double& x : normal_) x /= widest;
        for (std::size_t k = 0; k < 3; ++k) {
            if (std::fabs(normal_[k]) > std::fabs(normal_[axis_])) axis_ = k;
        }
    }

    std::vector<PlcPosition> places(const Triangle& t) const { return {place(t[0]), place(t[1]), place(t[2])}; }

    std::vector<std::vector<const double*>> rings_;
    std::vector<const double*> vertices_;
    std::vector<Triangle> triangles_;
    double area_ = 0;  ///< twice that of the region, projected, in the unit
    int exponent_;
    Vector normal_{};                       ///< of length 1
    std::array<const double*, 3> plane_{};  ///< three vertices that span it
    bool proper_ = false;
    std::size_t axis_ = 2;
};

}  // namespace barycert::check
