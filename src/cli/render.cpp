// barycert render: pictures and surfaces.

#include "render.hpp"

#include <CLI/CLI.hpp>

#include "command.hpp"

namespace barycert::cli {

void add_render(CLI::App& app, int& exit_code) {
    auto* const render = app.add_subcommand("render", "Surfaces and pictures of meshes and their fields");
    render->require_subcommand(1);
    add_render_iso(*render, exit_code);
    add_render_slice(*render, exit_code);
}

}  // namespace barycert::cli
