#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "barycert/base/text.hpp"
#include "barycert/io.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/gmsh/msh_parts.hpp"
#include "barycert/io/vtk/raw_grid.hpp"
#include "barycert/mesh/mid_edges.hpp"

namespace barycert {
namespace io {
namespace {

/// What is in the file and has no place in a mesh.
void note_sections(const MshFile& file, const std::vector<MshView>& views, Notes& notes) {
    constexpr std::array<std::string_view, 11> read{"MeshFormat",  "PhysicalNames",   "Entities", "PartitionedEntities",
                                                    "Nodes",       "ParametricNodes", "Elements", "NodeData",
                                                    "ElementData", "ElementNodeData", "Comments"};
    std::set<std::string_view> others;
    for (const MshSection& section : file.sections()) {
        if (std::find(read.begin(), read.end(), section.name) == read.end()) others.insert(section.name);
    }
    std::string text;
    for (const std::string_view name : others)
        text += (text.empty() ? "section $" : ", $") + base::printable(name.substr(0, 40));
    if (!text.empty()) notes.push_back({Note::Kind::left_out, text, file.path()});
    std::set<std::string> names;
    for (const MshView& view : views) {
        if (view.of != MshView::Of::element_nodes || !names.insert(view.field).second) continue;
        notes.push_back({Note::Kind::left_out,
                         base::quoted(view.field) + " ($ElementNodeData): it has a value for each node of each element",
                         file.path(), true});
    }
}

Mesh read_whole(const MshFile& file, const GmshReadOptions& options) {
    MshNodes nodes = read_msh_nodes(file);
    const MshElements elements = find_msh_elements(file);
    MshCells cells = read_msh_cells(file, elements, nodes);
    const MshGroups groups = read_msh_groups(file);
    const std::vector<MshView> views = find_msh_views(file);

    Mesh& mesh = cells.mesh;
    mesh.points = std::move(nodes.points);
    if (!mesh.mid_nodes.empty()) {
        // Of a triangle both orders are the same.
        mesh.mid_edge_order = mesh.dimension == 3 ? MidEdgeOrder::gmsh : MidEdgeOrder::vtk;
        mesh::normalise_mid_nodes(mesh);
    }
    mesh.index_base = 1;
    if (mesh.dimension == 2)
        mesh.points =
            to_points(std::move(mesh.points), 2, file.path(), mesh.mid_nodes.empty() ? file.path() : "", "node");
    note_cells(cells, groups.partitioned, file.path());
    read_msh_fields(file, views, MshView::Of::nodes, {nodes.index, mesh.point_count(), "node", "nodes"}, options.step,
                    mesh.point_fields, mesh.notes);
    if (std::any_of(views.begin(), views.end(), [](const MshView& v) { return v.of == MshView::Of::elements; })) {
        const TagIndex index(cells.tags);
        if (const auto twice = index.first_twice; twice)
            file.refuse(file.find("Elements")->name.data(),
                        "two cells with the tag " + std::to_string(cells.tags[*twice]),
                        "each tag once, for $ElementData refers to them",
                        "it again at cell " + std::to_string(*twice) + " from 0", "give each element a tag of its own");
        read_msh_fields(file, views, MshView::Of::elements, {index, mesh.cell_count(), "cell", "cells"}, options.step,
                        mesh.cell_fields, mesh.notes);
    }
    label_cells(file, elements, groups, cells);
    note_sections(file, views, mesh.notes);
    return std::move(mesh);
}

}  // namespace
}  // namespace io

Result<Mesh> read_gmsh(const std::string& path, const GmshReadOptions& options) {
    return io::read_guarded(
        path, [&]() -> Result<Mesh> { return io::read_whole(io::MshFile(path, options.threads), options); });
}

Result<std::vector<GmshStep>> gmsh_steps(const std::string& path) {
    return io::read_guarded(path, [&]() -> Result<std::vector<GmshStep>> {
        const io::MshFile file(path, 0);
        std::vector<GmshStep> steps;
        for (const io::MshView& v : io::find_msh_views(file)) {
            if (v.of != io::MshView::Of::element_nodes) steps.push_back(v);
        }
        return steps;
    });
}

Result<std::vector<double>> read_gmsh_points(const std::string& path, int dimension, int threads) {
    if (dimension != 2 && dimension != 3)
        return file_error(path, "the dimension of points", "2 or 3", std::to_string(dimension));
    return io::read_guarded(path, [&]() -> Result<std::vector<double>> {
        return io::to_points(io::read_msh_nodes(io::MshFile(path, threads)).points, dimension, path, {}, "node");
    });
}

}  // namespace barycert
