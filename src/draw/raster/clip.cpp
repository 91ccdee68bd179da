// Clipping, exactly: points of a segment or triangle are kept by their exact weights.
//
// Notation. A form h is a number at each vertex, h_i, and so one at each point of the simplex: sum of weight i times
// h_i; the distance to a bound, up to a factor. A form is known up to a positive factor, as integers in a unit of its
// own. Widths: a distance to a plane x = w or x = min is a difference of doubles, 2099 bits (integer.hpp); that to a
// half-space is a sum of four products of two doubles, 4198 bits. Numerators are such a distance, or in a triangle a
// difference of two products of differences, 4199 bits; times a double or a difference, and summed over three
// vertices, that is less than 6302 bits, of 14704 that there are.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/raster.hpp"
#include "barycert/result.hpp"
#include "core/base/finite.hpp"
#include "core/integer.hpp"
#include "core/scaled_double.hpp"

namespace barycert {
namespace raster {
namespace {

using Form = std::array<core::Integer, 3>;  ///< of a segment, the first two; the third is zero

/// Weight i is numerator[i] / denominator.
struct ExactPoint {
    Form numerator;
    core::Integer denominator;  ///< the sum of the numerators; positive
};

/// x(i) - y(i) at each of `count` vertices.
template <class X, class Y>
Form difference_form(int count, X x, Y y) {
    core::Unit unit;
    for (int i = 0; i < count; ++i) {
        unit.add(x(i));
        unit.add(y(i));
    }
    Form form;
    for (int i = 0; i < count; ++i) form[static_cast<std::size_t>(i)] = unit.integer(x(i)) - unit.integer(y(i));
    return form;
}

/// Weights in the ratio of these numbers.
ExactPoint exact_point(const Form& n) {
    ExactPoint p{n, n[0] + n[1] + n[2]};
    if (p.denominator.sign() >= 0) return p;
    for (core::Integer& x : p.numerator) x = core::Integer() - x;
    p.denominator = core::Integer() - p.denominator;
    return p;
}

/// The sign of h at the point: -1, 0 or 1.
int sign_at(const Form& h, const ExactPoint& p) {
    return (h[0] * p.numerator[0] + h[1] * p.numerator[1] + h[2] * p.numerator[2]).sign();
}

/// The number at the point, correctly rounded, of which each vertex has one.
double value_at(const ExactPoint& p, const double* values, std::size_t stride, std::size_t count) {
    core::Unit unit;
    for (std::size_t i = 0; i < count; ++i) unit.add(values[stride * i]);
    core::Integer sum;
    for (std::size_t i = 0; i < count; ++i) sum = sum + p.numerator[i] * unit.integer(values[stride * i]);
    return core::round_quotient(sum, p.denominator, unit.exponent - 1074);
}

Status check_segment(int dimension, std::span<const double> a, std::span<const double> b) {
    if (dimension < 1 || dimension > 3)
        return file_error("argument.value", {}, "dimension of a segment", "1, 2 or 3", std::to_string(dimension),
                          "choose another dimension");
    if (a.size() != b.size() || a.size() < static_cast<std::size_t>(dimension))
        return file_error("argument.size", {}, "the ends of a segment",
                          std::to_string(dimension) + " coordinates and as many attributes at both ends",
                          std::to_string(a.size()) + " and " + std::to_string(b.size()) + " numbers",
                          "give a number for each coordinate and attribute of each end");
    const std::size_t i = base::first_not_finite(a), k = base::first_not_finite(b);
    if (i == a.size() && k == i) return Done{};
    return base::not_finite(
        "number " + std::to_string(std::min(i, k)) + " of the " + (i <= k ? "first" : "second") + " end",
        i <= k ? a[i] : b[k], "leave the segment out");
}

/// Clips a segment exactly: each end stays as given, or lies where a form is zero.
struct SegmentClipper {
    using End = std::optional<ExactPoint>;

    std::span<const double> first, second;  ///< the ends given
    End a = {}, b = {};
    bool empty = false;

    /// Takes off what lies where the form is negative.
    void clip(const Form& form) {
        if (empty) return;
        const auto sign = [&](const End& end, std::size_t i) { return end ? sign_at(form, *end) : form[i].sign(); };
        const int at_a = sign(a, 0), at_b = sign(b, 1);
        empty = at_a < 0 && at_b < 0;
        if (empty || (at_a >= 0 && at_b >= 0)) return;
        // h_a W_a + h_b W_b = 0 for W_a : W_b = h_b : -h_a.
        (at_a < 0 ? a : b) = exact_point({form[1], core::Integer() - form[0], core::Integer()});
    }

