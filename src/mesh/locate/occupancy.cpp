#include "mesh/locate/occupancy.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "barycert/simplex.hpp"
#include "core/numerators-inl.hpp"
#include "mesh/index/bins.hpp"
#include "mesh/index/cell_index.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::locate {
namespace {

namespace formulas = core::HWY_NAMESPACE;

// A clear bit must be a proof.
//
// Let t(x) = (x / 2 - half_low) * scale, with the doubles of the quantizer and exact arithmetic, and u = t * 2^-shift,
// so that bin b of an axis is about b <= u < b + 1. For x in the box the quantizer rounds the difference and the
// product: t <= 2^31 is off by less than 2^-20, hence u by less than 2^-30, as shift >= 11. (Where halving x
// underflows, that is nothing beside half the length of the box, at least 2^-900 here.) The clamp at `max` moves t no
// further. Cutting off t and then its last bits is cutting off u. So a point whose bin is b has b - 2^-30 <= u <= b + 1
// + 2^-30, and the computed u of the corners of cells are off by as much.
//
// u is affine in x: a point of a closed cell has its u in the hull of those of the corners. A half-space that holds the
// computed corners holds the exact ones once it is moved outward by 2^-30 a coordinate. If it then misses the box of a
// bin, moved outward by as much, no point of the cell is in that bin. The half-spaces are those of the cell's box and
// of its facets. `margin` is for all these, and for the roundings of the box.
//
// Rounding errors in the equation of a facet: coordinates are relative to the lowest bin of the cell (off by a further
// 2^-30), so that all are at most E_k + 2 on axis k, E_k the extent of the cell. The equation is a sum of at most 12
// products of such numbers, each with at most 10 roundings: it is off by less than 12 * 10 * 2 * 2^-53 P, P = prod (E_k
// + 2). `slack` is 2^-40 P. A facet whose opposite corner is not clearly on one side bounds nothing.

/// A cell in bins, relative to the lowest one, and the half-spaces of its facets.
template <std::size_t d>
struct BinnedCell {
    static constexpr double margin = 0x1p-10;
    static constexpr double min_half = 0x1p-900;  ///< half the length of the box, on each axis

    std::array<std::array<double, d>, d + 1> corner;
    std::array<int, d> low, count;  ///< bins that its box touches

    struct HalfSpace {
        std::array<double, d> normal;  ///< inward
        double constant;
        double inverse;  ///< of normal[0]; zero if that is too small to bound anything along a row
        /// The greatest of normal.(u - a) over the bins of a row is normal[0] * column + rest.
        double rest(const std::array<int, d>& row) const {
            double sum = constant;
            for (std::size_t k = 1; k < d; ++k) sum += normal[k] * row[k];
            return sum;
        }
    };
    std::array<HalfSpace, d + 1> facet;
    std::size_t facets = 0;

    /// `corner` in bins; `bins`: how many there are on each axis.
    void set(const std::array<int, d>& bins, bool with_facets) {
        double product = 1;
        for (std::size_t k = 0; k < d; ++k) {
            double least = corner[0][k], most = least;
            for (const auto& c : corner) {
                least = std::min(least, c[k]);
                most = std::max(most, c[k]);
            }
            low[k] = std::clamp(static_cast<int>(std::floor(least - margin)), 0, bins[k] - 1);
            count[k] = std::clamp(static_cast<int>(std::floor(most + margin)), 0, bins[k] - 1) - low[k] + 1;
            for (auto& c : corner) c[k] -= low[k];
            product *= most - least + 2;
        }
        facets = 0;
        if (with_facets) set_facets(0x1p-40 * product);
    }

