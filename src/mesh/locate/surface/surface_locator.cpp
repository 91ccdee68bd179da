#include "barycert/surface_locator.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/surface.hpp"
#include "barycert/weights.hpp"
#include "core/base/finite.hpp"
#include "mesh/index/cell_tree.hpp"
#include "mesh/index/facet_contact.hpp"
#include "mesh/index/triangles.hpp"
#include "mesh/locate/batch.hpp"
#include "mesh/locate/near_feature.hpp"
#include "mesh/locate/surface/surface_data.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert {
namespace locate {
namespace {

Error inconsistent(std::string found) {
    return {.code = "surface.inconsistent",
            .what = "the surface is inconsistent",
            .found = std::move(found),
            .remedy = "correct the surface in memory"};
}

Status check(const Surface& s) {
    if (s.dimension != 3) return inconsistent("segments in the plane");
    if (s.points.size() % 3 != 0 || s.cells.size() % 3 != 0)
        return inconsistent("points or triangles that are not whole");
    if (s.point_count() > INT32_MAX || s.cell_count() > std::size_t{1} << 29)
        return inconsistent("more than 2147483647 points or 536870912 triangles");
    if (!base::all_finite(s.points)) return inconsistent("a coordinate that is not finite");
    const auto is_point = [&](Mesh::Index i) { return i >= 0 && static_cast<std::size_t>(i) < s.point_count(); };
    if (!std::ranges::all_of(s.cells, is_point)) return inconsistent("a corner of a triangle that is no point");
    return Done{};
}

/// Where the nearest point lies within an edge or a face, of the projection to it.
double value_at(const Surface& s, const Field& field, bool of_cells, const SurfaceNearest& at, const double* p,
                std::size_t c) {
    const auto width = static_cast<std::size_t>(field.components);
    if (at.cell < 0) return std::numeric_limits<double>::quiet_NaN();
    const auto row = [&](Mesh::Index i) { return field.data[width * static_cast<std::size_t>(i) + c]; };
    if (of_cells) return row(at.cell);
    const NearFeature on = near_feature(at.nodes, s.points, 3);
    std::array<double, 3> values{};
    for (std::size_t i = 0; i < static_cast<std::size_t>(on.count); ++i) values[i] = row(on.nodes[i]);
    if (on.count == 1) return values[0];
    return interpolate(on.simplex(), on.vertices().data(), p, values.data()).value().value;
}

void set_on(const Surface& s, const double* p, SurfaceNearest& n) {
    if (n.cell < 0 || n.distance != 0) return;
    index::PlacedFacet f;
    for (std::size_t k = 0; k < 3; ++k) {
        f.nodes[k] = s.cells[3 * static_cast<std::size_t>(n.cell) + k];
        f.at[k] = &s.points[3 * static_cast<std::size_t>(f.nodes[k])];
    }
    n.on = index::proper(3, f) ? index::face_around(3, f, p)[0] >= 0 : part_of_flat(f.at, p) != 0;
}

/// Finds the nearest triangles of points [first, last), those near each other one after the other.
void nearest_of_block(const SurfaceData& data, std::span<const double> points, double limit, std::size_t first,
                      std::size_t last, std::span<SurfaceNearest> found) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> order(last - first);
    for (std::size_t i = first; i < last; ++i)
        order[i - first] = {data.triangles.index.bins.of(&points[3 * i]), static_cast<std::uint32_t>(i - first)};
    std::ranges::sort(order);
    std::vector<const double*> from;
    std::vector<SurfaceNearest*> to;
    for (const auto& [bin, i] : order) {
        from.push_back(&points[3 * (first + i)]);
        to.push_back(&found[first + i]);
    }
    data.nearest(from, limit, to);
    for (std::size_t i = first; i < last; ++i) set_on(*data.surface, &points[3 * i], found[i]);
}

}  // namespace
}  // namespace locate

using namespace locate;

SurfaceLocator::SurfaceLocator(std::unique_ptr<SurfaceData> data)
    : data_(data.release(), [](SurfaceData* d) { delete d; }) {}

Result<SurfaceLocator> SurfaceLocator::build(const Surface& surface, const BuildOptions& options, bool flat) {
    const ExactEnvironment environment;
    if (const Status good = check(surface); !good) return good.error();
    auto data = std::make_unique<SurfaceData>();
    data->surface = &surface;
    data->threads = options.threads;
    base::in_arena(options.threads, surface.cell_count(), [&] {
        std::vector<Mesh::Index> numbers(surface.cell_count());
        std::iota(numbers.begin(), numbers.end(), 0);
        data->triangles = index::place_triangles(surface.points, surface.cells, numbers,
                                                 flat ? index::Flat::kept : index::Flat::left_out);
        if (data->empty()) return;
        data->sides = count_sides(data->triangles);
        data->boxes = std::make_unique<BoxGroups>(make_cell_tree(data->triangles.index));
    });
    return SurfaceLocator(std::move(data));
}

