/// Steps of all subcommands around their job: exit codes, messages on stderr, the name by which the program is called.
#pragma once

#include <string>
#include <string_view>

#include "app/options/command_table.hpp"
#include "barycert/result.hpp"

namespace barycert::cli {

inline constexpr int exit_clean = 0;
inline constexpr int exit_findings = 1;
inline constexpr int exit_error = 2;

class Options;

/// Declares the subcommands of an executable, by those below: barycert has all, barycert-audit the audit's,
/// barycert-check one.
void add_subcommands(const Options& program);

/// What they need done before any thread starts.
void prepare_subcommands();

/// Words that stand for what their options take, such as KERNEL: for completions.
void add_words(Vocabulary& words);
void add_audit_words(Vocabulary& words);

/// Each declares its subcommand below the program.
void add_audit(const Options& program);
void add_gaps(const Options& program);
void add_check(const Options& program);
void add_render(const Options& program);
void add_replay(const Options& program);
void add_resample(const Options& program);
void add_search(const Options& program);
void add_sample(const Options& program);
void add_verify(const Options& program);
void add_catalogue(const Options& program);
/// After all others: it explains them.
void add_help(const Options& program);

/// Likewise below `barycert render`.
void add_render_contours(const Options& render);
void add_render_tables(const Options& render);

/// From now on a failed allocation in CGAL or GMP ends the process as fail_for_want_of_memory() does, or is thrown.
void prepare_for_want_of_memory();

/// Text on stderr, its control characters this program's own (see printable()). A closed or full stderr is no error.
void tell(std::string_view text);

/// "error: ..." on stderr, with the options that set the members of jobs that it names; returns exit_error. An
/// Exception that a subcommand throws, as value() does, ends there, too.
int fail(Error error);

/// Where fail() writes the error as JSON (doc/json.md): the file of --json, "-" for stdout, empty for none. Until the
/// report stands there.
void expect_json(const std::string& path);

/// "note: ..." on stderr for each that may change what results mean.
void tell_important(const Notes& notes);

/// Writes `bytes` to a file that appears whole or not at all; "-" is stdout.
Status write_output(const std::string& path, std::string_view bytes);

/// How the user calls this program, for commands to repeat: BARYCERT_COMMAND if a wrapper set it, else "barycert".
std::string command_name();

/// Returns the text with command_name() in place of `barycert` at the start of each command between backquotes.
std::string with_command_name(std::string text);

/// The text of an error or a note that has a subject, with the option that sets it in place of each member of a job:
/// "--points" for "job.points". A text without a subject names none, and may hold such words by chance.
std::string with_options(std::string text);
/// The notes, those that have a subject with options in their texts.
Notes with_options(Notes notes);

/// The whole command as a shell takes it: command_name() and the arguments. main() tells it to remember.
std::string command_line();
void remember_command_line(int argc, const char* const* argv);

}  // namespace barycert::cli
