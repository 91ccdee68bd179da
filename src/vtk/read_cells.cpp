// From VTK's cells to a mesh of simplices, or a surface.
#include <vtkCellData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include "vtk/exact_index.hpp"

namespace barycert::in_vtk {
namespace {

constexpr unsigned char ghost_mask =
    vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::REFINEDCELL | vtkDataSetAttributes::HIDDENCELL;

// An id that is none of at most 2147483647 points is no node.
Mesh::Index node_of(vtkIdType id) {
    return id >= 0 && id < std::numeric_limits<Mesh::Index>::max() ? static_cast<Mesh::Index>(id) : -1;
}

// The cells of any data set.
class Cells {
public:
    explicit Cells(vtkDataSet& all) : data_(all) {
        if (surface_ != nullptr && surface_->NeedToBuildCells()) surface_->BuildCells();
    }
    bool built() const { return surface_ == nullptr || !surface_->NeedToBuildCells(); }
    std::uint8_t number(vtkIdType cell) const { return static_cast<std::uint8_t>(data_.GetCellType(cell)); }
    const mesh::CellType& type(vtkIdType cell) const { return mesh::cell_types()[number(cell)]; }

    bool is_ghost(vtkIdType cell) const { return ghosts_ != nullptr && (ghosts_->GetValue(cell) & ghost_mask) != 0; }

