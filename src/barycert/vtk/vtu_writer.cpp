#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkExecutive.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "barycert/core/output_file.hpp"
#include "barycert/mesh/consistency.hpp"
#include "barycert/mesh/mid_edges.hpp"
#include "barycert/vtk/messages.hpp"
#include "barycert/vtk/raw_grid.hpp"
#include "barycert/vtk/vtu.hpp"
#include "barycert/vtk/xml_name.hpp"

namespace barycert {
namespace {

/// VTK's writer on a stream of ours: what it makes of a string would be copied twice on the way out.
class StreamWriter : public vtkXMLUnstructuredGridWriter {
public:
    static StreamWriter* New();
    StreamWriter(const StreamWriter&) = delete;
    StreamWriter& operator=(const StreamWriter&) = delete;

    void set_stream(std::ostream& stream) { Stream = &stream; }

protected:
    StreamWriter() = default;
    ~StreamWriter() override = default;
};

StreamWriter* StreamWriter::New() {
    VTK_STANDARD_NEW_BODY(StreamWriter);
}

/// An array of VTK's on the mesh's own memory, which VTK neither frees nor writes to: its interface knows no const.
vtkNew<vtkDoubleArray> view_of(const std::vector<double>& values, int components) {
    constexpr int keep = 1;
    vtkNew<vtkDoubleArray> array;
    array->SetNumberOfComponents(components);
    array->SetArray(const_cast<double*>(values.data()), static_cast<vtkIdType>(values.size()), keep);
    return array;
}

void set_points(vtkUnstructuredGrid* grid, const Mesh& mesh) {
    vtkNew<vtkPoints> points;
    if (mesh.dimension == 3) {
        points->SetData(view_of(mesh.points, 3));
    } else {
        vtkNew<vtkDoubleArray> data;
        data->SetNumberOfComponents(3);
        data->SetNumberOfTuples(static_cast<vtkIdType>(mesh.point_count()));
        for (std::size_t i = 0; i < mesh.point_count(); ++i) {
            const double point[3] = {mesh.points[2 * i], mesh.points[2 * i + 1], 0};
            data->SetTypedTuple(static_cast<vtkIdType>(i), point);
        }
        points->SetData(data);
    }
    grid->SetPoints(points);
}

int cell_type(const Mesh& mesh) {
    if (mesh.dimension == 2) return mesh.mid_nodes.empty() ? VTK_TRIANGLE : VTK_QUADRATIC_TRIANGLE;
    return mesh.mid_nodes.empty() ? VTK_TETRA : VTK_QUADRATIC_TETRA;
}

/// Corners, then mid-edge nodes, whose order in the mesh is VTK's.
template <class Array>
void set_cells(vtkUnstructuredGrid* grid, const Mesh& mesh) {
    const std::size_t corners = mesh.corners();
    const std::size_t mids = mesh.mid_nodes.empty() ? 0 : detail::edges_of(mesh.dimension).size();
    vtkNew<Array> nodes;
    nodes->SetNumberOfValues(static_cast<vtkIdType>(mesh.cells.size() + mesh.mid_nodes.size()));
    auto* to = nodes->GetPointer(0);
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        to = std::copy_n(mesh.cells.begin() + static_cast<std::ptrdiff_t>(cell * corners), corners, to);
        to = std::copy_n(mesh.mid_nodes.begin() + static_cast<std::ptrdiff_t>(cell * mids), mids, to);
    }
    vtkNew<vtkCellArray> cells;
    cells->SetData(static_cast<vtkIdType>(corners + mids), nodes);
    grid->SetCells(cell_type(mesh), cells);
}

/// Empty if every name can be written and is the only one of its kind, as VTK keeps but one array of a name.
std::string fault_of_names(const std::vector<Field>& fields, bool markers) {
    std::vector<std::string> names;
    if (markers) names.emplace_back(detail::marker_name);
    for (const Field& field : fields) {
        if (field.name.empty()) return "a field has no name";
        if (!detail::xml_attribute(field.name)) {
            return "the name of field " + detail::in_quotes(field.name) + " has bytes that XML cannot hold";
        }
        names.push_back(field.name);
    }
    std::sort(names.begin(), names.end());
    const auto twice = std::adjacent_find(names.begin(), names.end());
    return twice == names.end() ? "" : "two fields are named " + detail::in_quotes(*twice);
}

void add_fields(vtkFieldData* data, const std::vector<Field>& fields) {
    for (const Field& field : fields) {
        const vtkNew<vtkDoubleArray> array = view_of(field.data, field.components);
        array->SetName(detail::xml_attribute(field.name)->c_str());
        data->AddArray(array);
    }
}

/// Bytes of the file but for its head, and room for a head: the stream then takes no more than the file does.
std::size_t file_size(const Mesh& mesh, std::size_t index_size) {
    std::size_t bytes = 24 * mesh.point_count() + 8 * mesh.point_markers.size();
    bytes += mesh.cell_count() * (index_size + 1) + (mesh.cells.size() + mesh.mid_nodes.size()) * index_size;
    for (const auto* fields : {&mesh.point_fields, &mesh.cell_fields}) {
        for (const Field& field : *fields) bytes += field.data.size() * sizeof(double) + field.name.size() * 6 + 512;
    }
    return bytes + 4096;
}

Error failure(const std::string& path, std::string found) {
    return Error{.what = "VTK cannot write the mesh",
                 .file = path,
                 .line = 0,
                 .expected = {},
                 .found = std::move(found),
                 .remedy = "free some memory: the file is made there first"};
}

Status write(const Mesh& mesh, const std::string& path) {
    vtkNew<vtkUnstructuredGrid> grid;
    set_points(grid, mesh);
    // Indices of 32 bits as long as offsets into the list of nodes fit them.
    const bool wide = mesh.cells.size() + mesh.mid_nodes.size() > std::numeric_limits<std::int32_t>::max();
    wide ? set_cells<vtkTypeInt64Array>(grid, mesh) : set_cells<vtkTypeInt32Array>(grid, mesh);
    add_fields(grid->GetPointData(), mesh.point_fields);
    add_fields(grid->GetCellData(), mesh.cell_fields);
    if (!mesh.point_markers.empty()) {
        vtkNew<vtkTypeInt64Array> markers;
        markers->SetNumberOfValues(static_cast<vtkIdType>(mesh.point_markers.size()));
        std::copy(mesh.point_markers.begin(), mesh.point_markers.end(), markers->GetPointer(0));
        markers->SetName(detail::marker_name);
        grid->GetPointData()->AddArray(markers);
    }

    std::string room;
    room.reserve(file_size(mesh, wide ? 8 : 4));
    std::ostringstream stream(std::move(room));
    detail::Messages messages;
    {
        vtkNew<StreamWriter> writer;
        messages.listen_to(writer);
        messages.listen_to(writer->GetExecutive());
        writer->SetDataModeToAppended();
        writer->EncodeAppendedDataOff();
        writer->SetCompressorTypeToNone();
        writer->SetHeaderTypeToUInt64();
        writer->SetInputData(grid);
        writer->set_stream(stream);
        const bool written = writer->Write() == 1 && writer->GetErrorCode() == vtkErrorCode::NoError;
        if (!written || !stream || !messages.first().empty()) return failure(path, messages.first());
    }
    OutputFile file(path);
    file.write(stream.view());
    return file.commit();
}

}  // namespace

Status write_vtu(const Mesh& mesh, const std::string& path) {
    std::string fault;
    if (const char* const found = detail::inconsistency(mesh, detail::FieldValues::any); found != nullptr) {
        fault = found;
    } else if (fault = fault_of_names(mesh.point_fields, !mesh.point_markers.empty()); fault.empty()) {
        fault = fault_of_names(mesh.cell_fields, false);
    }
    if (!fault.empty()) {
        return Error{.what = "cannot write the mesh: " + fault,
                     .file = path,
                     .line = 0,
                     .expected = {},
                     .found = {},
                     .remedy = "correct the mesh in memory"};
    }
    try {
        return write(mesh, path);
    } catch (const std::bad_alloc&) {
        return failure(path, "too little memory");
    }
}

}  // namespace barycert
