// Cells of a grid along axes by comparing coordinates, and values in two doubles.
//
// u = 2^-53. In a cell from a to b along each axis, n = p - a, m = b - p and w = b - a are exact as double-double, none
// is negative, and n + m = w. F: the largest nodal value of the cell; W: the product of its w, off by 18.1 u^2 W.
// A pair (h, l) stands for h + l, and is not normalised: l is small beside F times the w so far, V, not beside h. What
// is below is in units of u^2 F V for errors E, and of u F V for |l|.
//   times(x, f) of a double   h f = p + e exactly; l = e + fl(l f)
//   x * y                     of y = (n or m), h y.h = p + e exactly; l = e + (h y.l + l y.h); l y.l is left out
//   x + y                     h exactly as s + e; l = e + (l + l)
// Multilinear, axis by axis:  times: E 3, l 2; sum: E 3 + 5 = 8, l 3
//                             product: 3 + 1 + 3 + 4 + 5: E 24, l 5; sum: 5 + 6: E 35, l 6
//                             product: 6 + 1 + 6 + 7 + 8: E 63, l 8; sum: 8 + 9: E 80, l 9
// Linear, from the lowest node along the axes in the order of T_k = n_k times the other two w, descending:
//   N = f_0 (W - T_a) + f_1 (T_a - T_b) + f_2 (T_b - T_c) + f_3 T_c
// T is off by 18.1, a difference by 36.2 + 5 with l 3, all four by 141.7; times f 28, l 4 each; sums 17 + 27 + 37: E
// 251, l 19. Where T that are as good as equal are in the wrong order, N is that of a neighbouring part, continued: off
// by their difference, 36.2, times 4, for each pair of axes: 435.
// N / W as q = h i with i = 1 / W.h, off by 2 u F, and c = ((h - p) - e + (l - q W.l)) i where q W.h = p + e and h - p
// are exact: with l 9 it rounds by 4 + 1 + 10 + 14, and the factor i by 3 times 14: with 18.1 for W and 80 for N
// 169 u^2 F; with l 19 by 49 and 3 times 24: with 435 825 u^2 F. Taken are 176 and 848.
// Ranges outside which nothing is certain: w in [2^-200, 2^200], F in [2^-300, 2^300] or 0. The loss by underflow,
// 2^-1070 a product, times the w to come, is below 2^-60 of these bounds; nothing overflows.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>
#include "barycert/simplex.hpp"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/grid_lanes.cpp"
#include "core/foreach_target.hpp"
// After the targets.
#include "core/grid_lanes.hpp"
#include "core/lane_loop-inl.hpp"
#include "core/refinement-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::core::HWY_NAMESPACE {

/// Cells of the points that come next: what is read there is asked of memory so many vectors ahead.
constexpr std::size_t ahead = 4, some = 8 * (ahead + 1);
struct FoundCells {
    HWY_ALIGN double low[3][some], high[3][some];  ///< the planes of cells; of points outside those of some cell
    HWY_ALIGN std::int64_t node[some];             ///< the lowest one
};

#if HWY_TARGET != HWY_SCALAR
template <class D, class At>
HWY_INLINE hn::Vec<D> load_some_pairs(D tag, std::size_t first, const At& at) {
    if constexpr (hn::MaxLanes(D()) <= 2) {
        return hn::LoadU(tag, at(first));
    } else {
        const hn::Half<D> half;
        const auto low = load_some_pairs(half, first, at);
        return hn::Combine(tag, load_some_pairs(half, first + hn::MaxLanes(D()) / 4, at), low);
    }
}
#endif

/// a and b are at(l)[0] and at(l)[1] for each lane l, by loads of both at once: gathers take longer.
template <class D, class At, class V = hn::Vec<D>>
HWY_INLINE void load_pairs(D tag, const At& at, V& a, V& b) {
    constexpr std::size_t width = hn::MaxLanes(D());
    if constexpr (width == 1) {
        a = hn::Set(tag, at(0)[0]);
        b = hn::Set(tag, at(0)[1]);
    } else {
#if HWY_TARGET != HWY_SCALAR
        const V low = load_some_pairs(tag, 0, at), high = load_some_pairs(tag, width / 2, at);
        a = hn::ConcatEven(tag, high, low);
        b = hn::ConcatOdd(tag, high, low);
#endif
    }
}

