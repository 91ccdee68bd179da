// The oracle against other exact ways to four weights of a point in a tetrahedron.
//
// Compared: this oracle (signs, region, four correctly rounded weights and the value), the same by wide integers, and
// plain exact weights in CGAL's Gmpq, Mpzf (determinants only: it has no division) and Epeck, each of which would still
// have to be rounded.

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Mpzf.h>
#include <benchmark/benchmark.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "barycert/oracle.hpp"
#include "core/base/random.hpp"
#include "numerators.hpp"

namespace {

using namespace barycert;

constexpr std::size_t count = 4096;

enum Kind { unit_cube, lattice, wide };

std::vector<Case> make_cases(Kind kind) {
    std::vector<Case> cases(count);
    base::Random random(1);
    for (Case& c : cases) {
        const auto coordinate = [&] {
            return kind == lattice     ? random.integer(-8, 8)
                   : kind == unit_cube ? random.unit()
                                       : random.scaled(-1, 1, -60, 60);
        };
        for (double& x : c.vertices) x = coordinate();
        for (double& x : c.point) x = coordinate();
        for (double& x : c.values) x = random.uniform(-1, 1);
    }
    return cases;
}

void verify(const std::vector<Case>& cases) {
    for (const Case& c : cases) {
        const auto n = barycert::bench::numerators<CGAL::Gmpq>(c);
        const CGAL::Gmpq whole = n[0] + n[1] + n[2] + n[3];
        const OracleAnswer a = ask_oracle(c), w = exact::ask_wide(c);
        for (std::size_t i = 0; i < 4; ++i) {
            const int sign = static_cast<int>(CGAL::sign(n[i])) * static_cast<int>(CGAL::sign(whole));
            const bool weights_agree = a.weights[i] == w.weights[i] || a.region == Region::degenerate;
            if (sign != a.signs[i] || !weights_agree) {
                std::fprintf(stderr, "the oracle disagrees with CGAL::Gmpq\n");
                std::exit(1);
            }
        }
    }
}

template <class Work>
void run(benchmark::State& state, Kind kind, Work work) {
    const auto cases = make_cases(kind);
    verify(cases);
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(work(cases[i]));
        i = (i + 1) % count;
    }
}

double exact_gmpq(const Case& c) {
    const auto n = barycert::bench::numerators<CGAL::Gmpq>(c);
    const CGAL::Gmpq whole = n[0] + n[1] + n[2] + n[3];
    if (whole == CGAL::Gmpq(0)) return 0;
    return CGAL::to_double(n[0] / whole) + CGAL::to_double(n[1] / whole) + CGAL::to_double(n[2] / whole) +
           CGAL::to_double(n[3] / whole);
}

double exact_epeck(const Case& c) {
    using FT = CGAL::Exact_predicates_exact_constructions_kernel::FT;
    const auto n = barycert::bench::numerators<FT>(c);
    const FT whole = n[0] + n[1] + n[2] + n[3];
    if (CGAL::is_zero(whole)) return 0;
    double sum = 0;
    for (const FT& x : n) sum += CGAL::to_double((x / whole).exact());
    return sum;
}

double signs_mpzf(const Case& c) {
    const auto n = barycert::bench::numerators<CGAL::Mpzf>(c);
    return static_cast<double>(CGAL::sign(n[0]) + CGAL::sign(n[1]) + CGAL::sign(n[2]) + CGAL::sign(n[3]));
}

void add(const char* name, Kind kind, double (*work)(const Case&)) {
    benchmark::RegisterBenchmark(name, [=](benchmark::State& state) { run(state, kind, work); });
}

double ask(const Case& c) {
    return ask_oracle(c).weights[0];
}
double ask_wide(const Case& c) {
    return exact::ask_wide(c).weights[0];
}

}  // namespace

int main(int argc, char** argv) {
    add("oracle/unit-cube", unit_cube, ask);
    add("oracle/lattice", lattice, ask);
    add("oracle/wide-exponents", wide, ask);
    add("oracle-wide/unit-cube", unit_cube, ask_wide);
    add("CGAL-Mpzf-signs-only/unit-cube", unit_cube, signs_mpzf);
    add("CGAL-Gmpq-weights/unit-cube", unit_cube, exact_gmpq);
    add("CGAL-Epeck-weights/unit-cube", unit_cube, exact_epeck);
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
