/// Exact queries of points and segments to a surface of triangles in space.
///
/// Input: a Surface (read_surface), in any unit, and points in the same. Nodes at one place are one; a triangle of zero
/// area is the segment or point that it is. Output: on which triangle a point lies, or on which side; the nearest
/// triangle and point of it; where a segment or ray meets the surface.
///
/// Laws, for every finite point (each is a test of that name in tests/locate):
///   W1  A point that lies on a triangle is always found there, on its face, edge or vertex; of several triangles it is
///       the lowest.
///   W2  The winding number of every other point is exact: how many times the surface goes around the point. It is the
///       sum over shells (triangles connected over edges, without those that an edge of one triangle leaves open). Each
///       shell counts by the first of these rules that applies:
///       Turned::alike    each edge has as many triangles one way as the other: how many times the shell goes around
///                        the point, positive where normals (right hand) point away from it;
///       Turned::regions  the shell meets itself in common nodes and edges alone: 1 in the regions that it encloses, or
///                        -1 if normals of most of its triangles point into them. Triangles of the same nodes are one;
///       Turned::even     each edge has an even number of triangles: the parity, 0 or 1, of all such shells together;
///       Turned::open     any other shell is open: then no point has a winding number.
///       A point is inside if the sum is not 0.
///   N1  `nearest` is exact: no point of the surface is nearer than the one returned, and its triangle is the lowest
///       of all that have a point as near. Distance and coordinates are correctly rounded, and so are the weights of
///       the vertex, edge or face that the point lies on. A value of the surface there is the mean by these weights,
///       before they are rounded.
///   V1  `values` at nearest points are these means, computed exactly and rounded once to nearest, ties to even; those
///       beyond the doubles round to infinity. A value that is not finite counts only if its node has a weight.
///   H1  `hits` are all triangles that a segment meets, in their exact order along it, ties by triangle.
///   D1  Results depend on the points and the surface alone, not on threads, SIMD target or the order of points.
///
/// Example:
///
///     const Mesh mesh{.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, .cells = {0, 1, 2, 3}};
///     const Surface surface = boundary(mesh).value();
///     const SurfaceLocator locator = SurfaceLocator::build(surface).value();
///     const double point[] = {0.1, 0.1, 0.1};
///     const bool inside = locator.locate(point).value().winding != 0;
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/surface.hpp"

namespace barycert {

namespace locate {
struct SurfaceData;
}

/// Evidence that tells the two sides of a surface apart (W2): the weakest that one of its shells has.
enum class Turned : std::uint8_t {
    open,     ///< there is no inside
    even,     ///< parity
    regions,  ///< what is enclosed
    alike,    ///< winding numbers
};

/// How points inside are told from those outside.
struct SideRules {
    Turned turned = Turned::open;
    std::uint64_t by_regions = 0;  ///< triangles of shells that are told by Turned::regions
    std::uint64_t by_parity = 0;   ///< by Turned::even
    std::uint64_t idle = 0;        ///< triangles that count for nothing, as they enclose nothing
    Mesh::Index open = -1;         ///< the lowest triangle of a shell that is open; -1: there is none
};

struct SurfaceLocation {
    Mesh::Index triangle = -1;           ///< that holds the point; -1: none does
    Feature feature = Feature::outside;  ///< of the triangle; or `interior`, or `outside`
    int winding = 0;                     ///< W2, of a point on no triangle

    friend bool operator==(const SurfaceLocation&, const SurfaceLocation&) = default;
};

/// As Nearest, where `cell` is the triangle; `nodes` always has those of the vertex, edge or face.
struct SurfaceNearest : Nearest {
    std::array<double, 3> point{};    ///< the nearest point
    std::array<double, 3> weights{};  ///< of `nodes`
    bool on = false;                  ///< the point is exactly on the triangle; other distances may round to 0, too
};

/// A triangle that a segment meets.
struct SurfaceHit {
    Mesh::Index triangle = -1;
    /// The part of the triangle that is hit; `degenerate`: the segment lies in its plane, or along one of zero area.
    Feature feature = Feature::outside;
    double parameter = 0;  ///< 0 at the first end, 1 at the second; correctly rounded; of several the first
    int side = 0;  ///< 1 if it leaves on the side of the normal, -1 on the other, 0 in the plane or without a normal
};

/// Thread-safe.
class SurfaceLocator {
public:
    /// The surface must stay as it is and outlive the locator. Time O(n log n). Error: not triangles in space; an index
    /// that is no node; a coordinate that is not finite. Takes `threads` of the options.
    /// Without `flat`, triangles of zero area count for nothing.
    static Result<SurfaceLocator> build(const Surface& surface, const BuildOptions& options = {}, bool flat = true);
    static Result<SurfaceLocator> build(Surface&&, const BuildOptions& = {}, bool = true) = delete;

    const Surface& surface() const;
    const SideRules& sides() const;
    Turned turned() const { return sides().turned; }
    std::size_t bytes() const;  ///< of memory besides the surface

    /// Locates points by W1 and W2. For an open surface only W1 holds: points on no triangle are outside. Error: a
    /// coordinate is not finite.
    Result<SurfaceLocation> locate(const double* point) const;
    Status locate(std::span<const double> points, std::span<SurfaceLocation> found, int threads = 0) const;

    /// Returns the nearest point by N1, if the rounded distance is at most `limit`; otherwise cell -1, also if the
    /// limit is negative or NaN. Error: a coordinate is not finite.
    Result<SurfaceNearest> nearest(const double* point, double limit) const;
    Status nearest(std::span<const double> points, double limit, std::span<SurfaceNearest> found,
                   int threads = 0) const;

    /// Finds, by N1, the nearest point of one given triangle for each point; nothing where the triangle is -1. A map
    /// (map.hpp) stores these triangles, so no search is needed. Error: as nearest(); a triangle that does not exist.
    Status nearest_on(std::span<const Mesh::Index> triangles, std::span<const double> points,
                      std::span<SurfaceNearest> found, int threads = 0) const;

    /// Sets `out` by V1: the values of a field of nodes, or of triangles, at the nearest points of these points, one
    /// value a point; NaN where there is none. Error: sizes that do not fit.
    Status values(const Field& field, bool of_cells, std::span<const double> points,
                  std::span<const SurfaceNearest> nearest, std::span<double> out, int threads = 0) const;

    /// Returns, by H1, the hits of the closed segment from a to b, or of the ray from a through b. A triangle whose
    /// plane contains the segment is listed once, at the first of their common points. Error: a coordinate is not
    /// finite; a is b.
    Result<std::vector<SurfaceHit>> hits(const double* a, const double* b, bool ray = false) const;

private:
    explicit SurfaceLocator(std::unique_ptr<locate::SurfaceData> data);
    std::unique_ptr<locate::SurfaceData, void (*)(locate::SurfaceData*)> data_;
};

}  // namespace barycert
