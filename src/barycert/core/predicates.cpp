#include "barycert/predicates.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "barycert/core/blocks.hpp"
#include "barycert/core/exact_weights.hpp"
#include "barycert/core/lanes.hpp"
#include "barycert/core/point_arguments.hpp"
#include "barycert/environment.hpp"

namespace barycert {
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

template <class Batch>
Status batch_signs(const Batch& batch, std::span<WeightSigns> out, TierCounts* tiers) {
    const ExactEnvironment environment;  // for the tiers: signs are the same without
    const Simplex s = batch.simplex;
    if (Status sizes = check_sizes(batch, out.size(), 1); !sizes) return sizes;
    TierCounts counts;
    Status status = for_blocks(
        batch,
        [&](std::size_t first, const lanes::Cases& block, std::uint32_t* undecided) {
            const std::size_t left = lanes::signs(s, block, out.data() + first, undecided);
            counts.add(Tier::filter, block.count - left);
            return left;
        },
        [&](std::size_t first, std::size_t j, const SingleCase& c) {
            out[first + j] = exact_signs(s, c.vertices.data(), c.point.data());
            counts.add(Tier::exact);
            counts.degenerate += out[first + j].degenerate() ? 1 : 0;
        });
    if (status && tiers != nullptr) tiers->add(counts);
    return status;
}

double largest(double x, double y, double z) {
    return std::max(std::max(std::fabs(x), std::fabs(y)), std::fabs(z));
}

// The same ranges and constants as the numerators of filter-inl.hpp, which derives them: 2 terms of 4 roundings, and 6
// of 8 (there the last sign costs no rounding).
constexpr double epsilon = 0x1p-52;

bool in_range(double extent) {
    return extent >= 0x1p-300 && extent <= 0x1p300;
}

/// Sign of det(u, v, w) for the differences u = points[1] - points[0], v = points[3] - points[2], w = points[5] -
/// points[4], if the bound proves it; otherwise 0. A coordinate that is not finite proves nothing: each is in a
/// difference, which makes an extent infinite or the determinant NaN.
[[gnu::always_inline]] inline int filtered_det3d(const double* const (&points)[6]) {
    double u[3], v[3], w[3], extent[3];
    for (int k = 0; k < 3; ++k) {
        u[k] = points[1][k] - points[0][k];
        v[k] = points[3][k] - points[2][k];
        w[k] = points[5][k] - points[4][k];
        extent[k] = largest(u[k], v[k], w[k]);
    }
    const auto [x, y, z] = extent;
    const double det =
        u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) + u[2] * (v[0] * w[1] - v[1] * w[0]);
    if (in_range(x) && in_range(y) && in_range(z) && std::fabs(det) > 49 * epsilon * (x * y * z))
        return det < 0 ? -1 : 1;
    return 0;
}

/// Sign of det(b - a, c - a) likewise.
[[gnu::always_inline]] inline int filtered_orient2d(const double* a, const double* b, const double* c) {
    const double ux = b[0] - a[0], uy = b[1] - a[1], vx = c[0] - a[0], vy = c[1] - a[1];
    const double x = std::max(std::fabs(ux), std::fabs(vx)), y = std::max(std::fabs(uy), std::fabs(vy));
    const double det = ux * vy - uy * vx;
    if (in_range(x) && in_range(y) && std::fabs(det) > 8.5 * epsilon * (x * y)) return det < 0 ? -1 : 1;
    return 0;
}

/// The signs, if the filter proves them; where it does not, the coordinates may not be finite.
bool filtered_signs(Simplex simplex, const double* vertices, const double* point, WeightSigns& out, TierCounts* tiers) {
    std::uint32_t undecided[1];
    if (lanes::signs(simplex, as_block(simplex, vertices, point), &out, undecided) != 0) return false;
    if (tiers != nullptr) tiers->add(Tier::filter);
    return true;
}

WeightSigns counted_exact_signs(Simplex simplex, const double* vertices, const double* point, TierCounts* tiers) {
    const WeightSigns out = exact_signs(simplex, vertices, point);
    if (tiers != nullptr) {
        tiers->add(Tier::exact);
        tiers->degenerate += out.degenerate() ? 1 : 0;
    }
    return out;
}

}  // namespace

Sign orient2d(const double* a, const double* b, const double* c) noexcept {
    const int sign = filtered_orient2d(a, b, c);
    if (sign != 0) return static_cast<Sign>(sign);
    return exact_sign(std::array{a, b, c}, 2, [=] { return exact_orient2d(a, b, c); });
}

Sign orient3d(const double* a, const double* b, const double* c, const double* d) noexcept {
    const int sign = filtered_det3d({a, b, a, c, a, d});
    if (sign != 0) return static_cast<Sign>(sign);
    return exact_sign(std::array{a, b, c, d}, 3, [=] { return exact_orient3d(a, b, c, d); });
}

Sign det3d(const double* p, const double* q, const double* r, const double* s, const double* t,
           const double* u) noexcept {
    const int sign = filtered_det3d({p, q, r, s, t, u});
    if (sign != 0) return static_cast<Sign>(sign);
    return exact_sign(std::array{p, q, r, s, t, u}, 3, [=] { return exact_det3d(p, q, r, s, t, u); });
}

Result<Sign> checked_orient2d(const double* a, const double* b, const double* c) {
    const int sign = filtered_orient2d(a, b, c);
    if (sign != 0) return static_cast<Sign>(sign);
    return checked_exact_sign(std::array{a, b, c}, 2, [=] { return exact_orient2d(a, b, c); });
}

Result<Sign> checked_orient3d(const double* a, const double* b, const double* c, const double* d) {
    const int sign = filtered_det3d({a, b, a, c, a, d});
    if (sign != 0) return static_cast<Sign>(sign);
    return checked_exact_sign(std::array{a, b, c, d}, 3, [=] { return exact_orient3d(a, b, c, d); });
}

Result<Sign> checked_det3d(const double* p, const double* q, const double* r, const double* s, const double* t,
                           const double* u) {
    const int sign = filtered_det3d({p, q, r, s, t, u});
    if (sign != 0) return static_cast<Sign>(sign);
    return checked_exact_sign(std::array{p, q, r, s, t, u}, 3, [=] { return exact_det3d(p, q, r, s, t, u); });
}

WeightSigns weight_signs(Simplex simplex, const double* vertices, const double* point, TierCounts* tiers) noexcept {
    const ExactEnvironment environment;  // for the tier
    WeightSigns out;
    if (filtered_signs(simplex, vertices, point, out, tiers)) return out;
    assert(all_finite(simplex, vertices, point));
    return counted_exact_signs(simplex, vertices, point, tiers);
}

Result<WeightSigns> checked_weight_signs(Simplex simplex, const double* vertices, const double* point,
                                         TierCounts* tiers) {
    const ExactEnvironment environment;  // for the tier
    WeightSigns out;
    if (filtered_signs(simplex, vertices, point, out, tiers)) return out;
    if (!all_finite(simplex, vertices, point)) return not_finite_error(simplex, vertices, point);
    return counted_exact_signs(simplex, vertices, point, tiers);
}

Status weight_signs(const CaseArrays& cases, std::span<WeightSigns> out, TierCounts* tiers) {
    return batch_signs(cases, out, tiers);
}

Status weight_signs(const MeshQueries& queries, std::span<WeightSigns> out, TierCounts* tiers) {
    return batch_signs(queries, out, tiers);
}

}  // namespace barycert
