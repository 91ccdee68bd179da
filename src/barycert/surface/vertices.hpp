/// Coordinates and carried values at the points of a cut.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "barycert/base/large_pages.hpp"
#include "barycert/core/blocks.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface/levels.hpp"

namespace barycert::surface {

/// What nodes have and points are to get: coordinates, or a field.
struct Column {
    const double* from;
    double* to;
    std::size_t components;
};

inline std::vector<Column> columns_of(const Mesh& mesh, const CutOptions& options, Surface& surface) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const std::size_t points = surface.mesh_edges.size() / 2;
    base::resize_large(surface.points, d * points);
    std::vector<Column> columns{{mesh.points.data(), surface.points.data(), d}};
    surface.point_fields.reserve(options.point_fields.size());
    for (const Field* const field : options.point_fields) {
        Field& to = surface.point_fields.emplace_back(Field{field->name, field->components, {}});
        const auto components = static_cast<std::size_t>(field->components);
        base::resize_large(to.data, components * points);
        columns.push_back({field->data.data(), to.data.data(), components});
    }
    return columns;
}

/// Some points of a cut at a time, those on edges gathered for the lanes.
template <class Level>
class PointBlock {
public:
    PointBlock(const Level& level, const Surface& surface, const std::vector<Column>& columns)
        : level_(level),
          surface_(surface),
          columns_(columns),
          arrays_(Level::arrays + 2 * count(columns)),
          out_(count(columns) * core::block_size) {}

    /// Points [first, last), at most core::block_size of them.
    void place(std::size_t first, std::size_t last, TierCounts& tiers) {
        std::size_t size = 0;
        for (std::size_t v = first; v < last; ++v) {
            const Edge edge{surface_.mesh_edges[2 * v], surface_.mesh_edges[2 * v + 1]};
            if (edge.in == edge.out) {
                for_numbers([&](std::size_t, const Column& column, std::size_t c) {
                    // + 0: an exact zero is positive.
                    column.to[column.components * v + c] = from(column, edge.in, c) + 0.0;
                });
                continue;
            }
            level_.gather(edge, size, arrays_.data());
            for_numbers([&](std::size_t number, const Column& column, std::size_t c) {
                ends(number)[0][size] = from(column, edge.in, c);
                ends(number)[1][size] = from(column, edge.out, c);
            });
            edge_[size] = edge;
            point_[size++] = v;
        }
        const std::size_t components = out_.size() / core::block_size;
        const EdgeBlock block{ends(0), static_cast<int>(components), size};
        const std::size_t undecided = level_.lanes(arrays_.data(), block, out_.data(), undecided_.data());
        for (std::size_t i = 0; i < undecided; ++i) {
            if (!place_exactly(undecided_[i])) ++tiers.not_finite;
        }
        tiers.double_double += size - undecided;
        tiers.exact += undecided;
        for (std::size_t j = 0; j < size; ++j) {
            for_numbers([&](std::size_t number, const Column& column, std::size_t c) {
                column.to[column.components * point_[j] + c] = out_[components * j + number];
            });
        }
    }

private:
    static std::size_t count(const std::vector<Column>& columns) {
        std::size_t sum = 0;
        for (const Column& column : columns) sum += column.components;
        return sum;
    }

    /// f(number, column, component of it) for all numbers of a point.
    template <class F>
    void for_numbers(F&& f) const {
        std::size_t number = 0;
        for (const Column& column : columns_) {
            for (std::size_t c = 0; c < column.components; ++c) f(number++, column, c);
        }
    }

    static double from(const Column& column, Mesh::Index node, std::size_t c) {
        return column.from[column.components * static_cast<std::size_t>(node) + c];
    }

    double* const* ends(std::size_t number) const { return arrays_.data() + Level::arrays + 2 * number; }

    bool place_exactly(std::size_t j) {
        const ExactCrossing crossing = level_.exact(edge_[j]);
        const std::size_t components = out_.size() / core::block_size;
        bool finite = true;
        for (std::size_t number = 0; number < components; ++number) {
            const double in = ends(number)[0][j], out = ends(number)[1][j];
            const bool both = std::isfinite(in) && std::isfinite(out);
            finite = finite && both;
            out_[components * j + number] = both ? crossing.value(in, out) : std::numeric_limits<double>::quiet_NaN();
        }
        return finite;
    }

    const Level& level_;
    const Surface& surface_;
    const std::vector<Column>& columns_;
    core::LaneArrays arrays_;
    std::vector<double> out_;
    std::array<Edge, core::block_size> edge_{};
    std::array<std::size_t, core::block_size> point_{};
    std::array<std::uint32_t, core::block_size> undecided_{};
};

/// Sets coordinates and fields of nodes from mesh_edges. On all threads of the calling arena.
template <class Level>
TierCounts place_points(const Mesh& mesh, const Level& level, const CutOptions& options, Surface& surface) {
    const std::vector<Column> columns = columns_of(mesh, options, surface);
    const std::size_t points = surface.mesh_edges.size() / 2;
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, points, 16 * core::block_size), TierCounts{},
        [&](const tbb::blocked_range<std::size_t>& range, TierCounts tiers) {
            PointBlock<Level> block(level, surface, columns);
            for (std::size_t first = range.begin(); first < range.end(); first += core::block_size)
                block.place(first, std::min(first + core::block_size, range.end()), tiers);
            return tiers;
        },
        [](TierCounts a, const TierCounts& b) {
            a.add(b);
            return a;
        });
}

}  // namespace barycert::surface
