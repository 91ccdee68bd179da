#include "app/cli/audit_inputs.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

#include "app/cli/command.hpp"
#include "app/cli/options.hpp"
#include "app/cli/reports.hpp"
#include "app/options/command_table.hpp"
#include "barycert/audit_job.hpp"
#include "barycert/audit_report.hpp"
#include "barycert/choices.hpp"
#include "barycert/family.hpp"
#include "barycert/gaps.hpp"
#include "barycert/kernels.hpp"
#include "barycert/report.hpp"
#include "barycert/result.hpp"
#include "barycert/statistics.hpp"
#include "barycert/threshold.hpp"
#include "core/base/nearest_name.hpp"
#include "core/base/text.hpp"

namespace barycert::cli {
namespace {

namespace fs = std::filesystem;

template <class Chosen, class Items, Result<Items> (*choose)(const Chosen&), std::string (*json)(const Items&),
          std::string (*text)(const Items&)>
int list(Arguments<Chosen>& a) {
    return a.reports.end(choose(a.job), [&](const Items& all) {
        return Told{.files = {{"--json", [&] { return json(all); }}}, .text = [&](bool) { return text(all); }};
    });
}

}  // namespace

fs::path data_folder() {
    if (const char* named = std::getenv("BARYCERT_DATA_DIR"); named != nullptr && *named != '\0') return named;
    std::error_code ignored;
    const fs::path self = fs::read_symlink("/proc/self/exe", ignored);
    if (!ignored) {
        fs::path installed = self.parent_path().parent_path() / "share" / "barycert" / "data";
        if (fs::is_directory(installed, ignored)) return installed;
    }
    if (fs::is_directory(BARYCERT_SOURCE_DATA_DIR, ignored)) return BARYCERT_SOURCE_DATA_DIR;
    return {};
}

Result<std::vector<NamedMesh>> meshes_or_own(const std::vector<std::string>& paths) {
    std::vector<NamedMesh> meshes;
    std::ranges::transform(paths, std::back_inserter(meshes), [](const auto& path) { return NamedMesh{path, path}; });
    if (!meshes.empty()) return meshes;
    const std::string folder = (data_folder() / "meshes").string();
    std::error_code trouble;
    for (const std::string& name : base::names_in_folder(folder, trouble)) {
        if (name.ends_with(".node"))
            meshes.push_back({fs::path(name).stem().string(), (fs::path(folder) / name).string()});
    }
    // Some of them alone would be another audit.
    if (meshes.empty() || trouble)
        return file_error("witness.mesh", folder, "barycert's own meshes are missing", {},
                          trouble ? trouble.message() : "no .node file",
                          "name a mesh, or set BARYCERT_DATA_DIR to the folder `data` of barycert's sources");
    return meshes;
}

void add_audit_words(Vocabulary& words) {
    words["KERNEL"] = names_of(kernels_matching("*"));
    words["FAMILY"] = names_of(all_families());
    for (std::size_t reason = 0; reason < witness_reasons; ++reason) words["REASON"].emplace_back(reason_name(reason));
    words["RULE"] = threshold_names();
    for (std::size_t fault = 0; fault < claim_fault_count; ++fault)
        words["FAULT"].emplace_back(name(static_cast<ClaimFault>(fault)));
}

void add_kernel_rules(const Options& o, KernelChoice& kernels) {
    o.number("--class-tolerance", kernels.class_tolerance, 0,
             "For kernels that neither classify points nor certify: a point is inside if all weights are >= -X; "
             "default: if no weight is below 0",
             "X");
    add_containment(o, kernels);
}

void add_containment(const Options& o, KernelChoice& kernels) {
    o.number("--time-limit", kernels.seconds, 0.001, "Seconds that a kernel of yours may take for one case", "S")
        ->default_str(base::shortest(kernels.seconds))
        ->check(CLI::Range(0.001, 1e6).description(""));
    o.flag("--in-process", kernels.in_process,
           "Run kernels of yours in this process: a crash of theirs is then one of the audit's");
}

TerminalStyle style_to_repeat(const Reports& reports, const KernelChoice& kernels, bool colour) {
    const std::string& apart = reports.path("--witnesses");
    const std::string& witnesses = apart.empty() ? reports.path("--json") : apart;
    TerminalStyle style{.colour = colour, .command = command_name(), .library_arguments = kernels.libraries};
    if (witnesses != "-") style.witness_path = witnesses;
    std::string& words = style.kernel_arguments;
    if (kernels.in_process) words += " --in-process";
    if (kernels.seconds != KernelChoice{}.seconds) words += " --time-limit " + base::shortest(kernels.seconds);
    if (kernels.class_tolerance) words += " --class-tolerance " + base::shortest(*kernels.class_tolerance);
    return style;
}

Result<std::vector<Kernel>> chosen_kernels(const KernelChoice& choice) {
    auto kernels = choose_kernels(choice);
    const std::size_t count = choice.libraries.size();
    for (std::size_t i = 0; kernels && i < count; ++i)
        tell_note(choice.libraries[i], (*kernels)[kernels->size() - count + i]);
    return kernels;
}

std::string failures_of(const std::vector<Violation>& violations) {
    return base::joined(violations, "", [](const Violation& v) {
        return failure(v.kernel + ": " + v.figure, base::shortest(v.value), base::shortest(v.limit));
    });
}

// barycert kernels, barycert families: list and explain.
void add_catalogue(const Options& program) {
    using Names = std::vector<std::string>;
    constexpr const char* json_list = "Write the list as JSON; - is stdout";
    const auto& [kernels, k] =
        program.command("kernels", "List the kernels: formula, source, known failures", done_or_error,
                        list<KernelChoice, std::vector<Kernel>, chosen_kernels, kernels_json, kernels_text>);
    kernels.app().add_option("KERNEL|GLOB", k.job.names, "List only matching names");
    kernels.text("--kernel-library", k.job.libraries, "Also list the kernel of this shared library");
    k.reports.file(kernels, "--json", json_list);
    const auto& [families, f] =
        program.command("families", "List the families of cases: what each tests, and its recipe", done_or_error,
                        list<Names, std::vector<Family>, choose_families, families_json, families_text>);
    families.app().add_option("FAMILY|GLOB", f.job, "List only matching names");
    f.reports.file(families, "--json", json_list);
}

}  // namespace barycert::cli
