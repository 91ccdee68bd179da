#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/base/disjoint_sets.hpp"
#include "core/base/vectors.hpp"
#include "mesh/index/bins.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/locate/surface/surface_data.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::locate {

SideMap::SideMap(const SurfaceData& surface) : bins_(&surface.triangles.index.bins) {
    const CellIndex& index = surface.triangles.index;
    // About eight bins a triangle, as cubes; at most 2^23.
    double extent[3], longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        extent[k] = index.high[k] / 2 - index.low[k] / 2;
        longest = std::max(longest, extent[k]);
    }
    const double wanted = std::clamp<double>(8.0 * static_cast<double>(surface.triangles.size()), 4096, 0x1p23);
    int bits = 1;
    const auto bits_of = [&](std::size_t k) {
        const double share = longest > 0 ? extent[k] / longest : 0;
        return std::clamp(share > 0 ? bits + std::ilogb(share) : 0, 0, 10);
    };
    while (bits < 10 && std::ldexp(1, bits_of(0) + bits_of(1) + bits_of(2)) < wanted) ++bits;
    for (std::size_t k = 0; k < 3; ++k) {
        shift_[k] = Quantizer::bits - bits_of(k);
        size_[k] = std::size_t{1} << bits_of(k);
    }
    sides_.assign(size_[0] * size_[1] * size_[2], 0);
    touch(surface);
    fill(surface);
}

/// Marks the bins of each triangle's box that its plane may pass through: a bin is wholly on one side if its middle is
/// farther from the plane than half the bin reaches along the normal.
void SideMap::touch(const SurfaceData& surface) {
    const Triangles& all = surface.triangles;
    const Quantizer& q = bins_->quantizer();
    base::parallel_for_each(all.size(), 512, [&](std::size_t t) {
        const auto& at = all.facets[t].at;
        std::int32_t low[3], high[3];
        double half[3];
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = on_axis(k, std::min({at[0][k], at[1][k], at[2][k]}));
            high[k] = on_axis(k, std::max({at[0][k], at[1][k], at[2][k]}));
            half[k] = 0.5 / static_cast<double>(size_[k]);
        }
        // In the quantizer's numbers, which are the same for all bins: no axis is much longer than another there.
        const auto place = [&](std::size_t i) {
            base::Vector3<double> p;
            for (std::size_t k = 0; k < 3; ++k) p[k] = std::ldexp(q.before_rounding(k, at[i][k]), -31);
            return p;
        };
        const auto a = place(0), normal = base::cross(base::minus(place(1), a), base::minus(place(2), a));
        // Numbers up to 1, a few roundings each: 2^-40 of the size of the normal's parts is far more than they make.
        double reach = 0, doubt = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            reach += std::fabs(normal[k]) * half[k];
            doubt = std::max(doubt, std::fabs(normal[k]));
        }
        reach += 0x1p-30 * std::max(doubt, 0x1p-10);
        for (std::int32_t k = low[2]; k <= high[2]; ++k) {
            for (std::int32_t j = low[1]; j <= high[1]; ++j) {
                const double part =
                    normal[1] * ((2 * j + 1) * half[1] - a[1]) + normal[2] * ((2 * k + 1) * half[2] - a[2]);
                for (std::int32_t i = low[0]; i <= high[0]; ++i) {
                    const double away = part + normal[0] * ((2 * i + 1) * half[0] - a[0]);
                    if (std::fabs(away) <= reach)
                        std::atomic_ref(sides_[bin(i, j, k)]).store(touched, std::memory_order_relaxed);
                }
            }
        }
    });
}

bool SideMap::middle_of(std::size_t at, double (&p)[3]) const {
    const std::size_t place[3] = {at % size_[0], at / size_[0] % size_[1], at / size_[0] / size_[1]};
    const Quantizer& q = bins_->quantizer();
    for (std::size_t k = 0; k < 3; ++k) {
        const auto first = static_cast<std::int32_t>(place[k] << shift_[k]);
        const std::int32_t middle = first + static_cast<std::int32_t>((std::int64_t{1} << shift_[k]) / 2);
        p[k] = q.scale(k) > 0 ? 2 * (q.half_low(k) + middle / q.scale(k)) : 2 * q.half_low(k);
        if (!std::isfinite(p[k]) || on_axis(k, p[k]) != static_cast<std::int32_t>(place[k])) return false;
    }
    return true;
}

/// Joins bins that no triangle touches, and asks one point of each set.
void SideMap::fill(const SurfaceData& surface) {
    base::DisjointSets sets(sides_.size());
    const std::size_t step[3] = {1, size_[0], size_[0] * size_[1]};
    for (std::size_t b = 0; b < sides_.size(); ++b) {
        if (sides_[b] == touched) continue;
        const std::size_t place[3] = {b % size_[0], b / size_[0] % size_[1], b / step[2]};
        for (int k = 0; k < 3; ++k) {
            if (place[k] != 0 && sides_[b - step[k]] != touched) sets.join(b, b - step[k]);
        }
    }
    // Locates each set of bins by the middle of its lowest bin.
    for (std::size_t b = 0; b < sides_.size(); ++b) {
        if (sides_[b] == touched || sets.find(b) != b) continue;
        double p[3];
        sides_[b] = touched;
        if (!middle_of(b, p)) continue;
        SideSum side;
        surface.locate(p, side);
        if (side.fits()) sides_[b] = side.code();
    }
    for (std::size_t b = 0; b < sides_.size(); ++b) {
        if (sides_[b] != touched) sides_[b] = sides_[sets.find(b)];
    }
}

std::int16_t SideMap::next(const double* point, double (&end)[3]) const {
    const std::int32_t j = on_axis(1, point[1]), k = on_axis(2, point[2]);
    end[1] = point[1];
    end[2] = point[2];
    const Quantizer& q = bins_->quantizer();
    for (auto i = on_axis(0, point[0]) + 1; i < static_cast<std::int32_t>(size_[0]); ++i) {
        const std::int16_t side = sides_[bin(i, j, k)];
        if (side == touched) continue;
        const double middle = (static_cast<double>(i) + 0.5) * std::ldexp(1, shift_[0]);
        end[0] = 2 * (q.half_low(0) + middle / q.scale(0));
        if (std::isfinite(end[0]) && on_axis(0, end[0]) == i && end[0] > point[0]) return side;
    }
    end[0] = std::numeric_limits<double>::infinity();
    return 0;
}

}  // namespace barycert::locate
