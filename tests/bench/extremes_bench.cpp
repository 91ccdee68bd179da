// Times of single calls of the exact core where integers must answer: up to two limbs a number, and at the full spread
// of exponents, where they are widest. Answers are verified elsewhere (tests/laws); here only that there is one.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "exact_table.hpp"
#include "tests/core/extremes.hpp"

namespace {

using namespace barycert;
namespace extreme = testing_extremes;

constexpr int cases = 5000, repetitions = 5;

/// Microseconds of each case: of its fastest call.
std::vector<double> times_of(const extreme::Call& call, const std::vector<extreme::Extreme>& all) {
    std::vector<double> times;
    for (const extreme::Extreme& e : all) {
        double min = std::numeric_limits<double>::infinity();
        for (int i = 0; i < repetitions; ++i) {
            const double start = bench::seconds();
            const bool good = call.ask(e);
            min = std::min(min, 1e6 * (bench::seconds() - start));
            if (!good) {
                std::fprintf(stderr, "no answer: %s\n", call.name.c_str());
                std::exit(EXIT_FAILURE);
            }
        }
        times.push_back(min);
    }
    return times;
}

void print(const std::vector<double>& times) {
    std::printf("%10.2f%10.2f", bench::median(times), *std::max_element(times.begin(), times.end()));
}

}  // namespace

int main() {
    std::printf("Of %d cases, each the fastest of %d calls, one thread, its own time, microseconds.\n", cases,
                repetitions);
    std::printf("%-36s%20s%20s\n%-36s", "", "point at a vertex,", "full spread of", "");
    std::printf("%20s%20s\n%-36s%10s%10s%10s%10s\n", "spread 2^72", "exponents", "", "median", "max", "median", "max");
    const auto narrow = extreme::extremes(cases, extreme::two_limbs), wide = extreme::extremes(cases);
    const auto at_vertex = extreme::single_calls(extreme::Point::first), anywhere = extreme::single_calls();
    for (std::size_t i = 0; i < anywhere.size(); ++i) {
        std::printf("%-36s", anywhere[i].name.c_str());
        print(times_of(at_vertex[i], narrow));
        print(times_of(anywhere[i], wide));
        std::printf("\n");
    }
}
