#include "options/mistyped.hpp"

#include <CLI/CLI.hpp>

#include <optional>

#include "barycert/base/nearest_name.hpp"
#include "barycert/base/shell_word.hpp"
#include "barycert/base/text.hpp"

namespace barycert::cli {

namespace {

struct Mistyped {
    std::string word, meant;
};

/// The first word that was left over and is near an option.
std::optional<Mistyped> mistyped_option(const CLI::App& app) {
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
        if (std::string meant = base::nearest_name(word, names); !meant.empty()) return Mistyped{word, meant};
    }
    return std::nullopt;
}

}  // namespace

std::string usage_error(const CLI::App& app, const std::exception& error, const std::string& rest) {
    std::string message = error.what();
    // The parser tells them in reverse.
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
        message = "not expected:";
        for (const std::string& word : app.remaining(true)) message += ' ' + base::shell_word(base::printable(word));
    }
    std::string text = message + (message.ends_with('?') ? " " : "; ");
    if (const auto option = mistyped_option(app)) {
        // Another error may have been found before.
        if (message.find(option->word) == std::string::npos) text += '"' + option->word + "\" is no option, ";
        text += "did you mean \"" + option->meant + "\"? ";
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