template <class D, class V>
HWY_INLINE void load_points(D tag, const AxisGrid& grid, const double* from, V (&p)[3]) {
    p[2] = hn::Zero(tag);
    if (grid.dimension == 3) {
        hn::LoadInterleaved3(tag, from, p[0], p[1], p[2]);
    } else {
        hn::LoadInterleaved2(tag, from, p[0], p[1]);
    }
}

/// Cells and features of points from `first` on, into `found` from `at` on; fetches their values.
template <class D>
HWY_INLINE void find_some(D tag, const AxisGrid& grid, const GridPoints& of, std::size_t first, std::size_t at,
                          FoundCells& found) {
    using V = hn::Vec<D>;
    constexpr std::size_t width = hn::MaxLanes(D());
    const hn::RebindToSigned<D> integers;
    const V zero = hn::Zero(tag), one = hn::Set(tag, 1);
    V p[3];
    load_points(tag, grid, of.points.data() + grid.dimension * first, p);
    hn::Mask<D> inside = hn::Eq(p[0], p[0]);
    for (std::size_t k = 0; k < 3; ++k) {
        inside = hn::And(inside, within(tag, p[k], grid.planes[k][0], grid.planes[k][grid.cells[k]]));
    }
    V on_planes = zero, node = zero, cell = zero;
    for (std::size_t k = 3; k-- > 0;) {
        const double* const planes = grid.planes[k];
        const V x = hn::IfThenElse(inside, p[k], hn::Set(tag, planes[0]));
        const V about = (x - hn::Set(tag, planes[0])) * hn::Set(tag, grid.cells_per_unit[k]);
        const V last = hn::Set(tag, static_cast<double>(grid.cells[k] - 1));
        // Not a number where the axis is longer than the largest double, or than none: 0.
        V i = hn::Floor(hn::Min(hn::IfThenElseZero(hn::Gt(about, zero), about), last)), a, b;
        HWY_ALIGN std::int64_t plane[width];
        hn::Store(hn::ConvertTo(integers, i), integers, plane);
        asm("" : "+m"(plane));  // they are to be read from memory: to extract them takes longer
        const auto load = [&]() HWY_ATTR {
            load_pairs(
                tag, [&](std::size_t l) HWY_ATTR { return planes + plane[l]; }, a, b);
        };
        load();
        // On a plane, which the lower cell has; or a first guess that is wrong.
        const auto wrong = hn::Or(hn::And(hn::Le(x, a), hn::Gt(i, zero)), hn::Gt(x, b));
        if (HWY_UNLIKELY(!hn::AllFalse(tag, wrong))) {
            HWY_ALIGN double at_lanes[width];
            hn::Store(x, tag, at_lanes);
            for (std::size_t l = 0, bits = mask_bits(tag, wrong); l < width; ++l)
                if ((bits >> l & 1U) != 0) plane[l] = static_cast<std::int64_t>(grid.find(k, at_lanes[l], plane[l]));
            load();
            i = hn::ConvertTo(tag, hn::Load(integers, plane));
        }
        hn::StoreU(a, tag, found.low[k] + at);
        hn::StoreU(b, tag, found.high[k] + at);
        node = node + i * hn::Set(tag, static_cast<double>(grid.node_step[k]));
        cell = cell * hn::Set(tag, static_cast<double>(grid.cells[k])) + i;
        if (k < grid.dimension) on_planes = on_planes + hn::IfThenElseZero(hn::Or(hn::Eq(x, a), hn::Eq(x, b)), one);
    }
    hn::StoreU(hn::ConvertTo(integers, node), integers, found.node + at);
    const hn::Rebind<std::int32_t, D> narrow;
    const auto inner = hn::IfThenElse(inside, cell, hn::Set(tag, -1));
    hn::StoreU(hn::DemoteTo(narrow, inner), narrow, of.cells + first);
    // On one, two or three planes: a face, an edge, a vertex; in the plane an edge or a vertex.
    static_assert(static_cast<int>(Feature::vertex) == 3 && static_cast<int>(Feature::outside) == 4);
    if (grid.dimension == 2) on_planes = on_planes + hn::IfThenElseZero(hn::Gt(on_planes, zero), one);
    const hn::Rebind<std::uint8_t, D> bytes;
    const auto feature = hn::IfThenElse(inside, on_planes, hn::Set(tag, 4));
    hn::StoreU(hn::DemoteTo(bytes, hn::DemoteTo(narrow, feature)), bytes,
               reinterpret_cast<std::uint8_t*>(of.features + first));
    if (of.fields.empty()) return;
    const NodeComponent& field = of.fields.front();
    for (std::size_t l = 0; l < width; ++l) {
        const double* const lowest = field.data + field.step * static_cast<std::size_t>(found.node[at + l]);
        for (std::size_t j = 0; j < 4; ++j)
            __builtin_prefetch(lowest + field.step * ((j & 1U) * grid.node_step[1] + (j >> 1U) * grid.node_step[2]));
    }
}

