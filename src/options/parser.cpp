#include "options/parser.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "barycert/base/nearest_name.hpp"
#include "barycert/base/text.hpp"

namespace barycert::cli {
namespace {

/// "a, b or c".
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

std::string joined(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, "|"));
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

}  // namespace barycert::cli
