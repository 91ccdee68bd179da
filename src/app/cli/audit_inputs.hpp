/// Inputs of an audit, named by the words of the user: meshes, kernels and families.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/cli/command.hpp"
#include "app/cli/options.hpp"
#include "app/cli/reports.hpp"
#include "barycert/audit.hpp"
#include "barycert/audit_job.hpp"
#include "barycert/certificate.hpp"
#include "barycert/choices.hpp"
#include "barycert/kernels.hpp"
#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/report.hpp"
#include "barycert/result.hpp"
#include "barycert/threshold.hpp"
#include "core/base/text.hpp"
#include "files/named_file.hpp"

namespace barycert::cli {

// What barycert has (audit_whole.cpp), and barycert-audit only a part of (audit_alone.cpp), so that it is built in less
// time.

/// The reader of meshes, and the files that a path names: of all formats, or of those of TetGen and Triangle alone.
Result<Mesh> read_audited(const std::string& path, const ReadOptions& options);
std::vector<std::string> audited_files(const std::string& path);

/// Checks a mesh, or knows it for one of barycert's own meshes, which a test checks.
Certificate certify_audited(const Mesh& mesh, int threads);

/// Audits rules that answer cases of their own, on surfaces and inverse maps, or refuses to. Returns the exit code.
struct RuleRun {
    Reports& reports;
    const AuditOptions& options;
    std::function<void(const AuditProgress&)> progress;
};
int run_surface_rules(const RuleRun& run);
int run_inverse_rules(const RuleRun& run);

/// BARYCERT_DATA_DIR, the data beside an installed program, or the source tree's; empty if there is none.
std::filesystem::path data_folder();

/// The meshes named by the user, or those of barycert's own data folder, by the stems of their files.
Result<std::vector<NamedMesh>> meshes_or_own(const std::vector<std::string>& paths);

/// How users' kernels are run: --time-limit and --in-process; and these with --class-tolerance.
void add_containment(const Options& o, KernelChoice& kernels);
void add_kernel_rules(const Options& o, KernelChoice& kernels);

/// For commands to repeat: how the program is called, the kernels as the user gave them, where witnesses are written.
TerminalStyle style_to_repeat(const Reports& reports, const KernelChoice& kernels, bool colour);

inline void add_count(const Options& o, std::uint64_t& count, int most_bits, const std::string& help) {
    o.integer("--count", count, std::uint64_t{1}, std::uint64_t{1} << most_bits, help);
}
inline void add_seed(const Options& o, std::uint64_t& seed, const std::string& help) {
    o.whole("--seed", seed, help)->default_str(std::to_string(seed));
}

/// choose_kernels(), with what the libraries are to be told of on stderr.
Result<std::vector<Kernel>> chosen_kernels(const KernelChoice& choice);
inline void tell_note(const std::string& path, const Kernel& kernel) {
    if (!kernel.note.empty()) tell("note: " + base::printable(path + ": " + kernel.note) + "\n");
}

inline std::vector<base::NamedFile> library_files(const KernelChoice& kernels) {
    return base::named_files("--kernel-library", kernels.libraries);
}

std::string failures_of(const std::vector<Violation>& violations);

}  // namespace barycert::cli
