#include "vtk/exact_index.hpp"

#include <list>
#include <mutex>

#include <vtkCallbackCommand.h>
#include <vtkCell.h>
#include <vtkDataSet.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include "barycert/environment.hpp"
#include "barycert/sampler.hpp"

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
    return a.shape == b.shape && a.normal == b.normal && a.plane == b.plane && a.reason == b.reason &&
           a.mesh.cells == b.mesh.cells && a.mesh.mid_nodes == b.mesh.mid_nodes && a.mesh.shapes == b.mesh.shapes &&
           a.mesh.cell_numbers == b.mesh.cell_numbers && a.mesh.points == b.mesh.points &&
           a.surface.points == b.surface.points && a.surface.facets == b.surface.facets &&
           a.by_corners == b.by_corners && a.uncut == b.uncut && a.cells_are_cut == b.cells_are_cut;
}

void remember(vtkDataSet& data, const pieces::Shape& shape, vtkMTimeType time,
              std::shared_ptr<const ExactIndex> index) {
    const std::lock_guard lock(cache().access);
    std::list<Entry>& entries = cache().entries;
    const bool observed = std::ranges::find(entries, &data, &Entry::data) != entries.end();
    entries.remove_if([&](const Entry& entry) { return entry.data == &data && entry.shape == shape; });
    entries.push_back({&data, shape, time, std::move(index)});
    if (observed) return;
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(&data);
    command->SetClientDataDeleteCallback(forget);
    data.AddObserver(vtkCommand::DeleteEvent, command);
}

}  // namespace

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
    made->shape = shape;
    made->reason = read_cells(data, *made);
    std::shared_ptr<const ExactIndex> index = made;
    if (made->reason.empty() && !made->mesh.cells.empty()) {
        // One that was made for the same cells: of a shallow copy, or before point data changed.
        if (auto before = find([&](const Entry& e) { return same_cells(*e.index, *made); })) {
            index = std::move(before);
        } else if (const Status built = made->build(); !built) {
            made->reason = built.error().message();
        }
    }
    // Reading may have built the cells of a vtkPolyData.
    remember(data, shape, data.GetMTime(), index);
    return index;
}

Status ExactIndex::build() {
    if (!in_space()) {
        Status built = IndexedPiece::build(shape);
        if (built) std::ranges::move(notes_of_maps(*locator, shape.interpolation, {}), std::back_inserter(notes));
        return built;
    }
    // Without those of zero area, of which VTK's weights and parametric coordinates are of no use.
    Result<SurfaceLocator> made = SurfaceLocator::build(surface, {}, false);
    if (!made) return made.error();
    on_surface.emplace(std::move(*made));
    return Done{};
}

void ExactIndex::place(const double* point, double* x) const {
    if (!in_space()) return IndexedPiece::place(point, x);
    std::copy_n(point, 3, x);
}

Mesh::Index ExactIndex::owner(const double* x) const {
    if (!on_surface) return IndexedPiece::owner(x);                 // of a surface without triangles: none
    const Result<SurfaceNearest> near = on_surface->nearest(x, 0);  // without a winding number
    return near && near->on ? near->cell : -1;
}

pieces::Closest ExactIndex::closest(const double* x, double limit) const {
    if (!on_surface) return IndexedPiece::closest(x, limit);
    const Result<SurfaceNearest> near = on_surface->nearest(x, limit);
    if (!near || near->cell < 0) return {};
    pieces::Closest found{.cell = near->cell, .distance = near->distance, .inside = near->on, .point = near->point};
    const Mesh::Index* const corners = mesh.cells.data() + std::size_t{3} * static_cast<std::size_t>(near->cell);
    for (std::size_t k = 0; k < 9; ++k)
        if (near->nodes[k / 3] == corners[k % 3]) found.weights[k % 3] = near->weights[k / 3];
    return found;
}

std::array<double, 12> ExactIndex::vertices(Mesh::Index cell, vtkCell* fetched) const {
    std::array<double, 12> all{};
    double* out = all.data();
    const std::size_t n = mesh.corners(), d = in_space() ? 3 : n - 1;
    const double* const nodes = in_space() ? surface.points.data() : mesh.points.data();
    for (std::size_t k = 0; k < n; ++k) {
        std::array<double, 3> x{}, on_axes{};
        if (fetched != nullptr) fetched->Points->GetPoint(static_cast<vtkIdType>(k), x.data());
        if (fetched != nullptr) project(x.data(), on_axes.data());
        const auto at = static_cast<std::size_t>(mesh.cells[n * static_cast<std::size_t>(cell) + k]);
        out = std::copy_n(fetched != nullptr ? on_axes.data() : nodes + d * at, d, out);
    }
    return all;
}

std::array<double, 4> ExactIndex::weights(Mesh::Index cell, const double* point, vtkCell* fetched) const {
    const Result<Weights> its = barycentric_weights(simplex(), vertices(cell, fetched).data(), point);
    return its ? its->weights : std::array<double, 4>{};
}

void ExactIndex::weights_of_nodes(Mesh::Index cell, const double* x, bool inside, vtkIdList& nodes, double* out) const {
    std::array<double, 3> point{};
    project(x, point.data());
    NodeWeights its;
    if (in_space() || straight()) {
        const std::array<double, 4> all =
            inside ? weights(cell, point.data()) : closest(x, std::numeric_limits<double>::infinity()).weights;
        const Mesh::Index* const corners = mesh.cells.data() + mesh.corners() * static_cast<std::size_t>(cell);
        its.nodes.assign(corners, corners + mesh.corners());
        its.weights.assign(all.begin(), all.end());
    } else {
        const Mesh::Index own = inside ? cell : -1;
        const TableView row{.points = {point.data(), static_cast<std::size_t>(mesh.dimension)}, .cells = {&own, 1}};
        if (Result<NodeWeights> all = node_weights(*locator, row, {.kind = Outside::nearest})) its = std::move(*all);
    }
    // Sets NaN for a map that cannot be inverted there.
    const double others = its.nodes.empty() ? std::numeric_limits<double>::quiet_NaN() : 0.0;
    std::fill_n(out, nodes.GetNumberOfIds(), others);
    for (std::size_t i = 0; i < its.nodes.size(); ++i)
        if (const vtkIdType at = nodes.IsId(its.nodes[i]); at >= 0) out[at] = its.weights[i];
}

}  // namespace barycert::in_vtk
