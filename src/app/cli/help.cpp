// barycert help: what --help says, and the same options as manual pages and completions for shells.

#include <fmt/chrono.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <functional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/cli/command.hpp"
#include "app/cli/options.hpp"
#include "app/options/command_table.hpp"
#include "app/options/parser.hpp"
#include "barycert/result.hpp"
#include "barycert/verify.hpp"
#include "barycert/verify_job.hpp"
#include "core/base/nearest_name.hpp"
#include "files/format.hpp"

namespace barycert::cli {
namespace {

using CompletionOf = std::string (*)(const CommandEntry&);

struct HelpArguments {
    const CLI::App* program = nullptr;
    std::vector<std::string> words;
    CompletionOf completion = nullptr;
    std::string folder;
};

Vocabulary vocabulary(const CLI::App& app) {
    Vocabulary words{{"SUBCOMMAND", command_names(app)}};
    for (const RowVerdict kind : kinds_of_wrong) words["KIND"].emplace_back(handle(kind));
    add_words(words);
    return words;
}

/// The commands again below `path`, each with these options alone: `barycert help` takes their names.
std::vector<CommandEntry> names_below(const std::string& path, const std::vector<CommandEntry>& commands,
                                      const std::vector<OptionEntry>& options) {
    std::vector<CommandEntry> names;
    for (const CommandEntry& command : commands) {
        const std::string here = path + ' ' + command.name;
        names.push_back({here, command.name, command.text, {}, options, names_below(here, command.commands, options)});
    }
    return names;
}

/// For completions: after `help` come the names of commands, and of those below them.
CommandEntry with_names_below_help(CommandEntry program) {
    CommandEntry& help = *std::ranges::find(program.commands, "help", &CommandEntry::name);
    std::erase_if(help.options, std::mem_fn(&OptionEntry::operand));
    help.commands = names_below(help.path, program.commands, help.options);
    return program;
}

/// The command that `barycert mesh` runs, as a program of its own.
CommandEntry mesher(const CommandEntry& program) {
    CommandEntry alone = *std::ranges::find(program.commands, "mesh", &CommandEntry::name);
    alone.path = alone.name = "barycert-tetgen";
    alone.text = "Mesh a PLC (" + base::suffix_list_read(base::Use::plc) + ") with TetGen";
    return alone;
}

std::vector<Variable> variables() {
    return {{"BARYCERT_DATA_DIR", "The folder of barycert's own data, whose meshes are audited where none is named."},
            {"BARYCERT_COMMAND", "How the program names itself in commands to repeat, for scripts that run it."},
            {"BARYCERT_MESHIO",
             "The Python whose meshio reads formats that barycert does not read; default: python3. Empty: none."},
            {"NO_COLOR", "If set and not empty, nothing is coloured."},
            {"TMPDIR", "The folder of temporary files; /tmp without it."}};
}

/// The day that packages are made on, by SOURCE_DATE_EPOCH; else none, for pages depend on the program alone.
std::string date() {
    const char* const text = std::getenv("SOURCE_DATE_EPOCH");
    std::time_t seconds = 0;
    if (text == nullptr || std::from_chars(text, text + std::strlen(text), seconds).ec != std::errc{}) return "";
    std::tm day{};
    return gmtime_r(&seconds, &day) == nullptr ? "" : fmt::format("{:%Y-%m-%d}", day);
}

int write_pages(const CommandEntry& program, const std::string& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        return fail(
            {.code = "file.unwritable", .what = "cannot make the folder", .file = folder, .found = error.message()});
    std::vector<ManPage> pages = man_pages(program, "barycert " BARYCERT_VERSION, variables(), date());
    for (ManPage& page : man_pages(mesher(program), "barycert " BARYCERT_VERSION, {}, date()))
        pages.push_back(std::move(page));
    for (const ManPage& page : pages)
        write_output((std::filesystem::path(folder) / page.file).string(), page.text).value();
    return exit_clean;
}

int explain(const CLI::App& app, const std::vector<std::string>& words) {
    const CLI::App* command = &app;
    std::string above;
    for (const std::string& word : words) {
        const auto named = [&](const CLI::App* sub) { return sub->get_name() == word; };
        const auto found = command->get_subcommands(named);
        if (found.empty())
            return fail(file_error("option.usage", {}, "no such subcommand", {}, '"' + word + '"',
                                   base::did_you_mean(word, command_names(*command), "`barycert help` lists them")));
        above += (above.empty() ? "" : " ") + command->get_name();
        command = found.front();
    }
    // Makes the program's help by its formatter: help() of the program would show that of the subcommand that was
    // given, this one.
    const std::string text = command == &app
                                 ? app.get_formatter()->make_help(&app, app.get_name(), CLI::AppFormatMode::Normal)
                                 : command->help(above);
    write_output("-", text).value();
    return exit_clean;
}

int run_help(HelpArguments& a) {
    const CLI::App& app = *a.program;
    const bool pages = !a.folder.empty(), script = a.completion != nullptr;
    if (!pages && !script) return explain(app, a.words);
    const bool of_mesher = script && a.words == std::vector<std::string>{"mesh"};
    if ((!a.words.empty() && !of_mesher) || (pages && script))
        return fail(file_error("option.conflict", {}, "manual pages and completions are of all subcommands",
                               "--man DIR, --completion SHELL or subcommands", "several of these",
                               "give one of them alone"));
    const CommandEntry program = command_table(app, vocabulary(app));
    if (!script) return write_pages(program, a.folder);
    write_output("-", a.completion(a.words.empty() ? with_names_below_help(program) : mesher(program))).value();
    return exit_clean;
}

}  // namespace

void add_help(const Options& program) {
    const auto& [o, a] = program.command(
        "help", "Explain a subcommand; print completions for shells, write manual pages",
        "`source <(barycert help --completion bash)` completes commands in this shell; `barycert help mesh\n"
        "--completion bash` those of barycert-tetgen. Packages install both.\nExit codes: 0 done; 2 usage or input "
        "error.",
        run_help);
    a.program = &program.app();
    o.app().add_option("SUBCOMMAND", a.words, "The subcommand, such as sample or render iso; default: all, in a list");
    o.choice<CompletionOf>("--completion", a.completion,
                           {{"bash", bash_completion}, {"zsh", zsh_completion}, {"fish", fish_completion}},
                           "Print a script that completes subcommands, options and their values in this shell");
    o.text("--man", a.folder, "Write the manual pages of barycert, its subcommands and barycert-tetgen", "DIR");
}

}  // namespace barycert::cli
