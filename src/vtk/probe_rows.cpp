#include "vtk/probe_arrays.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include <vtkDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>

#include "barycert/grid.hpp"

namespace barycert::in_vtk {

namespace {

/// The points of a data set, as a sampler takes them.
struct ProbePoints {
    std::span<const double> coordinates;  ///< on the axes of the mesh, `dimension` a point
    std::vector<double> own;              ///< behind `coordinates`, if these had to be made
    /// Of each point in the data set; empty: all of them. Those that are not finite, or farther off the plane of the
    /// mesh than the tolerance, have no place here.
    std::vector<vtkIdType> ids;
};

bool finite(std::span<const double> numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

// Refers to the data set where its points are doubles.
ProbePoints probe_points(const ExactIndex& index, vtkDataSet& input, double tolerance) {
    ProbePoints all;
    const vtkIdType count = input.GetNumberOfPoints();
    if (count == 0) return all;
    if (auto* const set = vtkPointSet::SafeDownCast(&input); set != nullptr && index.normal < 0) {
        if (auto* const doubles = vtkDoubleArray::FastDownCast(set->GetPoints()->GetData())) {
            const std::span<const double> given(doubles->GetPointer(0), 3 * static_cast<std::size_t>(count));
            if (finite(given)) return {.coordinates = given, .own = {}, .ids = {}};
        }
    }
    const int d = index.mesh.dimension;
    all.own.reserve(static_cast<std::size_t>(d) * static_cast<std::size_t>(count));
    all.ids.reserve(static_cast<std::size_t>(count));
    for (vtkIdType i = 0; i < count; ++i) {
        std::array<double, 3> x{}, point{};
        input.GetPoint(i, x.data());
        if (!finite(x)) continue;
        if (!index.project(x.data(), point.data()) &&
            !(std::abs(x[static_cast<std::size_t>(index.normal)] - index.plane) <= tolerance))
            continue;
        all.own.insert(all.own.end(), point.begin(), point.begin() + d);
        all.ids.push_back(i);
    }
    if (static_cast<vtkIdType>(all.ids.size()) == count) all.ids.clear();
    all.coordinates = all.own;
    return all;
}

// The points of an image as a grid that has them to the bit, x fastest; none if it is no image along the axes.
std::optional<Grid> probe_grid(const ExactIndex& index, vtkDataSet& input) {
    auto* const image = vtkImageData::SafeDownCast(&input);
    if (image == nullptr || index.normal >= 0 || !image->GetDirectionMatrix()->IsIdentity()) return std::nullopt;
    const int* const extent = image->GetExtent();
    Grid grid;
    for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        const int low = extent[2 * axis], high = extent[2 * axis + 1];
        if (high < low) return std::nullopt;
        const auto coordinate = [&](int i) {
            int ijk[3] = {extent[0], extent[2], extent[4]};
            double x[3];
            ijk[axis] = i;
            image->TransformIndexToPhysicalPoint(ijk, x);
            return x[axis];
        };
        grid.counts[k] = static_cast<std::int64_t>(high) - low + 1;
        grid.origin[k] = coordinate(low);
        grid.spacing[k] = image->GetSpacing()[axis];
        grid.last[k] = coordinate(high);
        if (!std::isfinite(grid.origin[k]) || !std::isfinite(grid.last[k]) || !(grid.spacing[k] > 0))
            return std::nullopt;
        for (int i = low; i <= high; ++i)
            if (grid.coordinate(k, i - low) != coordinate(i)) return std::nullopt;
    }
    return grid;
}

Status sample_grid(const Sampler& sampler, const Grid& grid, const SampleOptions& options, ProbeArrays& arrays) {
    const auto nx = static_cast<std::uint64_t>(grid.counts[0]), ny = static_cast<std::uint64_t>(grid.counts[1]);
    const Result<SampleCounts> done = resample(sampler, grid, options, [&](const TableView& rows) -> Status {
        const auto place = [&](std::size_t row, double* point) {
            const std::uint64_t id = rows.first_row + row;
            point[0] = grid.coordinate(0, static_cast<std::int64_t>(id % nx));
            point[1] = grid.coordinate(1, static_cast<std::int64_t>(id / nx % ny));
            point[2] = grid.coordinate(2, static_cast<std::int64_t>(id / nx / ny));
        };
        arrays.write(rows, nullptr, static_cast<vtkIdType>(rows.first_row), place);
        return Done{};
    });
    return done ? Status(Done{}) : done.error();
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
