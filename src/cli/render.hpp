/// The subcommands of `barycert render`, one a file.
#pragma once

#include <string>
#include <vector>

#include "barycert/result.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace barycert::cli {

/// An Error if the word names none of the pictures, and no scene (.json).
Status check_picture_name(const std::string& word, const std::vector<std::string>& pictures);

/// Each adds its subcommand to `render`; when it has run, `exit_code` is set.
void add_render_clip(CLI::App& render, int& exit_code);
void add_render_cube(CLI::App& render, int& exit_code);
void add_render_gradient(CLI::App& render, int& exit_code);
void add_render_iso(CLI::App& render, int& exit_code);
void add_render_mesh(CLI::App& render, int& exit_code);
void add_render_slice(CLI::App& render, int& exit_code);
void add_render_texture(CLI::App& render, int& exit_code);

}  // namespace barycert::cli
