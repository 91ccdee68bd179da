// barycert render: one subcommand of its own a kind of picture.

#include <CLI/CLI.hpp>

#include "command.hpp"

namespace barycert::cli {

void add_render(CLI::App& app, int& exit_code) {
    auto* render = app.add_subcommand("render", "Draw pictures, and measure what the shortcuts of rasterisers cost");
    render->require_subcommand(1);
#ifdef BARYCERT_WITH_AUDIT
    add_render_drift(*render, exit_code);
    add_render_texels(*render, exit_code);
#else
    static_cast<void>(exit_code);
#endif
}

}  // namespace barycert::cli
