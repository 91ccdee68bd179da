// What all subcommands share: the mesh, what is said on stderr, what the terminal is like.

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "barycert/base/text.hpp"
#include "barycert/report/common/terminal_text.hpp"
#include "command.hpp"

namespace barycert::cli {
void tell(std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

int fail(const Error& error) {
    std::fflush(stdout);
    tell(fmt::format("error: {}\n", with_command_name(error.message())));
    return exit_error;
}

void tell_important(const Notes& notes) {
    for (const Note& note : notes) {
        if (note.important) tell(fmt::format("note: {}\n", message(note)));
    }
}

void tell_curved(const CurvedCells& curved) {
    if (curved.cells != 0) tell(fmt::format("note: {}\n", message(curved)));
}

Status check_curved(const Mesh& mesh, const std::string& path, Curved curved) {
    if (curved == Curved::straight) return Done{};
    const auto straight = take_as_straight(mesh, path, curved);
    return straight ? Status(Done{}) : Status(straight.error());
}

std::string command_name() {
    const char* wrapper = std::getenv("BARYCERT_COMMAND");
    return wrapper == nullptr || *wrapper == '\0' ? "barycert" : base::printable(wrapper);
}

std::string with_command_name(std::string text) {
    const std::string own = "`barycert ", named = '`' + command_name() + ' ';
    for (std::size_t at = text.find(own); at != std::string::npos; at = text.find(own, at + named.size()))
        text.replace(at, own.size(), named);
    return text;
}

namespace {
std::string& remembered_arguments() {
    static std::string arguments;
    return arguments;
}
}  // namespace

void remember_command_line(int argc, const char* const* argv) {
    for (int i = 1; i < argc; ++i) remembered_arguments() += " " + report::shell_word(argv[i]);
}

std::string command_line() {
    return command_name() + remembered_arguments();
}

bool colour_on_stdout() {
    const char* no_colour = std::getenv("NO_COLOR");
    return isatty(STDOUT_FILENO) == 1 && (no_colour == nullptr || *no_colour == '\0');
}

bool stderr_is_terminal() {
    return isatty(STDERR_FILENO) == 1;
}

}  // namespace barycert::cli
