// Internal: a vector of cells that fill in points, and what they fill in.
//
// Included once per SIMD target.
#if defined(BARYCERT_SAMPLE_FILL_BLOCK_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_SAMPLE_FILL_BLOCK_INL_HPP
#undef BARYCERT_SAMPLE_FILL_BLOCK_INL_HPP
#else
#define BARYCERT_SAMPLE_FILL_BLOCK_INL_HPP
#endif

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

}  // namespace barycert::sample::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
