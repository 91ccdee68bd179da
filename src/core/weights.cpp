#include "barycert/weights.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/predicates.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "core/base/finite.hpp"
#include "core/blocks.hpp"
#include "core/exact_tier.hpp"
#include "core/lanes.hpp"

namespace barycert::core {
namespace {

/// Weights of the last tier; NaN and false if degenerate.
bool exact_weights(Simplex s, const double* vertices, const double* point, double* out) {
    const ExactWeights w(s, vertices, point);
    for (int i = 0; i < vertex_count(s); ++i) out[i] = w.degenerate() ? nan : w.weight(i);
    return !w.degenerate();
}

template <class Batch>
Status batch_weights(const Batch& batch, std::span<double> out, TierCounts* tiers) {
    const ExactEnvironment environment;
    const Simplex s = batch.simplex;
    const auto n = static_cast<std::size_t>(vertex_count(s));
    if (Status sizes = check_sizes(batch, out.size(), n); !sizes) return sizes;
    return for_blocks(
        batch, Tier::double_double, tiers,
        [&](std::size_t first, const CaseBlock& block, std::uint32_t* undecided) {
            return weight_lanes(s, block, out.data() + n * first, undecided);
        },
        [&](std::size_t first, std::size_t j, const SingleCase& c) {
            double* const to = out.data() + n * (first + j);
            return ExactCase{.degenerate = !exact_weights(s, c.vertices.data(), c.point.data(), to)};
        });
}

/// Nodal values of a block as one array a component and vertex, taken in place where they lie so already.
template <class T>
class ArrayValues {
public:
    ArrayValues(const CaseArrays& cases, const ValueArrays<T>& values)
        : values_(values),
          n_(static_cast<std::size_t>(vertex_count(cases.simplex))),
          components_(static_cast<std::size_t>(values.components)),
          copies_(in_place() ? 0 : n_ * components_),
          arrays_(n_ * components_) {}

    const double* const* block(const CaseArrays&, std::size_t first, std::size_t count) {
        for (std::size_t i = 0; i < n_; ++i) {
            const T* const from = values_.at[i] + components_ * first;
            if constexpr (std::is_same_v<T, double>) {
                if (in_place()) {
                    arrays_[i] = from;
                    continue;
                }
            }
            for (std::size_t c = 0; c < components_; ++c) {
                double* const to = copies_[n_ * c + i];
                arrays_[n_ * c + i] = to;
                for (std::size_t j = 0; j < count; ++j) to[j] = static_cast<double>(from[components_ * j + c]);
            }
        }
        return arrays_.data();
    }

private:
    bool in_place() const { return std::is_same_v<T, double> && components_ == 1; }

    const ValueArrays<T>& values_;
    std::size_t n_, components_;
    LaneArrays copies_;
    std::vector<const double*> arrays_;
};

template <class T>
ArrayValues<T> block_values(const CaseArrays& cases, const ValueArrays<T>& values) {
    return {cases, values};
}
template <class T>
GatheredValues<T> block_values(const MeshQueries& queries, const NodalValues<T>& values) {
    return {values, static_cast<std::size_t>(vertex_count(queries.simplex))};
}

/// Values of the last tier, one a component: that of vertex i, component c is values[n * c + i][j].
ExactCase exact_values(const ExactWeights& w, int n, const double* const* values, std::size_t j, int components,
                       double* out) {
    ExactCase found{.degenerate = w.degenerate()};
    for (int c = 0; c < components; ++c) {
        double numbers[4];
        const std::span f(numbers, static_cast<std::size_t>(n));
        for (int i = 0; i < n; ++i) numbers[i] = values[n * c + i][j];
        const bool usable = w.leave_out_not_finite(f);
        found.finite_values = found.finite_values && usable;
        out[c] = usable && !w.degenerate() ? w.interpolate(f) : nan;
    }
    return found;
}

template <class Batch, class Values>
Status batch_values(const Batch& batch, const Values& values, std::span<double> out, TierCounts* tiers,
                    Rounding rounding) {
    const Simplex s = batch.simplex;
    const int n = vertex_count(s), components = values.components;
    const auto stride = static_cast<std::size_t>(components);
    const ExactEnvironment environment;
    if (Status some = check_components(components); !some) return some;
    if (Status sizes = check_sizes(batch, out.size(), stride); !sizes) return sizes;
    auto blocks = block_values(batch, values);
    const bool plain = rounding == Rounding::plain;
    const double* const* at = nullptr;
    return for_blocks(
        batch, Tier::double_double, plain ? nullptr : tiers,
        [&](std::size_t first, const CaseBlock& block, std::uint32_t* undecided) -> std::size_t {
            at = blocks.block(batch, first, block.count);
            double* const to = out.data() + stride * first;
            const std::size_t left = value_lanes(rounding, s, block, at, components, to, undecided);
            if (!plain) return left;
            mend_plain_values(s, block, {undecided, left}, at, n, components, to);
            return 0;
        },
        [&](std::size_t first, std::size_t j, const SingleCase& c) {
            const ExactWeights w(s, c.vertices.data(), c.point.data());
            return exact_values(w, n, at, j, components, out.data() + stride * (first + j));
        });
}

}  // namespace

void mend_plain_values(Simplex s, const CaseBlock& cases, std::span<const std::uint32_t> undecided,
                       const double* const* values, int nodes, int components, double* out) {
    const auto m = static_cast<std::size_t>(nodes), all = static_cast<std::size_t>(components);
    for (const std::uint32_t j : undecided) {
        const SingleCase one = single_case(s, cases, j);
        const CaseBlock block = single_block(s, one.vertices.data(), one.point.data());
        std::optional<ExactWeights> weights;
        for (std::size_t c = 0; c < all; ++c) {
            double f[10];
            const double* at[10] = {};
            for (std::size_t i = 0; i < m; ++i) at[i] = &(f[i] = values[m * c + i][j]);
            if (base::all_finite({f, m})) continue;
            double* const to[1] = {&out[all * j + c]};
            *to[0] = nan;
            if (!all_finite(s, one.vertices.data(), one.point.data())) continue;
            if (!weights) weights.emplace(s, one.vertices.data(), one.point.data());
            std::uint32_t ignored[1];
            if (!weights->leave_out_not_finite({f, m})) continue;
            nodes == vertex_count(s) ? value_lanes(Rounding::plain, s, block, at, 1, to[0], ignored)
                                     : quadratic_lanes(Rounding::plain, s, block, at, 1, to, ignored);
        }
    }
}

}  // namespace barycert::core

