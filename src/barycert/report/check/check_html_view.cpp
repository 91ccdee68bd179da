#include "barycert/report/check/check_html_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace barycert::report {

double dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector minus(const Vector& a, const Vector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector unit(const Vector& a) {
    const double max = std::max({std::fabs(a[0]), std::fabs(a[1]), std::fabs(a[2])});
    if (!(max > std::numeric_limits<double>::min())) return {1, 0, 0};
    const Vector b{a[0] / max, a[1] / max, a[2] / max};
    const double length = std::sqrt(dot(b, b));
    return {b[0] / length, b[1] / length, b[2] / length};
}

bool drawable(const Mesh& mesh, std::size_t cell) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    for (std::size_t i = 0; i <= d; ++i) {
        const Mesh::Index node = mesh.cells[cell * (d + 1) + i];
        if (node < 0 || static_cast<std::size_t>(node) >= mesh.point_count()) return false;
        for (std::size_t k = 0; k < d; ++k) {
            if (!std::isfinite(mesh.points[static_cast<std::size_t>(node) * d + k])) return false;
        }
    }
    return true;
}

Normalised::Normalised(int d, const std::vector<const double*>& points) : d_(d) {
    Vector high{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(d) && !points.empty(); ++k) {
        low_[k] = high[k] = points[0][k];
        for (const double* p : points) {
            low_[k] = std::min(low_[k], p[k]);
            high[k] = std::max(high[k], p[k]);
        }
        extent_ = std::max(extent_, high[k] / 2 - low_[k] / 2);  // halved, for a difference may overflow
    }
    exponent_ = extent_ > 0 ? std::ilogb(extent_) : 0;
    extent_ = extent_ > 0 ? std::scalbn(extent_, -exponent_) : 1;
    for (std::size_t k = 0; k < static_cast<std::size_t>(d); ++k)
        middle_[k] = std::scalbn(high[k] / 2 - low_[k] / 2, -exponent_) / 2;
    for (const double* p : points) points_.push_back(place(p));
}

Vector Normalised::place(const double* point) const {
    Vector v{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(d_); ++k) {
        const double offset = std::scalbn(point[k] / 2 - low_[k] / 2, -exponent_);
        v[k] = std::clamp(2 * (offset - middle_[k]) / extent_, -8.0, 8.0);
    }
    return v;
}

std::array<Vector, 3> extents(const std::vector<Vector>& points) {
    Vector mean{};
    for (const Vector& p : points) {
        for (std::size_t k = 0; k < 3; ++k) mean[k] += p[k] / static_cast<double>(points.size());
    }
    std::array<Vector, 3> m{}, axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (const Vector& p : points) {
        const Vector q = minus(p, mean);
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) m[i][j] += q[i] * q[j];
        }
    }
    // Jacobi's rotations: each makes one entry off the diagonal zero.
    for (int sweep = 0; sweep < 20; ++sweep) {
        for (const auto& [p, q] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 2}, {1, 2}}) {
            if (m[p][q] == 0) continue;
            const double angle = 0.5 * std::atan2(2 * m[p][q], m[q][q] - m[p][p]);
            const double c = std::cos(angle), s = std::sin(angle);
            for (std::size_t k = 0; k < 3; ++k) {
                const double a = m[k][p], b = m[k][q];
                m[k][p] = c * a - s * b, m[k][q] = s * a + c * b;
            }
            for (std::size_t k = 0; k < 3; ++k) {
                const double a = m[p][k], b = m[q][k];
                m[p][k] = c * a - s * b, m[q][k] = s * a + c * b;
            }
            for (std::size_t k = 0; k < 3; ++k) {
                const double a = axes[p][k], b = axes[q][k];
                axes[p][k] = c * a - s * b, axes[q][k] = s * a + c * b;
            }
        }
    }
    std::array<std::size_t, 3> order{0, 1, 2};
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return m[a][a] > m[b][b]; });
    return {axes[order[0]], axes[order[1]], axes[order[2]]};
}

View from_above(const std::vector<Vector>& points) {
    const auto [max, middle, min] = extents(points);
    return {max, middle, cross(max, middle)};
}

View from_the_side(const std::vector<Vector>& points) {
    const auto [max, middle, min] = extents(points);
    return {max, min, cross(max, min)};
}

std::array<std::size_t, 2> sharpest_edge(const std::vector<Vector>& t) {
    std::array<std::size_t, 2> sharpest{0, 1};
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = i + 1; j < 4; ++j) {
            const View v = along_edge(t, {i, j});
            std::array<double, 2> at{};
            std::size_t n = 0;
            for (std::size_t k = 0; k < 4; ++k) {
                if (k == i || k == j) continue;
                const Vector w = v(minus(t[k], t[i]));
                at[n++] = std::atan2(w[1], w[0]);
            }
            const double angle = std::fabs(at[0] - at[1]);
            if (angle < smallest) smallest = angle, sharpest = {i, j};
        }
    }
    return sharpest;
}

View along_edge(const std::vector<Vector>& t, std::array<std::size_t, 2> edge) {
    View v;
    v.z = unit(minus(t[edge[1]], t[edge[0]]));
    // Half way between the directions to the other two, seen along the edge.
    Vector open{};
    for (std::size_t k = 0; k < 4; ++k) {
        if (k == edge[0] || k == edge[1]) continue;
        Vector w = minus(t[k], t[edge[0]]);
        const double along = dot(w, v.z);
        for (std::size_t i = 0; i < 3; ++i) w[i] -= along * v.z[i];
        w = unit(w);
        for (std::size_t i = 0; i < 3; ++i) open[i] += w[i];
    }
    const double along = dot(open, v.z);
    for (std::size_t i = 0; i < 3; ++i) open[i] -= along * v.z[i];
    if (dot(open, open) < 1e-20) {  // opposite to each other: 180 degrees
        Vector axis{};
        const auto min =
            std::min_element(v.z.begin(), v.z.end(), [](double a, double b) { return std::fabs(a) < std::fabs(b); });
        axis[static_cast<std::size_t>(min - v.z.begin())] = 1;
        open = cross(v.z, axis);
    }
    v.x = unit(open);
    v.y = cross(v.z, v.x);
    return v;
}

View oblique() {
    constexpr double azimuth = -1.05, elevation = 0.42;  // about 60 and 24 degrees
    const double ca = std::cos(azimuth), sa = std::sin(azimuth), ce = std::cos(elevation), se = std::sin(elevation);
    return {{-sa, ca, 0}, {-se * ca, -se * sa, ce}, {ce * ca, ce * sa, se}};
}

}  // namespace barycert::report
