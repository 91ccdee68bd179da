#include "vtk/global_ids.hpp"

#include <algorithm>
#include <numeric>
#include <type_traits>
#include <utility>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkSetGet.h>
#include <vtkSmartPointer.h>

namespace barycert::in_vtk {

namespace {

vtkDataArray* ids_of(vtkDataSet& data) {
    return data.GetCellData()->GetGlobalIds();
}

bool is_integer(const vtkDataArray& array) {
    const int type = array.GetDataType();
    return type != VTK_DOUBLE && type != VTK_FLOAT && type != VTK_BIT;
}

// All of them, of cells of the data set; `fits` is false if one exceeds 64 bits with a sign.
std::vector<std::int64_t> all_ids(vtkDataArray& array, bool& fits) {
    // Its values stand one after the other, whatever the layout of the array.
    auto plain = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(array.GetDataType()));
    vtkDataArray* values = &array;
    if (!array.HasStandardMemoryLayout()) {
        plain->DeepCopy(&array);
        values = plain;
    }
    std::vector<std::int64_t> all(static_cast<std::size_t>(array.GetNumberOfTuples()));
    fits = true;
    const auto take = [&](const auto* from) {
        for (std::size_t i = 0; i < all.size(); ++i) {
            if constexpr (std::is_integral_v<std::remove_cvref_t<decltype(*from)>>)
                fits = fits && (from[i] < 0 || static_cast<std::uint64_t>(from[i]) <= std::uint64_t{INT64_MAX});
            all[i] = static_cast<std::int64_t>(+from[i]);
        }
    };
    switch (values->GetDataType()) { vtkTemplateMacro(take(static_cast<const VTK_TT*>(values->GetVoidPointer(0)))); }
    return all;
}

}  // namespace

bool has_global_ids(vtkDataSet& data) {
    return ids_of(data) != nullptr;
}

std::string fault_of_global_ids(vtkDataSet& data) {
    vtkDataArray& array = *ids_of(data);
    if (!is_integer(array)) return std::string("the global ids of its cells are a ") + array.GetClassName();
    if (array.GetNumberOfComponents() != 1) return "the global ids of its cells have more than one component";
    if (array.GetNumberOfTuples() != data.GetNumberOfCells())
        return "it has " + std::to_string(data.GetNumberOfCells()) + " cells and " +
               std::to_string(array.GetNumberOfTuples()) + " global ids of cells";
    bool fits = true;
    all_ids(array, fits);
    return fits ? std::string() : "a global id of a cell exceeds 9223372036854775807";
}

std::vector<std::int64_t> global_ids(vtkDataSet& data, const ExactIndex& index) {
    bool fits = true;
    std::vector<std::int64_t> of_data = all_ids(*ids_of(data), fits);
    if (index.ids.empty()) return of_data;
    std::vector<std::int64_t> of_mesh(index.ids.size());
    for (std::size_t i = 0; i < of_mesh.size(); ++i) of_mesh[i] = of_data[static_cast<std::size_t>(index.ids[i])];
    return of_mesh;
}

void order_by_global_ids(vtkDataSet& data, ExactIndex& index) {
    const std::size_t count = index.mesh.cell_count(), corners = index.mesh.corners();
    if (count == 0) return;
    const std::vector<std::int64_t> numbers = global_ids(data, index);
    if (std::is_sorted(numbers.begin(), numbers.end())) return;
    std::vector<Mesh::Index> order(count);
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](Mesh::Index a, Mesh::Index b) {
        return numbers[static_cast<std::size_t>(a)] < numbers[static_cast<std::size_t>(b)];
    });
    std::vector<Mesh::Index> cells;
    cells.reserve(index.mesh.cells.size());
    std::vector<vtkIdType> ids;
    ids.reserve(count);
    for (const Mesh::Index cell : order) {
        const auto from = index.mesh.cells.begin() + static_cast<std::ptrdiff_t>(corners) * cell;
        cells.insert(cells.end(), from, from + static_cast<std::ptrdiff_t>(corners));
        ids.push_back(index.id(cell));
    }
    index.mesh.cells = std::move(cells);
    index.ids = std::move(ids);
}

}  // namespace barycert::in_vtk
