// Limits of this machine, by small loops: memory in sequence, cache lines far apart, gathers, new pages, files, a radix
// sort. doc/speed.md holds the rows of the other benches against these limits. Medians of five; each loop's result is
// verified. Times are by the clock, as threads share the memory: let the machine be idle.
//
// bench_limits [--quick]
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <numeric>
#include <string>
#include <string_view>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "barycert/environment.hpp"
#include "core/base/large_pages.hpp"
#include "core/base/random.hpp"
#include "files/descriptor.hpp"
#include "require.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "limits_bench.cpp"
#include "core/foreach_target.hpp"

HWY_BEFORE_NAMESPACE();
namespace barycert::bench::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The sum of from[at[i]]; the count is a multiple of 8.
double gathered(const double* from, const std::int64_t* at, std::size_t count) {
    const hn::CappedTag<double, 8> tag;
    const hn::RebindToSigned<decltype(tag)> integers;
    auto sum = hn::Zero(tag);
    for (std::size_t i = 0; i < count; i += hn::Lanes(tag))
        sum = hn::Add(sum, hn::GatherIndex(tag, from, hn::LoadU(integers, at + i)));
    return hn::GetLane(hn::SumOfLanes(tag, sum));
}

}  // namespace barycert::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace barycert::bench {
namespace {

HWY_EXPORT(gathered);

using Words = std::vector<std::uint64_t>;

constexpr std::size_t line = 8;  ///< words of a cache line

double median_seconds(
    const std::function<void()>& work, const std::function<void()>& before = [] {}) {
    std::array<double, 5> seconds{};
    for (double& s : seconds) {
        before();
        const auto start = std::chrono::steady_clock::now();
        work();
        s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    std::ranges::sort(seconds);
    return seconds[2];
}

/// work(thread) on each of them.
void on_threads(std::size_t threads, const std::function<void(std::size_t)>& work) {
    std::vector<std::thread> others;
    for (std::size_t t = 1; t < threads; ++t) others.emplace_back(work, t);
    work(0);
    for (std::thread& other : others) other.join();
}

void tell(const std::string& what, double value, const char* unit) {
    std::printf("%-64s %9.3g %s\n", what.c_str(), value, unit);
    std::fflush(stdout);
}

std::string of_threads(std::size_t threads) {
    return threads == 1 ? ", 1 thread" : ", " + std::to_string(threads) + " threads";
}

void in_sequence(Words& words, std::size_t threads) {
    const std::size_t part = words.size() / threads;
    const double bytes = 8.0 * static_cast<double>(part * threads);
    std::vector<std::uint64_t> sums(threads);
    const double read = median_seconds([&] {
        on_threads(threads, [&](std::size_t t) {
            sums[t] = std::accumulate(&words[t * part], &words[t * part] + part, std::uint64_t{0});
        });
    });
    for (std::size_t t = 0; t < threads; ++t) require(sums[t] == part * words[0], "a sum of what was read");
    tell("memory read in sequence" + of_threads(threads), 1e-9 * bytes / read, "GB/s");
    std::uint64_t value = words[0];
    const double write = median_seconds([&] {
        ++value;
        on_threads(threads, [&](std::size_t t) { std::fill_n(&words[t * part], part, value); });
    });
    require(words[threads * part - 1] == value, "what was written");
    tell("memory written in sequence" + of_threads(threads), 1e-9 * bytes / write, "GB/s");
}

/// One cycle through all lines in random order: the first word of each line says which is next.
void link_lines(Words& words) {
    const std::size_t lines = words.size() / line;
    std::vector<std::uint32_t> order(lines);
    std::iota(order.begin(), order.end(), 0U);
    base::Random random(1);
    for (std::size_t i = lines - 1; i > 0; --i) std::swap(order[i], order[random.below(i + 1)]);
    for (std::size_t i = 0; i < lines; ++i) words[line * order[i]] = order[(i + 1) % lines];
}

/// `flight` walks side by side, `steps` each; the time of a line.
template <std::size_t flight>
double seconds_of_line(const Words& words, std::size_t threads, std::size_t steps) {
    const std::size_t lines = words.size() / line;
    const double seconds = median_seconds([&] {
        on_threads(threads, [&](std::size_t t) {
            std::array<std::uint64_t, flight> at{};
            for (std::size_t k = 0; k < flight; ++k) at[k] = (t * flight + k) * lines / (threads * flight);
            for (std::size_t step = 0; step < steps; ++step) {
                for (std::uint64_t& a : at) a = words[line * a];
            }
            require(std::ranges::all_of(at, [&](std::uint64_t a) { return a < lines; }), "a walk over lines");
        });
    });
    return seconds / static_cast<double>(steps * flight * threads);
}

void far_apart(Words& words, std::size_t threads, bool quick) {
    link_lines(words);
    const std::size_t steps = quick ? 1U << 10U : 1U << 18U;
    const auto row = [&]<std::size_t flight>(std::integral_constant<std::size_t, flight>, std::size_t on) {
        tell("a cache line from anywhere in memory, " + std::to_string(flight) + " in flight" + of_threads(on),
             1e9 * seconds_of_line<flight>(words, on, steps), "ns");
    };
    row(std::integral_constant<std::size_t, 1>(), 1);
    row(std::integral_constant<std::size_t, 2>(), 1);
    row(std::integral_constant<std::size_t, 4>(), 1);
    row(std::integral_constant<std::size_t, 8>(), 1);
    row(std::integral_constant<std::size_t, 16>(), 1);
    row(std::integral_constant<std::size_t, 16>(), threads);
}

void gathers(std::size_t most) {
    for (const std::size_t bytes : {std::size_t{1} << 14, std::size_t{1} << 19, most}) {
        std::vector<double> numbers;
        base::resize_large(numbers, bytes / sizeof(double));
        std::ranges::fill(numbers, 1.0);
        std::vector<std::int64_t> at(std::size_t{1} << 12);
        base::Random random(2);
        const std::size_t rounds = bytes < most ? 256 : 16;
        double seconds = 0, sum = 0;
        for (std::size_t round = 0; round < rounds; ++round) {  // other places each round, as far as there are others
            for (std::int64_t& a : at) a = static_cast<std::int64_t>(random.below(numbers.size()));
            const auto start = std::chrono::steady_clock::now();
            sum += HWY_DYNAMIC_DISPATCH(gathered)(numbers.data(), at.data(), at.size());
            seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        }
        const auto count = static_cast<double>(rounds * at.size());
        require(sum == count, "a sum of what was gathered");
        tell("a double gathered by " + simd_target() + " from " + std::to_string(bytes >> 10U) + " KiB",
             1e9 * seconds / count, "ns");
    }
}

void new_pages(std::size_t bytes) {
    constexpr std::size_t small_page = 4096;
    for (const bool large : {false, true}) {
        const double seconds = median_seconds([&] {
            const base::Mapping memory = base::map_memory(bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS);
            require(memory != nullptr, "memory for new pages");
            ::madvise(memory.get(), bytes, large ? MADV_HUGEPAGE : MADV_NOHUGEPAGE);
            for (std::size_t i = 0; i < bytes; i += small_page) static_cast<volatile char*>(memory.get())[i] = 1;
        });
        tell(std::string("4 KiB of new memory touched and given back, ") + (large ? "large" : "usual") + " pages",
             1e9 * seconds * small_page / static_cast<double>(bytes), "ns");
    }
}

/// A file without a name in the folder for temporary files, in blocks that lie in the cache.
void files(std::size_t bytes) {
    const std::string folder = std::filesystem::temp_directory_path();
    std::string block(std::size_t{1} << 18, 'x');
    base::Descriptor file;
    const auto rate = [&](double seconds) { return 1e-9 * static_cast<double>(bytes) / seconds; };
    const auto begin = [&] {
        file.close();
        file = base::Descriptor(::open(folder.c_str(), O_RDWR | O_TMPFILE | O_CLOEXEC, 0600));
    };
    const auto write = [&] {
        for (std::size_t at = 0; at < bytes; at += block.size()) require(file.write(block), "a file without a name");
    };
    const double written = median_seconds(write, begin);
    tell("a new file written, not to the disk", rate(written), "GB/s");
    const double read = median_seconds([&] {
        for (std::size_t at = 0; at < bytes; at += block.size())
            require(::pread(file.number, block.data(), block.size(), static_cast<off_t>(at)) ==
                        static_cast<ssize_t>(block.size()),
                    "a file read");
    });
    tell("the same read into memory", rate(read), "GB/s");
    std::uint64_t sum = 0;
    const double mapped = median_seconds([&] {
        const base::Mapping memory = base::map_memory(bytes, PROT_READ, MAP_SHARED, file.number);
        require(memory != nullptr, "a file mapped");
        const auto* const words = reinterpret_cast<const std::uint64_t*>(memory.get());
        sum = std::accumulate(words, words + bytes / 8, std::uint64_t{0});
    });
    require(sum == bytes / 8 * std::uint64_t{0x7878787878787878}, "the sum of a mapped file");
    tell("the same mapped and read", rate(mapped), "GB/s");
}

/// By bits `shift` to `shift` + 10.
void sort_by_digit(const Words& from, Words& to, int shift) {
    std::array<std::uint32_t, 2048> begin{};
    for (const std::uint64_t key : from) ++begin[key >> shift & 2047U];
    std::exclusive_scan(begin.begin(), begin.end(), begin.begin(), 0U);
    for (const std::uint64_t key : from) to[begin[key >> shift & 2047U]++] = key;
}

void radix_sort(std::size_t count) {
    Words keys(count), sorted(count), other(count);
    base::Random random(3);
    for (std::uint64_t& key : keys) key = random.bits() >> 31U;  // 33 bits: three digits
    const double seconds = median_seconds([&] {
        sort_by_digit(keys, sorted, 0);
        sort_by_digit(sorted, other, 11);
        sort_by_digit(other, sorted, 22);
    });
    require(std::ranges::is_sorted(sorted), "a radix sort");
    tell("keys of 33 bits, 8 bytes each, sorted by radix, a key", 1e9 * seconds / static_cast<double>(count), "ns");
}

}  // namespace
}  // namespace barycert::bench

int main(int argc, char** argv) {
    using namespace barycert::bench;
    const bool quick = argc > 1 && std::string_view(argv[1]) == "--quick";
    const std::size_t bytes = std::size_t{1} << (quick ? 24U : 29U);
    const std::size_t threads = std::max(1U, std::thread::hardware_concurrency());
    Words words;
    barycert::base::resize_large(words, bytes / sizeof(std::uint64_t));
    std::ranges::fill(words, 1);
    in_sequence(words, 1);
    if (threads > 1) in_sequence(words, threads);
    far_apart(words, threads, quick);
    gathers(bytes);
    new_pages(bytes / 2);
    files(bytes / 2);
    radix_sort(quick ? 1U << 14U : 1'000'000);
    return 0;
}
#endif
