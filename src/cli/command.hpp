/// What the subcommands share: registration, exit codes, stderr.
#pragma once

#include <string>
#include <string_view>

#include "barycert/check.hpp"
#include "barycert/result.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace barycert::cli {

inline constexpr int exit_clean = 0;
inline constexpr int exit_findings = 1;
inline constexpr int exit_error = 2;

/// What the help ends with where there are no other exit codes.
inline constexpr const char* done_or_error = "Exit codes: 0 done; 2 usage or input error.";

/// Each adds its subcommand to the app; when it has run, `exit_code` is set.
void add_audit(CLI::App& app, int& exit_code);
void add_gaps(CLI::App& app, int& exit_code);
void add_check(CLI::App& app, int& exit_code);
void add_render(CLI::App& app, int& exit_code);
void add_replay(CLI::App& app, int& exit_code);
void add_resample(CLI::App& app, int& exit_code);
void add_search(CLI::App& app, int& exit_code);
void add_sample(CLI::App& app, int& exit_code);
void add_verify(CLI::App& app, int& exit_code);
void add_catalogue(CLI::App& app, int& exit_code);
/// After all others: it explains them.
void add_help(CLI::App& app, int& exit_code);

/// Likewise below `barycert render`.
void add_render_drift(CLI::App& render, int& exit_code);
void add_render_texels(CLI::App& render, int& exit_code);

/// Replaces this process by barycert-tetgen with the same arguments; returns exit_error if it cannot be found.
int exec_mesh(int argc, char** argv);

/// Text on stderr, which holds no control characters but those of this program (see printable()). That nobody can read
/// it (a closed or full stderr) is no reason to stop.
void tell(std::string_view text);

/// "error: ..." on stderr; returns exit_error.
int fail(const Error& error);

/// From now on a failed allocation in CGAL's or GMP's code, which would abort, ends the process as
/// fail_for_want_of_memory() does, or is thrown.
void prepare_for_want_of_memory();

/// "note: ..." on stderr for each that may change what results mean.
void tell_important(const Notes& notes);

/// That cells are curved, where no table says so.
void tell_curved(const CurvedCells& curved);

/// Error, with Curved::refuse: cells are curved. For what measures them itself otherwise.
Status check_curved(const Mesh& mesh, const std::string& path, Curved curved);

/// True if text for people on that stream may be coloured: a terminal, and NO_COLOR is not set.
bool colour_on_stdout();

/// How the user calls this program, for commands to repeat: BARYCERT_COMMAND if a wrapper set it, else "barycert".
std::string command_name();

/// The text with that name for the program in each of its commands, which stand between ` and `.
std::string with_command_name(std::string text);

/// The whole command as a shell takes it: command_name() and the arguments. main() tells it to remember.
std::string command_line();
void remember_command_line(int argc, const char* const* argv);

bool stderr_is_terminal();

}  // namespace barycert::cli
