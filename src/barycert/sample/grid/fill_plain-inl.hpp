// Internal: the values of a linear field at points of a grid in a cell, in plain double, with the bits of those of
// points.
//
// Included once per SIMD target.
#if defined(BARYCERT_SAMPLE_FILL_PLAIN_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef BARYCERT_SAMPLE_FILL_PLAIN_INL_HPP
#undef BARYCERT_SAMPLE_FILL_PLAIN_INL_HPP
#else
#define BARYCERT_SAMPLE_FILL_PLAIN_INL_HPP
#endif

#include "barycert/sample/grid/fill_values-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::sample::HWY_NAMESPACE {

/// As CorrectValues. Every value is certain, whatever it is.
template <int d>
struct PlainValues {
    struct Block {
        HWY_ALIGN double vertex[d + 1][d][max_lanes], value[d + 1][max_lanes];
    };

    template <class D, class V = hn::Vec<D>>
    static HWY_INLINE void set(D tag, const CellMatrix<d, D>&, const V (&v)[d + 1][d], const V (&)[d],
                               const V (&f)[d + 1], Block& out) {
        for (int i = 0; i <= d; ++i) {
            for (int k = 0; k < d; ++k) hn::Store(v[i][k], tag, out.vertex[i][k]);
            hn::Store(f[i], tag, out.value[i]);
        }
    }

    template <class D, class V = hn::Vec<D>>
    static HWY_INLINE V value(D tag, const Block& b, std::size_t l, const V (&p)[d]) {
        constexpr Simplex s = d == 3 ? Simplex::tetrahedron : Simplex::triangle;
        Relative<s, V> relative;
        for (int i = 0; i <= d; ++i) {
            for (int k = 0; k < d; ++k) relative.r[i][k] = hn::Set(tag, b.vertex[i][k][l]) - p[k];
        }
        return PlainWeights<s, D>(tag, relative).value(tag, [&](int i) HWY_ATTR {
            return hn::Set(tag, b.value[i][l]);
        });
    }

    struct Table {
        HWY_ALIGN double at[d][max_lanes];
    };
    template <class D>
    static HWY_INLINE void set_table(D tag, const Raster& raster, const CellBlock<d>& cell, const Block&, std::size_t l,
                                     Table& out) {
        constexpr auto width = static_cast<std::int32_t>(hn::MaxLanes(D()));
        for (int k = 0; k < d; ++k) {
            const double* const from = raster.at[static_cast<std::size_t>(k)].data() + cell.first[k][l];
            for (std::int32_t i = 0; i < box_side; i += width)
                hn::Store(load_some(tag, from + i, cell.last[k][l] - cell.first[k][l] - i), tag, out.at[k] + i);
        }
    }
    template <class D, class I, class V = hn::Vec<D>>
    static HWY_INLINE V at_places(D tag, const Block& b, std::size_t l, const Table& table, const I (&place)[d],
                                  std::uint32_t& certain) {
        V p[d];
        for (int k = 0; k < d; ++k) p[k] = look_up(tag, table.at[k], place[k]);
        certain = ~0U;
        return value(tag, b, l, p);
    }

    struct RowTerms {
        double y[max_lanes], z[max_lanes];
    };
    template <class D>
    static HWY_INLINE void set_rows(D, const CellBlock<d>&, const Block&, std::size_t, const Rows& rows, std::size_t at,
                                    RowTerms& out) {
        std::copy_n(rows.y + at, hn::MaxLanes(D()), out.y);
        std::copy_n(rows.z + at, hn::MaxLanes(D()), out.z);
    }
    template <class D, class V = hn::Vec<D>>
    static HWY_INLINE V at_row(D tag, const CellBlock<d>&, const Block& b, std::size_t l, const RowTerms& rows,
                               std::size_t r, V x, std::uint32_t& certain) {
        V p[d];
        p[0] = x;
        p[1] = hn::Set(tag, rows.y[r]);
        if constexpr (d == 3) p[2] = hn::Set(tag, rows.z[r]);
        certain = ~0U;
        return value(tag, b, l, p);
    }
};

}  // namespace barycert::sample::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
