#include <cmath>

#include "barycert/base/finite.hpp"
#include "barycert/raster.hpp"
#include "barycert/raster/exact_point.hpp"

namespace barycert::raster {
namespace {

struct Segment {
    int dimension;
    std::span<const double> a, b;
};

Status check(const Segment& s) {
    if (s.dimension < 1 || s.dimension > 3)
        return Error{.what = "dimension of a segment",
                     .expected = "1, 2 or 3",
                     .found = std::to_string(s.dimension),
                     .remedy = "choose another dimension"};
    if (s.a.size() != s.b.size() || s.a.size() < static_cast<std::size_t>(s.dimension))
        return Error{.what = "the ends of a segment",
                     .expected = std::to_string(s.dimension) + " coordinates and as many attributes at both ends",
                     .found = std::to_string(s.a.size()) + " and " + std::to_string(s.b.size()) + " numbers",
                     .remedy = "give a number for each coordinate and attribute of each end"};
    const std::size_t i = base::first_not_finite(s.a), k = base::first_not_finite(s.b);
    if (i == s.a.size() && k == i) return Done{};
    return base::not_finite(
        "number " + std::to_string(std::min(i, k)) + " of the " + (i <= k ? "first" : "second") + " end",
        i <= k ? s.a[i] : s.b[k], "leave the segment out");
}

/// What is left of a segment, exactly: each end is as given, or where a form is zero.
struct SegmentClipper {
    using End = std::optional<ExactPoint>;

    const Segment& segment;
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
        return {false, a.has_value(), b.has_value(), row(a, segment.a), row(b, segment.b)};
    }

    std::vector<double> row(const End& end, std::span<const double> original) const {
        std::vector<double> numbers(original.begin(), original.end());
        if (!end) return numbers;
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            const double ends[2] = {segment.a[k], segment.b[k]};
            numbers[k] = value_at(*end, ends, 1, 2);
        }
        return numbers;
    }
};

/// normal . x + offset at both ends, in one unit.
Form distance_form(const Segment& s, const HalfSpace& h) {
    const auto d = static_cast<std::size_t>(s.dimension);
    core::Unit of_normal, of_points;
    of_normal.add(h.offset);
    of_points.add(1);
    for (std::size_t k = 0; k < d; ++k) {
        of_normal.add(h.normal[k]);
        of_points.add(s.a[k]);
        of_points.add(s.b[k]);
    }
    const auto product = [&](double n, double x) { return of_normal.integer(n) * of_points.integer(x); };
    Form form;
    for (std::size_t end = 0; end < 2; ++end) {
        form[end] = product(h.offset, 1);
        for (std::size_t k = 0; k < d; ++k) form[end] = form[end] + product(h.normal[k], (end == 0 ? s.a : s.b)[k]);
    }
    return form;
}

Error bad_bound(const std::string& what, const std::string& expected, double found) {
    return {.what = what, .expected = expected, .found = std::to_string(found), .remedy = "choose another bound"};
}

}  // namespace
}  // namespace barycert::raster

namespace barycert {

Result<ClippedSegment> clip_segment(int dimension, std::span<const double> a, std::span<const double> b,
                                    const HalfSpace& bound) {
    const raster::Segment segment{dimension, a, b};
    if (Status good = raster::check(segment); !good) return good.error();
    for (std::size_t k = 0; k <= static_cast<std::size_t>(dimension); ++k) {
        const double x = k < static_cast<std::size_t>(dimension) ? bound.normal[k] : bound.offset;
        if (!std::isfinite(x)) return raster::bad_bound("the half-space", "finite numbers", x);
    }
    raster::SegmentClipper clipper{segment};
    clipper.clip(raster::distance_form(segment, bound));
    return clipper.result();
}

Result<ClippedSegment> clip_segment(int dimension, std::span<const double> a, std::span<const double> b,
                                    const ClipBox& box) {
    const raster::Segment segment{dimension, a, b};
    if (Status good = raster::check(segment); !good) return good.error();
    raster::SegmentClipper clipper{segment};
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

}  // namespace barycert
