// Pictures of scenes and of meshes.

#include <cmath>
#include <deque>

#include "barycert/environment.hpp"
#include "barycert/jobs/field_files.hpp"
#include "barycert/jobs/job_files.hpp"
#include "barycert/jobs/pictures.hpp"

namespace barycert {
namespace jobs {

SurfaceView view_of(const Surface& s) {
    SurfaceView view{.points = s.points, .triangles = s.cells};
    if (!s.point_fields.empty()) {
        view.point_values = s.point_fields.front().data;
    } else if (!s.cell_fields.empty()) {
        view.triangle_values = s.cell_fields.front().data;
    }
    return view;
}

}  // namespace jobs

namespace {

/// The cells of a mesh in the plane, or the boundary of one in space, in the colours of the field; what is told of them
/// goes into the report.
Result<Image> image_of(const RenderJob& job, const Mesh& mesh, RenderReport& report) {
    CutOptions options{.threads = job.threads};
    std::deque<Field> made;
    if (!job.field.empty()) {
        const Result<FieldChoice> found = jobs::field_of_numbers(mesh, job.field, made, report.notes);
        if (!found) return found.error();
        (found->of_cells ? options.cell_fields : options.point_fields).push_back(found->field);
    }
    Result<Surface> surface = mesh.dimension == 3 ? boundary(mesh, options) : Surface();
    if (!surface) return surface.error();
    if (mesh.dimension == 2) {
        surface->points = mesh.points;
        surface->cells = mesh.cells;
        for (const Field* f : options.point_fields) surface->point_fields.push_back(*f);
        for (const Field* f : options.cell_fields) surface->cell_fields.push_back(*f);
    }
    SurfaceView view = jobs::view_of(*surface);
    view.dimension = mesh.dimension;
    ViewCounts counts;
    Result<Image> image = draw_surface(view, job.view, &counts);
    report.counts = counts.render;
    if (!job.field.empty()) report.colours = {job.field, counts.low, counts.high, counts.without_value};
    return image;
}

Result<Image> draw_mesh(const RenderJob& job, RenderReport& report) {
    const jobs::ThreadLimit limit(job.threads);
    Mesh mesh;
    MeshReport opened;
    if (Status done = jobs::open_mesh_with_fields(job, job.threads, mesh, opened); !done) return done.error();
    if (mesh.cells.empty()) return jobs::refusal(job.mesh, "the mesh has no cells", "", "", "there is nothing to draw");
    report.input = job.mesh;
    report.curved = opened.curved;
    report.notes = opened.notes;
    report.size = job.view.size;
    report.method = job.view.method;
    report.rounding = job.view.rounding;
    Result<Image> image = image_of(job, mesh, report);
    if (image || !image.error().file.empty()) return image;
    Error error = image.error();
    error.file = job.mesh;
    return error;
}

/// The largest difference of u or v at a pixel from the correctly rounded one.
Result<TexelError> texel_error(Scene scene, const PixelValues& drawn) {
    scene.method = FillMethod::barycentric;
    scene.interpolation = Interpolation::perspective;
    scene.rounding = Rounding::correct;
    PixelValues exact;
    if (const Result<Image> done = render(scene, nullptr, &exact); !done) return done.error();
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

Result<Image> draw_scene(const RenderJob& job, RenderReport& report) {
    const bool of_file = job.picture == PictureKind::scene, cube = job.picture == PictureKind::cube;
    const Result<Scene> scene = of_file ? read_scene(job.scene) : jobs::small_picture(job);
    if (!scene) return scene.error();
    report.input = of_file ? job.scene : job.image;
    report.size = scene->size;
    report.method = scene->method;
    report.interpolation = scene->interpolation;
    report.rounding = scene->rounding;
    PixelValues coordinates;
    Result<Image> image = render(*scene, &report.counts, cube ? &coordinates : nullptr);
    if (!image || !cube) return image;
    const Result<TexelError> error = texel_error(*scene, coordinates);
    if (!error) return error.error();
    report.texel_error = *error;
    return image;
}

std::vector<base::NamedFile> inputs_of(const RenderJob& job) {
    if (job.picture == PictureKind::mesh) return jobs::input_files(job);
    std::vector<base::NamedFile> inputs{{"job.image", job.image}};
    if (job.picture != PictureKind::scene) return inputs;
    inputs.push_back({"the scene", job.scene});
    for (const std::string& path : scene_files(job.scene)) inputs.push_back({"an image of the scene", path});
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
    RenderReport report;
    const Result<Image> image = job.picture == PictureKind::mesh ? draw_mesh(job, report) : draw_scene(job, report);
    if (!image) return image.error();
    if (Status written = write_png(job.output, *image); !written) return written.error();
    report.picture = name(job.picture);
    report.output = job.output;
    report.seconds = time.lap();
    return report;
}

}  // namespace barycert
