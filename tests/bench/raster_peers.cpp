#include "raster_peers.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace barycert::bench {
namespace {

/// u and v in units of texels, clamped.
std::uint32_t texel(const TexelRows& texture, double u, double v) {
    const int i = std::min(std::max(static_cast<int>(u), 0), texture.width - 1);
    const int j = std::min(std::max(static_cast<int>(v), 0), texture.height - 1);
    return texture.texels[j * texture.width + i];
}

int clamped(double x, int limit) {
    return std::min(std::max(static_cast<int>(x), 0), limit);
}

std::size_t barycentric_triangle(const PixelRows& out, const TexelRows& texture, const TexturedVertex* c) {
    const TexturedVertex &a = c[0], &b = c[1], &d = c[2];
    const double area = (b.x - a.x) * (d.y - a.y) - (d.x - a.x) * (b.y - a.y);
    if (area == 0) return 0;
    const int x0 = clamped(std::floor(std::min({a.x, b.x, d.x})), out.width);
    const int x1 = clamped(std::ceil(std::max({a.x, b.x, d.x})), out.width);
    const int y0 = clamped(std::floor(std::min({a.y, b.y, d.y})), out.height);
    const int y1 = clamped(std::ceil(std::max({a.y, b.y, d.y})), out.height);
    std::size_t count = 0;
    for (int j = y0; j < y1; ++j) {
        for (int i = x0; i < x1; ++i) {
            const double x = i + 0.5, y = j + 0.5;
            const double wa = ((b.x - x) * (d.y - y) - (d.x - x) * (b.y - y)) / area;
            const double wb = ((d.x - x) * (a.y - y) - (a.x - x) * (d.y - y)) / area;
            const double wd = 1 - wa - wb;
            if (wa < 0 || wb < 0 || wd < 0) continue;
            const double u = wa * a.u + wb * b.u + wd * d.u, v = wa * a.v + wb * b.v + wd * d.v;
            out.pixels[j * out.width + i] = texel(texture, u * texture.width, v * texture.height);
            ++count;
        }
    }
    return count;
}

/// A side, followed upwards: position and texture coordinates in units of texels, and their steps from row to row.
struct Side {
    double x, u, v, x_step, u_step, v_step;

    Side(const TexelRows& texture, const TexturedVertex& a, const TexturedVertex& b, double y) {
        const double dy = b.y - a.y, start = y - a.y;
        x_step = (b.x - a.x) / dy;
        u_step = (b.u - a.u) * texture.width / dy;
        v_step = (b.v - a.v) * texture.height / dy;
        x = a.x + start * x_step;
        u = a.u * texture.width + start * u_step;
        v = a.v * texture.height + start * v_step;
    }
    void step() {
        x += x_step;
        u += u_step;
        v += v_step;
    }
};

std::size_t rows_between(const PixelRows& out, const TexelRows& texture, Side& p, Side& q, int from, int to) {
    std::size_t count = 0;
    for (int j = from; j < to; ++j) {
        const Side &l = p.x <= q.x ? p : q, &r = p.x <= q.x ? q : p;
        const int first = clamped(std::ceil(l.x - 0.5), out.width), last = clamped(std::ceil(r.x - 0.5), out.width);
        if (first < last) {
            const double u_step = (r.u - l.u) / (r.x - l.x), v_step = (r.v - l.v) / (r.x - l.x);
            double u = l.u + (first + 0.5 - l.x) * u_step, v = l.v + (first + 0.5 - l.x) * v_step;
            std::uint32_t* const row = out.pixels + j * out.width;
            for (int i = first; i < last; ++i) {
                row[i] = texel(texture, u, v);
                u += u_step;
                v += v_step;
            }
            count += static_cast<std::size_t>(last - first);
        }
        p.step();
        q.step();
    }
    return count;
}

std::size_t scanline_triangle(const PixelRows& out, const TexelRows& texture, const TexturedVertex* c) {
    const TexturedVertex *a = c, *b = c + 1, *d = c + 2;
    if (b->y < a->y) std::swap(a, b);
    if (d->y < b->y) std::swap(b, d);
    if (b->y < a->y) std::swap(a, b);
    const int y0 = clamped(std::ceil(a->y - 0.5), out.height), y1 = clamped(std::ceil(b->y - 0.5), out.height),
              y2 = clamped(std::ceil(d->y - 0.5), out.height);
    if (y0 == y2) return 0;
    Side whole(texture, *a, *d, y0 + 0.5);
    std::size_t count = 0;
    if (y0 < y1) {
        Side lower(texture, *a, *b, y0 + 0.5);
        count += rows_between(out, texture, whole, lower, y0, y1);
    }
    if (y1 < y2) {
        Side upper(texture, *b, *d, y1 + 0.5);
        count += rows_between(out, texture, whole, upper, y1, y2);
    }
    return count;
}

}  // namespace

std::size_t barycentric_loop(const PixelRows& out, const TexelRows& texture, std::span<const TexturedVertex> corners) {
    std::size_t count = 0;
    for (std::size_t k = 0; k + 3 <= corners.size(); k += 3)
        count += barycentric_triangle(out, texture, corners.data() + k);
    return count;
}

std::size_t scanline_loop(const PixelRows& out, const TexelRows& texture, std::span<const TexturedVertex> corners) {
    std::size_t count = 0;
    for (std::size_t k = 0; k + 3 <= corners.size(); k += 3)
        count += scanline_triangle(out, texture, corners.data() + k);
    return count;
}

}  // namespace barycert::bench
