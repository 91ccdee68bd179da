// Where a segment meets the triangles, in their exact order along it.

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "barycert/predicates.hpp"
#include "barycert/simplex.hpp"
#include "barycert/surface_locator.hpp"
#include "core/base/vectors.hpp"
#include "core/whole_points.hpp"
#include "mesh/index/bins.hpp"
#include "mesh/index/cell_tree.hpp"
#include "mesh/locate/near_feature.hpp"
#include "mesh/locate/surface/surface_data.hpp"

namespace barycert::locate {
namespace {

using Number = core::WholeNumber;
using Vector = core::WholeVector;

int sign(const double* a, const double* b, const double* c, const double* d) {
    return static_cast<int>(orient3d(a, b, c, d));
}

/// numerator / denominator, the latter positive.
struct Parameter {
    Number numerator, denominator = 1;

    bool operator<(const Parameter& other) const {
        return numerator * other.denominator < other.numerator * denominator;
    }
    bool operator==(const Parameter& other) const {
        return numerator * other.denominator == other.numerator * denominator;
    }
};

struct Segment {
    const double *a, *b;
    bool ray;
};

struct Hit : SurfaceHit {
    Parameter exact;
};

/// The parameter of the point where the line through a and b meets the plane.
Parameter on_plane(const Segment& s, const std::array<const double*, 3>& t) {
    const core::WholePoints whole{s.a, s.b, t[0], t[1], t[2]};
    const Vector a = whole.at(t[0]);
    const Vector n = base::cross(base::minus(whole.at(t[1]), a), base::minus(whole.at(t[2]), a));
    Number from = base::dot(n, base::minus(whole.at(s.a), a)), to = base::dot(n, base::minus(whole.at(s.b), a));
    Number change = from - to;
    if (change < 0) change = -change, from = -from;
    return {from, change};
}

/// The first common point of a segment in the plane of the triangle, without the axis of the longest projection.
bool first_in_plane(const Segment& s, const std::array<const double*, 3>& t, Parameter& first) {
    const core::WholePoints whole{s.a, s.b, t[0], t[1], t[2]};
    const Vector o = whole.at(t[0]), n = base::cross(base::minus(whole.at(t[1]), o), base::minus(whole.at(t[2]), o));
    const Vector a = whole.at(s.a), d = base::minus(whole.at(s.b), a);
    Parameter low{0, 1}, high{1, 1};
    bool open = s.ray;  // `high` does not count
    for (std::size_t i = 0; i < 3; ++i) {
        // Inside: (n x edge).(x - corner) >= 0.
        const Vector c = whole.at(t[i]), edge = base::minus(whole.at(t[(i + 1) % 3]), c), inner = base::cross(n, edge);
        const Number at_a = base::dot(inner, base::minus(a, c)), step = base::dot(inner, d);
        if (step == 0) {
            if (at_a < 0) return false;
            continue;
        }
        if (step > 0) {
            if (const Parameter in{-at_a, step}; low < in) low = in;
        } else if (const Parameter out{at_a, -step}; open || out < high) {
            high = out;
            open = false;
        }
    }
    first = low;
    return open || !(high < low);
}

/// The parameter is one of the segment's.
bool is_of(const Segment& s, const Parameter& x) {
    return x.numerator >= 0 && (s.ray || x.numerator <= x.denominator);
}

/// Finds, for two segments on one line, where the one from c to d begins, as seen from a.
bool first_on_line(const Segment& s, const Vector& along, const Vector& to_c, const Vector& to_d, Parameter& first) {
    const Number square = base::dot(along, along);
    Parameter low{base::dot(to_c, along), square}, high{base::dot(to_d, along), square};
    if (high < low) std::swap(low, high);
    if (high.numerator < 0) return false;
    first = low.numerator < 0 ? Parameter{0, 1} : low;
    return is_of(s, first);
}

/// Finds a hit of a triangle without an area: a segment, with its corners in their order along it, or a point.
bool hit_flat(const Segment& s, const std::array<const double*, 3>& t, Hit& found) {
    const FlatCorners line = corners_along(t);
    const core::WholePoints whole{s.a, s.b, t[0], t[1], t[2]};
    const Vector a = whole.at(s.a), along = base::minus(whole.at(s.b), a), c = whole.at(t[line.corner[0]]);
    const Vector to_c = base::minus(c, a), edge = base::minus(whole.at(t[line.corner[line.count - 1]]), c);
    const Vector n = base::cross(along, edge), aside = base::cross(to_c, along);
    const Number square = base::dot(n, n);
    if (square == 0) {
        if (base::dot(aside, aside) != 0) return false;
        found.feature = line.count == 1 ? Feature::vertex : Feature::degenerate;
        const Vector to_d{to_c[0] + edge[0], to_c[1] + edge[1], to_c[2] + edge[2]};
        return first_on_line(s, along, to_c, to_d, found.exact);
    }
    if (base::dot(to_c, n) != 0) return false;
    found.exact = {base::dot(base::cross(to_c, edge), n), square};
    const Number on_edge = base::dot(aside, n);  // over the square
    if (!is_of(s, found.exact) || on_edge < 0 || on_edge > square) return false;
    const auto at_corner = [&](std::size_t i) {
        const Vector from_c = base::minus(whole.at(t[line.corner[i]]), c);
        return base::dot(from_c, edge) * square == on_edge * base::dot(edge, edge);
    };
    found.feature = at_corner(0) || at_corner(1) || at_corner(line.count - 1) ? Feature::vertex : Feature::edge;
    return true;
}

bool hit(const Segment& s, const std::array<const double*, 3>& t, Hit& found) {
    const int from = sign(t[0], t[1], t[2], s.a), to = sign(t[0], t[1], t[2], s.b);
    if (from == 0 && to == 0) {
        found.feature = Feature::degenerate;
        return first_in_plane(s, t, found.exact);
    }
    if (from * to > 0 && !s.ray) return false;
    int zeros = 0, all = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const int side = sign(s.a, s.b, t[i], t[(i + 1) % 3]);
        if (side * all < 0) return false;
        if (side == 0) ++zeros;
        if (side != 0) all = side;
    }
    found.exact = on_plane(s, t);
    if (found.exact.denominator == 0 || found.exact.numerator < 0) return false;  // parallel, or before a
    found.feature = zeros == 0 ? Feature::face : zeros == 1 ? Feature::edge : Feature::vertex;
    // Going on, it leaves on the side of b, or away from that of a.
    found.side = from != 0 ? (from > 0 ? -1 : 1) : (to > 0 ? 1 : -1);
    return true;
}

}  // namespace