    ClippedSegment result() const {
        if (empty) return {};
        return {false, a.has_value(), b.has_value(), row(a, first), row(b, second)};
    }

    std::vector<double> row(const End& end, std::span<const double> original) const {
        std::vector<double> numbers(original.begin(), original.end());
        if (!end) return numbers;
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            const double ends[2] = {first[k], second[k]};
            numbers[k] = value_at(*end, ends, 1, 2);
        }
        return numbers;
    }
};

/// normal . x + offset at both ends, in one unit.
Form distance_form(std::size_t d, const double* a, const double* b, const HalfSpace& h) {
    core::Unit of_normal, of_points;
    of_normal.add(h.offset);
    of_points.add(1);
    for (std::size_t k = 0; k < d; ++k) {
        of_normal.add(h.normal[k]);
        of_points.add(a[k]);
        of_points.add(b[k]);
    }
    const auto product = [&](double n, double x) { return of_normal.integer(n) * of_points.integer(x); };
    Form form;
    for (std::size_t end = 0; end < 2; ++end) {
        form[end] = product(h.offset, 1);
        for (std::size_t k = 0; k < d; ++k) form[end] = form[end] + product(h.normal[k], (end == 0 ? a : b)[k]);
    }
    return form;
}

Error bad_bound(const std::string& what, const std::string& expected, double found) {
    return {.code = "argument.value",
            .what = what,
            .expected = expected,
            .found = std::to_string(found),
            .remedy = "choose another bound"};
}

constexpr int bounds = 6;  ///< x, y, z <= w, then -w <= x, y, z

/// The coordinate that bound b compares with w: x, y, z or -x, -y, -z.
double beside(const double* vertex, int b) {
    return b < 3 ? vertex[b] : -vertex[b - 3];
}

/// On which side of bound b a vertex lies; positive inside. Exact: doubles are compared.
int side(const double* vertex, int b) {
    const double x = beside(vertex, b), w = vertex[3];
    return x < w ? 1 : x == w ? 0 : -1;
}

/// Sutherland and Hodgman's way (Reentrant Polygon Clipping, CACM 17, 1974): bound after bound, each taking off what
/// lies beyond it. But polygons are kept as what they are exactly, never as rounded vertices: an edge is the line where
/// a form is zero (one of the triangle's weights, or the distance to a bound that has cut), a new vertex is where two
/// lines meet. Signs of forms at vertices are exact, and rounding is done once, at the end.
class TriangleClipper {
public:
    TriangleClipper(const double* vertices, std::size_t stride) : vertices_(vertices), stride_(stride) {}

    /// False if less than a polygon is left.
    bool clip(int bound) {
        const Form form = form_of(3 + bound);
        std::vector<int> signs;
        for (const Corner& c : polygon_)
            signs.push_back(c.vertex < 3 ? side(vertex(c.vertex), bound) : sign_at(form, made(c.vertex)));
        std::vector<Corner> left;
        // Where the sign changes strictly along an edge, its form and that of the bound differ by more than a factor,
        // so that they have one zero in common.
        const auto cross = [&](int edge, int next_edge) {
            const Form g = form_of(edge), &h = form;
            made_.push_back(
                exact_point({g[1] * h[2] - g[2] * h[1], g[2] * h[0] - g[0] * h[2], g[0] * h[1] - g[1] * h[0]}));
            left.push_back({2 + static_cast<int>(made_.size()), next_edge});
        };
        for (std::size_t i = 0; i < polygon_.size(); ++i) {
            const Corner& c = polygon_[i];
            const int from = signs[i], to = signs[(i + 1) % signs.size()];
            if (from >= 0) left.push_back({c.vertex, from == 0 && to < 0 ? 3 + bound : c.edge});
            if (from > 0 && to < 0) cross(c.edge, 3 + bound);
            if (from < 0 && to > 0) cross(c.edge, c.edge);
        }
        polygon_ = std::move(left);
        return polygon_.size() >= 3;
    }

    void append_to(std::vector<double>& rows) const {
        for (const Corner& c : polygon_) {
            for (std::size_t k = 0; k < stride_; ++k)
                rows.push_back(c.vertex < 3 ? vertex(c.vertex)[k]
                                            : value_at(made(c.vertex), vertices_ + k, stride_, 3));
        }
    }

private:
    /// A vertex, and what the edge from it to the next one lies on: 0 to 2: where the weight of that vertex is zero;
    /// 3 + b: on bound b.
    struct Corner {
        int vertex;  ///< 0 to 2: of the triangle; 3 + k: made_[k]
        int edge;
    };

