// Completion for fish: a line for each option, with the command it belongs to as its condition.

#include <fmt/format.h>

#include "options/completion.hpp"

namespace barycert::cli {
namespace {

/// In single quotes of fish, which know \' and \\.
std::string fish_word(std::string_view text) {
    std::string out = "'";
    for (const char c : text) {
        if (c == '\'' || c == '\\') out += '\\';
        out += c;
    }
    return out + '\'';
}

/// The words as fish takes them: one a line would need a command.
std::string fish_words(const OptionEntry& option) {
    return fish_word(fmt::format("{}", fmt::join(option.words, " ")));
}

std::string line_of(const OptionEntry& option, const std::string& start) {
    std::string text = start;
    if (!option.operand) {
        for (const std::string& name : option.names)
            text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
        if (!option.type.empty() && !option.may_be_bare) text += " -r";
    }
    if (option.files) text += " -F";
    if (!option.files && !option.type.empty()) text += " -f";
    if (!option.words.empty()) text += " -a " + fish_words(option);
    return text + " -d " + fish_word(summary(option.text)) + '\n';
}

}  // namespace

std::string fish_completion(const CommandEntry& program) {
    const std::string function = "_" + function_name(program.path) + "_command";
    std::string paths, lines;
    for_commands(program, [&](const CommandEntry& command) {
        if (command.path != program.path) paths += ' ' + fish_word(command.path);
        const std::string start = fmt::format("complete -c {} -n {}", program.name,
                                              fish_word(fmt::format("{} {}", function, fish_word(command.path))));
        for (const CommandEntry& below : command.commands)
            lines += fmt::format("{} -f -a {} -d {}\n", start, fish_word(below.name), fish_word(summary(below.text)));
        for (const OptionEntry& option : command.options) lines += line_of(option, start);
    });
    std::string script = fmt::format("# Completion for fish; generated from the options of {}.\n", program.name);
    script += fmt::format("function {} --description 'Whether this command is being typed'\n", function);
    script += fmt::format("    set -l command {}\n", fish_word(program.path));
    script += "    for word in (commandline -opc)[2..-1]\n";
    script += fmt::format("        contains -- \"$command $word\"{}; or break\n", paths);
    script += "        set command \"$command $word\"\n    end\n";
    script += "    test \"$command\" = $argv[1]\nend\n";
    script += fmt::format("complete -c {} -f\n", program.name);
    return script + lines;
}

}  // namespace barycert::cli
