// What an audit is made of: meshes, kernels and families, by the words of the user.

#include "audit_inputs.hpp"

#include <fmt/format.h>
#include <tbb/task_arena.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "barycert/base/folder.hpp"
#include "barycert/base/nearest_name.hpp"
#include "barycert/base/text.hpp"
#include "barycert/check.hpp"
#include "barycert/io.hpp"
#include "command.hpp"
#include "names.hpp"
#include "options.hpp"

namespace barycert::cli {
namespace {

namespace fs = std::filesystem;

/// BARYCERT_DATA_DIR, the data beside an installed program, or the source tree's; empty if there is none.
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

/// Items of `all(glob)` for each glob, without repetition, in the order of the catalogue.
template <class Item, class All>
Result<std::vector<Item>> select(const std::vector<std::string>& globs, All all, const char* what, const char* remedy) {
    const std::vector<Item> everything = all("*");
    if (globs.empty()) return everything;
    for (const std::string& glob : globs) {
        if (all(glob).empty())
            return Error{.what = fmt::format("no {} of that name", what),
                         .found = '"' + glob + '"',
                         .remedy = base::did_you_mean(glob, names_of(everything), remedy)};
    }
    std::vector<Item> chosen;
    for (const Item& item : everything) {
        if (std::any_of(globs.begin(), globs.end(),
                        [&](const std::string& glob) { return base::glob_match(glob, item.name); }))
            chosen.push_back(item);
    }
    return chosen;
}

}  // namespace

Result<std::vector<std::string>> own_meshes() {
    const std::string folder = (data_folder() / "meshes").string();
    std::vector<std::string> paths;
    std::error_code trouble;
    for (const std::string& name : base::names_in_folder(folder, trouble)) {
        if (name.ends_with(".node")) paths.push_back(fmt::format("{}/{}", folder, name));
    }
    // Some of them alone would be another audit.
    if (paths.empty() || trouble) {
        return Error{.what = "barycert's own meshes are missing",
                     .file = folder,
                     .found = trouble ? trouble.message() : "no .node file",
                     .remedy = "name a mesh, or set BARYCERT_DATA_DIR to the folder `data` of barycert's sources"};
    }
    return paths;
}

Result<MeshSource> load_meshes(const std::vector<std::string>& paths, bool certify, int threads, bool quiet,
                               Curved curved) {
    std::vector<std::string> from = paths;
    if (from.empty()) {
        auto own = own_meshes();
        if (!own) return own.error();
        from = *own;
    }
    MeshSource source;
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    for (const std::string& path : from) {
        Result<Mesh> mesh = read_mesh(path, {.faces = false, .neighbours = false, .threads = threads});
        if (!mesh) return mesh.error();
        if (const Status ok = check_curved(*mesh, path, curved); !ok) return ok.error();
        if (!quiet) tell_important(mesh->notes);
        if (mesh->cell_count() == 0) return Error{.what = "the mesh has no cells", .file = path};
        CheckOptions verdict;
        verdict.verdict_only = true;
        verdict.threads = threads;
        const Certificate certificate = certify ? check_mesh(*mesh, verdict).certificate : Certificate();
        arena.execute(
            [&] { source.add(paths.empty() ? fs::path(path).stem().string() : path, std::move(*mesh), certificate); });
    }
    return source;
}

Result<std::vector<Kernel>> select_kernels(const std::vector<std::string>& globs,
                                           const std::vector<std::string>& libraries, const KernelRules& rules) {
    // With a library named and no glob, only the library's kernels are meant.
    Result<std::vector<Kernel>> chosen = std::vector<Kernel>{};
    if (!globs.empty() || libraries.empty()) {
        chosen =
            select<Kernel>(globs, kernels_matching, "kernel", "`barycert kernels` lists them; * and ? are wildcards");
        if (!chosen) return chosen;
    }
    for (const std::string& path : libraries) {
        Result<Kernel> kernel =
            rules.in_process ? load_kernel_library(path) : load_contained_kernel(path, rules.seconds);
        if (!kernel) return kernel.error();
        if (!kernel->note.empty()) tell("note: " + base::printable(path + ": " + kernel->note) + "\n");
        if (std::any_of(chosen->begin(), chosen->end(), [&](const Kernel& k) { return k.name == kernel->name; })) {
            return Error{.what = "two kernel libraries have the same name",
                         .file = path,
                         .found = kernel->name,
                         .remedy = "set another info->name in one of them"};
        }
        chosen->push_back(std::move(*kernel));
    }
    for (Kernel& kernel : *chosen) {
        if (!rules.class_tolerance || kernel.rule != RegionRule::sign || kernel.certifies) continue;
        kernel.rule = RegionRule::tolerant;
        kernel.tolerance = *rules.class_tolerance;
    }
    return chosen;
}

Result<std::vector<Family>> select_families(const std::vector<std::string>& globs) {
    return select<Family>(globs, families_matching, "family", "`barycert families` lists them; * and ? are wildcards");
}

void add_kernel_rules(CLI::App& sub, const std::shared_ptr<KernelRules>& rules) {
    sub.add_option("--class-tolerance", rules->class_tolerance,
                   "A point is inside if all weights are >= -X, of kernels that neither classify points themselves nor "
                   "certify; without it, if no weight is below 0")
        ->check(finite_at_least(0))
        ->type_name("X");
    add_containment(sub, rules);
}

void add_containment(CLI::App& sub, const std::shared_ptr<KernelRules>& rules) {
    sub.add_option("--time-limit", rules->seconds, "Seconds that a kernel of yours may take for one case")
        ->capture_default_str()
        ->check(finite_at_least(0.001))
        ->check(CLI::Range(0.001, 1e6).description(""))
        ->type_name("S");
    sub.add_flag("--in-process", rules->in_process,
                 "Run kernels of yours in this process: a crash of theirs is then one of the audit's");
}

std::string words_of(const KernelRules& rules) {
    std::string words;
    if (rules.in_process) words += " --in-process";
    if (rules.seconds != KernelRules{}.seconds) words += " --time-limit " + base::shortest(rules.seconds);
    if (rules.class_tolerance) words += " --class-tolerance " + base::shortest(*rules.class_tolerance);
    return words;
}

CLI::Validator whole_number() {
    return {[](std::string& text) {
                std::uint64_t ignored = 0;
                const char* const last = text.data() + text.size();
                const auto [end, error] = std::from_chars(text.data(), last, ignored);
                return error == std::errc{} && end == last
                           ? std::string()
                           : fmt::format("expected a whole number from 0 to 2^64 - 1, found \"{}\"", text);
            },
            ""};
}

}  // namespace barycert::cli
