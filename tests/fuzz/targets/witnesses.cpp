// Witnesses of findings: read, written and read again; and of a file with one, what the kernels answer today.
#include <bit>
#include <cstdint>

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
#include "barycert/inverse_rules.hpp"
#include "barycert/kernels.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc.hpp"
#include "barycert/rule_audit.hpp"
#include "barycert/statistics.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/surface_rules.hpp"
#include "barycert/threshold.hpp"
#include "barycert/witness.hpp"
#include "tests/fuzz/files.hpp"
#include "tests/fuzz/target.hpp"

namespace barycert::fuzz {
namespace {

template <std::size_t n>
bool same_bits(const std::array<double, n>& a, const std::array<double, n>& b) {
    for (std::size_t i = 0; i < n; ++i) {
        if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
    }
    return true;
}

/// `mesh` is written where there is a cell.
bool same(const Witness& a, const Witness& b) {
    return a.kernel == b.kernel && a.reason == b.reason && a.family == b.family && a.seed == b.seed &&
           a.index == b.index && a.cell == b.cell && (a.cell < 0 || a.mesh == b.mesh) && a.detail == b.detail &&
           a.magnitude == b.magnitude && a.c.simplex == b.c.simplex && a.c.perspective == b.c.perspective &&
           same_bits(a.c.vertices, b.c.vertices) && same_bits(a.c.point, b.c.point) &&
           same_bits(a.c.values, b.c.values);
}

}  // namespace

BARYCERT_FUZZ_TARGET(witnesses) {
    static InputFile file("in.json"), out("out.json");
    const Result<std::vector<Witness>> witnesses = read_witnesses(file.put(input));
    if (!witnesses) return expect_useful(witnesses.error(), lines_of(input));
    AuditReport report;
    report.kernels.resize(1);
    report.kernels.front().witnesses = *witnesses;
    const Result<std::vector<Witness>> again = read_witnesses(out.put(witnesses_json(report)));
    expect(bool(again), "witnesses that were written are not read", again ? "" : again.error().message());
    expect(again->size() == witnesses->size(), "another number of witnesses came back");
    for (std::size_t i = 0; i < again->size(); ++i)
        expect(same((*again)[i], (*witnesses)[i]), "another witness came back", (*witnesses)[i].kernel);
    if (witnesses->size() == 1) static_cast<void>(replay_witness(witnesses->front(), catalogue()));
}

}  // namespace barycert::fuzz
