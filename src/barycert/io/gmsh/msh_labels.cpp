#include "barycert/io/gmsh/msh_labels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "barycert/base/text.hpp"

namespace barycert::io {
namespace {

bool has_field(const Mesh& mesh, const char* name) {
    return std::any_of(mesh.cell_fields.begin(), mesh.cell_fields.end(),
                       [&](const Field& field) { return field.name == name; });
}

/// 4.x: groups of cells by way of their entities.
void fill_from_entities(const MshFile& file, const MshElements& elements, const MshGroups& groups, MshCells& cells,
                        Notes& notes) {
    cells.physical.assign(cells.tags.size(), 0);
    std::size_t cell = 0, entities = 0;
    std::string example;
    std::map<std::int64_t, bool> told;
    for (const ElementBlock& block : elements.blocks) {
        if (cells.left_out[static_cast<std::size_t>(block.type->number)] != 0 || block.run.count == 0) continue;
        const auto found = groups.entities.find({cells.dimension, block.entity});
        if (found != groups.entities.end()) {
            const MshEntity& entity = found->second;
            const auto begin = static_cast<std::ptrdiff_t>(cell);
            if (!entity.physical.empty()) {
                std::fill_n(cells.physical.begin() + begin, block.run.count,
                            static_cast<double>(entity.physical.front()));
            }
            std::fill_n(cells.geometrical.begin() + begin, block.run.count, static_cast<double>(entity.whole));
            if (entity.physical.size() > 1 && told.emplace(block.entity, true).second) {
                ++entities;
                if (example.empty()) {
                    example = "entity " + std::to_string(block.entity) + " is in " +
                              std::to_string(entity.physical.size()) + " groups";
                }
            }
        }
        cell += block.run.count;
    }
    if (entities == 0) return;
    notes.push_back({Note::Kind::left_out,
                     "physical groups of cells in several (" + example + "): gmsh:physical has the first of them",
                     file.path(), true});
}

/// The name of the group of each cell; empty where it has none.
std::vector<std::string> group_names(const MshCells& cells, const MshGroups& groups) {
    std::vector<std::string> names;
    names.reserve(cells.physical.size());
    double last = 0;
    const std::string nothing;
    const std::string* name = &nothing;
    for (const double tag : cells.physical) {
        if (tag != last || names.empty()) {
            // A group that is turned around has its tag with a minus.
            const auto found = groups.names.find({cells.dimension, static_cast<std::int64_t>(std::fabs(tag))});
            name = found == groups.names.end() ? &nothing : &found->second;
            last = tag;
        }
        names.push_back(*name);
    }
    return names;
}

}  // namespace

void note_cells(const MshCells& cells, const MshGroups& groups, const std::string& path, Notes& notes) {
    const std::string others = counted_types(cells.left_out, 0, cells.dimension - 1);
    // Gmsh writes points, lines and triangles of the boundary beside nearly all meshes. That changes no result, and to
    // tell it each time would teach users to look away. What has nodes of its own is another matter: a wire or a shell
    // beside the cells, of which nothing is left.
    if (!others.empty()) {
        notes.push_back(
            {Note::Kind::left_out,
             "elements of a lower dimension: " + others + (cells.apart ? "; some have nodes that no cell has" : ""),
             path, cells.apart});
    }
    if (cells.repeated != 0) {
        notes.push_back({Note::Kind::left_out,
                         std::to_string(cells.repeated) +
                             " elements that repeat the one before them for a further physical group: gmsh:physical "
                             "has the first group of each cell",
                         path, true});
    }
    if (cells.unused_nodes != 0) {
        notes.push_back({Note::Kind::left_out,
                         std::to_string(cells.unused_nodes) +
                             " nodes of no cell: no value is taken from them; all nodes keep their numbers",
                         path});
    }
    if (cells.partitioned || groups.partitioned)
        notes.push_back({Note::Kind::left_out, "partitions of the mesh: it is read as one", path});
}

void label_cells(const MshFile& file, const MshElements& elements, MshCells cells, const MshGroups& groups,
                 Mesh& mesh) {
    if (file.version() != 22) fill_from_entities(file, elements, groups, cells, mesh.notes);
    const bool grouped = std::any_of(cells.physical.begin(), cells.physical.end(), [](double tag) { return tag != 0; });
    bool in_sequence = true;
    for (std::size_t i = 0; i < cells.tags.size() && in_sequence; ++i) {
        in_sequence = cells.tags[i] == std::int64_t{mesh.cell_number(static_cast<Mesh::Index>(i))} + 1;
    }
    if (grouped) {
        std::vector<std::string> names = group_names(cells, groups);
        if (std::any_of(names.begin(), names.end(), [](const std::string& name) { return !name.empty(); }))
            mesh.cell_labels.push_back({"gmsh:physical_name", std::move(names)});
    }
    if (!in_sequence) mesh.cell_labels.push_back({"gmsh:tag", std::move(cells.tags)});
    if (grouped && !has_field(mesh, "gmsh:physical"))
        mesh.cell_fields.push_back({"gmsh:physical", 1, std::move(cells.physical)});
    const auto all_are = [&](double tag) {
        return std::all_of(cells.geometrical.begin(), cells.geometrical.end(), [&](double t) { return t == tag; });
    };
    if (!has_field(mesh, "gmsh:geometrical") && !all_are(1) && !all_are(0))
        mesh.cell_fields.push_back({"gmsh:geometrical", 1, std::move(cells.geometrical)});
}

}  // namespace barycert::io
