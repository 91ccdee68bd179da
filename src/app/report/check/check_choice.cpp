// Which cells a page draws, and from where.

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/report/check/check_pictures.hpp"
#include "app/report/check/check_words.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh.hpp"

namespace barycert::report {
namespace {

using Cells = std::array<Mesh::Index, 2>;

/// The most exhibits with one kind of problem.
constexpr std::size_t longest_queue = 200;

/// Without cells that cannot be drawn; sorted, the second -1 if there is one.
Cells drawn_of(const Mesh& mesh, Cells cells) {
    for (Mesh::Index& c : cells) {
        const auto cell = static_cast<std::size_t>(c);  // of -1 beyond all cells
        if (cell >= mesh.cell_count() || !drawable(mesh, cell)) c = -1;
    }
    if (cells[0] == cells[1]) cells[1] = -1;
    if (cells[0] < 0 || (cells[1] >= 0 && cells[1] < cells[0])) std::swap(cells[0], cells[1]);
    return cells;
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

std::vector<Exhibit> worst_cells(const CheckReport& report, const Mesh& mesh, std::size_t max) {
    const CellMeasures& m = report.measures;
    std::set<std::pair<double, Mesh::Index>> worst;
    for (std::size_t cell = 0; cell < m.min_angle.size(); ++cell) {
        const std::pair entry(m.min_angle[cell], static_cast<Mesh::Index>(cell));
        if (m.orientation[cell] == 0 || std::isnan(entry.first)) continue;
        if ((worst.size() == max && !(entry < *worst.rbegin())) || !drawable(mesh, cell)) continue;
        worst.insert(entry);
        if (worst.size() > max) worst.erase(std::prev(worst.end()));
    }
    std::vector<Exhibit> exhibits;
    exhibits.reserve(worst.size());
    const char* const kind = mesh.dimension == 2 ? "" : "dihedral ";
    for (const auto& [angle, cell] : worst)
        exhibits.push_back({.cells = {cell, -1}, .what = fmt::format("smallest {}angle {:.4g}°", kind, angle)});
    return exhibits;
}

std::vector<Exhibit> defect_cells(const CheckReport& report, const Mesh& mesh, std::size_t max) {
    // One queue a kind of problem; of pairs of cells, those with a witness first.
    std::vector<std::vector<Exhibit>> queues(2);
    const auto add = [](std::vector<Exhibit>& queue, Exhibit e) {
        if (e.cells[0] >= 0 && queue.size() < longest_queue) queue.push_back(std::move(e));
    };
    for (const CellContact& c : report.contacts) {
        std::string what = c.overlap ? "overlapping cells" : "cells that " + touch_text(c) + " where they must not";
        add(queues[c.overlap ? 0 : 1], {drawn_of(mesh, c.cells), std::move(what), &c, true});
    }
    for (const Defect& f : report.defects) {
        if (!f.breaks()) continue;
        std::vector<Exhibit>& queue = queues.emplace_back();
        std::string what(defect_text(f.kind).name);
        std::ranges::replace(what, '_', ' ');
        for (const DefectPlace& p : f.places) {
            const std::string detail = *p.detail == '\0' ? "" : fmt::format(" ({})", p.detail);
            add(queue, {.cells = drawn_of(mesh, p.cells), .what = what + detail, .defect = true});
        }
    }
    // First such as have only cells that were not shown yet; one cell may overlap many.
    std::vector<Exhibit> exhibits;
    std::set<Cells> pairs;
    std::set<Mesh::Index> cells;
    for (const bool others : {true, false}) {
        for (std::size_t round = 0; round < longest_queue; ++round) {
            for (const std::vector<Exhibit>& queue : queues) {
                if (round >= queue.size() || exhibits.size() == max) continue;
                const Exhibit& e = queue[round];
                if (pairs.contains(e.cells) ||
                    (others && (cells.contains(e.cells[0]) || (e.cells[1] >= 0 && cells.contains(e.cells[1])))))
                    continue;
                exhibits.push_back(e);
                pairs.insert(e.cells);
                cells.insert(e.cells.begin(), e.cells.end());
            }
        }
    }
    return exhibits;
}

bool drawable(const Mesh& mesh, std::size_t cell) {
    return std::ranges::all_of(mesh.corners_of(cell), [&](Mesh::Index node) {
        return node >= 0 && static_cast<std::size_t>(node) < mesh.point_count() &&
               std::all_of(mesh.point(node), mesh.point(node) + mesh.dimension,
                           [](double x) { return std::isfinite(x); });
    });
}

Normalised::Normalised(int d, const std::vector<const double*>& points) : d_(d) {
    Eigen::AlignedBox3d box;
    for (const double* p : points) box.extend(Vector(p[0], p[1], d == 2 ? 0 : p[2]));
    if (box.isEmpty()) return;
    low_ = box.min();
    const Vector half = box.max() / 2 - box.min() / 2;  // halved, for a difference may overflow
    extent_ = half.maxCoeff();
    exponent_ = extent_ > 0 ? std::ilogb(extent_) : 0;
    extent_ = extent_ > 0 ? std::scalbn(extent_, -exponent_) : 1;
    for (int k = 0; k < d; ++k) middle_[k] = std::scalbn(half[k], -exponent_) / 2;
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

View broad_view(const std::vector<Vector>& points, int up) {
    const Vector sum = std::accumulate(points.begin(), points.end(), Vector(Vector::Zero()));
    const Vector mean = sum / static_cast<double>(std::max<std::size_t>(points.size(), 1));
    Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
    for (const Vector& p : points) m += (p - mean) * (p - mean).transpose();
    // Directions of least, middle and largest extent, orthonormal.
    const Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m).eigenvectors();
    return {axes.col(2), axes.col(up), axes.col(2).cross(axes.col(up))};
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

}  // namespace barycert::report
