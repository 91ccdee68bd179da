#include <algorithm>
#include <cmath>
#include <set>

#include "barycert/io/gmsh/msh_parts.hpp"

namespace barycert::io {
namespace {

/// The tag of an entity: 1, or 0 for none, throughout says nothing.
bool says_something(std::int64_t tag, std::int64_t first) {
    return tag != first || (tag != 0 && tag != 1);
}

bool has_field(const Mesh& mesh, const char* name) {
    return std::any_of(mesh.cell_fields.begin(), mesh.cell_fields.end(),
                       [&](const Field& field) { return field.name == name; });
}

/// 4.x: groups of cells by way of their entities. Nothing is filled in that would say nothing.
void fill_from_entities(const MshFile& file, const MshElements& elements, const MshGroups& groups, MshCells& cells,
                        Notes& notes) {
    struct Piece {
        std::size_t count;
        std::int64_t physical, whole;
    };
    std::vector<Piece> pieces;
    std::set<std::int64_t> in_several;
    bool grouped = false, any_entity = false;
    for (const ElementBlock& block : elements.blocks) {
        if (cells.left_out[static_cast<std::size_t>(block.type->number)] != 0 || block.run.count == 0) continue;
        Piece piece{block.run.count, 0, block.entity};
        const auto found = groups.entities.find({cells.dimension, block.entity});
        if (found != groups.entities.end()) {
            const std::vector<std::int64_t>& physical = found->second.physical;
            piece.whole = found->second.whole;
            if (!physical.empty()) piece.physical = physical.front();
            if (physical.size() > 1) in_several.insert(block.entity);
        }
        grouped = grouped || piece.physical != 0;
        any_entity = any_entity || says_something(piece.whole, pieces.empty() ? piece.whole : pieces.front().whole);
        pieces.push_back(piece);
    }
    const auto fill = [&](std::vector<double>& values, std::int64_t Piece::*tag) {
        values.reserve(cells.tags.size());
        for (const Piece& piece : pieces) values.insert(values.end(), piece.count, static_cast<double>(piece.*tag));
    };
    if (grouped) fill(cells.physical, &Piece::physical);
    if (any_entity) fill(cells.geometrical, &Piece::whole);
    if (in_several.empty()) return;
    notes.push_back({Note::Kind::left_out,
                     "further physical groups of " + std::to_string(in_several.size()) + " entities, the first being " +
                         std::to_string(*in_several.begin()) + ": gmsh:physical has the first group of each cell",
                     file.path(), true});
}

/// 2.x: the same for what was read with each cell.
void drop_what_says_nothing(MshCells& cells) {
    if (std::all_of(cells.physical.begin(), cells.physical.end(), [](double tag) { return tag == 0; }))
        cells.physical.clear();
    const std::vector<double>& tags = cells.geometrical;
    const bool any = std::any_of(tags.begin(), tags.end(), [&](double tag) {
        return says_something(static_cast<std::int64_t>(tag), static_cast<std::int64_t>(tags.front()));
    });
    if (!any) cells.geometrical.clear();
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
    if (!others.empty())
        notes.push_back(
            {Note::Kind::left_out,
             "elements of a lower dimension: " + others + (cells.apart ? "; some have nodes that no cell has" : ""),
             path, cells.apart});
    if (cells.repeated != 0)
        notes.push_back({Note::Kind::left_out,
                         std::to_string(cells.repeated) +
                             " elements that repeat the one before them for a further physical group: gmsh:physical "
                             "has the first group of each cell",
                         path, true});
    if (cells.unused_nodes != 0)
        notes.push_back({Note::Kind::left_out,
                         std::to_string(cells.unused_nodes) +
                             " nodes of no cell: no value is taken from them; all nodes keep their numbers",
                         path});
    if (cells.partitioned || groups.partitioned)
        notes.push_back({Note::Kind::left_out, "partitions of the mesh: it is read as one", path});
}

void label_cells(const MshFile& file, const MshElements& elements, MshCells cells, const MshGroups& groups,
                 Mesh& mesh) {
    if (file.version() == 22) {
        drop_what_says_nothing(cells);
    } else {
        fill_from_entities(file, elements, groups, cells, mesh.notes);
    }
    const bool grouped = !cells.physical.empty();
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
    if (!cells.geometrical.empty() && !has_field(mesh, "gmsh:geometrical"))
        mesh.cell_fields.push_back({"gmsh:geometrical", 1, std::move(cells.geometrical)});
}

}  // namespace barycert::io
