#include "barycert/gradient.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "barycert/core/blocks.hpp"
#include "barycert/core/gradient_exact.hpp"
#include "barycert/core/gradient_lanes.hpp"
#include "barycert/environment.hpp"

namespace barycert {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Status check_simplex(Simplex s) {
    if (s == Simplex::triangle || s == Simplex::tetrahedron) return Done{};
    return Error{.what = "gradient in a simplex that does not fill its space",
                 .expected = "triangle or tetrahedron",
                 .found = std::string(name(s))};
}

/// What the last tier found of a cell.
struct Found {
    bool degenerate = false, finite = true;
};

/// Gradients of the last tier in the cell at `vertices`, of which out(c, k) is component k of field component c, whose
/// value at vertex i is value(c, i). Precondition: coordinates finite.
template <class ValueAt, class Out>
Found exact_gradients(Simplex s, const double* vertices, int components, ValueAt value, Out out) {
    const int n = vertex_count(s), d = space_dimension(s);
    Found found;
    for (int c = 0; c < components; ++c) {
        double f[4] = {}, g[3];
        for (int i = 0; i < n; ++i) f[i] = value(c, i);
        const bool usable = all_finite(f, n);
        if (!usable) std::fill_n(f, n, 0.0);  // whether the cell is degenerate is still to be told
        found.degenerate = !exact_gradient(s, vertices, f, g);
        found.finite = found.finite && usable;
        for (int k = 0; k < d; ++k) out(c, k) = usable ? g[k] : nan;
    }
    return found;
}

/// Blocks of cells in structure of arrays, gathered from a mesh, and room for their gradients.
class CellBlocks {
public:
    CellBlocks(Simplex s, std::span<const double> nodes, std::span<const std::int32_t> corners,
               const NodalValues<double>& values)
        : nodes_(nodes),
          corners_(corners),
          values_(values),
          n_(static_cast<std::size_t>(vertex_count(s))),
          d_(static_cast<std::size_t>(space_dimension(s))),
          components_(static_cast<std::size_t>(values.components)),
          rows_(n_ * d_ + n_ * components_ + d_ * components_),
          buffer_(rows_.size() * block_stride) {
        for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i] = buffer_.data() + i * block_stride;
    }

    /// Cells [first, first + count).
    void gather(std::size_t first, std::size_t count) {
        for (std::size_t j = 0; j < count; ++j) {
            const std::int32_t* const corners = corners_.data() + n_ * (first + j);
            for (std::size_t i = 0; i < n_; ++i) {
                const auto node = static_cast<std::size_t>(corners[i]);
                for (std::size_t k = 0; k < d_; ++k) rows_[d_ * i + k][j] = nodes_[d_ * node + k];
                for (std::size_t c = 0; c < components_; ++c)
                    values()[n_ * c + i][j] = values_.data[components_ * node + c];
            }
        }
    }

    double* const* vertices() const { return rows_.data(); }
    double* const* values() const { return rows_.data() + n_ * d_; }
    double* const* gradients() const { return rows_.data() + n_ * (d_ + components_); }

private:
    std::span<const double> nodes_;
    std::span<const std::int32_t> corners_;
    NodalValues<double> values_;
    std::size_t n_, d_, components_;
    std::vector<double*> rows_;
    std::vector<double> buffer_;
};

Status check_cells(Simplex s, std::size_t corners, int components, std::size_t places) {
    if (Status known = check_simplex(s); !known) return known;
    const auto n = static_cast<std::size_t>(vertex_count(s)), d = static_cast<std::size_t>(space_dimension(s));
    if (components < 1)
        return Error{.what = "number of components", .expected = "at least 1", .found = std::to_string(components)};
    if (corners % n != 0)
        return Error{.what = "size of the corners",
                     .expected = "a multiple of " + std::to_string(n),
                     .found = std::to_string(corners)};
    const std::size_t a_cell = d * static_cast<std::size_t>(components);
    if (places != a_cell * (corners / n))
        return Error{.what = "size of the output",
                     .expected = std::to_string(a_cell) + " for each of " + std::to_string(corners / n) + " cells",
                     .found = std::to_string(places)};
    return Done{};
}

}  // namespace

Result<Gradient> gradient(Simplex simplex, const double* vertices, const double* values) {
    const ExactEnvironment environment;
    if (Status known = check_simplex(simplex); !known) return known.error();
    const int n = vertex_count(simplex), d = space_dimension(simplex);
    const double *at[12] = {}, *f[4] = {};
    Gradient g;
    double* out[3] = {&g.gradient[0], &g.gradient[1], &g.gradient[2]};
    for (int i = 0; i < n * d; ++i) at[i] = vertices + i;
    for (int i = 0; i < n; ++i) f[i] = values + i;
    std::uint32_t undecided[1];
    if (lanes::gradients(simplex, at, f, 1, 1, out, undecided) == 0) return g;
    constexpr double origin[3] = {};
    if (!all_finite(vertices, n * d)) return not_finite_error(simplex, vertices, origin);
    const Found found = exact_gradients(
        simplex, vertices, 1, [&](int, int i) { return values[i]; }, [&](int, int k) -> double& { return *out[k]; });
    g.tier = Tier::exact;
    g.degenerate = found.degenerate;
    return g;
}

Status gradients(Simplex simplex, std::span<const double> nodes, std::span<const std::int32_t> corners,
                 const NodalValues<double>& values, std::span<double> out, TierCounts* tiers) {
    const ExactEnvironment environment;
    if (Status sizes = check_cells(simplex, corners.size(), values.components, out.size()); !sizes) return sizes;
    const auto n = static_cast<std::size_t>(vertex_count(simplex)),
               d = static_cast<std::size_t>(space_dimension(simplex));
    const std::size_t cells = corners.size() / n, a_cell = d * static_cast<std::size_t>(values.components);
    CellBlocks blocks(simplex, nodes, corners, values);
    std::array<std::uint32_t, block_size> undecided;
    TierCounts counts;
    for (std::size_t first = 0; first < cells; first += block_size) {
        const std::size_t count = std::min(block_size, cells - first);
        blocks.gather(first, count);
        const std::size_t left = lanes::gradients(simplex, blocks.vertices(), blocks.values(), values.components, count,
                                                  blocks.gradients(), undecided.data());
        counts.add(Tier::double_double, count - left);
        for (std::size_t u = 0; u < left; ++u) {
            const auto j = static_cast<std::size_t>(undecided[u]);
            double vertices[12] = {};
            for (std::size_t i = 0; i < n * d; ++i) vertices[i] = blocks.vertices()[i][j];
            constexpr double origin[3] = {};
            if (!all_finite(vertices, static_cast<int>(n * d)))
                return not_finite_error(simplex, vertices, origin, "cell " + std::to_string(first + j) + ": ");
            const Found found = exact_gradients(
                simplex, vertices, values.components,
                [&](int c, int i) { return blocks.values()[static_cast<int>(n) * c + i][j]; },
                [&](int c, int k) -> double& { return blocks.gradients()[static_cast<int>(d) * c + k][j]; });
            counts.add(Tier::exact);
            counts.degenerate += found.degenerate ? 1 : 0;
            counts.not_finite += found.finite ? 0 : 1;
        }
        for (std::size_t row = 0; row < a_cell; ++row) {
            const double* const from = blocks.gradients()[row];
            for (std::size_t j = 0; j < count; ++j) out[a_cell * (first + j) + row] = from[j];
        }
    }
    if (tiers != nullptr) tiers->add(counts);
    return Done{};
}

}  // namespace barycert
