#include "vtk/probe_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <vtkDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>

namespace barycert::in_vtk {

namespace {

bool finite(const double* x) {
    return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

}  // namespace

ProbePoints probe_points(const ExactIndex& index, vtkDataSet& input, double tolerance) {
    ProbePoints all;
    const vtkIdType count = input.GetNumberOfPoints();
    if (count == 0) return all;
    if (auto* const set = vtkPointSet::SafeDownCast(&input); set != nullptr && index.normal < 0) {
        if (auto* const doubles = vtkDoubleArray::FastDownCast(set->GetPoints()->GetData())) {
            const std::span<const double> given(doubles->GetPointer(0), 3 * static_cast<std::size_t>(count));
            if (std::all_of(given.begin(), given.end(), [](double x) { return std::isfinite(x); })) {
                all.coordinates = given;
                return all;
            }
        }
    }
    const int d = index.mesh.dimension;
    all.own.reserve(static_cast<std::size_t>(d) * static_cast<std::size_t>(count));
    all.ids.reserve(static_cast<std::size_t>(count));
    for (vtkIdType i = 0; i < count; ++i) {
        std::array<double, 3> x{}, point{};
        input.GetPoint(i, x.data());
        if (!finite(x.data())) continue;
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

}  // namespace barycert::in_vtk
