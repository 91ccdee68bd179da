// What barycert-audit has in place of what only barycert has: readers of other formats than TetGen's, checks and rules
// are much of the time of building.

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "app/cli/audit_inputs.hpp"
#include "app/cli/command.hpp"
#include "app/cli/tetgen_alone.hpp"
#include "barycert/certificate.hpp"
#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/result.hpp"
#include "barycert/tetgen_files.hpp"

namespace barycert::cli {
namespace {

/// Fingerprints of barycert's own meshes, all of them certified (a test of tests/mesh/check); a line each.
std::vector<std::uint64_t> own_certificates() {
    std::ifstream file(data_folder() / "certified.txt");
    std::vector<std::uint64_t> all;
    std::string fingerprint, name;
    while (file >> fingerprint >> name) all.push_back(std::stoull(fingerprint, nullptr, 16));
    return all;
}

[[noreturn]] void refuse_rules(const char* option) {
    throw Exception(
        {.code = "option.unfit",
         .what = fmt::format("barycert-audit does not know {}", option),
         .remedy = fmt::format("`barycert audit {}` does; among the sources: ./run audit {}", option, option)});
}

}  // namespace

std::vector<std::string> audited_files(const std::string& path) {
    return tetgen_files(path);
}

Result<Mesh> read_audited(const std::string& path, const ReadOptions& options) try {
    refuse_other_formats(path, "barycert-audit");
    return read_tetgen(path, options);
} catch (const Exception& e) {
    return e.error();
}

Certificate certify_audited(const Mesh& mesh, int /*threads*/) {
    static const std::vector<std::uint64_t> own = own_certificates();
    const Certificate certificate = Certificate::known(mesh, own);
    if (certificate.verdict() == Verdict::not_checked)
        tell("note: barycert-audit checks no meshes but knows its own; `barycert audit` checks\n");
    return certificate;
}

int run_surface_rules(const RuleRun& /*run*/) {
    refuse_rules("--surfaces");
}

int run_inverse_rules(const RuleRun& /*run*/) {
    refuse_rules("--inverse-maps");
}

}  // namespace barycert::cli
