#include "barycert/check/plc_facet.hpp"

#include "barycert/base/vectors.hpp"

#include <algorithm>
#include <cmath>

namespace barycert::check {
namespace {

using Vector = base::Vector3<double>;
using PlcPosition = PlcRegion::PlcPosition;
using base::cross;
using base::minus;

double length(const Vector& v) {
    return std::hypot(v[0], v[1], v[2]);
}
double cross(const PlcPosition& o, const PlcPosition& a, const PlcPosition& b) {
    return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

/// Distance of p from the segment ab.
double distance_from(const PlcPosition& p, const PlcPosition& a, const PlcPosition& b) {
    const double x = b[0] - a[0], y = b[1] - a[1], square = x * x + y * y;
    const double t = square > 0 ? std::clamp(((p[0] - a[0]) * x + (p[1] - a[1]) * y) / square, 0.0, 1.0) : 0;
    return std::hypot(a[0] + t * x - p[0], a[1] + t * y - p[1]);
}

/// Twice the area that a convex polygon has in common with a triangle; negative if this one turns clockwise. Sides of
/// the triangle cut it, one after the other.
double common_area(std::vector<PlcPosition> polygon, const std::array<PlcPosition, 3>& t) {
    const double turn = cross(t[0], t[1], t[2]) < 0 ? -1 : 1;
    for (std::size_t k = 0; k < 3; ++k) {
        std::vector<PlcPosition> left;
        for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
            const PlcPosition &p = polygon[j], &q = polygon[i];
            const double from = turn * cross(t[k], t[(k + 1) % 3], p), to = turn * cross(t[k], t[(k + 1) % 3], q);
            const double s = from / (from - to);
            if ((from > 0) != (to > 0)) left.push_back({p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])});
            if (to > 0) left.push_back(q);
        }
        polygon = std::move(left);
    }
    double twice = 0;
    for (std::size_t i = 2; i < polygon.size(); ++i) twice += cross(polygon[0], polygon[i - 1], polygon[i]);
    return turn * std::fabs(twice);
}

}  // namespace

PlcRegion::PlcRegion(const Plc& plc, const PlcFacet& facet, int exponent) : exponent_(exponent) {
    for (const auto& polygon : facet.polygons) {
        if (polygon.size() < 3) continue;
        Ring ring;
        for (const auto node : polygon) ring.points.push_back(&plc.points[static_cast<std::size_t>(node) * 3]);
        rings_.push_back(std::move(ring));
    }
    if (rings_.empty()) return;
    set_plane();
    if (proper_) set_holes(facet);
}

/// Less the first vertex. Halved first: a difference may overflow.
Vector PlcRegion::relative(const double* p) const {
    const double* const o = rings_.front().points.front();
    Vector v{};
    for (std::size_t k = 0; k < 3; ++k) v[k] = std::scalbn(p[k] / 2 - o[k] / 2, 1 - exponent_);
    return v;
}

PlcPosition PlcRegion::place(const double* p) const {
    const Vector v = relative(p);
    return {v[axes()[0]], v[axes()[1]]};
}

/// The plane through the widest triangle, at the first vertex of a ring, of all rings.
void PlcRegion::set_plane() {
    double widest = 0;
    for (const Ring& ring : rings_) {
        const Vector o = relative(ring.points.front());
        const auto from = [&](const double* p) { return minus(relative(p), o); };
        const double* const a =
            *std::max_element(ring.points.begin(), ring.points.end(),
                              [&](const double* p, const double* q) { return length(from(p)) < length(from(q)); });
        const double* const b =
            *std::max_element(ring.points.begin(), ring.points.end(), [&](const double* p, const double* q) {
                return length(cross(from(a), from(p))) < length(cross(from(a), from(q)));
            });
        const Vector normal = cross(from(a), from(b));
        if (length(normal) <= widest) continue;
        widest = length(normal);
        normal_ = normal;
        plane_ = {ring.points.front(), a, b};
    }
    proper_ = widest > 0;
    if (!proper_) return;
    for (double& x : normal_) x /= widest;
    for (std::size_t k = 0; k < 3; ++k) {
        if (std::fabs(normal_[k]) > std::fabs(normal_[axis_])) axis_ = k;
    }
}

void PlcRegion::set_holes(const PlcFacet& facet) {
    for (Ring& ring : rings_) {
        for (const double* p : ring.points) ring.at.push_back(place(p));
        double twice = 0;
        for (std::size_t i = 0, j = ring.at.size() - 1; i < ring.at.size(); j = i++)
            twice += cross(ring.at.front(), ring.at[j], ring.at[i]);
        ring.area = std::fabs(twice) / 2;
    }
    for (std::size_t i = 0; i + 2 < facet.holes.size(); i += 3) {
        const Ring* const ring = innermost(place(&facet.holes[i]), nullptr);
        for (Ring& r : rings_) r.hole = r.hole || &r == ring;
    }
    for (Ring& ring : rings_) {
        const Ring* const around = innermost(inner_place(ring), &ring);
        const bool filled = around != nullptr && !around->hole;
        ring.counts = ring.hole == filled ? (ring.hole ? -1 : 1) : 0;
    }
}

