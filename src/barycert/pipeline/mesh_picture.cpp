// The boundary of a mesh as a picture.

#include <tbb/global_control.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>

#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/io.hpp"
#include "barycert/mesh/adjacency.hpp"
#include "barycert/pipeline/run.hpp"
#include "barycert/rendering.hpp"
#include "barycert/sample/points/field_choice.hpp"

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

/// What is drawn: triangles, and which cell each belongs to.
struct DrawnFacets {
    std::vector<Mesh::Index> triangles, cells;
};

DrawnFacets facets_of(const Mesh& mesh) {
    DrawnFacets drawn;
    if (mesh.dimension == 2) {
        drawn.triangles = mesh.cells;
        for (std::size_t c = 0; c < mesh.cell_count(); ++c) drawn.cells.push_back(static_cast<Mesh::Index>(c));
        return drawn;
    }
    for (const std::int64_t facet : mesh::hull_facets(mesh, mesh::compute_neighbours(mesh))) {
        const std::int64_t cell = facet / 4;
        for (std::int64_t k = 0; k < 4; ++k) {
            if (k != facet % 4) drawn.triangles.push_back(mesh.cells[static_cast<std::size_t>(4 * cell + k)]);
        }
        drawn.cells.push_back(static_cast<Mesh::Index>(cell));
    }
    return drawn;
}

/// One component of the field, for each node or each triangle.
std::vector<double> values_of(const ChosenComponent& chosen, const DrawnFacets& drawn) {
    const auto components = static_cast<std::size_t>(chosen.field->components);
    const auto at = [&](std::size_t i) {
        return chosen.field->data[i * components + static_cast<std::size_t>(chosen.component)];
    };
    std::vector<double> values;
    if (chosen.of_cells) {
        for (const Mesh::Index cell : drawn.cells) values.push_back(at(static_cast<std::size_t>(cell)));
    } else {
        for (std::size_t i = 0; i < chosen.field->data.size() / components; ++i) values.push_back(at(i));
    }
    return values;
}

}  // namespace
}  // namespace pipeline

Result<RenderSummary> render_mesh_file(const MeshPictureJob& job) {
    const ExactEnvironment environment;
    pipeline::Stopwatch time;
    std::optional<tbb::global_control> limit;
    if (job.threads > 0)
        limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(job.threads));
    const Result<Mesh> mesh = read_mesh(job.mesh, {.faces = false, .neighbours = false, .threads = job.threads});
    if (!mesh) return mesh.error();
    if (mesh->cells.empty())
        return Error{.what = "the mesh has no cells", .file = job.mesh, .remedy = "there is nothing to draw"};
    RenderSummary summary;
    summary.picture = "mesh";
    summary.input = job.mesh;
    summary.output = job.output;
    summary.size = job.view.size;
    const pipeline::DrawnFacets drawn = pipeline::facets_of(*mesh);
    SurfaceView surface{.dimension = mesh->dimension, .points = mesh->points, .triangles = drawn.triangles};
    std::vector<double> values;
    if (!job.field.empty()) {
        const auto chosen = pipeline::chosen_field(*mesh, job.field);
        if (!chosen) {
            Error error = chosen.error();
            error.file = job.mesh;
            return error;
        }
        values = pipeline::values_of(*chosen, drawn);
        (chosen->of_cells ? surface.triangle_values : surface.point_values) = values;
    }
    ViewCounts counts;
    const Result<Image> image = draw_surface(surface, job.view, &counts);
    if (!image) return image.error();
    if (Status written = write_png(job.output, *image); !written) return written.error();
    summary.counts = counts.render;
    summary.method = job.view.method;
    summary.rounding = job.view.rounding;
    if (!job.field.empty()) summary.colours = {job.field, counts.low, counts.high, counts.without_value};
    summary.seconds = time.lap();
    return summary;
}

}  // namespace barycert
