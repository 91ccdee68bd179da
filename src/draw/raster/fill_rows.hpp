/// Ways to values at the pixels of a row, of numbers that are linear in the window: three in plain double arithmetic,
/// and one that rounds once. Coverage is not theirs: they are asked for pixels that the triangle covers, row after row
/// upwards.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/raster.hpp"
#include "barycert/simplex.hpp"
#include "barycert/weights.hpp"
#include "draw/raster/edge.hpp"

namespace barycert::raster {

/// Weights at each centre by signed areas: lambda_i = (v_{i+1} - p) x (v_{i+2} - p) / D, D twice the triangle's area.
struct BarycentricRows {
    const double* v;
    std::span<const double> values;
    std::size_t components;
    double area = (v[2] - v[0]) * (v[5] - v[1]) - (v[4] - v[0]) * (v[3] - v[1]);

    void fill(std::int32_t j, std::int32_t first, std::int32_t last, double* out) const {
        const double y0 = v[1] - (j + 0.5), y1 = v[3] - (j + 0.5), y2 = v[5] - (j + 0.5);
        for (std::int32_t i = first; i < last; ++i) {
            const double x0 = v[0] - (i + 0.5), x1 = v[2] - (i + 0.5), x2 = v[4] - (i + 0.5);
            const double w0 = (x1 * y2 - x2 * y1) / area;
            const double w1 = (x2 * y0 - x0 * y2) / area;
            const double w2 = (x0 * y1 - x1 * y0) / area;
            for (std::size_t c = 0; c < components; ++c)
                *out++ = w0 * values[c] + w1 * values[components + c] + w2 * values[2 * components + c];
        }
    }
};

/// A side of the triangle with the values at its ends, lower end first.
struct ValuedEdge {
    const double *a, *b;    ///< coordinates
    const double *fa, *fb;  ///< values, as many as there are components
};

/// The long side and the two short ones.
struct ValuedEdges {
    ValuedEdge whole, lower, upper;
};

inline ValuedEdges valued_edges(const SortedTriangle& t, const double* vertices, std::span<const double> values,
                                int components) {
    const auto edge = [&](int i, int k) {
        const double *const a = t.vertex[i], *const b = t.vertex[k];
        const auto values_of = [&](const double* v) { return values.data() + (v - vertices) / 2 * components; };
        return ValuedEdge{a, b, values_of(a), values_of(b)};
    };
    return {edge(0, 2), edge(0, 1), edge(1, 2)};
}

/// Values on the two sides that the line of the row meets; then along the line, with one division a row. That a centre
/// lies between the sides is known exactly, so a parameter that rounding has put outside [0, 1] is set to its end.
struct BilinearRows {
    ValuedEdges edges;
    std::int32_t middle;  ///< the first row that meets the upper short side
    std::size_t components;

    void fill(std::int32_t j, std::int32_t first, std::int32_t last, double* out) const {
        const double y = j + 0.5;
        const ValuedEdge &p = edges.whole, &q = j < middle ? edges.lower : edges.upper;
        const double tp = (y - p.a[1]) / (p.b[1] - p.a[1]), tq = (y - q.a[1]) / (q.b[1] - q.a[1]);
        const double xp = p.a[0] + tp * (p.b[0] - p.a[0]), xq = q.a[0] + tq * (q.b[0] - q.a[0]);
        const double inverse = xp == xq ? 0 : 1 / (xq - xp);
        for (std::int32_t i = first; i < last; ++i) {
            const double r = (i + 0.5 - xp) * inverse, s = r > 0 ? std::min(r, 1.0) : 0;  // 0 for NaN too
            for (std::size_t c = 0; c < components; ++c) {
                const double fp = p.fa[c] + tp * (p.fb[c] - p.fa[c]), fq = q.fa[c] + tq * (q.fb[c] - q.fa[c]);
                *out++ = fp + s * (fq - fp);
            }
        }
    }
};

/// Steps alone: from row to row along the long side, from pixel to pixel along the row by the triangle's d/dx.
class ScanlineRows {
public:
    ScanlineRows(const SortedTriangle& t, const double* vertices, std::span<const double> values, int components)
        : row_(t.begin), components_(static_cast<std::size_t>(components)) {
        const ValuedEdges edges = valued_edges(t, vertices, values, components);
        const ValuedEdge &p = edges.whole, &q = edges.lower;
        const double x1 = q.b[0] - q.a[0], y1 = q.b[1] - q.a[1], x2 = p.b[0] - p.a[0], y2 = p.b[1] - p.a[1];
        const double area = x1 * y2 - x2 * y1, start = (row_ + 0.5) - p.a[1];
        x_step_ = x2 / y2;
        x_ = p.a[0] + start * x_step_;
        for (std::size_t c = 0; c < components_.size(); ++c) {
            const double f1 = q.fb[c] - q.fa[c], f2 = p.fb[c] - p.fa[c], up = f2 / y2;
            components_[c] = {p.fa[c] + start * up, up, (f1 * y2 - f2 * y1) / area, 0};
        }
    }

    void fill(std::int32_t j, std::int32_t first, std::int32_t last, double* out) {
        for (; row_ < j; ++row_) {
            x_ += x_step_;
            for (Component& c : components_) c.at += c.up;
        }
        for (Component& c : components_) c.here = c.at + (first + 0.5 - x_) * c.along;
        for (std::int32_t i = first; i < last; ++i) {
            for (Component& c : components_) {
                *out++ = c.here;
                c.here += c.along;
            }
        }
    }

private:
    struct Component {
        double at, up;  ///< on the long side, and the step from row to row
        double along;   ///< d/dx
        double here;    ///< at a pixel
    };
    std::int32_t row_;   ///< where x_ and components stand
    double x_, x_step_;  ///< of the long side
    std::vector<Component> components_;
};

/// Each value the exact one at the centre, rounded once, by weights.hpp.
struct CorrectRows {
    std::span<const double> vertices, values;
    int components;
    std::vector<double> centres = {};  ///< of the pixels of the last row
    std::vector<std::int32_t> cells = {};

    void fill(std::int32_t j, std::int32_t first, std::int32_t last, double* out) {
        constexpr std::array<std::int32_t, 3> corners{0, 1, 2};
        const auto count = static_cast<std::size_t>(last - first), all = count * static_cast<std::size_t>(components);
        cells.assign(count, 0);
        centres.clear();
        for (std::int32_t i = first; i < last; ++i) centres.insert(centres.end(), {i + 0.5, j + 0.5});
        // No error can occur: sizes fit, and coordinates are finite.
        (void)interpolate(MeshQueries{Simplex::triangle, vertices, corners, cells, centres},
                          NodalValues<double>{values, components}, {out, all});
    }
};

/// use(rows) with the way that is asked for. With Rounding::correct there is one for all methods.
template <class Use>
auto with_rows(const SortedTriangle& t, const double* vertices, std::span<const double> values, int components,
               FillMethod method, Rounding rounding, Use use) {
    const auto n = static_cast<std::size_t>(components);
    if (rounding == Rounding::correct) return use(CorrectRows{{vertices, 6}, values, components});
    if (method == FillMethod::scanline) return use(ScanlineRows(t, vertices, values, components));
    if (method == FillMethod::bilinear)
        return use(BilinearRows{valued_edges(t, vertices, values, components), t.middle, n});
    return use(BarycentricRows{vertices, values, n});
}

}  // namespace barycert::raster
