// What barycert-audit has only a part of: all formats of meshes, checks of them, audits of rules.

#include <string>
#include <vector>

#include "app/cli/audit_inputs.hpp"
#include "app/cli/reports.hpp"
#include "barycert/audit.hpp"
#include "barycert/audit_job.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/certificate.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/report.hpp"
#include "barycert/result.hpp"
#include "barycert/surface_rules.hpp"

namespace barycert::cli {
namespace {

template <class Audit>
int run_rules(const RuleRun& run, void (*ask)(Audit&), std::string (*text)(const Audit&, const TerminalStyle&),
              std::string (*json)(const Audit&), std::string (*html)(const Audit&)) {
    run.reports.check({});
    const AuditOptions& o = run.options;
    Audit audit{.seed = o.seed, .count = o.count, .threads = o.threads, .progress = run.progress};
    ask(audit);
    return run.reports.end(Result<Audit>(std::move(audit)), [&](const Audit& done) {
        return Told{.files = {{"--json", [&] { return json(done); }}, {"--html", [&] { return html(done); }}},
                    .text = [&](bool colour) { return text(done, {.colour = colour}); }};
    });
}

}  // namespace

std::vector<std::string> audited_files(const std::string& path) {
    return mesh_files(path);
}

Result<Mesh> read_audited(const std::string& path, const ReadOptions& options) {
    return read_mesh(path, options);
}

Certificate certify_audited(const Mesh& mesh, int threads) {
    return certify_mesh(mesh, threads);
}

int run_surface_rules(const RuleRun& run) {
    return run_rules(run, audit_surfaces, surfaces_text, surfaces_json, surfaces_html);
}

int run_inverse_rules(const RuleRun& run) {
    return run_rules(run, audit_inverses, inverses_text, inverses_json, inverses_html);
}

}  // namespace barycert::cli
