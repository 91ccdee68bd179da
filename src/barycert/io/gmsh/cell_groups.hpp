/// The physical groups and entities that the cells of a mesh are written with.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

struct CellGroups {
    std::vector<std::int64_t> tags;                    ///< of elements
    std::vector<std::int32_t> physical;                ///< a cell; empty: none
    std::vector<std::int32_t> entity;                  ///< a cell; empty: 1
    std::map<std::int32_t, std::int32_t> physical_of;  ///< of each entity, 0 for none; `by_entity` alone
    std::map<std::int32_t, std::string> names;         ///< of physical groups
    std::vector<const Field*> data;                    ///< the cell fields that are written as such

    std::int32_t entity_of(std::size_t cell) const { return entity.empty() ? 1 : entity[cell]; }
    std::int32_t group_of(std::size_t cell) const { return physical.empty() ? 0 : physical[cell]; }
};

/// `by_entity`: an entity can be in one group only (4.1). Error: one group with two names.
Result<CellGroups> group_cells(const Mesh& mesh, bool by_entity, const std::string& path);

}  // namespace barycert::io
