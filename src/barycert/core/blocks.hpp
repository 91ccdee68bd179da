/// Internal: batches cut into blocks of cases in structure of arrays, for the SIMD lanes; and single cases out of them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "barycert/base/strict_math.hpp"
#include "barycert/batch.hpp"
#include "barycert/core/lanes.hpp"
#include "barycert/result.hpp"

namespace barycert {

/// Cases of a block. Gathered tetrahedra take 16 KiB: they stay in the nearest cache, together with what goes out.
inline constexpr std::size_t block_size = 128;

/// Doubles from one gathered row to the next. Not a power of two: rows would then share a few sets of the cache.
inline constexpr std::size_t block_stride = block_size + 8;

inline std::size_t case_count(const CaseArrays& c) {
    return c.count;
}
inline std::size_t case_count(const MeshQueries& q) {
    return q.count();
}

/// An Error if sizes that must fit together do not. Indices are not looked at: that would cost as much as the answers.
inline Status check_sizes(const CaseArrays& cases, std::size_t places, std::size_t per_case) {
    if (places == per_case * cases.count) return Done{};
    return Error{.what = "size of the output",
                 .expected = std::to_string(per_case) + " for each of " + std::to_string(cases.count) + " cases",
                 .found = std::to_string(places)};
}
inline Status check_sizes(const MeshQueries& q, std::size_t places, std::size_t per_case) {
    const auto d = static_cast<std::size_t>(space_dimension(q.simplex));
    if (q.points.size() != d * q.cells.size()) {
        return Error{
            .what = "size of the points",
            .expected = std::to_string(d) + " coordinates for each of " + std::to_string(q.cells.size()) + " queries",
            .found = std::to_string(q.points.size())};
    }
    return check_sizes(CaseArrays{.simplex = q.simplex, .count = q.count()}, places, per_case);
}

/// One case, vertex after vertex.
struct SingleCase {
    std::array<double, 12> vertices;
    std::array<double, 3> point;
};

inline SingleCase single_case(Simplex s, const lanes::Cases& cases, std::size_t j) {
    SingleCase c{};
    const auto d = static_cast<std::size_t>(space_dimension(s));
    const auto coordinates = d * static_cast<std::size_t>(vertex_count(s));
    for (std::size_t i = 0; i < coordinates; ++i) c.vertices[i] = cases.vertices[i][j];
    for (std::size_t k = 0; k < d; ++k) c.point[k] = cases.point[k][j];
    return c;
}

/// The arrays of a case that stands alone.
inline lanes::Cases as_block(Simplex s, const double* vertices, const double* point) {
    lanes::Cases cases{};
    for (int i = 0; i < space_dimension(s) * vertex_count(s); ++i) cases.vertices[i] = vertices + i;
    for (int k = 0; k < space_dimension(s); ++k) cases.point[k] = point + k;
    cases.count = 1;
    return cases;
}

inline bool all_finite(const double* x, int count) {
    return std::all_of(x, x + count, [](double v) { return std::isfinite(v); });
}

inline bool all_finite(Simplex s, const double* vertices, const double* point) {
    return all_finite(vertices, space_dimension(s) * vertex_count(s)) && all_finite(point, space_dimension(s));
}

/// Names the first coordinate that is not finite. Precondition: there is one. `which` goes before it.
inline Error not_finite_error(Simplex s, const double* vertices, const double* point, const std::string& which = {}) {
    const int d = space_dimension(s), coordinates = d * vertex_count(s);
    const double* const bad =
        std::find_if(vertices, vertices + coordinates, [](double v) { return !std::isfinite(v); });
    const auto i = static_cast<int>(bad - vertices);
    if (i < coordinates) {
        return {.what = which + "coordinate " + std::to_string(i % d) + " of vertex " + std::to_string(i / d),
                .expected = "a finite number",
                .found = std::to_string(*bad)};
    }
    const int k = all_finite(point, 1) ? all_finite(point, 2) ? 2 : 1 : 0;
    return {.what = which + "coordinate " + std::to_string(k) + " of the point",
            .expected = "a finite number",
            .found = std::to_string(point[k])};
}

inline std::string case_prefix(std::size_t number) {
    return "case " + std::to_string(number) + ": ";
}

/// Blocks of cases that lie in arrays already.
class ArrayBlocks {
public:
    explicit ArrayBlocks(const CaseArrays& cases) : cases_(cases) {}