const Surface& SurfaceLocator::surface() const {
    return *data_->surface;
}
const SideRules& SurfaceLocator::sides() const {
    return data_->sides.rules;
}
std::size_t SurfaceLocator::bytes() const {
    return data_->bytes();
}

Result<SurfaceLocation> SurfaceLocator::locate(const double* point) const {
    const ExactEnvironment environment;
    if (Status status = check_finite({point, 3}, 3); !status) return status.error();
    return data_->locate(point);
}

Status SurfaceLocator::locate(std::span<const double> points, std::span<SurfaceLocation> found, int threads) const {
    const ExactEnvironment environment;
    if (Status status = check_size(points, 3); !status) return status.error();
    if (found.size() != points.size() / 3)
        return Error{.code = "argument.size", .what = "as many places for results as points"};
    if (Status status = check_finite(points, 3); !status) return status.error();
    base::in_arena(threads, found.size(), [&] {
        // A map pays for itself once there are as many points as a fraction of the triangles.
        const bool map = turned() != Turned::open && 4 * found.size() > data_->triangles.size();
        if (map) data_->side_map();
        base::parallel_for_each(found.size(), 512, [&](std::size_t i) {
            found[i] = map ? data_->locate_by_map(&points[3 * i]) : data_->locate(&points[3 * i]);
        });
    });
    return Done{};
}

Result<SurfaceNearest> SurfaceLocator::nearest(const double* point, double limit) const {
    const ExactEnvironment environment;
    if (Status status = check_finite({point, 3}, 3); !status) return status.error();
    SurfaceNearest found;
    SurfaceNearest* const to = &found;
    data_->nearest({&point, 1}, base::held(limit), {&to, 1});
    set_on(*data_->surface, point, found);
    return found;
}

Status SurfaceLocator::nearest(std::span<const double> points, double limit, std::span<SurfaceNearest> found,
                               int threads) const {
    const ExactEnvironment environment;
    if (Status status = check_size(points, 3); !status) return status.error();
    if (found.size() != points.size() / 3)
        return Error{.code = "argument.size", .what = "as many places for results as points"};
    if (Status status = check_finite(points, 3); !status) return status.error();
    limit = base::held(limit);
    base::in_arena(threads, found.size(), [&] {
        if (!data_->empty()) data_->near_groups();
        const std::size_t count = found.size(), block = block_of(count, data_->triangles.size());
        base::parallel_for((count + block - 1) / block, [&](std::size_t b) {
            nearest_of_block(*data_, points, limit, b * block, std::min(count, (b + 1) * block), found);
        });
    });
    return Done{};
}

Status SurfaceLocator::nearest_on(std::span<const Mesh::Index> triangles, std::span<const double> points,
                                  std::span<SurfaceNearest> found, int threads) const {
    const ExactEnvironment environment;
    if (points.size() != 3 * triangles.size() || found.size() != triangles.size())
        return Error{.code = "argument.size", .what = "as many triangles and places for results as points"};
    if (Status status = check_cells(triangles, data_->surface->cell_count()); !status) return status.error();
    if (Status status = check_finite(points, 3); !status) return status.error();
    base::in_arena(threads, found.size(), [&] {
        base::parallel_for_each(found.size(), 256, [&](std::size_t i) {
            data_->nearest_on(triangles[i], &points[3 * i], found[i]);
            set_on(*data_->surface, &points[3 * i], found[i]);
        });
    });
    return Done{};
}

Status SurfaceLocator::values(const Field& field, bool of_cells, std::span<const double> points,
                              std::span<const SurfaceNearest> nearest, std::span<double> out, int threads) const {
    const ExactEnvironment environment;
    const Surface& s = *data_->surface;
    const auto width = static_cast<std::size_t>(field.components);
    const std::size_t rows = of_cells ? s.cell_count() : s.point_count();
    if (field.components < 1 || field.data.size() != rows * width)
        return Error{.code = "argument.size",
                     .what = "a field that does not fit the surface",
                     .expected = std::to_string(rows) + " values"};
    if (points.size() != 3 * nearest.size() || out.size() != width * nearest.size())
        return Error{.code = "argument.size", .what = "as many values as points, and their nearest points"};
    base::in_arena(threads, nearest.size(), [&] {
        base::parallel_for_each(nearest.size(), 256, [&](std::size_t i) {
            for (std::size_t c = 0; c < width; ++c)
                out[width * i + c] = value_at(s, field, of_cells, nearest[i], &points[3 * i], c);
        });
    });
    return Done{};
}

Result<std::vector<SurfaceHit>> SurfaceLocator::hits(const double* a, const double* b, bool ray) const {
    const ExactEnvironment environment;
    for (const double* const end : {a, b}) {
        if (Status status = check_finite({end, 3}, 3); !status) return status.error();
    }
    if (std::equal(a, a + 3, b))
        return Error{
            .code = "argument.size", .what = "the ends of a segment", .expected = "two points", .found = "one"};
    return data_->hits(a, b, ray);
}

}  // namespace barycert
