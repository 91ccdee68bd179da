#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <string>
#include <utility>

#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/mesh/consistency.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface/levels.hpp"
#include "barycert/surface/parts.hpp"
#include "barycert/surface/vertices.hpp"

namespace barycert::surface {
namespace {

template <class Level>
Result<Cut> cut_at(const Mesh& mesh, const Level& level, const CutOptions& options) {
    std::vector<std::uint8_t> states(mesh.point_count());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, states.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) states[i] = level.state(i);
    });
    Cut cut;
    if (Status done = cut_cells(mesh, states, cut.surface, cut.counts); !done) return done.error();
    cut.counts.tiers = place_points(mesh, level, options, cut.surface);
    carry_cell_fields(options, cut.surface);
    cut.counts.second_order = mesh.mid_nodes.empty() ? 0 : mesh.cell_count();
    return cut;
}

Result<Cut> cut_field(int dimension, const Mesh& mesh, const Field& field, double value, const CutOptions& options,
                      int component) {
    const ExactEnvironment environment;
    if (Status fits = mesh::check_field(&field, mesh.point_count(), "node"); !fits) return fits.error();
    if (component < 0 || component >= field.components)
        return Error{.what = "no such component of field \"" + field.name + '"',
                     .expected = "0 to " + std::to_string(field.components - 1),
                     .found = std::to_string(component)};
    if (!std::isfinite(value))
        return Error{.what = "the value to cut at", .expected = "a finite number", .found = base::shortest(value)};
    return in_arena(options.threads, [&]() -> Result<Cut> {
        if (Status good = check_mesh(mesh, dimension); !good) return good.error();
        if (Status fit = check_options(mesh, options); !fit) return fit.error();
        return cut_at(mesh, FieldLevel(field, component, value), options);
    });
}

}  // namespace
}  // namespace barycert::surface

namespace barycert {

Result<Cut> isosurface(const Mesh& mesh, const Field& field, double value, const CutOptions& options, int component) {
    return surface::cut_field(3, mesh, field, value, options, component);
}

Result<Cut> isoline(const Mesh& mesh, const Field& field, double value, const CutOptions& options, int component) {
    return surface::cut_field(2, mesh, field, value, options, component);
}

Result<Cut> slice(const Mesh& mesh, const Plane& plane, const CutOptions& options) {
    const ExactEnvironment environment;
    bool finite = std::isfinite(plane.offset), zero = true;
    for (const double n : plane.normal) {
        finite = finite && std::isfinite(n);
        zero = zero && n == 0;
    }
    if (!finite || zero)
        return Error{.what = "the plane",
                     .expected = "four finite numbers, the normal not zero",
                     .found = base::shortest(plane.normal[0]) + ", " + base::shortest(plane.normal[1]) + ", " +
                              base::shortest(plane.normal[2]) + ", " + base::shortest(plane.offset)};
    return surface::in_arena(options.threads, [&]() -> Result<Cut> {
        if (Status good = surface::check_mesh(mesh, 3); !good) return good.error();
        if (Status fit = surface::check_options(mesh, options); !fit) return fit.error();
        return surface::cut_at(mesh, surface::PlaneLevel(mesh, plane), options);
    });
}

}  // namespace barycert
