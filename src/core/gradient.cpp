#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "barycert/environment.hpp"
#include "barycert/predicates.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/weights.hpp"
#include "core/blocks.hpp"
#include "core/exact_tier.hpp"
#include "core/lanes.hpp"

namespace barycert::core {
namespace {

/// Whether the derivative by coordinate k of the weight of vertex i is not exactly zero: it is the size of the opposite
/// edge or face, seen along axis k, over that of the cell.
bool has_part(Simplex s, const double* vertices, int i, int k) {
    const int n = vertex_count(s), d = n - 1;
    double seen[3][2];
    for (int j = 0; j < d; ++j) {
        const double* const v = vertices + d * ((i + 1 + j) % n);
        seen[j][0] = v[k == 0 ? 1 : 0];
        seen[j][1] = v[k == 2 ? 1 : 2 % d];
    }
    if (s == Simplex::triangle) return seen[0][0] != seen[1][0];
    return exact_orient2d(seen[0], seen[1], seen[2]) != Sign::zero;
}

/// Gradients of the last tier in the cell at `vertices`: component k of that of field component c, whose value at
/// vertex i is values[n * c + i][j], is out[d * c + k]. Requires: coordinates finite.
ExactCase exact_gradients(Simplex s, const double* vertices, const double* const* values, std::size_t j, int components,
                          double* out) {
    const int n = vertex_count(s), d = space_dimension(s);
    ExactCase found;
    for (int c = 0; c < components; ++c, out += d) {
        double f[4] = {};
        for (int i = 0; i < n; ++i) f[i] = values[n * c + i][j];
        bool lost[3] = {};
        for (int i = 0; i < n; ++i) {
            if (std::isfinite(f[i])) continue;
            f[i] = 0;
            for (int k = 0; k < d; ++k) lost[k] = lost[k] || has_part(s, vertices, i, k);
        }
        found.degenerate = !exact_gradient(s, vertices, f, out);
        for (int k = 0; k < d; ++k) {
            if (!lost[k]) continue;
            out[k] = nan;
            found.finite_values = false;
        }
    }
    return found;
}

}  // namespace
}  // namespace barycert::core

namespace barycert {

Result<Gradient> gradient(Simplex simplex, const double* vertices, const double* values) {
    const ExactEnvironment environment;
    if (Status known = core::check_fills_space(simplex, "a gradient"); !known) return known.error();
    const double* f[4] = {};
    for (int i = 0; i < vertex_count(simplex); ++i) f[i] = values + i;
    Gradient g;
    double* const out[3] = {&g.gradient[0], &g.gradient[1], &g.gradient[2]};
    std::uint32_t undecided[1];
    const core::CaseBlock block = core::single_block(simplex, vertices, nullptr);
    if (core::gradient_lanes(simplex, block, f, 1, out, undecided) == 0) return g;
    if (!core::all_finite(simplex, vertices, nullptr)) return core::not_finite_error(simplex, vertices, nullptr);
    g.tier = Tier::exact;
    g.degenerate = core::exact_gradients(simplex, vertices, f, 0, 1, g.gradient.data()).degenerate;
    return g;
}

Status gradients(Simplex simplex, std::span<const double> nodes, std::span<const std::int32_t> corners,
                 const NodalValues<double>& values, std::span<double> out, TierCounts* tiers) {
    const ExactEnvironment environment;
    const int components = values.components;
    const core::MeshCells cells{simplex, nodes, corners};
    if (Status known = core::check_fills_space(simplex, "a gradient"); !known) return known;
    if (Status some = core::check_components(components); !some) return some;
    const std::size_t per_cell =
        static_cast<std::size_t>(space_dimension(simplex)) * static_cast<std::size_t>(components);
    if (Status sizes = core::check_sizes(cells, out.size(), per_cell); !sizes) return sizes;
    core::GatheredValues<double> block_values(values, static_cast<std::size_t>(vertex_count(simplex)));
    const core::LaneArrays results(per_cell);
    return core::for_blocks(
        cells, Tier::double_double, tiers,
        [&](std::size_t first, const core::CaseBlock& block, std::uint32_t* undecided) {
            const double* const* const nodal = block_values.block(cells, first, block.count);
            const std::size_t undecided_count =
                core::gradient_lanes(simplex, block, nodal, components, results.data(), undecided);
            results.copy_out(block.count, out.data() + per_cell * first);
            return undecided_count;
        },
        [&](std::size_t first, std::size_t j, const core::SingleCase& c) {
            return core::exact_gradients(simplex, c.vertices.data(), block_values.arrays(), j, components,
                                         out.data() + per_cell * (first + j));
        });
}

}  // namespace barycert
