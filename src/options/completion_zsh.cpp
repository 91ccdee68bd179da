// Completion for zsh: a function for each command, of specifications for _arguments.

#include <fmt/format.h>

#include "options/completion.hpp"

namespace barycert::cli {
namespace {

/// `text` where _arguments and _describe give these characters a meaning.
std::string zsh_text(std::string_view text, std::string_view special) {
    std::string out;
    for (const char c : text) {
        if (special.find(c) != std::string_view::npos) out += '\\';
        out += c;
    }
    return out;
}

/// ":TYPE:ACTION"
std::string zsh_value(const OptionEntry& option) {
    std::string action;
    if (option.files) action = "_files";
    if (!option.words.empty())
        action = '(' + zsh_text(fmt::format("{}", fmt::join(option.words, " ")), ":\\^*?[]~#$") + ')';
    return ':' + zsh_text(option.type, ":\\") + ':' + action;
}

std::string specification(const OptionEntry& option) {
    const std::string text = '[' + zsh_text(summary(option.text), "[]\\:") + ']';
    if (option.operand) return (option.repeats ? "*" : "") + zsh_value(option);
    std::string all;
    for (const std::string& name : option.names) {
        std::string one = option.repeats ? "*" : "";
        one += name;
        if (!option.type.empty() && name.starts_with("--")) one += '=';
        one += text;
        if (!option.type.empty()) one += (option.may_be_bare ? ":" : "") + zsh_value(option);
        all += ' ' + in_quotes(one);
    }
    return all;
}

std::string function_of(const CommandEntry& command) {
    std::string text = function_name(command.path) + "() {\n";
    std::string specifications;
    for (const OptionEntry& option : command.options)
        specifications +=
            " \\\n   " + (option.operand ? ' ' + in_quotes(specification(option)) : specification(option));
    if (command.commands.empty()) return text + "  _arguments -s -S" + specifications + "\n}\n";
    std::string names, cases;
    for (const CommandEntry& below : command.commands) {
        names += "\n    " + in_quotes(zsh_text(below.name, ":\\") + ':' + zsh_text(summary(below.text), "\\"));
        cases += fmt::format("    {}) {} ;;\n", below.name, function_name(below.path));
    }
    // Operands of a command that has commands below it: where the first word is none of them.
    std::string operands;
    for (const OptionEntry& option : command.options) {
        if (option.operand && option.files) operands = "_files";
    }
    std::string options;
    for (const OptionEntry& option : command.options) {
        if (!option.operand) options += " \\\n   " + specification(option);
    }
    text += "  local curcontext=$curcontext state line\n  local -a commands\n  typeset -A opt_args\n";
    text += "  commands=(" + names + "\n  )\n";
    text += "  _arguments -C -S" + options + " \\\n    ': :->command' \\\n    '*:: :->rest'\n";
    text +=
        "  case $state in\n  command) _describe command commands" + (operands.empty() ? "" : "; " + operands) + " ;;\n";
    text += "  rest)\n    case $words[1] in\n" + cases;
    return text + "    esac ;;\n  esac\n}\n";
}

}  // namespace

std::string zsh_completion(const CommandEntry& program) {
    std::string script =
        fmt::format("#compdef {0}\n# Completion for zsh; generated from the options of {0}.\n", program.name);
    for_commands(program, [&](const CommandEntry& command) { script += function_of(command); });
    // The file is a function of this name when zsh loads it by itself, and a script when it is sourced.
    return script + fmt::format("if [ \"$funcstack[1]\" = {2} ]; then\n  {0} \"$@\"\nelse\n  compdef {0} {1}\nfi\n",
                                function_name(program.path), program.name, '_' + program.name);
}

}  // namespace barycert::cli
