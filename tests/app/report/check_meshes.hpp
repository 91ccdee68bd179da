/// Small meshes, good and broken, and what the check says of them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/fix.hpp"
#include "barycert/gmsh_files.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/plc.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"

namespace barycert::report_test {

inline Mesh own_mesh(const std::string& name) {
    return read_tetgen(std::string(BARYCERT_DATA_DIR) + "/meshes/" + name + ".node").value();
}

inline Mesh tetrahedra(std::vector<double> points, std::vector<Mesh::Index> cells) {
    Mesh mesh;
    mesh.points = std::move(points);
    mesh.cells = std::move(cells);
    return mesh;
}

/// Two cells that share a facet.
inline Mesh pair_of_cells() {
    return tetrahedra({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1}, {0, 1, 2, 3, 0, 2, 1, 4});
}

/// Two cells of which one stands in the other.
inline Mesh overlapping() {
    return tetrahedra({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, .1, .1, .1, 1.1, .1, .1, .1, 1.1, .1, .1, .1, 1.1},
                      {0, 1, 2, 3, 4, 5, 6, 7});
}

/// Something of everything: a flat cell, a cell twice in both orders, one that overlaps, one of three nodes, neighbours
/// and faces of another mesh, a node of no cell, a node at the place of another.
inline Mesh thoroughly_broken() {
    Mesh mesh = overlapping();
    mesh.points.insert(mesh.points.end(), {1, 1, 0, 5, 5, 5, 5, 5, 5});
    mesh.cells.insert(mesh.cells.end(), {0, 2, 1, 3, 0, 1, 2, 8, 0, 1, 2, 2});
    mesh.neighbours.assign(mesh.cells.size(), 0);
    mesh.faces = {0, 1, 2, 0, 1, 7};
    return mesh;
}

/// Two cells side by side, each with its own nodes, of which one is an ulp beside its twin; below one that an edge of
/// theirs hangs on, and a field whose values differ.
inline Mesh cracked_and_hanging() {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.points = {0, 0, 1, 0, 0, 1, 2, 2, 1, 0x1p-53, 0, 1, 1, 1, -1, -1, 3, -1, 3, 0, -1, 0};
    mesh.cells = {0, 1, 2, 4, 6, 5, 10, 7, 9, 0, 2, 0};
    mesh.point_fields = {{"T", 1, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}}};
    mesh.point_markers = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
    return mesh;
}

/// Triangles of which two lie on each other.
inline Mesh broken_plane() {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.points = {0, 0, 1, 0, 0, 1, 0.5, 0.25};
    mesh.cells = {0, 1, 2, 0, 1, 3};
    return mesh;
}

inline CheckReport checked(const Mesh& mesh, bool delaunay = false) {
    CheckOptions options;
    options.threads = 2;
    options.delaunay = delaunay;
    return check_mesh(mesh, options);
}

}  // namespace barycert::report_test
