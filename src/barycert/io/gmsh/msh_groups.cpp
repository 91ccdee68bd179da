// $PhysicalNames, always text: count, lines: dimension tag "name"
//
// $Entities: four counts (points, curves, surfaces, volumes), then a row for each:
//     tag, x y z of a point or (all others, and in 4.0 points too) two corners of a box, groups count, group...;
//     but for points also: boundaries count, boundary...
// $PartitionedEntities, 4.1: partitions count, ghosts count, rows: ghost partition; four counts; rows as above, with
//     parent-dimension parent-tag, partitions count, partition... after the tag.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>

#include "barycert/io/gmsh/msh_parts.hpp"

namespace barycert::io {
namespace {

void read_names(const MshFile& file, const MshSection& section, MshGroups& groups) {
    constexpr const char* name_line = "a line: dimension tag \"name\"";
    Walk walk(file, section, true, "bad line in");
    const auto refuse_at = [&](const char* at) {
        walk.move_to(at);
        walk.refuse_word(name_line, word_at(at, walk.end()));
    };
    const std::int64_t count = walk.integer(name_line);
    if (count < 0) refuse_at(section.body.data());
    walk.line();
    for (std::int64_t i = 0; i < count; ++i) {
        const char* const start = walk.at();
        const std::int64_t dimension = walk.integer(name_line), tag = walk.integer(name_line);
        const std::string_view rest = walk.line();
        const std::size_t first = rest.find('"'), last = rest.rfind('"');
        if (first == std::string_view::npos || first == last) refuse_at(start);
        groups.names[{dimension, tag}] = std::string(rest.substr(first + 1, last - first - 1));
    }
}

std::vector<std::int64_t> take_integers(Walk& walk, const char* count_name, const char* name) {
    std::vector<std::int64_t> values;
    for (std::int64_t left = walk.size(count_name); left > 0; --left) values.push_back(walk.integer(name));
    return values;
}

/// One row. `parts`: of $PartitionedEntities.
void take_entity(Walk& walk, std::int64_t dimension, int reals, bool parts, MshGroups& groups) {
    const std::int64_t tag = walk.integer("the tag of an entity");
    MshEntity entity{{}, tag};
    if (parts) {
        const std::int64_t whole_dimension = walk.integer("the dimension of an entity");
        const std::int64_t whole = walk.integer("the tag of an entity");
        take_integers(walk, "the number of partitions", "a partition");
        if (whole_dimension == dimension) entity.whole = whole;
    }
    for (int i = 0; i < reals; ++i) walk.real("a coordinate");
    entity.physical = take_integers(walk, "the number of physical groups", "the tag of a physical group");
    if (dimension > 0) take_integers(walk, "the number of boundaries", "the tag of an entity");
    if (!entity.physical.empty() || entity.whole != tag) groups.entities[{dimension, tag}] = std::move(entity);
}

/// `parts`: of $PartitionedEntities.
void take_entities(const MshFile& file, const MshSection& section, bool parts, MshGroups& groups) {
    Walk walk(file, section);
    if (parts) {
        walk.size("the number of partitions");
        for (std::int64_t ghosts = walk.size("the number of ghost entities"); ghosts-- > 0;) {
            walk.integer("the tag of an entity");
            walk.integer("a partition");
        }
        groups.partitioned = true;
    }
    std::array<std::int64_t, 4> counts{};
    for (std::int64_t& count : counts) count = walk.size("the number of entities");
    for (std::int64_t dimension = 0; dimension < 4; ++dimension) {
        const int reals = dimension == 0 && file.version() == 41 ? 3 : 6;
        for (std::int64_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i)
            take_entity(walk, dimension, reals, parts, groups);
    }
    walk.need_end();
}

/// The tag of an entity: 1, or 0 for none, throughout says nothing.
bool says_something(std::int64_t tag, std::int64_t first) {
    return tag != first || (tag != 0 && tag != 1);
}

/// 4.x: groups of cells by way of their entities. Nothing is filled in that would say nothing.
void fill_from_entities(const MshFile& file, const MshElements& elements, const MshGroups& groups, MshCells& cells) {
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
        const auto found = groups.entities.find({cells.mesh.dimension, block.entity});
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
    cells.mesh.notes.push_back({Note::Kind::left_out,
                                "further physical groups of " + std::to_string(in_several.size()) +
                                    " entities, the first being " + std::to_string(*in_several.begin()) +
                                    ": gmsh:physical has the first group of each cell",
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
            const auto found = groups.names.find({cells.mesh.dimension, static_cast<std::int64_t>(std::fabs(tag))});
            name = found == groups.names.end() ? &nothing : &found->second;
            last = tag;
        }
        names.push_back(*name);
    }
    return names;
}

}  // namespace

MshGroups read_msh_groups(const MshFile& file) {
    MshGroups groups;
    if (const MshSection* const names = file.find("PhysicalNames"); names != nullptr) read_names(file, *names, groups);
    if (const MshSection* const entities = file.find("Entities"); entities != nullptr && file.version() != 22)
        take_entities(file, *entities, false, groups);
    if (const MshSection* const parts = file.find("PartitionedEntities"); parts != nullptr && file.version() == 41)
        take_entities(file, *parts, true, groups);
    return groups;
}

void label_cells(const MshFile& file, const MshElements& elements, const MshGroups& groups, MshCells& cells) {
    Mesh& mesh = cells.mesh;
    if (file.version() == 22) {
        drop_what_says_nothing(cells);
    } else {
        fill_from_entities(file, elements, groups, cells);
    }
    bool in_sequence = true;
    for (std::size_t i = 0; i < cells.tags.size() && in_sequence; ++i)
        in_sequence = cells.tags[i] == std::int64_t{mesh.cell_number(static_cast<Mesh::Index>(i))} + 1;
    if (!cells.physical.empty()) {
        std::vector<std::string> names = group_names(cells, groups);
        if (std::any_of(names.begin(), names.end(), [](const std::string& name) { return !name.empty(); }))
            mesh.cell_labels.push_back({"gmsh:physical_name", std::move(names)});
    }
    if (!in_sequence) mesh.cell_labels.push_back({"gmsh:tag", std::move(cells.tags)});
    const auto add_field = [&](const char* name, std::vector<double>& tags) {
        const bool there = std::ranges::find(mesh.cell_fields, name, &Field::name) != mesh.cell_fields.end();
        if (!tags.empty() && !there) mesh.cell_fields.push_back({name, 1, std::move(tags)});
    };
    add_field("gmsh:physical", cells.physical);
    add_field("gmsh:geometrical", cells.geometrical);
}

}  // namespace barycert::io
