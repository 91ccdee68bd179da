#include "draw/raster/layers.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/raster.hpp"
#include "barycert/scene.hpp"
#include "barycert/weights.hpp"
#include "core/base/lists.hpp"
#include "core/exact_tier.hpp"
#include "draw/raster/band.hpp"
#include "draw/raster/parts.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::raster {
namespace {

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
        std::vector<const Primitive*> all;
        for (const Parts& some : parts_)
            for (const Primitive& part : some.all) all.push_back(&part);
        const base::Lists<std::uint32_t> of_band(bands, [&](auto add) {
            for (std::size_t i = 0; i < all.size(); ++i) add_to_bands(*all[i], static_cast<std::uint32_t>(i), add);
        });
        drawn_ = std::vector<std::atomic<bool>>(layers_.triangles.size() / 3);
        std::mutex mutex;
        base::parallel_for(bands, [&](std::size_t b) {
            const ExactEnvironment environment;  // threads that were there before have theirs
            const auto begin = static_cast<std::int32_t>(b) * rows_;
            Band band(layers_, begin, std::min(begin + rows_, height_));
            std::vector<double> numbers(3 * layers_.numbers);
            for (const std::uint32_t i : of_band[b]) {
                const Primitive& part = *all[i];
                set_numbers(part, numbers);
                if (band.draw(part, numbers) && !part.line) drawn_[part.source].store(true, std::memory_order_relaxed);
            }
            const RenderCounts own = band.resolve_into(image_);
            const std::lock_guard lock(mutex);
            counts_.covered += own.covered;
            counts_.hidden += own.hidden;
            counts_.pixels += own.pixels;
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
    void add_to_bands(const Primitive& part, std::uint32_t index, const Add& add) const {
        const auto [low, high] = std::minmax({part.window[1], part.window[3], part.window[5]});
        const std::int32_t last_band = (height_ - 1) / rows_;
        const double tall = 1.0 * rows_ * layers_.samples, last = last_band;
        if (high < 0 || low > samples_.height) return;
        const auto first = static_cast<std::size_t>(std::clamp(std::floor(low / tall), 0.0, last));
        for (auto b = first; b <= static_cast<std::size_t>(std::clamp(std::floor(high / tall), 0.0, last)); ++b)
            add(b, index);
    }

    void set_numbers(const Primitive& part, std::vector<double>& numbers) const {
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

std::vector<double> in_clip_space(std::span<const double> positions, const Matrix4& to_clip, Rounding rounding) {
    std::vector<double> clip(positions.size());
    base::parallel_for(clip.size(), std::size_t{1} << 16, [&](std::size_t begin, std::size_t end) {
        const ExactEnvironment environment;
        for (std::size_t i = begin; i != end; ++i) {
            const double* const p = positions.data() + i / 4 * 4;
            const double* const m = to_clip.m.data() + i % 4 * 4;
            clip[i] = rounding == Rounding::correct ? core::exact_dot(m, p, 4)
                                                    : m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3] * p[3];
        }
    });
    return clip;
}

Image draw(const Layers& layers, RenderCounts& counts) {
    counts = {};
    return Drawing(layers, counts).run();
}

}  // namespace barycert::raster
