#include <algorithm>
#include <cstddef>
#include <span>
#include <string>

#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/weights.hpp"
#include "core/base/finite.hpp"
#include "core/exact_tier.hpp"

namespace barycert::core {
namespace {

Status check_finite(std::span<const double> numbers, const char* what) {
    const std::size_t i = base::first_not_finite(numbers);
    if (i == numbers.size()) return Done{};
    return base::not_finite(std::string(what) + " " + std::to_string(i), numbers[i]);
}

}  // namespace
}  // namespace barycert::core

namespace barycert {

Result<Parameter> parameter_of_value(double value_a, double value_b, double value) {
    return point_of_value({}, {}, value_a, value_b, value, {});
}

Result<Parameter> point_of_value(std::span<const double> a, std::span<const double> b, double value_a, double value_b,
                                 double value, std::span<double> point) {
    const double attribute[3] = {value_a, value_b, value};
    if (Status s = core::check_finite(attribute, "attribute value"); !s) return s.error();
    if (Status s = core::check_finite(a, "coordinate of the first end,"); !s) return s.error();
    if (Status s = core::check_finite(b, "coordinate of the second end,"); !s) return s.error();
    // The attribute as the coordinate: a segment along the first axis, from value_a to value_b, with the point at
    // value.
    const double along[6] = {value_a, 0, 0, value_b, 0, 0}, at[3] = {value, 0, 0};
    const core::ExactWeights w(Simplex::segment, along, at);
    if (w.degenerate()) {
        std::fill(point.begin(), point.end(), core::nan);
        return Parameter{core::nan, true};
    }
    for (std::size_t k = 0; k < point.size(); ++k) {
        const double ends[2] = {a[k], b[k]};
        point[k] = w.interpolate(ends);
    }
    return Parameter{w.weight(1), false};
}

Status point_from_weights(Simplex simplex, const double* vertices, const double* weights, double* point) {
    const auto n = static_cast<std::size_t>(vertex_count(simplex));
    const auto d = static_cast<std::size_t>(space_dimension(simplex));
    if (Status s = core::check_finite({weights, n}, "weight"); !s) return s;
    if (Status s = core::check_finite({vertices, n * d}, "coordinate of the vertices,"); !s) return s;
    for (std::size_t k = 0; k < d; ++k) {
        double axis[4];
        for (std::size_t i = 0; i < n; ++i) axis[i] = vertices[d * i + k];
        point[k] = core::exact_dot(weights, axis, static_cast<int>(n));
    }
    return Done{};
}

}  // namespace barycert
