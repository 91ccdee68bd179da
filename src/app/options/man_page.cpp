#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/options/command_table.hpp"
#include "core/base/text.hpp"

namespace barycert::cli {
namespace {

/// As text of roff: nothing in it is a request or an escape.
std::string roff(std::string_view text) {
    std::string out(text);
    for (const auto& [plain, escape] :
         {std::pair("\\", "\\e"), {"-", "\\-"}, {"'", "\\(aq"}, {"`", "\\(ga"}, {"^", "\\(ha"}, {"~", "\\(ti"}})
        base::replace_all(out, plain, escape);
    base::replace_all(out, "\n.", "\n\\&.");
    return out.starts_with('.') ? "\\&" + out : out;
}

std::string bold(std::string_view text) {
    return "\\fB" + roff(text) + "\\fR";
}
std::string italic(std::string_view text) {
    return "\\fI" + roff(text) + "\\fR";
}

std::string page_name(const CommandEntry& command) {
    std::string name = command.path;
    std::replace(name.begin(), name.end(), ' ', '-');
    return name;
}

/// "sample the fields ...", as man and apropos show it.
std::string headline(const CommandEntry& command) {
    std::string text = command.text;
    if (text.size() > 1 && std::islower(static_cast<unsigned char>(text[1])) != 0)
        text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
    return text;
}

/// The text in the place of a value: words as they are, names of things in italics.
std::string man_value(const OptionEntry& option) {
    const auto capital = [](char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; };
    const bool words = !option.words.empty() && std::ranges::none_of(option.type, capital);
    return words ? bold(option.type) : italic(option.type);
}

std::string synopsis(const CommandEntry& command) {
    std::string text = ".SH SYNOPSIS\n" + bold(command.path);
    for (const OptionEntry& o : command.options) {
        if (!o.operand && o.required) text += fmt::format(" {} {}", bold(o.name()), man_value(o));
    }
    text += " [" + italic("OPTIONS") + "]";
    for (const OptionEntry& o : command.options) {
        if (!o.operand) continue;
        const std::string name = italic(o.name()) + (o.repeats ? "..." : "");
        text += ' ' + (o.required ? name : '[' + name + ']');
    }
    text += '\n';
    if (!command.commands.empty()) text += ".br\n" + bold(command.path) + ' ' + italic("SUBCOMMAND") + " ...\n";
    return text;
}

std::string option_text(const OptionEntry& option) {
    std::string text = ".TP\n";
    text += option.operand ? italic(option.name()) : base::joined(option.names, ", ", bold);
    if (!option.operand && !option.type.empty()) text += ' ' + man_value(option);
    text += '\n' + roff(option.text);
    std::string more;
    if (option.required && !option.operand) more += " Required.";
    if (!option.preset.empty()) more += " Default: " + option.preset + '.';
    if (!more.empty()) text += (option.text.ends_with('.') ? "" : ".") + roff(more);
    return text + '\n';
}

std::string entries(const CommandEntry& command, bool operands, const char* title) {
    const std::string text = base::joined(command.options, "", [&](const OptionEntry& option) {
        return option.operand == operands ? option_text(option) : "";
    });
    return text.empty() ? text : std::string(".SH ") + title + '\n' + text;
}

/// The notes are broken into lines by hand: prose is filled again, but not lines that have columns.
std::string notes_text(std::string_view text) {
    std::string out;
    bool columns = false;
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(text.size(), line.size() + 1));
        if (columns != (line.find("   ") != std::string_view::npos)) {
            columns = !columns;
            out += columns ? ".PP\n.nf\n" : ".fi\n.PP\n";
        }
        out += roff(line) + '\n';
    }
    return columns ? out + ".fi\n" : out;
}

/// The sentence on exit codes has a section of its own.
std::pair<std::string, std::string> split_notes(const std::string& notes) {
    const std::size_t begin = notes.find("Exit codes:");
    if (begin == std::string::npos) return {notes, ""};
    const std::size_t end = std::min(notes.find('.', begin), notes.size() - 1) + 1;
    std::string codes = notes.substr(begin + 12, end - begin - 12);
    std::replace(codes.begin(), codes.end(), '\n', ' ');
    std::string rest =
        notes.substr(0, begin) + notes.substr(std::min(notes.find_first_not_of("\n ", end), notes.size()));
    rest.erase(rest.find_last_not_of("\n ") + 1);
    return {rest, codes};
}

std::string link_to(const CommandEntry& command) {
    return bold(page_name(command)) + "(1)";
}

std::string see_also(const CommandEntry& command, const CommandEntry& program) {
    std::vector<std::string> links;
    if (&command != &program) links.push_back(link_to(program));
    for (const CommandEntry& other : command.commands) links.push_back(link_to(other));
    return links.empty() ? "" : fmt::format(".SH SEE ALSO\n{}\n", fmt::join(links, ",\n"));
}

std::string page(const CommandEntry& command, const CommandEntry& program, std::string_view version,
                 const std::vector<Variable>& environment, std::string_view date) {
    std::string title = page_name(command);
    for (char& c : title) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    const auto [notes, codes] = split_notes(command.notes);
    std::string text =
        fmt::format(".TH {} 1 \"{}\" \"{}\" \"User Commands\"\n.nh\n.ad l\n", roff(title), date, roff(version));
    text += ".SH NAME\n" + roff(page_name(command)) + " \\- " + roff(headline(command)) + '\n';
    text += synopsis(command);
    text += ".SH DESCRIPTION\n" + roff(command.text) + ".\n";
    if (!notes.empty()) text += ".PP\n" + notes_text(notes);
    text += entries(command, true, "OPERANDS") + entries(command, false, "OPTIONS");
    if (!command.commands.empty()) text += ".SH SUBCOMMANDS\n";
    for (const CommandEntry& below : command.commands)
        text += ".TP\n" + bold(below.name) + '\n' + roff(below.text) + ". See " + link_to(below) + ".\n";
    if (!codes.empty()) text += ".SH EXIT STATUS\n" + roff(codes) + '\n';
    if (&command == &program && !environment.empty()) {
        text += ".SH ENVIRONMENT\n";
        for (const Variable& v : environment) text += ".TP\n" + bold(v.name) + '\n' + roff(v.text) + '\n';
    }
    return text + see_also(command, program);
}

}  // namespace

std::vector<ManPage> man_pages(const CommandEntry& program, std::string_view version,
                               const std::vector<Variable>& environment, std::string_view date) {
    std::vector<ManPage> pages;
    for_commands(program, [&](const CommandEntry& command) {
        pages.push_back({page_name(command) + ".1", page(command, program, version, environment, date)});
    });
    return pages;
}

}  // namespace barycert::cli