    lanes::Cases block(std::size_t first, std::size_t count) {
        lanes::Cases block{};
        for (std::size_t i = 0; i < 12; ++i) {
            if (cases_.vertices[i] != nullptr) block.vertices[i] = cases_.vertices[i] + first;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            if (cases_.point[k] != nullptr) block.point[k] = cases_.point[k] + first;
        }
        block.count = count;
        return block;
    }

private:
    const CaseArrays& cases_;
};

inline const std::int32_t* corners_of(const MeshQueries& q, std::size_t n, std::size_t query) {
    return q.corners.data() + n * static_cast<std::size_t>(q.cells[query]);
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

/// Blocks of mesh queries, their coordinates gathered.
class GatheredBlocks {
public:
    explicit GatheredBlocks(const MeshQueries& queries)
        : queries_(queries),
          coordinates_(static_cast<std::size_t>(space_dimension(queries.simplex)) *
                       static_cast<std::size_t>(vertex_count(queries.simplex) + 1) * block_stride) {}

    lanes::Cases block(std::size_t first, std::size_t count) {
        const Simplex s = queries_.simplex;
        with_simplex(s, [&]<Simplex known>() { gather<vertex_count(known), space_dimension(known)>(first, count); });
        lanes::Cases block{};
        const int d = space_dimension(s), n = vertex_count(s);
        for (int i = 0; i < n * d; ++i)
            block.vertices[i] = coordinates_.data() + static_cast<std::size_t>(i) * block_stride;
        for (int k = 0; k < d; ++k)
            block.point[k] = coordinates_.data() + static_cast<std::size_t>(n * d + k) * block_stride;
        block.count = count;
        return block;
    }

private:
    template <std::size_t n, std::size_t d>
    void gather(std::size_t first, std::size_t count) {
        const auto node = [this](std::int32_t i) { return queries_.nodes.data() + d * static_cast<std::size_t>(i); };
        for (std::size_t j = 0; j < count; ++j) {
            fetch_ahead(queries_, n, first + j, node);
            const std::int32_t* const corners = corners_of(queries_, n, first + j);
            double* const out = coordinates_.data() + j;
            for (std::size_t i = 0; i < n; ++i) {
                const double* const from = node(corners[i]);
                for (std::size_t k = 0; k < d; ++k) out[(d * i + k) * block_stride] = from[k];
            }
            const double* const point = queries_.points.data() + d * (first + j);
            for (std::size_t k = 0; k < d; ++k) out[(d * n + k) * block_stride] = point[k];
        }
    }

    const MeshQueries& queries_;
    std::vector<double> coordinates_;
};

inline ArrayBlocks blocks_of(const CaseArrays& cases) {
    return ArrayBlocks(cases);
}
inline GatheredBlocks blocks_of(const MeshQueries& queries) {
    return GatheredBlocks(queries);
}

/// Calls decide(first, block, undecided) for each block, which returns how many cases it left undecided, their numbers
/// within the block in `undecided`; then escalate(first, number, c) for each of these, with the case itself, whose
/// coordinates are finite. Stops with an Error at the first case of which they are not.
template <class Batch, class Decide, class Escalate>
Status for_blocks(const Batch& batch, Decide decide, Escalate escalate) {
    auto blocks = blocks_of(batch);
    std::array<std::uint32_t, block_size> undecided;
    for (std::size_t first = 0; first < case_count(batch); first += block_size) {
        const lanes::Cases block = blocks.block(first, std::min(block_size, case_count(batch) - first));
        const std::size_t left = decide(first, block, undecided.data());
        for (std::size_t i = 0; i < left; ++i) {
            const auto j = static_cast<std::size_t>(undecided[i]);
            const SingleCase c = single_case(batch.simplex, block, j);
            if (!all_finite(batch.simplex, c.vertices.data(), c.point.data()))
                return not_finite_error(batch.simplex, c.vertices.data(), c.point.data(), case_prefix(first + j));
            escalate(first, j, c);
        }
    }
    return Done{};
}

}  // namespace barycert
