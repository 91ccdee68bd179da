#include "mesh/index/cell_index.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/simplex.hpp"
#include "mesh/index/bins.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::index {
namespace {

/// Cells or nodes that a task takes at a time.
constexpr std::size_t grain = std::size_t{1} << 14;

struct KeyedPlace {
    std::uint32_t key;
    std::int32_t place;
};

/// Bits of the first pass, over all items, at most: as many as the second cache holds lines for.
constexpr int high_bits = 11;
/// Bits of each later pass, over one bucket of the first.
constexpr int low_bits = 8;

/// Items by their highest bits; returns where each bucket begins, and the end.
std::vector<std::uint32_t> scatter(const Buffer<KeyedPlace>& from, Buffer<KeyedPlace>& to, int shift, int bits) {
    const std::size_t count = from.size(), buckets = std::size_t{1} << bits;
    const std::size_t block = std::max<std::size_t>(std::size_t{1} << 15, count / 256);
    const std::size_t blocks = (count + block - 1) / block;
    std::vector<std::uint32_t> next(blocks * buckets, 0);
    const auto for_blocks = [&](auto use) {
        base::parallel_for(blocks, [&](std::size_t b) {
            const auto items = std::span<const KeyedPlace>(from).subspan(b * block, std::min(block, count - b * block));
            std::uint32_t* const counters = &next[b * buckets];
            for (const KeyedPlace& item : items) use(item, counters[item.key >> shift]);
        });
    };
    for_blocks([](const KeyedPlace&, std::uint32_t& counter) { ++counter; });
    std::vector<std::uint32_t> begin(buckets + 1, 0);
    std::uint32_t sum = 0;
    for (std::size_t k = 0; k < buckets; ++k) {
        begin[k] = sum;
        for (std::size_t b = 0; b < blocks; ++b) sum += std::exchange(next[b * buckets + k], sum);
    }
    begin[buckets] = sum;
    for_blocks([&](const KeyedPlace& item, std::uint32_t& counter) { to[counter++] = item; });
    return begin;
}

/// One pass over a bucket.
void pass(std::span<const KeyedPlace> from, KeyedPlace* to, int shift, int width) {
    std::array<std::uint32_t, 1 << low_bits> next{};
    const std::uint32_t mask = (1U << width) - 1;
    for (const KeyedPlace& item : from) ++next[item.key >> shift & mask];
    std::exclusive_scan(next.begin(), next.end(), next.begin(), 0U);
    for (const KeyedPlace& item : from) to[next[item.key >> shift & mask]++] = item;
}

/// Ascending keys of `bits` <= 32 bits; equal ones keep their order.
void sort_by_key(Buffer<KeyedPlace>& items, int bits) {
    // Buckets of fewer items would be mostly counters.
    const int high = std::clamp(static_cast<int>(std::bit_width(items.size() / 128)), 1, high_bits);
    const int low = std::max(0, bits - high);
    Buffer<KeyedPlace> other(items.size());
    const std::vector<std::uint32_t> begin = scatter(items, other, low, bits - low);
    std::swap(items, other);
    const int passes = (low + low_bits - 1) / low_bits;
    if (passes == 0) return;
    // Buckets go to and fro between the same parts of both arrays, all as often.
    base::parallel_for(begin.size() - 1, [&](std::size_t k) {
        const std::size_t size = begin[k + 1] - begin[k];
        KeyedPlace *from = items.data() + begin[k], *to = other.data() + begin[k];
        for (int p = 0, shift = 0; p < passes; ++p) {
            const int width = (low - shift) / (passes - p);
            pass({from, size}, to, shift, width);
            std::swap(from, to);
            shift += width;
        }
    });
    if (passes % 2 == 1) std::swap(items, other);
}

/// Coordinates of nodes, and corners of cells.
struct Cells {
    std::span<const double> points;
    std::span<const Mesh::Index> cells;
    std::span<const Mesh::Index> wholes = {};  ///< Mesh::Shapes::parts

