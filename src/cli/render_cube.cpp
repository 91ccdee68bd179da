// barycert render cube: a checkerboard on the faces of a cube in perspective, right, or wrong in one of the usual ways;
// and how wrong it is, in texels.

#include <CLI/CLI.hpp>

#include <cmath>
#include <memory>

#include "command.hpp"
#include "options.hpp"
#include "render.hpp"
#include "render_options.hpp"

namespace barycert::cli {
namespace {

struct CubePicture {
    PictureOptions files;
    RasterSize size{480, 400};
    FillMethod method = FillMethod::barycentric;
    Rounding rounding = Rounding::plain;
    Interpolation interpolation = Interpolation::perspective;
};

/// A face of the cube from -1 to 1, on which u and v go from 0 to 1 along two axes.
void add_face(Scene& scene, const Vector3& middle, const Vector3& u, const Vector3& v) {
    const auto first = static_cast<std::int32_t>(scene.positions.size() / 4);
    constexpr double corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (const auto& c : corners) {
        for (std::size_t k = 0; k < 3; ++k) scene.positions.push_back(middle[k] + c[0] * u[k] + c[1] * v[k]);
        scene.positions.push_back(1);
        for (const double x : c) scene.texture_coordinates.push_back(x > 0 ? 1 : 0);
    }
    for (const std::int32_t k : {0, 1, 2, 0, 2, 3}) scene.triangles.push_back(first + k);
}

Result<Scene> cube_scene(const CubePicture& p) {
    Scene scene;
    scene.size = p.size;
    scene.method = p.method;
    scene.rounding = p.rounding;
    scene.interpolation = p.interpolation;
    Result<Image> board = checkerboard(8, 8);
    if (!board) return board.error();
    scene.texture = Texture{std::move(*board), Wrap::clamp, Filter::nearest};
    add_face(scene, {0, 0, 1}, {1, 0, 0}, {0, 1, 0});
    add_face(scene, {1, 0, 0}, {0, 0, -1}, {0, 1, 0});
    add_face(scene, {0, 1, 0}, {1, 0, 0}, {0, 0, -1});
    add_face(scene, {0, 0, -1}, {-1, 0, 0}, {0, 1, 0});
    add_face(scene, {-1, 0, 0}, {0, 0, 1}, {0, 1, 0});
    add_face(scene, {0, -1, 0}, {1, 0, 0}, {0, 0, 1});
    const auto view = look_at({1.6, 1.5, 2.4}, {0, -0.1, 0.13}, {0, 1, 0});
    if (!view) return view.error();
    const auto projection = perspective(62, 1.0 * p.size.width / p.size.height, 0.5, 10);
    if (!projection) return projection.error();
    scene.to_clip = *projection * *view;
    return scene;
}

/// The largest difference of u or v at a pixel from the correctly rounded one.
Result<TexelError> texel_error(const Scene& scene, const PixelValues& drawn) {
    Scene right = scene;
    right.method = FillMethod::barycentric;
    right.interpolation = Interpolation::perspective;
    right.rounding = Rounding::correct;
    PixelValues exact;
    if (const Result<Image> done = render(right, nullptr, &exact); !done) return done.error();
    const double texels[2] = {1.0 * scene.texture->image.width, 1.0 * scene.texture->image.height};
    TexelError worst;
    for (std::size_t i = 0; i < drawn.data.size(); ++i) {
        const double error = std::abs(drawn.data[i] - exact.data[i]) * texels[i % 2];
        if (!(error > worst.texels)) continue;  // NaN where nothing is drawn
        const auto pixel = static_cast<std::int32_t>(i / 2);
        worst = {error, pixel % scene.size.width, pixel / scene.size.width};
    }
    return worst;
}

Result<RenderReport> draw_cube(const CubePicture& p) {
    const Result<Scene> scene = cube_scene(p);
    if (!scene) return scene.error();
    RenderReport summary = summary_of("cube", p.files, *scene);
    PixelValues coordinates;
    const Result<Image> image = render(*scene, &summary.counts, &coordinates);
    if (!image) return image.error();
    const Result<TexelError> error = texel_error(*scene, coordinates);
    if (!error) return error.error();
    summary.texel_error = *error;
    if (Status written = write_png(p.files.output, *image); !written) return written.error();
    return summary;
}

}  // namespace

void add_render_cube(CLI::App& render, int& exit_code) {
    auto* sub = render.add_subcommand(
        "cube",
        "A checkerboard on the faces of a cube in perspective, and the largest error of its texture coordinates");
    sub->footer(done_or_error);
    const auto p = std::make_shared<CubePicture>();
    choice_option<Interpolation>(
        *sub, "--interpolation", p->interpolation,
        {{"perspective", Interpolation::perspective},
         {"affine", Interpolation::affine},
         {"projected-z", Interpolation::projected_z}},
        "Of texture coordinates in the window: (v/w)/(1/w) (default); v itself, which is wrong; with "
        "the projected z in place of w, which is wrong as well");
    add_picture_options(*sub, p->files);
    add_size_option(*sub, p->size);
    add_method_options(*sub, p->method, p->rounding);
    sub->callback([=, &exit_code] { exit_code = run_picture(p->files, {}, [&] { return draw_cube(*p); }); });
}

}  // namespace barycert::cli
