/// What the subcommands share: registration, exit codes, meshes, output.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "barycert/audit/families.hpp"
#include "barycert/audit/mesh_source.hpp"
#include "barycert/core/result.hpp"
#include "barycert/kernels/kernel.hpp"
#include "barycert/mesh/tetgen_io.hpp"

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

/// Text on stderr. That nobody can read it (a closed or full stderr) is no reason to stop.
void tell(std::string_view text);

/// "error: ..." on stderr; returns exit_error.
int fail(const Error& error);

/// True if the name ends as those of VTK's files do: .vtu .vtk .vtp.
bool is_vtk_file(const std::string& path);

/// One mesh, TetGen's or VTK's; the error of one that is not there has a hint at what was meant.
Result<Mesh> load_mesh(const std::string& path, const ReadOptions& options);

/// The meshes named by the user, or those of barycert's own data folder if none is.
/// `certify`: check each (see check/check.hpp), so that its certificate is known.
Result<audit::MeshSource> load_meshes(const std::vector<std::string>& paths, bool certify);

/// Catalogue entries that match any of the globs ("*" if there are none), then the kernels of the libraries.
Result<std::vector<Kernel>> select_kernels(const std::vector<std::string>& globs,
                                           const std::vector<std::string>& libraries);
Result<std::vector<audit::Family>> select_families(const std::vector<std::string>& globs);

/// Writes `bytes` to a file that appears whole or not at all; "-" is stdout.
Status write_output(const std::string& path, std::string_view bytes);

/// An Error if write_output(path, ...) is bound to fail: told before the work, not after.
Status check_output(const std::string& path);

/// True if both name one file, or are the same word.
bool same_output(const std::string& a, const std::string& b);

/// Refuses "-1" and 2^64 where a seed or the number of a case is due: the parser would take both for 2^64 - 1.
CLI::Validator whole_number();

/// True if text for people on that stream may be coloured: a terminal, and NO_COLOR is not set.
bool colour_on_stdout();

/// How the user calls this program, for commands to repeat: BARYCERT_COMMAND if a wrapper set it, else "barycert".
std::string command_name();

bool stderr_is_terminal();

}  // namespace barycert::cli