    /// The first part of a whole cell. Without parts cells are whole themselves.
    std::size_t first_of(std::size_t whole) const {
        return wholes.empty() ? whole : static_cast<std::size_t>(wholes[whole]);
    }
};

/// The nodes that cells have, ascending: others may lie anywhere.
std::vector<Mesh::Index> used_nodes(const Cells& mesh, std::size_t d) {
    std::vector<std::uint8_t> used(mesh.points.size() / d, 0);
    base::parallel_for_each(mesh.cells.size(), grain, [&](std::size_t i) {
        std::atomic_ref(used[static_cast<std::size_t>(mesh.cells[i])]).store(1, std::memory_order_relaxed);
    });
    std::vector<Mesh::Index> nodes(used.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < used.size(); ++i) {
        nodes[count] = static_cast<Mesh::Index>(i);
        count += used[i];
    }
    nodes.resize(count);
    return nodes;
}

void find_box(const Cells& mesh, const std::vector<Mesh::Index>& nodes, CellIndex& index) {
    const std::size_t d = index.dimension();
    for (std::size_t k = 0; k < d; ++k) {
        index.low[k] = std::numeric_limits<double>::infinity();
        index.high[k] = -index.low[k];
    }
    for (const Mesh::Index node : nodes) {
        for (std::size_t k = 0; k < d; ++k) {
            const double x = mesh.points[d * static_cast<std::size_t>(node) + k];
            index.low[k] = std::min(index.low[k], x);
            index.high[k] = std::max(index.high[k], x);
        }
    }
}

/// Copies nodes along the curve; returns the place of each node of the mesh.
template <std::size_t d>
Buffer<Place> place_nodes(const Cells& mesh, const std::vector<Mesh::Index>& used, CellIndex& index) {
    Buffer<KeyedPlace> order(used.size());
    base::parallel_for_each(order.size(), grain, [&](std::size_t i) {
        order[i] = {index.bins.of(&mesh.points[d * static_cast<std::size_t>(used[i])]), used[i]};
    });
    sort_by_key(order, index.bins.bits());
    Buffer<Place> place(mesh.points.size() / d);
    index.nodes = Buffer<NodeRecord>(order.size());
    index.original_node.resize(order.size());
    base::parallel_for_each(order.size(), grain, [&](std::size_t i) {
        const auto node = static_cast<std::size_t>(order[i].place);
        place[node] = static_cast<Place>(i);
        index.original_node[i] = order[i].place;
        index.nodes[i] = {};
        for (std::size_t k = 0; k < d; ++k) index.nodes[i].at[k] = mesh.points[d * node + k];
    });
    return place;
}

/// Whole cells along the curve, by the middles of their parts' corners in whole numbers of the quantizer. Parts of a
/// whole cell stay together: there are fewer to sort, and they have most of their facets in common.
template <std::size_t d, std::size_t corners>
Buffer<KeyedPlace> order_cells(const Cells& mesh, const Bins& bins) {
    Buffer<std::array<std::int32_t, d>> nodes(mesh.points.size() / d);
    base::parallel_for_each(nodes.size(), grain, [&](std::size_t i) {
        for (std::size_t k = 0; k < d; ++k) nodes[i][k] = bins.quantizer().at(k, mesh.points[d * i + k]);
    });
    constexpr std::size_t ahead = 12 * corners;
    Buffer<KeyedPlace> wholes(mesh.wholes.empty() ? mesh.cells.size() / corners : mesh.wholes.size() - 1);
    base::parallel_for_each(wholes.size(), grain, [&](std::size_t c) {
        const std::size_t begin = corners * mesh.first_of(c), end = corners * mesh.first_of(c + 1);
        std::array<std::int64_t, d> sum{};
        for (std::size_t i = begin; i < end; ++i) {
            if (i + ahead < mesh.cells.size())
                __builtin_prefetch(&nodes[static_cast<std::size_t>(mesh.cells[i + ahead])]);
            const auto& node = nodes[static_cast<std::size_t>(mesh.cells[i])];
            for (std::size_t k = 0; k < d; ++k) sum[k] += node[k];
        }
        for (std::size_t k = 0; k < d; ++k) sum[k] /= static_cast<std::int64_t>(end - begin);
        wholes[c] = {bins.of_quantized(sum), static_cast<Place>(c)};
    });
    sort_by_key(wholes, bins.bits());
    return wholes;
}

template <std::size_t corners>
void place_cells(const Cells& mesh, const Buffer<KeyedPlace>& order, const Buffer<Place>& place_of_node,
                 CellIndex& index) {
    const auto whole_at = [&](std::size_t i) { return static_cast<std::size_t>(order[i].place); };
    std::vector<Place> begin(mesh.wholes.empty() ? 0 : order.size());
    for (std::size_t i = 1; i < begin.size(); ++i)
        begin[i] = begin[i - 1] + mesh.wholes[whole_at(i - 1) + 1] - mesh.wholes[whole_at(i - 1)];
    // Cells that are near in space are anywhere in the file: they are asked for some ahead.
    constexpr std::size_t ahead = 32;
    base::parallel_for(order.size(), grain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            if (i + ahead < last) {
                const Mesh::Index* const soon = mesh.cells.data() + corners * mesh.first_of(whole_at(i + ahead));
                __builtin_prefetch(soon);
                if (!mesh.wholes.empty()) __builtin_prefetch(soon + 4 * corners);
            }
            if (!mesh.wholes.empty() && i + 2 * ahead < last) __builtin_prefetch(&mesh.wholes[whole_at(i + 2 * ahead)]);
            auto place = mesh.wholes.empty() ? static_cast<Place>(i) : begin[i];
            for (std::size_t cell = mesh.first_of(whole_at(i)); cell < mesh.first_of(whole_at(i) + 1);
                 ++cell, ++place) {
                CellRecord& record = index.cells[place];
                for (std::size_t k = 0; k < corners; ++k)
                    record.node[k] = place_of_node[static_cast<std::size_t>(mesh.cells[corners * cell + k])];
                if constexpr (corners == 3) record.node[3] = record.node[0];
                record.next = {-1, -1, -1, -1};
                index.original[place] = static_cast<Mesh::Index>(cell);
            }
        }
    });
}