/// A number of two terms, as above.
template <class V>
struct Pair {
    V h, l;
};
template <class V>
HWY_INLINE Pair<V> times(const DoubleDouble<V>& x, V f) {
    const TwoTerms<V> p = two_product(x.high, f);
    return {p.high, p.low + x.low * f};
}
template <class V>
HWY_INLINE Pair<V> times(const Pair<V>& x, const DoubleDouble<V>& y) {
    const TwoTerms<V> p = two_product(x.h, y.high);
    return {p.high, p.low + (x.h * y.low + x.l * y.high)};
}
template <class V>
HWY_INLINE Pair<V> sum(const Pair<V>& x, const Pair<V>& y) {
    const TwoTerms<V> s = two_sum(x.h, y.h);
    return {s.high, s.low + (x.l + y.l)};
}

/// Points in their cells, and what is made of nodal values there.
template <class D, class V = hn::Vec<D>>
struct GridLanes {
    D tag;
    const AxisGrid& grid;
    const std::int64_t* node;
    DoubleDouble<V> n[3], m[3], w[3];  ///< from the lower plane, to the upper one, and both
    DoubleDouble<V> volume;
    V inverse;  ///< of volume.high
    hn::Mask<D> certain;

    HWY_INLINE V set(double x) const { return hn::Set(tag, x); }

    HWY_INLINE GridLanes(D d, const AxisGrid& g, const double* points, const FoundCells& found, std::size_t at)
        : tag(d), grid(g), node(found.node + at) {
        V p[3];
        load_points(tag, grid, points, p);
        certain = hn::Eq(p[0], p[0]);
        for (std::size_t k = 0; k < 3; ++k) {
            const V a = hn::LoadU(tag, found.low[k] + at), b = hn::LoadU(tag, found.high[k] + at);
            n[k] = two_difference(p[k], a);
            m[k] = two_difference(b, p[k]);
            w[k] = two_difference(b, a);
            volume = k == 0 ? w[k] : volume * w[k];
            certain = hn::And(certain, within(tag, w[k].high, 0x1p-200, 0x1p200));
        }
        inverse = set(1) / volume.high;
    }

    /// Loads the values at the eight corners of the cell; returns the largest in size.
    HWY_INLINE V load(const NodeComponent& field, V (&f)[8]) const {
        V most = hn::Zero(tag);
        for (std::size_t j = 0; j < 4; ++j) {
            const double* const from =
                field.data + field.step * ((j & 1U) * grid.node_step[1] + (j >> 1U) * grid.node_step[2]);
            if (field.step == 1) {
                load_pairs(
                    tag, [&](std::size_t l) HWY_ATTR { return from + node[l]; }, f[2 * j], f[2 * j + 1]);
            } else {
                const hn::RebindToSigned<D> integers;
                const V at = hn::ConvertTo(tag, hn::LoadU(integers, node)) * set(static_cast<double>(field.step));
                const auto numbers = hn::ConvertTo(integers, at);
                f[2 * j] = hn::GatherIndex(tag, from, numbers);
                f[2 * j + 1] = hn::GatherIndex(tag, from + field.step, numbers);
            }
            most = hn::Max(most, hn::Max(hn::Abs(f[2 * j]), hn::Abs(f[2 * j + 1])));
        }
        return most;
    }

