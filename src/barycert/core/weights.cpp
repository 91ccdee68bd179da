#include "barycert/weights.hpp"

#include <limits>
#include <type_traits>
#include <vector>

#include "barycert/core/blocks.hpp"
#include "barycert/core/exact_weights.hpp"
#include "barycert/core/lanes.hpp"
#include "barycert/environment.hpp"

namespace barycert {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Weights of the last tier; NaN and false if degenerate.
bool exact_weights(Simplex s, const double* vertices, const double* point, double* out) {
    const ExactWeights w(s, vertices, point);
    for (int i = 0; i < vertex_count(s); ++i) out[i] = w.degenerate() ? nan : w.weight(i);
    return !w.degenerate();
}

template <class Batch>
Status batch_weights(const Batch& batch, std::span<double> out, TierCounts* tiers) {
    const ExactEnvironment environment;
    const Simplex s = batch.simplex;
    const auto n = static_cast<std::size_t>(vertex_count(s));
    if (Status sizes = check_sizes(batch, out.size(), n); !sizes) return sizes;
    TierCounts counts;
    Status status = for_blocks(
        batch,
        [&](std::size_t first, const lanes::Cases& block, std::uint32_t* undecided) {
            const std::size_t left = lanes::weights(s, block, out.data() + n * first, undecided);
            counts.add(Tier::double_double, block.count - left);
            return left;
        },
        [&](std::size_t first, std::size_t j, const SingleCase& c) {
            counts.add(Tier::exact);
            if (!exact_weights(s, c.vertices.data(), c.point.data(), out.data() + n * (first + j))) ++counts.degenerate;
        });
    if (status && tiers != nullptr) tiers->add(counts);
    return status;
}

/// Nodal values of a block as one array a component and vertex, taken in place where they lie so already.
template <class T>
class BlockValues {
public:
    BlockValues(int vertices, int components)
        : components_(static_cast<std::size_t>(components)),
          pointers_(static_cast<std::size_t>(vertices) * components_),
          buffer_(pointers_.size() * block_stride) {}

    const double* const* block(const CaseArrays& cases, const ValueArrays<T>& values, std::size_t first,
                               std::size_t count) {
        const auto n = static_cast<std::size_t>(vertex_count(cases.simplex));
        for (std::size_t i = 0; i < n; ++i) {
            const T* const from = values.at[i] + components_ * first;
            if constexpr (std::is_same_v<T, double>) {
                if (components_ == 1) {
                    pointers_[i] = from;
                    continue;
                }
            }
            for (std::size_t c = 0; c < components_; ++c) {
                double* const to = buffer_.data() + (n * c + i) * block_stride;
                pointers_[n * c + i] = to;
                for (std::size_t j = 0; j < count; ++j) to[j] = static_cast<double>(from[components_ * j + c]);
            }
        }
        return pointers_.data();
    }

