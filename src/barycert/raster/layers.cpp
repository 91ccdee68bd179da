#include "barycert/raster/layers.hpp"

#include <atomic>

#include "barycert/base/arena.hpp"
#include "barycert/base/lists.hpp"
#include "barycert/environment.hpp"
#include "barycert/perspective.hpp"
#include "barycert/raster/fill_rows.hpp"
#include "barycert/raster/resolve.hpp"

namespace barycert::raster {
namespace {

/// A triangle within the clip volume, in the window of samples. Numbers are finite, w > 0, the area in the window is
/// not zero.
struct Part {
    std::array<double, 6> window;  ///< x and y of each vertex
    std::array<double, 3> z;       ///< z / w, the depth
    std::array<double, 3> w;
    std::array<std::uint32_t, 3> rows;  ///< of their numbers: vertices, or, if it was clipped, rows of `cut`
    std::uint32_t source;               ///< the triangle, or the line
    bool clipped = false, line = false;
};

/// What a range of triangles has become.
struct Parts {
    std::vector<Part> all;
    std::vector<double> cut;  ///< numbers of new vertices and those beside them
    RenderCounts counts;
};

/// False where plain weights may be off by more than 2^-38. With X and Y the extent of the triangle, a pixel's centre
/// in it is within X and Y of each vertex, so that the four differences of a signed area are exact or off by half an
/// ulp, and the area by at most 2 * 3.01 * 2^-53 X Y + 2^-53 X Y < 2^-50 X Y. Twice the triangle's area D is as exact.
/// For |D| >= 2^-11 X Y the quotient of both is off by less than 2^-50 * 2^11 * 2 + 2^-53 < 2^-37.9.
bool thick_enough(const std::array<double, 6>& v) {
    const double area = (v[2] - v[0]) * (v[5] - v[1]) - (v[4] - v[0]) * (v[3] - v[1]);
    const double wide = std::max({v[0], v[2], v[4]}) - std::min({v[0], v[2], v[4]});
    const double tall = std::max({v[1], v[3], v[5]}) - std::min({v[1], v[3], v[5]});
    return std::abs(area) >= 0x1p-11 * wide * tall;
}

class Clipper {
public:
    Clipper(const Layers& layers, RasterSize samples, Parts& to) : layers_(layers), samples_(samples), to_(to) {}

    void add(std::size_t triangle) {
        const std::size_t stride = 4 + layers_.numbers;
        const std::int32_t* const corners = layers_.triangles.data() + 3 * triangle;
        ++to_.counts.triangles;
        rows_.resize(3 * stride);
        for (std::size_t c = 0; c < 3; ++c) {
            const auto vertex = static_cast<std::size_t>(corners[c]);
            std::copy_n(layers_.clip.data() + 4 * vertex, 4, &rows_[stride * c]);
            if (layers_.numbers != 0) layers_.number(vertex, &rows_[stride * c + 4]);
        }
        // No error can occur: all numbers are finite.
        const Clip clip = clip_triangle(rows_, polygon_).value();
        if (clip == Clip::cut) ++to_.counts.clipped;
        if (clip == Clip::outside || clip == Clip::at_eye) {
            ++(clip == Clip::outside ? to_.counts.outside : to_.counts.degenerate);
            return;
        }
        const std::size_t vertices = polygon_.size() / stride;
        const auto first = static_cast<std::uint32_t>(layers_.numbers == 0 ? 0 : to_.cut.size() / layers_.numbers);
        window_.clear();
        for (std::size_t i = 0; i < vertices; ++i) {
            const double* const row = polygon_.data() + stride * i;
            window_.push_back(viewport(samples_, row[0], row[1], row[3], layers_.rounding));
            if (clip == Clip::cut) to_.cut.insert(to_.cut.end(), row + 4, row + stride);
        }
        bool area = false;
        for (std::size_t i = 1; i + 1 < vertices; ++i) {
            if (orient2d(window_[0].data(), window_[i].data(), window_[i + 1].data()) == Sign::zero) continue;
            area = true;
            Part& part = to_.all.emplace_back();
            part.source = static_cast<std::uint32_t>(triangle);
            part.clipped = clip == Clip::cut;
            const std::size_t fan[3] = {0, i, i + 1};
            for (std::size_t k = 0; k < 3; ++k) {
                const double* const row = polygon_.data() + stride * fan[k];
                std::copy_n(window_[fan[k]].data(), 2, &part.window[2 * k]);
                part.z[k] = row[2] / row[3];
                part.w[k] = row[3];
                part.rows[k] = part.clipped ? first + static_cast<std::uint32_t>(fan[k])
                                            : static_cast<std::uint32_t>(corners[fan[k]]);
            }
        }
        if (!area) ++to_.counts.degenerate;
    }

private:
    const Layers& layers_;
    RasterSize samples_;
    Parts& to_;
    std::vector<double> rows_, polygon_;
    std::vector<std::array<double, 2>> window_;
};

/// A line as two triangles; nothing if an end is not before the eye, or both are at one place.
void add_line(const Layers& layers, std::size_t index, RasterSize samples, std::vector<Part>& to) {
    const Line& line = layers.lines[index];
    std::array<std::array<double, 2>, 2> at;
    for (std::size_t i = 0; i < 2; ++i) {
        const auto& [x, y, z, w] = line.ends[i];
        if (!(w > 0)) return;
        at[i] = viewport(samples, x, y, w, Rounding::plain);
    }
    const double dx = at[1][0] - at[0][0], dy = at[1][1] - at[0][1], length = std::sqrt(dx * dx + dy * dy);
    if (!(length > 0) || !(length < 0x1p40)) return;
    const double half = 0.5 * line.width * layers.samples / length;
    // To the left and the right of both ends, which are half a width longer: lines that meet leave no notch.
    const auto corner = [&](std::size_t end, double side) {
        const double on = end == 0 ? -1 : 1;
        return std::array{at[end][0] + half * (on * dx * 0.5 - side * dy),
                          at[end][1] + half * (on * dy * 0.5 + side * dx)};
    };
    const std::array corners{corner(0, 1), corner(0, -1), corner(1, -1), corner(1, 1)};
    for (const std::array<std::size_t, 3>& fan : {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 3}}) {
        Part part{};
        part.source = static_cast<std::uint32_t>(index);
        part.line = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto& end = line.ends[fan[k] < 2 ? 0 : 1];
            std::copy_n(corners[fan[k]].data(), 2, &part.window[2 * k]);
            part.z[k] = end[2] / end[3];
            part.w[k] = end[3];
        }
        if (orient2d(&part.window[0], &part.window[2], &part.window[4]) != Sign::zero) to.push_back(part);
    }
}

