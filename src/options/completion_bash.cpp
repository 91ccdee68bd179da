// Completion for bash: one function over tables of words. It needs bash alone, not the package bash-completion.

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "options/completion.hpp"

namespace barycert::cli {
namespace {

std::string alternatives(const std::vector<std::string>& patterns) {
    std::string text;
    for (const std::string& pattern : patterns) text += (text.empty() ? "" : " | ") + in_quotes(pattern);
    return text;
}

/// What completes a value or an operand, as assignments in the script.
std::string source_of(const OptionEntry& option) {
    std::string text;
    if (!option.words.empty())
        text = fmt::format("words={}", in_quotes(fmt::format("{}", fmt::join(option.words, " "))));
    if (option.files) text += (text.empty() ? "" : " ") + std::string("files=1");
    return text.empty() ? ":" : text;
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
        cases += fmt::format("        {})\n            {} ;;\n", alternatives(patterns), source);
    const std::string function = function_name(program.path);
    std::string script = fmt::format("# Completion for bash; generated from the options of {}.\n", program.name);
    script += function + "() {\n";
    script += "    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}\n";
    script += fmt::format("    local command={} words= files= word i\n", in_quotes(program.path));
    if (!paths.empty()) {
        script += "    for ((i = 1; i < COMP_CWORD; ++i)); do\n";
        script += "        word=\"$command ${COMP_WORDS[i]}\"\n";
        script += fmt::format(
            "        case $word in\n        {}) command=$word ;;\n        *) break ;;\n        esac\n    done\n",
            alternatives(paths));
    }
    // bash makes words of their own of the parts of --option=value.
    script += "    if [[ $current == = ]]; then\n        current=\n";
    script +=
        "    elif [[ $previous == = && $COMP_CWORD -ge 2 ]]; then\n        previous=${COMP_WORDS[COMP_CWORD - 2]}\n    "
        "fi\n";
    script += "    case \"$command $previous\" in\n" + cases;
    script += "        *)\n            if [[ $current == -* ]]; then\n        case $command in\n" + options +
              "        esac\n            else\n        case $command in\n" + operands +
              "        esac\n            fi ;;\n";
    script += "    esac\n";
    script += "    COMPREPLY=()\n";
    script += "    [[ -z $words ]] || mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n";
    script += "    if [[ -n $files ]]; then\n        local -a found\n";
    script += "        mapfile -t found < <(compgen -f -- \"$current\")\n";
    script += "        COMPREPLY+=(\"${found[@]}\")\n";
    script += "        compopt -o filenames 2>/dev/null\n    fi\n";
    script += "    [[ ${COMPREPLY[0]} != *= ]] || compopt -o nospace 2>/dev/null\n";
    return script + "}\n" + fmt::format("complete -F {} {}\n", function, program.name);
}

}  // namespace barycert::cli