    const double* const* block(const MeshQueries& queries, const NodalValues<T>& values, std::size_t first,
                               std::size_t count) {
        const auto n = static_cast<std::size_t>(vertex_count(queries.simplex));
        for (std::size_t row = 0; row < pointers_.size(); ++row) pointers_[row] = buffer_.data() + row * block_stride;
        const auto at = [&](std::int32_t node) {
            return values.data.data() + components_ * static_cast<std::size_t>(node);
        };
        for (std::size_t j = 0; j < count; ++j) {
            fetch_ahead(queries, n, first + j, at);
            const std::int32_t* const corners = corners_of(queries, n, first + j);
            for (std::size_t i = 0; i < n; ++i) {
                const T* const from = at(corners[i]);
                for (std::size_t c = 0; c < components_; ++c)
                    buffer_[(n * c + i) * block_stride + j] = static_cast<double>(from[c]);
            }
        }
        return pointers_.data();
    }

private:
    std::size_t components_;
    std::vector<const double*> pointers_;
    std::vector<double> buffer_;
};

/// Values of the last tier, one a component: that of vertex i, component c is values[n * c + i][j].
void exact_values(const ExactWeights& w, int n, const double* const* values, std::size_t j, int components, double* out,
                  TierCounts& counts) {
    counts.add(Tier::exact);
    counts.degenerate += w.degenerate() ? 1 : 0;
    bool finite = true;
    for (int c = 0; c < components; ++c) {
        double f[4];
        for (int i = 0; i < n; ++i) f[i] = values[n * c + i][j];
        const bool usable = all_finite(f, n);
        finite = finite && usable;
        out[c] = usable && !w.degenerate() ? w.interpolate({f, static_cast<std::size_t>(n)}) : nan;
    }
    counts.not_finite += finite ? 0 : 1;
}

template <class Batch, class Values, class T>
Status batch_values(const Batch& batch, const Values& values, std::span<double> out, TierCounts* tiers,
                    Rounding rounding) {
    const Simplex s = batch.simplex;
    const int n = vertex_count(s), components = values.components;
    const auto stride = static_cast<std::size_t>(components);
    const ExactEnvironment environment;
    if (components < 1)
        return Error{.what = "number of components", .expected = "at least 1", .found = std::to_string(components)};
    if (Status sizes = check_sizes(batch, out.size(), stride); !sizes) return sizes;
    BlockValues<T> block_values(n, components);
    const double* const* at = nullptr;
    TierCounts counts;
    Status status = for_blocks(
        batch,
        [&](std::size_t first, const lanes::Cases& block, std::uint32_t* undecided) -> std::size_t {
            at = block_values.block(batch, values, first, block.count);
            double* const to = out.data() + stride * first;
            if (rounding == Rounding::plain) {
                lanes::plain_values(s, block, at, components, to);
                return 0;
            }
            const std::size_t left = lanes::values(s, block, at, components, to, undecided);
            counts.add(Tier::double_double, block.count - left);
            return left;
        },
        [&](std::size_t first, std::size_t j, const SingleCase& c) {
            const ExactWeights w(s, c.vertices.data(), c.point.data());
            exact_values(w, n, at, j, components, out.data() + stride * (first + j), counts);
        });
    if (status && tiers != nullptr) tiers->add(counts);
    return status;
}

}  // namespace

Result<Weights> barycentric_weights(Simplex simplex, const double* vertices, const double* point) {
    const ExactEnvironment environment;
    Weights w;
    std::uint32_t undecided[1];
    if (lanes::weights(simplex, as_block(simplex, vertices, point), w.weights.data(), undecided) == 0) return w;
    if (!all_finite(simplex, vertices, point)) return not_finite_error(simplex, vertices, point);
    w.tier = Tier::exact;
    w.degenerate = !exact_weights(simplex, vertices, point, w.weights.data());
    return w;
}

Result<Value> interpolate(Simplex simplex, const double* vertices, const double* point, const double* values) {
    const ExactEnvironment environment;
    const int n = vertex_count(simplex);
    const double* at[4] = {};
    for (int i = 0; i < n; ++i) at[i] = values + i;
    Value v;
    std::uint32_t undecided[1];
    if (lanes::values(simplex, as_block(simplex, vertices, point), at, 1, &v.value, undecided) == 0) return v;
    if (!all_finite(simplex, vertices, point)) return not_finite_error(simplex, vertices, point);
    const ExactWeights w(simplex, vertices, point);
    TierCounts counts;
    exact_values(w, n, at, 0, 1, &v.value, counts);
    v.tier = Tier::exact;
    v.degenerate = w.degenerate();
    return v;
}

Status barycentric_weights(const CaseArrays& cases, std::span<double> out, TierCounts* tiers) {
    return batch_weights(cases, out, tiers);
}

Status barycentric_weights(const MeshQueries& queries, std::span<double> out, TierCounts* tiers) {
    return batch_weights(queries, out, tiers);
}

template <class T>
Status interpolate(const CaseArrays& cases, const ValueArrays<T>& values, std::span<double> out, TierCounts* tiers,
                   Rounding rounding) {
    return batch_values<CaseArrays, ValueArrays<T>, T>(cases, values, out, tiers, rounding);
}

template <class T>
Status interpolate(const MeshQueries& queries, const NodalValues<T>& values, std::span<double> out, TierCounts* tiers,
                   Rounding rounding) {
    return batch_values<MeshQueries, NodalValues<T>, T>(queries, values, out, tiers, rounding);
}

template Status interpolate(const CaseArrays&, const ValueArrays<double>&, std::span<double>, TierCounts*, Rounding);
template Status interpolate(const CaseArrays&, const ValueArrays<float>&, std::span<double>, TierCounts*, Rounding);
template Status interpolate(const MeshQueries&, const NodalValues<double>&, std::span<double>, TierCounts*, Rounding);
template Status interpolate(const MeshQueries&, const NodalValues<float>&, std::span<double>, TierCounts*, Rounding);

}  // namespace barycert
