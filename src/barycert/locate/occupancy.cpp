#include "barycert/locate/occupancy.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "barycert/index/bins.hpp"
#include "barycert/locate/binned_cell.hpp"

namespace barycert::locate {
namespace {

/// Bits of the bins of cells.
template <std::size_t d>
class Marks {
public:
    Marks(const CellIndex& index, const std::array<int, 3>& bits, bool with_facets, std::uint32_t* words)
        : index_(index),
          with_facets_(with_facets),
          words_(words),
          words_a_row_(std::size_t{1} << (bits[0] - Occupancy::word_bits)) {
        for (std::size_t k = 0; k < d; ++k) {
            unit_[k] = std::ldexp(1.0, bits[k] - Quantizer::bits);
            bins_[k] = 1 << bits[k];
        }
        bits_ = bits;
    }

    void add(std::size_t place) {
        BinnedCell<d>& cell = cell_;
        for (std::size_t i = 0; i <= d; ++i) {
            const auto& at = index_.nodes[static_cast<std::size_t>(index_.cells[place].node[i])].at;
            for (std::size_t k = 0; k < d; ++k)
                cell.corner[i][k] = index_.bins.quantizer().before_rounding(k, at[k]) * unit_[k];
        }
        cell.set(bins_, with_facets_);
        std::array<int, d> row{};
        const int layers = d == 3 ? cell.count[d - 1] : 1;
        for (int layer = 0; layer < layers; ++layer) {
            if constexpr (d == 3) row[2] = layer;
            for (row[1] = 0; row[1] < cell.count[1]; ++row[1]) {
                cell.columns(row, [&](int first, int last) {
                    set(row, static_cast<std::size_t>(first + cell.low[0]),
                        static_cast<std::size_t>(last + cell.low[0]));
                });
            }
        }
    }

private:
    void set(const std::array<int, d>& row, std::size_t first, std::size_t last) {
        std::size_t number = 0;
        for (std::size_t k = d - 1; k > 0; --k)
            number = number << bits_[k] | static_cast<std::size_t>(row[k] + cell_.low[k]);
        constexpr std::size_t width = std::size_t{1} << Occupancy::word_bits;
        std::uint32_t* const words = words_ + number * words_a_row_;
        for (std::size_t w = first / width; w <= last / width; ++w) {
            std::uint32_t bits = ~std::uint32_t{0};
            if (w == first / width) bits &= bits << (first % width);
            if (w == last / width) bits &= ~std::uint32_t{0} >> (width - 1 - last % width);
            const std::atomic_ref<std::uint32_t> word(words[w]);
            if ((word.load(std::memory_order_relaxed) & bits) != bits) word.fetch_or(bits, std::memory_order_relaxed);
        }
    }

    const CellIndex& index_;
    bool with_facets_;
    std::uint32_t* words_;
    std::size_t words_a_row_;
    std::array<int, 3> bits_;
    std::array<int, d> bins_;
    std::array<double, d> unit_;
    BinnedCell<d> cell_;
};

template <std::size_t d>
void mark(const CellIndex& index, const std::array<int, 3>& bits, bool with_facets, std::uint32_t* words) {
    // What waits for this, waits in a lock: nothing else may be taken up here.
    tbb::this_task_arena::isolate([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, index.cell_count(), 2048), [&](const auto& range) {
            Marks<d> marks(index, bits, with_facets, words);
            for (std::size_t place = range.begin(); place < range.end(); ++place) marks.add(place);
        });
    });
}

/// The share of the box that a cell fills.
template <std::size_t d>
double share(const CellIndex& index, std::size_t place) {
    std::array<std::array<double, d>, d + 1> v;
    for (std::size_t i = 0; i <= d; ++i) {
        const auto& at = index.nodes[static_cast<std::size_t>(index.cells[place].node[i])].at;
        for (std::size_t k = 0; k < d; ++k)
            v[i][k] = index.bins.quantizer().before_rounding(k, at[k]) / static_cast<double>(Quantizer::max);
    }
    for (std::size_t i = 1; i <= d; ++i) {
        for (std::size_t k = 0; k < d; ++k) v[i][k] -= v[0][k];
    }
    if constexpr (d == 2) return std::abs(v[1][0] * v[2][1] - v[1][1] * v[2][0]) / 2;
    return std::abs(v[1][0] * (v[2][1] * v[3][d - 1] - v[2][d - 1] * v[3][1]) +
                    v[1][1] * (v[2][d - 1] * v[3][0] - v[2][0] * v[3][d - 1]) +
                    v[1][d - 1] * (v[2][0] * v[3][1] - v[2][1] * v[3][0])) /
           6;
}

}  // namespace

Occupancy::Occupancy(const CellIndex& index, double filled, Detail detail) {
    constexpr std::size_t bins_a_cell = 64, few_cells = std::size_t{1} << 20, max_bins_a_cell = 8;
    const std::size_t cells = index.cell_count(), max = std::max(few_cells, max_bins_a_cell * cells);
    const bool fine = detail == Detail::fine;
    std::size_t bins = std::min(max, bins_a_cell * std::max(least_cells, cells));
    // Cells that fill next to nothing of their boxes do not make the coarse one finer than the fine one.
    if (!fine)
        bins = static_cast<std::size_t>(std::min(static_cast<double>(cells) / filled, static_cast<double>(bins)));
    for (const std::size_t axis : index::halved_axes(index.dimension(), index.low.data(), index.high.data(), bins))
        ++bits_[axis];
    bits_[0] = std::max(bits_[0], word_bits);
    const auto all = static_cast<std::size_t>(bits_[0] + bits_[1] + bits_[2]);
    words_.assign(std::size_t{1} << (all - word_bits), 0);
    index.simplex == Simplex::triangle ? mark<2>(index, bits_, fine, words_.data())
                                       : mark<3>(index, bits_, fine, words_.data());
}

double filled_share(const CellIndex& index) {
    if (index.cell_count() == 0) return 1;
    for (std::size_t k = 0; k < index.dimension(); ++k) {
        if (!(index.high[k] * 0.5 - index.low[k] * 0.5 >= BinnedCell<3>::min_half)) return 1;
    }
    constexpr std::size_t max_asked = 4096;
    const std::size_t cells = index.cell_count(), asked = std::min(cells, max_asked);
    double filled = 0;
    for (std::size_t i = 0; i < asked; ++i) {
        const std::size_t place = i * cells / asked;
        filled += index.simplex == Simplex::triangle ? share<2>(index, place) : share<3>(index, place);
    }
    return filled * static_cast<double>(cells) / static_cast<double>(asked);
}

}  // namespace barycert::locate
