#include "program_table.hpp"

#include <cctype>

#include <gtest/gtest.h>

namespace barycert::cli_test {
namespace {

void list(const Words& words, std::vector<ListedCommand>& all) {
    Words call = words;
    call.emplace_back("--help");
    const Ended help = run(call);
    ASSERT_EQ(help.code, 0) << help.err;
    ListedCommand command{words, {}};
    Words below;
    bool commands = false;
    for (const std::string& line : lines_of(help.out)) {
        if (line.empty() || line.front() != ' ') commands = line == "Subcommands:";
        if (line.size() < 3 || line.compare(0, 2, "  ") != 0 || line[2] == ' ') continue;
        if (commands) {
            below.push_back(line.substr(2, line.find(' ', 2) - 2));
        } else if (const std::size_t at = line.find("--"); at != std::string::npos && line[2] == '-') {
            std::size_t end = at;
            while (end < line.size() && (line[end] == '-' || std::isalnum(static_cast<unsigned char>(line[end])) != 0))
                ++end;
            command.options.push_back(line.substr(at, end - at));
        }
    }
    all.push_back(command);
    for (const std::string& name : below) {
        Words deeper = words;
        deeper.push_back(name);
        if (deeper == Words{"mesh"}) continue;  // its --help is that of another program
        list(deeper, all);
    }
}

}  // namespace

std::vector<ListedCommand> listed_commands() {
    std::vector<ListedCommand> all;
    list({}, all);
    return all;
}

bool is_there(const std::string& program) {
    return run_shell("command -v " + program).code == 0;
}

}  // namespace barycert::cli_test
