// The boundary of a mesh as a picture.

#include <tbb/global_control.h>

#include <deque>
#include <optional>
#include <string>

#include "barycert/environment.hpp"
#include "barycert/io.hpp"
#include "barycert/jobs.hpp"
#include "barycert/jobs/field_files.hpp"
#include "barycert/jobs/run.hpp"
#include "barycert/sample/quantity/made_fields.hpp"
#include "barycert/surface.hpp"

namespace barycert {
namespace jobs {
namespace {

/// Triangles, with the chosen number at their points or on them.
struct DrawnSurface {
    Surface surface;
    std::vector<double> values;
    bool of_triangles = false;

    SurfaceView view(int dimension) const {
        SurfaceView view{.dimension = dimension, .points = surface.points, .triangles = surface.cells};
        (of_triangles ? view.triangle_values : view.point_values) = values;
        return view;
    }
};

/// The cells of a mesh in the plane, or the boundary of one in space. The fields of `options` are carried along.
Result<Surface> triangles_of(const Mesh& mesh, const CutOptions& options) {
    if (mesh.dimension == 3) return boundary(mesh, options);
    Surface cells;
    cells.points = mesh.points;
    cells.cells = mesh.cells;
    for (const Field* f : options.point_fields) cells.point_fields.push_back(*f);
    for (const Field* f : options.cell_fields) cells.cell_fields.push_back(*f);
    return cells;
}

Result<DrawnSurface> drawn_surface(const Mesh& mesh, const std::string& field, int threads, Notes& notes) {
    CutOptions options;
    options.threads = threads;
    FieldChoice chosen;
    std::deque<Field> made;
    if (!field.empty()) {
        const Result<FieldChoice> found = sample::number_named(mesh, field);
        if (!found) return found.error();
        std::vector<FieldChoice> one{*found};
        if (Status done = sample::make_all_fields(mesh, one, made, notes); !done) return done.error();
        chosen = one.front();
        (chosen.of_cells ? options.cell_fields : options.point_fields).push_back(chosen.field);
    }
    Result<Surface> surface = triangles_of(mesh, options);
    if (!surface) return surface.error();
    DrawnSurface drawn{std::move(*surface), {}, chosen.of_cells};
    if (chosen.field == nullptr) return drawn;
    drawn.values = (chosen.of_cells ? drawn.surface.cell_fields : drawn.surface.point_fields).front().data;
    return drawn;
}

}  // namespace
}  // namespace jobs

Result<RenderReport> render_mesh_file(const MeshPictureJob& job) {
    const ExactEnvironment environment;
    jobs::Stopwatch time;
    std::optional<tbb::global_control> limit;
    if (job.threads > 0)
        limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(job.threads));
    Result<Mesh> mesh =
        read_mesh(job.mesh, {.faces = false, .neighbours = false, .threads = job.threads, .step = job.step});
    if (!mesh) return mesh.error();
    const auto curved = take_as_straight(*mesh, job.mesh, job.curved);
    if (!curved) return curved.error();
    if (Status added = jobs::add_fields(job.field_files, *mesh); !added) return added.error();
    if (mesh->cells.empty())
        return Error{.what = "the mesh has no cells", .file = job.mesh, .remedy = "there is nothing to draw"};
    RenderReport summary;
    summary.picture = "mesh";
    summary.input = job.mesh;
    summary.output = job.output;
    summary.size = job.view.size;
    summary.notes = mesh->notes;
    const auto drawn = jobs::drawn_surface(*mesh, job.field, job.threads, summary.notes);
    if (!drawn) {
        Error error = drawn.error();
        if (error.file.empty()) error.file = job.mesh;
        return error;
    }
    ViewCounts counts;
    const Result<Image> image = draw_surface(drawn->view(mesh->dimension), job.view, &counts);
    if (!image) return image.error();
    if (Status written = write_png(job.output, *image); !written) return written.error();
    summary.counts = counts.render;
    summary.method = job.view.method;
    summary.rounding = job.view.rounding;
    if (!job.field.empty()) summary.colours = {job.field, counts.low, counts.high, counts.without_value};
    summary.curved = *curved;
    summary.seconds = time.lap();
    return summary;
}

}  // namespace barycert