std::vector<SurfaceHit> SurfaceData::hits(const double* a, const double* b, bool ray) const {
    std::vector<Hit> all;
    if (empty()) return {};
    const Segment segment{a, b, ray};
    // Boxes of parts of the segment would leave out more; triangles are few where segments are short.
    const double* ends[2] = {a, b};
    CellBox box = box_of(triangles.index, ends, 2);
    for (std::size_t k = 0; k < 3 && ray; ++k) {
        if (b[k] > a[k]) box.high[k] = Quantizer::max;
        if (b[k] < a[k]) box.low[k] = 0;
    }
    boxes->for_each_meeting(box, [&](std::size_t t) {
        Hit one;
        const std::array<const double*, 3> at = triangles.turned(t);
        if (triangles.is_flat(t) ? hit_flat(segment, at, one) : hit(segment, at, one)) {
            one.triangle = triangles.number(t);
            one.parameter = core::rounded_quotient(one.exact.numerator, one.exact.denominator, 0);
            all.push_back(std::move(one));
        }
        return true;
    });
    std::ranges::sort(all, [](const Hit& x, const Hit& y) {
        if (x.parameter != y.parameter) return x.parameter < y.parameter;  // rounding keeps the order
        return x.exact == y.exact ? x.triangle < y.triangle : x.exact < y.exact;
    });
    return {all.begin(), all.end()};
}

}  // namespace barycert::locate
