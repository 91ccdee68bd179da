/// All commands and options of a program, as --help shows them; manual pages and completions that are made of them.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace barycert::cli {

struct OptionEntry {
    std::vector<std::string> names;  ///< "-h", "--help"; of an operand its name alone: "MESH"
    std::string type;                ///< what it takes, as the help shows it: "FILE", "correct|plain"; empty: nothing
    std::string preset;              ///< what holds without it; empty: see the text
    std::string text;
    bool operand = false;  ///< by its place, without a name
    bool required = false;
    bool repeats = false;      ///< may be given several times, or an operand several words
    bool may_be_bare = false;  ///< the value may be left out

    // Completions of the value.
    std::vector<std::string> words;  ///< these
    bool files = false;              ///< names of files

    const std::string& name() const { return names.back(); }
};

struct CommandEntry {
    std::string path;  ///< "barycert render iso"
    std::string name;  ///< "iso"
    std::string text;
    std::string notes;  ///< what the help ends with
    std::vector<OptionEntry> options;
    std::vector<CommandEntry> commands;
};

/// The words that types of values stand for: "KERNEL" -> all kernels.
using Vocabulary = std::map<std::string, std::vector<std::string>>;

bool is_type_of_files(std::string_view type);

/// Types of values, by which their words are found: parts between |. Parts in small letters are words themselves (up to
/// a [; with their = where one follows). Names of files are completed as such; other parts are looked up in the
/// vocabulary.
CommandEntry command_table(const CLI::App& app, const Vocabulary& vocabulary, const std::string& above = {});

/// Calls visit(command) for the command, and for all below it, depth first.
template <class Visit>
void for_commands(const CommandEntry& command, const Visit& visit) {
    visit(command);
    for (const CommandEntry& below : command.commands) for_commands(below, visit);
}

// Manual pages.

struct ManPage {
    std::string file;  ///< "barycert-render-iso.1"
    std::string text;  ///< roff, with the macros of man(7)
};

struct Variable {
    std::string name, text;
};

/// A page for the program, which has the environment, and one for each command below it. `date`: YYYY-MM-DD, or empty.
std::vector<ManPage> man_pages(const CommandEntry& program, std::string_view version,
                               const std::vector<Variable>& environment, std::string_view date);

// Completions for shells: commands, options, and their values where these are a few words or files.

std::string bash_completion(const CommandEntry& program);
std::string zsh_completion(const CommandEntry& program);
std::string fish_completion(const CommandEntry& program);

}  // namespace barycert::cli
