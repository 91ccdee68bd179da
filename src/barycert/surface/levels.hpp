/// The functions g whose sign says which nodes are in the set: a field less a value, a plane's offset less n.x. Both
/// give the state of a node, the crossings of edges on lanes, and the exact crossing of one edge.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "barycert/core/integer.hpp"
#include "barycert/mesh.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface/cell_cases.hpp"

namespace barycert::surface {

// The middle tier of crossings, on SIMD lanes, dispatched at run time as those of core/lanes.hpp.

/// Crossings of edges: values[2 c + i][j] is number c at the end of edge j that is in the set (i = 0), or that is not
/// (i = 1). out[components * j + c] is number c where g is zero, correctly rounded where that is certain. Each returns
/// how many edges are undecided, their numbers, ascending, in undecided[0 ...], which has room for `count`.
struct EdgeBlock {
    const double* const* values;
    int components;
    std::size_t count;  ///< any; below 2^32
};

/// g = f - value; f[i][j] is the field at end i of edge j.
std::size_t level_lanes(double value, const double* const* f, const EdgeBlock& edges, double* out,
                        std::uint32_t* undecided);

/// g = offset - normal.x; the first three numbers are the coordinates.
std::size_t plane_lanes(const Plane& plane, const EdgeBlock& edges, double* out, std::uint32_t* undecided);

/// An edge with an end `in` of the set and an end `out` outside.
struct Edge {
    Mesh::Index in = 0, out = 0;
};

/// g(in) >= 0 and -g(out) > 0 as integers in one unit.
class ExactCrossing {
public:
    /// Of the field with these values at the ends.
    ExactCrossing(double in, double out, double value);

    /// Of the plane, with the ends at these points.
    ExactCrossing(const Plane& plane, const double* in, const double* out);

    /// The number that is `in` and `out` at the ends, where g is zero, correctly rounded. Precondition: finite numbers.
    double value(double in, double out) const;

private:
    core::Integer in_, out_;
};

class FieldLevel {
public:
    FieldLevel(const Field& field, int component, double value)
        : data_(field.data.data() + component), stride_(static_cast<std::size_t>(field.components)), value_(value) {}

    State state(std::size_t node) const {
        const double f = at(node);
        return f < value_         ? (std::isinf(f) ? unknown : outside)
               : f == value_      ? on
               : std::isfinite(f) ? inside
                                  : unknown;
    }

    /// Arrays that lanes need besides the numbers to interpolate.
    static constexpr std::size_t arrays = 2;
    void gather(const Edge& edge, std::size_t j, double* const* to) const {
        to[0][j] = at(static_cast<std::size_t>(edge.in));
        to[1][j] = at(static_cast<std::size_t>(edge.out));
    }
    std::size_t lanes(const double* const* own, const EdgeBlock& edges, double* out, std::uint32_t* undecided) const {
        return level_lanes(value_, own, edges, out, undecided);
    }
    ExactCrossing exact(const Edge& edge) const {
        return {at(static_cast<std::size_t>(edge.in)), at(static_cast<std::size_t>(edge.out)), value_};
    }

private:
    double at(std::size_t node) const { return data_[stride_ * node]; }

    const double* data_;
    std::size_t stride_;
    double value_;
};

class PlaneLevel {
public:
    PlaneLevel(const Mesh& mesh, const Plane& plane) : points_(mesh.points.data()), plane_(plane) {}

    State state(std::size_t node) const;

    static constexpr std::size_t arrays = 0;
    void gather(const Edge&, std::size_t, double* const*) const {}
    std::size_t lanes(const double* const*, const EdgeBlock& edges, double* out, std::uint32_t* undecided) const {
        return plane_lanes(plane_, edges, out, undecided);
    }
    ExactCrossing exact(const Edge& edge) const {
        return {plane_, points_ + 3 * static_cast<std::size_t>(edge.in),
                points_ + 3 * static_cast<std::size_t>(edge.out)};
    }

private:
    const double* points_;
    Plane plane_;
};

}  // namespace barycert::surface
