/// $Elements: which there are, and where.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "barycert/io/gmsh/element_type.hpp"
#include "barycert/io/gmsh/msh_file.hpp"
#include "barycert/io/gmsh/rows.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

/// Elements of one type, one after the other.
struct ElementBlock {
    const ElementType* type = nullptr;
    std::int64_t entity = 0;  ///< 4.x
    std::size_t tags = 0;     ///< of an element; binary 2.x
    std::size_t first = 0;    ///< its first element among all of the file
    Run run;                  ///< `first` and `id` are not set
};

struct MshElements {
    std::vector<ElementBlock> blocks;
    TypeCounts counts{};
    std::size_t count = 0;
};

/// Looks at headers, in 2.x at the types of the elements. Error: what the grammar does not have, unknown types.
Result<MshElements> find_msh_elements(const MshFile& file);

}  // namespace barycert::io
