/// The subcommands of `barycert render`, one a file.
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace barycert::cli {

/// Each adds its subcommand to `render`; when it has run, `exit_code` is set.
void add_render_clip(CLI::App& render, int& exit_code);
void add_render_cube(CLI::App& render, int& exit_code);
void add_render_gradient(CLI::App& render, int& exit_code);
void add_render_iso(CLI::App& render, int& exit_code);
void add_render_mesh(CLI::App& render, int& exit_code);
void add_render_slice(CLI::App& render, int& exit_code);
void add_render_texture(CLI::App& render, int& exit_code);

}  // namespace barycert::cli
