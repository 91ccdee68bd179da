/// The vertex, edge or face of a cell that is nearest to a point, and exact distances to such.
///
/// Everything here is exact for all finite doubles: signs come from weight_signs, comparisons and distances from
/// integers. Neither depends on the floating-point environment.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/simplex.hpp"

namespace barycert::locate {

using Point3 = std::array<double, 3>;  ///< in 2D z = 0

/// The open face of a cell in whose relative interior the nearest point lies. The nearest point is the orthogonal
/// projection to what its corners span.
struct NearFeature {
    int count = 0;                                 ///< corners: 1 to 3
    std::array<Mesh::Index, 3> nodes{-1, -1, -1};  ///< ascending; none if the point itself is in the cell
    std::array<Point3, 3> at{};

    /// Behind those that are there. `point`: of `d` coordinates.
    void add(Mesh::Index node, const double* point, std::size_t d = 3) {
        const auto i = static_cast<std::size_t>(count++);
        nodes[i] = node;
        std::copy_n(point, d, at[i].begin());
    }
    /// The simplex that its corners span, if they are two or three, in space.
    Simplex simplex() const { return count == 3 ? Simplex::triangle3d : Simplex::segment; }
    std::array<double, 9> vertices() const {
        std::array<double, 9> all{};
        for (std::size_t i = 0; i < 3; ++i) std::copy(at[i].begin(), at[i].end(), &all[3 * i]);
        return all;
    }
};

/// Makes the feature of these nodes, -1 where there are fewer. `points`: with d coordinates each.
inline NearFeature near_feature(const std::array<Mesh::Index, 3>& nodes, const std::vector<double>& points,
                                std::size_t d) {
    NearFeature f;
    for (const Mesh::Index node : nodes) {
        if (node >= 0) f.add(node, &points[d * static_cast<std::size_t>(node)], d);
    }
    return f;
}

/// The corners of a cell by ascending node.
struct NearCell {
    int count = 0;          ///< d + 1; of a triangle in space 3
    bool in_space = false;  ///< it is a triangle in space
    std::array<Mesh::Index, 4> nodes{};
    std::array<Point3, 4> at{};

    /// The feature with the corners of `mask`, bit i for corner i.
    NearFeature feature(unsigned mask) const;
};

/// Sets `out` to the feature of the closed cell that has the cell's point nearest to p; to p itself if p is inside.
/// `guess`: the mask of a feature to try first. Returns false if the cell is degenerate, unless it is a triangle in
/// space: then the feature is a vertex, or an edge between corners that follow one another along its line.
bool nearest_feature(const NearCell& cell, const Point3& p, unsigned guess, NearFeature& out);

// Triangles in space without an area: segments and points.

/// Corners by their order along the line, of those at one place the first.
struct FlatCorners {
    std::size_t count = 0;
    std::array<std::uint8_t, 3> corner{};
};
FlatCorners corners_along(const std::array<const double*, 3>& at);

/// The corners of the vertex or edge nearest to p, a bit each. Both require: the triangle has no area.
unsigned nearest_of_flat(const std::array<const double*, 3>& at, const double* p);
/// The same for the vertex or edge on which p lies; 0 if it lies on none.
unsigned part_of_flat(const std::array<const double*, 3>& at, const double* p);

/// -1, 0, 1 as p is nearer to the projection on f than to that on g, as near, or farther.
int compare_distances(const Point3& p, const NearFeature& f, const NearFeature& g);

/// The distance of p to its projection, rounded to nearest; infinite where that is.
double distance_to(const Point3& p, const NearFeature& f);

/// The weights of the projection of p on f, each correctly rounded.
std::array<double, 3> weights_of(const Point3& p, const NearFeature& f);

/// The projection of p on f, each coordinate correctly rounded.
Point3 projection_on(const Point3& p, const NearFeature& f);

}  // namespace barycert::locate
