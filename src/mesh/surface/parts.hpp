/// Steps that cuts and boundaries share: threads, what they require of their input, orientations, cells cut, crossings,
/// fields of cells.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/mesh.hpp"
#include "barycert/predicates.hpp"
#include "barycert/result.hpp"
#include "barycert/surface.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::surface {

/// The mesh has whole nodes and cells, finite coordinates and the dimension (0: any), and the fields to be carried
/// along fit it. Indices of cells are left to those who read them: a pass over them takes a fifth of the time of a cut.
/// On all threads of the calling arena.
Status check_input(const Mesh& mesh, int dimension, const CutOptions& options);

/// All of these are nodes.
inline bool indices_fit(std::span<const Mesh::Index> indices, std::size_t nodes) {
    std::uint32_t max = 0;  // a negative index is a large one
    for (const Mesh::Index i : indices) max = std::max(max, static_cast<std::uint32_t>(i));
    return indices.empty() || max < nodes;
}

/// The error for indices that are no nodes.
Error bad_index();

/// Returns work(), which returns a Result, if the input is good: on base::threads_of(options.threads), in an exact
/// environment.
template <class Work>
auto on_good_input(const Mesh& mesh, int dimension, const CutOptions& options, Work&& work) {
    const ExactEnvironment environment;
    return base::in_arena(options.threads, mesh.cells.size(), [&]() -> decltype(work()) {
        if (Status good = check_input(mesh, dimension, options); !good) return good.error();
        return work();
    });
}

/// Rows or cells that a task takes at a time.
inline constexpr std::size_t grain = 4096;

/// Rows rows[0], rows[stride], rows[2 * stride] ... of an array of so many columns.
std::vector<double> take_rows(const std::vector<double>& from, std::size_t columns,
                              const std::vector<Mesh::Index>& rows, std::size_t stride);

/// The same rows of each field are added to `to`.
void take_rows(const std::vector<const Field*>& fields, const std::vector<Mesh::Index>& rows, std::size_t stride,
               std::vector<Field>& to);

/// The orientation of the cell with these corners: exact.
inline Sign orientation(const Mesh& mesh, const Mesh::Index* corners) {
    const auto at = [&](int i) { return mesh.point(corners[i]); };
    return mesh.dimension == 2 ? orient2d(at(0), at(1), at(2)) : orient3d(at(0), at(1), at(2), at(3));
}

/// The State of each node.
struct States {
    std::vector<std::uint8_t> of;
    std::vector<std::uint64_t> in_set;  ///< bit 0 of each state, 64 nodes a word, the lowest first
    bool all_known = true;
};

/// Returned by mixed_cells if a corner is no node.
inline constexpr std::size_t no_node = ~std::size_t{0};

/// Which of `count` < 2^32 cells of n corners have corners in the set and corners that are not, ascending in
/// out[0 ...]; returns how many. All of them where the state of some node is unknown.
std::size_t mixed_cells(const Mesh::Index* corners, std::size_t n, std::size_t count, const States& states,
                        std::uint32_t* out);

/// Sets cells, mesh_cells and mesh_edges of the surface, and the counts of cells and points, from the State of each
/// node. On all threads of the calling arena. Error: a corner of a cell that is no node; more points or triangles than
/// indices can number. With `ends`, facets that only one cell has, in the set, and where g is 0 are part of it: there a
/// mesh ends at a plane.
Status cut_cells(const Mesh& mesh, const States& states, bool ends, Surface& surface, CutCounts& counts);

/// slice(), and where the mesh ends at the plane, too: there K2 does not hold. Facets in the plane that one cell alone
/// has are part of it on whichever side the cell is; normals are along that of the plane.
Result<Cut> section(const Mesh& mesh, const Plane& plane, const CutOptions& options);

// The middle tier of crossings, on SIMD lanes, dispatched at run time as those of core/lanes.hpp.

/// Crossings of edges: values[2 c + i][j] is number c at the end of edge j that is in the set (i = 0), or that is not
/// (i = 1). out[components * j + c] is number c where g is zero, correctly rounded where that is certain. Each returns
/// how many edges are undecided, their numbers, ascending, in undecided[0 ...], which has room for `count`.
struct EdgeBlock {
    const double* const* values;
    int components;
    std::size_t count;  ///< any; below 2^32
};

/// g = f - value; f[i][j] is the field at end i of edge j.
std::size_t level_lanes(double value, const double* const* f, const EdgeBlock& edges, double* out,
                        std::uint32_t* undecided);

/// g = offset - normal.x; the first three numbers are the coordinates.
std::size_t plane_lanes(const Plane& plane, const EdgeBlock& edges, double* out, std::uint32_t* undecided);

}  // namespace barycert::surface
