#include <algorithm>

#include "barycert/check/stages.hpp"
#include "barycert/mesh/consistency.hpp"

namespace barycert::check {
namespace {

using Triple = std::array<Mesh::Index, 3>;

Triple nodes_of_face(const Mesh& mesh, std::size_t f) {
    return {mesh.faces[3 * f], mesh.faces[3 * f + 1], mesh.faces[3 * f + 2]};
}

bool has_nodes(const Mesh& mesh, const Triple& face) {
    return std::all_of(face.begin(), face.end(),
                       [&](Mesh::Index n) { return n >= 0 && static_cast<std::size_t>(n) < mesh.point_count(); });
}

void check_neighbours(const Mesh& mesh, const Facets& facets, DefectList& defects) {
    if (mesh.neighbours.empty()) return;
    if (mesh.neighbours.size() != mesh.cells.size()) {
        defects.add(DefectKind::wrong_neighbour, {.detail = "not one for each facet of each cell"});
        return;
    }
    for (std::size_t i = 0; i < mesh.neighbours.size(); ++i) {
        if (mesh.neighbours[i] == facets.neighbours[i]) continue;
        const auto cell = static_cast<Mesh::Index>(i / mesh.corners());
        defects.add(DefectKind::wrong_neighbour, {.cells = {cell, mesh.neighbours[i]}});
    }
}

void check_faces(const Mesh& mesh, const std::vector<std::uint8_t>& usable, DefectList& defects) {
    if (mesh.faces.empty()) return;
    if (mesh.dimension == 2) {
        defects.add(DefectKind::wrong_face, {.detail = barycert::mesh::faces_of_triangles});
        return;
    }
    if (mesh.faces.size() % 3 != 0) defects.add(DefectKind::wrong_face, {.detail = "the last one is not whole"});
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const Triple nodes = nodes_of_face(mesh, f);
        if (!has_nodes(mesh, nodes))
            defects.add(DefectKind::wrong_face, {.nodes = nodes, .detail = "a corner is no node"});
    }
    const std::vector<std::uint8_t> found = faces_of_cells(mesh, usable);
    for (std::size_t f = 0; f < found.size(); ++f) {
        const Triple nodes = nodes_of_face(mesh, f);
        if (found[f] == 0 && has_nodes(mesh, nodes)) defects.add(DefectKind::wrong_face, {.nodes = nodes});
    }
}

}  // namespace

std::vector<std::uint8_t> faces_of_cells(const Mesh& mesh, const std::vector<std::uint8_t>& usable) {
    struct Face {
        Triple nodes;
        std::size_t index;
    };
    // Sorted, and where those of each lowest node begin.
    std::vector<Face> faces;
    std::vector<std::size_t> begin(mesh.point_count() + 1, 0);
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        Face face{nodes_of_face(mesh, f), f};
        if (!has_nodes(mesh, face.nodes)) continue;
        std::sort(face.nodes.begin(), face.nodes.end());
        ++begin[static_cast<std::size_t>(face.nodes[0]) + 1];
        faces.push_back(face);
    }
    for (std::size_t n = 1; n < begin.size(); ++n) begin[n] += begin[n - 1];
    std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.nodes < b.nodes; });
    std::vector<std::uint8_t> found(mesh.face_count(), 0);
    const auto meet = [&](const Triple& sorted) {
        const auto node = static_cast<std::size_t>(sorted[0]);
        for (std::size_t i = begin[node]; i < begin[node + 1]; ++i) {
            if (faces[i].nodes == sorted) std::atomic_ref(found[faces[i].index]).store(1, std::memory_order_relaxed);
        }
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.cell_count(), 4096), [&](const auto& range) {
        for (std::size_t cell = range.begin(); cell != range.end(); ++cell) {
            if (usable[cell] == 0) continue;
            std::array<Mesh::Index, 4> n{};
            std::copy_n(&mesh.cells[4 * cell], 4, n.begin());
            std::sort(n.begin(), n.end());
            for (const Triple& facet :
                 {Triple{n[0], n[1], n[2]}, {n[0], n[1], n[3]}, {n[0], n[2], n[3]}, {n[1], n[2], n[3]}})
                meet(facet);
        }
    });
    return found;
}

void check_files(const Mesh& mesh, const std::vector<std::uint8_t>& usable, const Facets& facets, DefectList& defects) {
    check_neighbours(mesh, facets, defects);
    check_faces(mesh, usable, defects);
}

}  // namespace barycert::check
