// $PhysicalNames, always text: count, lines: dimension tag "name"
//
// $Entities: four counts (points, curves, surfaces, volumes), then a row for each:
//     tag, x y z of a point or (all others, and in 4.0 points too) two corners of a box, groups count, group...;
//     but for points also: boundaries count, boundary...
// $PartitionedEntities, 4.1: partitions count, ghosts count, rows: ghost partition; four counts; rows as above, with
//     parent-dimension parent-tag, partitions count, partition... after the tag.
#include <array>
#include <string_view>

#include "barycert/io/gmsh/msh_parts.hpp"

namespace barycert::io {
namespace {

constexpr const char* name_line = "a line: dimension tag \"name\"";

Status read_names(const MshFile& file, const MshSection& section, MshGroups& groups) {
    Walk walk(file, section, true);
    std::int64_t count = 0;
    const char* start = walk.at();
    const auto bad = [&] {
        return file.error_at(start, "bad line in $PhysicalNames", name_line, word_at(start, walk.end()));
    };
    if (!walk.size(count, "")) return bad();
    walk.line();
    for (std::int64_t i = 0; i < count; ++i) {
        start = walk.at();
        std::int64_t dimension = 0, tag = 0;
        if (!walk.integer(dimension, "") || !walk.integer(tag, "")) return bad();
        const std::string_view rest = walk.line();
        const std::size_t first = rest.find('"'), last = rest.rfind('"');
        if (first == std::string_view::npos || first == last) return bad();
        groups.names[{dimension, tag}] = std::string(rest.substr(first + 1, last - first - 1));
    }
    return Done{};
}

bool take_integers(Walk& walk, const char* count_name, const char* name, std::vector<std::int64_t>* values) {
    std::int64_t count = 0, value = 0;
    if (!walk.size(count, count_name)) return false;
    for (std::int64_t i = 0; i < count; ++i) {
        if (!walk.integer(value, name)) return false;
        if (values != nullptr) values->push_back(value);
    }
    return true;
}

/// One row. `parts`: of $PartitionedEntities.
bool take_entity(Walk& walk, std::int64_t dimension, int reals, bool parts, MshGroups& groups) {
    std::int64_t tag = 0, whole_dimension = 0;
    MshEntity entity;
    if (!walk.integer(tag, "the tag of an entity")) return false;
    entity.whole = tag;
    if (parts) {
        std::int64_t whole = 0;
        if (!walk.integer(whole_dimension, "the dimension of an entity") ||
            !walk.integer(whole, "the tag of an entity") ||
            !take_integers(walk, "the number of partitions", "a partition", nullptr)) {
            return false;
        }
        if (whole_dimension == dimension) entity.whole = whole;
    }
    double ignored = 0;
    for (int i = 0; i < reals; ++i) {
        if (!walk.real(ignored, "a coordinate")) return false;
    }
    if (!take_integers(walk, "the number of physical groups", "the tag of a physical group", &entity.physical))
        return false;
    if (dimension > 0 && !take_integers(walk, "the number of boundaries", "the tag of an entity", nullptr))
        return false;
    if (!entity.physical.empty() || entity.whole != tag) groups.entities[{dimension, tag}] = std::move(entity);
    return true;
}

bool take_entities(Walk& walk, int version, bool parts, MshGroups& groups) {
    std::array<std::int64_t, 4> counts{};
    for (std::int64_t& count : counts) {
        if (!walk.size(count, "the number of entities")) return false;
    }
    for (std::int64_t dimension = 0; dimension < 4; ++dimension) {
        const int reals = dimension == 0 && version == 41 ? 3 : 6;
        for (std::int64_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
            if (!take_entity(walk, dimension, reals, parts, groups)) return false;
        }
    }
    return walk.at_end();
}

bool take_parts(Walk& walk, int version, MshGroups& groups) {
    std::int64_t partitions = 0, ghosts = 0, ignored = 0;
    if (!walk.size(partitions, "the number of partitions") || !walk.size(ghosts, "the number of ghost entities"))
        return false;
    for (std::int64_t i = 0; i < ghosts; ++i) {
        if (!walk.integer(ignored, "the tag of an entity") || !walk.integer(ignored, "a partition")) return false;
    }
    return take_entities(walk, version, true, groups);
}

}  // namespace

Result<MshGroups> read_msh_groups(const MshFile& file) {
    MshGroups groups;
    if (const MshSection* const names = file.find("PhysicalNames"); names != nullptr) {
        if (Status s = read_names(file, *names, groups); !s) return s.error();
    }
    if (const MshSection* const entities = file.find("Entities"); entities != nullptr && file.version() != 22) {
        Walk walk(file, *entities);
        if (!take_entities(walk, file.version(), false, groups)) return walk.error();
    }
    if (const MshSection* const parts = file.find("PartitionedEntities"); parts != nullptr && file.version() == 41) {
        Walk walk(file, *parts);
        if (!take_parts(walk, file.version(), groups)) return walk.error();
        groups.partitioned = true;
    }
    return groups;
}

}  // namespace barycert::io
