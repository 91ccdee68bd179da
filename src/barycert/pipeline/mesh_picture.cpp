// The boundary of a mesh as a picture.

#include <tbb/global_control.h>

#include <charconv>
#include <optional>
#include <string>

#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/io.hpp"
#include "barycert/pipeline/field_files.hpp"
#include "barycert/pipeline/run.hpp"
#include "barycert/rendering.hpp"
#include "barycert/sample/points/field_choice.hpp"
#include "barycert/surface.hpp"

namespace barycert {
namespace pipeline {
namespace {

struct ChosenComponent {
    const Field* field = nullptr;
    bool of_cells = false;
    int component = 0;
};

/// NAME.K, where there is no field of the whole name.
std::optional<std::pair<std::string, int>> with_component(const std::string& name) {
    const std::size_t dot = name.rfind('.');
    if (dot == std::string::npos) return std::nullopt;
    int k = 0;
    const char* const end = name.data() + name.size();
    const auto [stop, error] = std::from_chars(name.data() + dot + 1, end, k);
    if (error != std::errc{} || stop != end || k < 0) return std::nullopt;
    return std::pair(name.substr(0, dot), k);
}

Result<ChosenComponent> chosen_field(const Mesh& mesh, const std::string& name) {
    Result<std::vector<FieldChoice>> found = sample::fields_named(mesh, {name});
    ChosenComponent chosen;
    if (found) {
        if (found->size() != 1)
            return Error{
                .what = "more than one field", .expected = "one", .found = base::quoted(name), .remedy = "name one"};
        if (const int n = found->front().field->components; n != 1)
            return Error{.what = "the field has several components",
                         .expected = "the name of one: " + name + ".0 to " + name + '.' + std::to_string(n - 1),
                         .found = base::quoted(name),
                         .remedy = "choose one of them"};
    } else {
        const auto part = with_component(name);
        const Error error = found.error();
        if (part) found = sample::fields_named(mesh, {part->first});
        if (!found || found->size() != 1) return error;
        chosen.component = part->second;
        if (chosen.component >= found->front().field->components)
            return Error{.what = "the field has no such component",
                         .expected = "0 to " + std::to_string(found->front().field->components - 1),
                         .found = base::quoted(name),
                         .remedy = "choose one of them"};
    }
    chosen.field = found->front().field;
    chosen.of_cells = found->front().of_cells;
    return chosen;
}

/// Triangles, with the chosen component at their points or on them.
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

Result<DrawnSurface> drawn_surface(const Mesh& mesh, const std::string& field, int threads) {
    CutOptions options;
    options.threads = threads;
    ChosenComponent chosen;
    if (!field.empty()) {
        const Result<ChosenComponent> found = chosen_field(mesh, field);
        if (!found) return found.error();
        chosen = *found;
        (chosen.of_cells ? options.cell_fields : options.point_fields).push_back(chosen.field);
    }
    Result<Surface> surface = triangles_of(mesh, options);
    if (!surface) return surface.error();
    DrawnSurface drawn{std::move(*surface), {}, chosen.of_cells};
    if (chosen.field == nullptr) return drawn;
    const Field& carried = (chosen.of_cells ? drawn.surface.cell_fields : drawn.surface.point_fields).front();
    const auto components = static_cast<std::size_t>(carried.components);
    for (auto i = static_cast<std::size_t>(chosen.component); i < carried.data.size(); i += components)
        drawn.values.push_back(carried.data[i]);
    return drawn;
}

}  // namespace
}  // namespace pipeline

Result<RenderSummary> render_mesh_file(const MeshPictureJob& job) {
    const ExactEnvironment environment;
    pipeline::Stopwatch time;
    std::optional<tbb::global_control> limit;
    if (job.threads > 0)
        limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(job.threads));
    Result<Mesh> mesh = read_mesh(job.mesh, {.faces = false, .neighbours = false, .threads = job.threads});
    if (!mesh) return mesh.error();
    if (Status added = pipeline::add_fields(job.field_files, *mesh); !added) return added.error();
    if (mesh->cells.empty())
        return Error{.what = "the mesh has no cells", .file = job.mesh, .remedy = "there is nothing to draw"};
    RenderSummary summary;
    summary.picture = "mesh";
    summary.input = job.mesh;
    summary.output = job.output;
    summary.size = job.view.size;
    const auto drawn = pipeline::drawn_surface(*mesh, job.field, job.threads);
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
    summary.notes = mesh->notes;
    summary.seconds = time.lap();
    return summary;
}

}  // namespace barycert