/// The depth and the numbers of `count` pixels from what is linear in the window, in place.
///
/// With perspective, 1/w and v/w are interpolated. All are multiplied by the least w, so that 1/w cannot overflow; it
/// may underflow, for a vertex 2^1074 times as far away as another one, whose share is then below the last place.
void divide_by_scale(double* numbers, std::size_t own, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        const double* const in = numbers + (2 + own) * i;
        double* const to = numbers + (1 + own) * i;  // never ahead of what is still to be read
        const double depth = in[0], scale = in[1];
        to[0] = depth;
        for (std::size_t k = 0; k < own; ++k) to[1 + k] = in[2 + k] / scale;
    }
}

/// Rows of pixels, and their samples.
class Band {
public:
    Band(const Layers& layers, std::int32_t begin, std::int32_t end)
        : layers_(layers),
          samples_(layers.samples),
          width_(layers.size.width * samples_),
          begin_(begin * samples_),
          end_(end * samples_),
          colours_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(end_ - begin_), layers.background),
          depth_(colours_.size(), HUGE_VAL),
          slack_(layers.lines.empty() ? 0 : colours_.size(), 0.0F) {}

    RenderCounts counts;

    /// `numbers`: n of each vertex. True if it covers a sample.
    bool draw(const Part& part, std::span<const double> numbers) {
        const std::uint64_t before = counts.covered;
        part_ = &part;
        numbers_ = numbers;
        const bool at_each = samples_ == 1 || layers_.method != FillMethod::barycentric ||
                             layers_.rounding == Rounding::correct || !thick_enough(part.window);
        part.line || !at_each ? draw_pixels() : draw_samples();
        return counts.covered != before;
    }

    void resolve_into(Image& image) {
        counts.pixels +=
            static_cast<std::uint64_t>(std::ranges::count_if(depth_, [](double z) { return z < HUGE_VAL; }));
        raster::resolve(colours_, samples_, layers_.size.width, begin_ / samples_, image);
    }

