/// Rules of --fail-on: NAME, or NAME>NUMBER.
#pragma once

#include <optional>
#include <string_view>

#include "barycert/base/text.hpp"

namespace barycert::base {

struct NamedLimit {
    std::string_view name;
    std::optional<double> most;  ///< 0 if none is written; nothing if what is written is no number >= 0
};

inline NamedLimit named_limit(std::string_view text) {
    const std::size_t sign = text.find('>');
    if (sign == std::string_view::npos) return {text, 0};
    std::optional<double> most = parse_double(text.substr(sign + 1));
    if (most && !(*most >= 0)) most.reset();
    return {text.substr(0, sign), most};
}

}  // namespace barycert::base
