#include "vtk/exact_index.hpp"

#include <list>
#include <mutex>

#include <vtkCallbackCommand.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCellTypes.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include "barycert/environment.hpp"
#include "barycert/weights.hpp"

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
           a.ids == b.ids && a.mesh.points == b.mesh.points && a.surface.points == b.surface.points;
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
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(&data);
    command->SetClientDataDeleteCallback(forget);
    data.AddObserver(vtkCommand::DeleteEvent, command);
}

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

constexpr unsigned char ghost_mask =
    vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::REFINEDCELL | vtkDataSetAttributes::HIDDENCELL;

bool is_quadratic(int type) {
    return type == VTK_QUADRATIC_TRIANGLE || type == VTK_QUADRATIC_TETRA;
}

// Dimension of cells that may stand beside simplices and are left out there: 0 to 2; 3 tetrahedra; -1 all others.
int plain_dimension(int type, Sides sides) {
    if (type == VTK_EMPTY_CELL || type == VTK_VERTEX || type == VTK_POLY_VERTEX) return 0;
    if (type == VTK_LINE || type == VTK_POLY_LINE) return 1;
    if (is_quadratic(type) && sides != Sides::none) return type == VTK_QUADRATIC_TRIANGLE ? 2 : 3;
    if (sides == Sides::any &&
        (type == VTK_TRIANGLE_STRIP || type == VTK_POLYGON || type == VTK_PIXEL || type == VTK_QUAD))
        return 2;
    return type == VTK_TRIANGLE ? 2 : type == VTK_TETRA ? 3 : -1;
}

// A data set of cells, whichever of the two it is.
struct Cells {
    explicit Cells(vtkDataSet& all, Sides of = Sides::none) : data(all), sides(of) {
        if (surface != nullptr && surface->NeedToBuildCells()) surface->BuildCells();
    }
    vtkPoints* points() const { return grid != nullptr ? grid->GetPoints() : surface->GetPoints(); }
    /// Calls `take(cell, size, nodes)` for each cell of that dimension that is no ghost.
    template <class Take>
    void each(int dimension, Take&& take) const {
        vtkUnsignedCharArray* const ghosts = data.GetCellGhostArray();
        for (vtkIdType i = 0; i < count; ++i) {
            if (plain_dimension(data.GetCellType(i), sides) != dimension) continue;
            if (ghosts != nullptr && (ghosts->GetValue(i) & ghost_mask) != 0) continue;
            vtkIdType size = 0;
            const vtkIdType* nodes = nullptr;
            if (grid != nullptr)
                grid->GetCellPoints(i, size, nodes);
            else
                surface->GetCellPoints(i, size, nodes);
            take(i, size, nodes);
        }
    }

    vtkDataSet& data;
    Sides sides;
    vtkUnstructuredGrid* grid = vtkUnstructuredGrid::SafeDownCast(&data);
    vtkPolyData* surface = vtkPolyData::SafeDownCast(&data);
    vtkIdType count = data.GetNumberOfCells();
};

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
    if (!in_space()) return IndexedPiece::build();
    Result<SurfaceLocator> made = SurfaceLocator::build(surface);
    if (!made) return made.error();
    on_surface.emplace(std::move(*made));
    return Done{};
}

void ExactIndex::place(const double* point, double* x) const {
    if (!in_space()) return IndexedPiece::place(point, x);
    std::copy_n(point, 3, x);
}

Mesh::Index ExactIndex::owner(const double* x) const {
    if (!in_space()) return IndexedPiece::owner(x);
    const Result<SurfaceNearest> near = on_surface->nearest(x, 0);  // without a winding number
    return near && near->on ? near->cell : -1;
}

