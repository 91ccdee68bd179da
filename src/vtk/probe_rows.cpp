#include "vtk/probe_rows.hpp"

#include <algorithm>
#include <optional>

#include "barycert/grid.hpp"
#include "vtk/probe_points.hpp"

namespace barycert::in_vtk {

namespace {

Status sample_grid(const Sampler& sampler, const Grid& grid, const SampleOptions& options, ProbeArrays& arrays) {
    const auto nx = static_cast<std::uint64_t>(grid.counts[0]), ny = static_cast<std::uint64_t>(grid.counts[1]);
    const Result<SampleCounts> counts = resample(sampler, grid, options, [&](const TableView& rows) -> Status {
        const auto place = [&](std::size_t row, double* point) {
            const std::uint64_t id = rows.first_row + row;
            point[0] = grid.coordinate(0, static_cast<std::int64_t>(id % nx));
            point[1] = grid.coordinate(1, static_cast<std::int64_t>(id / nx % ny));
            point[2] = grid.coordinate(2, static_cast<std::int64_t>(id / nx / ny));
        };
        arrays.write(rows, nullptr, static_cast<vtkIdType>(rows.first_row), place);
        return Done{};
    });
    if (!counts) return counts.error();
    return Done{};
}

// In blocks, so that memory for rows does not grow with the number of points.
Status sample_points(const Sampler& sampler, const ProbePoints& points, const SampleOptions& options,
                     ProbeArrays& arrays) {
    constexpr std::size_t block = std::size_t{1} << 20;
    const auto d = static_cast<std::size_t>(sampler.locator().mesh().dimension);
    const std::size_t count = points.coordinates.size() / d;
    Table rows;
    for (std::size_t first = 0; first < count; first += block) {
        const auto some = points.coordinates.subspan(d * first, d * std::min(block, count - first));
        if (Status done = sampler.sample(some, options, rows, first); !done) return done;
        const auto place = [&](std::size_t row, double* point) { std::copy_n(some.data() + d * row, d, point); };
        const vtkIdType* const ids = points.ids.empty() ? nullptr : points.ids.data() + first;
        arrays.write(rows.view(), ids, static_cast<vtkIdType>(first), place);
    }
    return Done{};
}

}  // namespace

Status sample_data_set(const Sampler& sampler, const ExactIndex& index, vtkDataSet& input, const SampleOptions& options,
                       double tolerance, ProbeArrays& arrays) {
    if (const std::optional<Grid> grid = probe_grid(index, input)) return sample_grid(sampler, *grid, options, arrays);
    return sample_points(sampler, probe_points(index, input, tolerance), options, arrays);
}

}  // namespace barycert::in_vtk
