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

/// Draws the surface in the colours of the field; what is told of them goes into the report.
Result<Image> image_of(const RenderJob& job, const Mesh& mesh, RenderReport& report) {
    CutOptions options;
    options.threads = job.threads;
    FieldChoice chosen;
    std::deque<Field> made;
    if (!job.field.empty()) {
        const Result<FieldChoice> found = field_of_numbers(mesh, job.field, made, report.notes);
        if (!found) return found.error();
        chosen = *found;
        (chosen.of_cells ? options.cell_fields : options.point_fields).push_back(chosen.field);
    }
    const Result<Surface> surface = triangles_of(mesh, options);
    if (!surface) return surface.error();
    SurfaceView view{.dimension = mesh.dimension, .points = surface->points, .triangles = surface->cells};
    if (chosen.field != nullptr && chosen.of_cells) view.triangle_values = surface->cell_fields.front().data;
    if (chosen.field != nullptr && !chosen.of_cells) view.point_values = surface->point_fields.front().data;
    ViewCounts counts;
    Result<Image> image = draw_surface(view, job.view, &counts);
    report.counts = counts.render;
    if (!job.field.empty()) report.colours = {job.field, counts.low, counts.high, counts.without_value};
    return image;
}

}  // namespace

Result<RenderReport> draw_mesh(const RenderJob& job) {
    const ThreadLimit limit(job.threads);
    RenderReport report;
    Result<Mesh> mesh = open_mesh(job, job.threads, job.step, report.curved);
    if (!mesh) return mesh.error();
    if (Status added = add_fields(job.field_files, *mesh); !added) return added.error();
    if (mesh->cells.empty()) return refusal(job.mesh, "the mesh has no cells", "", "", "there is nothing to draw");
    report.input = job.mesh;
    report.size = job.view.size;
    report.notes = mesh->notes;
    report.method = job.view.method;
    report.rounding = job.view.rounding;
    const Result<Image> image = image_of(job, *mesh, report);
    if (!image) {
        Error error = image.error();
        if (error.file.empty()) error.file = job.mesh;
        return error;
    }
    if (Status written = write_png(job.output, *image); !written) return written.error();
    return report;
}

}  // namespace barycert::jobs
