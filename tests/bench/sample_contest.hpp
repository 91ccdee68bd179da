/// Things to be timed in turn, so that whatever slows the machine hits all of them.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace barycert::bench {

/// Times of a run: by the clock, and the processor's own of all threads, which does not count what others on the
/// machine do.
struct Seconds {
    double wall = 0, cpu = 0;
};

Seconds time(const std::function<void()>& work);

double median(std::vector<double> values);

class Contest {
public:
    /// `prepare` runs before each run and is not timed.
    void add(const std::string& name, std::function<void()> work, std::function<void()> prepare = {});

    /// All of them in turn, so many times. A run of less than half a second runs twice in each turn, the first time
    /// only to warm up. Progress goes to the standard error.
    void run(int repetitions);

    bool has(const std::string& name) const { return find(name) != nullptr; }

    /// Medians over the runs, in seconds; NaN if there is nothing of that name.
    double wall(const std::string& name) const;
    double cpu(const std::string& name) const;

    /// The median over turns of the quotient of two times in the same turn: of processor time; of the clock.
    double cpu_ratio(const std::string& slow, const std::string& fast) const;
    double wall_ratio(const std::string& slow, const std::string& fast) const;

private:
    struct Entry {
        std::string name;
        std::function<void()> work, prepare;
        std::vector<Seconds> times = {};
    };
    const Entry* find(const std::string& name) const;
    double middle(const std::string& name, double Seconds::*which) const;
    double ratio(const std::string& slow, const std::string& fast, double Seconds::*which) const;

    std::vector<Entry> entries_;
};

}  // namespace barycert::bench
