// The filter of means over cells: sums in double-double with a bound on their error.
//
// u = 2^-53, rounding to nearest. V_i: d! times the volume of cell i without its sign; f_i its value; n cells;
//   A = sum V_i,   S = sum V_i f_i,   the mean is S / A.
// All arithmetic is that of error_free-inl.hpp: a sum is off by 4 u^2 (|x| + |y|), a product by 9 u^2 |x y|.
//
// Volumes. Edges are exact differences of two doubles. Each of the 6 monomials of the determinant (triangle: 2) meets a
// product and a difference in its minor, 13 u^2, a product and two sums outside, 17 u^2 (triangle: 13 u^2 in all). With
// X, Y, Z the extents of the edges as computed, exact to (1 + u), the determinant is off by at most 6 * 30 u^2 X Y Z
// (triangle: 2 * 13 u^2 X Y). E_i = 190 u^2 X Y Z (27 u^2 X Y) exceeds that and the roundings of its own evaluation. As
// ||x| - |y|| <= |x - y|, the bound holds for V_i whatever the sign, also where the sign itself is not certain.
//
// Sums. With v_i the volumes as computed, T = sum v_i |f_i| and the n sums taken one after the other,
//   |A as computed - A| <= sum E_i + 4 n u^2 sum v_i
//   |S as computed - S| <= sum E_i |f_i| + (4 n + 9) u^2 T
// Both are evaluated in double with 4.2 n + 11 for the second factors, and times 1.01: there are less than 2^32 cells,
// so that sums of so many positive numbers are exact to 2^-20.
//
// Quotient. As for projected simplices in refinement-inl.hpp, with h = fl(S / A) and c = (S - h A) / A,
//   |S / A - (h + c)| <= 1.02 (E_S + |h| E_A) / A + 26 u^2 |h|      if E_A <= 2^-10 A.
//
// Ranges; outside them nothing is certain. Extents in [2^-100, 2^100]: V <= 2^303, and E_i >= 2^-399. The largest |f_i|
// F is 0, and then so is the mean; or in [2^-200, 2^600]: S <= 2^940, also with 2^32 cells, and no factor of a product
// is above 2^640. The underflow in a volume is below 2^-1070 * 2^200, in a product V f below 2^-1070, and less than
// 2^-860 in all, against E_i >= 2^-399 and against E_S >= E_i F >= 2^-599 of the cell with F. In the quotient A <=
// 2^336: the underflow there is below 2^-1070, the bound at least 2^-599 / 2^336. NaN ends in a comparison that is
// false, an infinite value in F.
#include "mesh/sample/quantity/mean_lanes.hpp"
#include <cstddef>
#include <cstdint>
#include <span>
#include "barycert/mesh.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "mesh/sample/quantity/mean_lanes.cpp"
#include "core/foreach_target.hpp"

#include "core/lane_loop-inl.hpp"
#include "core/refinement-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::sample::HWY_NAMESPACE {

using namespace core::HWY_NAMESPACE;

template <class V>
HWY_INLINE DoubleDouble<V> magnitude_of(const DoubleDouble<V>& x) {
    const auto negative = hn::Lt(x.high, hn::Zero(hn::DFromV<V>()));
    return {hn::Abs(x.high), hn::IfThenElse(negative, hn::Neg(x.low), x.low)};
}

template <int d>
HWY_INLINE void volumes_of(const Mesh& mesh, std::size_t first, std::size_t count, CellVolume* out) {
    const hn::ScalableTag<double> tag;
    using D = decltype(tag);
    using V = hn::Vec<D>;
    using Number = DoubleDouble<V>;
    constexpr std::size_t width = hn::MaxLanes(D());
    constexpr double u = 0x1p-53;
    for (std::size_t at = 0; at < count; at += width) {
        HWY_ALIGN double gathered[d + 1][d][width];
        for (std::size_t l = 0; l < width; ++l) {
            const std::size_t cell = first + (at + l < count ? at + l : count - 1);
            for (std::size_t i = 0; i <= d; ++i) {
                const auto node = static_cast<std::size_t>(mesh.cells[(d + 1) * cell + i]);
                for (std::size_t k = 0; k < d; ++k) gathered[i][k][l] = mesh.points[d * node + k];
            }
        }
        Number edge[d][d];
        V rounded[d][d], extent[d];
        for (int i = 0; i < d; ++i) {
            for (int k = 0; k < d; ++k) {
                edge[i][k] = two_difference(hn::Load(tag, gathered[i + 1][k]), hn::Load(tag, gathered[0][k]));
                rounded[i][k] = edge[i][k].high;
            }
        }
        extents(rounded, extent);
        V bound = hn::Set(tag, (d == 2 ? 27 : 190) * u * u);
        for (int k = 0; k < d; ++k) bound = bound * extent[k];
        const auto valid = all_within(tag, extent, 0x1p-100, 0x1p100);
        const Number volume = magnitude_of(determinant(edge));
        HWY_ALIGN double high[width], low[width], error[width];
        hn::Store(volume.high, tag, high);
        hn::Store(volume.low, tag, low);
        hn::Store(hn::IfThenElse(valid, bound, hn::Inf(tag)), tag, error);
        for (std::size_t l = 0; l < width && at + l < count; ++l) out[at + l] = {high[l], low[l], error[l]};
    }
}

void volumes_of_cells(const Mesh& mesh, std::size_t first, std::size_t count, CellVolume* out) {
    if (mesh.dimension == 2) return volumes_of<2>(mesh, first, count, out);
    volumes_of<3>(mesh, first, count, out);
}

