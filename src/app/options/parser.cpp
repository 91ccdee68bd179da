#include "app/options/parser.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <exception>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/options/command_table.hpp"
#include "core/base/nearest_name.hpp"
#include "core/base/text.hpp"

namespace barycert::cli {
namespace {

std::string listed(const std::vector<std::string>& words) {
    if (words.size() < 2) return joined(words);
    return fmt::format("{} or {}", fmt::join(words.begin(), words.end() - 1, ", "), words.back());
}

/// The first word that was left over and is near an option, and that option.
std::optional<std::pair<std::string, std::string>> mistyped_option(const CLI::App& app) {
    for (const CLI::App* sub : app.get_subcommands()) {
        if (auto found = mistyped_option(*sub)) return found;
    }
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    for (const std::string& text : app.remaining()) {
        if (!text.starts_with("--")) continue;
        const std::string word = text.substr(0, text.find('='));
        if (std::string meant = base::nearest_name(word, names); !meant.empty()) return std::pair(word, meant);
    }
    return std::nullopt;
}

/// The option of the command that was given, or one below it, that has more values than it takes.
const CLI::Option* given_twice(const CLI::App& app) {
    for (const CLI::App* sub : app.get_subcommands()) {
        if (const CLI::Option* const found = given_twice(*sub)) return found;
    }
    for (const CLI::Option* option : app.get_options()) {
        if (static_cast<int>(option->count()) > std::max(1, option->get_items_expected_max())) return option;
    }
    return nullptr;
}

/// Whether the command that was given, or one below it, has such an option, which takes a value.
bool takes_value(const CLI::App& app, const std::string& option) {
    const CLI::Option* const found = app.get_option_no_throw(option);
    if (found != nullptr && found->get_items_expected_max() > 0) return true;
    const auto subs = app.get_subcommands();
    return std::any_of(subs.begin(), subs.end(), [&](const CLI::App* sub) { return takes_value(*sub, option); });
}

/// "; --points takes one value", where the word stands behind the value of that option.
std::string one_value(const CLI::App& app, std::span<const char* const> words, const std::string& extra) {
    for (std::size_t i = 2; i < words.size(); ++i) {
        const std::string option = words[i - 2], value = words[i - 1];
        if (words[i] == extra && option.starts_with("--") && !value.starts_with("--") && takes_value(app, option))
            return "; " + option + " takes one value";
    }
    return "";
}

void add_words(OptionEntry& entry, const Vocabulary& vocabulary) {
    std::istringstream parts(entry.type);
    for (std::string text; std::getline(parts, text, '|');) {
        const std::string_view part = text;
        std::string_view word = part.substr(0, part.find('['));
        if (word.empty()) word = part.substr(1, part.find(']') - 1);  // [RATIO]
        const int first = static_cast<unsigned char>(word.front());
        if (std::islower(first) != 0 || std::isdigit(first) != 0) {
            const std::size_t sign = word.find('=');
            entry.words.emplace_back(word.substr(0, sign == std::string_view::npos ? sign : sign + 1));
        } else if (const auto known = vocabulary.find(std::string(word)); known != vocabulary.end()) {
            entry.words.insert(entry.words.end(), known->second.begin(), known->second.end());
        }
        entry.files = entry.files || word == "NAME=FILE" || is_type_of_files(word);
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
    add_words(entry, vocabulary);
    return entry;
}

}  // namespace

CLI::Validator one_of(const std::vector<std::string>& words) {
    return {[words](std::string& text) {
                if (std::find(words.begin(), words.end(), text) != words.end()) return std::string();
                const std::string meant = base::did_you_mean(text, words);
                return fmt::format("expected {}, found \"{}\"{}{}", listed(words), text, meant.empty() ? "" : "; ",
                                   meant);
            },
            ""};
}

std::string usage_error(const CLI::App& app, const std::exception& error, const std::string& rest,
                        std::span<const char* const> words) {
    std::string message = error.what();
    // The parser tells them in reverse.
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
        message = "not expected:";
        const std::vector<std::string> extras = app.remaining(true);
        for (const std::string& word : extras) message += ' ' + base::shell_word(base::printable(word));
        if (extras.size() == 1) message += one_value(app, words, extras.front());
    }
    const CLI::Option* const twice =
        dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr ? given_twice(app) : nullptr;
    if (twice != nullptr)
        message = twice->get_name() + " is given " + std::to_string(twice->count()) + " times: give it once";
    const auto option = mistyped_option(app);
    // Who knows what is expected of a value needs no list of options.
    if (!option && dynamic_cast<const CLI::ValidationError*>(&error) != nullptr &&
        message.find(": expected ") != std::string::npos)
        return message;
    std::string text = message + (message.ends_with('?') ? " " : "; ");
    if (option) {
        // Another error may have been found before.
        if (message.find(option->first) == std::string::npos) text += '"' + option->first + "\" is no option, ";
        text += "did you mean \"" + option->second + "\"? ";
    }
    return text + rest;
}

std::vector<std::string> command_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(sub->get_name());
    return names;
}

bool is_type_of_files(std::string_view type) {
    constexpr std::array<std::string_view, 5> types{"FILE", "MESH", "MESH2", "PLC", "DIR"};
    return std::find(types.begin(), types.end(), type) != types.end();
}

CommandEntry command_table(const CLI::App& app, const Vocabulary& vocabulary, const std::string& above) {
    CommandEntry entry;
    entry.name = app.get_name();
    entry.path = above.empty() ? entry.name : above + ' ' + entry.name;
    entry.text = app.get_description();
    entry.notes = app.get_footer();
    for (const CLI::Option* option : app.get_options()) {
        if (!option->get_group().empty()) entry.options.push_back(entry_of(*option, vocabulary));
    }
    for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; }))
        entry.commands.push_back(command_table(*sub, vocabulary, entry.path));
    return entry;
}

}  // namespace barycert::cli