    /// Returns the cells of that dimension that are no ghosts.
    std::vector<Mesh::Index> kept(int dimension) const {
        std::vector<Mesh::Index> all;
        for (vtkIdType i = 0; i < data_.GetNumberOfCells(); ++i)
            if (!is_ghost(i) && type(i).dimension() == dimension) all.push_back(static_cast<Mesh::Index>(i));
        return all;
    }
    void nodes(vtkIdType cell, std::vector<Mesh::Index>& out) {
        vtkIdType size = 0;
        const vtkIdType* all = nullptr;
        if (grid_ != nullptr) {
            grid_->GetCellPoints(cell, size, all);
        } else {
            data_.GetCellPoints(cell, some_);
            size = some_->GetNumberOfIds();
            all = some_->GetPointer(0);
        }
        out.resize(static_cast<std::size_t>(size));
        std::transform(all, all + size, out.begin(), node_of);
    }
    /// Appends the faces of a polyhedron, the last of the shapes, as Mesh::Shapes has them.
    void faces(vtkIdType cell, Mesh::Shapes& shapes) const {
        vtkIdType count = 0;
        const vtkIdType* stream = nullptr;
        if (grid_ != nullptr) grid_->GetFaceStream(cell, count, stream);
        shapes.face_ends.resize(shapes.count() - 1, static_cast<std::int64_t>(shapes.ring_ends.size()));
        for (; count > 0; --count) {
            const vtkIdType* const ring = stream + 1;
            stream = ring + *stream;
            std::transform(ring, stream, std::back_inserter(shapes.rings), node_of);
            shapes.ring_ends.push_back(static_cast<std::int64_t>(shapes.rings.size()));
        }
        shapes.face_ends.push_back(static_cast<std::int64_t>(shapes.ring_ends.size()));
    }

private:
    vtkDataSet& data_;
    vtkUnstructuredGrid* grid_ = vtkUnstructuredGrid::SafeDownCast(&data_);
    vtkPolyData* surface_ = vtkPolyData::SafeDownCast(&data_);
    vtkUnsignedCharArray* ghosts_ = data_.GetCellGhostArray();
    vtkNew<vtkIdList> some_;
};

std::vector<double> points_of(vtkDataSet& data) {
    std::vector<double> points(3 * static_cast<std::size_t>(data.GetNumberOfPoints()));
    for (std::size_t i = 0; i < points.size(); i += 3) data.GetPoint(static_cast<vtkIdType>(i / 3), &points[i]);
    return points;
}

std::vector<std::int64_t> integers_of(vtkDataArray& array) {
    vtkNew<vtkTypeInt64Array> ids;
    ids->DeepCopy(&array);
    return {ids->GetPointer(0), ids->GetPointer(ids->GetNumberOfValues())};
}

std::string name_of(Mesh::Index cell) {
    return "cell " + std::to_string(cell);
}

void note(ExactIndex& index, std::size_t count, const char* what) {
    if (count != 0) index.notes.push_back({Note::Kind::converted, std::to_string(count) + what, {}, true});
}

// Why the nodes of a cell are not those of its type, or none of so many points (0: they may be any); empty if they are.
std::string fault_of_nodes(const mesh::CellType& type, const std::vector<Mesh::Index>& nodes, std::size_t points) {
    const std::size_t least = std::max<std::size_t>(type.corners, 3);
    const bool few = nodes.size() < least || mesh::corners_of(type, nodes).size() < least;
    if (type.nodes != 0 ? nodes.size() != type.nodes : few) return " has " + std::to_string(nodes.size()) + " nodes";
    const auto is_point = [&](Mesh::Index node) { return points == 0 || static_cast<std::size_t>(node) < points; };
    return std::all_of(nodes.begin(), nodes.end(), is_point) ? "" : " has a vertex that is no point";
}

// Polygons that lie in no plane across an axis.
std::string make_surface(Cells& cells, const std::vector<Mesh::Index>& kept, ExactIndex& index) {
    Surface& surface = index.surface;
    surface.points = std::exchange(index.mesh.points, {});
    if (index.shape.mixed || !index.mesh.mid_nodes.empty()) {
        const bool is_finite = pieces::all_finite(surface.points);
        std::vector<Mesh::Index> nodes;
        for (const Mesh::Index cell : kept) {
            cells.nodes(cell, nodes);
            const bool cut = cells.number(cell) != vtk_triangle_strip && nodes.size() > 3;
            if (cut && !is_finite) return "it has polygons, and a coordinate that is not finite";
            index.uncut += surface::add_triangles(surface.points, cells.type(cell), nodes, surface.cells);
            index.by_corners += mesh::corners_of(cells.type(cell), nodes).size() < nodes.size() ? 1 : 0;
            surface.facets.resize(surface.cell_count(), cell);
        }
        note(index, index.by_corners, " polygons of a higher order: they are taken by their corners");
        note(index, index.uncut,
             " polygons that are no simple ones, and cannot be cut into triangles: they are left out");
        index.cells_are_cut = true;
    } else {
        surface.cells = index.mesh.cells;
        surface.facets = index.mesh.cell_numbers;
    }
    index.mesh = {};
    index.mesh.dimension = 2;
    index.mesh.cells = surface.cells;
    return {};
}

}  // namespace

std::string fault_of_global_ids(vtkDataSetAttributes& attributes, vtkIdType count, const std::string& of) {
    vtkDataArray& array = *attributes.GetGlobalIds();
    const int type = array.GetDataType();
    if (type == VTK_DOUBLE || type == VTK_FLOAT || type == VTK_BIT)
        return "the global ids of its " + of + "s are a " + array.GetClassName();
    if (array.GetNumberOfComponents() != 1) return "the global ids of its " + of + "s have more than one component";
    if (array.GetNumberOfTuples() != count)
        return "it has " + std::to_string(count) + " " + of + "s and " + std::to_string(array.GetNumberOfTuples()) +
               " global ids of " + of + "s";
    const std::vector<std::int64_t> ids = integers_of(array);
    const bool is_unsigned = array.GetDataTypeMin() == 0;
    const bool fits = !is_unsigned || std::none_of(ids.begin(), ids.end(), [](std::int64_t id) { return id < 0; });
    return fits ? std::string() : "a global id of a " + of + " exceeds 9223372036854775807";
}

std::vector<std::int64_t> global_ids(vtkDataSet& data, const ExactIndex& index) {
    const std::vector<std::int64_t> of_data = integers_of(*data.GetCellData()->GetGlobalIds());
    std::vector<std::int64_t> of_mesh(index.mesh.cell_count());
    for (std::size_t i = 0; i < of_mesh.size(); ++i)
        of_mesh[i] = of_data[static_cast<std::size_t>(index.id(static_cast<Mesh::Index>(i)))];
    return of_mesh;
}

std::string look_at_cells(vtkDataSet& data, pieces::PieceFacts& facts) {
    facts = {};
    Cells cells(data);
    if (!cells.built()) return "VTK cannot build its cells";
    const vtkIdType count = data.GetNumberOfCells(), most = std::numeric_limits<Mesh::Index>::max();
    if (count > most || data.GetNumberOfPoints() > most) return "it has more than 2147483647 points or cells";
    if (data.GetNumberOfPoints() == 0) return {};
    std::vector<Mesh::Index> nodes;
    for (vtkIdType i = 0; i < count; ++i) {
        const mesh::CellType& type = cells.type(i);
        const int number = cells.number(i);
        if (type.kind == mesh::CellKind::other)
            return name_of(static_cast<Mesh::Index>(i)) + " is a " + type.name() + ", whose corners are not known";
        if (type.dimension() < facts.dimension) continue;
        if (type.dimension() > facts.dimension) facts = {.dimension = type.dimension()};
        facts.low_type = std::min(facts.low_type, number);
        facts.high_type = std::max(facts.high_type, number);
        if (type.corners != static_cast<std::size_t>(type.dimension()) + 1)
            facts.nodes_numbered = data.GetPointData()->GetGlobalIds() != nullptr;
        nodes.clear();
        if (facts.dimension == 2 && !cells.is_ghost(i)) cells.nodes(i, nodes);
        for (const Mesh::Index node : nodes) {
            // A node that is not there makes no bounds: who reads the cells tells of it.
            if (node < 0 || node >= data.GetNumberOfPoints()) continue;
            std::array<double, 3> x{};
            data.GetPoint(node, x.data());
            facts.polygons.add({x, x});
        }
    }
    facts.numbered = data.GetCellData()->GetGlobalIds() != nullptr;
    return {};
}

std::string read_cells(vtkDataSet& data, ExactIndex& index) {
    pieces::PieceFacts facts;
    if (std::string reason = look_at_cells(data, facts); !reason.empty() || facts.dimension < 0) return reason;
    pieces::Shape& shape = index.shape;
    const bool alone = shape.dimension == 0;
    if (alone && facts.dimension < 2) return pieces::only_lower;
    if (alone)
        shape.dimension = facts.dimension, shape.mixed = pieces::PieceFacts::mixed(facts.low_type, facts.high_type);

    Cells cells(data);
    std::vector<Mesh::Index> kept = cells.kept(shape.dimension);
    if (kept.empty()) return {};
    if (shape.by_numbers) {
        const std::vector<std::int64_t> ids = integers_of(*data.GetCellData()->GetGlobalIds());
        std::stable_sort(kept.begin(), kept.end(), [&](Mesh::Index a, Mesh::Index b) {
            return ids[static_cast<std::size_t>(a)] < ids[static_cast<std::size_t>(b)];
        });
    }
    Mesh& mesh = index.mesh;
    mesh.dimension = shape.dimension;
    mesh.points = points_of(data);
    Mesh::Shapes& shapes = mesh.shapes;
    const std::size_t points = mesh.points.size() / 3;
    // Tetrahedra alone need no look at their nodes here: who indexes or checks them tells what is no node.
    const bool any_node = !shape.mixed && shape.dimension == 3;
    std::vector<Mesh::Index> nodes;
    for (const Mesh::Index cell : kept) {
        cells.nodes(cell, nodes);
        if (std::string fault = fault_of_nodes(cells.type(cell), nodes, any_node ? 0 : points); !fault.empty())
            return name_of(cell) + fault;
        if (shape.mixed) {
            index.by_corners += mesh::add_shape(mesh, cells.number(cell), nodes) ? 0 : 1;
            if (cells.number(cell) == vtk_polyhedron) cells.faces(cell, shapes);
        } else {
            const auto mid = nodes.begin() + static_cast<std::ptrdiff_t>(mesh.corners());
            mesh.cells.insert(mesh.cells.end(), nodes.begin(), mid);
            mesh.mid_nodes.insert(mesh.mid_nodes.end(), mid, nodes.end());
        }
    }
    for (const Mesh::Index node : shapes.rings)
        if (node < 0 || static_cast<std::size_t>(node) >= points) return "a face has a vertex that is no point";
    if (!shapes.face_ends.empty()) shapes.face_ends.resize(shapes.count(), shapes.face_ends.back());
    if (!mesh.mid_nodes.empty()) mesh.mid_edge_order = MidEdgeOrder::vtk;
    const bool whole = static_cast<vtkIdType>(kept.size()) == data.GetNumberOfCells();
    if (!whole || !std::is_sorted(kept.begin(), kept.end())) mesh.cell_numbers = kept;
    if (shape.dimension == 2 && !index.flatten(shape.normal))
        return alone ? make_surface(cells, kept, index) : "its polygons do not lie in one plane across an axis";
    if (!shape.mixed) return {};
    // No cell has more parts than nodes of its own and of its faces.
    if (shapes.nodes.size() + shapes.rings.size() > std::numeric_limits<Mesh::Index>::max())
        return "its cells would have more than 2147483647 parts";
    vtkDataArray* const ids = shape.nodes_by_numbers ? data.GetPointData()->GetGlobalIds() : nullptr;
    if (ids != nullptr) {
        std::string fault = fault_of_global_ids(*data.GetPointData(), data.GetNumberOfPoints(), "point");
        if (!fault.empty()) return fault;
    }
    if (const auto open = index.cut(ids != nullptr ? integers_of(*ids) : std::vector<std::int64_t>()))
        return "the faces of " + name_of(mesh.cell_number(shapes.parts[*open])) + " do not close";
    index.cells_are_cut = true;
    mesh.by_corners = index.by_corners;
    note(index, index.by_corners, " cells of a higher order: they are taken by their corners");
    if (std::string uncut = mesh::told_uncut(mesh); !uncut.empty())
        index.notes.push_back({Note::Kind::left_out, std::move(uncut), {}, true});
    return {};
}

std::vector<Mesh::Index> read_polygons(vtkDataSet& data, Plc& plc) {
    Cells cells(data);
    std::vector<Mesh::Index> numbers, nodes;
    std::vector<std::vector<Mesh::Index>> rings;
    for (const Mesh::Index cell : cells.kept(2)) {
        cells.nodes(cell, nodes);
        mesh::add_rings(cells.type(cell), nodes, rings);
        numbers.resize(rings.size(), cell);
    }
    if (std::all_of(rings.begin(), rings.end(), [](const auto& ring) { return ring.size() == 3; })) return {};
    plc.points = points_of(data);
    for (std::vector<Mesh::Index>& ring : rings) plc.facets.emplace_back().polygons.push_back(std::move(ring));
    return numbers;
}

}  // namespace barycert::in_vtk
