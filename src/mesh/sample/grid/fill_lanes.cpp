// Cells, a vector of them at a time, fill in the points of a grid that they hold. Cells with few points in their boxes
// look at all of them (fill_box-inl.hpp); others find where each row enters and leaves them (fill_values-inl.hpp).
#include "mesh/sample/grid/fill_lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "mesh/sample/grid/fill_lanes.cpp"
#include "core/foreach_target.hpp"

#include "mesh/index/records-inl.hpp"
#include "mesh/sample/grid/fill_values-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::sample::HWY_NAMESPACE {

using namespace index::HWY_NAMESPACE;

/// MaxLanes cells.
template <template <int> class Values, int d>
struct FillBlock {
    locate::Place place[max_lanes];
    Mesh::Index id[max_lanes];
    CellBlock<d> cells;
    BoxBlock<d> boxes;
    std::uint32_t valid, box;                ///< bits; box: with few points in their boxes
    typename Values<d>::CellValues* values;  ///< by component
};

template <int d>
struct Filling {
    const FillSource& source;
    const FillTarget& target;
    UndecidedFill& undecided;

    std::size_t first_of_box(const CellBlock<d>& cells, std::size_t l) const {
        return target.line_of(cells.first[1][l], d == 3 ? cells.first[d - 1][l] : 0) * target.columns +
               static_cast<std::size_t>(cells.first[0][l]);
    }
    std::size_t components() const { return source.nodes.components; }
    bool one_number() const { return target.stride == 1 && components() == 1; }
    /// Unless kept.
    void own(std::size_t point, Mesh::Index cell, bool certain) const {
        if (target.owner[point] >= 0 || !certain) target.set_feature(point, Feature::interior, certain);
        target.owner[point] = cell;
    }
};

/// From b.place. `rows` is set only if some cells need it.
template <template <int> class Values, int d, class D>
HWY_INLINE void set_block(D tag, const Filling<d>& to, FillBlock<Values, d>& b, RowsBlock<d>& rows) {
    using V = hn::Vec<D>;
    constexpr int n = d + 1;
    const FillSource& source = to.source;
    const NodeValues& nodes = source.nodes;
    for (std::size_t l = 0; l < hn::MaxLanes(D()); ++l)
        b.id[l] = source.index.original[static_cast<std::size_t>(b.place[l])];
    const auto node = [&](std::size_t l, int i) HWY_ATTR {
        return static_cast<std::size_t>(
            source.index.cells[static_cast<std::size_t>(b.place[l])].node[static_cast<std::size_t>(i)]);
    };
    V v[n][d], f[n];
    for (int i = 0; i < n; ++i) {
        V row[4];
        load_records(
            tag, [&](std::size_t l) HWY_ATTR { return nodes.first[node(l, i)].at.data(); }, row);
        for (int k = 0; k < d; ++k) v[i][k] = row[k];
        f[i] = row[3];
    }
    set_places<d>(tag, source.raster, {to.target.first_layer, to.target.last_layer}, v, b.cells);
    const CellMatrix<d, D> m = cell_matrix<d>(tag, v);
    V extent[d];
    extents(m.edge, extent);
    CellWeights<d, D> weights;
    set_weights<d>(tag, m, extent, weights);
    b.valid = mask_bits(tag, weights.valid);
    b.box = set_boxes<d>(tag, source.raster, b.cells, weights, b.boxes) & b.valid;
    if (b.box != (1U << hn::MaxLanes(D())) - 1) set_planes<d>(tag, source.raster, b.cells, weights, extent[0], rows);

    for (std::size_t c = 0; c < nodes.components; ++c) {
        for (int i = 0; c != 0 && i < n; ++i) {
            HWY_ALIGN double lanes[max_lanes];
            for (std::size_t l = 0; l < hn::MaxLanes(D()); ++l)
                lanes[l] = nodes.more[(c - 1) / 4 * nodes.node_count + node(l, i)].value[(c - 1) % 4];
            f[i] = hn::Load(tag, lanes);
        }
        Values<d>::set(tag, m, v, extent, f, b.values[c]);
    }
}

/// Blocks that are set up one after the other, as each hides the waits of the next.
constexpr std::size_t blocks_at_once = 8;

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

// Cells with many points in their boxes.

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
