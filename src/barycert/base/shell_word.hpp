/// Words of a command line that is shown to be copied.
#pragma once

#include <string>
#include <string_view>

namespace barycert::base {

/// `text` as one word for a POSIX shell, quoted where needed; printable, whatever it holds.
std::string shell_word(std::string_view text);

}  // namespace barycert::base
