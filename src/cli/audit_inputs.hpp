/// What an audit is made of: meshes, kernels and families, by the words of the user.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "barycert/audit.hpp"
#include "barycert/kernels.hpp"
#include "barycert/result.hpp"

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace barycert::cli {

/// The meshes of barycert's own data folder.
Result<std::vector<std::string>> own_meshes();

/// The meshes named by the user, or barycert's own if none is.
/// `certify`: check each (see check.hpp), so that its certificate is known. `threads`: 0 is all.
Result<MeshSource> load_meshes(const std::vector<std::string>& paths, bool certify, int threads, bool quiet,
                               Curved curved = Curved::straight);

/// How the kernels of the user's libraries are run, and how it is told what they claim.
struct KernelRules {
    bool in_process = false;
    double seconds = 1;                     ///< for a case, in a process of its own
    std::optional<double> class_tolerance;  ///< of kernels that have no rule of their own
};

/// The options --time-limit and --in-process; and these with --class-tolerance.
void add_containment(CLI::App& sub, const std::shared_ptr<KernelRules>& rules);
void add_kernel_rules(CLI::App& sub, const std::shared_ptr<KernelRules>& rules);

/// As words to repeat: " --in-process --class-tolerance 1e-10"; empty if all are as without options.
std::string words_of(const KernelRules& rules);

/// Catalogue entries that match any of the globs ("*" if there are none), then the kernels of the libraries.
Result<std::vector<Kernel>> select_kernels(const std::vector<std::string>& globs,
                                           const std::vector<std::string>& libraries, const KernelRules& rules);
Result<std::vector<Family>> select_families(const std::vector<std::string>& globs);

/// Refuses "-1" and 2^64 where a seed or the number of a case is due: the parser would take both for 2^64 - 1.
CLI::Validator whole_number();

}  // namespace barycert::cli
