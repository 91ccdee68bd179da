#include "barycert/quadratic.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "barycert/core/blocks.hpp"
#include "barycert/core/quadratic_exact.hpp"
#include "barycert/core/quadratic_lanes.hpp"
#include "barycert/environment.hpp"

namespace barycert {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Status check_simplex(Simplex s) {
    if (s == Simplex::triangle || s == Simplex::tetrahedron) return Done{};
    return Error{.what = "quadratic interpolation in a simplex that does not fill its space",
                 .expected = "triangle or tetrahedron",
                 .found = std::string(name(s))};
}

Status check_quadratic(const MeshQueries& q, std::size_t mid_nodes, int components, std::size_t places) {
    if (Status known = check_simplex(q.simplex); !known) return known;
    if (components < 1)
        return Error{.what = "number of components", .expected = "at least 1", .found = std::to_string(components)};
    const auto n = static_cast<std::size_t>(vertex_count(q.simplex));
    const auto m = static_cast<std::size_t>(mid_node_count(q.simplex));
    if (mid_nodes * n != q.corners.size() * m)
        return Error{.what = "number of mid-edge nodes",
                     .expected = std::to_string(m) + " for each " + std::to_string(n) + " of the " +
                                 std::to_string(q.corners.size()) + " corners",
                     .found = std::to_string(mid_nodes)};
    return check_sizes(q, places, static_cast<std::size_t>(components));
}

/// Values of the last tier: those of the nodes of component c are values[nodes * c ...]. Coordinates are finite.
void exact_values(Simplex s, const SingleCase& c, double* values, int nodes, int components, double* out,
                  TierCounts& counts) {
    counts.add(Tier::exact);
    const auto usable = [&](int component) { return all_finite(values + nodes * component, nodes); };
    std::vector<int> unusable;
    for (int component = 0; component < components; ++component) {
        if (usable(component)) continue;
        unusable.push_back(component);
        std::fill_n(values + nodes * component, nodes, 0.0);  // whether the cell is degenerate is still to be told
    }
    if (!exact_quadratic(s, c.vertices.data(), c.point.data(), values, components, out)) {
        ++counts.degenerate;
        std::fill_n(out, components, nan);
    }
    for (const int component : unusable) out[component] = nan;
    counts.not_finite += unusable.empty() ? 0 : 1;
}

/// Nodal values of a block of queries, one array a component and node, corners before mid-edge nodes; and behind them
/// room for the results, one array a component.
class QuadraticValues {
public:
    QuadraticValues(const MeshQueries& queries, std::span<const std::int32_t> mid_nodes,
                    const NodalValues<double>& values)
        : queries_(queries),
          mid_nodes_(mid_nodes),
          values_(values),
          corners_(static_cast<std::size_t>(vertex_count(queries.simplex))),
          mids_(static_cast<std::size_t>(mid_node_count(queries.simplex))),
          components_(static_cast<std::size_t>(values.components)),
          rows_((nodes() + 1) * components_),
          buffer_(rows_.size() * block_stride) {
        for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i] = buffer_.data() + i * block_stride;
    }

    /// Those of queries [first, first + count).
    void gather(std::size_t first, std::size_t count) {
        const auto at = [this](std::int32_t node) {
            return values_.data.data() + components_ * static_cast<std::size_t>(node);
        };
        for (std::size_t j = 0; j < count; ++j) {
            fetch_ahead(queries_, corners_, first + j, at);
            const std::int32_t* const corners = corners_of(queries_, corners_, first + j);
            const std::int32_t* const mids =
                mid_nodes_.data() + mids_ * static_cast<std::size_t>(queries_.cells[first + j]);
            for (std::size_t i = 0; i < nodes(); ++i) {
                const double* const from = at(i < corners_ ? corners[i] : mids[i - corners_]);
                for (std::size_t c = 0; c < components_; ++c) rows_[nodes() * c + i][j] = from[c];
            }
        }
    }

    std::size_t nodes() const { return corners_ + mids_; }
    double* const* values() const { return rows_.data(); }
    double* const* results() const { return rows_.data() + nodes() * components_; }

private:
    const MeshQueries& queries_;
    std::span<const std::int32_t> mid_nodes_;
    NodalValues<double> values_;
    std::size_t corners_, mids_, components_;
    std::vector<double*> rows_;
    std::vector<double> buffer_;
};

}  // namespace

Result<Value> interpolate_quadratic(Simplex simplex, const double* vertices, const double* point,
                                    const double* values) {
    if (Status known = check_simplex(simplex); !known) return known.error();
    const ExactEnvironment environment;
    const int nodes = vertex_count(simplex) + mid_node_count(simplex);
    const double* at[10] = {};
    for (int i = 0; i < nodes; ++i) at[i] = values + i;
    const lanes::Cases block = as_block(simplex, vertices, point);
    Value v;
    double* const out[1] = {&v.value};
    std::uint32_t undecided[1];
    if (lanes::quadratic_values(simplex, block, at, 1, out, undecided) == 0) return v;
    if (!all_finite(simplex, vertices, point)) return not_finite_error(simplex, vertices, point);
    double f[10];
    for (int i = 0; i < nodes; ++i) f[i] = values[i];
    TierCounts counts;
    exact_values(simplex, single_case(simplex, block, 0), f, nodes, 1, &v.value, counts);
    v.tier = Tier::exact;
    v.degenerate = counts.degenerate != 0;
    return v;
}

Status interpolate_quadratic(const MeshQueries& queries, std::span<const std::int32_t> mid_nodes,
                             const NodalValues<double>& values, std::span<double> out, TierCounts* tiers,
                             Rounding rounding) {
    const Simplex s = queries.simplex;
    const int components = values.components;
    if (Status sizes = check_quadratic(queries, mid_nodes.size(), components, out.size()); !sizes) return sizes;
    const ExactEnvironment environment;
    const auto stride = static_cast<std::size_t>(components);
    QuadraticValues block_values(queries, mid_nodes, values);
    const std::size_t nodes = block_values.nodes();
    std::vector<double> single(nodes * stride);
    TierCounts counts;
    Status status = for_blocks(
        queries,
        [&](std::size_t first, const lanes::Cases& block, std::uint32_t* undecided) -> std::size_t {
            block_values.gather(first, block.count);
            std::size_t left = 0;
            if (rounding == Rounding::plain) {
                lanes::plain_quadratic_values(s, block, block_values.values(), components, block_values.results());
            } else {
                left = lanes::quadratic_values(s, block, block_values.values(), components, block_values.results(),
                                               undecided);
                counts.add(Tier::double_double, block.count - left);
            }
            for (std::size_t c = 0; c < stride; ++c) {
                const double* const from = block_values.results()[c];
                for (std::size_t j = 0; j < block.count; ++j) out[stride * (first + j) + c] = from[j];
            }
            return left;
        },
        [&](std::size_t first, std::size_t j, const SingleCase& c) {
            for (std::size_t row = 0; row < single.size(); ++row) single[row] = block_values.values()[row][j];
            exact_values(s, c, single.data(), static_cast<int>(nodes), components, &out[stride * (first + j)], counts);
        });
    if (status && tiers != nullptr) tiers->add(counts);
    return status;
}

}  // namespace barycert
