/// Many points, in blocks and chunks, on several threads.
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "barycert/locate/finder.hpp"
#include "barycert/locate/sorted_points.hpp"

namespace barycert::locate {

/// Work on `threads` threads, 0 for as many as the machine has, and never on more.
template <class F>
void in_arena(int threads, F&& work) {
    const int available = tbb::this_task_arena::max_concurrency();
    tbb::task_arena arena(threads > 0 ? std::min(threads, available) : available);
    arena.execute(std::forward<F>(work));
}

/// An Error naming the first point with a coordinate that is not finite, if there is one. `first`: its number counts
/// from there.
inline Status check_finite(std::span<const double> points, std::size_t d, std::size_t first = 0) {
    // Differences of finite numbers with themselves are zero, all others NaN: a sum that is easy to vectorise.
    double sum = 0;
    for (const double x : points) sum += x - x;
    if (sum == 0) return Done{};
    const auto bad = static_cast<std::size_t>(
        std::find_if(points.begin(), points.end(), [](double x) { return !std::isfinite(x); }) - points.begin());
    return Error{.what = "coordinate " + std::to_string(bad % d) + " of point " + std::to_string(first + bad / d),
                 .expected = "a finite number",
                 .found = std::to_string(points[bad])};
}

/// How many points are sorted together: the more there are, the nearer they lie to each other.
inline std::size_t block_of(std::size_t count) {
    constexpr std::size_t min = std::size_t{1} << 13, max = std::size_t{1} << 20;
    const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    return std::clamp((count + threads - 1) / threads, min, max);
}

/// For blocks of the points, on all threads of the calling arena: worker = make(number of the first point of the
/// block, their count); worker(records, count, owners, features) for each chunk of the sorted block; in the end
/// done(number of the first point, sorted block, worker). Precondition: finite points.
template <class Make, class Done>
void for_chunks(const LocatorData& data, std::span<const double> points, LocationCounts& counts, Make make, Done done) {
    const std::size_t d = data.index.dimension(), count = points.size() / d;
    const std::size_t block = block_of(count), blocks = (count + block - 1) / block;
    std::vector<LocationCounts> parts(blocks);
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
        const std::size_t first = b * block, size = std::min(block, count - first);
        std::unique_ptr<SortedPoints> sorted = data.sorted.take();
        sorted->sort(d, data.index.bins, points.subspan(d * first, d * size));
        Finder finder(data);
        auto worker = make(first, size);
        std::array<Place, chunk_size> owner;
        std::array<Feature, chunk_size> feature;
        for (std::size_t at = 0; at < size; at += chunk_size) {
            const std::size_t n = std::min(chunk_size, size - at);
            finder.find(sorted->data() + at, n, owner.data(), feature.data(), parts[b]);
            worker(sorted->data() + at, n, owner.data(), feature.data());
        }
        done(first, *sorted, worker);
        data.sorted.put(std::move(sorted));
    });
    for (const LocationCounts& part : parts) counts.add(part);
}

}  // namespace barycert::locate
