#include "mesh/locate/cell_signs.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "barycert/predicates.hpp"
#include "barycert/simplex.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/pulling.hpp"

namespace barycert::locate {
namespace {

/// Bit i: all vertices but i share a coordinate with the point. That is asked of the bits: where subnormal numbers are
/// flushed, numbers may compare equal that are not.
template <Simplex s>
unsigned facets_along_axes(const CellIndex& index, const CellRecord& cell, const double* p) {
    unsigned found = 0;
    for (std::size_t k = 0; k < space_dimension(s); ++k) {
        unsigned other = 0;
        for (std::size_t i = 0; i < vertex_count(s); ++i) {
            const double v = index.nodes[cell.node[i]].at[k];
            other |= (std::bit_cast<std::uint64_t>(v) == std::bit_cast<std::uint64_t>(p[k]) ? 0U : 1U) << i;
        }
        found |= std::has_single_bit(other) ? other : 0;
    }
    return found;
}

template <Simplex s>
std::optional<WeightSigns> filtered(const CellIndex& index, const CellRecord& cell, const double* p) {
    const CellAtPoint<s> at(index, cell, p);
    const double denominator = at.weights.denominator;
    if (!at.in_range || !(std::abs(denominator) > at.denominator_error())) return std::nullopt;
    const unsigned zeros = facets_along_axes<s>(index, cell, p);
    unsigned bits = denominator < 0 ? 0x100 : 0;
    for (unsigned i = 0; i < vertex_count(s); ++i) {
        const double numerator = at.weights.numerator[i];
        if ((zeros >> i & 1) != 0) {
            bits |= 0x10U << i;
        } else if (std::abs(numerator) > at.numerator_error()) {
            bits |= ((numerator < 0) != (denominator < 0) ? 1U : 0U) << i;
        } else {
            return std::nullopt;
        }
    }
    return WeightSigns(static_cast<WeightSigns::Bits>(bits));
}

}  // namespace

WeightSigns cell_signs(const CellIndex& index, Place cell, const double* point, TierCounts& tiers) {
    const CellRecord& record = index.cells[cell];
    const auto certain = index.simplex == Simplex::triangle ? filtered<Simplex::triangle>(index, record, point)
                                                            : filtered<Simplex::tetrahedron>(index, record, point);
    // All numbers are finite: there is no Error.
    if (!certain) return weight_signs(index.simplex, vertices_of(index, cell).data(), point, &tiers);
    tiers.add(Tier::filter);
    return *certain;
}

Feature feature_of(const CellIndex& index, Place cell, WeightSigns signs) {
    if (index.inside == nullptr || signs.region() != Region::boundary) return signs.feature(index.simplex);
    const auto original = static_cast<std::size_t>(index.original[cell]);
    return mesh::feature_of_whole(index.inside[original], signs.bits() >> 4U & 0xfU,
                                  static_cast<int>(index.dimension()));
}

}  // namespace barycert::locate
