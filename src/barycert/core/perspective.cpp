#include "barycert/perspective.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "barycert/core/input_checks.hpp"
#include "barycert/core/perspective_exact.hpp"
#include "barycert/environment.hpp"

namespace barycert::core {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

bool usable_vertices(const double* vertices) {
    for (int i = 0; i < 3; ++i) {
        const double w = vertices[3 * i + 2];
        if (!all_finite(vertices + 3 * i, 3) || !(w > 0)) return false;
    }
    return true;
}

/// Names the first number that is not as perspective.hpp requires. Precondition: there is one.
Error unusable_error(const double* vertices, const double* point, const std::string& which = {}) {
    for (int i = 0; i < 3; ++i) {
        const std::string vertex = " of vertex " + std::to_string(i);
        for (int k = 0; k < 2; ++k) {
            if (const double x = vertices[3 * i + k]; !std::isfinite(x))
                return {.what = "coordinate " + std::to_string(k) + vertex,
                        .expected = "a finite number",
                        .found = std::to_string(x)};
        }
        if (const double w = vertices[3 * i + 2]; !std::isfinite(w) || !(w > 0))
            return {.what = "depth w" + vertex,
                    .expected = "a finite number above 0",
                    .found = std::to_string(w),
                    .remedy = "clip the triangle in clip space, before the division by w"};
    }
    const int k = std::isfinite(point[0]) ? 1 : 0;
    return {.what = which + "coordinate " + std::to_string(k) + " of the point",
            .expected = "a finite number",
            .found = std::to_string(point[k])};
}

Status check_perspective(const double* vertices, const double* point) {
    if (usable_vertices(vertices) && all_finite(point, 2)) return Done{};
    return unusable_error(vertices, point);
}

}  // namespace
}  // namespace barycert::core

namespace barycert {

Result<PerspectiveWeights> perspective_weights(const double* vertices, const double* point) {
    const ExactEnvironment environment;
    if (Status usable = core::check_perspective(vertices, point); !usable) return usable.error();
    PerspectiveWeights w;
    w.degenerate = !core::exact_perspective_weights(vertices, point, w.weights.data());
    if (w.degenerate) w.weights.fill(core::nan);
    return w;
}

Result<Value> perspective_depth(const double* vertices, const double* point) {
    const ExactEnvironment environment;
    if (Status usable = core::check_perspective(vertices, point); !usable) return usable.error();
    Value z{.value = core::nan, .degenerate = false, .tier = Tier::exact};
    z.degenerate = !core::exact_perspective_depth(vertices, point, &z.value);
    return z;
}

Result<Value> perspective_value(const double* vertices, const double* point, const double* values) {
    const ExactEnvironment environment;
    if (Status usable = core::check_perspective(vertices, point); !usable) return usable.error();
    Value v{.value = core::nan, .degenerate = false, .tier = Tier::exact};
    v.degenerate = !core::exact_perspective_values(vertices, point, values, 1, &v.value);
    return v;
}

Status perspective_values(const double* vertices, std::span<const double> points, std::span<const double> values,
                          int components, std::span<double> out, TierCounts* tiers) {
    const ExactEnvironment environment;
    if (Status some = core::check_components(components); !some) return some;
    const auto stride = static_cast<std::size_t>(components);
    if (points.size() % 2 != 0) return core::size_error("size of the points", "two coordinates a point", points.size());
    const std::size_t count = points.size() / 2;
    if (values.size() != 3 * stride)
        return core::size_error("size of the values", std::to_string(stride) + " for each of 3 vertices",
                                values.size());
    if (Status size = core::check_output(out.size(), stride, count, "point"); !size) return size;
    const bool usable = core::usable_vertices(vertices);
    TierCounts counts;
    const bool finite_values = core::all_finite(values.data(), static_cast<int>(values.size()));
    for (std::size_t j = 0; j < count; ++j) {
        const double* const point = points.data() + 2 * j;
        if (!usable || !core::all_finite(point, 2))
            return core::unusable_error(vertices, point, "point " + std::to_string(j) + ", ");
        double* const to = out.data() + stride * j;
        const bool proper = core::exact_perspective_values(vertices, point, values.data(), components, to);
        if (!proper) std::fill_n(to, components, core::nan);
        counts.add(Tier::exact);
        counts.degenerate += proper ? 0 : 1;
        counts.not_finite += finite_values ? 0 : 1;
    }
    if (tiers != nullptr) tiers->add(counts);
    return Done{};
}

}  // namespace barycert
