// The boundary of a mesh as a picture.

#include <deque>
#include <string>

#include "barycert/io.hpp"
#include "barycert/jobs/field_files.hpp"
#include "barycert/jobs/job_files.hpp"
#include "barycert/jobs/pictures.hpp"
#include "barycert/sample/quantity/quantities.hpp"
#include "barycert/surface.hpp"

namespace barycert::jobs {
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

Result<RenderReport> draw_mesh(const RenderJob& job) {
    const ThreadLimit limit(job.threads);
    RenderReport report;
    Result<Mesh> mesh = open_mesh(job, job.threads, job.step, report.curved);
    if (!mesh) return mesh.error();
    if (Status added = add_fields(job.field_files, *mesh); !added) return added.error();
    if (mesh->cells.empty())
        return Error{.what = "the mesh has no cells", .file = job.mesh, .remedy = "there is nothing to draw"};
    report.input = job.mesh;
    report.size = job.view.size;
    report.notes = mesh->notes;
    const auto drawn = drawn_surface(*mesh, job.field, job.threads, report.notes);
    if (!drawn) {
        Error error = drawn.error();
        if (error.file.empty()) error.file = job.mesh;
        return error;
    }
    ViewCounts counts;
    const Result<Image> image = draw_surface(drawn->view(mesh->dimension), job.view, &counts);
    if (!image) return image.error();
    if (Status written = write_png(job.output, *image); !written) return written.error();
    report.counts = counts.render;
    report.method = job.view.method;
    report.rounding = job.view.rounding;
    if (!job.field.empty()) report.colours = {job.field, counts.low, counts.high, counts.without_value};
    return report;
}

}  // namespace barycert::jobs
