// Cells as points that can be drawn, and the directions to draw them from.

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "barycert/report/check/check_pictures.hpp"

namespace barycert::report {
namespace {

/// Directions of least, middle and largest extent of the points, orthonormal.
Eigen::Matrix3d extents(const std::vector<Vector>& points) {
    const Vector sum = std::accumulate(points.begin(), points.end(), Vector(Vector::Zero()));
    const Vector mean = sum / static_cast<double>(std::max<std::size_t>(points.size(), 1));
    Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
    for (const Vector& p : points) m += (p - mean) * (p - mean).transpose();
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m).eigenvectors();
}

/// The directions to the other two corners of a tetrahedron, seen along an edge.
std::array<Vector, 2> sides_at(Points t, std::array<std::size_t, 2> edge) {
    const Vector along = unit(t[edge[1]] - t[edge[0]]);
    std::array<Vector, 2> sides;
    std::size_t n = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        if (k == edge[0] || k == edge[1]) continue;
        const Vector w = t[k] - t[edge[0]];
        sides[n++] = unit(w - w.dot(along) * along);
    }
    return sides;
}

}  // namespace

Vector unit(const Vector& a) {
    const double max = a.cwiseAbs().maxCoeff();
    return max > std::numeric_limits<double>::min() ? Vector((a / max).normalized()) : Vector(Vector::UnitX());
}

bool drawable(const Mesh& mesh, std::size_t cell) {
    return std::ranges::all_of(nodes_of(mesh, cell), [&](Mesh::Index node) {
        return node >= 0 && static_cast<std::size_t>(node) < mesh.point_count() &&
               std::all_of(node_at(mesh, node), node_at(mesh, node) + mesh.dimension,
                           [](double x) { return std::isfinite(x); });
    });
}

Normalised::Normalised(int d, const std::vector<const double*>& points) : d_(d) {
    Vector high = Vector::Zero();
    for (int k = 0; k < d && !points.empty(); ++k) {
        low_[k] = high[k] = points[0][k];
        for (const double* p : points) {
            low_[k] = std::min(low_[k], p[k]);
            high[k] = std::max(high[k], p[k]);
        }
        extent_ = std::max(extent_, high[k] / 2 - low_[k] / 2);  // halved, for a difference may overflow
    }
    exponent_ = extent_ > 0 ? std::ilogb(extent_) : 0;
    extent_ = extent_ > 0 ? std::scalbn(extent_, -exponent_) : 1;
    for (int k = 0; k < d; ++k) middle_[k] = std::scalbn(high[k] / 2 - low_[k] / 2, -exponent_) / 2;
    for (const double* p : points) points_.push_back(place(p));
}

Vector Normalised::place(const double* point) const {
    Vector v = Vector::Zero();
    for (int k = 0; k < d_; ++k) {
        const double offset = std::scalbn(point[k] / 2 - low_[k] / 2, -exponent_);
        v[k] = std::clamp(2 * (offset - middle_[k]) / extent_, -8.0, 8.0);
    }
    return v;
}

View from_above(const std::vector<Vector>& points) {
    const Eigen::Matrix3d axes = extents(points);
    return {axes.col(2), axes.col(1), axes.col(2).cross(axes.col(1))};
}

View from_the_side(const std::vector<Vector>& points) {
    const Eigen::Matrix3d axes = extents(points);
    return {axes.col(2), axes.col(0), axes.col(2).cross(axes.col(0))};
}

std::array<std::size_t, 2> sharpest_edge(Points t) {
    std::array<std::size_t, 2> sharpest{0, 1};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = i + 1; j < 4; ++j) {
            const auto [a, b] = sides_at(t, {i, j});
            // Twice the sine of half the angle.
            if (const double chord = (a - b).norm(); chord < least) least = chord, sharpest = {i, j};
        }
    }
    return sharpest;
}

View along_edge(Points t, std::array<std::size_t, 2> edge) {
    View v;
    v.z = unit(t[edge[1]] - t[edge[0]]);
    const auto [a, b] = sides_at(t, edge);
    Vector open = a + b;
    open -= open.dot(v.z) * v.z;
    if (open.squaredNorm() < 1e-20) {  // opposite to each other: 180 degrees
        Eigen::Index min = 0;
        v.z.cwiseAbs().minCoeff(&min);
        open = v.z.cross(Vector::Unit(min));
    }
    v.x = unit(open);
    v.y = v.z.cross(v.x);
    return v;
}

View oblique() {
    constexpr double azimuth = -1.05, elevation = 0.42;  // about 60 and 24 degrees
    const double ca = std::cos(azimuth), sa = std::sin(azimuth), ce = std::cos(elevation), se = std::sin(elevation);
    return {{-sa, ca, 0}, {-se * ca, -se * sa, ce}, {ce * ca, ce * sa, se}};
}

}  // namespace barycert::report
