#include "sample_contest.hpp"

#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>
#include <utility>

namespace barycert::bench {
namespace {

double cpu_seconds() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Seconds time(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    const double cpu = cpu_seconds();
    work();
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), cpu_seconds() - cpu};
}

double median(std::vector<double> values) {
    if (values.empty()) return nothing;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

void Contest::add(const std::string& name, std::function<void()> work, std::function<void()> prepare) {
    entries_.push_back({name, std::move(work), std::move(prepare)});
}

void Contest::run(int repetitions) {
    for (int repetition = 0; repetition < repetitions; ++repetition) {
        for (Entry& entry : entries_) {
            const auto once = [&] {
                if (entry.prepare) entry.prepare();
                return time(entry.work);
            };
            Seconds taken = once();
            if (taken.wall < 0.5) taken = once();
            entry.times.push_back(taken);
            std::fprintf(stderr, "  %d/%d %-40s %10.4f s, %10.4f s of processor\n", repetition + 1, repetitions,
                         entry.name.c_str(), taken.wall, taken.cpu);
        }
    }
}

const Contest::Entry* Contest::find(const std::string& name) const {
    const auto found =
        std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.name == name; });
    return found == entries_.end() ? nullptr : &*found;
}

double Contest::middle(const std::string& name, double Seconds::*which) const {
    const Entry* const entry = find(name);
    if (entry == nullptr) return nothing;
    std::vector<double> values;
    for (const Seconds& s : entry->times) values.push_back(s.*which);
    return median(std::move(values));
}

double Contest::wall(const std::string& name) const {
    return middle(name, &Seconds::wall);
}

double Contest::cpu(const std::string& name) const {
    return middle(name, &Seconds::cpu);
}

double Contest::ratio(const std::string& slow, const std::string& fast, double Seconds::*which) const {
    const Entry* const a = find(slow);
    const Entry* const b = find(fast);
    if (a == nullptr || b == nullptr) return nothing;
    std::vector<double> values;
    for (std::size_t i = 0; i < a->times.size(); ++i) values.push_back(a->times[i].*which / (b->times[i].*which));
    return median(std::move(values));
}

double Contest::cpu_ratio(const std::string& slow, const std::string& fast) const {
    return ratio(slow, fast, &Seconds::cpu);
}

double Contest::wall_ratio(const std::string& slow, const std::string& fast) const {
    return ratio(slow, fast, &Seconds::wall);
}

}  // namespace barycert::bench
