/// $PhysicalNames, $Entities and $PartitionedEntities: what entities belong to.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "barycert/io/gmsh/msh_file.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

/// An entity or a physical group: its dimension and its tag.
using GmshKey = std::pair<std::int64_t, std::int64_t>;

struct MshEntity {
    std::vector<std::int64_t> physical;  ///< tags of groups, as in the file: negative where turned around
    std::int64_t whole = 0;              ///< the entity that it is a part of, or itself
};

struct MshGroups {
    std::map<GmshKey, std::string> names;   ///< of physical groups
    std::map<GmshKey, MshEntity> entities;  ///< 4.x; those that are in a group or a part of another
    bool partitioned = false;               ///< there are parts of entities
};

Result<MshGroups> read_msh_groups(const MshFile& file);

}  // namespace barycert::io
