// Completions for shells: for bash a function over tables of words, which needs no package bash-completion; for zsh one
// for each command, of specifications for _arguments; for fish a line for each option, with its command as condition.

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "app/options/command_table.hpp"
#include "core/base/text.hpp"

namespace barycert::cli {
namespace {

std::string in_quotes(std::string text) {
    base::replace_all(text, "'", "'\\''");
    return "'" + text + "'";
}

/// A name of a function made of the path of a command: "_barycert_render_iso".
std::string function_name(std::string_view path) {
    std::string name = "_";
    for (const char c : path) name += c == ' ' || c == '-' ? '_' : c;
    return name;
}

/// The beginning of a help text, as a list of completions shows it: up to the first ";", "(", ". " or ": ", in a line.
std::string summary(std::string_view text) {
    std::size_t end = text.size();
    for (const std::string_view stop : {"; ", " (", ". ", ": "}) end = std::min(end, text.find(stop));
    std::string out(text.substr(0, end));
    std::replace(out.begin(), out.end(), '\n', ' ');
    return out;
}

std::string words_of(const OptionEntry& option) {
    return fmt::format("{}", fmt::join(option.words, " "));
}

/// The completions of a value or an operand, as assignments in the script.
std::string source_of(const OptionEntry& option) {
    const std::string words = option.words.empty() ? "" : "words=" + in_quotes(words_of(option));
    if (option.files) return words + (words.empty() ? "" : " ") + "files=1";
    return words.empty() ? ":" : words;
}

/// `text` with a backslash before the characters to which a shell gives a meaning.
std::string escaped(std::string_view text, std::string_view special) {
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
    if (!option.words.empty()) action = '(' + escaped(words_of(option), ":\\^*?[]~#$") + ')';
    return ':' + escaped(option.type, ":\\") + ':' + action;
}

std::string specification(const OptionEntry& option) {
    if (option.operand) return ' ' + in_quotes((option.repeats ? "*" : "") + zsh_value(option));
    std::string rest = '[' + escaped(summary(option.text), "[]\\:") + ']';
    if (!option.type.empty()) rest += (option.may_be_bare ? ":" : "") + zsh_value(option);
    std::string all;
    for (const std::string& name : option.names) {
        std::string one = option.repeats ? '*' + name : name;
        if (!option.type.empty() && name.starts_with("--")) one += '=';
        one += rest;
        all += ' ' + in_quotes(one);
    }
    return all;
}

std::string function_of(const CommandEntry& command) {
    const bool last = command.commands.empty();
    std::string text = function_name(command.path) + "() {\n", options, operands, names, cases;
    for (const OptionEntry& option : command.options) {
        if (last || !option.operand) options += " \\\n   " + specification(option);
        // Operands of a command that has commands below it: where the first word is none of them.
        if (option.operand && option.files) operands = "; _files";
    }
    if (last) return text + "  _arguments -s -S" + options + "\n}\n";
    for (const CommandEntry& below : command.commands) {
        names += "\n    " + in_quotes(escaped(below.name, ":\\") + ':' + escaped(summary(below.text), "\\"));
        cases += fmt::format("    {}) {} ;;\n", below.name, function_name(below.path));
    }
    text += "  local curcontext=$curcontext state line\n  local -a commands\n  typeset -A opt_args\n";
    text += "  commands=(" + names + "\n  )\n";
    text += "  _arguments -C -S" + options + " \\\n    ': :->command' \\\n    '*:: :->rest'\n";
    text += "  case $state in\n  command) _describe command commands" + operands + " ;;\n";
    text += "  rest)\n    case $words[1] in\n" + cases;
    return text + "    esac ;;\n  esac\n}\n";
}

/// In single quotes of fish, which know \' and \\.
std::string fish_word(std::string_view text) {
    return '\'' + escaped(text, "'\\") + '\'';
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
    if (!option.words.empty()) text += " -a " + fish_word(words_of(option));
    return text + " -d " + fish_word(summary(option.text)) + '\n';
}

}  // namespace

std::string bash_completion(const CommandEntry& program) {
    std::vector<std::string> paths;
    std::map<std::string, std::vector<std::string>> values;  // assignments -> "path option"
    std::string operands, options;
    for_commands(program, [&](const CommandEntry& command) {
        if (command.path != program.path) paths.push_back(command.path);
        OptionEntry operand;
        std::string names;
        for (const CommandEntry& below : command.commands) operand.words.push_back(below.name);
        for (const OptionEntry& o : command.options) {
            if (o.operand) {
                operand.words.insert(operand.words.end(), o.words.begin(), o.words.end());
                operand.files = operand.files || o.files;
                continue;
            }
            for (const std::string& name : o.names) names += (names.empty() ? "" : " ") + name;
            if (!o.type.empty()) values[source_of(o)].push_back(command.path + ' ' + o.name());
        }
        operands += fmt::format("        {}) {} ;;\n", in_quotes(command.path), source_of(operand));
        options += fmt::format("        {}) words={} ;;\n", in_quotes(command.path), in_quotes(names));
    });
    std::string cases;
    for (const auto& [source, patterns] : values)
        cases += fmt::format("        {})\n            {} ;;\n", base::joined(patterns, " | ", in_quotes), source);
    // Options of commands below: the words before the last name the command.
    std::string descend;
    if (!paths.empty())
        descend = fmt::format(R"(    for ((i = 1; i < COMP_CWORD; ++i)); do
        word="$command ${{COMP_WORDS[i]}}"
        case $word in
        {}) command=$word ;;
        *) break ;;
        esac
    done
)",
                              base::joined(paths, " | ", in_quotes));
    // bash makes words of their own of the parts of --option=value.
    return fmt::format(R"(# Completion for bash; generated from the options of {name}.
{function}() {{
    local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}}
    local command={path} words= files= word i
{descend}    if [[ $current == = ]]; then
        current=
    elif [[ $previous == = && $COMP_CWORD -ge 2 ]]; then
        previous=${{COMP_WORDS[COMP_CWORD - 2]}}
    fi
    case "$command $previous" in
{cases}        *)
            if [[ $current == -* ]]; then
        case $command in
{options}        esac
            else
        case $command in
{operands}        esac
            fi ;;
    esac
    COMPREPLY=()
    [[ -z $words ]] || mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
    if [[ -n $files ]]; then
        local -a found
        mapfile -t found < <(compgen -f -- "$current")
        COMPREPLY+=("${{found[@]}}")
        compopt -o filenames 2>/dev/null
    fi
    [[ ${{COMPREPLY[0]}} != *= ]] || compopt -o nospace 2>/dev/null
}}
complete -F {function} {name}
)",
                       fmt::arg("name", program.name), fmt::arg("function", function_name(program.path)),
                       fmt::arg("path", in_quotes(program.path)), fmt::arg("descend", descend),
                       fmt::arg("cases", cases), fmt::arg("options", options), fmt::arg("operands", operands));
}

std::string zsh_completion(const CommandEntry& program) {
    std::string script =
        fmt::format("#compdef {0}\n# Completion for zsh; generated from the options of {0}.\n", program.name);
    for_commands(program, [&](const CommandEntry& command) { script += function_of(command); });
    // The file is a function of this name when zsh loads it by itself, and a script when it is sourced.
    return script + fmt::format("if [ \"$funcstack[1]\" = {2} ]; then\n  {0} \"$@\"\nelse\n  compdef {0} {1}\nfi\n",
                                function_name(program.path), program.name, '_' + program.name);
}

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