namespace barycert {

Result<Weights> barycentric_weights(Simplex simplex, const double* vertices, const double* point) {
    const ExactEnvironment environment;
    Weights w;
    std::uint32_t undecided[1];
    const core::CaseBlock block = core::single_block(simplex, vertices, point);
    if (core::weight_lanes(simplex, block, w.weights.data(), undecided) == 0) return w;
    if (!core::all_finite(simplex, vertices, point)) return core::not_finite_error(simplex, vertices, point);
    w.tier = Tier::exact;
    w.degenerate = !core::exact_weights(simplex, vertices, point, w.weights.data());
    return w;
}

Result<Value> interpolate(Simplex simplex, const double* vertices, const double* point, const double* values) {
    const ExactEnvironment environment;
    const int n = vertex_count(simplex);
    const double* at[4] = {};
    for (int i = 0; i < n; ++i) at[i] = values + i;
    Value v;
    std::uint32_t undecided[1];
    const core::CaseBlock block = core::single_block(simplex, vertices, point);
    if (core::value_lanes(Rounding::correct, simplex, block, at, 1, &v.value, undecided) == 0) return v;
    if (!core::all_finite(simplex, vertices, point)) return core::not_finite_error(simplex, vertices, point);
    const core::ExactWeights w(simplex, vertices, point);
    v.tier = Tier::exact;
    v.degenerate = core::exact_values(w, n, at, 0, 1, &v.value).degenerate;
    return v;
}

Result<Sign> compare_value(Simplex simplex, const double* vertices, const double* point, const double* values,
                           double threshold) {
    if (!core::all_finite(simplex, vertices, point)) return core::not_finite_error(simplex, vertices, point);
    const core::ExactWeights w(simplex, vertices, point);
    if (w.degenerate()) return Error{.code = "argument.value", .what = "a degenerate simplex has no values"};
    double numbers[4];
    const std::span nodal(numbers, static_cast<std::size_t>(vertex_count(simplex)));
    std::copy_n(values, nodal.size(), numbers);
    if (!std::isfinite(threshold) || !w.leave_out_not_finite(nodal))
        return Error{.code = "argument.not-finite",
                     .what = "a value cannot be compared",
                     .expected = "finite nodal values and a finite threshold"};
    return static_cast<Sign>(w.compare(nodal, threshold));
}

Status barycentric_weights(const CaseArrays& cases, std::span<double> out, TierCounts* tiers) {
    return core::batch_weights(cases, out, tiers);
}

Status barycentric_weights(const MeshQueries& queries, std::span<double> out, TierCounts* tiers) {
    return core::batch_weights(queries, out, tiers);
}

Status interpolate(const CaseArrays& cases, const ValueArrays<double>& values, std::span<double> out, TierCounts* tiers,
                   Rounding rounding) {
    return core::batch_values(cases, values, out, tiers, rounding);
}

Status interpolate(const CaseArrays& cases, const ValueArrays<float>& values, std::span<double> out, TierCounts* tiers,
                   Rounding rounding) {
    return core::batch_values(cases, values, out, tiers, rounding);
}

Status interpolate(const MeshQueries& queries, const NodalValues<double>& values, std::span<double> out,
                   TierCounts* tiers, Rounding rounding) {
    return core::batch_values(queries, values, out, tiers, rounding);
}

Status interpolate(const MeshQueries& queries, const NodalValues<float>& values, std::span<double> out,
                   TierCounts* tiers, Rounding rounding) {
    return core::batch_values(queries, values, out, tiers, rounding);
}

}  // namespace barycert
