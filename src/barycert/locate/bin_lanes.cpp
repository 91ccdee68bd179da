#include "barycert/locate/bin_lanes.hpp"

#include <algorithm>

#include "barycert/locate/occupancy.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "barycert/locate/bin_lanes.cpp"
#include "barycert/core/foreach_target.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::locate {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using locate::CellIndex;
using locate::Occupancy;
using locate::Quantizer;

template <class D, std::size_t d, class V = hn::Vec<D>>
HWY_INLINE void load_points(D tag, const double* from, V (&x)[d]) {
    if constexpr (d == 3) {
        hn::LoadInterleaved3(tag, from, x[0], x[1], x[2]);
    } else {
        hn::LoadInterleaved2(tag, from, x[0], x[1]);
    }
}

/// Points one vector at a time. The arithmetic is the quantizer's, operation for operation.
template <std::size_t d, class D>
class BinsOfPoints {
public:
    using V = hn::Vec<D>;
    using I = hn::Rebind<std::int32_t, D>;

    HWY_INLINE BinsOfPoints(const CellIndex& index, const Occupancy* occupancy)
        : index_(index), occupancy_(occupancy), strange_(hn::Zero(D())) {}

    HWY_INLINE void find(const double* from, std::uint32_t* to) {
        const D tag;
        const I integers;
        V x[d];
        load_points(tag, from, x);
        auto in_box = hn::MaskFromVec(hn::Zero(tag));
        for (std::size_t k = 0; k < d; ++k) {
            const V zero = x[k] - x[k];  // of finite numbers alone
            strange_ = strange_ + zero;
            const auto within =
                hn::And(hn::Ge(x[k], hn::Set(tag, index_.low[k])), hn::Le(x[k], hn::Set(tag, index_.high[k])));
            in_box = k == 0 ? within : hn::And(in_box, within);
        }
        const Quantizer& quantizer = index_.bins.quantizer();
        hn::Vec<I> q[d];
        auto bin = hn::Zero(integers);
        for (std::size_t k = 0; k < d; ++k) {
            const V t =
                (x[k] * hn::Set(tag, 0.5) - hn::Set(tag, quantizer.half_low(k))) * hn::Set(tag, quantizer.scale(k));
            // At least zero in the box; others become zero, so that every place below is one of the tables.
            const V inside = hn::IfThenElseZero(in_box, hn::Min(t, hn::Set(tag, double{Quantizer::max})));
            q[k] = hn::DemoteTo(integers, inside);
            const auto* const curve = reinterpret_cast<const std::int32_t*>(index_.bins.curve(k));
            bin = hn::Or(bin, hn::GatherIndex(integers, curve, hn::ShiftRightSame(q[k], index_.bins.shift(k))));
        }
        // no_bin has all bits set.
        bin = hn::Or(bin, hn::DemoteTo(integers, hn::IfThenElse(in_box, hn::Zero(tag), hn::Set(tag, -1))));
        if (occupancy_ != nullptr) bin = hn::Or(bin, all_bits_if_empty(q));
        hn::StoreU(bin, integers, reinterpret_cast<std::int32_t*>(to));
    }

    HWY_INLINE bool all_finite() const { return hn::AllTrue(D(), hn::Eq(strange_, hn::Zero(D()))); }

private:
    HWY_INLINE hn::Vec<I> all_bits_if_empty(const hn::Vec<I> (&q)[d]) const {
        const I integers;
        auto row = hn::Zero(integers);
        for (std::size_t k = d - 1; k > 0; --k)
            row = hn::Or(hn::ShiftLeftSame(row, occupancy_->bits(k)),
                         hn::ShiftRightSame(q[k], Quantizer::bits - occupancy_->bits(k)));
        const auto column = hn::ShiftRightSame(q[0], Quantizer::bits - occupancy_->bits(0));
        const auto word = hn::Or(hn::ShiftLeftSame(row, occupancy_->bits(0) - Occupancy::word_bits),
                                 hn::ShiftRight<Occupancy::word_bits>(column));
        const auto* const words = reinterpret_cast<const std::int32_t*>(occupancy_->words());
        const auto bit = hn::And(column, hn::Set(integers, (1 << Occupancy::word_bits) - 1));
        const auto one = hn::Set(integers, 1);
        return hn::And(hn::Shr(hn::GatherIndex(integers, words, word), bit), one) - one;
    }

    const CellIndex& index_;
    const Occupancy* occupancy_;
    V strange_;
};

template <std::size_t d>
bool find_bins_of(const CellIndex& index, const Occupancy* occupancy, std::span<const double> points,
                  std::uint32_t* bin) {
    const hn::CappedTag<double, 8> tag;
    constexpr std::size_t width = hn::MaxLanes(hn::CappedTag<double, 8>());
    BinsOfPoints<d, hn::CappedTag<double, 8>> bins(index, occupancy);
    const std::size_t count = points.size() / d;
    std::size_t at = 0;
    for (; at + width <= count; at += width) bins.find(points.data() + d * at, bin + at);
    if (at < count) {
        double rest[d * width] = {};
        std::uint32_t found[width];
        std::copy(points.data() + d * at, points.data() + d * count, rest);
        bins.find(rest, found);
        std::copy(found, found + (count - at), bin + at);
    }
    static_cast<void>(tag);
    return bins.all_finite();
}

bool find_bins(const CellIndex& index, const Occupancy* occupancy, std::span<const double> points, std::uint32_t* bin) {
    return index.simplex == Simplex::triangle ? find_bins_of<2>(index, occupancy, points, bin)
                                              : find_bins_of<3>(index, occupancy, points, bin);
}

}  // namespace HWY_NAMESPACE
}  // namespace barycert::locate
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::locate {

HWY_EXPORT(find_bins);

bool find_bins(const CellIndex& index, const Occupancy* occupancy, std::span<const double> points, std::uint32_t* bin) {
    return HWY_DYNAMIC_DISPATCH(find_bins)(index, occupancy, points, bin);
}

}  // namespace barycert::locate
#endif
