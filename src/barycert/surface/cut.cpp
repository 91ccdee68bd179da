#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "barycert/base/large_pages.hpp"
#include "barycert/base/text.hpp"
#include "barycert/core/blocks.hpp"
#include "barycert/mesh/consistency.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface/levels.hpp"
#include "barycert/surface/parts.hpp"

namespace barycert::surface {
namespace {

/// A number that nodes have and points are to get: a coordinate, or a component of a field.
struct Carried {
    const double* from;
    double* to;
    std::size_t stride;

    double at(Mesh::Index node) const { return from[stride * static_cast<std::size_t>(node)]; }
};

std::vector<Carried> carried_by(const Mesh& mesh, const CutOptions& options, Surface& surface) {
    std::vector<Carried> all;
    const auto add = [&](const std::vector<double>& from, std::vector<double>& to, int components) {
        const auto stride = static_cast<std::size_t>(components);
        base::resize_large(to, stride * (surface.mesh_edges.size() / 2));
        for (std::size_t c = 0; c < stride; ++c) all.push_back({from.data() + c, to.data() + c, stride});
    };
    add(mesh.points, surface.points, mesh.dimension);
    for (const Field* const field : options.point_fields) {
        surface.point_fields.push_back({field->name, field->components, {}});
        add(field->data, surface.point_fields.back().data, field->components);
    }
    return all;
}

/// Some points of a cut at a time, those on edges gathered for the lanes.
template <class Level>
class PointBlock {
public:
    PointBlock(const Level& level, const Surface& surface, const std::vector<Carried>& carried)
        : level_(level),
          surface_(surface),
          carried_(carried),
          arrays_(Level::arrays + 2 * carried.size()),
          out_(carried.size() * core::block_size) {}

    /// Points [first, last), at most core::block_size of them.
    void place(std::size_t first, std::size_t last, TierCounts& tiers) {
        std::size_t size = 0;
        for (std::size_t v = first; v < last; ++v) {
            const Edge edge{surface_.mesh_edges[2 * v], surface_.mesh_edges[2 * v + 1]};
            if (edge.in == edge.out) {
                for (const Carried& c : carried_)
                    c.to[c.stride * v] = c.at(edge.in) + 0.0;  // an exact zero is positive
                continue;
            }
            level_.gather(edge, size, arrays_.data());
            for (std::size_t k = 0; k < carried_.size(); ++k) {
                ends(k)[0][size] = carried_[k].at(edge.in);
                ends(k)[1][size] = carried_[k].at(edge.out);
            }
            edge_[size] = edge;
            point_[size++] = v;
        }
        const EdgeBlock block{ends(0), static_cast<int>(carried_.size()), size};
        const std::size_t undecided = level_.lanes(arrays_.data(), block, out_.data(), undecided_.data());
        for (std::size_t i = 0; i < undecided; ++i) {
            if (!place_exactly(undecided_[i])) ++tiers.not_finite;
        }
        tiers.double_double += size - undecided;
        tiers.exact += undecided;
        for (std::size_t j = 0; j < size; ++j) {
            for (std::size_t k = 0; k < carried_.size(); ++k)
                carried_[k].to[carried_[k].stride * point_[j]] = out_[carried_.size() * j + k];
        }
    }

private:
    double* const* ends(std::size_t number) const { return arrays_.data() + Level::arrays + 2 * number; }

    bool place_exactly(std::size_t j) {
        const ExactCrossing crossing = level_.exact(edge_[j]);
        bool finite = true;
        for (std::size_t k = 0; k < carried_.size(); ++k) {
            const double in = ends(k)[0][j], out = ends(k)[1][j];
            const bool both = std::isfinite(in) && std::isfinite(out);
            finite = finite && both;
            out_[carried_.size() * j + k] = both ? crossing.value(in, out) : std::numeric_limits<double>::quiet_NaN();
        }
        return finite;
    }

    const Level& level_;
    const Surface& surface_;
    const std::vector<Carried>& carried_;
    core::LaneArrays arrays_;
    std::vector<double> out_;
    std::array<Edge, core::block_size> edge_{};
    std::array<std::size_t, core::block_size> point_{};
    std::array<std::uint32_t, core::block_size> undecided_{};
};

/// Sets coordinates and fields of nodes from mesh_edges. On all threads of the calling arena.
template <class Level>
TierCounts place_points(const Mesh& mesh, const Level& level, const CutOptions& options, Surface& surface) {
    const std::vector<Carried> carried = carried_by(mesh, options, surface);
    const std::size_t points = surface.mesh_edges.size() / 2;
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, points, 16 * core::block_size), TierCounts{},
        [&](const tbb::blocked_range<std::size_t>& range, TierCounts tiers) {
            PointBlock<Level> block(level, surface, carried);
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
    for_ranges(states.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i != end; ++i) states[i] = level.state(i);
    });
    Cut cut;
    if (Status done = cut_cells(mesh, states, cut.surface, cut.counts); !done) return done.error();
    cut.counts.tiers = place_points(mesh, level, options, cut.surface);
    take_rows(options.cell_fields, cut.surface.mesh_cells, 1, cut.surface.cell_fields);
    cut.counts.second_order = mesh.mid_nodes.empty() ? 0 : mesh.cell_count();
    return cut;
}

Result<Cut> cut_field(int dimension, const Mesh& mesh, const Field& field, double value, const CutOptions& options,
                      int component) {
    if (Status fits = mesh::check_field(&field, mesh.point_count(), "node"); !fits) return fits.error();
    if (component < 0 || component >= field.components)
        return Error{.what = "no such component of field \"" + field.name + '"',
                     .expected = "0 to " + std::to_string(field.components - 1),
                     .found = std::to_string(component)};
    if (!std::isfinite(value))
        return Error{.what = "the value to cut at", .expected = "a finite number", .found = base::shortest(value)};
    return on_good_input(mesh, dimension, options,
                         [&] { return cut_at(mesh, FieldLevel(field, component, value), options); });
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
    const auto& n = plane.normal;
    const bool finite =
        std::isfinite(plane.offset) && std::isfinite(n[0]) && std::isfinite(n[1]) && std::isfinite(n[2]);
    if (!finite || (n[0] == 0 && n[1] == 0 && n[2] == 0))
        return Error{.what = "the plane",
                     .expected = "four finite numbers, the normal not zero",
                     .found = base::shortest(n[0]) + ", " + base::shortest(n[1]) + ", " + base::shortest(n[2]) + ", " +
                              base::shortest(plane.offset)};
    return surface::on_good_input(mesh, 3, options,
                                  [&] { return surface::cut_at(mesh, surface::PlaneLevel(mesh, plane), options); });
}

}  // namespace barycert
