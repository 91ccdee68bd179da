/// What the subcommands share: registration, exit codes, meshes, output.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "barycert/audit.hpp"
#include "barycert/io.hpp"
#include "barycert/kernels.hpp"
#include "barycert/result.hpp"

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace barycert::cli {

inline constexpr int exit_clean = 0;
inline constexpr int exit_findings = 1;
inline constexpr int exit_error = 2;

/// Each adds its subcommand to the app; when it has run, `exit_code` is set.
void add_audit(CLI::App& app, int& exit_code);
void add_check(CLI::App& app, int& exit_code);
void add_replay(CLI::App& app, int& exit_code);
void add_resample(CLI::App& app, int& exit_code);
void add_sample(CLI::App& app, int& exit_code);
void add_catalogue(CLI::App& app, int& exit_code);

/// Replaces this process by barycert-tetgen with the same arguments; returns exit_error if it cannot be found.
int exec_mesh(int argc, char** argv);

/// Text on stderr, which holds no control characters but those of this program (see printable()). That nobody can read
/// it (a closed or full stderr) is no reason to stop.
void tell(std::string_view text);

/// "error: ..." on stderr; returns exit_error.
int fail(const Error& error);

/// One mesh, TetGen's or VTK's; the error of one that is not there has a hint at what was meant.
Result<Mesh> load_mesh(const std::string& path, const ReadOptions& options);

/// The meshes of barycert's own data folder.
Result<std::vector<std::string>> own_meshes();

/// The meshes named by the user, or barycert's own if none is.
/// `certify`: check each (see check.hpp), so that its certificate is known.
Result<audit::MeshSource> load_meshes(const std::vector<std::string>& paths, bool certify);

/// Catalogue entries that match any of the globs ("*" if there are none), then the kernels of the libraries.
Result<std::vector<Kernel>> select_kernels(const std::vector<std::string>& globs,
                                           const std::vector<std::string>& libraries);
Result<std::vector<audit::Family>> select_families(const std::vector<std::string>& globs);

/// Refuses "-1" and 2^64 where a seed or the number of a case is due: the parser would take both for 2^64 - 1.
CLI::Validator whole_number();

/// True if text for people on that stream may be coloured: a terminal, and NO_COLOR is not set.
bool colour_on_stdout();

/// How the user calls this program, for commands to repeat: BARYCERT_COMMAND if a wrapper set it, else "barycert".
std::string command_name();

bool stderr_is_terminal();

}  // namespace barycert::cli