    const double* vertex(int i) const { return vertices_ + stride_ * static_cast<std::size_t>(i); }
    const ExactPoint& made(int i) const { return made_[static_cast<std::size_t>(i - 3)]; }

    Form form_of(int edge) const {
        if (edge >= 3)
            return difference_form(
                3, [&](int i) { return vertex(i)[3]; }, [&](int i) { return beside(vertex(i), edge - 3); });
        Form form;
        form[static_cast<std::size_t>(edge)] = core::Integer(false, 1, 0);
        return form;
    }

    const double* vertices_;
    std::size_t stride_;
    std::vector<Corner> polygon_{{0, 2}, {1, 0}, {2, 1}};
    std::vector<ExactPoint> made_;
};

Status check_rows(std::span<const double> vertices) {
    if (vertices.size() < 12 || vertices.size() % 3 != 0)
        return file_error("argument.size", {}, "a triangle of other than three vertices",
                          "three rows of x, y, z, w and attributes, of equal length",
                          std::to_string(vertices.size()) + " numbers",
                          "give a number for each attribute of each vertex");
    const std::size_t i = base::first_not_finite(vertices), row = vertices.size() / 3;
    if (i == vertices.size()) return Done{};
    return base::not_finite("number " + std::to_string(i % row) + " of vertex " + std::to_string(i / row), vertices[i],
                            "leave the triangle out");
}

}  // namespace
}  // namespace raster

Result<ClippedSegment> clip_segment(int dimension, std::span<const double> a, std::span<const double> b,
                                    const HalfSpace& bound) {
    if (Status good = raster::check_segment(dimension, a, b); !good) return good.error();
    const auto d = static_cast<std::size_t>(dimension);
    for (std::size_t k = 0; k <= d; ++k) {
        const double x = k < d ? bound.normal[k] : bound.offset;
        if (!std::isfinite(x)) return raster::bad_bound("the half-space", "finite numbers", x);
    }
    raster::SegmentClipper clipper{.first = a, .second = b};
    clipper.clip(raster::distance_form(d, a.data(), b.data(), bound));
    return clipper.result();
}

Result<ClippedSegment> clip_segment(int dimension, std::span<const double> a, std::span<const double> b,
                                    const ClipBox& box) {
    if (Status good = raster::check_segment(dimension, a, b); !good) return good.error();
    raster::SegmentClipper clipper{.first = a, .second = b};
    for (std::size_t k = 0; k < static_cast<std::size_t>(dimension); ++k) {
        for (const double x : {box.min[k], box.max[k]}) {
            if (std::isnan(x)) return raster::bad_bound("a bound of the box", "a number", x);
        }
        const auto end = [&](int i) { return i == 0 ? a[k] : b[k]; };
        const auto min = [&](int) { return box.min[k]; };
        const auto max = [&](int) { return box.max[k]; };
        // An infinite bound on the far side bounds nothing; on the near side nothing lies inside.
        if (box.min[k] == HUGE_VAL || box.max[k] == -HUGE_VAL) return ClippedSegment{};
        if (std::isfinite(box.min[k])) clipper.clip(raster::difference_form(2, end, min));
        if (std::isfinite(box.max[k])) clipper.clip(raster::difference_form(2, max, end));
    }
    return clipper.result();
}

Result<Clip> clip_triangle(std::span<const double> vertices, std::vector<double>& polygon) {
    using namespace raster;
    const ExactEnvironment environment;  // for comparisons of subnormal numbers
    if (Status good = check_rows(vertices); !good) return good.error();
    const std::size_t row = vertices.size() / 3;
    std::array<int, bounds> beyond{};  // how many vertices lie there
    for (std::size_t b = 0; b < bounds; ++b) {
        for (std::size_t i = 0; i < 3; ++i)
            beyond[b] += side(vertices.data() + row * i, static_cast<int>(b)) < 0 ? 1 : 0;
    }
    const int most = std::ranges::max(beyond);
    polygon.clear();
    if (most == 3) return Clip::outside;
    if (most == 0) {
        polygon.assign(vertices.begin(), vertices.end());
    } else {
        TriangleClipper clipper(vertices.data(), row);
        for (std::size_t b = 0; b < bounds; ++b) {
            // A bound beyond which no vertex lies has nothing of the triangle beyond it.
            if (beyond[b] != 0 && !clipper.clip(static_cast<int>(b))) return Clip::outside;
        }
        clipper.append_to(polygon);
    }
    for (std::size_t i = 3; i < polygon.size(); i += row) {
        if (polygon[i] != 0) continue;
        polygon.clear();
        return Clip::at_eye;
    }
    return most == 0 ? Clip::inside : Clip::cut;
}

}  // namespace barycert