private:
    std::size_t place(std::int32_t i, std::int32_t j) const {
        return static_cast<std::size_t>(j - begin_) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(i);
    }

    /// What is linear in the window at each vertex: the depth, the scale if there is one, numbers times the scale.
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
            counts.covered += static_cast<std::uint64_t>(last - first);
            const std::size_t from = place(first, j);
            for (std::size_t i = 0; i < static_cast<std::size_t>(last - first); ++i) {
                const double* const sample = row.data() + (1 + n) * i;
                if (!(sample[0] < depth_[from + i])) {
                    ++counts.hidden;
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
            counts.covered += static_cast<std::uint64_t>(part_->line ? 0 : last - first);
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
        if (!part_->line) counts.hidden += covered - seen;
        if (seen == 0) return;
        const auto n = static_cast<double>(covered);
        const Rgba colour = part_->line ? layers_.lines[part_->source].colour : colour_at(x / n + 0.5, y / n + 0.5);
        for (std::size_t i = 0; i < seen; ++i) colours_[places[i]] = colour;
    }

    Rgba colour_at(double x, double y) {
        const auto& v = part_->window;
        const double x0 = v[0] - x, x1 = v[2] - x, x2 = v[4] - x, y0 = v[1] - y, y1 = v[3] - y, y2 = v[5] - y;
        const double a = x1 * y2 - x2 * y1, b = x2 * y0 - x0 * y2, c = x0 * y1 - x1 * y0, sum = a + b + c;
        // Of a triangle without an area in double: its first vertex.
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
    const Part* part_ = nullptr;
    std::span<const double> numbers_;
    std::vector<double> values_, row_;
    std::array<double, 2> slope_{};
    float own_slack_ = 0;
};

class Drawing {
public:
    Drawing(const Layers& layers, RenderCounts& counts)
        : layers_(layers),
          counts_(counts),
          height_(layers.size.height),
          samples_{layers.size.width * layers.samples, layers.size.height * layers.samples},
          rows_(std::clamp((1 << 20) / (samples_.width * layers.samples), 1, 32)),
          image_(blank_image(layers.size.width, layers.size.height, layers.background).value()) {}

    Image run() {
        set_parts();
        const auto bands = static_cast<std::size_t>((height_ + rows_ - 1) / rows_);
        const base::Lists<std::uint32_t> of_band(bands, [&](auto add) {
            std::uint32_t all = 0;
            for (const Parts& some : parts_)
                for (const Part& part : some.all) add_to_bands(part, all++, add);
        });
        std::vector<const Part*> all;
        for (const Parts& some : parts_)
            for (const Part& part : some.all) all.push_back(&part);
        drawn_ = std::vector<std::atomic<bool>>(layers_.triangles.size() / 3);
        std::mutex mutex;
        base::parallel_for(bands, [&](std::size_t b) {
            const ExactEnvironment environment;  // threads that were there before have theirs
            const auto begin = static_cast<std::int32_t>(b) * rows_;
            Band band(layers_, begin, std::min(begin + rows_, height_));
            std::vector<double> numbers(3 * layers_.numbers);
            for (const std::uint32_t i : of_band[b]) {
                const Part& part = *all[i];
                set_numbers(part, numbers);
                if (band.draw(part, numbers) && !part.line) drawn_[part.source].store(true, std::memory_order_relaxed);
            }
            band.resolve_into(image_);
            const std::lock_guard lock(mutex);
            counts_.covered += band.counts.covered;
            counts_.hidden += band.counts.hidden;
            counts_.pixels += band.counts.pixels;
        });
        counts_.drawn =
            static_cast<std::uint64_t>(std::ranges::count_if(drawn_, [](const auto& d) { return d.load(); }));
        counts_.between_pixels = counts_.triangles - counts_.outside - counts_.degenerate - counts_.drawn;
        return std::move(image_);
    }

private:
    static constexpr std::size_t grain = 1U << 12;

    void set_parts() {
        const std::size_t triangles = layers_.triangles.size() / 3, ranges = (triangles + grain - 1) / grain;
        parts_.resize(ranges + 1);
        base::parallel_for(ranges, [&](std::size_t r) {
            const ExactEnvironment environment;
            Clipper clipper(layers_, samples_, parts_[r]);
            for (std::size_t t = r * grain; t < std::min((r + 1) * grain, triangles); ++t) clipper.add(t);
        });
        for (std::size_t i = 0; i < layers_.lines.size(); ++i) add_line(layers_, i, samples_, parts_.back().all);
        for (const Parts& p : parts_) {
            counts_.triangles += p.counts.triangles;
            counts_.outside += p.counts.outside;
            counts_.degenerate += p.counts.degenerate;
            counts_.clipped += p.counts.clipped;
        }
    }

    template <class Add>
    void add_to_bands(const Part& part, std::uint32_t index, const Add& add) const {
        const auto [low, high] = std::minmax({part.window[1], part.window[3], part.window[5]});
        const std::int32_t last_band = (height_ - 1) / rows_;
        const double tall = 1.0 * rows_ * layers_.samples, last = last_band;
        if (high < 0 || low > samples_.height) return;
        const auto first = static_cast<std::size_t>(std::clamp(std::floor(low / tall), 0.0, last));
        for (auto b = first; b <= static_cast<std::size_t>(std::clamp(std::floor(high / tall), 0.0, last)); ++b)
            add(b, index);
    }

    void set_numbers(const Part& part, std::vector<double>& numbers) const {
        const std::size_t n = layers_.numbers;
        if (n == 0 || part.line) return;
        const std::vector<double>& cut = parts_[part.source / grain].cut;
        for (std::size_t k = 0; k < 3; ++k) {
            if (part.clipped) {
                std::copy_n(&cut[n * part.rows[k]], n, &numbers[n * k]);
            } else {
                layers_.number(part.rows[k], &numbers[n * k]);
            }
        }
    }

    const Layers& layers_;
    RenderCounts& counts_;
    std::int32_t height_;
    RasterSize samples_;  ///< how many, across and up
    std::int32_t rows_;   ///< of pixels in a band
    Image image_;
    std::vector<Parts> parts_;  ///< of ranges of triangles; the last of lines
    std::vector<std::atomic<bool>> drawn_;
};

}  // namespace

Image draw(const Layers& layers, RenderCounts& counts) {
    counts = {};
    return Drawing(layers, counts).run();
}

}  // namespace barycert::raster