pieces::Closest ExactIndex::closest(const double* x, double limit) const {
    if (!in_space()) return IndexedPiece::closest(x, limit);
    pieces::Closest found;
    const Result<SurfaceNearest> near = on_surface->nearest(x, limit);
    if (!near || near->cell < 0) return found;
    found.cell = near->cell;
    found.distance = near->distance;
    found.point = near->point;
    found.inside = near->on;
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

std::vector<double> doubles_of(vtkDataArray& array) {
    std::vector<double> all(static_cast<std::size_t>(array.GetNumberOfValues()));
    if (all.empty()) return all;
    vtkNew<vtkDoubleArray> doubles;
    doubles->SetNumberOfComponents(array.GetNumberOfComponents());
    doubles->SetArray(all.data(), array.GetNumberOfValues(), 1);
    doubles->InsertTuples(0, array.GetNumberOfTuples(), 0, &array);
    return all;
}

std::string cell_dimension(vtkDataSet& data, int& dimension, Sides sides) {
    dimension = -1;
    const Cells cells(data);
    if (cells.grid == nullptr && cells.surface == nullptr)
        return std::string("a ") + data.GetClassName() + " has no simplices";
    if (cells.surface != nullptr && cells.surface->NeedToBuildCells()) return "VTK cannot build its cells";
    constexpr vtkIdType most = std::numeric_limits<Mesh::Index>::max();
    if (cells.count > most || data.GetNumberOfPoints() > most) return "it has more than 2147483647 points or cells";
    if (cells.points() == nullptr) return {};
    for (vtkIdType i = 0; i < cells.count; ++i) {
        const int type = data.GetCellType(i), its = plain_dimension(type, sides);
        if (its < 0) return "cell " + std::to_string(i) + " is a " + vtkCellTypes::GetClassNameFromTypeId(type);
        dimension = std::max(dimension, its);
    }
    return {};
}

std::string read_simplices(vtkDataSet& data, ExactIndex& index, const pieces::Shape& shape, Sides sides) {
    int dimension = -1;
    if (std::string reason = cell_dimension(data, dimension, sides); !reason.empty()) return reason;
    if (dimension < 0) return {};
    if (shape.dimension > 0) dimension = shape.dimension;
    if (dimension < 2) return "it has neither tetrahedra nor triangles";

    const Cells cells(data, sides);
    Mesh& mesh = index.mesh;
    mesh.dimension = dimension;
    const vtkIdType corners = dimension + 1, nodes_of_quadratic = corners * (corners + 1) / 2;
    mesh.cells.reserve(static_cast<std::size_t>(corners * cells.count));
    std::vector<vtkIdType> ids;
    ids.reserve(static_cast<std::size_t>(cells.count));
    std::string reason;
    cells.each(dimension, [&](vtkIdType cell, vtkIdType size, const vtkIdType* nodes) {
        const bool quadratic = is_quadratic(data.GetCellType(cell));
        if (size != (quadratic ? nodes_of_quadratic : corners) && reason.empty())
            reason =
                "cell " + std::to_string(cell) + " has " + std::to_string(size) + (quadratic ? " nodes" : " vertices");
        if (!reason.empty()) return;
        for (vtkIdType k = 0; k < size; ++k)
            (k < corners ? mesh.cells : mesh.mid_nodes).push_back(static_cast<Mesh::Index>(nodes[k]));
        ids.push_back(cell);
    });
    if (!reason.empty() || ids.empty()) return reason;
    if (!mesh.mid_nodes.empty()) {
        const auto mid_nodes = static_cast<std::size_t>(nodes_of_quadratic - corners);
        if (mesh.mid_nodes.size() != mid_nodes * ids.size()) return "it has linear cells beside quadratic ones";
        mesh.mid_edge_order = MidEdgeOrder::vtk;
    }
    if (static_cast<vtkIdType>(ids.size()) != cells.count) index.ids = std::move(ids);
    mesh.points = doubles_of(*cells.points()->GetData());
    if (dimension == 3) return {};
    const auto [low, high] = std::minmax_element(mesh.cells.begin(), mesh.cells.end());
    if (*low < 0 || *high >= data.GetNumberOfPoints()) return "a vertex of a triangle is no point";
    if (index.flatten(shape.normal)) return {};
    if (shape.dimension != 0) return "its triangles do not lie in one plane across an axis";
    if (!mesh.mid_nodes.empty())
        index.surface.notes.push_back(
            {Note::Kind::converted, "triangles of second order: they are taken by their corners", {}, true});
    index.surface.points = std::exchange(mesh.points, {});
    index.surface.cells = mesh.cells;
    mesh.mid_nodes.clear();
    return {};
}

std::string read_polygons(vtkDataSet& data, ExactIndex& index, Plc& plc) {
    const Cells cells(data, Sides::any);
    std::string reason;
    bool triangles = true;
    const auto add = [&](vtkIdType cell, std::vector<Mesh::Index> ring) {
        triangles = triangles && ring.size() == 3;
        plc.facets.emplace_back().polygons.push_back(std::move(ring));
        index.ids.push_back(cell);
    };
    cells.each(2, [&](vtkIdType cell, vtkIdType size, const vtkIdType* nodes) {
        const int type = data.GetCellType(cell);
        const bool few = size < 3 || (type == VTK_TRIANGLE && size > 3);
        const auto is_point = [&](vtkIdType node) { return node >= 0 && node < data.GetNumberOfPoints(); };
        if (few || !std::all_of(nodes, nodes + size, is_point))
            reason = "cell " + std::to_string(cell) + " has " +
                     (few ? std::to_string(size) + " vertices" : "a vertex that is no point");
        if (!reason.empty()) return;
        std::vector<Mesh::Index> ring(nodes, nodes + (is_quadratic(type) ? 3 : size));
        if (type == VTK_PIXEL) std::swap(ring[2], ring.back());
        if (type != VTK_TRIANGLE_STRIP) return add(cell, std::move(ring));
        // Every other triangle is turned.
        for (std::size_t i = 0; i + 2 < ring.size(); ++i)
            add(cell, {ring[i + i % 2], ring[i + 1 - i % 2], ring[i + 2]});
    });
    if (!reason.empty() || plc.facets.empty()) return reason;
    plc.points = doubles_of(*cells.points()->GetData());
    if (!triangles) return pieces::all_finite(plc.points) ? "" : "it has polygons, and a coordinate that is not finite";
    index.surface.points = std::move(plc.points);
    for (const PlcFacet& facet : plc.facets)
        index.surface.cells.insert(index.surface.cells.end(), facet.polygons[0].begin(), facet.polygons[0].end());
    plc = {};
    return {};
}

pieces::Box box_of_triangles(vtkDataSet& data) {
    pieces::Box all = pieces::empty_box;
    const Cells cells(data);
    vtkPoints* const points = cells.points();
    if (points == nullptr) return all;
    cells.each(2, [&](vtkIdType, vtkIdType size, const vtkIdType* nodes) {
        for (vtkIdType k = 0; k < size; ++k) {
            // A node that is not there makes no bounds: who reads the cells tells of it.
            if (nodes[k] < 0 || nodes[k] >= points->GetNumberOfPoints()) continue;
            std::array<double, 3> x{};
            points->GetPoint(nodes[k], x.data());
            all.add({x, x});
        }
    });
    return all;
}

}  // namespace barycert::in_vtk
