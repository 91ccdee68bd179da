// Rows of a grid against the planes of a cell's facets.
//
// For each corner i, the volume n_i (2D: area) that the point takes from it, as a function along a row: n_i = N_x x' +
// A with x' the distance from a vertex v of the facet, N its normal, A = N_y y' + N_z z'. As in filter-inl.hpp, with e
// = 2^-52 and X, Y, Z the sides of the cell's box, which also holds the points that are asked about: n_i has 6 terms of
// at most X Y Z, each with at most 8 roundings, so that N_x and A as computed give n_i up to E = 49 e X Y Z (2D: 2
// terms, 4 roundings, 8.5 e X Y), whatever the rounding mode, provided that the sides are within [2^-300, 2^300]. The
// signed volume of the cell has the same form and bound, by which its sign is certain or not.
//
// So with all signs turned such that the volume is positive, a point in the closed cell has N_x x' + A >= -E for all i,
// and one with N_x x' + A > E for all i is certainly inside. Solved for x', that is an interval; its ends are off by a
// few roundings of themselves, and places along the row by less than raster.slack: so much is added outside, and taken
// off inside.
#include "barycert/sample/grid/raster_lanes.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "barycert/sample/grid/raster_lanes.cpp"
#include "barycert/core/foreach_target.hpp"

#include "barycert/base/strict_math.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::sample::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using locate::Place;
using sample::Raster;
using sample::Span;

/// A facet's plane: its normal and a vertex on it.
struct Plane {
    double normal[3];
    const double* vertex;
};

struct CellPlanes {
    Plane plane[4];
    double error;  ///< E
    bool certain;  ///< the bounds hold and the sign of the volume is certain
    double low[3], high[3];
};

