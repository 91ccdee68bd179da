#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

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

Status check_quadratic(const MeshQueries& q, std::size_t mid_nodes, int components, std::size_t places) {
    if (Status known = check_fills_space(q.simplex, "quadratic interpolation"); !known) return known;
    if (Status some = check_components(components); !some) return some;
    const auto n = static_cast<std::size_t>(vertex_count(q.simplex));
    const auto m = static_cast<std::size_t>(mid_node_count(q.simplex));
    if (mid_nodes * n != q.corners.size() * m)
        return size_error("number of mid-edge nodes",
                          std::to_string(m) + " for each " + std::to_string(n) + " of the " +
                              std::to_string(q.corners.size()) + " corners",
                          mid_nodes);
    return check_sizes(q, places, static_cast<std::size_t>(components));
}

/// The components with a value that takes part and is not finite; what is not finite is overwritten. A function of its
/// own, for its integers must not lie on the stack below those of the value.
[[gnu::noinline]] std::vector<int> unusable_components(Simplex s, const SingleCase& c, double* values, int components) {
    const auto nodes = static_cast<std::size_t>(vertex_count(s) + mid_node_count(s));
    std::vector<int> unusable;
    std::optional<ExactWeights> weights;
    for (int component = 0; component < components; ++component) {
        const std::span of_component(values + nodes * static_cast<std::size_t>(component), nodes);
        if (base::all_finite(of_component)) continue;
        if (!weights) weights.emplace(s, c.vertices.data(), c.point.data());
        if (!weights->leave_out_not_finite(of_component)) unusable.push_back(component);
    }
    return unusable;
}

/// Values of the last tier: component c at node i of the case is values[nodes * c + i]; those that are not finite are
/// overwritten. Coordinates are finite.
ExactCase exact_values(Simplex s, const SingleCase& c, double* values, int components, double* out) {
    const std::vector<int> unusable = unusable_components(s, c, values, components);
    ExactCase found{.finite_values = unusable.empty()};
    found.degenerate = !exact_quadratic(s, c.vertices.data(), c.point.data(), values, components, out);
    if (found.degenerate) std::fill_n(out, components, nan);
    for (const int component : unusable) out[component] = nan;
    return found;
}

}  // namespace
}  // namespace barycert::core

namespace barycert {

Result<Value> interpolate_quadratic(Simplex simplex, const double* vertices, const double* point,
                                    const double* values) {
    if (Status known = core::check_fills_space(simplex, "quadratic interpolation"); !known) return known.error();
    const ExactEnvironment environment;
    const int nodes = vertex_count(simplex) + mid_node_count(simplex);
    const double* at[10] = {};
    for (int i = 0; i < nodes; ++i) at[i] = values + i;
    const core::CaseBlock block = core::single_block(simplex, vertices, point);
    Value v;
    double* const out[1] = {&v.value};
    std::uint32_t undecided[1];
    if (core::quadratic_lanes(Rounding::correct, simplex, block, at, 1, out, undecided) == 0) return v;
    if (!core::all_finite(simplex, vertices, point)) return core::not_finite_error(simplex, vertices, point);
    double f[10];
    std::copy_n(values, nodes, f);
    v.tier = Tier::exact;
    v.degenerate = core::exact_values(simplex, core::single_case(simplex, block, 0), f, 1, &v.value).degenerate;
    return v;
}

Status interpolate_quadratic(const MeshQueries& queries, std::span<const std::int32_t> mid_nodes,
                             const NodalValues<double>& values, std::span<double> out, TierCounts* tiers,
                             Rounding rounding) {
    const Simplex s = queries.simplex;
    const int components = values.components;
    if (Status sizes = core::check_quadratic(queries, mid_nodes.size(), components, out.size()); !sizes) return sizes;
    const ExactEnvironment environment;
    const auto stride = static_cast<std::size_t>(components);
    const auto n = static_cast<std::size_t>(vertex_count(s)), m = static_cast<std::size_t>(mid_node_count(s));
    core::GatheredValues<double> block_values(values, n + m);
    const core::LaneArrays results(stride);
    std::vector<double> single((n + m) * stride);  // of one case
    const bool plain = rounding == Rounding::plain;
    return core::for_blocks(
        queries, Tier::double_double, plain ? nullptr : tiers,
        [&](std::size_t first, const core::CaseBlock& block, std::uint32_t* undecided) {
            const double* const* const nodal = block_values.block(queries, first, block.count);
            block_values.gather(n, m, block.count, [&](std::size_t j) {
                return mid_nodes.data() + m * static_cast<std::size_t>(queries.cells[first + j]);
            });
            const std::size_t left =
                core::quadratic_lanes(rounding, s, block, nodal, components, results.data(), undecided);
            double* const to = out.data() + stride * first;
            results.copy_out(block.count, to);
            if (!plain) return left;
            core::mend_plain_values(s, block, {undecided, left}, nodal, static_cast<int>(n + m), components, to);
            return std::size_t{0};
        },
        [&](std::size_t first, std::size_t j, const core::SingleCase& c) {
            for (std::size_t i = 0; i < single.size(); ++i) single[i] = block_values.arrays()[i][j];
            return core::exact_values(s, c, single.data(), components, out.data() + stride * (first + j));
        });
}

}  // namespace barycert
