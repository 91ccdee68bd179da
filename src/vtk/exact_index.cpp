#include "vtk/exact_index.hpp"

#include <cmath>
#include <list>
#include <mutex>
#include <utility>

#include <vtkCallbackCommand.h>
#include <vtkDataSet.h>

#include "barycert/environment.hpp"
#include "barycert/grid.hpp"
#include "vtk/global_ids.hpp"
#include "vtk/simplices.hpp"

namespace barycert::in_vtk {

namespace {

struct Entry {
    const vtkObjectBase* data;
    SimplexShape shape;
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

std::shared_ptr<const ExactIndex> cached(const vtkDataSet& data, const SimplexShape& shape, vtkMTimeType time) {
    const std::lock_guard lock(cache().access);
    // Times of modification never come twice: an address that is used again has another.
    for (const Entry& entry : cache().entries)
        if (entry.data == &data && entry.time == time && entry.shape == shape) return entry.index;
    return nullptr;
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

void remember(vtkDataSet& data, const SimplexShape& shape, vtkMTimeType time, std::shared_ptr<const ExactIndex> index) {
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

// The edge of a square or cube that would hold about 8 cells if they were spread over the box of the mesh.
double some_cells(const Mesh& mesh) {
    const Bounds3 box = bounds_of_cells(mesh);
    const auto d = static_cast<std::size_t>(mesh.dimension);
    double size = 8 / static_cast<double>(mesh.cell_count());
    for (std::size_t a = 0; a < d; ++a) size *= box.high[a] - box.low[a];
    return std::pow(size, 1.0 / mesh.dimension);
}

// One that was made for the same cells: of a shallow copy, or before point data changed.
std::shared_ptr<const ExactIndex> made_before(const ExactIndex& index) {
    const std::lock_guard lock(cache().access);
    for (const Entry& entry : cache().entries)
        if (entry.index->locator && same_cells(*entry.index, index)) return entry.index;
    return nullptr;
}

}  // namespace

void forget_index(const vtkDataSet& data) {
    const std::lock_guard lock(cache().access);
    // The entries stay, for their data set is observed once.
    for (Entry& entry : cache().entries)
        if (entry.data == &data) entry.time = 0;
}

std::shared_ptr<const ExactIndex> exact_index(vtkDataSet& data, const SimplexShape& shape) {
    const vtkMTimeType time = data.GetMTime();
    const ExactEnvironment environment;
    if (std::shared_ptr<const ExactIndex> found = cached(data, shape, time)) return found;
    const std::lock_guard lock(cache().making);
    if (std::shared_ptr<const ExactIndex> found = cached(data, shape, time)) return found;

    auto made = std::make_shared<ExactIndex>();
    made->reason = read_simplices(data, *made, shape);
    if (shape.by_global_ids && made->reason.empty()) order_by_global_ids(data, *made);
    std::shared_ptr<const ExactIndex> index = made;
    if (made->reason.empty() && !made->mesh.cells.empty()) {
        if (std::shared_ptr<const ExactIndex> before = made_before(*made)) {
            index = std::move(before);
        } else if (Result<Locator> locator = Locator::build(made->mesh)) {
            made->locator = std::move(*locator);
            made->near = some_cells(made->mesh);
        } else {
            made->reason = locator.error().message();
        }
    }
    // Reading may have built the cells of a vtkPolyData.
    remember(data, shape, data.GetMTime(), index);
    return index;
}

}  // namespace barycert::in_vtk
