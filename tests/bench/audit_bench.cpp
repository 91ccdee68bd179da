// A whole audit: every tetrahedron kernel on a million cases from a mesh; time per case, and memory against the number
// of cases.

#include <benchmark/benchmark.h>

#include <algorithm>

#include "barycert/audit.hpp"
#include "barycert/baseline.hpp"
#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/choices.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/finding.hpp"
#include "barycert/fix.hpp"
#include "barycert/gmsh_files.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/kernels.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/rule_audit.hpp"
#include "barycert/series.hpp"
#include "barycert/statistics.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/surface_rules.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/threshold.hpp"
#include "barycert/vtk_files.hpp"
#include "barycert/witness.hpp"
#include "peak_memory.hpp"

namespace {

using namespace barycert;

void audit_mesh_cases(benchmark::State& state) {
    MeshSource meshes;
    meshes.add("bracket", read_tetgen(BARYCERT_DATA_DIR "/meshes/bracket").value());
    AuditOptions options;
    options.kernels = kernels_matching("tetrahedron.*");
    options.families = families_matching("mesh.*");
    options.threads = static_cast<int>(state.range(0));
    const auto applies = [](const Family& f) { return f.applies_to(Simplex::tetrahedron); };
    const auto parts = std::count_if(options.families.begin(), options.families.end(), applies);
    options.count = static_cast<std::uint64_t>(state.range(1)) / static_cast<std::uint64_t>(parts);
    for (auto _ : state) {
        const AuditReport report = run_audit(options, meshes).value();
        // Verified before it is believed: every case was met, and the worst and a sound kernel stand where they must.
        const KernelStatistics& worst = report.kernels.front().total;
        const KernelStatistics& best = report.kernels.back().total;
        if (report.cases != options.count * static_cast<std::uint64_t>(parts) || worst.cases != report.cases ||
            worst.wrong_cases * 3 < worst.cases || best.wrong_cases * 20 > best.cases) {
            state.SkipWithError("the audit is wrong");
        }
    }
    state.counters["cases/s"] =
        benchmark::Counter(static_cast<double>(state.range(1)), benchmark::Counter::kIsIterationInvariantRate);
    state.counters["kernels"] = static_cast<double>(options.kernels.size());
    state.counters["peak MiB so far"] = barycert::bench::peak_mib();
}

}  // namespace

// Small counts first: if memory grew with cases, the last line's peak would show it.
BENCHMARK(audit_mesh_cases)
    ->ArgNames({"threads", "cases"})
    ->Args({1, 10000})
    ->Args({2, 100000})
    ->Args({1, 1000000})
    ->Args({2, 1000000})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1);

BENCHMARK_MAIN();
