#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "barycert/base/arena.hpp"
#include "barycert/base/text.hpp"
#include "barycert/core/blocks.hpp"
#include "barycert/environment.hpp"
#include "barycert/mesh/consistency.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface/levels.hpp"
#include "barycert/surface/parts.hpp"

namespace barycert::surface {
namespace {

/// What nodes have and points are to get: coordinates, or a field.
struct Carried {
    const double* from;
    double* to;
    std::size_t components;
};

std::vector<Carried> carried_by(const Mesh& mesh, const CutOptions& options, Surface& surface) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const std::size_t points = surface.mesh_edges.size() / 2;
    base::resize_large(surface.points, d * points);
    std::vector<Carried> columns{{mesh.points.data(), surface.points.data(), d}};
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
    PointBlock(const Level& level, const Surface& surface, const std::vector<Carried>& columns)
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
                for_numbers([&](std::size_t, const Carried& column, std::size_t c) {
                    // + 0: an exact zero is positive.
                    column.to[column.components * v + c] = from(column, edge.in, c) + 0.0;
                });
                continue;
            }
            level_.gather(edge, size, arrays_.data());
            for_numbers([&](std::size_t number, const Carried& column, std::size_t c) {
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
            for_numbers([&](std::size_t number, const Carried& column, std::size_t c) {
                column.to[column.components * point_[j] + c] = out_[components * j + number];
            });
        }
    }

private:
    static std::size_t count(const std::vector<Carried>& columns) {
        std::size_t sum = 0;
        for (const Carried& column : columns) sum += column.components;
        return sum;
    }

    /// f(number, column, component of it) for all numbers of a point.
    template <class F>
    void for_numbers(F&& f) const {
        std::size_t number = 0;
        for (const Carried& column : columns_) {
            for (std::size_t c = 0; c < column.components; ++c) f(number++, column, c);
        }
    }

    static double from(const Carried& column, Mesh::Index node, std::size_t c) {
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
    const std::vector<Carried>& columns_;
    core::LaneArrays arrays_;
    std::vector<double> out_;
    std::array<Edge, core::block_size> edge_{};
    std::array<std::size_t, core::block_size> point_{};
    std::array<std::uint32_t, core::block_size> undecided_{};
};

/// Sets coordinates and fields of nodes from mesh_edges. On all threads of the calling arena.
template <class Level>
TierCounts place_points(const Mesh& mesh, const Level& level, const CutOptions& options, Surface& surface) {
    const std::vector<Carried> columns = carried_by(mesh, options, surface);
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

template <class Level>
Result<Cut> cut_at(const Mesh& mesh, const Level& level, const CutOptions& options) {
    std::vector<std::uint8_t> states(mesh.point_count());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, states.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) states[i] = level.state(i);
    });
    Cut cut;
    if (Status done = cut_cells(mesh, states, cut.surface, cut.counts); !done) return done.error();
    cut.counts.tiers = place_points(mesh, level, options, cut.surface);
    carry_cell_fields(options, cut.surface);
    cut.counts.second_order = mesh.mid_nodes.empty() ? 0 : mesh.cell_count();
    return cut;
}

Result<Cut> cut_field(int dimension, const Mesh& mesh, const Field& field, double value, const CutOptions& options,
                      int component) {
    const ExactEnvironment environment;
    if (Status fits = mesh::check_field(&field, mesh.point_count(), "node"); !fits) return fits.error();
    if (component < 0 || component >= field.components)
        return Error{.what = "no such component of field \"" + field.name + '"',
                     .expected = "0 to " + std::to_string(field.components - 1),
                     .found = std::to_string(component)};
    if (!std::isfinite(value))
        return Error{.what = "the value to cut at", .expected = "a finite number", .found = base::shortest(value)};
    return base::in_arena(options.threads, mesh.cells.size(), [&]() -> Result<Cut> {
        if (Status good = check_mesh(mesh, dimension); !good) return good.error();
        if (Status fit = check_options(mesh, options); !fit) return fit.error();
        return cut_at(mesh, FieldLevel(field, component, value), options);
    });
}

}  // namespace
}  // namespace barycert::surface

namespace barycert {

Result<Cut> isosurface(const Mesh& mesh, const Field& field, double value, const CutOptions& options, int component) {
    return surface::cut_field(3, mesh, field, value, options, component);
}

Result<Cut> isoline(const Mesh& mesh, const Field& field, double value, const CutOptions& options, int component) {
    return surface::cut_field(2, mesh, field, value, options, component);
}

Result<Cut> slice(const Mesh& mesh, const Plane& plane, const CutOptions& options) {
    const ExactEnvironment environment;
    bool finite = std::isfinite(plane.offset), zero = true;
    for (const double n : plane.normal) {
        finite = finite && std::isfinite(n);
        zero = zero && n == 0;
    }
    if (!finite || zero)
        return Error{.what = "the plane",
                     .expected = "four finite numbers, the normal not zero",
                     .found = base::shortest(plane.normal[0]) + ", " + base::shortest(plane.normal[1]) + ", " +
                              base::shortest(plane.normal[2]) + ", " + base::shortest(plane.offset)};
    return base::in_arena(options.threads, mesh.cells.size(), [&]() -> Result<Cut> {
        if (Status good = surface::check_mesh(mesh, 3); !good) return good.error();
        if (Status fit = surface::check_options(mesh, options); !fit) return fit.error();
        return surface::cut_at(mesh, surface::PlaneLevel(mesh, plane), options);
    });
}

}  // namespace barycert
