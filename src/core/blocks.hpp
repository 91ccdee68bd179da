/// The driver of all batches. It cuts them into blocks of cases in structure of arrays for the SIMD lanes,
/// and hands single cases that these leave undecided to the last tier.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "core/base/finite.hpp"
#include "core/base/strict_math.hpp"
#include "core/lanes.hpp"

namespace barycert::core {

// Checks of the input of calls and batches. A function returns the Error of the first requirement that is not met.

/// All cells of a mesh, a batch without points: vertex i of cell j is node corners[n * j + i].
struct MeshCells {
    Simplex simplex;
    std::span<const double> nodes;
    std::span<const std::int32_t> corners;

    std::size_t count() const { return corners.size() / static_cast<std::size_t>(vertex_count(simplex)); }
};

inline Error size_error(const char* what, const std::string& expected, std::size_t found) {
    return {.code = "argument.size", .what = what, .expected = expected, .found = std::to_string(found)};
}

/// Sizes that must fit together do. Indices are not looked at: that would cost as much as the answers.
inline Status check_output(std::size_t places, std::size_t per_case, std::size_t count, const char* what) {
    if (places == per_case * count) return Done{};
    return size_error("size of the output",
                      std::to_string(per_case) + " for each of " + std::to_string(count) + " " + what + "s", places);
}
inline Status check_sizes(const CaseArrays& cases, std::size_t places, std::size_t per_case) {
    return check_output(places, per_case, cases.count, "case");
}
inline Status check_sizes(const MeshQueries& q, std::size_t places, std::size_t per_case) {
    const auto d = static_cast<std::size_t>(space_dimension(q.simplex));
    if (q.points.size() != d * q.cells.size())
        return size_error("size of the points",
                          std::to_string(d) + " coordinates for each of " + std::to_string(q.cells.size()) + " queries",
                          q.points.size());
    return check_output(places, per_case, q.count(), "case");
}
inline Status check_sizes(const MeshCells& cells, std::size_t places, std::size_t per_case) {
    const auto n = static_cast<std::size_t>(vertex_count(cells.simplex));
    if (cells.corners.size() % n != 0)
        return size_error("size of the corners", "a multiple of " + std::to_string(n), cells.corners.size());
    return check_output(places, per_case, cells.count(), "cell");
}

inline Status check_components(int components) {
    if (components >= 1) return Done{};
    return Error{.code = "argument.value",
                 .what = "number of components",
                 .expected = "at least 1",
                 .found = std::to_string(components)};
}

/// The simplex fills its space. `what` names what is asked for.
inline Status check_fills_space(Simplex s, const std::string& what) {
    if (s == Simplex::triangle || s == Simplex::tetrahedron) return Done{};
    return Error{.code = "argument.value",
                 .what = "unsupported simplex for " + what,
                 .expected = "triangle or tetrahedron",
                 .found = std::string(name(s))};
}

/// `point` may be null.
inline bool all_finite(Simplex s, const double* vertices, const double* point) {
    const auto d = static_cast<std::size_t>(space_dimension(s)), all = d * static_cast<std::size_t>(vertex_count(s));
    return base::first_not_finite({vertices, all}) == all &&
           (point == nullptr || base::first_not_finite({point, d}) == d);
}

/// Names the first coordinate that is not finite. Requires: there is one. `which` goes before it.
inline Error not_finite_error(Simplex s, const double* vertices, const double* point, const std::string& which = {}) {
    const auto d = static_cast<std::size_t>(space_dimension(s)), all = d * static_cast<std::size_t>(vertex_count(s));
    if (const std::size_t i = base::first_not_finite({vertices, all}); i < all)
        return base::not_finite(which + "coordinate " + std::to_string(i % d) + " of vertex " + std::to_string(i / d),
                                vertices[i]);
    const std::size_t k = base::first_not_finite({point, d});
    return base::not_finite(which + "coordinate " + std::to_string(k) + " of the point", point[k]);
}

// The driver.

/// Cases of a block. Gathered tetrahedra take 16 KiB: they stay in the nearest cache, together with what goes out.
inline constexpr std::size_t block_size = 128;

/// Doubles from one gathered array to the next. Not a power of two: arrays would then share a few sets of the cache.
inline constexpr std::size_t block_stride = block_size + 8;

/// The corners of case j, n of them.
inline const std::int32_t* corners_of(const MeshQueries& q, std::size_t n, std::size_t j) {
    return q.corners.data() + n * static_cast<std::size_t>(q.cells[j]);
}
inline const std::int32_t* corners_of(const MeshCells& c, std::size_t n, std::size_t j) {
    return c.corners.data() + n * j;
}

/// Asks for the memory of a query soon to come, for cells in random order: its corners, and what lies at address(node)
/// for the nodes of one that comes sooner. The distances are as good as twice or half of them; without, random cells of
/// a large mesh took twice as long. Inlined by force: GCC takes a function that only prefetches for one without effect,
/// and drops the call.
template <class Address>
[[gnu::always_inline]] inline void fetch_ahead(const MeshQueries& q, std::size_t n, std::size_t query,
                                               Address address) {
    constexpr std::size_t corners_ahead = 32, nodes_ahead = 16;
    if (query + corners_ahead >= q.cells.size()) return;
    __builtin_prefetch(corners_of(q, n, query + corners_ahead));
    const std::int32_t* const next = corners_of(q, n, query + nodes_ahead);
    for (std::size_t i = 0; i < n; ++i) __builtin_prefetch(address(next[i]));
}
template <class Address>
[[gnu::always_inline]] inline void fetch_ahead(const MeshCells&, std::size_t, std::size_t, Address) {}  // in order

/// One case, vertex after vertex.
struct SingleCase {
    std::array<double, 12> vertices;
    std::array<double, 3> point;
};

inline SingleCase single_case(Simplex s, const CaseBlock& block, std::size_t j) {
    SingleCase c{};
    const auto d = static_cast<std::size_t>(space_dimension(s));
    const auto coordinates = d * static_cast<std::size_t>(vertex_count(s));
    for (std::size_t i = 0; i < coordinates; ++i) c.vertices[i] = block.vertices[i][j];
    for (std::size_t k = 0; k < d; ++k) c.point[k] = block.point[k] == nullptr ? 0 : block.point[k][j];
    return c;
}

/// The block of a case that stands alone. `point` may be null.
inline CaseBlock single_block(Simplex s, const double* vertices, const double* point) {
    CaseBlock block{};
    for (int i = 0; i < space_dimension(s) * vertex_count(s); ++i) block.vertices[i] = vertices + i;
    if (point != nullptr) {
        for (int k = 0; k < space_dimension(s); ++k) block.point[k] = point + k;
    }
    block.count = 1;
    return block;
}

/// Arrays that lanes read or write, each with room for a block.
class LaneArrays {
public:
    explicit LaneArrays(std::size_t count) : arrays_(count), buffer_(count * block_stride) {
        for (std::size_t i = 0; i < count; ++i) arrays_[i] = buffer_.data() + i * block_stride;
    }

