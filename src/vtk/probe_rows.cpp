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

bool finite(std::span<const double> numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

// The points of the data set where they are finite doubles already, on the axes of the mesh; else empty.
std::span<const double> own_coordinates(const ExactIndex& index, vtkDataSet& input) {
    auto* const set = vtkPointSet::SafeDownCast(&input);
    if (set == nullptr || index.normal >= 0 || input.GetNumberOfPoints() == 0) return {};
    auto* const doubles = vtkDoubleArray::FastDownCast(set->GetPoints()->GetData());
    if (doubles == nullptr) return {};
    const std::span<const double> all(doubles->GetPointer(0), 3 * static_cast<std::size_t>(input.GetNumberOfPoints()));
    return finite(all) ? all : std::span<const double>();
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

// In blocks, so that memory does not grow with the number of points. Points that are not finite, or farther off the
// plane of the mesh than the tolerance, are left out.
Status sample_points(const Sampler& sampler, const ExactIndex& index, vtkDataSet& input, const SampleOptions& options,
                     double tolerance, ProbeArrays& arrays) {
    constexpr vtkIdType block = vtkIdType{1} << 20;
    const auto d = static_cast<std::size_t>(index.mesh.dimension);
    const std::span<const double> all = own_coordinates(index, input);
    std::vector<double> copied;
    std::vector<vtkIdType> ids;
    Table rows;
    for (vtkIdType first = 0, count = input.GetNumberOfPoints(); first < count; first += block) {
        const vtkIdType last = first + std::min(block, count - first);
        copied.clear();
        ids.clear();
        for (vtkIdType i = first; all.empty() && i < last; ++i) {
            std::array<double, 3> x{}, point{};
            input.GetPoint(i, x.data());
            if (!finite(x)) continue;
            if (!index.project(x.data(), point.data()) &&
                !(std::abs(x[static_cast<std::size_t>(index.normal)] - index.plane) <= tolerance))
                continue;
            copied.insert(copied.end(), point.begin(), point.begin() + index.mesh.dimension);
            ids.push_back(i);
        }
        const auto from = static_cast<std::size_t>(first), size = static_cast<std::size_t>(last - first);
        const std::span<const double> some =
            all.empty() ? std::span<const double>(copied) : all.subspan(d * from, d * size);
        if (Status done = sampler.sample(some, options, rows, from); !done) return done;
        const auto place = [&](std::size_t row, double* point) { std::copy_n(some.data() + d * row, d, point); };
        arrays.write(rows.view(), all.empty() ? ids.data() : nullptr, first, place);
    }
    return Done{};
}

}  // namespace

Status sample_data_set(const Sampler& sampler, const ExactIndex& index, vtkDataSet& input, const SampleOptions& options,
                       double tolerance, ProbeArrays& arrays) {
    if (const std::optional<Grid> grid = probe_grid(index, input)) return sample_grid(sampler, *grid, options, arrays);
    return sample_points(sampler, index, input, options, tolerance, arrays);
}

}  // namespace barycert::in_vtk
