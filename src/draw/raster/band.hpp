/// Rows of pixels, and the samples in them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

#include "barycert/perspective.hpp"
#include "barycert/raster.hpp"
#include "barycert/scene.hpp"
#include "barycert/weights.hpp"
#include "core/base/strict_math.hpp"
#include "draw/raster/edge.hpp"
#include "draw/raster/fill_rows.hpp"
#include "draw/raster/layers.hpp"
#include "draw/raster/parts.hpp"
#include "draw/raster/resolve.hpp"

namespace barycert::raster {

/// False where plain weights may be off by more than 2^-38. With X and Y the extent of the triangle, a pixel's centre
/// in it is within X and Y of each vertex, so that the four differences of a signed area are exact or off by half an
/// ulp, and the area by at most 2 * 3.01 * 2^-53 X Y + 2^-53 X Y < 2^-50 X Y. Twice the triangle's area D is as exact.
/// For |D| >= 2^-11 X Y the quotient of both is off by less than 2^-50 * 2^11 * 2 + 2^-53 < 2^-37.9.
inline bool thick_enough(const std::array<double, 6>& v) {
    const double area = (v[2] - v[0]) * (v[5] - v[1]) - (v[4] - v[0]) * (v[3] - v[1]);
    const double wide = std::max({v[0], v[2], v[4]}) - std::min({v[0], v[2], v[4]});
    const double tall = std::max({v[1], v[3], v[5]}) - std::min({v[1], v[3], v[5]});
    return std::abs(area) >= 0x1p-11 * wide * tall;
}

/// The depth and the numbers of `count` pixels from what is linear in the window, in place.
///
/// With perspective, 1/w and v/w are interpolated. All are multiplied by the least w, so that 1/w cannot overflow; it
/// may underflow, for a vertex 2^1074 times as far away as another one, whose share is then below the last place.
inline void divide_by_scale(double* numbers, std::size_t own, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const double* const in = numbers + (2 + own) * i;
        double* const to = numbers + (1 + own) * i;  // never ahead of what is still to be read
        const double depth = in[0], scale = in[1];
        to[0] = depth;
        for (std::size_t k = 0; k < own; ++k) to[1 + k] = in[2 + k] / scale;
    }
}

class Band {
public:
    /// Rows of pixels begin ... end - 1.
    Band(const Layers& layers, std::int32_t begin, std::int32_t end)
        : layers_(layers),
          samples_(layers.samples),
          width_(layers.size.width * samples_),
          begin_(begin * samples_),
          end_(end * samples_),
          colours_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(end_ - begin_), layers.background),
          depth_(colours_.size(), HUGE_VAL),
          slack_(layers.lines.empty() ? 0 : colours_.size(), 0.0F) {}

    /// `numbers`: layers.numbers of each vertex. True if it covers a sample.
    bool draw(const Primitive& part, std::span<const double> numbers) {
        const std::uint64_t before = counts_.covered;
        part_ = &part;
        numbers_ = numbers;
        const bool at_each = samples_ == 1 || layers_.method != FillMethod::barycentric ||
                             layers_.rounding == Rounding::correct || !thick_enough(part.window);
        part.line || !at_each ? draw_pixels() : draw_samples();
        return counts_.covered != before;
    }

    /// When all is drawn: into the rows of the image, and what has become of samples.
    RenderCounts resolve_into(Image& image) {
        counts_.pixels +=
            static_cast<std::uint64_t>(std::ranges::count_if(depth_, [](double z) { return z < HUGE_VAL; }));
        resolve(colours_, samples_, layers_.size.width, begin_ / samples_, image);
        return counts_;
    }