/// Inside the ring: at its lowest corner, which is convex, between it and what of the ring lies deepest in the triangle
/// with its neighbours, or in the middle of that triangle.
PlcPosition PlcRegion::inner_place(const Ring& ring) const {
    const std::vector<PlcPosition>& at = ring.at;
    const auto n = at.size();
    const auto corner = static_cast<std::size_t>(std::min_element(at.begin(), at.end()) - at.begin());
    const PlcPosition &v = at[corner], &a = at[(corner + n - 1) % n], &b = at[(corner + 1) % n];
    const double turn = cross(a, v, b) < 0 ? -1 : 1;
    const PlcPosition* deepest = nullptr;
    double depth = 0;
    for (const PlcPosition& p : at) {
        if (turn * cross(a, v, p) <= 0 || turn * cross(v, b, p) <= 0 || turn * cross(b, a, p) <= 0) continue;
        if (turn * cross(b, a, p) <= depth) continue;
        depth = turn * cross(b, a, p);
        deepest = &p;
    }
    if (deepest != nullptr) return {(v[0] + (*deepest)[0]) / 2, (v[1] + (*deepest)[1]) / 2};
    return {(a[0] + v[0] + b[0]) / 3, (a[1] + v[1] + b[1]) / 3};
}

double PlcRegion::distance(const double* p) const {
    const Vector v = minus(relative(p), relative(plane_[0]));
    return std::fabs(normal_[0] * v[0] + normal_[1] * v[1] + normal_[2] * v[2]);
}

bool PlcRegion::in_plane(const double* p) const {
    return orient3d(plane_[0], plane_[1], plane_[2], p) == Sign::zero;
}

bool PlcRegion::in_ring(const Ring& ring, const PlcPosition& p) const {
    bool inside = false;
    for (std::size_t i = 0, j = ring.at.size() - 1; i < ring.at.size(); j = i++) {
        const PlcPosition &a = ring.at[i], &b = ring.at[j];
        // A ray along the first axis crosses the side ab.
        if ((a[1] > p[1]) != (b[1] > p[1]) && p[0] < (b[0] - a[0]) * ((p[1] - a[1]) / (b[1] - a[1])) + a[0])
            inside = !inside;
    }
    return inside;
}

const PlcRegion::Ring* PlcRegion::innermost(const PlcPosition& p, const Ring* but) const {
    const Ring* found = nullptr;
    for (const Ring& ring : rings_) {
        if (&ring != but && (found == nullptr || ring.area < found->area) &&
            (but == nullptr || ring.area > but->area || (ring.area == but->area && &ring < but)) && in_ring(ring, p))
            found = &ring;
    }
    return found;
}

bool PlcRegion::holds(const PlcPosition& p) const {
    const Ring* const ring = innermost(p, nullptr);
    return ring != nullptr && !ring->hole;
}

PlcRegion::Crossing PlcRegion::crossing(const double* a, const double* b, double slack) const {
    const auto [x, y] = axes();
    const auto projected = [x = x, y = y](const double* p) { return std::array<double, 2>{p[x], p[y]}; };
    const auto pa = projected(a), pb = projected(b);
    Crossing worst = Crossing::none;
    for (const Ring& ring : rings_) {
        for (std::size_t i = 0, j = ring.points.size() - 1; i < ring.points.size(); j = i++) {
            const double *const c = ring.points[i], *const d = ring.points[j];
            const auto pc = projected(c), pd = projected(d);
            if (std::max(pa[0], pb[0]) < std::min(pc[0], pd[0]) || std::min(pa[0], pb[0]) > std::max(pc[0], pd[0]))
                continue;
            const auto turn = [](const auto& u, const auto& v, const auto& w) {
                return orient2d(u.data(), v.data(), w.data());
            };
            if (turn(pa, pb, pc) * turn(pa, pb, pd) != Sign::negative ||
                turn(pc, pd, pa) * turn(pc, pd, pb) != Sign::negative)
                continue;
            const PlcPosition u = place(a), v = place(b), &w = ring.at[i], &z = ring.at[j];
            const double nearest = std::min(
                {distance_from(u, w, z), distance_from(v, w, z), distance_from(w, u, v), distance_from(z, u, v)});
            if (nearest > slack) return Crossing::deep;
            worst = Crossing::shallow;
        }
    }
    return worst;
}

double PlcRegion::covered_by(const std::array<const double*, 3>& triangle) const {
    const std::vector<PlcPosition> face{place(triangle[0]), place(triangle[1]), place(triangle[2])};
    double common = 0, whole = 0;
    for (const Ring& ring : rings_) {
        // A ring is a fan of triangles, those that turn the other way taken off.
        double twice = 0;
        for (std::size_t i = 2; i < ring.at.size() && ring.counts != 0; ++i)
            twice += common_area(face, {ring.at.front(), ring.at[i - 1], ring.at[i]});
        common += ring.counts * std::fabs(twice) / 2;
        whole += ring.counts * ring.area;
    }
    return common / whole;
}

Box PlcRegion::box(double margin) const {
    const double* const o = rings_.front().points.front();
    Box box{{o[0], o[1], o[2]}, {o[0], o[1], o[2]}};
    for (const Ring& ring : rings_) {
        for (const double* p : ring.points) box.add({{p[0], p[1], p[2]}, {p[0], p[1], p[2]}});
    }
    for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] -= margin;
        box.high[k] += margin;
    }
    return box;
}

}  // namespace barycert::check
