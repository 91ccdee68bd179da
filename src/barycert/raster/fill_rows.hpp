/// Ways to values at the pixels of a row, of numbers that are linear in the window: three in plain double arithmetic,
/// and one that rounds once. Coverage is not theirs: they are asked for pixels that the triangle covers, row after row
/// upwards.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "barycert/raster.hpp"
#include "barycert/raster/edge.hpp"

namespace barycert::raster {

/// Where pixel (i, j) stands in PixelValues::data.
inline std::size_t row_offset(const PixelValues& image, std::int32_t i, std::int32_t j) {
    const auto width = static_cast<std::size_t>(image.size.width);
    return (static_cast<std::size_t>(j) * width + static_cast<std::size_t>(i)) *
           static_cast<std::size_t>(image.components);
}

/// Weights at each centre by signed areas: lambda_i = (v_{i+1} - p) x (v_{i+2} - p) / D, D twice the triangle's area.
class BarycentricRows {
public:
    BarycentricRows(const double* vertices, std::span<const double> values, int components)
        : v_(vertices), values_(values), components_(static_cast<std::size_t>(components)) {
        area_ = (v_[2] - v_[0]) * (v_[5] - v_[1]) - (v_[4] - v_[0]) * (v_[3] - v_[1]);
    }

    void fill(std::int32_t j, std::int32_t first, std::int32_t last, double* out) const {
        const double y0 = v_[1] - (j + 0.5), y1 = v_[3] - (j + 0.5), y2 = v_[5] - (j + 0.5);
        for (std::int32_t i = first; i < last; ++i) {
            const double x0 = v_[0] - (i + 0.5), x1 = v_[2] - (i + 0.5), x2 = v_[4] - (i + 0.5);
            const double w0 = (x1 * y2 - x2 * y1) / area_;
            const double w1 = (x2 * y0 - x0 * y2) / area_;
            const double w2 = (x0 * y1 - x1 * y0) / area_;
            for (std::size_t c = 0; c < components_; ++c)
                *out++ = w0 * values_[c] + w1 * values_[components_ + c] + w2 * values_[2 * components_ + c];
        }
    }

private:
    const double* v_;
    std::span<const double> values_;
    std::size_t components_;
    double area_;
};

/// A side of the triangle with the values at its ends, lower end first.
struct ValuedEdge {
    const double *a = nullptr, *b = nullptr;    ///< coordinates
    const double *fa = nullptr, *fb = nullptr;  ///< values, as many as there are components
};

/// The long side and the two short ones.
struct ValuedEdges {
    ValuedEdge whole, lower, upper;
    std::int32_t middle;  ///< the first row that meets the upper short side

    ValuedEdges(const SortedTriangle& t, const double* vertices, std::span<const double> values, int components);

    const ValuedEdge& shorter(std::int32_t j) const { return j < middle ? lower : upper; }
};

/// Values on the two sides that the line of the row meets; then along the line, with one division a row. That a centre
/// lies between the sides is known exactly, so a parameter that rounding has put outside [0, 1] is set to its end.
class BilinearRows {
public:
    BilinearRows(const SortedTriangle& t, const double* vertices, std::span<const double> values, int components)
        : edges_(t, vertices, values, components), components_(static_cast<std::size_t>(components)) {}

    void fill(std::int32_t j, std::int32_t first, std::int32_t last, double* out) const;

private:
    ValuedEdges edges_;
    std::size_t components_;
};

/// Steps alone: from row to row along the long side, from pixel to pixel along the row by the triangle's d/dx.
class ScanlineRows {
public:
    ScanlineRows(const SortedTriangle& t, const double* vertices, std::span<const double> values, int components);

    void fill(std::int32_t j, std::int32_t first, std::int32_t last, double* out);

private:
    std::size_t components_;
    std::int32_t row_;           ///< where x_ and at_ stand
    double x_, x_step_;          ///< of the long side
    std::vector<double> at_;     ///< values on the long side
    std::vector<double> up_;     ///< their step from row to row
    std::vector<double> along_;  ///< d/dx
    std::vector<double> here_;   ///< values at a pixel
};

/// Each value the exact one at the centre, rounded once, by weights.hpp.
class CorrectRows {
public:
    CorrectRows(const double* vertices, std::span<const double> values, int components)
        : vertices_(vertices, 6), values_(values), components_(components) {}

    void fill(std::int32_t j, std::int32_t first, std::int32_t last, double* out);

private:
    std::span<const double> vertices_, values_;
    int components_;
    std::vector<double> points_;
    std::vector<std::int32_t> cells_;
};

/// The centres of the pixels of a row, one after the other, as `points`.
void set_centres(std::int32_t j, std::int32_t first, std::int32_t last, std::vector<double>& points);

/// use(rows) with the way that is asked for. With Rounding::correct there is one for all methods.
template <class Use>
auto with_rows(const SortedTriangle& t, const double* vertices, std::span<const double> values, int components,
               FillMethod method, Rounding rounding, Use use) {
    if (rounding == Rounding::correct) return use(CorrectRows(vertices, values, components));
    if (method == FillMethod::scanline) return use(ScanlineRows(t, vertices, values, components));
    if (method == FillMethod::bilinear) return use(BilinearRows(t, vertices, values, components));
    return use(BarycentricRows(vertices, values, components));
}

}  // namespace barycert::raster
