// Internal: cells with few points in their boxes look at all of them.
//
// Included once per SIMD target.
#if defined(BARYCERT_SAMPLE_FILL_POINTS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_SAMPLE_FILL_POINTS_INL_HPP
#undef BARYCERT_SAMPLE_FILL_POINTS_INL_HPP
#else
#define BARYCERT_SAMPLE_FILL_POINTS_INL_HPP
#endif

#include "mesh/sample/grid/fill_block-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::sample::HWY_NAMESPACE {

/// The points that a cell with few points in its box holds: entries [begin, end) of a list of places. Points of which
/// this is open follow, up to open_end, where there is one value a point.
struct BoxFill {
    std::size_t block, lane, begin, end, open_end;
};

/// Where place `place` of a box is in the grid.
template <int d>
HWY_INLINE std::array<std::int32_t, 3> in_grid(const CellBlock<d>& cells, std::size_t l, std::int32_t place) {
    return {cells.first[0][l] + (place & (box_side - 1)), cells.first[1][l] + (place >> box_bits & (box_side - 1)),
            (d == 3 ? cells.first[d - 1][l] : 0) + (place >> 2 * box_bits)};
}

/// Lists, from the vector at entry `at` on, the points of which it is open whether the cell holds them.
template <template <int> class Values, int d>
HWY_NOINLINE void list_open(const Filling<d>& to, const FillBlock<Values, d>& b, const BoxFill& one,
                            const std::int32_t* found, std::size_t at, std::size_t width, const double* values,
                            std::uint32_t certain) {
    for (std::size_t i = std::max(at, one.end); i < std::min(at + width, one.open_end); ++i) {
        const std::array<std::int32_t, 3> n = in_grid(b.cells, one.lane, found[i]);
        to.undecided.points.push_back(
            {b.place[one.lane], n[0], n[1], n[2], values[i - at], (certain >> (i - at) & 1) != 0});
    }
}

/// Writes the values of component c of the points, which are numbered from `base` on; one_number: and their owner.
template <bool one_number, template <int> class Values, int d, class D>
HWY_INLINE void fill_box_component(D tag, const Filling<d>& to, const FillBlock<Values, d>& b, const BoxFill& one,
                                   const std::int32_t* found, std::size_t c, std::size_t base, std::uint8_t* certain) {
    using V = hn::Vec<D>;
    constexpr std::size_t width = hn::MaxLanes(D());
    const hn::Rebind<std::int32_t, D> whole;
    const hn::RebindToSigned<D> index;
    const FillTarget& target = to.target;
    const std::size_t l = one.lane;
    const Mesh::Index id = b.id[l];
    typename Values<d>::Table table;
    Values<d>::set_table(tag, to.source.raster, b.cells, b.values[c], l, table);
    const auto mask = hn::Set(whole, box_side - 1);
    const auto line = hn::Set(whole, static_cast<std::int32_t>(target.columns));
    const auto plane = hn::Set(whole, static_cast<std::int32_t>(target.columns * target.rows));
    const std::size_t last = one_number ? one.open_end : one.end;
    for (std::size_t at = one.begin; at < last; at += width) {
        const auto place = hn::LoadU(whole, found + at);
        const auto column = hn::And(place, mask), row = hn::And(hn::ShiftRight<box_bits>(place), mask);
        auto offset = column + row * line;
        hn::Vec<decltype(index)> places[d];
        places[0] = hn::PromoteTo(index, column);
        places[1] = hn::PromoteTo(index, row);
        if constexpr (d == 3) {
            const auto layer = hn::And(hn::ShiftRight<2 * box_bits>(place), mask);
            offset = offset + layer * plane;
            places[2] = hn::PromoteTo(index, layer);
        }
        HWY_ALIGN std::int32_t offsets[max_lanes];
        hn::Store(offset, whole, offsets);
        const std::size_t used = at < one.end ? std::min(width, one.end - at) : 0;
        const auto point = [&](std::size_t i) { return base + static_cast<std::size_t>(offsets[i]); };
        std::uint32_t bits;
        const V value = Values<d>::at_places(tag, b.values[c], l, table, places, bits);
        HWY_ALIGN double values[max_lanes];
        hn::Store(value, tag, values);
        if constexpr (one_number) {
            for (std::size_t i = 0; i < used; ++i) {
                const Mesh::Index before = target.owner[point(i)];
                if (HWY_UNLIKELY(before >= 0)) {
                    if (before < id) continue;
                    target.set_feature(point(i), Feature::interior, true);
                }
                target.values[point(i)] = values[i];
                target.owner[point(i)] = id;
            }
            for (std::uint32_t rest = ~bits & ((1U << used) - 1); HWY_UNLIKELY(rest != 0); rest &= rest - 1) {
                const std::size_t one_of_them = point(static_cast<std::size_t>(__builtin_ctz(rest)));
                if (target.owner[one_of_them] == id) target.set_feature(one_of_them, Feature::interior, false);
            }
            if (HWY_UNLIKELY(at + width > one.end && one.end != one.open_end))
                list_open(to, b, one, found, at, width, values, bits);
        } else {
            *certain = static_cast<std::uint8_t>(c == 0 ? bits : *certain & bits);
            ++certain;
            for (std::size_t i = 0; i < used; ++i) {
                if (!to.target.kept(point(i), id)) target.values[target.stride * point(i) + c] = values[i];
            }
        }
    }
}

