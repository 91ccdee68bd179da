/// What cuts and boundaries share: threads, what they require of their input, orientations, cells cut, fields of cells.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "barycert/base/large_pages.hpp"
#include "barycert/mesh.hpp"
#include "barycert/predicates.hpp"
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

/// Those to be carried along.
Status check_options(const Mesh& mesh, const CutOptions& options);

/// Copies the fields of cells to the cells of the surface, by mesh_cells.
inline void carry_cell_fields(const CutOptions& options, Surface& surface) {
    for (const Field* const field : options.cell_fields) {
        Field& to = surface.cell_fields.emplace_back(Field{field->name, field->components, {}});
        const auto components = static_cast<std::size_t>(field->components);
        base::resize_large(to.data, components * surface.mesh_cells.size());
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, surface.mesh_cells.size(), 4096), [&](const auto& range) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                const auto cell = static_cast<std::size_t>(surface.mesh_cells[i]);
                std::copy_n(field->data.data() + components * cell, components, to.data.data() + components * i);
            }
        });
    }
}

/// Of the cell with these corners: exact.
inline Sign orientation(const Mesh& mesh, const Mesh::Index* corners) {
    const auto at = [&](int i) {
        return mesh.points.data() + static_cast<std::size_t>(mesh.dimension) * static_cast<std::size_t>(corners[i]);
    };
    return mesh.dimension == 2 ? orient2d(at(0), at(1), at(2)) : orient3d(at(0), at(1), at(2), at(3));
}

/// Orientations that cells of zero volume take from their neighbours: cells on both sides of a facet see its corners
/// turn in opposite ways. It is made only where there are such cells, for it needs the neighbours of all.
class FlatCells {
public:
    explicit FlatCells(const Mesh& mesh);

    /// 1 or -1; 0 if a corner is there twice: then its facets come in equal pairs, turned in opposite ways, and the
    /// surface is whole without it. Cells of zero volume that are connected take the orientation of the first cell with
    /// volume that is met from the first of them that was asked for; if there is none, that one is taken for positive.
    int sign(Mesh::Index cell);

private:
    void settle(Mesh::Index cell);

    const Mesh& mesh_;
    std::vector<Mesh::Index> neighbours_;
    std::vector<std::int8_t> sign_;  ///< of each cell; `not_asked` at first
};

/// Sets cells, mesh_cells and mesh_edges of the surface, and the counts of cells and points, from the State of each
/// node. On all threads of the calling arena. Error: a corner of a cell that is no node; more points or triangles than
/// indices can number.
Status cut_cells(const Mesh& mesh, const std::vector<std::uint8_t>& states, Surface& surface, CutCounts& counts);

}  // namespace barycert::surface
