// barycert render gradient, texture: one triangle or square that lies in the window.

#include <CLI/CLI.hpp>

#include <memory>

#include "command.hpp"
#include "files.hpp"
#include "options.hpp"
#include "render.hpp"
#include "render_options.hpp"

namespace barycert::cli {
namespace {

struct PlainPicture {
    PictureOptions files;
    RasterSize size{400, 400};
    FillMethod method = FillMethod::barycentric;
    Rounding rounding = Rounding::plain;
};

struct TexturePicture : PlainPicture {
    std::string image;
    bool triangle = false;
    double low = 0, high = 1;  ///< u and v at the lower left and the upper right
    Wrap wrap = Wrap::clamp;
    Filter filter = Filter::nearest;
};

Scene plain_scene(const PlainPicture& p) {
    Scene scene;
    scene.size = p.size;
    scene.method = p.method;
    scene.rounding = p.rounding;
    return scene;
}

Scene gradient_scene(const PlainPicture& p) {
    Scene scene = plain_scene(p);
    scene.positions = {-0.9, -0.8, 0, 1, 0.9, -0.8, 0, 1, 0, 0.9, 0, 1};
    scene.colours = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    scene.triangles = {0, 1, 2};
    return scene;
}

Result<Scene> texture_scene(const TexturePicture& p) {
    Scene scene = plain_scene(p);
    Texture texture{four_colours(), p.wrap, p.filter};
    if (!p.image.empty()) {
        Result<Image> image = read_png(p.image);
        if (!image) return image.error();
        texture.image = std::move(*image);
    }
    scene.texture = std::move(texture);
    const double low = p.low, high = p.high;
    if (p.triangle) {
        scene.positions = {-1, -1, 0, 1, 1, -1, 0, 1, 0, 1, 0, 1};
        scene.texture_coordinates = {low, low, high, low, 0.5 * low + 0.5 * high, high};
        scene.triangles = {0, 1, 2};
    } else {
        scene.positions = {-1, -1, 0, 1, 1, -1, 0, 1, 1, 1, 0, 1, -1, 1, 0, 1};
        scene.texture_coordinates = {low, low, high, low, high, high, low, high};
        scene.triangles = {0, 1, 2, 0, 2, 3};
    }
    return scene;
}

void add_plain_options(CLI::App& sub, PlainPicture& p) {
    add_picture_options(sub, p.files);
    add_size_option(sub, p.size);
    add_method_options(sub, p.method, p.rounding);
}

}  // namespace

void add_render_gradient(CLI::App& render, int& exit_code) {
    auto* sub = render.add_subcommand("gradient", "A triangle with a red, a green and a blue corner");
    sub->footer(done_or_error);
    const auto p = std::make_shared<PlainPicture>();
    add_plain_options(*sub, *p);
    sub->callback([=, &exit_code] {
        exit_code = run_scene(p->files, "gradient", {}, [&]() -> Result<Scene> { return gradient_scene(*p); });
    });
}

void add_render_texture(CLI::App& render, int& exit_code) {
    auto* sub = render.add_subcommand("texture", "A picture on a square or a triangle");
    sub->footer(done_or_error);
    const auto p = std::make_shared<TexturePicture>();
    file_option(*sub, "--image", p->image, "The picture: .png; default: one of 2 by 2 texels");
    choice_option<bool>(*sub, "--shape", p->triangle, {{"square", false}, {"triangle", true}},
                        "What it is put on; default: square");
    choice_option<Wrap>(*sub, "--wrap", p->wrap,
                        {{"clamp", Wrap::clamp}, {"repeat", Wrap::repeat}, {"mirror", Wrap::mirror}},
                        "What is beyond the picture: its rim (default), the picture again, or again "
                        "and every other time reversed");
    choice_option<Filter>(*sub, "--filter", p->filter, {{"nearest", Filter::nearest}, {"bilinear", Filter::bilinear}},
                          "The texel at a point (default), or between the four around it");
    sub->add_option_function<std::string>(
           "--coordinates",
           [p](const std::string& text) {
               constexpr const char* expected = "MIN,MAX, finite numbers";
               const auto ends = numbers_of<double>("--coordinates", text, ',', finite, expected);
               if (ends.size() != 2) refuse_option("--coordinates", expected, text);
               p->low = ends[0];
               p->high = ends[1];
           },
           "u and v at the lower left and the upper right; default: 0,1, the picture once")
        ->type_name("MIN,MAX");
    add_plain_options(*sub, *p);
    sub->callback([=, &exit_code] {
        const std::vector<base::NamedFile> inputs =
            p->image.empty() ? std::vector<base::NamedFile>{} : base::named_files("--image", {p->image});
        exit_code = run_scene(p->files, "texture", inputs, [&] { return texture_scene(*p); });
    });
}

}  // namespace barycert::cli
