// The executable barycert: one subcommand a file.

#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <string_view>

#include "barycert/base/begun_files.hpp"
#include "barycert/base/nearest_name.hpp"
#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "command.hpp"
#include "files.hpp"
#include "options/mistyped.hpp"
#include "tetgen/option_table.hpp"

// What is thrown is told below; telling it may fail for want of memory. NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
    using namespace barycert;
    // For all threads, before any of them starts: a library that was loaded first may have changed it.
    const ExactEnvironment environment;
    const std::string_view first = argc > 1 ? argv[1] : "";
    if (first == "mesh") return cli::exec_mesh(argc, argv);
    base::remove_begun_files_on_signals();
    // What was compiled in cannot be set.
    if (const Status exact = check_environment(measure_environment()); !exact) return cli::fail(exact.error());
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error to tell, like a full disk

    CLI::App app("barycert: barycentric interpolation at the speed of floating point, audited against exact arithmetic",
                 "barycert");
    app.set_version_flag("--version", "barycert " BARYCERT_VERSION);
    app.require_subcommand(1);
    app.footer(
        "Exit codes: 0 success; 1 threshold exceeded, mesh not certified or witness not reproduced; 2 usage or input "
        "error.\nTables go to stdout, everything else to stderr. `barycert help SUBCOMMAND` explains each.");
    app.failure_message([](const CLI::App* failed, const CLI::Error& e) {
        return "error: " +
               base::printable(cli::usage_error(
                   *failed, e.what(),
                   "`barycert --help` and `barycert SUBCOMMAND --help` list subcommands and options")) +
               '\n';
    });
    int exit_code = cli::exit_clean;
#ifdef BARYCERT_WITH_AUDIT
    cli::add_audit(app, exit_code);
    cli::add_gaps(app, exit_code);
#endif
    cli::add_check(app, exit_code);
    cli::add_sample(app, exit_code);
    cli::add_resample(app, exit_code);
    cli::add_verify(app, exit_code);
    cli::add_render(app, exit_code);
#ifdef BARYCERT_WITH_AUDIT
    cli::add_search(app, exit_code);
    cli::add_replay(app, exit_code);
    cli::add_catalogue(app, exit_code);
#endif
    // Its options are those of barycert-tetgen, for help and completions; main() has handed all else over.
    auto* mesh =
        app.add_subcommand("mesh", "Mesh a PLC (.poly .smesh .off .stl .ply) with TetGen: runs barycert-tetgen");
    OptionTable mesh_options;
    add_options(*mesh, mesh_options);
    cli::add_help(app, exit_code);
    const auto named_first = [&](const CLI::App* sub) { return sub->get_name() == first; };
    if (!first.empty() && first.front() != '-' && app.get_subcommands(named_first).empty()) {
        return cli::fail(
            {.what = "no such subcommand",
             .found = '"' + std::string(first) + '"',
             .remedy = base::did_you_mean(first, cli::command_names(app), "`barycert --help` lists them")});
    }
    try {
        cli::remember_command_line(argc, argv);
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (app.exit(e) != 0) return cli::exit_error;
        // --help and --version were printed: to a full disk, perhaps.
        std::cout.flush();
        if (std::cout && cli::write_output("-", "")) return cli::exit_clean;
        return cli::fail({.what = "cannot write to stdout", .found = std::strerror(errno)});
    } catch (const std::bad_alloc&) {
        return cli::fail({.what = "out of memory", .remedy = "use a smaller mesh or picture, or fewer threads"});
    } catch (const std::exception& e) {
        return cli::fail({.what = e.what()});
    }
    return exit_code;
}
