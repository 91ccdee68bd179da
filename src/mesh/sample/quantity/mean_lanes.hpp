/// Means over the cells of many nodes at once, on SIMD lanes: correctly rounded where that is certain.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "barycert/mesh.hpp"
#include "core/base/lists.hpp"

namespace barycert::sample {

/// d! times the volume of a cell without its sign (area in the plane): high + low, off by at most error.
struct CellVolume {
    double high, low;
    double error;  ///< infinite where nothing is known
};

/// The volumes of cells [first, first + count) to out[0] to out[count - 1].
void volume_lanes(const Mesh& mesh, std::size_t first, std::size_t count, CellVolume* out);

/// Data from which means are computed.
struct MeanInput {
    const base::Lists<Mesh::Index>& cells;  ///< of each node
    std::span<const CellVolume> volumes;    ///< of all cells
    std::span<const double> values;         ///< of all cells, `components` each
    std::size_t components;
};

/// The means at nodes [first, first + count) to out[0] to out[count * components - 1]. Returns how many nodes are
/// undecided, these, as i of first + i, in undecided[0 ...], ascending; their means are unspecified.
std::size_t mean_lanes(const MeanInput& input, std::size_t first, std::size_t count, double* out,
                       std::uint32_t* undecided);

}  // namespace barycert::sample
