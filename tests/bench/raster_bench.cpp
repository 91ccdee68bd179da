// Textured triangles: barycert's rasteriser beside the textbook's two loops, affine and in perspective.
//
// Every picture is verified first: the same pixels as cover_triangle, and texels within a stated distance of those at
// the exact texture coordinates; the loops' pixels that differ are counted. Times are the thread's own.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "barycert/raster.hpp"
#include "core/base/random.hpp"
#include "exact_table.hpp"
#ifdef BARYCERT_WITH_OSMESA
#include "raster_mesa.hpp"
#endif
#include "raster_peers.hpp"

namespace {

using namespace barycert;
using bench::Demand;
using bench::Row;

constexpr std::int32_t side = 1024, texture_side = 256;
constexpr int repetitions = 11;
constexpr double pixels_a_run = 4e6;

struct Picture {
    Image image{side, side, std::vector<std::uint8_t>(std::size_t{4} * side * side)};
    std::uint32_t* pixels() { return reinterpret_cast<std::uint32_t*>(image.data.data()); }
    bench::PixelRows rows() { return {pixels(), side, side}; }
};

/// Each texel has its own colour: its index.
struct Texels {
    Texture texture{
        {texture_side, texture_side, std::vector<std::uint8_t>(std::size_t{4} * texture_side * texture_side)}};
    Texels() {
        auto* const texels = reinterpret_cast<std::uint32_t*>(texture.image.data.data());
        for (std::uint32_t i = 0; i < texture_side * texture_side; ++i) texels[i] = 0xff000000U | i;
    }
    bench::TexelRows rows() const {
        return {reinterpret_cast<const std::uint32_t*>(texture.image.data.data()), texture_side, texture_side};
    }
};

/// Triangles with three equal sides, `across` pixels from the leftmost to the rightmost of their circle, anyhow turned.
std::vector<TexturedVertex> triangles(double across, bool perspective, bool snap = true) {
    base::Random random(5);
    std::vector<TexturedVertex> corners;
    // Numbers that single precision holds in clip coordinates too: OpenGL is given the same triangles.
    const auto snapped = [&](double x, double unit) { return snap ? std::round(x / unit) * unit : x; };
    const double radius = across / 2, area = 0.75 * std::sqrt(3.0) * radius * radius;
    const auto count = static_cast<std::size_t>(pixels_a_run / area) + 1;
    for (std::size_t k = 0; k < count; ++k) {
        const double x = random.uniform(radius, side - radius), y = random.uniform(radius, side - radius);
        const double turn = random.uniform(0, 6.28318530717958648), start = random.unit();
        for (int i = 0; i < 3; ++i) {
            const double a = turn + 2.09439510239319549 * i;
            const double w = perspective ? snapped(random.uniform(1, 4), 0.0625) : 1;
            // About a texel a pixel, or the whole texture.
            const double part = snapped(std::min(1.0, across / texture_side), 0x1p-16),
                         at = snapped((1 - part) * start, 0x1p-16);
            const double u = at + (i == 1 ? part : 0), v = at + (i == 2 ? part : 0);
            corners.push_back(
                {snapped(x + radius * std::cos(a), 0x1p-8), snapped(y + radius * std::sin(a), 0x1p-8), w, u, v});
        }
    }
    return corners;
}

std::size_t area_of(const std::vector<TexturedVertex>& c) {
    std::size_t pixels = 0;
    std::vector<PixelSpan> spans;
    for (std::size_t k = 0; k < c.size(); k += 3) {
        spans.clear();
        const double v[6] = {c[k].x, c[k].y, c[k + 1].x, c[k + 1].y, c[k + 2].x, c[k + 2].y};
        (void)cover_triangle({side, side}, v, spans);
        for (const PixelSpan& s : spans) pixels += static_cast<std::size_t>(s.end - s.begin);
    }
    return pixels;
}

struct Findings {
    std::size_t covered = 0, missed = 0, beyond = 0;  ///< pixels by exact coverage; of them not drawn; drawn besides
    double largest = 0;  ///< distance, in texels, of a drawn texel from the exact coordinates
};

/// Holds the picture of a single triangle against exact coverage and against the texture coordinates by double
/// arithmetic, whose error is far below what is found.
void judge(const std::uint32_t* pixels, const TexturedVertex* c, bool perspective, Findings& f) {
    const double v[6] = {c[0].x, c[0].y, c[1].x, c[1].y, c[2].x, c[2].y};
    std::vector<PixelSpan> spans;
    (void)cover_triangle({side, side}, v, spans);
    std::size_t drawn = 0;
    for (const PixelSpan& s : spans) {
        for (std::int32_t i = s.begin; i < s.end; ++i) {
            ++f.covered;
            const std::uint32_t pixel = pixels[static_cast<std::size_t>(s.row) * side + static_cast<std::size_t>(i)];
            if (pixel == 0) {
                ++f.missed;
                continue;
            }
            ++drawn;
            const double x = i + 0.5, y = s.row + 0.5;
            double w[3], sum = 0, at[2] = {0, 0};
            for (int n = 0; n < 3; ++n) {
                const auto &p = c[(n + 1) % 3], &q = c[(n + 2) % 3];
                w[n] = ((p.x - x) * (q.y - y) - (q.x - x) * (p.y - y)) / (perspective ? c[n].w : 1);
                sum += w[n];
            }
            for (int n = 0; n < 3; ++n) {
                at[0] += w[n] / sum * c[n].u * texture_side;
                at[1] += w[n] / sum * c[n].v * texture_side;
            }
            const std::uint32_t index = pixel & 0xffffffU;
            const double found[2] = {static_cast<double>(index % texture_side),
                                     static_cast<double>(index / texture_side)};
            for (int n = 0; n < 2; ++n) f.largest = std::max({f.largest, found[n] - at[n], at[n] - (found[n] + 1)});
        }
    }
    const auto all = std::count_if(pixels, pixels + std::size_t{side} * side, [](std::uint32_t p) { return p != 0; });
    f.beyond += static_cast<std::size_t>(all) - drawn;
}

constexpr std::size_t judged = 60;  ///< triangles

double largest_error(const std::vector<TexturedVertex>& corners, bool perspective) {
    Picture picture;
    const Texels texels;
    Findings f;
    for (std::size_t k = 0; k < std::min(corners.size(), 3 * judged); k += 3) {
        std::fill(picture.image.data.begin(), picture.image.data.end(), std::uint8_t{0});
        draw_textured(picture.image, texels.texture, {corners.data() + k, 3}, perspective).value();
        judge(picture.pixels(), corners.data() + k, perspective, f);
    }
    if (f.missed + f.beyond != 0) {
        std::fprintf(stderr, "wrong: of %zu covered pixels %zu are not drawn, and %zu others are\n", f.covered,
                     f.missed, f.beyond);
        std::exit(1);
    }
    return f.largest;
}

#ifdef BARYCERT_WITH_OSMESA
/// Compares what Mesa draws with the exact pictures.
void judge_mesa(const bench::MesaAnswer& mesa, const std::vector<TexturedVertex>& corners, bool perspective,
                const char* what) {
    Findings f;
    for (std::size_t k = 0; k < std::min(judged, corners.size() / 3); ++k)
        judge(mesa.pixels.data() + k * std::size_t{side} * side, corners.data() + 3 * k, perspective, f);
    std::printf("    %s: of %zu pixels %zu not drawn, %zu others drawn; texture coordinates off by up to %.3g texels\n",
                what, f.covered, f.missed, f.beyond, f.largest);
}

/// Mesa's times by the clock, and what it draws.
void beside_mesa(double across, const std::vector<TexturedVertex>& corners, double pixels, bool perspective) {
    const Texels texels;
    const std::size_t pictures = std::min(judged, corners.size() / 3);
    for (const int threads : {1, 2}) {
        const bench::MesaAnswer mesa =
            bench::draw_by_mesa(side, texels.rows(), corners, threads, repetitions, threads == 1 ? pictures : 0);
        if (mesa.version.empty()) {
            std::printf("Mesa: does not start\n");
            return;
        }
        std::printf("  Mesa %s, %d thread%s, %s: %.3g ns by the clock\n", mesa.version.c_str(), threads,
                    threads == 1 ? "" : "s", perspective ? "perspective" : "affine",
                    1e9 * bench::median(mesa.seconds) / pixels);
        if (threads == 1) judge_mesa(mesa, corners, perspective, "coordinates that single precision holds");
    }
    const auto any = triangles(across, perspective, false);
    const bench::MesaAnswer mesa =
        bench::draw_by_mesa(side, texels.rows(), any, 1, 1, std::min(judged, any.size() / 3));
    if (!mesa.version.empty()) judge_mesa(mesa, any, perspective, "any coordinates");
}
#endif

double seconds_of(const auto& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Two threads by the clock, in turn with the scanline loop.
void two_threads(const std::vector<TexturedVertex>& corners, double pixels) {
    Picture picture;
    const Texels texels;
    std::vector<double> ours, ratios;
    for (int r = 0; r < repetitions; ++r) {
        const double loop = seconds_of([&] { bench::scanline_loop(picture.rows(), texels.rows(), corners); });
        ours.push_back(seconds_of([&] { draw_textured(picture.image, texels.texture, corners, false, 2).value(); }));
        ratios.push_back(loop / ours.back());
    }
    std::printf("  affine, 2 threads: %.3g ns a pixel by the clock, scanline / affine %.3gx\n",
                1e9 * bench::median(ours) / pixels, bench::median(ratios));
}

}  // namespace

int main() {
    const bench::TargetTable table;
    const Texels texels;
    Picture picture;
    for (const double across : {10.0, 100.0, 500.0}) {
        const auto flat = triangles(across, false), deep = triangles(across, true);
        const auto pixels = static_cast<double>(area_of(flat)), deep_pixels = static_cast<double>(area_of(deep));
        std::printf("largest texture-coordinate error, texels of %d: affine %.3g, perspective %.3g\n", texture_side,
                    largest_error(flat, false), largest_error(deep, true));
        std::vector<Row> rows;
        const auto row = [&](const char* what, double count, auto work, bool peer) {
            rows.push_back({what, count, work, peer});
        };
        row(
            "textbook barycentric", pixels, [&] { bench::barycentric_loop(picture.rows(), texels.rows(), flat); },
            true);
        row(
            "textbook scanline", pixels, [&] { bench::scanline_loop(picture.rows(), texels.rows(), flat); }, true);
        row(
            "affine", pixels, [&] { draw_textured(picture.image, texels.texture, flat, false, 1).value(); }, false);
        row(
            "perspective", deep_pixels, [&] { draw_textured(picture.image, texels.texture, deep, true, 1).value(); },
            false);
        char title[100];
        std::snprintf(title, sizeof title, "triangles %g pixels across, ns a pixel", across);
        table.run(title, rows, repetitions);
        two_threads(flat, pixels);
#ifdef BARYCERT_WITH_OSMESA
        beside_mesa(across, flat, pixels, false);
        beside_mesa(across, deep, deep_pixels, true);
#endif
        table.demand(rows, {"scanline / affine", 1, 2, 8});
        table.demand(rows, {"perspective / affine", 3, 2, 1.5, true});
    }
}
