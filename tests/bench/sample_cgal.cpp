#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <limits>
#include <utility>

#include "sample_peers.hpp"

namespace barycert::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<Mesh::Index, Kernel>;
using CellBase = CGAL::Delaunay_triangulation_cell_base_3<Kernel>;
using Triangulation =
    CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using Point = Kernel::Point_3;
using Numbered = std::pair<Point, Mesh::Index>;

Point point_of(std::span<const double> points, std::size_t i) {
    return {points[3 * i], points[3 * i + 1], points[3 * i + 2]};
}

/// Six times the signed volume, in plain double.
double volume(const Point& a, const Point& b, const Point& c, const Point& d) {
    const double x1 = b.x() - a.x(), y1 = b.y() - a.y(), z1 = b.z() - a.z();
    const double x2 = c.x() - a.x(), y2 = c.y() - a.y(), z2 = c.z() - a.z();
    const double x3 = d.x() - a.x(), y3 = d.y() - a.y(), z3 = d.z() - a.z();
    return x1 * (y2 * z3 - z2 * y3) - y1 * (x2 * z3 - z2 * x3) + z1 * (x2 * y3 - y2 * x3);
}

}  // namespace

struct CgalPeer::Data {
    std::vector<Numbered> nodes;
    Triangulation triangulation;
    std::vector<Numbered> sorted;
    std::vector<Triangulation::Cell_handle> cells;  // of the sorted points
    std::vector<Triangulation::Cell_handle> last, each;
};

CgalPeer::CgalPeer(const Mesh& mesh) : data_(std::make_unique<Data>()) {
    for (std::size_t i = 0; i < mesh.point_count(); ++i) {
        const double* const x = mesh.points.data() + 3 * i;
        data_->nodes.emplace_back(Point(x[0], x[1], x[2]), static_cast<Mesh::Index>(i));
    }
}

CgalPeer::~CgalPeer() = default;

void CgalPeer::build() {
    data_->triangulation = Triangulation(data_->nodes.begin(), data_->nodes.end());
}

void CgalPeer::drop() {
    data_->triangulation.clear();
    data_->cells.clear();
    data_->last.clear();
}

void CgalPeer::sort(std::span<const double> points) {
    data_->sorted.resize(points.size() / 3);
    for (std::size_t i = 0; i < data_->sorted.size(); ++i) {
        const double* const x = points.data() + 3 * i;
        data_->sorted[i] = {Point(x[0], x[1], x[2]), static_cast<Mesh::Index>(i)};
    }
    using Traits = CGAL::Spatial_sort_traits_adapter_3<Kernel, CGAL::First_of_pair_property_map<Numbered>>;
    CGAL::spatial_sort(data_->sorted.begin(), data_->sorted.end(), Traits());
}

void CgalPeer::walk() {
    data_->cells.resize(data_->sorted.size());
    Triangulation::Cell_handle hint;
    for (std::size_t i = 0; i < data_->sorted.size(); ++i)
        data_->cells[i] = hint = data_->triangulation.locate(data_->sorted[i].first, hint);
}

void CgalPeer::follow(std::span<const double> points) {
    data_->last.resize(points.size() / 3);
    Triangulation::Cell_handle hint;
    for (std::size_t i = 0; i < data_->last.size(); ++i)
        data_->last[i] = hint = data_->triangulation.locate(point_of(points, i), hint);
}

void CgalPeer::find_each(std::span<const double> points) {
    data_->each.resize(points.size() / 3);
    for (std::size_t i = 0; i < data_->each.size(); ++i)
        data_->each[i] = data_->triangulation.locate(point_of(points, i));
}

void CgalPeer::find_each_from(std::span<const double> points, std::size_t (*hint)(std::size_t, std::size_t)) {
    const std::size_t count = points.size() / 3;
    data_->each.resize(count);
    for (std::size_t i = 0; i < count; ++i)
        data_->each[i] = data_->triangulation.locate(point_of(points, i), data_->last[hint(i, count)]);
}

std::vector<std::array<Mesh::Index, 4>> CgalPeer::found() const {
    std::vector<std::array<Mesh::Index, 4>> nodes(data_->sorted.size(), {-1, -1, -1, -1});
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (data_->triangulation.is_infinite(data_->cells[i])) continue;
        for (int k = 0; k < 4; ++k) {
            nodes[static_cast<std::size_t>(data_->sorted[i].second)][static_cast<std::size_t>(k)] =
                data_->cells[i]->vertex(k)->info();
        }
    }
    return nodes;
}

void CgalPeer::interpolate(const std::vector<double>& nodal, std::vector<double>& values) const {
    values.resize(data_->sorted.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto& [p, number] = data_->sorted[i];
        double& value = values[static_cast<std::size_t>(number)];
        const auto cell = data_->cells[i];
        if (data_->triangulation.is_infinite(cell)) {
            value = std::numeric_limits<double>::quiet_NaN();
            continue;
        }
        std::array<Point, 4> v;
        std::array<double, 4> f{};
        for (int k = 0; k < 4; ++k) {
            v[static_cast<std::size_t>(k)] = cell->vertex(k)->point();
            f[static_cast<std::size_t>(k)] = nodal[static_cast<std::size_t>(cell->vertex(k)->info())];
        }
        const std::array<double, 4> part{volume(p, v[1], v[2], v[3]), volume(v[0], p, v[2], v[3]),
                                         volume(v[0], v[1], p, v[3]), volume(v[0], v[1], v[2], p)};
        value = (part[0] * f[0] + part[1] * f[1] + part[2] * f[2] + part[3] * f[3]) /
                (part[0] + part[1] + part[2] + part[3]);
    }
}

}  // namespace barycert::bench