template <template <int> class Values, int d, class D>
HWY_INLINE void fill_box(D tag, const Filling<d>& to, const FillBlock<Values, d>& b, const BoxFill& one,
                         const std::int32_t* found) {
    const std::size_t base = to.first_of_box(b.cells, one.lane);
    if (to.one_number()) {
        fill_box_component<true>(tag, to, b, one, found, 0, base, nullptr);
        return;
    }
    constexpr std::size_t width = hn::MaxLanes(D());
    std::uint8_t certain[box_points / width] = {};
    for (std::size_t c = 0; c < to.components(); ++c)
        fill_box_component<false>(tag, to, b, one, found, c, base, certain);
    const Mesh::Index id = b.id[one.lane];
    for (std::size_t i = 0; i < one.end - one.begin; ++i) {
        const auto place = static_cast<std::size_t>(found[one.begin + i]);
        const std::size_t row = place >> box_bits & (box_side - 1), layer = place >> 2 * box_bits;
        const std::size_t point = base + (place & (box_side - 1)) + (layer * to.target.rows + row) * to.target.columns;
        if (!to.target.kept(point, id)) to.own(point, id, (certain[i / width] >> i % width & 1) != 0);
    }
}

template <template <int> class Values, int d>
HWY_NOINLINE void list_undecided(const Filling<d>& to, const FillBlock<Values, d>& b, std::size_t l,
                                 const BoxPlaces& open) {
    for (std::size_t i = 0; i < open.count; ++i) {
        const auto [column, row, layer] = in_grid(b.cells, l, open.place[i]);
        to.undecided.spans.push_back({b.place[l], row, layer, column, column + 1, column + 1, column + 1});
    }
}

template <int d>
HWY_INLINE BoxTarget target_of(const Filling<d>& to, std::size_t point) {
    const FillTarget& target = to.target;
    const std::size_t plane = target.columns * target.rows, value = sizeof(double) * target.stride;
    constexpr std::size_t owner = sizeof(Mesh::Index);
    return {reinterpret_cast<std::uintptr_t>(target.values) + value * point,
            reinterpret_cast<std::uintptr_t>(target.owner) + owner * point,
            value * target.columns,
            value * plane,
            owner * target.columns,
            owner * plane};
}

/// Cells with few points in their boxes. All find their points before the first of these are read: a vector of what was
/// just stored in parts would have to wait.
template <template <int> class Values, int d, class D>
HWY_INLINE void fill_boxes(D tag, const Filling<d>& to, const FillBlock<Values, d>* blocks, std::size_t count) {
    constexpr std::size_t room = 8 * box_points;
    HWY_ALIGN std::int32_t found[room + box_lanes], opens[box_points + box_lanes];
    BoxFill fills[blocks_at_once * max_lanes];
    BoxPlaces inside{found};
    std::size_t cells = 0;
    const auto fill = [&]() HWY_ATTR {
        for (std::size_t i = 0; i < cells; ++i) fill_box(tag, to, blocks[fills[i].block], fills[i], found);
        inside.count = cells = 0;
    };
    for (std::size_t i = 0; i < count; ++i) {
        const FillBlock<Values, d>& b = blocks[i];
        for (std::uint32_t bits = b.box; bits != 0; bits &= bits - 1) {
            if (room - inside.count < box_points) fill();
            const auto l = static_cast<std::size_t>(__builtin_ctz(bits));
            const std::size_t begin = inside.count;
            const BoxTarget target = target_of(to, to.first_of_box(b.cells, l) + 2);
            const bool decided = find_box_points<d>(b.cells, b.boxes, l, inside, target);
            const std::size_t end = inside.count;
            if (HWY_UNLIKELY(!decided)) {
                if (to.one_number()) {
                    find_open_points<d>(b.cells, b.boxes, l, inside);
                } else {
                    BoxPlaces open{opens};
                    find_open_points<d>(b.cells, b.boxes, l, open);
                    list_undecided(to, b, l, open);
                }
            }
            fills[cells] = {i, l, begin, end, inside.count};
            cells += inside.count != begin ? 1 : 0;
        }
    }
    fill();
}

}  // namespace barycert::sample::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
