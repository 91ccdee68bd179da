// barycert replay: show a witness, every kernel's weights next to the exact ones.

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/cli/audit_inputs.hpp"
#include "app/cli/command.hpp"
#include "app/cli/options.hpp"
#include "app/cli/reports.hpp"
#include "app/options/parser.hpp"
#include "barycert/audit_job.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/choices.hpp"
#include "barycert/environment.hpp"
#include "barycert/error_codes.hpp"
#include "barycert/kernels.hpp"
#include "barycert/report.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/witness.hpp"
#include "core/base/nearest_name.hpp"
#include "core/base/text.hpp"

namespace barycert::cli {
namespace {

/// The job is the case that is generated, or what witnesses of the file are to be shown.
struct ReplayArguments : Arguments<CaseJob> {
    std::string file;
    std::vector<std::string> meshes;
    KernelChoice kernels{.names = {"*"}};
    std::optional<std::uint64_t> index;
    bool all = false;
};

/// The remedy where no witness of the file matches; names the nearest one if none has that of --kernel or --reason.
std::string where_none_matches(const CaseJob& wanted, const std::vector<Witness>& witnesses) {
    const char* const rest = "leave out --kernel and --reason to see all";
    for (const auto& wish : {std::pair(wanted.kernel, &Witness::kernel), std::pair(wanted.reason, &Witness::reason)}) {
        std::vector<std::string> names;
        std::ranges::transform(witnesses, std::back_inserter(names), wish.second);
        const auto matches = [&](const std::string& name) { return base::glob_match(wish.first, name); };
        if (!wish.first.empty() && std::ranges::none_of(names, matches))
            return base::did_you_mean(wish.first, names, rest);
    }
    return rest;
}

void check_arguments(const ReplayArguments& a) {
    if (a.file.empty() == a.job.family.empty())
        throw Exception({.code = a.file.empty() ? ErrorCode("option.missing") : ErrorCode("option.conflict"),
                         .what = a.file.empty() ? "no case to replay" : "a witness file and a case",
                         .expected = "either a witness file, or --family and --case"});
    if (!a.job.family.empty() && !a.index) throw Exception({.code = "option.missing", .what = "--family needs --case"});
    const std::string of_case = given_option(*a.app, {"--case", "--seed", "--simplex"});
    if (!a.file.empty() && !of_case.empty())
        throw Exception({.code = "option.conflict",
                         .what = of_case + " is for a case that is generated",
                         .expected = "a witness file without it, or --family and --case"});
    if (std::error_code ignored; std::filesystem::is_directory(a.file, ignored))
        throw Exception({.code = "file.unreadable",
                         .what = "cannot read the witnesses",
                         .file = a.file,
                         .expected = "a file",
                         .found = "a folder"});
}

/// Returns the witnesses of the file, or the one that --family and --case describe, made again.
std::vector<Witness> witnesses_of(ReplayArguments& a, const std::vector<Kernel>& kernels) {
    if (!a.file.empty()) return read_witnesses(a.file).value();
    a.job.index = *a.index;
    // Where they are missing, it is told only if the family draws from meshes.
    const auto meshes = meshes_or_own(a.meshes);
    if (meshes) a.job.meshes = *meshes;
    Result<Witness> made = make_witness(a.job, kernels, read_audited);
    if (!made && !meshes && made.error().code == "witness.mesh") throw Exception(meshes.error());
    return {std::move(made).value()};
}

int run_replay(ReplayArguments& a) {
    const std::vector<Kernel> kernels = chosen_kernels(a.kernels).value();
    check_arguments(a);
    const std::vector<Witness> witnesses = witnesses_of(a, kernels);
    bool any = false, all_reproduced = true;
    for (const Witness& w : witnesses) {
        const CaseJob& wanted = a.job;
        if (!a.file.empty() && !wanted.kernel.empty() && !base::glob_match(wanted.kernel, w.kernel)) continue;
        if (!a.file.empty() && !wanted.reason.empty() && !base::glob_match(wanted.reason, w.reason)) continue;
        const Replay replay = replay_witness(w, kernels);
        const std::string above = any ? "\n" : environment_line(measure_environment()) + "\n\n";
        write_output("-", above + witness_text(replay, {.colour = colour_on_stdout()}, a.all)).value();
        any = true;
        if (replay.not_reproduced.empty()) continue;
        tell(base::printable(fmt::format("not reproduced: {} of {}: {}", w.reason, w.kernel, replay.not_reproduced)) +
             "\n");
        all_reproduced = false;
    }
    if (!any)
        return fail({.code = "witness.unknown",
                     .what = "no witness matches",
                     .file = a.file,
                     .remedy = where_none_matches(a.job, witnesses)});
    return all_reproduced ? exit_clean : exit_findings;
}

}  // namespace

void add_replay(const Options& program) {
    const auto& [o, a] =
        program.command("replay", "Show witnesses: a kernel's weights beside the exact ones",
                        "Exit codes: 0 done; 1 a finding is not reproduced; 2 usage or input error.", run_replay);
    o.text("FILE", a.file, "Witnesses from `barycert audit` or `search`: --witnesses FILE or --json FILE");
    o.text("--kernel", a.job.kernel, "Show only witnesses of matching kernels; with --case, mark this kernel",
           "KERNEL|GLOB");
    o.text("--reason", a.job.reason,
           "Show only witnesses of this kind of finding; with --case, the finding it must show", "REASON|GLOB");
    o.text("--family", a.job.family, "Generate a case instead of reading it: its family", "FAMILY");
    o.whole("--case", a.index, "Number of the case to generate", "N");
    add_seed(o, a.job.seed, "Seed of the case to generate");
    o.text("--simplex", a.job.simplex, "Simplex of the case, if family and kernel do not determine it",
           joined(names_of(all_simplices)));
    o.text("--mesh", a.meshes, "Meshes of the case, in the order given to the audit; default: barycert's own", "MESH");
    o.text("--kernel-library", a.kernels.libraries, "Also show the kernel of this library");
    o.flag("--all", a.all, "Show the answers of all kernels, not only of the one in question");
    add_kernel_rules(o, a.kernels);
}

}  // namespace barycert::cli