    void set_facets(double slack) {
        for (std::size_t i = 0; i <= d; ++i) {
            const auto &a = corner[(i + 1) % (d + 1)], &b = corner[(i + 2) % (d + 1)];
            double n[d];
            if constexpr (d == 2) {
                n[0] = a[1] - b[1];
                n[1] = b[0] - a[0];
            } else {
                const auto& c = corner[(i + 3) % (d + 1)];
                const double x[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
                const double y[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
                formulas::cross(x, y, n);
            }
            double side = 0;
            for (std::size_t k = 0; k < d; ++k) side += n[k] * (corner[i][k] - a[k]);
            if (!(std::abs(side) > slack)) continue;
            HalfSpace& h = facet[facets++];
            h.constant = slack;
            for (std::size_t k = 0; k < d; ++k) {
                h.normal[k] = side > 0 ? n[k] : -n[k];
                h.constant += h.normal[k] * (0.5 - a[k]) + (0.5 + margin) * std::abs(n[k]);
            }
            // Below 2^-100, times less than 2^21, it is far below the slack.
            h.inverse = std::abs(n[0]) > 0x1p-100 ? 1 / h.normal[0] : 0;
        }
    }

    /// use(first, last) for the bins of a row that the cell may touch, if there are any: columns relative to low[0].
    /// A column is bounded by -rest / normal[0]. Where that is one of the columns, it is off by less than the margin;
    /// where it is not, it is on the right side of them.
    template <class Use>
    void columns(const std::array<int, d>& row, Use use) const {
        double from = 0, to = count[0] - 1;
        for (std::size_t i = 0; i < facets; ++i) {
            const double rest = facet[i].rest(row), inverse = facet[i].inverse, zero = -rest * inverse;
            if (inverse > 0) {
                from = std::max(from, zero - margin);
            } else if (inverse < 0) {
                to = std::min(to, zero + margin);
            } else if (rest < 0) {
                return;
            }
        }
        if (!(from <= to)) return;
        const int first = static_cast<int>(std::ceil(from)), last = static_cast<int>(std::floor(to));
        if (first <= last) use(first, last);
    }
};

/// Bits of the bins of cells.
template <std::size_t d>
class Marks {
public:
    Marks(const CellIndex& index, const std::array<int, 3>& bits, bool with_facets, std::uint32_t* words)
        : index_(index),
          with_facets_(with_facets),
          words_(words),
          words_a_row_(std::size_t{1} << (bits[0] - Occupancy::word_bits)),
          bits_(bits) {
        for (std::size_t k = 0; k < d; ++k) {
            unit_[k] = std::ldexp(1.0, bits[k] - Quantizer::bits);
            bins_[k] = 1 << bits[k];
        }
    }

    void add(std::size_t place) {
        for (std::size_t i = 0; i <= d; ++i) {
            const auto& at = index_.nodes[index_.cells[place].node[i]].at;
            for (std::size_t k = 0; k < d; ++k)
                cell_.corner[i][k] = index_.bins.quantizer().before_rounding(k, at[k]) * unit_[k];
        }
        cell_.set(bins_, with_facets_);
        std::array<int, d> row{};
        const int layers = d == 3 ? cell_.count[d - 1] : 1;
        for (int layer = 0; layer < layers; ++layer) {
            if constexpr (d == 3) row[2] = layer;
            for (row[1] = 0; row[1] < cell_.count[1]; ++row[1])
                cell_.columns(row, [&](int first, int last) {
                    set(row, static_cast<std::size_t>(first + cell_.low[0]),
                        static_cast<std::size_t>(last + cell_.low[0]));
                });
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
    // Other threads wait for this in a lock, so this thread may take up nothing else here.
    base::isolated([&] {
        base::parallel_for(index.cell_count(), 2048, [&](std::size_t begin, std::size_t end) {
            Marks<d> marks(index, bits, with_facets, words);
            for (std::size_t place = begin; place < end; ++place) marks.add(place);
        });
    });
}

/// The share of the box that a cell fills.
template <std::size_t d>
double share(const CellIndex& index, std::size_t place) {
    const auto coordinate = [&](std::size_t i, std::size_t k) {
        const auto& at = index.nodes[index.cells[place].node[i]].at;
        return index.bins.quantizer().before_rounding(k, at[k]) / static_cast<double>(Quantizer::max);
    };
    double edges[d][d];
    for (std::size_t i = 0; i < d; ++i) {
        for (std::size_t k = 0; k < d; ++k) edges[i][k] = coordinate(i + 1, k) - coordinate(0, k);
    }
    return std::abs(formulas::determinant(edges)) / (d == 2 ? 2 : 6);
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