/// The bin of the middle of a cell, or of one beside it: coordinates are rounded here.
template <std::size_t d, std::size_t corners>
std::uint32_t bin_of_middle(const CellIndex& index, const CellRecord& cell) {
    std::array<double, d> middle{};
    for (std::size_t i = 0; i < corners; ++i)
        for (std::size_t k = 0; k < d; ++k) middle[k] += index.nodes[cell.node[i]].at[k] * (1.0 / corners);
    return index.bins.of(middle.data());
}

/// The start of a bin is the last cell with its middle there. `order`: of cells that have these bins as keys, or empty.
template <std::size_t d, std::size_t corners>
void set_starts(std::span<const KeyedPlace> order, CellIndex& index) {
    constexpr std::size_t at_once = 256;
    std::fill_n(index.start.data(), index.start.size(), -1);
    base::parallel_for(index.cell_count(), grain, [&](std::size_t first, std::size_t last) {
        std::array<std::uint32_t, at_once> bins;
        for (std::size_t at = first; at < last; at += at_once) {
            const std::size_t count = std::min(at_once, last - at);
            for (std::size_t i = 0; i < count; ++i) {
                bins[i] = order.empty() ? bin_of_middle<d, corners>(index, index.cells[at + i]) : order[at + i].key;
                __builtin_prefetch(&index.start[bins[i]], 1);
            }
            for (std::size_t i = 0; i < count; ++i) {
                const std::atomic_ref start(index.start[bins[i]]);
                const auto place = static_cast<Place>(at + i);
                Place before = start.load(std::memory_order_relaxed);
                while (before < place && !start.compare_exchange_weak(before, place, std::memory_order_relaxed))
                    continue;
            }
        }
    });
}

