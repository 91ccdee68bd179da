// barycert replay: show a witness, every kernel's weights next to the exact ones.

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "audit_inputs.hpp"
#include "barycert/audit.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/base/nearest_name.hpp"
#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "command.hpp"
#include "files.hpp"
#include "names.hpp"
#include "options/choice.hpp"

namespace barycert::cli {
namespace {

struct ReplayArguments {
    std::string file, kernel, reason, family, simplex;
    std::vector<std::string> meshes, libraries;
    std::optional<std::uint64_t> index;
    std::uint64_t seed = 1;
    bool all = false;
    std::string of_generated;  ///< an option that was given and is for a generated case
    std::shared_ptr<KernelRules> rules = std::make_shared<KernelRules>();
};

/// What to do where no witness of the file matches; with the nearest name if no witness has that of --kernel or
/// --reason.
std::string where_none_matches(const ReplayArguments& a, const std::vector<Witness>& witnesses) {
    const char* const rest = "leave out --kernel and --reason to see all";
    for (const auto& [glob, name] : {std::pair(a.kernel, &Witness::kernel), std::pair(a.reason, &Witness::reason)}) {
        std::vector<std::string> names;
        bool matched = glob.empty();
        for (const Witness& w : witnesses) {
            names.push_back(w.*name);
            matched = matched || base::glob_match(glob, w.*name);
        }
        if (!matched) return base::did_you_mean(glob, names, rest);
    }
    return rest;
}

/// The witness that --family and --case describe, made again.
Result<std::vector<Witness>> made_again(const ReplayArguments& a, const std::vector<Kernel>& kernels) {
    if (!a.reason.empty() && !finding_named(a.reason))
        return Error{.what = "--reason of a case that is generated",
                     .expected = "a class of finding",
                     .found = '"' + a.reason + '"',
                     .remedy = "leave it out to see the answer whatever it is"};
    const auto families = select_families({a.family});
    if (!families) return families.error();
    if (families->size() != 1 || families->front().name != a.family)
        return Error{.what = "--family must name one family",
                     .found = '"' + a.family + '"',
                     .remedy = base::did_you_mean(a.family, family_names(), "`barycert families` lists them")};
    const Family& family = families->front();
    std::optional<Simplex> simplex = simplex_named(a.simplex);
    if (!a.simplex.empty() && !simplex)
        return Error{.what = "unknown simplex",
                     .expected = "segment, triangle, triangle3d or tetrahedron",
                     .found = '"' + a.simplex + '"',
                     .remedy = base::did_you_mean(a.simplex, simplex_names())};
    std::string kernel;
    if (!a.kernel.empty()) {
        const auto k = std::find_if(kernels.begin(), kernels.end(), [&](const Kernel& x) {
            return x.perspective == family.perspective && (!simplex || x.simplex == *simplex) &&
                   base::glob_match(a.kernel, x.name);
        });
        if (k == kernels.end())
            return Error{.what = "no kernel of that name for the cases of that family",
                         .found = '"' + a.kernel + '"',
                         .remedy = base::did_you_mean(a.kernel, kernel_names(), "`barycert kernels` lists them")};
        simplex = k->simplex;
        kernel = k->name;
    }
    if (!simplex && family.simplices.size() == 1) simplex = family.simplices.front();
    if (!simplex || !family.applies_to(*simplex)) {
        return Error{.what = "the simplex is not determined: the family applies to several, or not to the one given",
                     .remedy = "add --simplex NAME or --kernel NAME"};
    }
    MeshSource meshes;
    if (family.needs_mesh) {
        auto loaded = load_meshes(a.meshes, false, 0, false);
        if (!loaded) return loaded.error();
        meshes = std::move(*loaded);
        if (!meshes.supplies(*simplex))
            return Error{.what = "no mesh supplies a " + std::string(name(*simplex)), .remedy = "name one with --mesh"};
    }
    Witness w;
    w.kernel = kernel;
    w.reason = a.reason;
    w.family = family.name;
    w.seed = a.seed;
    w.index = *a.index;
    CaseOrigin origin;
    w.c = make_case(family, *simplex, a.seed, *a.index, meshes, &origin);
    w.mesh = origin.mesh;
    w.cell = origin.cell;
    return std::vector<Witness>{w};
}

int run_replay(const ReplayArguments& a) {
    const Environment environment = measure_environment();
    Result<std::vector<Kernel>> kernels = select_kernels({"*"}, a.libraries, *a.rules);
    if (!kernels) return fail(kernels.error());
    if (a.file.empty() == a.family.empty())
        return fail({.what = a.file.empty() ? "no case to replay" : "a witness file and a case",
                     .expected = "either a witness file, or --family and --case"});
    if (!a.family.empty() && !a.index) return fail({.what = "--family needs --case"});
    if (!a.file.empty() && !a.of_generated.empty())
        return fail({.what = a.of_generated + " is for a case that is generated",
                     .expected = "a witness file without it, or --family and --case"});
    if (std::error_code ignored; std::filesystem::is_directory(a.file, ignored))
        return fail({.what = "cannot read the witnesses", .file = a.file, .expected = "a file", .found = "a folder"});
    const auto witnesses = a.file.empty() ? made_again(a, *kernels) : read_witnesses(a.file);
    if (!witnesses) return fail(witnesses.error());
    bool any = false, all_reproduced = true;
    const TerminalStyle style{.colour = colour_on_stdout(),
                              .command = command_name(),
                              .witness_path = {},
                              .mesh_arguments = {},
                              .library_arguments = {}};
    for (const Witness& w : *witnesses) {
        if (!a.file.empty() && !a.kernel.empty() && !base::glob_match(a.kernel, w.kernel)) continue;
        if (!a.file.empty() && !a.reason.empty() && !base::glob_match(a.reason, w.reason)) continue;
        const Replay replay = replay_witness(w, *kernels);
        const std::string above = any ? "\n" : environment_line(environment) + "\n\n";
        const Status written = write_output("-", above + witness_text(replay, style, a.all));
        if (!written) return fail(written.error());
        any = true;
        if (!replay.not_reproduced.empty()) {
            tell(base::printable(
                     fmt::format("not reproduced: {} of {}: {}", w.reason, w.kernel, replay.not_reproduced)) +
                 "\n");
            all_reproduced = false;
        }
    }
    if (!any) return fail({.what = "no witness matches", .file = a.file, .remedy = where_none_matches(a, *witnesses)});
    return all_reproduced ? exit_clean : exit_findings;
}

}  // namespace

void add_replay(CLI::App& app, int& exit_code) {
    auto* sub = app.add_subcommand("replay", "Show witnesses: a kernel's weights beside the exact ones");
    sub->footer("Exit codes: 0 done; 1 a finding is not reproduced; 2 usage or input error.");
    const auto a = std::make_shared<ReplayArguments>();
    file_option(*sub, "FILE", a->file, "Witnesses from `barycert audit` or `search`: --witnesses FILE or --json FILE");
    sub->add_option("--kernel", a->kernel, "Show only witnesses of matching kernels; with --case, mark this kernel")
        ->type_name("KERNEL|GLOB");
    sub->add_option("--reason", a->reason,
                    "Show only witnesses of this kind of finding; with --case, the finding it must show")
        ->type_name("REASON|GLOB");
    sub->add_option("--family", a->family, "Generate a case instead of reading it: its family")->type_name("FAMILY");
    sub->add_option("--case", a->index, "Number of the case to generate")->check(whole_number())->type_name("N");
    sub->add_option("--seed", a->seed, "Seed of the case to generate")
        ->capture_default_str()
        ->check(whole_number())
        ->type_name("S");
    sub->add_option("--simplex", a->simplex, "Simplex of the case, if family and kernel do not determine it")
        ->type_name(joined(simplex_names()));
    file_option(*sub, "--mesh", a->meshes,
                "Meshes of the case, in the order given to the audit; default: barycert's own")
        ->type_name("MESH");
    file_option(*sub, "--kernel-library", a->libraries, "Also show the kernel of this library");
    sub->add_flag("--all", a->all, "Show the answers of all kernels, not only of the one in question");
    add_kernel_rules(*sub, a->rules);
    sub->callback([=, &exit_code] {
        for (const char* const name : {"--case", "--seed", "--simplex"}) {
            if (sub->get_option(name)->count() > 0) a->of_generated = name;
        }
        exit_code = run_replay(*a);
    });
}

}  // namespace barycert::cli
