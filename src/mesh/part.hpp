/// Some cells of a mesh as a mesh of their own.
#pragma once

#include <cstddef>
#include <vector>

#include "barycert/mesh.hpp"

namespace barycert::mesh {

/// Appends the rows, of `size` entries, of these numbers.
template <class T>
void append_rows_of(const std::vector<T>& whole, std::size_t size, const std::vector<Mesh::Index>& rows,
                    std::vector<T>& out) {
    out.reserve(out.size() + size * rows.size());
    for (const Mesh::Index row : rows) {
        const T* const from = whole.data() + size * static_cast<std::size_t>(row);
        out.insert(out.end(), from, from + size);
    }
}

/// Leaves those rows and no others; a row may be there several times. An empty array stays so.
template <class T>
void keep_rows(std::vector<T>& values, std::size_t size, const std::vector<Mesh::Index>& rows) {
    std::vector<T> kept;
    if (!values.empty()) append_rows_of(values, size, rows, kept);
    values = std::move(kept);
}

Field rows_of(const Field& whole, const std::vector<Mesh::Index>& rows);

struct Submesh {
    Mesh mesh;                       ///< points, cells and mid-edge nodes alone, in their order; no fields
    std::vector<Mesh::Index> cells;  ///< of the whole mesh, by cell of the part
    std::vector<Mesh::Index> nodes;  ///< likewise
};

/// Requires: `cells` are cells of the mesh, ascending, and the mesh is consistent as far as these are concerned.
Submesh part_of(const Mesh& mesh, std::vector<Mesh::Index> cells);

}  // namespace barycert::mesh
