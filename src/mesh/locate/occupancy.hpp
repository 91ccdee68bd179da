/// Where a mesh surely has no cell.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/index/bins.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/locate/names.hpp"

namespace barycert::locate {

/// The box of a mesh cut into bins, a bit each: clear if no closed cell of non-zero volume has a point there. So a
/// point of the box whose bit is clear is outside, exactly; one whose bit is set may be outside all the same.
///
/// The bin of a point is that of its coordinates in whole numbers of the quantizer (Bins), without their last bits.
class Occupancy {
public:
    static constexpr int word_bits = 5;  ///< of them, bins along the first axis make a word
    /// An occupancy of fewer cells is as large, and takes as long to make, as one of so many.
    static constexpr std::size_t least_cells = 64;

    /// How much it tells: `coarse`, from the boxes of cells alone, with bins about as large as cells; `fine`, with far
    /// smaller ones if there are not too many cells, which takes five to ten times as long.
    enum class Detail : std::uint8_t { coarse, fine };

    /// `filled`: filled_share(index), below 1. On the threads of the calling arena.
    Occupancy(const CellIndex& index, double filled, Detail detail);

    int bits(std::size_t k) const { return bits_[k]; }
    const std::uint32_t* words() const { return words_.data(); }
    std::size_t bytes() const { return words_.size() * sizeof(std::uint32_t); }

    /// False: no cell holds the point. Requires: the point lies in the box of the cells.
    bool may_hold(const CellIndex& index, const double* point) const {
        const auto at = [&](std::size_t k) {
            return static_cast<std::size_t>(index.bins.quantizer().at(k, point[k]) >> (Quantizer::bits - bits_[k]));
        };
        std::size_t row = 0;
        for (std::size_t k = index.dimension() - 1; k > 0; --k) row = row << bits_[k] | at(k);
        const std::size_t bin = row << bits_[0] | at(0);
        return (words_[bin >> word_bits] >> (bin & ((1U << word_bits) - 1)) & 1) != 0;
    }

private:
    std::array<int, 3> bits_{};
    std::vector<std::uint32_t> words_;
};

/// The share of the box of all cells that these fill, estimated from some of them. 1 or more as well where no Occupancy
/// can be made, because there is no cell or the box is flat or too small.
double filled_share(const CellIndex& index);

}  // namespace barycert::locate
