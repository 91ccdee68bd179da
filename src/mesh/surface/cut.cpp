#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/surface.hpp"
#include "core/base/finite.hpp"
#include "core/base/large_pages.hpp"
#include "core/base/strict_math.hpp"
#include "core/base/text.hpp"
#include "core/blocks.hpp"
#include "core/exact_tier.hpp"
#include "core/integer.hpp"
#include "core/scaled_double.hpp"
#include "mesh/consistency.hpp"
#include "mesh/surface/cell_cases.hpp"
#include "mesh/surface/parts.hpp"

namespace barycert::surface {
namespace {

using core::Integer;
using core::Unit;

/// An edge with an end `in` of the set and an end `out` outside.
struct CrossedEdge {
    Mesh::Index in = 0, out = 0;
};

/// g(in) >= 0 and -g(out) > 0 as integers in one unit.
struct ExactCrossing {
    Integer of_in, of_out;

    /// The number that is `in` and `out` at the ends, where g is zero, correctly rounded. Requires: finite numbers.
    double value(double in, double out) const {
        // The weights of the ends are of_out / (of_in + of_out) and of_in / (of_in + of_out).
        const Unit unit{in, out};
        const Integer sum = of_out * unit.integer(in) + of_in * unit.integer(out);
        return core::round_quotient(sum, of_in + of_out, unit.exponent - 1074);
    }
};

// The functions g whose sign says which nodes are in the set: a field less a value, a plane's offset less n.x. Both
// give the state of a node, the crossings of edges on lanes, and the exact crossing of one edge.

class FieldLevel {
public:
    FieldLevel(const Field& field, int component, double value)
        : data_(field.data.data() + component), stride_(static_cast<std::size_t>(field.components)), value_(value) {}

    State state(std::size_t node) const {
        const double f = data_[stride_ * node];
        // One branch, for nodes may come in any order.
        if (std::isfinite(f) && f != value_) [[likely]]
            return static_cast<State>(f > value_);
        return f == value_ ? on : unknown;
    }

    /// Arrays that lanes need besides the numbers to interpolate.
    static constexpr std::size_t arrays = 2;
    void gather(const CrossedEdge& edge, std::size_t j, double* const* to) const {
        to[0][j] = at(edge.in);
        to[1][j] = at(edge.out);
    }
    std::size_t lanes(const double* const* own, const EdgeBlock& edges, double* out, std::uint32_t* undecided) const {
        return level_lanes(value_, own, edges, out, undecided);
    }
    ExactCrossing exact(const CrossedEdge& edge) const {
        const Unit unit{at(edge.in), at(edge.out), value_};
        const Integer level = unit.integer(value_);
        return {unit.integer(at(edge.in)) - level, level - unit.integer(at(edge.out))};
    }

private:
    double at(Mesh::Index node) const { return data_[stride_ * static_cast<std::size_t>(node)]; }

    const double* data_;
    std::size_t stride_;
    double value_;
};

class PlaneLevel {
public:
    PlaneLevel(const Mesh& mesh, const Plane& plane) : points_(mesh.points.data()), plane_(plane) {}

    State state(std::size_t node) const {
        // Three products and three sums, each rounded by u of at most M (1 + 4 u), M the sum of the magnitudes of the
        // terms: an error of 4 u M and a little. Underflow loses 2^-1075 a product, and as much in the bound.
        // Comparisons with infinity or NaN are false.
        const double* const x = points_ + 3 * node;
        double height = plane_.offset, magnitude = std::fabs(plane_.offset);
        for (std::size_t k = 0; k < 3; ++k) {
            const double product = plane_.normal[k] * x[k];
            height -= product;
            magnitude += std::fabs(product);
        }
        const double bound = 4.5 * 0x1p-53 * magnitude + 0x1p-1070;
        // One branch, for nodes may come in any order.
        if (std::fabs(height) > bound) [[likely]]
            return static_cast<State>(height > 0);
        const int sign = exact_height(x, Unit{1, x[0], x[1], x[2]}).sign();
        return sign > 0 ? inside : sign < 0 ? outside : on;
    }

    static constexpr std::size_t arrays = 0;
    void gather(const CrossedEdge&, std::size_t, double* const*) const {}
    std::size_t lanes(const double* const*, const EdgeBlock& edges, double* out, std::uint32_t* undecided) const {
        return plane_lanes(plane_, edges, out, undecided);
    }
    ExactCrossing exact(const CrossedEdge& edge) const {
        const double* const in = points_ + 3 * static_cast<std::size_t>(edge.in);
        const double* const out = points_ + 3 * static_cast<std::size_t>(edge.out);
        const Unit of_points{1, in[0], in[1], in[2], out[0], out[1], out[2]};
        return {exact_height(in, of_points), Integer() - exact_height(out, of_points)};
    }

private:
    /// offset - normal.x in units that depend on the plane and on `of_points` alone.
    Integer exact_height(const double* x, const Unit& of_points) const {
        const auto& [normal, offset] = plane_;
        const Unit of_plane{offset, normal[0], normal[1], normal[2]};
        Integer sum = of_plane.integer(offset) * of_points.integer(1);
        for (std::size_t k = 0; k < 3; ++k) sum = sum - of_plane.integer(normal[k]) * of_points.integer(x[k]);
        return sum;
    }

    const double* points_;
    Plane plane_;
};

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
        : level_(level), surface_(surface), carried_(carried), out_(carried.size() * core::block_size) {}

