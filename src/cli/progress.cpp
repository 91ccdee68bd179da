#include "progress.hpp"

#include <fmt/format.h>

#include "barycert/base/text.hpp"
#include "command.hpp"

namespace barycert::cli {

void Progress::stage(std::string_view text) {
    if (!on_) return;
    tell(fmt::format("\r\033[K{}", base::printable(text)));
    shown_ = true;
    last_ = std::chrono::steady_clock::now();
}

void Progress::count(std::string_view what, std::uint64_t done) {
    if (due()) stage(fmt::format("{}: {}", what, done));
}

bool Progress::due() const {
    return on_ && std::chrono::steady_clock::now() - last_ > std::chrono::milliseconds(100);
}

void Progress::clear() {
    if (shown_) tell("\r\033[K");
    shown_ = false;
}

}  // namespace barycert::cli
