#include "barycert/index/radix_sort.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace barycert::index {
namespace {

/// Of the first pass, over all items: as many as the second cache holds lines for.
constexpr int high_bits = 11;
/// Of each later pass, over one bucket of the first.
constexpr int low_bits = 8;

/// Items by their highest bits; returns where each bucket begins, and the end.
std::vector<std::uint32_t> scatter(const Buffer<KeyedPlace>& from, Buffer<KeyedPlace>& to, int shift, int bits) {
    const std::size_t count = from.size(), buckets = std::size_t{1} << bits;
    const std::size_t block = std::max<std::size_t>(std::size_t{1} << 15, count / 256);
    const std::size_t blocks = (count + block - 1) / block;
    std::vector<std::uint32_t> next(blocks * buckets, 0);
    const auto for_blocks = [&](auto use) {
        tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
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
    std::uint32_t sum = 0;
    for (std::uint32_t& n : next) sum += std::exchange(n, sum);
    for (const KeyedPlace& item : from) to[next[item.key >> shift & mask]++] = item;
}

}  // namespace

void sort_by_key(Buffer<KeyedPlace>& items, int bits) {
    const int low = std::max(0, bits - high_bits);
    Buffer<KeyedPlace> other(items.size());
    const std::vector<std::uint32_t> begin = scatter(items, other, low, bits - low);
    std::swap(items, other);
    const int passes = (low + low_bits - 1) / low_bits;
    if (passes == 0) return;
    // Buckets go to and fro between the same parts of both arrays, all as often.
    tbb::parallel_for(std::size_t{0}, begin.size() - 1, [&](std::size_t k) {
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

}  // namespace barycert::index
