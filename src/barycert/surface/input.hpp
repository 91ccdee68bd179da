/// What cuts require of their input, as Errors.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/surface.hpp"

namespace barycert::surface {

/// The mesh has whole nodes and cells, finite coordinates and the dimension; 0: any. Indices of cells are left to those
/// who read them: a pass over them takes a fifth of the time of a cut. On all threads of the calling arena.
Status check_mesh(const Mesh& mesh, int dimension);

/// All of these are nodes.
inline bool indices_fit(std::span<const Mesh::Index> indices, std::size_t nodes) {
    std::uint32_t max = 0;  // a negative index is a large one
    for (const Mesh::Index i : indices) max = std::max(max, static_cast<std::uint32_t>(i));
    return indices.empty() || max < nodes;
}

/// What to tell where they are not.
Error bad_index();

/// The field has `rows` rows; `of` as in "node".
Status check_field(const Field* field, std::size_t rows, const char* of);

/// Those to be carried along.
Status check_options(const Mesh& mesh, const CutOptions& options);

}  // namespace barycert::surface
