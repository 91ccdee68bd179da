// barycert::audit: ask the oracle, and run a small audit to its report.

#include <cstdio>

#include "barycert/audit.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/oracle.hpp"

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
