#include "barycert/locate/cell_signs.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "barycert/base/strict_math.hpp"
#include "barycert/predicates.hpp"

namespace barycert::locate {
namespace {

/// Vertices relative to the point, and for each weight whether all other vertices share a coordinate with the point.
/// That is asked of the bits: where subnormal numbers are flushed, numbers may compare equal that are not.
template <std::size_t d>
struct Situation {
    double r[d + 1][d];
    double extent[d] = {};
    bool zero[d + 1] = {};

    Situation(const CellIndex& index, const CellRecord& cell, const double* p) {
        for (std::size_t k = 0; k < d; ++k) {
            std::size_t equal = 0, other = 0;
            for (std::size_t i = 0; i <= d; ++i) {
                const double v = index.nodes[static_cast<std::size_t>(cell.node[i])].at[k];
                r[i][k] = v - p[k];
                extent[k] = std::max(extent[k], std::abs(r[i][k]));
                const bool same = std::bit_cast<std::uint64_t>(v) == std::bit_cast<std::uint64_t>(p[k]);
                equal += same ? 1 : 0;
                other += same ? 0 : i;
            }
            if (equal == d) zero[other] = true;
        }
    }
};

/// As filter-inl.hpp, whose bounds these are.
template <std::size_t d>
std::optional<WeightSigns> filtered(const Situation<d>& s) {
    const auto& r = s.r;
    double product = 1;
    for (std::size_t k = 0; k < d; ++k) {
        if (!(s.extent[k] >= 0x1p-300 && s.extent[k] <= 0x1p300)) return std::nullopt;
        product *= s.extent[k];
    }
    double n[d + 1], denominator;
    if constexpr (d == 3) {
        const auto cross = [&](std::size_t i, std::size_t j, double(&out)[3]) {
            out[0] = r[i][1] * r[j][2] - r[i][2] * r[j][1];
            out[1] = r[i][2] * r[j][0] - r[i][0] * r[j][2];
            out[2] = r[i][0] * r[j][1] - r[i][1] * r[j][0];
        };
        const auto dot = [&](std::size_t i, const double(&x)[3]) {
            return r[i][0] * x[0] + r[i][1] * x[1] + r[i][2] * x[2];
        };
        double m01[3], m23[3];
        cross(0, 1, m01);
        cross(2, 3, m23);
        n[0] = dot(1, m23);
        n[1] = -dot(0, m23);
        n[2] = dot(3, m01);
        n[3] = -dot(2, m01);
        denominator = (n[0] + n[1]) + (n[2] + n[3]);
    } else {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto &a = r[(i + 1) % 3], &b = r[(i + 2) % 3];
            n[i] = a[0] * b[1] - a[1] * b[0];
        }
        denominator = n[0] + n[1] + n[2];
    }
    constexpr double e = 0x1p-52;
    const double numerator_bound = (d == 3 ? 49 : 8.5) * e * product;
    if (!(std::abs(denominator) > (d == 3 ? 245 : 37) * e * product)) return std::nullopt;
    unsigned bits = denominator < 0 ? 0x100 : 0;
    for (std::size_t i = 0; i <= d; ++i) {
        if (s.zero[i]) {
            bits |= 0x10U << i;
        } else if (std::abs(n[i]) > numerator_bound) {
            bits |= ((n[i] < 0) != (denominator < 0) ? 1U : 0U) << i;
        } else {
            return std::nullopt;
        }
    }
    return WeightSigns(static_cast<WeightSigns::Bits>(bits));
}

template <std::size_t d>
WeightSigns signs(const CellIndex& index, Place cell, const double* point, TierCounts& tiers) {
    const Situation<d> situation(index, index.cells[static_cast<std::size_t>(cell)], point);
    if (const auto certain = filtered<d>(situation)) {
        tiers.add(Tier::filter);
        return *certain;
    }
    // All numbers are finite: there is no Error.
    return weight_signs(index.simplex, vertices_of(index, cell).data(), point, &tiers);
}

}  // namespace

WeightSigns cell_signs(const CellIndex& index, Place cell, const double* point, TierCounts& tiers) {
    return index.simplex == Simplex::triangle ? signs<2>(index, cell, point, tiers)
                                              : signs<3>(index, cell, point, tiers);
}

}  // namespace barycert::locate