private:
    std::size_t place(std::int32_t i, std::int32_t j) const {
        return static_cast<std::size_t>(j - begin_) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(i);
    }

    /// The numbers that are linear in the window, at each vertex: the depth, the scale if there is one, the attributes
    /// times the scale.
    std::vector<double> linear_values() const {
        const bool affine = layers_.interpolation == Interpolation::affine;
        const bool projected = layers_.interpolation == Interpolation::projected_z;
        const std::size_t n = layers_.numbers;
        const double least = std::ranges::min(part_->w);
        std::vector<double> values;
        for (std::size_t i = 0; i < 3; ++i) {
            const double scale = affine ? 1 : projected ? 1 / ((part_->z[i] + 1) / 2) : least / part_->w[i];
            values.push_back(part_->z[i]);
            if (!affine) values.push_back(scale);
            for (std::size_t k = 0; k < n; ++k) values.push_back(scale * numbers_[n * i + k]);
        }
        return values;
    }

    /// The differences of the depth from sample to sample.
    std::array<double, 2> slope() const {
        const auto& v = part_->window;
        const auto& z = part_->z;
        const double area = (v[2] - v[0]) * (v[5] - v[1]) - (v[4] - v[0]) * (v[3] - v[1]);
        return {((z[1] - z[0]) * (v[5] - v[1]) - (z[2] - z[0]) * (v[3] - v[1])) / area,
                ((z[2] - z[0]) * (v[2] - v[0]) - (z[1] - z[0]) * (v[4] - v[0])) / area};
    }

    /// How far in front of this triangle a line along its edge may seem to be: where it is beside its middle.
    float slack() const {
        constexpr double widest = 3, most = 0x1p-8, rounding = 0x1p-20;
        const auto [along, up] = slope();
        const double own = widest * samples_ * (std::fabs(along) + std::fabs(up)) + rounding;
        return static_cast<float>(own < most ? own : most);  // NaN: of a sliver
    }

    /// fill(j, first, last, numbers): the depth and the numbers of these samples of row j, 1 + n each.
    template <class Fill>
    void draw_rows(const SortedTriangle& sorted, Fill fill) {
        const std::size_t n = layers_.numbers;
        const float own = slack_.empty() ? 0 : slack();
        std::vector<double> row;
        for_spans(sorted, width_, begin_, end_, [&](std::int32_t j, std::int32_t first, std::int32_t last) {
            fill(j, first, last, row);
            counts_.covered += static_cast<std::uint64_t>(last - first);
            const std::size_t from = place(first, j);
            for (std::size_t i = 0; i < static_cast<std::size_t>(last - first); ++i) {
                const double* const sample = row.data() + (1 + n) * i;
                if (!(sample[0] < depth_[from + i])) {
                    ++counts_.hidden;
                    continue;
                }
                depth_[from + i] = sample[0];
                if (!slack_.empty()) slack_[from + i] = own;
                colours_[from + i] = layers_.colour(sample + 1, part_->source);
                if (layers_.kept != nullptr)
                    std::copy_n(sample + 1, n, &layers_.kept->data[n * (from + i + place(0, 2 * begin_))]);
            }
        });
    }

    /// With depths and numbers that are each the exact function of the vertices' window coordinates, w and numbers in
    /// perspective, rounded once.
    void draw_correct(const SortedTriangle& sorted) {
        const std::size_t n = layers_.numbers;
        std::array<double, 9> vertices;
        for (std::size_t i = 0; i < 3; ++i) {
            vertices[3 * i] = part_->window[2 * i];
            vertices[3 * i + 1] = part_->window[2 * i + 1];
            vertices[3 * i + 2] = part_->w[i];
        }
        CorrectRows depth{part_->window, part_->z, 1};
        std::vector<double> depths, values;
        draw_rows(sorted, [&](std::int32_t j, std::int32_t first, std::int32_t last, auto& out) {
            const auto count = static_cast<std::size_t>(last - first);
            depths.resize(count);
            depth.fill(j, first, last, depths.data());
            values.resize(n * count);
            // No error can occur: sizes fit, coordinates are finite, w > 0.
            (void)perspective_values(vertices.data(), depth.centres, numbers_, static_cast<int>(n), values);
            out.clear();
            for (std::size_t i = 0; i < count; ++i) {
                out.push_back(depths[i]);
                out.insert(out.end(), values.data() + n * i, values.data() + n * (i + 1));
            }
        });
    }

    /// Each sample with numbers of its own.
    void draw_samples() {
        const SortedTriangle sorted(part_->window.data(), layers_.size.height * samples_);
        const bool correct = layers_.rounding == Rounding::correct,
                   affine = layers_.interpolation == Interpolation::affine;
        if (correct && layers_.numbers != 0 && !affine) return draw_correct(sorted);
        const std::vector<double> values = linear_values();
        const std::size_t linear = values.size() / 3;
        const auto draw = [&](auto rows) {
            draw_rows(sorted, [&](std::int32_t j, std::int32_t first, std::int32_t last, auto& numbers) {
                const auto count = static_cast<std::size_t>(last - first);
                numbers.resize(linear * count);
                rows.fill(j, first, last, numbers.data());
                if (!affine) divide_by_scale(numbers.data(), layers_.numbers, count);
            });
        };
        with_rows(sorted, part_->window.data(), values, static_cast<int>(linear), layers_.method,
                  correct || !thick_enough(part_->window) ? Rounding::correct : Rounding::plain, draw);
    }

    /// Rows of samples of one row of pixels, each with the samples that are covered.
    struct PixelRow {
        std::int32_t row = 0;  ///< of pixels
        std::array<std::pair<std::int32_t, std::int32_t>, max_samples> spans{};
        std::int32_t low = INT32_MAX, high = 0;  ///< of all spans
    };

    /// One colour in each pixel.
    void draw_pixels() {
        const SortedTriangle sorted(part_->window.data(), layers_.size.height * samples_);
        values_ = linear_values();
        slope_ = slope();
        own_slack_ = slack_.empty() || part_->line ? 0 : slack();
        PixelRow row{.row = -1};
        for_spans(sorted, width_, begin_, end_, [&](std::int32_t j, std::int32_t first, std::int32_t last) {
            if (j / samples_ != row.row) {
                draw_row(row);
                row = {.row = j / samples_};
            }
            row.spans[static_cast<std::size_t>(j % samples_)] = {first, last};
            row.low = std::min(row.low, first);
            row.high = std::max(row.high, last);
            counts_.covered += static_cast<std::uint64_t>(part_->line ? 0 : last - first);
        });
        draw_row(row);
    }

    void draw_row(const PixelRow& row) {
        for (std::int32_t i = row.low / samples_; i * samples_ < row.high; ++i) draw_pixel(row, i);
    }

    void draw_pixel(const PixelRow& row, std::int32_t pixel) {
        std::size_t covered = 0, seen = 0;
        std::array<std::size_t, std::size_t{max_samples} * max_samples> places;
        double x = 0, y = 0;
        const std::int32_t left = pixel * samples_;
        for (std::int32_t s = 0; s < samples_; ++s) {
            const auto& [from, to] = row.spans[static_cast<std::size_t>(s)];
            const std::int32_t j = row.row * samples_ + s, first = std::max(left, from),
                               last = std::min(left + samples_, to);
            const double v = j + 0.5 - part_->window[1];
            for (std::int32_t i = first; i < last; ++i) {
                const double u = i + 0.5 - part_->window[0], z = part_->z[0] + slope_[0] * u + slope_[1] * v;
                const std::size_t at = place(i, j);
                x += i;
                y += j;
                ++covered;
                const double limit = part_->line ? depth_[at] + double{slack_[at]} : depth_[at];
                if (!(z < limit)) continue;
                places[seen++] = at;
                if (!part_->line) depth_[at] = z;  // of lines a later one lies above
                if (!slack_.empty() && !part_->line) slack_[at] = own_slack_;
            }
        }
        if (!part_->line) counts_.hidden += covered - seen;
        if (seen == 0) return;
        const auto n = static_cast<double>(covered);
        const Rgba colour = part_->line ? layers_.lines[part_->source].colour : colour_at(x / n + 0.5, y / n + 0.5);
        for (std::size_t i = 0; i < seen; ++i) colours_[places[i]] = colour;
    }

    Rgba colour_at(double x, double y) {
        const auto& v = part_->window;
        const double x0 = v[0] - x, x1 = v[2] - x, x2 = v[4] - x, y0 = v[1] - y, y1 = v[3] - y, y2 = v[5] - y;
        const double a = x1 * y2 - x2 * y1, b = x2 * y0 - x0 * y2, c = x0 * y1 - x1 * y0, sum = a + b + c;
        // Takes the first vertex of a triangle without an area in double.
        const std::array<double, 3> weights =
            sum == 0 ? std::array{1.0, 0.0, 0.0} : std::array{a / sum, b / sum, c / sum};
        const std::size_t linear = values_.size() / 3, n = layers_.numbers;
        row_.assign(linear, 0);
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < linear; ++k) row_[k] += weights[i] * values_[linear * i + k];
        if (layers_.interpolation != Interpolation::affine) divide_by_scale(row_.data(), n, 1);
        return layers_.colour(row_.data() + 1, part_->source);
    }

    const Layers& layers_;
    std::int32_t samples_, width_, begin_, end_;  ///< of rows of samples
    std::vector<Rgba> colours_;
    std::vector<double> depth_;  ///< of each sample; infinite where nothing is drawn
    std::vector<float> slack_;
    RenderCounts counts_;
    const Primitive* part_ = nullptr;
    std::span<const double> numbers_;
    std::vector<double> values_, row_;
    std::array<double, 2> slope_{};
    float own_slack_ = 0;
};

}  // namespace barycert::raster
