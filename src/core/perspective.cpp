#include "barycert/perspective.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "barycert/environment.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/weights.hpp"
#include "core/base/finite.hpp"
#include "core/blocks.hpp"
#include "core/exact_tier.hpp"
#include "core/lanes.hpp"

namespace barycert::core {
namespace {

/// Names the first number that is not as perspective.hpp requires.
Status check_usable(const double* vertices, const double* point, const std::string& which = {}) {
    for (int i = 0; i < 9; ++i) {
        const double x = vertices[i];
        const bool depth = i % 3 == 2;
        if (std::isfinite(x) && (!depth || x > 0)) continue;
        const std::string vertex = " of vertex " + std::to_string(i / 3);
        if (!depth) return base::not_finite("coordinate " + std::to_string(i % 3) + vertex, x);
        return Error{.code = "argument.value",
                     .what = "depth w" + vertex,
                     .expected = "a finite number above 0",
                     .found = std::to_string(x),
                     .remedy = "clip the triangle in clip space, before the division by w"};
    }
    if (base::all_finite({point, 2})) return Done{};
    const int k = std::isfinite(point[0]) ? 1 : 0;
    return base::not_finite(which + "coordinate " + std::to_string(k) + " of the point", point[k]);
}

/// Sets `found`, whose numbers begin at `out`.
template <PerspectiveAnswer what, class Numbers>
Result<Numbers> answer(Numbers& found, double* out, const double* vertices, const double* point, const double* values) {
    const ExactEnvironment environment;
    constexpr std::size_t count = what == PerspectiveAnswer::weights ? 3 : 1;
    double* to[count];
    for (std::size_t i = 0; i < count; ++i) to[i] = out + i;
    std::uint32_t undecided[1];
    if (perspective_lanes(what, vertices, {{}, {point, point + 1}, 1}, values, 1, to, undecided) == 0) return found;
    if (Status good = check_usable(vertices, point); !good) return good.error();
    found.tier = Tier::exact;
    found.degenerate = !exact_perspective(what, vertices, point, values, 1, out);
    if (found.degenerate) std::fill_n(out, count, nan);
    return found;
}

}  // namespace
}  // namespace barycert::core

namespace barycert {

using core::PerspectiveAnswer;

Result<PerspectiveWeights> perspective_weights(const double* vertices, const double* point) {
    PerspectiveWeights w;
    return core::answer<PerspectiveAnswer::weights>(w, w.weights.data(), vertices, point, nullptr);
}

Result<Value> perspective_depth(const double* vertices, const double* point) {
    Value depth;
    return core::answer<PerspectiveAnswer::depth>(depth, &depth.value, vertices, point, nullptr);
}

Result<Value> perspective_value(const double* vertices, const double* point, const double* values) {
    Value v;
    return core::answer<PerspectiveAnswer::values>(v, &v.value, vertices, point, values);
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
    constexpr double origin[2] = {};
    if (Status good = core::check_usable(vertices, origin); !good) return good;
    TierCounts counts;
    const bool finite_values = base::all_finite(values);
    double x[core::block_size] = {}, y[core::block_size] = {};
    const core::LaneArrays results(stride);
    std::uint32_t undecided[core::block_size];
    for (std::size_t first = 0; first < count; first += core::block_size) {
        const std::size_t some = std::min(core::block_size, count - first);
        for (std::size_t j = 0; j < some; ++j) {
            x[j] = points[2 * (first + j)];
            y[j] = points[2 * (first + j) + 1];
        }
        const std::size_t left = core::perspective_lanes(PerspectiveAnswer::values, vertices, {{}, {x, y}, some},
                                                         values.data(), components, results.data(), undecided);
        double* const to = out.data() + stride * first;
        results.copy_out(some, to);
        for (std::size_t i = 0; i < left; ++i) {
            const std::size_t j = undecided[i];
            const double* const point = points.data() + 2 * (first + j);
            if (!core::check_usable(vertices, point))
                return core::check_usable(vertices, point, "point " + std::to_string(first + j) + ", ");
            const bool proper = core::exact_perspective(PerspectiveAnswer::values, vertices, point, values.data(),
                                                        components, to + stride * j);
            if (!proper) std::fill_n(to + stride * j, components, core::nan);
            counts.degenerate += proper ? 0 : 1;
            const auto is_nan = [](double value) { return std::isnan(value); };
            counts.not_finite += !finite_values && std::any_of(to + stride * j, to + stride * (j + 1), is_nan) ? 1 : 0;
        }
        counts.add(Tier::double_double, some - left);
        counts.add(Tier::exact, left);
    }
    if (tiers != nullptr) tiers->add(counts);
    return Done{};
}

}  // namespace barycert
