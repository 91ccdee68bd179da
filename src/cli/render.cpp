// barycert render: pictures and surfaces, one subcommand of its own each; here a scene from a file.

#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>

#include "barycert/base/nearest_name.hpp"
#include "command.hpp"
#include "files.hpp"
#include "options/mistyped.hpp"
#include "render.hpp"
#include "render_options.hpp"

namespace barycert::cli {
namespace {

constexpr const char* pictures_remedy = "`barycert render --help` lists the pictures";

int run_scene_file(const std::string& path, const PictureOptions& o, const std::vector<std::string>& pictures) {
    if (path.empty())
        return fail({.what = "nothing to draw",
                     .expected = "the name of a picture, or a scene (.json)",
                     .remedy = pictures_remedy});
    if (const Status named = check_picture_name(path, pictures); !named) return fail(named.error());
    if (o.output.empty())
        return fail({.what = "--output is required", .remedy = "name the picture: --output FILE.png"});
    std::vector<base::NamedFile> inputs{{"the scene", path}};
    for (base::NamedFile& file : base::named_files("an image of the scene", scene_files(path)))
        inputs.push_back(std::move(file));
    return run_scene(o, "scene", inputs, [&] { return read_scene(path); });
}

}  // namespace

Status check_picture_name(const std::string& word, const std::vector<std::string>& pictures) {
    if (word.ends_with(".json") || std::find(pictures.begin(), pictures.end(), word) != pictures.end()) return Done{};
    return Error{.what = "no such picture",
                 .expected = "the name of a picture, or a scene (.json)",
                 .found = '"' + word + '"',
                 .remedy = base::did_you_mean(word, pictures, pictures_remedy)};
}

void add_render(CLI::App& app, int& exit_code) {
    auto* sub = app.add_subcommand(
        "render", "Pictures of meshes and scenes, surfaces in meshes, and what the shortcuts of rasterisers cost");
    const auto path = std::make_shared<std::string>();
    const auto o = std::make_shared<PictureOptions>();
    file_option(*sub, "SCENE", *path, "A scene (.json)");
    add_picture_options(*sub, *o, false);
    sub->require_subcommand(0, 1);
    add_render_gradient(*sub, exit_code);
    add_render_texture(*sub, exit_code);
    add_render_cube(*sub, exit_code);
    add_render_clip(*sub, exit_code);
    add_render_mesh(*sub, exit_code);
    add_render_iso(*sub, exit_code);
    add_render_slice(*sub, exit_code);
#ifdef BARYCERT_WITH_AUDIT
    add_render_drift(*sub, exit_code);
    add_render_texels(*sub, exit_code);
#endif
    // After the pictures, which would take it over.
    sub->footer(
        "`barycert render SCENE.json --output FILE.png` draws a scene; doc/rendering.md describes its file. Coverage "
        "is\n"
        "exact: a pixel belongs to the triangle that holds its centre, and on a common side to exactly one of the "
        "two.\n"
        "`barycert help render PICTURE` explains each picture. Exit codes: 0 done; 2 usage or input error.");
    sub->callback([=, &exit_code] {
        if (sub->get_subcommands().empty()) exit_code = run_scene_file(*path, *o, command_names(*sub));
    });
}

}  // namespace barycert::cli
