// The executable barycert: one subcommand a file.

#include <signal.h>
#include <tbb/cache_aligned_allocator.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "app/cli/command.hpp"
#include "app/cli/options.hpp"
#include "app/options/parser.hpp"
#include "app/options/want_of_memory.hpp"
#include "app/tetgen/options.hpp"
#include "barycert/environment.hpp"
#include "barycert/result.hpp"
#include "core/base/nearest_name.hpp"
#include "core/base/text.hpp"
#include "files/format.hpp"
#include "files/input_file.hpp"
#include "files/output_file.hpp"

namespace barycert::cli {
namespace {

/// Asks for the memory of oneTBB's tables, and gives it back to its allocator, which keeps it. Version 2022 makes them
/// under a lock; to report that memory is wanted it takes that lock again, and so would wait for itself.
void fetch_memory_for_threads() {
    constexpr std::size_t more_than_the_tables = 64 << 10;
    tbb::cache_aligned_allocator<char> memory;
    memory.deallocate(memory.allocate(more_than_the_tables), more_than_the_tables);
}

/// Hands over to barycert-tetgen, as git does with its subcommands, so that TetGen's licence stays there; or fails.
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
    return fail(file_error(
        "tool.missing", {}, "cannot run barycert-tetgen", {}, std::strerror(errno),
        "install the package barycert-tetgen; among the sources use `./run barycert mesh ...`, which builds it"));
}

int run(int argc, char** argv) {
    // For all threads, before any of them starts: a library that was loaded first may have changed it.
    const ExactEnvironment environment;
    const std::string_view first = argc > 1 ? argv[1] : "";
    if (first == "mesh") return exec_mesh(argc, argv);
    base::remove_begun_files_on_signals(true);
    const base::RunFiles files;
    prepare_subcommands();
    fetch_memory_for_threads();
    // Stops where the build itself is wrong: no call can set what was compiled in.
    if (const Status exact = check_environment(measure_environment()); !exact) return fail(exact.error());
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error to tell, like a full disk

    CLI::App app(
        "Exact interpolation over meshes of triangles or tetrahedra; proofs and pictures of meshes; audits of what "
        "other tools and formulas compute",
        "barycert");
    app.set_version_flag("--version", "barycert " BARYCERT_VERSION);
    app.require_subcommand(1);
    app.failure_message([&](const CLI::App* failed, const CLI::Error& e) {
        return "error: " +
               base::printable(with_command_name(usage_error(
                   *failed, e, "`barycert --help` and `barycert SUBCOMMAND --help` list subcommands and options",
                   {argv, static_cast<std::size_t>(argc)}))) +
               '\n';
    });
    int exit_code = exit_clean;
    const Options program(app, exit_code);
    add_subcommands(program);
    // Its options are those of barycert-tetgen, for help and completions; main() has handed all else over.
    barycert::Options of_mesh;
    add_options(*app.add_subcommand("mesh", "Mesh a PLC (" + base::suffix_list_read(base::Use::plc) +
                                                ") with TetGen: runs barycert-tetgen"),
                of_mesh);
    add_help(program);
    // After the subcommands, which would take it over.
    app.footer(with_command_name(
        R"(Exit codes: 0 success; 1 a mesh is not certified, results are wrong, a rule is broken, a figure is worse than
in the baseline, a mutant is not caught, or a witness is not reproduced; 2 usage or input error.
Tables go to stdout, everything else to stderr. `barycert help SUBCOMMAND` explains each.)"));
    if (!first.empty() && first.front() != '-' && std::ranges::count(command_names(app), first) == 0)
        return fail(file_error("option.usage", {}, "no such subcommand", {}, '"' + std::string(first) + '"',
                               base::did_you_mean(first, command_names(app), "`barycert --help` lists them")));
    try {
        remember_command_line(argc, argv);
        app.parse(argc, argv);
    } catch (const Exception& e) {
        return fail(e.error());
    } catch (const CLI::ParseError& e) {
        if (app.exit(e) != 0) return exit_error;
        // --help and --version were printed: to a full disk, perhaps.
        std::cout.flush();
        if (std::cout && write_output("-", "")) return exit_clean;
        return fail({.code = "file.unwritable", .what = "cannot write to stdout", .found = std::strerror(errno)});
    }
    return exit_code;
}

}  // namespace
}  // namespace barycert::cli

// Nothing is thrown but for want of memory, or by a library.
int main(int argc, char** argv) {
    namespace cli = barycert::cli;
    cli::expect_want_of_memory();
    try {
        return cli::run(argc, argv);
    } catch (const std::bad_alloc&) {
        return cli::fail_for_want_of_memory();
    } catch (const std::exception& e) {
        try {
            return cli::fail({.code = "internal.error", .what = e.what()});
        } catch (...) {
            return cli::fail_for_want_of_memory();
        }
    }
}
