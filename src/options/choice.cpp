#include "options/choice.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "barycert/base/nearest_name.hpp"

namespace barycert::cli {
namespace {

/// "a, b or c".
std::string listed(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
    return text;
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

}  // namespace barycert::cli
