#include "vtk/closest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "barycert/environment.hpp"
#include "barycert/weights.hpp"

namespace barycert::in_vtk {

namespace {

std::span<const Mesh::Index> corners_of(const ExactIndex& index, Mesh::Index cell) {
    const std::size_t n = index.mesh.corners();
    return {index.mesh.cells.data() + n * static_cast<std::size_t>(cell), n};
}

// The node in space.
void place(const ExactIndex& index, Mesh::Index node, double* out) {
    const auto d = static_cast<std::size_t>(index.mesh.dimension);
    out[index.axes[2]] = index.plane;
    for (std::size_t a = 0; a < d; ++a) out[index.axes[a]] = index.mesh.points[d * static_cast<std::size_t>(node) + a];
}

// Sets point and weights from the nodes whose hull has the nearest point in it.
void project(const ExactIndex& index, const Nearest& nearest, const double* x, Closest& found) {
    std::array<double, 9> vertices{};
    int count = 0;
    for (; count < 3 && nearest.nodes[static_cast<std::size_t>(count)] >= 0; ++count)
        place(index, nearest.nodes[static_cast<std::size_t>(count)], vertices.data() + 3 * count);
    std::array<double, 4> weights{1};
    std::copy_n(vertices.begin(), 3, found.point.begin());
    if (count > 1) {
        const Simplex simplex = count == 2 ? Simplex::segment : Simplex::triangle3d;
        if (const Result<Weights> w = barycentric_weights(simplex, vertices.data(), x)) weights = w->weights;
        std::array<double, 3> point{};
        if (point_from_weights(simplex, vertices.data(), weights.data(), point.data())) found.point = point;
    }
    const std::span<const Mesh::Index> corners = corners_of(index, found.cell);
    for (int k = 0; k < count; ++k) {
        const auto at = std::find(corners.begin(), corners.end(), nearest.nodes[static_cast<std::size_t>(k)]);
        if (at != corners.end())
            found.weights[static_cast<std::size_t>(at - corners.begin())] = weights[static_cast<std::size_t>(k)];
    }
}

}  // namespace

Closest closest(const ExactIndex& index, const double* x, double limit) {
    const ExactEnvironment environment;
    Closest found;
    if (!index.locator || !std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2])) return found;
    std::array<double, 3> point{};
    const bool flat = index.mesh.dimension == 2;
    const bool in_plane = index.project(x, point.data());
    const Result<Nearest> nearest =
        index.locator->nearest(point.data(), flat ? std::numeric_limits<double>::infinity() : limit);
    if (!nearest || nearest->cell < 0) return found;
    const double distance =
        in_plane ? nearest->distance : std::hypot(nearest->distance, held(x[index.normal]) - index.plane);
    if (!(distance <= limit)) return found;
    found.cell = nearest->cell;
    found.distance = distance;
    if (nearest->nodes[0] >= 0) {
        project(index, *nearest, x, found);
        return found;
    }
    found.inside = in_plane;
    found.weights = weights_in(index, found.cell, x);
    std::copy_n(x, 3, found.point.begin());
    if (flat) found.point[static_cast<std::size_t>(index.normal)] = index.plane;
    return found;
}

std::array<double, 4> weights_in(const ExactIndex& index, Mesh::Index cell, const double* x) {
    std::array<double, 3> point{};
    index.project(x, point.data());
    return weights_on_axes(index, cell, point.data());
}

std::array<double, 4> weights_on_axes(const ExactIndex& index, Mesh::Index cell, const double* point) {
    std::array<double, 12> vertices{};
    const auto d = static_cast<std::size_t>(index.mesh.dimension);
    double* out = vertices.data();
    for (const Mesh::Index node : corners_of(index, cell))
        out = std::copy_n(index.mesh.points.data() + d * static_cast<std::size_t>(node), d, out);
    const Result<Weights> weights = barycentric_weights(index.simplex(), vertices.data(), point);
    return weights ? weights->weights : std::array<double, 4>{};
}

}  // namespace barycert::in_vtk
