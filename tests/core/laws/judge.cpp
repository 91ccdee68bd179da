// judge signs|values N [threads] [seed]: the core against its judges (see judge.hpp) over N cases in all, spread evenly
// over families and simplices. A table per family in the end; exit code 1 at any disagreement, 2 at a wrong call.

#include <atomic>
#include <charconv>
#include <cstring>
#include <mutex>
#include <thread>

#include "judge.hpp"

namespace barycert::laws {
namespace {

constexpr std::uint64_t chunk = 16 * Block::capacity;

struct Call {
    bool signs = true;
    std::uint64_t cases = 0;
    unsigned threads = 2;
    std::uint64_t seed = 970326;  // not the tests': other cases
};

bool parse(int argc, char** argv, Call& call) {
    if (argc < 3 || argc > 5) return false;
    call.signs = std::strcmp(argv[1], "signs") == 0;
    if (!call.signs && std::strcmp(argv[1], "values") != 0) return false;
    const auto number = [&](int i, auto& to) {
        if (i >= argc) return true;
        const char* const end = argv[i] + std::strlen(argv[i]);
        const auto [stop, error] = std::from_chars(argv[i], end, to);
        return error == std::errc{} && stop == end;
    };
    return number(2, call.cases) && number(3, call.threads) && number(4, call.seed) && call.cases > 0 &&
           call.threads > 0;
}

double per_case(double seconds, std::uint64_t cases) {
    return cases == 0 ? 0 : 1e9 * seconds / static_cast<double>(cases);
}

void print_row(const std::string& title, const Tally& t) {
    std::printf("%-24s %12llu %6llu %12llu %12llu %12llu %10llu %9.1f %9.1f\n", title.c_str(),
                static_cast<unsigned long long>(t.cases), static_cast<unsigned long long>(t.disagreements),
                static_cast<unsigned long long>(t.tiers.filter), static_cast<unsigned long long>(t.tiers.double_double),
                static_cast<unsigned long long>(t.tiers.exact), static_cast<unsigned long long>(t.tiers.degenerate),
                per_case(t.own_seconds, t.cases), per_case(t.judge_seconds, t.cases));
}

int run(const Call& call) {
    const std::vector<Subject> subjects = all_subjects();
    own_meshes();  // read before the threads start
    const std::uint64_t each = (call.cases - 1) / subjects.size() + 1, chunks = (each - 1) / chunk + 1;
    std::vector<Tally> tallies(subjects.size());
    std::mutex mutex;
    std::atomic<std::uint64_t> next{0}, done{0};
    const Stopwatch clock;
    const auto work = [&] {
        for (std::uint64_t task = next++; task < subjects.size() * chunks; task = next++) {
            const std::size_t i = static_cast<std::size_t>(task % subjects.size());
            const std::uint64_t first = task / subjects.size() * chunk, count = std::min(chunk, each - first);
            const Tally tally = call.signs ? judge_signs(subjects[i], call.seed, first, count)
                                           : judge_values(subjects[i], call.seed, first, count, false);
            const std::lock_guard lock(mutex);
            tallies[i].add(tally);
            done += count;
            if (tally.disagreements != 0) std::fprintf(stderr, "\n%s", tally.first.front().c_str());
            if (task % 16 == 0)
                std::fprintf(stderr, "\r%llu of %llu cases, %.0f s ", static_cast<unsigned long long>(done),
                             static_cast<unsigned long long>(each * subjects.size()), clock.seconds());
        }
    };
    std::vector<std::thread> threads;
    for (unsigned t = 0; t < call.threads; ++t) threads.emplace_back(work);
    for (std::thread& t : threads) t.join();
    std::fprintf(stderr, "\n");

    std::printf("%-24s %12s %6s %12s %12s %12s %10s %9s %9s\n", "family", "cases", "wrong", "filter", "dbl-double",
                "exact", "degenerate", "ns own", "ns judge");
    Tally total;
    for (const Family& f : all_families()) {
        if (f.perspective) continue;
        Tally of_family;
        for (std::size_t i = 0; i < subjects.size(); ++i) {
            if (subjects[i].family == &f) of_family.add(tallies[i]);
        }
        print_row(f.name, of_family);
        total.add(of_family);
    }
    print_row("all", total);
    const double seconds = clock.seconds();
    std::printf("%s, seed %llu, %u threads: %.1f s, %.0f ns per case and thread\n", call.signs ? "signs" : "values",
                static_cast<unsigned long long>(call.seed), call.threads, seconds,
                per_case(seconds * call.threads, total.cases));
    for (const std::string& text : total.first) std::printf("\n%s", text.c_str());
    return total.disagreements == 0 && total.cases == each * subjects.size() ? 0 : 1;
}

}  // namespace
}  // namespace barycert::laws

int main(int argc, char** argv) {
    barycert::laws::Call call;
    if (!barycert::laws::parse(argc, argv, call)) {
        std::fprintf(stderr, "usage: barycert_judge signs|values N [threads] [seed]\n");
        return 2;
    }
    return barycert::laws::run(call);
}
