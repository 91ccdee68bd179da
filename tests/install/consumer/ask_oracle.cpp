// barycert::audit: ask the oracle, and run a small audit to its report.

#include <cstdio>

#include "barycert/audit.hpp"
#include "barycert/audit_report.hpp"
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

int main() {
    using namespace barycert;
    Case c;
    c.simplex = Simplex::triangle;
    c.vertices = {0, 0, 3, 0, 0, 3};
    c.point = {1, 1};
    c.values = {0, 1, 2};
    const OracleAnswer answer = ask_oracle(c);

    AuditOptions options;
    options.kernels = kernels_matching("tetrahedron.inverse");
    options.families = families_matching("huge");
    options.count = 10;
    options.threads = 1;
    const auto report = run_audit(options, {});
    if (!report) return 2;
    std::printf("%s, third %s, value %g, report %s\n", name(answer.region).data(),
                answer.weights[1] == 1.0 / 3 ? "exact" : "wrong", answer.value,
                audit_json(*report).size() > 1000 ? "long" : "short");
    return 0;
}
