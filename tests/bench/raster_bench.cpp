// Textured triangles: barycert's rasteriser beside the textbook's two loops, affine and in perspective.
//
// Every picture is verified first: the same pixels as cover_triangle, and texels within a stated distance of those at
// the exact texture coordinates; the loops' pixels that differ are counted. Times are the thread's own.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "barycert/base/random.hpp"
#include "barycert/raster.hpp"
#include "barycert/raster/textured_lanes.hpp"
#include "exact_table.hpp"
#include "raster_peers.hpp"

namespace {

using namespace barycert;
using bench::Demand;
using bench::Row;
using raster::PixelRows;
using raster::TexelRows;
using raster::TexturedCorner;

constexpr std::int32_t side = 1024, texture_side = 256;
constexpr int repetitions = 11;
constexpr double pixels_a_run = 4e6;

struct Picture {
    std::vector<std::uint32_t> pixels = std::vector<std::uint32_t>(static_cast<std::size_t>(side) * side);
    PixelRows rows() { return {pixels.data(), side, side}; }
};

/// Each texel has its own colour: its index.
struct Texels {
    std::vector<std::uint32_t> texels;
    Texels() {
        for (std::uint32_t i = 0; i < texture_side * texture_side; ++i) texels.push_back(0xff000000U | i);
    }
    TexelRows rows() const { return {texels.data(), texture_side, texture_side, 0}; }
};

/// Triangles with three equal sides, `across` pixels from the leftmost to the rightmost of their circle, anyhow turned.
std::vector<TexturedCorner> triangles(double across, bool perspective) {
    base::Random random(5);
    std::vector<TexturedCorner> corners;
    const double radius = across / 2, area = 0.75 * std::sqrt(3.0) * radius * radius;
    const auto count = static_cast<std::size_t>(pixels_a_run / area) + 1;
    for (std::size_t k = 0; k < count; ++k) {
        const double x = random.uniform(radius, side - radius), y = random.uniform(radius, side - radius);
        const double turn = random.uniform(0, 6.28318530717958648), start = random.unit();
        for (int i = 0; i < 3; ++i) {
            const double a = turn + 2.09439510239319549 * i;
            const double w = perspective ? random.uniform(1, 4) : 1;
            // About a texel a pixel, or the whole texture.
            const double part = std::min(1.0, across / texture_side), at = (1 - part) * start;
            const double u = at + (i == 1 ? part : 0), v = at + (i == 2 ? part : 0);
            corners.push_back({x + radius * std::cos(a), y + radius * std::sin(a), w, u, v});
        }
    }
    return corners;
}

std::size_t area_of(const std::vector<TexturedCorner>& c) {
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

/// The largest distance, in texels, between the texel drawn and the exact texture coordinates (of plain double
/// arithmetic, whose error is far below), over the pixels of single triangles.
double largest_error(const std::vector<TexturedCorner>& corners, bool perspective) {
    Picture picture;
    const Texels texels;
    double largest = 0;
    std::vector<PixelSpan> spans;
    for (std::size_t k = 0; k < std::min<std::size_t>(corners.size(), 600); k += 3) {
        const TexturedCorner* const c = corners.data() + k;
        const double v[6] = {c[0].x, c[0].y, c[1].x, c[1].y, c[2].x, c[2].y};
        spans.clear();
        (void)cover_triangle({side, side}, v, spans);
        std::fill(picture.pixels.begin(), picture.pixels.end(), 0U);
        const std::size_t drawn = raster::draw_textured(picture.rows(), texels.rows(), {c, 3}, perspective);
        std::size_t expected = 0;
        for (const PixelSpan& s : spans) {
            for (std::int32_t i = s.begin; i < s.end; ++i) {
                const std::uint32_t pixel =
                    picture.pixels[static_cast<std::size_t>(s.row) * side + static_cast<std::size_t>(i)];
                if (pixel == 0) {
                    std::fprintf(stderr, "wrong: a covered pixel was not drawn\n");
                    std::exit(1);
                }
                ++expected;
                const double x = i + 0.5, y = s.row + 0.5;
                double w[3], sum = 0;
                for (int n = 0; n < 3; ++n) {
                    const auto &p = c[(n + 1) % 3], &q = c[(n + 2) % 3];
                    w[n] = ((p.x - x) * (q.y - y) - (q.x - x) * (p.y - y)) / (perspective ? c[n].w : 1);
                    sum += w[n];
                }
                double at[2] = {0, 0};
                for (int n = 0; n < 3; ++n) {
                    at[0] += w[n] / sum * c[n].u * texture_side;
                    at[1] += w[n] / sum * c[n].v * texture_side;
                }
                const std::uint32_t index = pixel & 0xffffffU;
                const double found[2] = {static_cast<double>(index % texture_side),
                                         static_cast<double>(index / texture_side)};
                for (int n = 0; n < 2; ++n) largest = std::max({largest, found[n] - at[n], at[n] - (found[n] + 1)});
            }
        }
        const auto all = static_cast<std::size_t>(
            std::count_if(picture.pixels.begin(), picture.pixels.end(), [](std::uint32_t p) { return p != 0; }));
        if (drawn != expected || all != expected) {
            std::fprintf(stderr, "wrong: %zu pixels drawn, %zu set, %zu covered\n", drawn, all, expected);
            std::exit(1);
        }
    }
    return largest;
}

}  // namespace

int main() {
    const bench::Table table;
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
            "affine", pixels, [&] { raster::draw_textured(picture.rows(), texels.rows(), flat, false); }, false);
        row(
            "perspective", deep_pixels, [&] { raster::draw_textured(picture.rows(), texels.rows(), deep, true); },
            false);
        char title[100];
        std::snprintf(title, sizeof title, "triangles %g pixels across, ns a pixel", across);
        table.run(title, rows, repetitions);
        table.demand(rows, {"scanline / affine", 1, 2, 8});
        table.demand(rows, {"perspective / affine", 3, 2, 1.5, true});
    }
}
