// Cells against the points of a grid: where each row enters and leaves a cell (fill_rows-inl.hpp), and the values
// between (fill_values-inl.hpp).
#include "barycert/sample/grid/fill_lanes.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "barycert/sample/grid/fill_lanes.cpp"
#include "barycert/core/foreach_target.hpp"

#include "barycert/base/strict_math.hpp"
#include "barycert/index/records-inl.hpp"
#include "barycert/sample/grid/fill_values-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::sample {
namespace HWY_NAMESPACE {

using namespace core::HWY_NAMESPACE;
using namespace index::HWY_NAMESPACE;

/// Cells [0, MaxLanes).
template <Simplex s, class D>
HWY_INLINE void set_block(D tag, const locate::CellIndex& index, const NodeValues& nodes, const Raster& raster,
                          const locate::Place* cells, CellBlock<space_dimension(s)>& out, ValueBlock* values) {
    using V = hn::Vec<D>;
    constexpr int d = space_dimension(s), n = d + 1;
    constexpr double u = 0x1p-53;
    const auto node = [&](std::size_t l, int i) HWY_ATTR {
        return static_cast<std::size_t>(
            index.cells[static_cast<std::size_t>(cells[l])].node[static_cast<std::size_t>(i)]);
    };
    V v[n][d], f[n];
    for (int i = 0; i < n; ++i) {
        V row[4];
        load_records(
            tag, [&](std::size_t l) HWY_ATTR { return nodes.first[node(l, i)].at.data(); }, row);
        for (int k = 0; k < d; ++k) v[i][k] = row[k];
        f[i] = row[3];
    }
    const CellMatrix<d, D> m = cell_matrix<d>(tag, v);
    V extent[d];
    extents(m.edge, extent);
    for (int k = 0; k < d; ++k) {
        V low = v[0][k], high = v[0][k];
        for (int i = 1; i < n; ++i) {
            low = hn::Min(low, v[i][k]);
            high = hn::Max(high, v[i][k]);
        }
        const V origin = hn::Set(tag, raster.origin[k]), scale = hn::Set(tag, raster.scale[k]);
        const V max = hn::Set(tag, static_cast<double>(raster.at[static_cast<std::size_t>(k)].size()));
        const auto clamp = [&](V x) HWY_ATTR { return hn::Min(hn::Max(x, hn::Zero(tag)), max); };
        hn::Store(v[d][k], tag, out.origin[k]);
        hn::Store(low, tag, out.low[k]);
        hn::Store(high, tag, out.high[k]);
        hn::Store(clamp(hn::Ceil((low - origin) * scale)), tag, out.first[k]);
        hn::Store(clamp(hn::Floor((high - origin) * scale) + hn::Set(tag, 1)), tag, out.last[k]);
    }
    const V condition = m.reach[0] * extent[0];
    const V error =
        hn::Set(tag, 1000 * u) * condition * condition + hn::Set(tag, 400 * u) * condition + hn::Set(tag, 8 * u);
    V last[d];
    for (int j = 0; j < d; ++j) {
        V slope[d];
        for (int k = 0; k < d; ++k) {
            slope[k] = m.normal[j][k] * m.inverse;
            last[k] = j == 0 ? hn::Neg(slope[k]) : last[k] - slope[k];
        }
        set_plane<d>(tag, raster, hn::Zero(tag), slope, v[d][0], extent[0], error, out.plane[j]);
    }
    set_plane<d>(tag, raster, hn::Set(tag, 1), last, v[d][0], extent[0], error, out.plane[d]);
    const auto valid = hn::And(m.valid, hn::Le(error, hn::Set(tag, 0x1p-9)));
    hn::Store(hn::IfThenElse(valid, hn::Set(tag, 1), hn::Zero(tag)), tag, out.valid);

    set_values<d>(tag, m, extent, f, values[0]);
    for (std::size_t c = 1; c < nodes.components; ++c) {
        const sample::ValueRecord* const more = nodes.more + (c - 1) / 4 * nodes.node_count;
        for (int i = 0; i < n; ++i) {
            HWY_ALIGN double lanes[max_lanes];
            for (std::size_t l = 0; l < hn::MaxLanes(D()); ++l) lanes[l] = more[node(l, i)].value[(c - 1) % 4];
            f[i] = hn::Load(tag, lanes);
        }
        set_values<d>(tag, m, extent, f, values[c]);
    }
}

/// What the rows of a cell are filled with.
template <int d, class V>
struct CellFill {
    const CellBlock<d>& cell;
    const ValueBlock* values;
    std::size_t components, l;
    Mesh::Index id;
    std::int32_t first_column;
    const Partial<V>* known;  ///< the columns' terms if one vector holds them all, else nullptr
    RowTerms* terms;
};

/// Points [first, last) of the line that begins at point `at`, whatever the number of components and columns.
template <int d, class D, class V = hn::Vec<D>>
HWY_INLINE void fill_row(D tag, const Raster& raster, const CellFill<d, V>& fill, std::size_t r, std::int32_t first,
                         std::int32_t last, std::size_t at, const FillTarget& target) {
    constexpr auto width = static_cast<std::int32_t>(hn::MaxLanes(D()));
    const auto kept = [&](std::size_t point) {
        return target.overlapping && target.owner[point] >= 0 && target.owner[point] < fill.id;
    };
    for (std::int32_t column = fill.known != nullptr ? fill.first_column : first; column < last; column += width) {
        const std::int32_t from = std::max(first, column), to = std::min(last, column + width);
        std::uint32_t certain = ~0U;
        for (std::size_t c = 0; c < fill.components; ++c) {
            const Partial<V> x = fill.known != nullptr
                                     ? fill.known[c]
                                     : column_terms<d>(tag, raster, fill.cell, fill.values[c], fill.l, column);
            HWY_ALIGN double lanes[max_lanes];
            hn::Store(value_of(tag, fill.values[c], fill.l, fill.terms[c], r, x, certain), tag, lanes);
            for (std::int32_t i = from; i < to; ++i) {
                const std::size_t point = at + static_cast<std::size_t>(i);
                if (!kept(point)) target.values[target.stride * point + c] = lanes[i - column];
            }
        }
        for (std::int32_t i = from; i < to; ++i) {
            const std::size_t point = at + static_cast<std::size_t>(i);
            if (kept(point)) continue;
            target.owner[point] = fill.id;
            target.feature[point] = (certain >> (i - column) & 1) != 0 ? Feature::interior : interior_without_value;
        }
    }
}

/// The eight bytes that begin at `at`: those of which the bit is set get `value`.
HWY_INLINE void set_bytes(Feature* at, std::uint32_t bits, Feature value) {
    static_assert(sizeof(Feature) == 1);
    // Each of the eight bits to the lowest of its byte, then to all of it.
    const std::uint64_t spread = (bits * 0x0101010101010101U & 0x8040201008040201U) + 0x7f7f7f7f7f7f7f7fU;
    const std::uint64_t mask = (spread >> 7 & 0x0101010101010101U) * 0xff;
    std::uint64_t bytes;
    std::memcpy(&bytes, at, 8);
    bytes = (bytes & ~mask) | (mask & static_cast<std::uint64_t>(value) * 0x0101010101010101U);
    std::memcpy(at, &bytes, 8);
}

/// The same without branches, for the usual case: one number a point, cells that do not overlap, one vector of columns.
template <int d, class D, class V = hn::Vec<D>>
HWY_INLINE void fill_short_row(D tag, const CellFill<d, V>& fill, std::size_t r, std::int32_t first, std::int32_t last,
                               std::size_t at, const FillTarget& target) {
    std::uint32_t certain = ~0U;
    const V value = value_of(tag, fill.values[0], fill.l, fill.terms[0], r, fill.known[0], certain);
    const std::int32_t begin = fill.first_column;
    const std::size_t point = at + static_cast<std::size_t>(begin);
    const std::uint32_t bits = ((1U << (last - begin)) - 1) & ~((1U << (first - begin)) - 1);
    const std::uint8_t stored[8] = {static_cast<std::uint8_t>(bits)};
    hn::BlendedStore(value, hn::LoadMaskBits(tag, stored), tag, target.values + point);
    const hn::CappedTag<std::int32_t, max_lanes> whole;
    constexpr std::size_t width = hn::MaxLanes(hn::CappedTag<std::int32_t, max_lanes>());
    for (std::size_t i = 0; i < hn::MaxLanes(D()); i += width) {
        const std::uint8_t part[8] = {static_cast<std::uint8_t>(bits >> i)};
        hn::BlendedStore(hn::Set(whole, fill.id), hn::LoadMaskBits(whole, part), whole, target.owner + point + i);
    }
    set_bytes(target.feature + point, bits & certain, Feature::interior);
    if ((bits & ~certain) != 0) set_bytes(target.feature + point, bits & ~certain, interior_without_value);
}

/// One cell of a block, and what is known of its components.
template <int d>
struct CellOfBlock {
    const CellBlock<d>& block;
    std::size_t lane;
    locate::Place place;
    Mesh::Index id;
    const ValueBlock* values;
    std::size_t components;
    RowTerms* terms;
};

template <int d, class D>
HWY_INLINE void fill_cell(D tag, const Raster& raster, const CellOfBlock<d>& one, const FillTarget& target,
                          std::vector<Span>& undecided) {
    using V = hn::Vec<D>;
    // No structured binding: lambdas of clang 14 cannot take one.
    const CellBlock<d>& cell = one.block;
    const std::size_t l = one.lane, components = one.components;
    const locate::Place place = one.place;
    const Mesh::Index id = one.id;
    const ValueBlock* const values = one.values;
    RowTerms* const terms = one.terms;
    constexpr std::size_t width = hn::MaxLanes(D());
    const auto range = [&](std::size_t k) {
        return places_between(raster.at[k], cell.first[k][l], cell.last[k][l], cell.low[k][l], cell.high[k][l]);
    };
    const PlaceRange columns = range(0);
    PlaceRange lines = range(1), layers{0, 1};
    if constexpr (d == 3) layers = range(2);
    PlaceRange& cut = d == 3 ? layers : lines;
    cut.first = std::max(cut.first, target.first_layer);
    cut.last = std::min(cut.last, target.last_layer);
    if (columns.first >= columns.last || lines.first >= lines.last || layers.first >= layers.last) return;

    constexpr std::size_t max_known = 4;
    Partial<V> known[max_known];
    const bool one_vector = static_cast<std::size_t>(columns.last - columns.first) <= width && components <= max_known;
    for (std::size_t c = 0; one_vector && c < components; ++c)
        known[c] = column_terms<d>(tag, raster, cell, values[c], l, columns.first);
    const CellFill<d, V> fill{cell, values, components, l, id, columns.first, one_vector ? known : nullptr, terms};
    const bool usual = one_vector && target.stride == 1 && components == 1 && !target.overlapping;

    Rows rows;
    rows.count = 0;
    const auto run = [&]() HWY_ATTR {
        for (std::size_t r = rows.count; r % width != 0; ++r) {  // lanes without a row repeat one
            rows.y[r] = rows.y[0];
            rows.z[r] = rows.z[0];
        }
        for (std::size_t at = 0; at < rows.count; at += width) {
            RowBlock block;
            find_intervals<d>(tag, cell, l, columns, rows, at, block);
            const std::uint32_t real = rows.count - at >= width ? ~0U : (1U << (rows.count - at)) - 1;
            for (std::uint32_t bits = block.undecided & real; bits != 0; bits &= bits - 1) {
                const auto r = static_cast<std::size_t>(__builtin_ctz(bits));
                undecided.push_back({place, rows.row[at + r], rows.layer[at + r], block.first[r], block.inner_first[r],
                                     block.inner_last[r], block.last[r]});
            }
            block.with_points &= real;
            if (block.with_points == 0) continue;
            for (std::size_t c = 0; c < components; ++c) {
                const Partial<V> t = row_terms<d>(tag, cell, values[c], l, rows, at);
                hn::Store(t.sum, tag, terms[c].sum);
                hn::Store(t.rest, tag, terms[c].rest);
            }
            for (std::uint32_t bits = block.with_points; bits != 0; bits &= bits - 1) {
                const auto r = static_cast<std::size_t>(__builtin_ctz(bits));
                const std::int32_t row = rows.row[at + r], layer = rows.layer[at + r];
                const auto line = static_cast<std::size_t>(d == 3 ? layer - target.first_layer : 0) * target.rows +
                                  static_cast<std::size_t>(d == 3 ? row : row - target.first_layer);
                if (usual) {
                    fill_short_row<d>(tag, fill, r, block.inner_first[r], block.inner_last[r], line * target.columns,
                                      target);
                } else {
                    fill_row<d>(tag, raster, fill, r, block.inner_first[r], block.inner_last[r], line * target.columns,
                                target);
                }
            }
        }
        rows.count = 0;
    };
    // One loop over both: nothing could predict where the inner one ends.
    const double* const y = raster.at[1].data();
    const double* const z = raster.at[2].data();
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

template <Simplex s>
void fill_all(const FillSource& source, std::span<const locate::Place> cells, const FillTarget& target,
              UndecidedFill& undecided) {
    const hn::ScalableTag<double> tag;
    constexpr std::size_t width = hn::MaxLanes(hn::ScalableTag<double>());
    const std::size_t components = source.nodes.components;
    CellBlock<space_dimension(s)> block;
    std::vector<ValueBlock> values(components);
    std::vector<RowTerms> terms(components);
    for (std::size_t at = 0; at < cells.size(); at += width) {
        locate::Place some[width];
        for (std::size_t l = 0; l < width; ++l) some[l] = cells[std::min(at + l, cells.size() - 1)];
        set_block<s>(tag, source.index, source.nodes, source.raster, some, block, values.data());
        for (std::size_t l = 0; l < std::min(width, cells.size() - at); ++l) {
            if (block.valid[l] == 0) {
                undecided.cells.push_back(some[l]);
                continue;
            }
            const Mesh::Index id = source.index.original[static_cast<std::size_t>(some[l])];
            fill_cell<space_dimension(s)>(tag, source.raster,
                                          {block, l, some[l], id, values.data(), components, terms.data()}, target,
                                          undecided.spans);
        }
    }
}

void fill_cells(const FillSource& source, std::span<const locate::Place> cells, const FillTarget& target,
                UndecidedFill& undecided) {
    source.index.simplex == Simplex::triangle ? fill_all<Simplex::triangle>(source, cells, target, undecided)
                                              : fill_all<Simplex::tetrahedron>(source, cells, target, undecided);
}

}  // namespace HWY_NAMESPACE
}  // namespace barycert::sample
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::sample {

HWY_EXPORT(fill_cells);

void fill_cells(const FillSource& source, std::span<const locate::Place> cells, const FillTarget& target,
                UndecidedFill& undecided) {
    HWY_DYNAMIC_DISPATCH(fill_cells)(source, cells, target, undecided);
}

}  // namespace barycert::sample
#endif