/// Sums over the cells of a node a lane.
template <class V>
struct LaneSums {
    DoubleDouble<V> weighted, total;  ///< S and A
    V weighted_error, total_error;    ///< sums of E_i |f_i| and of E_i
    V size, max_value;                ///< T and F
};

/// Nodes first + at ... of component c. A node with fewer cells than others adds zeros.
template <class D, class V = hn::Vec<D>>
HWY_INLINE LaneSums<V> sum_over_cells(D tag, const MeanInput& input, std::size_t begin, std::size_t nodes,
                                      std::size_t most, std::size_t c) {
    constexpr std::size_t width = hn::MaxLanes(D());
    const V zero = hn::Zero(tag);
    LaneSums<V> s{{zero, zero}, {zero, zero}, zero, zero, zero, zero};
    HWY_ALIGN double high[width] = {}, low[width] = {}, error[width] = {}, value[width] = {};
    for (std::size_t j = 0; j < most; ++j) {
        for (std::size_t l = 0; l < nodes; ++l) {
            const std::span<const Mesh::Index> cells = input.cells[begin + l];
            if (j >= cells.size()) {
                high[l] = low[l] = error[l] = value[l] = 0;
                continue;
            }
            const auto cell = static_cast<std::size_t>(cells[j]);
            const CellVolume& volume = input.volumes[cell];
            high[l] = volume.high;
            low[l] = volume.low;
            error[l] = volume.error;
            value[l] = input.values[input.components * cell + c];
        }
        const DoubleDouble<V> v{hn::Load(tag, high), hn::Load(tag, low)};
        const V e = hn::Load(tag, error), f = hn::Load(tag, value), f_size = hn::Abs(f);
        s.weighted = s.weighted + v * DoubleDouble<V>{f, zero};
        s.total = s.total + v;
        s.weighted_error = s.weighted_error + e * f_size;
        s.total_error = s.total_error + e;
        s.size = s.size + v.high * f_size;
        s.max_value = hn::Max(s.max_value, f_size);
    }
    return s;
}

/// S / A correctly rounded, where certain.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V quotient(D tag, const LaneSums<V>& s, double cells, hn::Mask<D>& certain) {
    constexpr double u = 0x1p-53;
    const auto constant = [&](double x) HWY_ATTR { return hn::Set(tag, x); };
    const V inverse = constant(1) / s.total.high;
    const V total_error = constant(1.01) * (s.total_error + constant((4.2 * cells + 11) * u * u) * s.total.high);
    const V weighted_error = constant(1.01) * (s.weighted_error + constant((4.2 * cells + 11) * u * u) * s.size);
    const V h = s.weighted.high / s.total.high;
    const TwoTerms<V> p = two_product(h, s.total.high);
    const V rest = ((s.weighted.high - p.high) - p.low) + (s.weighted.low - h * s.total.low);
    const V correction = rest * inverse;
    // As core's `weight`: what rounding correction -+ error takes is added to the error.
    const V error =
        constant(1.02) * (weighted_error + hn::Abs(h) * total_error) * inverse + constant(26 * u * u) * hn::Abs(h);
    const V wider = constant(1 + 0x1p-40) * error + constant(0x1p-52) * hn::Abs(correction);
    certain = hn::And(certain, hn::Lt(total_error, constant(0x1p-10) * s.total.high));  // not of a node without cells
    auto rounds = certain;
    const V mean = rounded_if_certain<D>(h, correction, wider, rounds);
    const auto no_values = hn::Eq(s.size + s.max_value, hn::Zero(tag));
    const auto in_range = hn::And(hn::Ge(s.max_value, constant(0x1p-200)), hn::Le(s.max_value, constant(0x1p600)));
    certain = hn::And(certain, hn::Or(no_values, hn::And(rounds, in_range)));
    return hn::IfThenElse(no_values, hn::Zero(tag), mean);
}

std::size_t means_of_nodes(const MeanInput& input, std::size_t first, std::size_t count, double* out,
                           std::uint32_t* undecided) {
    const hn::ScalableTag<double> tag;
    using D = decltype(tag);
    constexpr std::size_t width = hn::MaxLanes(D());
    UndecidedList list{undecided};
    for (std::size_t at = 0; at < count; at += width) {
        const std::size_t nodes = count - at < width ? count - at : width, begin = first + at;
        std::size_t most = 0;
        for (std::size_t l = 0; l < nodes; ++l) {
            const std::size_t cells = input.cells[begin + l].size();
            most = cells > most ? cells : most;
        }
        auto certain = hn::Eq(hn::Zero(tag), hn::Zero(tag));
        for (std::size_t c = 0; c < input.components; ++c) {
            const auto sums = sum_over_cells(tag, input, begin, nodes, most, c);
            HWY_ALIGN double lanes[width];
            hn::Store(quotient(tag, sums, static_cast<double>(most), certain), tag, lanes);
            for (std::size_t l = 0; l < nodes; ++l) out[input.components * (at + l) + c] = lanes[l];
        }
        list.add(tag, certain, at, nodes);
    }
    return list.count;
}

}  // namespace barycert::sample::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::sample {

HWY_EXPORT(volumes_of_cells);
HWY_EXPORT(means_of_nodes);

void volume_lanes(const Mesh& mesh, std::size_t first, std::size_t count, CellVolume* out) {
    HWY_DYNAMIC_DISPATCH(volumes_of_cells)(mesh, first, count, out);
}

std::size_t mean_lanes(const MeanInput& input, std::size_t first, std::size_t count, double* out,
                       std::uint32_t* undecided) {
    return HWY_DYNAMIC_DISPATCH(means_of_nodes)(input, first, count, out, undecided);
}

}  // namespace barycert::sample
#endif