    std::size_t size() const { return arrays_.size(); }
    double* operator[](std::size_t i) const { return arrays_[i]; }
    double* const* data() const { return arrays_.data(); }

    /// out[size() * j + i] = array i of case j.
    void copy_out(std::size_t count, double* out) const {
        for (std::size_t i = 0; i < size(); ++i) {
            for (std::size_t j = 0; j < count; ++j) out[size() * j + i] = arrays_[i][j];
        }
    }

private:
    std::vector<double*> arrays_;
    std::vector<double> buffer_;
};

/// Blocks of MeshQueries or MeshCells, their coordinates gathered.
template <class Batch>
class CaseBlocks {
public:
    explicit CaseBlocks(const Batch& batch)
        : batch_(batch),
          coordinates_(static_cast<std::size_t>(space_dimension(batch.simplex)) *
                       static_cast<std::size_t>(vertex_count(batch.simplex) + (has_points ? 1 : 0))) {}

    std::size_t count() const { return batch_.count(); }
    CaseBlock block(std::size_t first, std::size_t count) {
        const Simplex s = batch_.simplex;
        with_simplex(s, [&]<Simplex known>() { gather<vertex_count(known), space_dimension(known)>(first, count); });
        CaseBlock block{};
        const auto d = static_cast<std::size_t>(space_dimension(s)), n = static_cast<std::size_t>(vertex_count(s));
        for (std::size_t i = 0; i < n * d; ++i) block.vertices[i] = coordinates_[i];
        if constexpr (has_points) {
            for (std::size_t k = 0; k < d; ++k) block.point[k] = coordinates_[n * d + k];
        }
        block.count = count;
        return block;
    }

private:
    static constexpr bool has_points = std::is_same_v<Batch, MeshQueries>;

    template <std::size_t n, std::size_t d>
    void gather(std::size_t first, std::size_t count) {
        const auto node = [this](std::int32_t i) { return batch_.nodes.data() + d * static_cast<std::size_t>(i); };
        double* const arrays = coordinates_[0];
        for (std::size_t j = 0; j < count; ++j) {
            fetch_ahead(batch_, n, first + j, node);
            const std::int32_t* const corners = corners_of(batch_, n, first + j);
            double* const out = arrays + j;
            for (std::size_t i = 0; i < n; ++i) {
                const double* const from = node(corners[i]);
                for (std::size_t k = 0; k < d; ++k) out[(d * i + k) * block_stride] = from[k];
            }
            if constexpr (has_points) {
                const double* const point = batch_.points.data() + d * (first + j);
                for (std::size_t k = 0; k < d; ++k) out[(d * n + k) * block_stride] = point[k];
            }
        }
    }

