#include "draw/raster/parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "barycert/predicates.hpp"
#include "barycert/raster.hpp"
#include "barycert/scene.hpp"
#include "barycert/weights.hpp"
#include "core/base/strict_math.hpp"
#include "draw/raster/layers.hpp"

namespace barycert::raster {

void Clipper::add(std::size_t triangle) {
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
        Primitive& part = to_.all.emplace_back();
        part.source = static_cast<std::uint32_t>(triangle);
        part.clipped = clip == Clip::cut;
        const std::size_t fan[3] = {0, i, i + 1};
        for (std::size_t k = 0; k < 3; ++k) {
            const double* const row = polygon_.data() + stride * fan[k];
            std::copy_n(window_[fan[k]].data(), 2, &part.window[2 * k]);
            part.z[k] = row[2] / row[3];
            part.w[k] = row[3];
            part.rows[k] =
                part.clipped ? first + static_cast<std::uint32_t>(fan[k]) : static_cast<std::uint32_t>(corners[fan[k]]);
        }
    }
    if (!area) ++to_.counts.degenerate;
}

void add_line(const Layers& layers, std::size_t index, RasterSize samples, std::vector<Primitive>& to) {
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
        Primitive part{};
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

}  // namespace barycert::raster
