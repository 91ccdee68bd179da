// Proves that a mesh is a partition of its domain, or lists its defects.

#include <barycert/check.hpp>
#include <barycert/mesh_files.hpp>

#include <cstdio>

using namespace barycert;

int main() {
    Mesh mesh = read_mesh("data/meshes/cube-hole").value();
    mesh.points[3 * 408] += 0.1;  // move a node

    const CheckReport report = check_mesh(mesh, {.delaunay = true});
    std::printf("%s\n", report.certified() ? "certified" : "not certified");
    for (const Defect& defect : report.defects) {
        const DefectText& text = defect_text(defect.kind);
        std::printf("%d %s: %s\n", static_cast<int>(defect.count), text.name.data(), text.text.data());
    }
}
