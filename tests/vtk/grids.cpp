#include "tests/vtk/grids.hpp"

#include <mutex>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

namespace barycert::testing {

namespace {

vtkSmartPointer<vtkPoints> nodes_of(const Mesh& mesh, int normal, double plane) {
    const auto points = vtkSmartPointer<vtkPoints>::New();
    points->SetDataTypeToDouble();
    const auto d = static_cast<std::size_t>(mesh.dimension);
    for (std::size_t i = 0; i < mesh.point_count(); ++i) {
        double x[3] = {plane, plane, plane};
        std::size_t axis = 0;
        for (int a = 0; a < 3; ++a)
            if (d == 3 || a != normal) x[a] = mesh.points[d * i + axis++];
        points->InsertNextPoint(x);
    }
    return points;
}

vtkSmartPointer<vtkCellArray> cells_of(const Mesh& mesh) {
    const auto cells = vtkSmartPointer<vtkCellArray>::New();
    for (std::size_t i = 0; i < mesh.cells.size(); i += mesh.corners()) {
        cells->InsertNextCell(static_cast<int>(mesh.corners()));
        for (std::size_t k = 0; k < mesh.corners(); ++k) cells->InsertCellPoint(mesh.cells[i + k]);
    }
    return cells;
}

void add(vtkDataSetAttributes* attributes, const std::vector<Field>& fields) {
    for (const Field& field : fields) {
        vtkNew<vtkDoubleArray> array;
        array->SetName(field.name.c_str());
        array->SetNumberOfComponents(field.components);
        for (const double value : field.data) array->InsertNextValue(value);
        attributes->AddArray(array);
    }
}

struct Window : vtkOutputWindow {
    static Window* New();
    vtkTypeMacro(Window, vtkOutputWindow)
    void DisplayText(const char* text) override {
        const std::lock_guard lock(access);
        said += text;
    }
    std::mutex access;
    std::string said;
};
vtkStandardNewMacro(Window);

Window* window = nullptr;

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> grid_of(const Mesh& mesh, double plane) {
    const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    grid->SetPoints(nodes_of(mesh, 2, plane));
    grid->SetCells(mesh.dimension == 3 ? VTK_TETRA : VTK_TRIANGLE, cells_of(mesh));
    add(grid->GetPointData(), mesh.point_fields);
    add(grid->GetCellData(), mesh.cell_fields);
    return grid;
}

vtkSmartPointer<vtkPolyData> surface_of(const Mesh& mesh, int normal, double plane) {
    const auto surface = vtkSmartPointer<vtkPolyData>::New();
    surface->SetPoints(nodes_of(mesh, normal, plane));
    surface->SetPolys(cells_of(mesh));
    add(surface->GetPointData(), mesh.point_fields);
    add(surface->GetCellData(), mesh.cell_fields);
    return surface;
}

vtkSmartPointer<vtkPolyData> poly_data_of(const Surface& surface) {
    const auto data = points_of(surface.points);
    Mesh triangles;
    triangles.dimension = 2;
    triangles.cells = surface.cells;
    data->SetPolys(cells_of(triangles));
    return data;
}

vtkSmartPointer<vtkPolyData> points_of(const std::vector<double>& points) {
    const auto cloud = vtkSmartPointer<vtkPolyData>::New();
    Mesh mesh;
    mesh.points = points;
    cloud->SetPoints(nodes_of(mesh, 2, 0));
    return cloud;
}

Messages::Messages() {
    window = Window::New();
    vtkOutputWindow::SetInstance(window);
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

Messages::~Messages() {
    vtkOutputWindow::SetInstance(nullptr);
    window->Delete();
    window = nullptr;
}

int Messages::count(const std::string& part) const {
    int n = 0;
    const std::string text = all();
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
}

std::string Messages::all() const {
    const std::lock_guard lock(window->access);
    return window->said;
}

}  // namespace barycert::testing
