// barycert itself, asked as the others are.
#include <algorithm>
#include <cstdio>
#include <string>

#include "barycert/sampler.hpp"
#include "io/mesh_notes.hpp"
#include "mesh/pulling.hpp"
#include "tests/systems/exchange.hpp"

namespace {

using namespace barycert;

/// Second-order tetrahedra as such, as readers take them.
void set_cells(const systems::Question& question, Mesh& mesh) {
    const auto is_curved = [](std::uint8_t type) { return type == 24; };
    if (question.types.empty()) {
        mesh.cells = question.cells;
    } else if (std::ranges::all_of(question.types, is_curved)) {
        for (auto node = question.cells.begin(); node != question.cells.end(); node += 10) {
            mesh.cells.insert(mesh.cells.end(), node, node + 4);
            mesh.mid_nodes.insert(mesh.mid_nodes.end(), node + 4, node + 10);
        }
        mesh.mid_edge_order = MidEdgeOrder::vtk;
    } else {
        mesh.shapes.types = question.types;
        mesh.shapes.ends = question.ends;
        mesh.shapes.nodes = question.cells;
        io::cut_into_simplices(mesh, "the mesh that was asked about");
    }
}

}  // namespace

int main(int count, char** words) {
    if (count != 4 || std::string(words[2]) != "locate") return 2;
    const systems::Question question(words[3]);
    Mesh mesh;
    mesh.dimension = static_cast<int>(question.dimension);
    mesh.points = question.nodes;
    set_cells(question, mesh);
    mesh.point_fields = {{"f", 1, question.values}};
    systems::Answer answer;
    const double start = systems::now();
    const Sampler sampler =
        Sampler::build(mesh, {}, {.interpolation = CellInterpolation::multilinear, .threads = 1, .progress = {}})
            .value();
    const double built = systems::now();
    SampleOptions options;
    options.threads = 1;
    const Table rows = sampler.sample(question.points, options).value();
    answer.index_seconds = built - start;
    answer.seconds = systems::now() - built;
    for (const Mesh::Index cell : rows.cells) answer.owners.push_back(mesh.cell_number(cell));
    answer.sampled = rows.values;
    answer.write(question.folder);
    std::printf("%s\n", BARYCERT_VERSION);
    return 0;
}
