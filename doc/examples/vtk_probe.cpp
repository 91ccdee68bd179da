// Exact owners and correctly rounded values in a VTK pipeline.

#include <cstdio>

#include <vtkBarycertCheck.h>
#include <vtkBarycertLocator.h>
#include <vtkBarycertProbe.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProbeFilter.h>
#include <vtkUnstructuredGrid.h>

int main() {
    // Two tetrahedra with a common face, a temperature at the nodes, a number for each cell.
    const double nodes[][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    const vtkIdType cells[][4] = {{0, 1, 2, 3}, {4, 1, 2, 3}};
    vtkNew<vtkPoints> vertices;
    vertices->SetDataTypeToDouble();
    vtkNew<vtkDoubleArray> temperature;
    temperature->SetName("T");
    for (int i = 0; i < 5; ++i) {
        vertices->InsertNextPoint(nodes[i]);
        temperature->InsertNextValue(10 * i);
    }
    vtkNew<vtkUnstructuredGrid> mesh;
    mesh->SetPoints(vertices);
    vtkNew<vtkIntArray> number;
    number->SetName("cell");
    for (int i = 0; i < 2; ++i) {
        mesh->InsertNextCell(VTK_TETRA, 4, cells[i]);
        number->InsertNextValue(i);
    }
    mesh->GetPointData()->AddArray(temperature);
    mesh->GetCellData()->AddArray(number);

    // On the common face; inside the second cell; 0.0003 outside of the mesh.
    vtkNew<vtkPoints> where;
    where->SetDataTypeToDouble();
    where->InsertNextPoint(0.5, 0.25, 0.25);
    where->InsertNextPoint(0.5, 0.5, 0.5);
    where->InsertNextPoint(0.25, 0.25, -0.0003);
    vtkNew<vtkPolyData> points;
    points->SetPoints(where);

    vtkNew<vtkBarycertProbe> probe;
    probe->SetSourceData(mesh);
    probe->SetInputData(points);
    probe->Update();
    const auto print = [](const char* name, vtkPointData* out) {
        std::printf("%s\n", name);
        for (vtkIdType i = 0; i < 3; ++i) {
            std::printf("valid %g, cell %g, T = %.17g\n", out->GetArray("vtkValidPointMask")->GetTuple1(i),
                        out->GetArray("cell")->GetTuple1(i), out->GetArray("T")->GetTuple1(i));
        }
    };
    print("vtkBarycertProbe", probe->GetOutput()->GetPointData());

    vtkNew<vtkBarycertLocator> locator;
    vtkNew<vtkProbeFilter> filter;
    filter->SetSourceData(mesh);
    filter->SetInputData(points);
    filter->SetCellLocatorPrototype(locator);
    filter->Update();
    print("vtkProbeFilter with vtkBarycertLocator", filter->GetOutput()->GetPointData());

    filter->SetCellLocatorPrototype(nullptr);
    filter->Update();
    print("vtkProbeFilter", filter->GetOutput()->GetPointData());

    // The faces of the first cell, as a surface.
    const vtkIdType faces[][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    vtkNew<vtkCellArray> triangles;
    for (const auto& face : faces) triangles->InsertNextCell(3, face);
    vtkNew<vtkPolyData> surface;
    surface->SetPoints(vertices);
    surface->SetPolys(triangles);

    vtkNew<vtkBarycertCheck> check;
    check->SetInputData(surface);
    check->Update();
    std::printf("certified: %s\n", check->GetCertified() ? "yes" : "no");

    vtkNew<vtkBarycertLocator> on_surface;
    on_surface->SetDataSet(surface);
    const double from[] = {0.25, 0.25, 0.25}, to[] = {0.25, 0.25, -2};
    double nearest[3], squared = 0;
    vtkIdType cell = -1;
    int sub_id = 0;
    on_surface->FindClosestPoint(to, nearest, cell, sub_id, squared);
    std::printf("nearest: cell %lld at %g %g %g\n", cell, nearest[0], nearest[1], nearest[2]);

    vtkNew<vtkIdList> hits;
    const int side = on_surface->IntersectWithLine(from, to, nullptr, hits);
    std::printf("starts %s, meets %lld: cell %lld\n", side < 0 ? "inside" : "outside", hits->GetNumberOfIds(),
                hits->GetId(0));
}