    const Batch& batch_;
    LaneArrays coordinates_;
};

/// Blocks of cases that lie in arrays already.
template <>
class CaseBlocks<CaseArrays> {
public:
    explicit CaseBlocks(const CaseArrays& cases) : cases_(cases) {}

    std::size_t count() const { return cases_.count; }
    CaseBlock block(std::size_t first, std::size_t count) {
        const auto from = [first](const double* all) { return all == nullptr ? nullptr : all + first; };
        CaseBlock block{{}, {}, count};
        std::transform(cases_.vertices.begin(), cases_.vertices.end(), block.vertices, from);
        std::transform(cases_.point.begin(), cases_.point.end(), block.point, from);
        return block;
    }

private:
    const CaseArrays& cases_;
};

/// Nodal values of a block, gathered: array nodes * c + i has component c at node i of each case.
template <class T>
class GatheredValues {
public:
    GatheredValues(const NodalValues<T>& values, std::size_t nodes)
        : values_(values.data),
          components_(static_cast<std::size_t>(values.components)),
          nodes_(nodes),
          arrays_(nodes * components_) {}

    /// Gathers the values at the corners of cases [first, first + count), as the first nodes of each case. Returns all
    /// arrays.
    template <class Batch>
    const double* const* block(const Batch& batch, std::size_t first, std::size_t count) {
        const auto n = static_cast<std::size_t>(vertex_count(batch.simplex));
        gather(0, n, count, [&](std::size_t j) {
            fetch_ahead(batch, n, first + j, [this](std::int32_t node) { return at(node); });
            return corners_of(batch, n, first + j);
        });
        return arrays_.data();
    }

    /// Gathers the values at the `number` nodes indices(j) of each case j, as the nodes of that case from `begin` on.
    template <class Indices>
    void gather(std::size_t begin, std::size_t number, std::size_t count, Indices indices) {
        const std::size_t components = components_, nodes = nodes_;
        double* const arrays = arrays_[begin];
        for (std::size_t j = 0; j < count; ++j) {
            const std::int32_t* const of_case = indices(j);
            for (std::size_t i = 0; i < number; ++i) {
                const T* const from = at(of_case[i]);
                for (std::size_t c = 0; c < components; ++c)
                    arrays[(nodes * c + i) * block_stride + j] = static_cast<double>(from[c]);
            }
        }
    }

    double* const* arrays() const { return arrays_.data(); }

private:
    const T* at(std::int32_t node) const { return values_.data() + components_ * static_cast<std::size_t>(node); }

    std::span<const T> values_;
    std::size_t components_, nodes_;
    LaneArrays arrays_;
};

/// Facts about a case that the last tier found.
struct ExactCase {
    bool degenerate = false;
    bool finite_values = true;
};

/// Calls decide(first, block, undecided) for each block; it returns how many cases it leaves undecided, their numbers
/// within the block in `undecided`. Then calls exact(first, j, c) for each of these, with the case itself, whose
/// coordinates are finite; it returns an ExactCase. Counts the cases that are decided for `tier`, the others for
/// Tier::exact. Stops with an Error, and counts nothing, at the first undecided case with a coordinate that is not
/// finite.
template <class Batch, class Decide, class Exact>
Status for_blocks(const Batch& batch, Tier tier, TierCounts* tiers, Decide decide, Exact exact) {
    CaseBlocks<Batch> blocks(batch);
    std::array<std::uint32_t, block_size> undecided;
    TierCounts counts;
    for (std::size_t first = 0; first < blocks.count(); first += block_size) {
        const CaseBlock block = blocks.block(first, std::min(block_size, blocks.count() - first));
        const std::size_t undecided_count = decide(first, block, undecided.data());
        counts.add(tier, block.count - undecided_count);
        counts.add(Tier::exact, undecided_count);
        for (const std::uint32_t j : std::span(undecided).first(undecided_count)) {
            const SingleCase c = single_case(batch.simplex, block, j);
            if (!all_finite(batch.simplex, c.vertices.data(), c.point.data()))
                return not_finite_error(
                    batch.simplex, c.vertices.data(), c.point.data(),
                    (std::is_same_v<Batch, MeshCells> ? "cell " : "case ") + std::to_string(first + j) + ": ");
            const ExactCase found = exact(first, j, c);
            counts.degenerate += found.degenerate ? 1 : 0;
            counts.not_finite += found.finite_values ? 0 : 1;
        }
    }
    if (tiers != nullptr) tiers->add(counts);
    return Done{};
}

}  // namespace barycert::core
