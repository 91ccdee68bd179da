// The table of bench_exact: groups of rows that are timed turn by turn, and demands on their ratios.
#pragma once

#include <time.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/simplex.hpp"

namespace barycert::bench {

/// The thread's own time: others on the machine may slow it down, but are not counted.
inline double seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

inline double median(std::vector<double> x) {
    const auto middle = x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2);
    std::nth_element(x.begin(), middle, x.end());
    return *middle;
}

struct Row {
    std::string what;
    double cases = 1;                             ///< the time is divided by this
    std::function<void()> work;                   //
    bool peer = false;                            ///< independent of the SIMD target: timed once a repetition
    TierCounts tiers = {};                        ///< of one run; none for peers
    std::vector<std::vector<double>> times = {};  ///< ns per case [target][repetition]

    const std::vector<double>& at(std::size_t target) const { return times[peer ? 0 : target]; }
};

/// `slow` / `fast` >= limit, or with `at_most` <= limit; a slow row without a fast one has its time limited.
struct Demand {
    std::string what;
    std::size_t slow = 0, fast = none;
    double limit = 1;
    bool at_most = false;

    static constexpr std::size_t none = ~std::size_t{0};
};

class TargetTable {
public:
    TargetTable() : targets_(simd_targets()) { std::reverse(targets_.begin(), targets_.end()); }

    const std::vector<std::string>& targets() const { return targets_; }

    /// Runs the rows of a group turn by turn, on one target after the other, and prints them.
    void run(const std::string& title, std::vector<Row>& rows, int repetitions) const {
        for (Row& row : rows) row.times.assign(row.peer ? 1 : targets_.size(), {});
        for (int repetition = -1; repetition < repetitions; ++repetition) {  // the first only warms up
            for (std::size_t t = 0; t < targets_.size(); ++t) {
                use_simd_target(targets_[t]);
                for (Row& row : rows) {
                    // A peer runs next to the widest target, against which the demands are read.
                    if (row.peer && t + 1 != targets_.size()) continue;
                    const double start = seconds();
                    row.work();
                    const double ns = 1e9 * (seconds() - start) / row.cases;
                    if (repetition >= 0) row.times[row.peer ? 0 : t].push_back(ns);
                }
            }
        }
        use_simd_target("");
        line(title, "ns per case");
        for (const Row& row : rows) print(row);
    }

    void demand(const std::vector<Row>& rows, const Demand& d) const {
        std::printf("  %-58s %s %g%s", d.what.c_str(), d.at_most ? "<=" : ">=", d.limit,
                    d.fast == Demand::none ? " ns" : "x");
        std::printf("%*s", d.limit < 10 ? 4 : d.limit < 100 ? 3 : d.fast == Demand::none ? 1 : 2, "");
        for (std::size_t t = 0; t < targets_.size(); ++t) {
            std::vector<double> x = rows[d.slow].at(t);
            if (d.fast != Demand::none) {
                for (std::size_t i = 0; i < x.size(); ++i) x[i] /= rows[d.fast].at(t)[i];
            }
            const double found = median(x);
            const bool met = d.at_most ? found <= d.limit : found >= d.limit;
            std::printf("%8s%s %s", number(found).c_str(), d.fast == Demand::none ? " " : "x", met ? "pass" : "FAIL");
        }
        std::printf("\n");
    }

    void heading(const std::string& text) const { line(text, "demand"); }

private:
    static std::string number(double x) {
        char text[32];
        std::snprintf(text, sizeof text, x < 9.995 ? "%.2f" : x < 99.95 ? "%.1f" : "%.0f", x);
        return text;
    }

    void line(const std::string& title, const char* unit) const {
        const bool demands = std::string(unit) == "demand";
        std::printf("\n%-*s%*s", demands ? 61 : 58, title.c_str(), demands ? -8 : 11, unit);
        for (const std::string& name : targets_) std::printf(demands ? "%14s" : "%10s", name.c_str());
        std::printf(demands ? "\n" : "   needed exact integers\n");
    }

    void print(const Row& row) const {
        std::printf("  %-66s ", row.what.c_str());
        for (std::size_t t = 0; t < targets_.size(); ++t) {
            const bool shown = !row.peer || t + 1 == targets_.size();
            std::printf("%10s", shown ? number(median(row.at(t))).c_str() : "");
        }
        if (const auto all = static_cast<double>(row.tiers.cases()); all > 0)
            std::printf("   %8.0f of %.0f", static_cast<double>(row.tiers.exact), all);
        std::printf("\n");
    }

    std::vector<std::string> targets_;
};

}  // namespace barycert::bench
