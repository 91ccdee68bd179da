#include "options/choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "barycert/base/nearest_name.hpp"
#include "barycert/base/text.hpp"

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

namespace {

CLI::Validator finite_number(double least, bool itself) {
    return {[=](std::string& text) {
                const auto x = base::parse_double(text);
                if (x && std::isfinite(*x) && (*x > least || (itself && *x == least))) return std::string();
                return fmt::format("expected a finite number {} {}, found \"{}\"", itself ? "of at least" : "above",
                                   base::shortest(least), text);
            },
            ""};
}

}  // namespace

CLI::Validator finite_at_least(double least) {
    return finite_number(least, true);
}

CLI::Validator finite_above(double least) {
    return finite_number(least, false);
}

std::string joined(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, "|"));
}

}  // namespace barycert::cli
