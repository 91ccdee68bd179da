#include "barycert/check/plc_facet.hpp"

#include <algorithm>
#include <cmath>

#include "barycert/core/predicates.hpp"

namespace barycert::check {
namespace {

using Vector = std::array<double, 3>;

Vector cross(const double* o, const double* a, const double* b) {
    const double u[] = {a[0] - o[0], a[1] - o[1], a[2] - o[2]}, v[] = {b[0] - o[0], b[1] - o[1], b[2] - o[2]};
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

double length(const Vector& v) {
    return std::hypot(v[0], v[1], v[2]);
}

}  // namespace

PlcRegion::PlcRegion(const Plc& plc, const PlcFacet& facet) {
    for (const auto& polygon : facet.polygons) {
        if (polygon.size() < 3) continue;
        Ring ring;
        for (const auto node : polygon) ring.points.push_back(&plc.points[static_cast<std::size_t>(node) * 3]);
        rings_.push_back(std::move(ring));
    }
    if (rings_.empty()) return;
    // The plane through the widest triangle at the first two different vertices.
    const std::vector<const double*>& first = rings_.front().points;
    const double* const o = first.front();
    const double* const a = *std::max_element(first.begin(), first.end(), [&](const double* p, const double* q) {
        return std::hypot(p[0] - o[0], p[1] - o[1], p[2] - o[2]) < std::hypot(q[0] - o[0], q[1] - o[1], q[2] - o[2]);
    });
    const double* const b = *std::max_element(first.begin(), first.end(), [&](const double* p, const double* q) {
        return length(cross(o, a, p)) < length(cross(o, a, q));
    });
    plane_ = {o, a, b};
    normal_ = cross(o, a, b);
    length_ = length(normal_);
    if (!proper()) return;
    for (std::size_t k = 0; k < 3; ++k) {
        normal_[k] /= length_;
        if (std::fabs(normal_[k]) > std::fabs(normal_[axis_])) axis_ = k;
    }
    for (Ring& ring : rings_) {
        for (const Ring& other : rings_) {
            if (&other != &ring && in_ring(other, ring.points.front())) ring.hole = !ring.hole;
        }
    }
}

double PlcRegion::distance(const double* p) const {
    const double* const o = plane_[0];
    return std::fabs(normal_[0] * (p[0] - o[0]) + normal_[1] * (p[1] - o[1]) + normal_[2] * (p[2] - o[2]));
}

bool PlcRegion::in_plane(const double* p) const {
    const Result<Sign> s = orient3d(plane_[0], plane_[1], plane_[2], p);
    return s && *s == Sign::zero;
}

bool PlcRegion::in_ring(const Ring& ring, const double* p) const {
    const auto [x, y] = axes();
    bool inside = false;
    for (std::size_t i = 0, j = ring.points.size() - 1; i < ring.points.size(); j = i++) {
        const double *const a = ring.points[i], *const b = ring.points[j];
        // A ray along x crosses the side ab.
        if ((a[y] > p[y]) != (b[y] > p[y]) && p[x] < (b[x] - a[x]) * ((p[y] - a[y]) / (b[y] - a[y])) + a[x])
            inside = !inside;
    }
    return inside;
}

bool PlcRegion::holds(const double* p) const {
    bool inside = false;
    for (const Ring& ring : rings_) inside = inside != in_ring(ring, p);
    return inside;
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
