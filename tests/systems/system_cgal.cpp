// CGAL's locate in its own Delaunay triangulation of the nodes. SYSTEM: exact-predicates, inexact.
//
// The triangulation is made with exact predicates in both cases; `inexact` copies it into one over plain doubles and
// walks there. Points are sorted along a space-filling curve, and each walk begins where the last one ended, as CGAL's
// manual advises.
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_2.h>
#include <CGAL/Triangulation_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>
#include <CGAL/version.h>

#include <cstdio>
#include <string>
#include <utility>

#include "tests/systems/exchange.hpp"

namespace {

using barycert::systems::Answer;
using barycert::systems::now;
using barycert::systems::Question;
using Exact = CGAL::Exact_predicates_inexact_constructions_kernel;
using Inexact = CGAL::Simple_cartesian<double>;

/// Triangles in the plane. Vertices know the number of their node, faces their own.
template <class Kernel>
struct Plane {
    static constexpr int corners = 3;
    using Point = typename Kernel::Point_2;
    using Structure = CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>,
                                                           CGAL::Triangulation_face_base_with_info_2<int, Kernel>>;
    using Triangulation = CGAL::Triangulation_2<Kernel, Structure>;
    using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, Structure>;
    using Cell = typename Triangulation::Face_handle;
    using CellData = typename Structure::Face;
    using Numbered = std::pair<Point, int>;
    using Sorting = CGAL::Spatial_sort_traits_adapter_2<Kernel, CGAL::First_of_pair_property_map<Numbered>>;

    static Point point(const double* x) { return {x[0], x[1]}; }
    template <class From>
    static Point converted(const From& p) {
        return {p.x(), p.y()};
    }
    template <class T>
    static auto cells(T& t) {
        return t.finite_face_handles();
    }
    template <class T>
    static bool outside(const T& t, Cell cell) {
        return cell == Cell() || t.is_infinite(cell);
    }
};

/// The same for tetrahedra.
template <class Kernel>
struct Space {
    static constexpr int corners = 4;
    using Point = typename Kernel::Point_3;
    using Structure = CGAL::Triangulation_data_structure_3<
        CGAL::Triangulation_vertex_base_with_info_3<int, Kernel>,
        CGAL::Triangulation_cell_base_with_info_3<int, Kernel, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>;
    using Triangulation = CGAL::Triangulation_3<Kernel, Structure>;
    using Delaunay = CGAL::Delaunay_triangulation_3<Kernel, Structure>;
    using Cell = typename Triangulation::Cell_handle;
    using CellData = typename Structure::Cell;
    using Numbered = std::pair<Point, int>;
    using Sorting = CGAL::Spatial_sort_traits_adapter_3<Kernel, CGAL::First_of_pair_property_map<Numbered>>;

    static Point point(const double* x) { return {x[0], x[1], x[2]}; }
    template <class From>
    static Point converted(const From& p) {
        return {p.x(), p.y(), p.z()};
    }
    template <class T>
    static auto cells(T& t) {
        return t.finite_cell_handles();
    }
    template <class T>
    static bool outside(const T& t, Cell cell) {
        return cell == Cell() || t.is_infinite(cell);
    }
};

/// Copies vertices with other points, and cells.
template <class From, class To>
struct Vertices {
    typename To::Structure::Vertex operator()(const typename From::Structure::Vertex& v) const {
        typename To::Structure::Vertex made;
        (*this)(v, made);
        return made;
    }
    void operator()(const typename From::Structure::Vertex& v, typename To::Structure::Vertex& to) const {
        to.set_point(To::converted(v.point()));
        to.info() = v.info();
    }
};
template <class From, class To>
struct Cells {
    To operator()(const From& c) const {
        To made;
        made.info() = c.info();
        return made;
    }
    void operator()(const From& c, To& to) const { to.info() = c.info(); }
};

template <class World>
std::vector<typename World::Numbered> numbered(const std::vector<double>& coordinates) {
    std::vector<typename World::Numbered> points;
    const std::size_t d = World::corners - 1;
    for (std::size_t i = 0; i < coordinates.size() / d; ++i)
        points.emplace_back(World::point(coordinates.data() + d * i), static_cast<int>(i));
    return points;
}

template <class World, class Triangulation>
void locate(const Triangulation& triangulation, const Question& question, Answer& answer) {
    auto points = numbered<World>(question.points);
    const double start = now();
    CGAL::spatial_sort(points.begin(), points.end(), typename World::Sorting());
    typename World::Cell hint;
    for (const auto& [point, number] : points) {
        hint = triangulation.locate(point, hint);
        const bool outside = World::outside(triangulation, hint);
        answer.owners[static_cast<std::size_t>(number)] = outside ? -1 : hint->info();
    }
    answer.seconds = now() - start;
}

template <template <class> class World>
void answer(const Question& question, const std::string& system, const std::string& task) {
    using Made = World<Exact>;
    const double start = now();
    const auto nodes = numbered<Made>(question.nodes);
    typename Made::Delaunay delaunay(nodes.begin(), nodes.end());
    int number = 0;
    std::vector<std::int32_t> cells;
    for (auto cell : Made::cells(delaunay)) {
        cell->info() = number++;
        for (int k = 0; k < Made::corners; ++k) cells.push_back(cell->vertex(k)->info());
    }
    if (task == "triangulate") return barycert::systems::write_array(question.folder + "/cells.i32", cells);
    Answer answer;
    answer.owners.resize(question.point_count());
    if (system == "exact-predicates") {
        answer.index_seconds = now() - start;
        locate<Made>(delaunay, question, answer);
    } else {
        using Plain = World<Inexact>;
        typename Plain::Triangulation copy;
        copy.set_infinite_vertex(copy.tds().copy_tds(delaunay.tds(), delaunay.infinite_vertex(),
                                                     Vertices<Made, Plain>(),
                                                     Cells<typename Made::CellData, typename Plain::CellData>()));
        answer.index_seconds = now() - start;
        locate<Plain>(copy, question, answer);
    }
    answer.write(question.folder);
}

}  // namespace

int main(int count, char** words) {
    if (count != 4) return 2;
    const Question question(words[3]);
    if (question.dimension == 3) {
        answer<Space>(question, words[1], words[2]);
    } else {
        answer<Plane>(question, words[1], words[2]);
    }
    std::printf("%s\n", CGAL_VERSION_STR);
    return 0;
}
