// Internal: cells with many points in their boxes find where each row of points enters and leaves them.
//
// Included once per SIMD target.
#if defined(BARYCERT_SAMPLE_FILL_ROWS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_SAMPLE_FILL_ROWS_INL_HPP
#undef BARYCERT_SAMPLE_FILL_ROWS_INL_HPP
#else
#define BARYCERT_SAMPLE_FILL_ROWS_INL_HPP
#endif

#include "mesh/sample/grid/fill_block-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::sample::HWY_NAMESPACE {

/// Points [first, last) of row r, which begins at point `at`.
template <template <int> class Values, int d, class D>
HWY_INLINE void fill_row(D tag, const Filling<d>& to, const FillBlock<Values, d>& b, std::size_t l,
                         const typename Values<d>::RowTerms* terms, std::size_t r, PlaceRange columns, std::size_t at) {
    constexpr auto width = static_cast<std::int32_t>(hn::MaxLanes(D()));
    const FillTarget& target = to.target;
    const Mesh::Index id = b.id[l];
    for (std::int32_t column = columns.first; column < columns.last; column += width) {
        const std::int32_t used = std::min(width, columns.last - column);
        const auto x = load_some(tag, to.source.raster.at[0].data() + column, used);
        const std::size_t first = at + static_cast<std::size_t>(column);
        std::uint32_t certain = to.components() == 0 ? 0 : ~0U;
        bool alone = to.one_number();
        for (std::size_t i = 0; i < static_cast<std::size_t>(used); ++i) alone &= target.owner[first + i] < 0;
        for (std::size_t c = 0; c < to.components(); ++c) {
            std::uint32_t bits;
            const auto value = Values<d>::at_row(tag, b.cells, b.values[c], l, terms[c], r, x, bits);
            certain &= bits;
            if (alone) {
                store_some(tag, value, target.values + first, used);
                continue;
            }
            HWY_ALIGN double values[max_lanes];
            hn::Store(value, tag, values);
            for (std::size_t i = 0; i < static_cast<std::size_t>(used); ++i) {
                if (!to.target.kept(first + i, id)) target.values[target.stride * (first + i) + c] = values[i];
            }
        }
        for (std::size_t i = 0; i < static_cast<std::size_t>(used); ++i) {
            if (!to.target.kept(first + i, id)) to.own(first + i, id, (certain >> i & 1) != 0);
        }
    }
}

template <template <int> class Values, int d, class D>
HWY_INLINE void fill_rows(D tag, const Filling<d>& to, const FillBlock<Values, d>& b, const RowsBlock<d>& planes,
                          std::size_t l, typename Values<d>::RowTerms* terms) {
    constexpr std::size_t width = hn::MaxLanes(D());
    const PlaceRange columns = b.cells.places(0, l), lines = b.cells.places(1, l);
    const PlaceRange layers = d == 3 ? b.cells.places(d - 1, l) : PlaceRange{0, 1};
    Rows rows;
    rows.count = 0;
    const auto run = [&]() HWY_ATTR {
        for (std::size_t r = rows.count; r % width != 0; ++r) {  // lanes without a row repeat one
            rows.y[r] = rows.y[0];
            rows.z[r] = rows.z[0];
        }
        for (std::size_t at = 0; at < rows.count; at += width) {
            RowBlock block;
            find_intervals<d>(tag, b.cells, planes, l, columns, rows, at, block);
            const std::uint32_t real = rows.count - at >= width ? ~0U : (1U << (rows.count - at)) - 1;
            for (std::uint32_t bits = block.undecided & real; bits != 0; bits &= bits - 1) {
                const auto r = static_cast<std::size_t>(__builtin_ctz(bits));
                to.undecided.spans.push_back({b.place[l], rows.row[at + r], rows.layer[at + r], block.first[r],
                                              block.inner_first[r], block.inner_last[r], block.last[r]});
            }
            block.with_points &= real;
            if (block.with_points == 0) continue;
            for (std::size_t c = 0; c < to.components(); ++c)
                Values<d>::set_rows(tag, b.cells, b.values[c], l, rows, at, terms[c]);
            for (std::uint32_t bits = block.with_points; bits != 0; bits &= bits - 1) {
                const auto r = static_cast<std::size_t>(__builtin_ctz(bits));
                fill_row(tag, to, b, l, terms, r, {block.inner_first[r], block.inner_last[r]},
                         to.target.line_of(rows.row[at + r], rows.layer[at + r]) * to.target.columns);
            }
        }
        rows.count = 0;
    };
    // One loop over both: nothing could predict where the inner one ends.
    const double* const y = to.source.raster.at[1].data();
    const double* const z = to.source.raster.at[2].data();
    std::int32_t row = lines.first, layer = layers.first;
    for (std::int64_t left = std::int64_t{lines.last - lines.first} * (layers.last - layers.first); left > 0; --left) {
        rows.y[rows.count] = y[row];
        rows.z[rows.count] = z[layer];
        rows.row[rows.count] = row;
        rows.layer[rows.count] = layer;
        ++row;
        layer += row == lines.last ? 1 : 0;
        row = row == lines.last ? lines.first : row;
        if (++rows.count == Rows::max) run();
    }
    if (rows.count != 0) run();
}

}  // namespace barycert::sample::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