HWY_INLINE void cross_edges(const double* a, const double* b, const double* c, double sign, double* out) {
    const double e[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, f[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    out[0] = sign * (e[1] * f[2] - e[2] * f[1]);
    out[1] = sign * (e[2] * f[0] - e[0] * f[2]);
    out[2] = sign * (e[0] * f[1] - e[1] * f[0]);
}

template <Simplex s>
HWY_INLINE void find_planes(const locate::CellIndex& index, locate::Place cell, CellPlanes& out) {
    constexpr std::size_t n = vertex_count(s), d = space_dimension(s);
    const auto& node = index.cells[static_cast<std::size_t>(cell)].node;
    const double* v[4];
    for (std::size_t i = 0; i < n; ++i) v[i] = index.nodes[static_cast<std::size_t>(node[i])].at.data();
    double product = 1, min = 1, max = 1;
    for (std::size_t k = 0; k < d; ++k) {
        out.low[k] = out.high[k] = v[0][k];
        for (std::size_t i = 1; i < n; ++i) {
            out.low[k] = std::min(out.low[k], v[i][k]);
            out.high[k] = std::max(out.high[k], v[i][k]);
        }
        const double side = out.high[k] - out.low[k];
        product *= side;
        min = std::min(min, side);
        max = std::max(max, side);
    }
    double volume;
    if constexpr (d == 3) {
        double normal[3];
        cross_edges(v[0], v[2], v[3], 1, normal);
        volume = normal[0] * (v[1][0] - v[0][0]) + normal[1] * (v[1][1] - v[0][1]) + normal[2] * (v[1][2] - v[0][2]);
        const double sign = volume < 0 ? -1 : 1;
        for (int k = 0; k < 3; ++k) out.plane[1].normal[k] = sign * normal[k];
        cross_edges(v[1], v[2], v[3], -sign, out.plane[0].normal);
        cross_edges(v[0], v[3], v[1], sign, out.plane[2].normal);
        cross_edges(v[0], v[1], v[2], sign, out.plane[3].normal);
        out.error = 49 * 0x1p-52 * product;
    } else {
        const double e[2] = {v[1][0] - v[0][0], v[1][1] - v[0][1]}, f[2] = {v[2][0] - v[0][0], v[2][1] - v[0][1]};
        volume = e[0] * f[1] - e[1] * f[0];
        const double sign = volume < 0 ? -1 : 1;
        const double g[2] = {v[2][0] - v[1][0], v[2][1] - v[1][1]};
        const double normal[3][2] = {{-g[1], g[0]}, {f[1], -f[0]}, {-e[1], e[0]}};
        for (int i = 0; i < 3; ++i) {
            for (int k = 0; k < 2; ++k) out.plane[i].normal[k] = sign * normal[i][k];
        }
        out.error = 8.5 * 0x1p-52 * product;
    }
    for (std::size_t i = 0; i < n; ++i) out.plane[i].vertex = i == 0 ? v[1] : v[0];
    out.certain = min >= 0x1p-300 && max <= 0x1p300 && std::abs(volume) > out.error;
}

/// The first place of an axis that is not below x.
HWY_INLINE std::int32_t first_not_below(const std::vector<double>& at, double guess, double x) {
    const auto size = static_cast<std::int32_t>(at.size());
    auto i = static_cast<std::int32_t>(std::clamp(guess, 0.0, static_cast<double>(size)));
    while (i > 0 && at[static_cast<std::size_t>(i - 1)] >= x) --i;
    while (i < size && at[static_cast<std::size_t>(i)] < x) ++i;
    return i;
}

HWY_INLINE PlaceRange places_within(const std::vector<double>& at, double low, double high) {
    const double start = at.front(), extent = at.back() - start;
    const double scale = extent > 0 ? static_cast<double>(at.size() - 1) / extent : 0;
    const auto guess = [&](double x) {
        const double g = (x - start) * scale;
        return g >= 0 ? g : 0;  // also where it is no number
    };
    const std::int32_t first = first_not_below(at, guess(low), low);
    std::int32_t last = first_not_below(at, guess(high), high);
    while (last < static_cast<std::int32_t>(at.size()) && at[static_cast<std::size_t>(last)] == high) ++last;
    return {first, last};
}

/// The spans of up to MaxLanes rows at once: row r + l, all in one layer.
template <std::size_t n, std::size_t d, class D>
HWY_INLINE void row_spans(D tag, const Raster& raster, const CellPlanes& planes, PlaceRange columns, std::int32_t row,
                          std::int32_t last_row, std::int32_t layer, locate::Place cell, std::vector<Span>& out) {
    using V = hn::Vec<D>;
    constexpr std::size_t width = hn::MaxLanes(D());
    HWY_ALIGN double y[width];
    for (std::size_t l = 0; l < width; ++l)
        y[l] = raster.at[1][static_cast<std::size_t>(std::min(row + static_cast<std::int32_t>(l), last_row - 1))];
    const V rows = hn::Load(tag, y), zero = hn::Zero(tag);
    V low = hn::Set(tag, -1e300), high = hn::Set(tag, 1e300), inner_low = low, inner_high = high;
    for (std::size_t i = 0; i < n; ++i) {
        const Plane& plane = planes.plane[i];
        V a = hn::Set(tag, plane.normal[1]) * (rows - hn::Set(tag, plane.vertex[1]));
        if constexpr (d == 3) {
            const double z = raster.at[2][static_cast<std::size_t>(layer)] - plane.vertex[2];
            a = a + hn::Set(tag, plane.normal[2] * z);
        }
        const double slope = plane.normal[0], vertex = plane.vertex[0];
        const V error = hn::Set(tag, planes.error);
        if (std::abs(slope) * (planes.high[0] - planes.low[0]) <= planes.error) {
            // The plane is parallel to the rows, or so nearly that N_x x' is lost in the error. A greater slope is at
            // least 49 e Y Z, and its inverse far from overflow.
            const V twice = error + error;
            const auto none = hn::Lt(a, hn::Neg(twice)), unsure = hn::Le(a, twice);
            high = hn::IfThenElse(none, hn::Set(tag, -1e300), high);
            inner_high = hn::IfThenElse(unsure, hn::Set(tag, -1e300), inner_high);
            continue;
        }
        const V inverse = hn::Set(tag, 1 / slope), from = hn::Set(tag, vertex);
        const V reach = from + (zero - a - error) * inverse, inner = from + (error - a) * inverse;
        if (slope > 0) {
            low = hn::Max(low, reach);
            inner_low = hn::Max(inner_low, inner);
        } else {
            high = hn::Min(high, reach);
            inner_high = hn::Min(inner_high, inner);
        }
    }
    const V origin = hn::Set(tag, raster.origin[0]), scale = hn::Set(tag, raster.scale[0]);
    const V slack = hn::Set(tag, raster.slack), one = hn::Set(tag, 1);
    const V min = hn::Set(tag, columns.first), max = hn::Set(tag, columns.last);
    const auto clamp = [&](V x) HWY_ATTR { return hn::Min(hn::Max(x, min), max); };
    const hn::Rebind<std::int32_t, D> whole;
    HWY_ALIGN std::int32_t first[width], last[width], inner_first[width], inner_last[width];
    hn::Store(hn::DemoteTo(whole, clamp(hn::Ceil((low - origin) * scale - slack))), whole, first);
    hn::Store(hn::DemoteTo(whole, clamp(hn::Floor((high - origin) * scale + slack) + one)), whole, last);
    hn::Store(hn::DemoteTo(whole, clamp(hn::Ceil((inner_low - origin) * scale + slack))), whole, inner_first);
    hn::Store(hn::DemoteTo(whole, clamp(hn::Floor((inner_high - origin) * scale - slack) + one)), whole, inner_last);
    for (std::size_t l = 0; l < width && row + static_cast<std::int32_t>(l) < last_row; ++l) {
        if (first[l] >= last[l]) continue;
        out.push_back({cell, row + static_cast<std::int32_t>(l), layer, first[l], inner_first[l],
                       std::max(inner_first[l], inner_last[l]), last[l]});
    }
}

template <Simplex s>
void spans_of(const locate::CellIndex& index, const Raster& raster, const locate::Place* which, std::size_t count,
              std::int32_t first_layer, std::int32_t last_layer, std::vector<Span>& out) {
    constexpr std::size_t n = vertex_count(s), d = space_dimension(s);
    const hn::ScalableTag<double> tag;
    constexpr auto width = static_cast<std::int32_t>(hn::MaxLanes(hn::ScalableTag<double>()));
    for (std::size_t c = 0; c < count; ++c) {
        CellPlanes planes;
        find_planes<s>(index, which[c], planes);
        const PlaceRange columns = places_within(raster.at[0], planes.low[0], planes.high[0]);
        PlaceRange rows = places_within(raster.at[1], planes.low[1], planes.high[1]), layers{0, 1};
        PlaceRange& cut = d == 3 ? layers : rows;
        if constexpr (d == 3) layers = places_within(raster.at[2], planes.low[2], planes.high[2]);
        cut.first = std::max(cut.first, first_layer);
        cut.last = std::min(cut.last, last_layer);
        if (columns.first >= columns.last) continue;
        for (std::int32_t layer = layers.first; layer < layers.last; ++layer) {
            if (planes.certain && raster.precise) {
                for (std::int32_t row = rows.first; row < rows.last; row += width)
                    row_spans<n, d>(tag, raster, planes, columns, row, rows.last, layer, which[c], out);
                continue;
            }
            for (std::int32_t row = rows.first; row < rows.last; ++row)
                out.push_back({which[c], row, layer, columns.first, columns.first, columns.first, columns.last});
        }
    }
}

void find_spans(const locate::CellIndex& index, const Raster& raster, const locate::Place* which, std::size_t count,
                std::int32_t first_layer, std::int32_t last_layer, std::vector<Span>& out) {
    index.simplex == Simplex::triangle
        ? spans_of<Simplex::triangle>(index, raster, which, count, first_layer, last_layer, out)
        : spans_of<Simplex::tetrahedron>(index, raster, which, count, first_layer, last_layer, out);
}

}  // namespace barycert::sample::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::sample {

HWY_EXPORT(find_spans);

void find_spans(const locate::CellIndex& index, const Raster& raster, const locate::Place* which, std::size_t count,
                std::int32_t first_layer, std::int32_t last_layer, std::vector<Span>& out) {
    HWY_DYNAMIC_DISPATCH(find_spans)(index, raster, which, count, first_layer, last_layer, out);
}

}  // namespace barycert::sample
#endif