    /// Points [first, last), at most core::block_size of them.
    void place(std::size_t first, std::size_t last, TierCounts& tiers) {
        std::size_t size = 0;
        for (std::size_t v = first; v < last; ++v) {
            const CrossedEdge edge{surface_.mesh_edges[2 * v], surface_.mesh_edges[2 * v + 1]};
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
    core::LaneArrays arrays_{Level::arrays + 2 * carried_.size()};
    std::vector<double> out_;
    std::array<CrossedEdge, core::block_size> edge_{};
    std::array<std::size_t, core::block_size> point_{};
    std::array<std::uint32_t, core::block_size> undecided_{};
};

/// Sets coordinates and fields of nodes from mesh_edges. On all threads of the calling arena.
template <class Level>
TierCounts place_points(const Mesh& mesh, const Level& level, const CutOptions& options, Surface& surface) {
    const std::vector<Carried> carried = carried_by(mesh, options, surface);
    const std::size_t points = surface.mesh_edges.size() / 2;
    return base::parallel_reduce(
        points, 16 * core::block_size, TierCounts{},
        [&](std::size_t begin, std::size_t end, TierCounts& tiers) {
            PointBlock<Level> block(level, surface, carried);
            for (std::size_t first = begin; first < end; first += core::block_size)
                block.place(first, std::min(first + core::block_size, end), tiers);
        },
        [](TierCounts& all, const TierCounts& part) { all.add(part); });
}

template <class Level>
States states_of(const Mesh& mesh, const Level& level) {
    constexpr std::size_t word = 64;
    const std::size_t nodes = mesh.point_count();
    States states{std::vector<std::uint8_t>(nodes), std::vector<std::uint64_t>((nodes + word - 1) / word)};
    std::atomic<bool> all_known{true};
    base::parallel_for(states.in_set.size(), grain / word, [&](std::size_t begin, std::size_t end) {
        bool known = true;
        for (std::size_t w = begin; w < end; ++w) {
            std::uint64_t bits = 0;
            for (std::size_t i = word * w; i < std::min(nodes, word * (w + 1)); ++i) {
                const State state = level.state(i);
                states.of[i] = state;
                bits |= static_cast<std::uint64_t>(state & 1) << (i % word);
                known &= state != unknown;
            }
            states.in_set[w] = bits;
        }
        if (!known) all_known = false;
    });
    states.all_known = all_known;
    return states;
}

template <class Level>
Result<Cut> cut_at(const Mesh& mesh, const Level& level, const CutOptions& options, bool ends = false) {
    Cut cut;
    const States states = states_of(mesh, level);
    if (Status done = cut_cells(mesh, states, ends, cut.surface, cut.counts); !done) return done.error();
    cut.counts.tiers = place_points(mesh, level, options, cut.surface);
    take_rows(options.cell_fields, cut.surface.mesh_cells, 1, cut.surface.cell_fields);
    cut.counts.second_order = mesh.mid_nodes.empty() ? 0 : mesh.cell_count();
    return cut;
}

Result<Cut> cut_field(int dimension, const Mesh& mesh, const Field& field, double value, const CutOptions& options,
                      int component) {
    if (Status fits = mesh::check_field(&field, mesh.point_count(), "node"); !fits) return fits.error();
    if (component < 0 || component >= field.components)
        return file_error("field.component", {}, "no such component of field \"" + field.name + '"',
                          "0 to " + std::to_string(field.components - 1), std::to_string(component));
    if (!std::isfinite(value))
        return Error{.code = "argument.not-finite",
                     .what = "the value to cut at",
                     .expected = "a finite number",
                     .found = base::shortest(value)};
    return on_good_input(mesh, dimension, options,
                         [&] { return cut_at(mesh, FieldLevel(field, component, value), options); });
}

Result<Cut> cut_plane(const Mesh& mesh, const Plane& plane, const CutOptions& options, bool ends) {
    const ExactEnvironment environment;
    const auto& n = plane.normal;
    if (!std::isfinite(plane.offset) || !base::all_finite(n) || (n[0] == 0 && n[1] == 0 && n[2] == 0))
        return file_error("argument.value", {}, "the plane", "four finite numbers, the normal not zero",
                          base::joined(std::array{n[0], n[1], n[2], plane.offset}, ", ", base::shortest));
    return on_good_input(mesh, 3, options, [&] { return cut_at(mesh, PlaneLevel(mesh, plane), options, ends); });
}

}  // namespace
}  // namespace barycert::surface

namespace barycert {

Plane plane_through(const std::array<double, 3>& point, const std::array<double, 3>& normal) {
    return {normal, core::exact_dot(normal.data(), point.data(), 3)};
}

Result<Cut> isosurface(const Mesh& mesh, const Field& field, double value, const CutOptions& options, int component) {
    return surface::cut_field(3, mesh, field, value, options, component);
}

Result<Cut> isoline(const Mesh& mesh, const Field& field, double value, const CutOptions& options, int component) {
    return surface::cut_field(2, mesh, field, value, options, component);
}

Result<Cut> slice(const Mesh& mesh, const Plane& plane, const CutOptions& options) {
    return surface::cut_plane(mesh, plane, options, false);
}

Result<Cut> surface::section(const Mesh& mesh, const Plane& plane, const CutOptions& options) {
    return cut_plane(mesh, plane, options, true);
}

}  // namespace barycert