/// Bins without a middle get the start at the same place of the other half of their block: the smallest that has any.
/// Blocks of each round have starts everywhere or nowhere.
void fill_starts(Buffer<Place>& start) {
    const auto fill = [&](std::size_t first, std::size_t size, std::size_t from) {
        for (std::size_t half = from; half < size; half *= 2) {
            for (Place* low = &start[first]; low != &start[first] + size; low += 2 * half) {
                Place* const high = low + half;
                if (*low < 0) std::copy_n(high, half, low);
                if (*high < 0) std::copy_n(low, half, high);
            }
        }
    };
    const std::size_t block = std::min(grain, start.size());
    base::parallel_for(start.size() / block, [&](std::size_t b) { fill(b * block, block, 1); });
    fill(0, start.size(), block);
}

template <std::size_t d, std::size_t corners>
void build(const Cells& mesh, const std::vector<Mesh::Index>& used, CellIndex& index) {
    const Buffer<Place> place_of_node = place_nodes<d>(mesh, used, index);
    const Buffer<KeyedPlace> order = order_cells<d, corners>(mesh, index.bins);
    place_cells<corners>(mesh, order, place_of_node, index);
    if (index.start.size() == 0) return;
    set_starts<d, corners>(mesh.wholes.empty() ? order : std::span<const KeyedPlace>(), index);
    fill_starts(index.start);
}

}  // namespace

CellIndex make_cell_index(Simplex simplex, std::span<const double> points, std::span<const Mesh::Index> cells,
                          std::span<const Mesh::Index> wholes) {
    const Cells mesh{points, cells, wholes};
    CellIndex index;
    index.simplex = simplex;
    const std::size_t count = mesh.cells.size() / index.corners();
    const std::vector<Mesh::Index> used = used_nodes(mesh, index.dimension());
    find_box(mesh, used, index);
    index.cells = Buffer<CellRecord>(count);
    index.original = Buffer<Mesh::Index>(count);
    // A surface goes through few of the bins of its box.
    const bool surface = simplex == Simplex::triangle3d;
    if (count != 0)
        index.bins = Bins(index.dimension(), index.low.data(), index.high.data(), count << (surface ? 7 : 1));
    if (!surface) index.start = Buffer<Place>(index.bins.count());
    if (count == 0 && !surface) index.start[0] = 0;
    if (count == 0) return index;
    simplex == Simplex::triangle     ? build<2, 3>(mesh, used, index)
    : simplex == Simplex::triangle3d ? build<3, 3>(mesh, used, index)
                                     : build<3, 4>(mesh, used, index);
    return index;
}

std::size_t CellIndex::bytes() const {
    return cells.bytes() + original.bytes() + nodes.bytes() + original_node.size() * sizeof(Mesh::Index) +
           start.bytes();
}

std::array<double, 12> vertices_of(const CellIndex& index, Place cell) {
    std::array<double, 12> vertices{};
    const auto at = index.corner_points(cell);
    const std::size_t d = index.dimension();
    for (std::size_t i = 0; i < index.corners(); ++i) std::copy_n(at[i], d, &vertices[d * i]);
    return vertices;
}

CellIndex make_cell_index(const Mesh& mesh) {
    const Simplex simplex = mesh.dimension == 2 ? Simplex::triangle : Simplex::tetrahedron;
    CellIndex index = make_cell_index(simplex, mesh.points, mesh.cells, mesh.shapes.parts);
    if (!mesh.shapes.inside.empty()) index.inside = mesh.shapes.inside.data();
    return index;
}

}  // namespace barycert::index
