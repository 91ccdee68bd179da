#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <memory>

#include "surface_query_peers.hpp"

namespace barycert::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using CgalMesh = CGAL::Surface_mesh<Point>;
using Primitive = CGAL::AABB_face_graph_triangle_primitive<CgalMesh>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

struct Shared {
    CgalMesh mesh;
    std::unique_ptr<Tree> tree;
    std::unique_ptr<CGAL::Side_of_triangle_mesh<CgalMesh, Kernel>> side;
};

}  // namespace

QueryPeers cgal_peers(const Surface& surface) {
    const auto shared = std::make_shared<Shared>();
    std::vector<CgalMesh::Vertex_index> at;
    for (std::size_t i = 0; i < surface.points.size(); i += 3)
        at.push_back(shared->mesh.add_vertex(Point(surface.points[i], surface.points[i + 1], surface.points[i + 2])));
    for (std::size_t i = 0; i < surface.cells.size(); i += 3)
        shared->mesh.add_face(at[surface.cells[i]], at[surface.cells[i + 1]], at[surface.cells[i + 2]]);
    QueryPeers peers;
    peers.nearest.push_back({"CGAL AABB_tree", [shared](const auto& points, auto& answers, auto& distances) {
                                 if (!shared->tree) {
                                     shared->tree = std::make_unique<Tree>(faces(shared->mesh).begin(),
                                                                           faces(shared->mesh).end(), shared->mesh);
                                     shared->tree->accelerate_distance_queries();
                                 }
                                 for (std::size_t i = 0; i < answers.size(); ++i) {
                                     const Point p(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
                                     const auto found = shared->tree->closest_point_and_primitive(p);
                                     answers[i] = static_cast<std::int64_t>(found.second);
                                     distances[i] = std::sqrt(CGAL::squared_distance(p, found.first));
                                 }
                             }});
    peers.inside.push_back({"CGAL Side_of_triangle_mesh", [shared](const auto& points, auto& answers, auto&) {
                                if (!shared->side)
                                    shared->side =
                                        std::make_unique<CGAL::Side_of_triangle_mesh<CgalMesh, Kernel>>(shared->mesh);
                                for (std::size_t i = 0; i < answers.size(); ++i)
                                    answers[i] = (*shared->side)(Point(points[3 * i], points[3 * i + 1],
                                                                       points[3 * i + 2])) == CGAL::ON_BOUNDED_SIDE;
                            }});
    peers.self_intersections = [shared] {
        std::vector<std::pair<CgalMesh::Face_index, CgalMesh::Face_index>> pairs;
        CGAL::Polygon_mesh_processing::self_intersections(shared->mesh, std::back_inserter(pairs));
        return pairs.size();
    };
    return peers;
}

}  // namespace barycert::bench