    HWY_INLINE V rounded(const Pair<V>& x, V most, double bound, hn::Mask<D>& sure) const {
        const V q = x.h * inverse;
        const TwoTerms<V> p = two_product(q, volume.high);
        const V c = (((x.h - p.high) - p.low) + (x.l - q * volume.low)) * inverse;
        const V error = set(bound * (1 + 0x1p-40)) * most + set(0x1p-52) * hn::Abs(c);
        sure = hn::And(sure, hn::Or(within(tag, most, 0x1p-300, 0x1p300), hn::Eq(most, hn::Zero(tag))));
        return rounded_if_certain<D>(q, c, error, sure) + hn::Zero(tag);
    }
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE V multilinear_value(const GridLanes<D>& lanes, const NodeComponent& field, hn::Mask<D>& sure) {
    V f[8];
    const V most = lanes.load(field, f);
    Pair<V> part[4];
    for (std::size_t j = 0; j < 4; ++j) part[j] = sum(times(lanes.m[0], f[2 * j]), times(lanes.n[0], f[2 * j + 1]));
    for (std::size_t j = 0; j < 2; ++j)
        part[j] = sum(times(part[2 * j], lanes.m[1]), times(part[2 * j + 1], lanes.n[1]));
    const Pair<V> all = sum(times(part[0], lanes.m[2]), times(part[1], lanes.n[2]));
    return lanes.rounded(all, most, 176 * 0x1p-106, sure);
}

/// The part of a cell that holds the point: by the order of the axes, and weights times the volume.
template <class D, class V = hn::Vec<D>>
struct GridPart {
    hn::Mask<D> swap[3];
    DoubleDouble<V> weight[4];

    static HWY_INLINE void exchange(hn::Mask<D> mask, V& a, V& b) {
        const V first = hn::IfThenElse(mask, b, a);
        b = hn::IfThenElse(mask, a, b);
        a = first;
    }
    /// Axes 0 and 1, 1 and 2, 0 and 1.
    HWY_INLINE void sort(std::size_t step, V (&of_axes)[3]) const {
        exchange(swap[step], of_axes[step % 2], of_axes[step % 2 + 1]);
    }

    HWY_INLINE explicit GridPart(const GridLanes<D>& lanes) {
        V high[3], low[3];
        for (std::size_t k = 0; k < 3; ++k) {
            const DoubleDouble<V> t = lanes.n[k] * (lanes.w[(k + 1) % 3] * lanes.w[(k + 2) % 3]);
            high[k] = t.high;
            low[k] = t.low;
        }
        for (std::size_t step = 0; step < 3; ++step) {
            const std::size_t i = step % 2, j = i + 1;
            swap[step] = hn::Or(hn::Lt(high[i], high[j]), hn::And(hn::Eq(high[i], high[j]), hn::Lt(low[i], low[j])));
            sort(step, high);
            sort(step, low);
        }
        const auto less = [](V h, V l, V by_h, V by_l) HWY_ATTR {
            const TwoTerms<V> d = two_difference(h, by_h);
            return DoubleDouble<V>{d.high, d.low + (l - by_l)};
        };
        weight[0] = less(lanes.volume.high, lanes.volume.low, high[0], low[0]);
        weight[1] = less(high[0], low[0], high[1], low[1]);
        weight[2] = less(high[1], low[1], high[2], low[2]);
        weight[3] = {high[2], low[2]};
    }

