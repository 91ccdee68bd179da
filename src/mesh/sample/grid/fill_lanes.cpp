// Cells, a vector of them at a time, fill in the points of a grid that they hold. Cells with few points in their boxes
// look at all of them (fill_points-inl.hpp); others find where each row enters and leaves them (fill_rows-inl.hpp).
#include "mesh/sample/grid/fill_lanes.hpp"
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>
#include "barycert/simplex.hpp"
#include "barycert/weights.hpp"
#include "mesh/index/cell_index.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "mesh/sample/grid/fill_lanes.cpp"
#include "core/foreach_target.hpp"

#include "mesh/sample/grid/fill_points-inl.hpp"
#include "mesh/sample/grid/fill_rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::sample::HWY_NAMESPACE {

template <template <int> class Values, int d>
void fill_all(const FillSource& source, std::span<const locate::Place> cells, const FillTarget& target,
              UndecidedFill& undecided) {
    const hn::ScalableTag<double> tag;
    constexpr std::size_t width = hn::MaxLanes(hn::ScalableTag<double>());
    const Filling<d> to{source, target, undecided};
    FillBlock<Values, d> blocks[blocks_at_once];
    RowsBlock<d> rows;
    std::vector<typename Values<d>::CellValues> values(to.components() * blocks_at_once);
    std::vector<typename Values<d>::RowTerms> terms(to.components());
    for (std::size_t i = 0; i < blocks_at_once; ++i) blocks[i].values = values.data() + i * to.components();
    std::size_t count = 0;
    for (std::size_t at = 0; at < cells.size(); at += width) {
        FillBlock<Values, d>& b = blocks[count];
        for (std::size_t l = 0; l < width; ++l) {
            const auto later = [&](std::size_t ahead) {
                return source.index.cells.data() + cells[std::min(at + ahead * width + l, cells.size() - 1)];
            };
            b.place[l] = cells[std::min(at + l, cells.size() - 1)];
            // Fetches the nodes of a cell two vectors ahead, and the numbers of the nodes of one eight vectors ahead.
            __builtin_prefetch(later(8));
            for (std::size_t i = 0; i <= d; ++i) __builtin_prefetch(source.nodes.first + later(2)->node[i]);
        }
        set_block(tag, to, b, rows);
        std::uint32_t holding = (1U << std::min(width, cells.size() - at)) - 1;
        for (std::size_t l = 0; l < width; ++l) {
            for (int k = 0; k < d; ++k)
                holding &= ~(static_cast<std::uint32_t>(b.cells.first[k][l] >= b.cells.last[k][l]) << l);
        }
        b.box &= holding;
        for (std::uint32_t others = holding & ~b.box; others != 0; others &= others - 1) {
            const auto l = static_cast<std::size_t>(__builtin_ctz(others));
            if ((b.valid >> l & 1) != 0) {
                fill_rows(tag, to, b, rows, l, terms.data());
            } else {
                undecided.cells.push_back(b.place[l]);
            }
        }
        if (++count < blocks_at_once && at + width < cells.size()) continue;
        fill_boxes(tag, to, blocks, count);
        count = 0;
    }
}

void fill_cells(const FillSource& source, std::span<const locate::Place> cells, const FillTarget& target,
                UndecidedFill& undecided) {
    const bool plain = source.rounding == Rounding::plain;
    if (source.index.simplex == Simplex::triangle) {
        plain ? fill_all<PlainValues, 2>(source, cells, target, undecided)
              : fill_all<CorrectValues, 2>(source, cells, target, undecided);
    } else {
        plain ? fill_all<PlainValues, 3>(source, cells, target, undecided)
              : fill_all<CorrectValues, 3>(source, cells, target, undecided);
    }
}

// After that: points as they are left.

/// One by one.
HWY_INLINE void finish_point(const FillTarget& target, std::size_t point, const double* outside, FinishedPoints& out) {
    Feature& feature = target.feature[point];
    const bool owned = target.owner[point] >= 0, set = feature != Feature::outside;
    if (owned && !set) feature = Feature::interior;
    if (owned ? set && target.value_missing[point] != 0 : outside == nullptr) {
        out.others.push_back(static_cast<std::uint32_t>(point));
    } else if (owned) {
        out.locations.add(feature);
        ++out.with_value;
    } else {
        ++out.outside;
        std::fill_n(target.values + target.stride * point, target.stride, *outside);
    }
}

void finish_points(const FillTarget& target, std::size_t first, std::size_t last, const double* outside,
                   FinishedPoints& out) {
    const hn::ScalableTag<std::int32_t> tag;
    const hn::Rebind<std::int8_t, decltype(tag)> bytes;
    constexpr std::size_t width = hn::MaxLanes(hn::ScalableTag<std::int32_t>());
    const auto none = hn::Set(bytes, static_cast<std::int8_t>(Feature::outside));
    const auto interior = hn::Set(bytes, static_cast<std::int8_t>(Feature::interior));
    std::size_t point = first, inside = 0;
    for (; point + width <= last; point += width) {
        auto* const features = reinterpret_cast<std::int8_t*>(target.feature + point);
        const auto known = hn::LoadU(bytes, features);
        const auto unowned = hn::Lt(hn::LoadU(tag, target.owner + point), hn::Zero(tag));
        const std::size_t lost = hn::CountTrue(tag, unowned);
        const bool usual = hn::AllTrue(bytes, hn::Eq(known, none));
        if (usual && lost == 0) {
            hn::StoreU(interior, bytes, features);
            inside += width;
        } else if (usual && lost == width && outside != nullptr) {
            std::fill_n(target.values + target.stride * point, target.stride * width, *outside);
            out.outside += width;
        } else {
            for (std::size_t i = 0; i < width; ++i) finish_point(target, point + i, outside, out);
        }
    }
    out.locations.add(Feature::interior, inside);
    out.with_value += inside;
    for (; point < last; ++point) finish_point(target, point, outside, out);
}

}  // namespace barycert::sample::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::sample {

HWY_EXPORT(fill_cells);
HWY_EXPORT(finish_points);

void fill_cells(const FillSource& source, std::span<const locate::Place> cells, const FillTarget& target,
                UndecidedFill& undecided) {
    HWY_DYNAMIC_DISPATCH(fill_cells)(source, cells, target, undecided);
}

void finish_points(const FillTarget& target, std::size_t first, std::size_t last, const double* outside,
                   FinishedPoints& out) {
    HWY_DYNAMIC_DISPATCH(finish_points)(target, first, last, outside, out);
}

}  // namespace barycert::sample
#endif
