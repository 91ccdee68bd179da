#include "vtk/exact_index.hpp"

#include <algorithm>
#include <list>
#include <mutex>
#include <utility>

#include <vtkCallbackCommand.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkNew.h>
#include <vtkTypeInt64Array.h>

#include "barycert/environment.hpp"

namespace barycert::in_vtk {

namespace {

struct Entry {
    const vtkObjectBase* data;
    pieces::Shape shape;
    vtkMTimeType time;
    std::shared_ptr<const ExactIndex> index;
};

struct Cache {
    std::mutex making;  ///< held while an index is made, so that it is made once
    std::mutex access;  ///< held while entries are read or changed
    std::list<Entry> entries;
};

// Data sets may die after all static objects have: hence never destroyed.
Cache& cache() {
    static Cache& the = *new Cache;
    return the;
}

// The index of the first entry that fits.
template <class Fits>
std::shared_ptr<const ExactIndex> find(Fits&& fits) {
    const std::lock_guard lock(cache().access);
    const auto entry = std::find_if(cache().entries.begin(), cache().entries.end(), fits);
    return entry != cache().entries.end() ? entry->index : nullptr;
}

// Called when an observer dies: with its data set, also where VTK's garbage collector deletes that without an event.
void forget(void* data) {
    const std::lock_guard lock(cache().access);
    cache().entries.remove_if([data](const Entry& entry) { return entry.data == data; });
}

bool same_cells(const ExactIndex& a, const ExactIndex& b) {
    return a.normal == b.normal && a.plane == b.plane && a.reason == b.reason && a.mesh.cells == b.mesh.cells &&
           a.ids == b.ids && a.mesh.points == b.mesh.points;
}

void remember(vtkDataSet& data, const pieces::Shape& shape, vtkMTimeType time,
              std::shared_ptr<const ExactIndex> index) {
    const std::lock_guard lock(cache().access);
    bool observed = false;
    for (Entry& entry : cache().entries) {
        if (entry.data != &data) continue;
        observed = true;
        if (!(entry.shape == shape)) continue;
        entry.time = time;
        entry.index = std::move(index);
        return;
    }
    cache().entries.push_back({&data, shape, time, std::move(index)});
    if (observed) return;
    vtkCallbackCommand* const command = vtkCallbackCommand::New();
    command->SetClientData(&data);
    command->SetClientDataDeleteCallback(forget);
    data.AddObserver(vtkCommand::DeleteEvent, command);
    command->Delete();
}

// Of cells of the data set.
std::vector<std::int64_t> all_global_ids(vtkDataSet& data) {
    vtkNew<vtkTypeInt64Array> ids;
    ids->DeepCopy(data.GetCellData()->GetGlobalIds());
    return {ids->GetPointer(0), ids->GetPointer(ids->GetNumberOfValues())};
}

void order_by_global_ids(vtkDataSet& data, ExactIndex& index) {
    const std::vector<Mesh::Index> order = index.sort_cells(global_ids(data, index));
    std::vector<vtkIdType> ids;
    ids.reserve(order.size());
    for (const Mesh::Index cell : order) ids.push_back(index.id(cell));
    if (!ids.empty()) index.ids = std::move(ids);
}

}  // namespace

std::string fault_of_global_ids(vtkDataSet& data) {
    vtkDataArray& array = *data.GetCellData()->GetGlobalIds();
    const int type = array.GetDataType();
    if (type == VTK_DOUBLE || type == VTK_FLOAT || type == VTK_BIT)
        return std::string("the global ids of its cells are a ") + array.GetClassName();
    if (array.GetNumberOfComponents() != 1) return "the global ids of its cells have more than one component";
    if (array.GetNumberOfTuples() != data.GetNumberOfCells())
        return "it has " + std::to_string(data.GetNumberOfCells()) + " cells and " +
               std::to_string(array.GetNumberOfTuples()) + " global ids of cells";
    const std::vector<std::int64_t> ids = all_global_ids(data);
    const bool is_unsigned = array.GetDataTypeMin() == 0;
    const bool fits = !is_unsigned || std::none_of(ids.begin(), ids.end(), [](std::int64_t id) { return id < 0; });
    return fits ? std::string() : "a global id of a cell exceeds 9223372036854775807";
}

std::vector<std::int64_t> global_ids(vtkDataSet& data, const ExactIndex& index) {
    std::vector<std::int64_t> of_data = all_global_ids(data);
    if (index.ids.empty()) return of_data;
    std::vector<std::int64_t> of_mesh(index.ids.size());
    for (std::size_t i = 0; i < of_mesh.size(); ++i) of_mesh[i] = of_data[static_cast<std::size_t>(index.ids[i])];
    return of_mesh;
}

void forget_index(const vtkDataSet& data) {
    const std::lock_guard lock(cache().access);
    // The entries stay, for their data set is observed once.
    for (Entry& entry : cache().entries)
        if (entry.data == &data) entry.time = 0;
}

std::shared_ptr<const ExactIndex> exact_index(vtkDataSet& data, const pieces::Shape& shape) {
    // Times of modification never come twice: an address that is used again has another.
    const auto same = [&data, &shape, time = data.GetMTime()](const Entry& entry) {
        return entry.data == &data && entry.time == time && entry.shape == shape;
    };
    const ExactEnvironment environment;
    if (std::shared_ptr<const ExactIndex> found = find(same)) return found;
    const std::lock_guard lock(cache().making);
    if (std::shared_ptr<const ExactIndex> found = find(same)) return found;

    auto made = std::make_shared<ExactIndex>();
    made->reason = read_simplices(data, *made, shape);
    if (shape.by_numbers && made->reason.empty()) order_by_global_ids(data, *made);
    std::shared_ptr<const ExactIndex> index = made;
    if (made->reason.empty() && !made->mesh.cells.empty()) {
        // One that was made for the same cells: of a shallow copy, or before point data changed.
        if (auto before = find([&](const Entry& e) { return e.index->locator && same_cells(*e.index, *made); })) {
            index = std::move(before);
        } else if (const Status built = made->build(); !built) {
            made->reason = built.error().message();
        }
    }
    // Reading may have built the cells of a vtkPolyData.
    remember(data, shape, data.GetMTime(), index);
    return index;
}

}  // namespace barycert::in_vtk
