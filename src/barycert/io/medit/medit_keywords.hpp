/// The keywords of Medit's files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace barycert::io {

enum class MeditKind : std::uint8_t {
    other,
    vertices,
    cells,
    solution,  ///< fields of nodes (dimension 0), triangles (2) or tetrahedra (3)
};

struct MeditKeyword {
    int code;  ///< in binary files
    std::string_view name;
    MeditKind kind = MeditKind::other;
    int dimension = 0;
    std::size_t nodes = 0;  ///< of a cell
};

/// nullptr if it is not known. Names are in any case.
const MeditKeyword* medit_keyword(std::string_view name);
const MeditKeyword* medit_keyword(std::int64_t code);

}  // namespace barycert::io