    HWY_INLINE V value(const GridLanes<D>& lanes, const NodeComponent& field, hn::Mask<D>& sure) const {
        V f[8];
        const V most = lanes.load(field, f);
        V along[3] = {f[1], f[2], f[4]}, across[3] = {f[6], f[5], f[3]};  // the corner along an axis, and not along it
        for (std::size_t step = 0; step < 3; ++step) {
            sort(step, along);
            sort(step, across);
        }
        const Pair<V> two = sum(times(weight[0], f[0]), times(weight[1], along[0]));
        const Pair<V> all = sum(sum(two, times(weight[2], across[2])), times(weight[3], f[7]));
        return lanes.rounded(all, most, 848 * 0x1p-106, sure);
    }
};

template <class D>
HWY_INLINE hn::Mask<D> values_of_some(D tag, const AxisGrid& grid, const GridPoints& of, std::size_t first,
                                      std::size_t at, const FoundCells& found) {
    const GridLanes<D> lanes(tag, grid, of.points.data() + grid.dimension * first, found, at);
    hn::Mask<D> sure = lanes.certain;
    const auto set_all = [&](const auto& value_of) HWY_ATTR {
        for (std::size_t c = 0; c < of.fields.size(); ++c)
            store_strided(tag, value_of(of.fields[c]), of.values + of.width * first + c, of.width);
    };
    if (of.multilinear) {
        set_all([&](const NodeComponent& field) HWY_ATTR { return multilinear_value(lanes, field, sure); });
    } else {
        const GridPart<D> part(lanes);
        set_all([&](const NodeComponent& field) HWY_ATTR { return part.value(lanes, field, sure); });
    }
    const hn::Rebind<std::int32_t, D> narrow;
    const auto cells = hn::PromoteTo(tag, hn::LoadU(narrow, of.cells + first));
    return hn::Or(sure, hn::Lt(cells, hn::Zero(tag)));
}

std::size_t sample_all(const AxisGrid& grid, const GridPoints& of, std::uint32_t* undecided) {
    const std::size_t count = of.points.size() / grid.dimension;
    FoundCells found;
    UndecidedList list{undecided};
    std::size_t first = 0;
    const auto run = [&](auto tag) HWY_ATTR {
        constexpr std::size_t width = hn::MaxLanes(decltype(tag)());
        const std::size_t begin = first, vectors = (count - begin) / width;
        for (std::size_t i = 0; i < vectors + ahead; ++i) {
            if (i < vectors) find_some(tag, grid, of, begin + i * width, i % (ahead + 1) * width, found);
            if (i < ahead || of.fields.empty()) continue;
            const std::size_t at = begin + (i - ahead) * width, slot = (i - ahead) % (ahead + 1) * width;
            list.add(tag, values_of_some(tag, grid, of, at, slot, found), at, width);
        }
        first += vectors * width;
    };
    run(hn::ScalableTag<double>());
    run(hn::CappedTag<double, 1>());
    return list.count;
}

}  // namespace barycert::core::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::core {

HWY_EXPORT(sample_all);

AxisGrid::AxisGrid(int d, const std::array<std::vector<double>, 3>& axes) : dimension(static_cast<std::size_t>(d)) {
    static constexpr std::array<double, 2> unit{0, 1};
    std::size_t nodes = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::span<const double> own = k < dimension ? std::span<const double>(axes[k]) : unit;
        planes[k] = own.data();
        cells[k] = own.size() - 1;
        cells_per_unit[k] = static_cast<double>(cells[k]) / (own.back() - own.front());
        node_step[k] = k < dimension ? nodes : 0;
        nodes *= own.size();
    }
}

std::size_t AxisGrid::node_of(std::size_t cell) const {
    return cell % cells[0] + cell / cells[0] % cells[1] * node_step[1] + cell / cells[0] / cells[1] * node_step[2];
}

std::size_t AxisGrid::find(std::size_t axis, double x, std::int64_t guess) const {
    const double* const begin = planes[axis];
    const auto holds = [&](std::int64_t i) {
        return i >= 0 && i < static_cast<std::int64_t>(cells[axis]) && (begin[i] < x || i == 0) && x <= begin[i + 1];
    };
    for (const std::int64_t beside : {guess - 1, guess + 1}) {
        if (holds(beside)) return static_cast<std::size_t>(beside);
    }
    return static_cast<std::size_t>(std::lower_bound(begin + 1, begin + cells[axis], x) - begin - 1);
}

std::size_t sample_grid(const AxisGrid& grid, const GridPoints& points, std::uint32_t* undecided) {
    return HWY_DYNAMIC_DISPATCH(sample_all)(grid, points, undecided);
}

}  // namespace barycert::core
#endif
