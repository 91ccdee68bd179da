// Pictures of scenes: one from a file, and those that show what rasterising does.

#include <cmath>
#include <utility>

#include "barycert/environment.hpp"
#include "barycert/jobs/job_files.hpp"
#include "barycert/jobs/pictures.hpp"

namespace barycert {
namespace {

Scene plain_scene(const RenderJob& job) {
    Scene scene;
    scene.size = job.view.size;
    scene.method = job.view.method;
    scene.rounding = job.view.rounding;
    return scene;
}

Scene gradient_scene(const RenderJob& job) {
    Scene scene = plain_scene(job);
    scene.positions = {-0.9, -0.8, 0, 1, 0.9, -0.8, 0, 1, 0, 0.9, 0, 1};
    scene.colours = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    scene.triangles = {0, 1, 2};
    return scene;
}

Result<Scene> texture_scene(const RenderJob& job) {
    Scene scene = plain_scene(job);
    Texture texture{four_colours(), job.wrap, job.filter};
    if (!job.image.empty()) {
        Result<Image> image = read_png(job.image);
        if (!image) return image.error();
        texture.image = std::move(*image);
    }
    scene.texture = std::move(texture);
    const auto [low, high] = job.coordinates;
    if (job.triangle) {
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

Result<Scene> cube_scene(const RenderJob& job) {
    Scene scene = plain_scene(job);
    scene.interpolation = job.interpolation;
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
    const auto projection = perspective(62, 1.0 * scene.size.width / scene.size.height, 0.5, 10);
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

Result<Scene> scene_of(const RenderJob& job) {
    switch (job.picture) {
        case PictureKind::gradient:
            return gradient_scene(job);
        case PictureKind::texture:
            return texture_scene(job);
        case PictureKind::cube:
            return cube_scene(job);
        case PictureKind::clip:
            return jobs::clip_scene(job.view.size);
        default:
            return read_scene(job.scene);
    }
}

Result<RenderReport> draw_scene(const RenderJob& job) {
    const Result<Scene> scene = scene_of(job);
    if (!scene) return scene.error();
    RenderReport report;
    report.input = job.picture == PictureKind::scene ? job.scene : job.image;
    report.size = scene->size;
    report.method = scene->method;
    report.interpolation = scene->interpolation;
    report.rounding = scene->rounding;
    PixelValues coordinates;
    const bool cube = job.picture == PictureKind::cube;
    const Result<Image> image = render(*scene, &report.counts, cube ? &coordinates : nullptr);
    if (!image) return image.error();
    if (cube) {
        const Result<TexelError> error = texel_error(*scene, coordinates);
        if (!error) return error.error();
        report.texel_error = *error;
    }
    if (Status written = write_png(job.output, *image); !written) return written.error();
    return report;
}

std::vector<base::NamedFile> inputs_of(const RenderJob& job) {
    if (job.picture == PictureKind::mesh) return jobs::input_files(job);
    if (job.picture != PictureKind::scene) return base::named_files("job.image", {job.image});
    std::vector<base::NamedFile> inputs = base::named_files("an image of the scene", scene_files(job.scene));
    inputs.insert(inputs.begin(), {{"job.image", job.image}, {"the scene", job.scene}});
    std::erase_if(inputs, [](const base::NamedFile& f) { return f.path.empty(); });
    return inputs;
}

}  // namespace

Result<RenderReport> render_files(const RenderJob& job) {
    const ExactEnvironment environment;
    if (!job.output.ends_with(".png"))
        return jobs::refusal(job.output, "pictures are PNG files", "a name that ends in .png", "",
                             "choose another name for job.output");
    if (const Status ok = jobs::check_outputs(job, inputs_of(job), {{"job.output", job.output}}); !ok)
        return ok.error();
    jobs::Stopwatch time;
    Result<RenderReport> report = job.picture == PictureKind::mesh ? jobs::draw_mesh(job) : draw_scene(job);
    if (!report) return report;
    report->picture = name(job.picture);
    report->output = job.output;
    report->seconds = time.lap();
    return report;
}

}  // namespace barycert
