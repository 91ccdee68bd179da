// barycert mesh: hands over to barycert-tetgen, as git does with its subcommands, so that TetGen's licence stays there.

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <vector>

#include "command.hpp"

namespace barycert::cli {

int exec_mesh(int argc, char** argv) {
    namespace fs = std::filesystem;
    std::vector<char*> arguments(argv + 1, argv + argc);
    static char name[] = "barycert-tetgen";
    arguments.front() = name;
    arguments.push_back(nullptr);
    std::error_code ignored;
    const fs::path beside = fs::read_symlink("/proc/self/exe", ignored).parent_path() / name;
    if (!ignored && fs::exists(beside, ignored)) execv(beside.c_str(), arguments.data());
    execvp(name, arguments.data());
    return fail(
        {.what = "cannot run barycert-tetgen",
         .found = std::strerror(errno),
         .remedy =
             "install the package barycert-tetgen; among the sources use `./run barycert mesh ...`, which builds it"});
}

}  // namespace barycert::cli
