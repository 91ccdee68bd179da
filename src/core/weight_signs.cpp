#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>

#include "barycert/environment.hpp"
#include "barycert/predicates.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "core/blocks.hpp"
#include "core/exact_tier.hpp"
#include "core/lanes.hpp"

namespace barycert::core {
namespace {

WeightSigns exact_signs(Simplex s, const double* vertices, const double* point) {
    const ExactWeights w(s, vertices, point);
    if (w.degenerate()) return WeightSigns::degenerate_simplex();
    unsigned bits = w.orientation() < 0 ? 1U << 8 : 0;
    for (int i = 0; i < vertex_count(s); ++i) {
        if (w.sign(i) < 0) bits |= 1U << i;
        if (w.sign(i) == 0) bits |= 1U << (4 + i);
    }
    return WeightSigns(static_cast<WeightSigns::Bits>(bits));
}

/// The signs of one case, if the filter proves them. It does not where a coordinate is not finite.
bool filtered_signs(Simplex s, const double* vertices, const double* point, WeightSigns& out, TierCounts* tiers) {
    std::uint32_t undecided[1];
    if (sign_lanes(s, single_block(s, vertices, point), &out, undecided) != 0) return false;
    if (tiers != nullptr) tiers->add(Tier::filter);
    return true;
}

WeightSigns counted_exact_signs(Simplex s, const double* vertices, const double* point, TierCounts* tiers) {
    const WeightSigns out = exact_signs(s, vertices, point);
    if (tiers != nullptr) {
        tiers->add(Tier::exact);
        tiers->degenerate += out.degenerate() ? 1 : 0;
    }
    return out;
}

template <class Batch>
Status batch_signs(const Batch& batch, std::span<WeightSigns> out, TierCounts* tiers) {
    const ExactEnvironment environment;  // for the tiers: signs are the same without
    if (Status sizes = check_sizes(batch, out.size(), 1); !sizes) return sizes;
    return for_blocks(
        batch, Tier::filter, tiers,
        [&](std::size_t first, const CaseBlock& block, std::uint32_t* undecided) {
            return sign_lanes(batch.simplex, block, out.data() + first, undecided);
        },
        [&](std::size_t first, std::size_t j, const SingleCase& c) {
            out[first + j] = exact_signs(batch.simplex, c.vertices.data(), c.point.data());
            return ExactCase{.degenerate = out[first + j].degenerate()};
        });
}

}  // namespace
}  // namespace barycert::core

namespace barycert {

WeightSigns weight_signs(Simplex simplex, const double* vertices, const double* point, TierCounts* tiers) noexcept {
    const ExactEnvironment environment;  // for the tier
    WeightSigns out;
    if (core::filtered_signs(simplex, vertices, point, out, tiers)) return out;
    assert(core::all_finite(simplex, vertices, point));
    return core::counted_exact_signs(simplex, vertices, point, tiers);
}

Result<WeightSigns> checked_weight_signs(Simplex simplex, const double* vertices, const double* point,
                                         TierCounts* tiers) {
    const ExactEnvironment environment;  // for the tier
    WeightSigns out;
    if (core::filtered_signs(simplex, vertices, point, out, tiers)) return out;
    if (!core::all_finite(simplex, vertices, point)) return core::not_finite_error(simplex, vertices, point);
    return core::counted_exact_signs(simplex, vertices, point, tiers);
}

Status weight_signs(const CaseArrays& cases, std::span<WeightSigns> out, TierCounts* tiers) {
    return core::batch_signs(cases, out, tiers);
}

Status weight_signs(const MeshQueries& queries, std::span<WeightSigns> out, TierCounts* tiers) {
    return core::batch_signs(queries, out, tiers);
}

}  // namespace barycert
