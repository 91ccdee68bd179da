#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "barycert/base/text.hpp"
#include "barycert/io.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/gmsh/msh_parts.hpp"
#include "barycert/mesh/mid_edges.hpp"

namespace barycert {
namespace io {
namespace {

/// Coordinates of the plane z = 0, in place.
Status flatten(std::vector<double>& points, const std::string& path, const std::string& triangles) {
    std::size_t to = 0;
    for (std::size_t i = 0; i < points.size(); i += 3) {
        if (points[i + 2] != 0)
            return file_error(path, "z of node " + std::to_string(i / 3) + " (from 0)",
                              "0, as the mesh is of triangles", base::shortest(points[i + 2]),
                              plane_remedy(i == 0 ? points : std::vector<double>(), triangles));
        points[to++] = points[i];
        points[to++] = points[i + 1];
    }
    points.resize(to);
    return Done{};
}

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

Result<Mesh> read_whole(const MshFile& file, const GmshReadOptions& options) {
    Result<MshNodes> nodes = read_msh_nodes(file);
    if (!nodes) return nodes.error();
    const Result<MshElements> elements = find_msh_elements(file);
    if (!elements) return elements.error();
    Result<MshCells> cells = read_msh_cells(file, *elements, nodes->index, nodes->points.size() / 3);
    if (!cells) return cells.error();
    const Result<MshGroups> groups = read_msh_groups(file);
    if (!groups) return groups.error();
    const Result<std::vector<MshView>> views = find_msh_views(file);
    if (!views) return views.error();

    Mesh mesh;
    mesh.dimension = cells->dimension;
    mesh.points = std::move(nodes->points);
    mesh.cells = std::move(cells->corners);
    mesh.mid_nodes = std::move(cells->mid_nodes);
    if (!mesh.mid_nodes.empty()) {
        // Of a triangle both orders are the same.
        mesh.mid_edge_order = mesh.dimension == 3 ? MidEdgeOrder::gmsh : MidEdgeOrder::vtk;
        mesh::normalise_mid_nodes(mesh);
    }
    mesh.index_base = 1;
    mesh.cell_numbers = std::move(cells->numbers);
    if (mesh.dimension == 2) {
        if (Status s = flatten(mesh.points, file.path(), mesh.mid_nodes.empty() ? file.path() : ""); !s)
            return s.error();
    }
    note_cells(*cells, *groups, file.path(), mesh.notes);
    const ViewTargets node_targets{nodes->index, mesh.point_count(), "node", "nodes"};
    Status status =
        read_msh_fields(file, *views, MshView::Of::nodes, node_targets, options.step, mesh.point_fields, mesh.notes);
    if (!status) return status.error();
    if (std::any_of(views->begin(), views->end(), [](const MshView& v) { return v.of == MshView::Of::elements; })) {
        std::optional<std::size_t> twice;
        const TagIndex index(cells->tags, twice);
        if (twice)
            return file.error_at(
                file.find("Elements")->name.data(), "two cells with the tag " + std::to_string(cells->tags[*twice]),
                "each tag once, for $ElementData refers to them",
                "it again at cell " + std::to_string(*twice) + " from 0", "give each element a tag of its own");
        const ViewTargets targets{index, mesh.cell_count(), "cell", "cells"};
        status =
            read_msh_fields(file, *views, MshView::Of::elements, targets, options.step, mesh.cell_fields, mesh.notes);
        if (!status) return status.error();
    }
    label_cells(file, *elements, std::move(*cells), *groups, mesh);
    note_sections(file, *views, mesh.notes);
    return mesh;
}

}  // namespace
}  // namespace io

Result<Mesh> read_gmsh(const std::string& path, const GmshReadOptions& options) {
    return io::read_guarded(path, [&]() -> Result<Mesh> {
        const Result<io::MshFile> file = io::MshFile::open(path, options.threads);
        return file ? io::read_whole(*file, options) : file.error();
    });
}

Result<std::vector<GmshStep>> gmsh_steps(const std::string& path) {
    return io::read_guarded(path, [&]() -> Result<std::vector<GmshStep>> {
        const Result<io::MshFile> file = io::MshFile::open(path, 0);
        if (!file) return file.error();
        const Result<std::vector<io::MshView>> views = io::find_msh_views(*file);
        if (!views) return views.error();
        std::vector<GmshStep> steps;
        for (const io::MshView& v : *views) {
            if (v.of != io::MshView::Of::element_nodes) steps.push_back(v);
        }
        return steps;
    });
}

Result<std::vector<double>> read_gmsh_points(const std::string& path, int dimension, int threads) {
    if (dimension != 2 && dimension != 3)
        return file_error(path, "the dimension of points", "2 or 3", std::to_string(dimension));
    return io::read_guarded(path, [&]() -> Result<std::vector<double>> {
        const Result<io::MshFile> file = io::MshFile::open(path, threads);
        if (!file) return file.error();
        Result<io::MshNodes> nodes = io::read_msh_nodes(*file);
        if (!nodes) return nodes.error();
        if (dimension == 2) {
            if (Status s = io::flatten(nodes->points, path, {}); !s) return s.error();
        }
        return std::move(nodes->points);
    });
}

}  // namespace barycert
