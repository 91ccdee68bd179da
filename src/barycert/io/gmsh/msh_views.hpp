/// $NodeData and $ElementData: fields, and their steps in time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "barycert/io/gmsh/msh_file.hpp"
#include "barycert/io/gmsh/rows.hpp"
#include "barycert/io/gmsh/tag_index.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

/// The header of one section.
struct MshView {
    enum class Of : std::uint8_t { nodes, elements, element_nodes };
    Of of = Of::nodes;
    const MshSection* section = nullptr;
    std::string name;
    bool interpolated = false;  ///< names an interpolation scheme
    double time = 0;
    std::int64_t step = 0;
    int components = 1;
    Run rows;  ///< of element_nodes: not set
};

/// All such sections, in the order of the file. Error: what the grammar does not have.
Result<std::vector<MshView>> find_msh_views(const MshFile& file);

/// What views are about.
struct ViewTargets {
    const TagIndex& index;
    std::size_t count;  ///< of nodes or cells
    const char* one;    ///< "node"
    const char* many;   ///< "nodes"
};

/// Appends one field for each name among the views `of` nodes or elements, and tells in `notes` what is missing.
/// `step`: of each field; not set: its first.
Status read_msh_fields(const MshFile& file, const std::vector<MshView>& views, MshView::Of of,
                       const ViewTargets& targets, std::optional<std::int64_t> step, std::vector<Field>& fields,
                       Notes& notes);

}  // namespace barycert::io
