#include "barycert/check/files.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "barycert/mesh/consistency.hpp"

namespace barycert::check {
namespace {

using Triple = std::array<Mesh::Index, 3>;

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

/// The given faces in lists by their lowest node, to look facets up in.
class FaceTable {
public:
    FaceTable(const Mesh& mesh, DefectList& defects) : begin_(mesh.point_count() + 1, 0) {
        const auto nodes = static_cast<Mesh::Index>(mesh.point_count());
        for (std::size_t f = 0; f < mesh.face_count(); ++f) {
            Face face{{mesh.faces[3 * f], mesh.faces[3 * f + 1], mesh.faces[3 * f + 2]}, f};
            std::sort(face.nodes.begin(), face.nodes.end());
            if (face.nodes[0] < 0 || face.nodes[2] >= nodes) {
                defects.add(DefectKind::wrong_face, {.nodes = nodes_of(mesh, f), .detail = "a corner is no node"});
                continue;
            }
            faces_.push_back(face);
            ++begin_[static_cast<std::size_t>(face.nodes[0]) + 1];
        }
        for (std::size_t n = 0; n + 1 < begin_.size(); ++n) begin_[n + 1] += begin_[n];
        std::sort(faces_.begin(), faces_.end(), [](const Face& a, const Face& b) {
            return a.nodes != b.nodes ? a.nodes < b.nodes : a.index < b.index;
        });
        found_.assign(faces_.size(), 0);
    }

    /// Notes that a cell has the facet.
    void meet(const Triple& sorted) {
        const auto node = static_cast<std::size_t>(sorted[0]);
        for (std::size_t i = begin_[node]; i < begin_[node + 1]; ++i) {
            if (faces_[i].nodes == sorted) std::atomic_ref(found_[i]).store(1, std::memory_order_relaxed);
        }
    }

    void tell_missing(const Mesh& mesh, DefectList& defects) const {
        std::vector<std::size_t> missing;
        for (std::size_t i = 0; i < faces_.size(); ++i) {
            if (found_[i] == 0) missing.push_back(faces_[i].index);
        }
        std::sort(missing.begin(), missing.end());
        for (const std::size_t f : missing) defects.add(DefectKind::wrong_face, {.nodes = nodes_of(mesh, f)});
    }

private:
    struct Face {
        Triple nodes;
        std::size_t index;
    };
    static Triple nodes_of(const Mesh& mesh, std::size_t f) {
        return {mesh.faces[3 * f], mesh.faces[3 * f + 1], mesh.faces[3 * f + 2]};
    }

    std::vector<std::size_t> begin_;
    std::vector<Face> faces_;
    std::vector<std::uint8_t> found_;
};

void check_faces(const Mesh& mesh, const std::vector<std::uint8_t>& usable, DefectList& defects) {
    if (mesh.faces.empty()) return;
    if (mesh.dimension == 2) {
        defects.add(DefectKind::wrong_face, {.detail = barycert::mesh::faces_of_triangles});
        return;
    }
    if (mesh.faces.size() % 3 != 0) defects.add(DefectKind::wrong_face, {.detail = "the last one is not whole"});
    FaceTable table(mesh, defects);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.cell_count(), 4096), [&](const auto& range) {
        for (std::size_t cell = range.begin(); cell != range.end(); ++cell) {
            if (usable[cell] == 0) continue;
            std::array<Mesh::Index, 4> n{};
            std::copy_n(&mesh.cells[4 * cell], 4, n.begin());
            std::sort(n.begin(), n.end());
            table.meet({n[0], n[1], n[2]});
            table.meet({n[0], n[1], n[3]});
            table.meet({n[0], n[2], n[3]});
            table.meet({n[1], n[2], n[3]});
        }
    });
    table.tell_missing(mesh, defects);
}

}  // namespace

void check_files(const Mesh& mesh, const std::vector<std::uint8_t>& usable, const Facets& facets, DefectList& defects) {
    check_neighbours(mesh, facets, defects);
    check_faces(mesh, usable, defects);
}

}  // namespace barycert::check
