#include "options/command_table.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cctype>

namespace barycert::cli {
namespace {

void add_words(OptionEntry& entry, std::string_view type, const Vocabulary& vocabulary) {
    for (;;) {
        const std::size_t bar = type.find('|');
        std::string_view part = type.substr(0, bar);
        const std::size_t bracket = part.find('[');
        std::string_view word = part.substr(0, bracket);
        if (word.empty()) word = part.substr(1, part.find(']') - 1);  // [RATIO]
        const int first = static_cast<unsigned char>(word.front());
        if (std::islower(first) != 0 || std::isdigit(first) != 0) {
            const std::size_t sign = word.find('=');
            entry.words.emplace_back(word.substr(0, sign == std::string_view::npos ? sign : sign + 1));
        } else if (const auto known = vocabulary.find(std::string(word)); known != vocabulary.end()) {
            entry.words.insert(entry.words.end(), known->second.begin(), known->second.end());
        }
        entry.files = entry.files || word == "NAME=FILE" || is_type_of_files(word);
        if (bar == std::string_view::npos) return;
        type.remove_prefix(bar + 1);
    }
}

OptionEntry entry_of(const CLI::Option& option, const Vocabulary& vocabulary) {
    OptionEntry entry;
    entry.operand = option.get_positional();
    if (entry.operand) entry.names.push_back(option.get_name(true));
    for (const std::string& name : option.get_snames()) entry.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) entry.names.push_back("--" + name);
    entry.text = option.get_description();
    entry.required = option.get_required();
    entry.repeats = option.get_items_expected_max() >= CLI::detail::expected_max_vector_size;
    entry.may_be_bare = option.get_items_expected_min() == 0;
    if (option.get_items_expected_max() == 0) return entry;  // a flag
    entry.type = option.get_type_name();
    entry.preset = option.get_default_str();
    // The types that the parser makes up for operands say less than their names.
    if (entry.operand && entry.type == "TEXT") entry.type = entry.name();
    if (!entry.type.empty()) add_words(entry, entry.type, vocabulary);
    return entry;
}

CommandEntry entry_of(const CLI::App& app, const std::string& above, const Vocabulary& vocabulary) {
    CommandEntry entry;
    entry.name = app.get_name();
    entry.path = above.empty() ? entry.name : above + ' ' + entry.name;
    entry.text = app.get_description();
    entry.notes = app.get_footer();
    for (const CLI::Option* option : app.get_options()) {
        if (!option->get_group().empty()) entry.options.push_back(entry_of(*option, vocabulary));
    }
    for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; }))
        entry.commands.push_back(entry_of(*sub, entry.path, vocabulary));
    return entry;
}

}  // namespace

bool is_type_of_files(std::string_view type) {
    constexpr std::array<std::string_view, 5> types{"FILE", "MESH", "MESH2", "PLC", "DIR"};
    return std::find(types.begin(), types.end(), type) != types.end();
}

CommandEntry command_table(const CLI::App& app, const Vocabulary& vocabulary) {
    return entry_of(app, "", vocabulary);
}

}  // namespace barycert::cli
