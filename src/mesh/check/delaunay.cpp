#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "barycert/check_results.hpp"
#include "barycert/mesh.hpp"
#include "barycert/predicates.hpp"
#include "core/base/strict_math.hpp"
#include "core/base/vectors.hpp"
#include "mesh/check/stages.hpp"

namespace barycert::check {
namespace {

/// The radius of the sphere through the corners less the distance of `apex` from its centre, over the radius: plain
/// double, relative to corner 0, in a unit in which nothing overflows. At least 0 for what is exactly inside.
double depth(int d, const double* const* p, const double* apex) {
    using Vector = base::Vector3<double>;
    std::array<Vector, 3> e{};
    Vector x{};
    double max = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(d); ++k) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(d); ++i) {
            e[i][k] = p[i + 1][k] / 2 - p[0][k] / 2;
            max = std::max(max, std::fabs(e[i][k]));
        }
        x[k] = apex[k] / 2 - p[0][k] / 2;
    }
    if (d == 2) e[2][2] = max;  // a third edge, normal to the plane: the centre's foot is the circle's
    const int exponent = max > 0 ? std::ilogb(max) : 0;
    for (Vector* v : {&e[0], &e[1], &e[2], &x}) {
        for (double& coordinate : *v) coordinate = std::scalbn(coordinate, -exponent);
    }
    const Vector minors[] = {base::cross(e[1], e[2]), base::cross(e[2], e[0]), base::cross(e[0], e[1])};
    const double det = base::dot(e[0], minors[0]);
    double radius = 0, distance = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(d); ++k) {
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i) sum += base::dot(e[i], e[i]) * minors[i][k];
        const double c = sum / (2 * det);
        radius += c * c;
        distance += (x[k] - c) * (x[k] - c);
    }
    const double value = 1 - std::sqrt(distance / radius);
    return std::isfinite(value) ? std::max(value, 0.0) : 0;
}

/// Adds a part; of equal depths the first counts.
void add(const DelaunayReport& part, DelaunayReport& all) {
    all.facets += part.facets;
    all.violations += part.violations;
    all.cospherical += part.cospherical;
    if (part.worst_cell < 0 || (all.worst_cell >= 0 && part.worst_depth <= all.worst_depth)) return;
    all.worst_depth = part.worst_depth;
    all.worst_cell = part.worst_cell;
    all.worst_node = part.worst_node;
}

struct FacetTester {
    const Checked& c;
    const Mesh& mesh = c.mesh;

    /// The facets of `cell` to cells of higher number.
    void operator()(std::size_t cell, DelaunayReport& out) const {
        if (c.orientation[cell] == 0) return;
        const auto p = corner_points(mesh, cell);
        for (std::size_t i = 0; i < mesh.corners(); ++i) {
            const Mesh::Index other = c.neighbours[cell * mesh.corners() + i];
            if (other <= static_cast<Mesh::Index>(cell) || c.degenerate(other)) continue;
            ++out.facets;
            const auto there = static_cast<std::size_t>(other);
            const Mesh::Index node = apex(there, static_cast<Mesh::Index>(cell));
            const Sign one = side(cell, p, node);
            // Where the cells lie on opposite sides, an apex is in the other's sphere if that one is in its own.
            const bool mutual = opposite(cell, p, i, node);
            if (mutual && one == Sign::negative) continue;
            const auto q = corner_points(mesh, there);
            const Mesh::Index back = mesh.corners_of(cell)[i];
            const Sign other_one = mutual ? one : side(there, q, back);
            if (one == Sign::positive || other_one == Sign::positive)
                ++out.violations;
            else if (one == Sign::zero || other_one == Sign::zero)
                ++out.cospherical;
            if (one == Sign::positive) note_depth(cell, p, node, out);
            if (other_one == Sign::positive) note_depth(there, q, back, out);
        }
    }

    /// The node lies on the other side of the facet opposite to corner i than the cell.
    bool opposite(std::size_t cell, std::array<const double*, 4> p, std::size_t i, Mesh::Index node) const {
        p[i] = mesh.point(node);
        return exact_sign(mesh.dimension, p) * c.orientation[cell] < 0;
    }

    /// Positive if the node lies strictly in the cell's sphere, zero on it.
    Sign side(std::size_t cell, const std::array<const double*, 4>& p, Mesh::Index node) const {
        const double* const at = mesh.point(node);
        const Sign s = mesh.dimension == 2 ? incircle(p[0], p[1], p[2], at) : insphere(p[0], p[1], p[2], p[3], at);
        return static_cast<Sign>(static_cast<int>(s) * c.orientation[cell]);
    }

    void note_depth(std::size_t cell, const std::array<const double*, 4>& p, Mesh::Index node,
                    DelaunayReport& out) const {
        add({0, 0, 0, depth(mesh.dimension, p.data(), mesh.point(node)), static_cast<Mesh::Index>(cell), node}, out);
    }

    /// The node of `cell` that is opposite to its facet to `to`.
    Mesh::Index apex(std::size_t cell, Mesh::Index to) const {
        const std::size_t n = mesh.corners();
        std::size_t i = 0;
        while (i + 1 < n && c.neighbours[cell * n + i] != to) ++i;
        return mesh.cells[cell * n + i];
    }
};

}  // namespace

DelaunayReport check_delaunay(const Checked& c) {
    DelaunayReport all;
    const FacetTester test{c};
    in_blocks(
        c.mesh.cell_count(), 8192, DelaunayReport(),
        [&](std::size_t first, std::size_t last, DelaunayReport& part) {
            for (std::size_t cell = first; cell < last; ++cell) test(cell, part);
        },
        [&](const DelaunayReport& part) { add(part, all); });
    return all;
}

}  // namespace barycert::check
