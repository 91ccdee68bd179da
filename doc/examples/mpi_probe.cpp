// A mesh in pieces on the ranks of a job; points, some of them on seams, on the first rank.

#include <cstdio>

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkMPIController.h>
#include <vtkNew.h>
#include <vtkPBarycertProbe.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

int main(int argc, char** argv) {
    vtkNew<vtkMPIController> controller;
    controller->Initialize(&argc, &argv);
    vtkMultiProcessController::SetGlobalController(controller);
    const int rank = controller->GetLocalProcessId(), ranks = controller->GetNumberOfProcesses();

    // A bar of four cubes, five tetrahedra each, every second one mirrored. This rank has some of the cubes, and their
    // nodes.
    constexpr int cubes = 4;
    const int first = cubes * rank / ranks, last = cubes * (rank + 1) / ranks;
    constexpr int corners[5][4] = {{0, 1, 2, 4}, {3, 1, 2, 7}, {5, 1, 4, 7}, {6, 2, 4, 7}, {1, 2, 4, 7}};
    vtkNew<vtkPoints> nodes;
    nodes->SetDataTypeToDouble();
    vtkNew<vtkDoubleArray> temperature;
    temperature->SetName("T");
    for (int i = first; i <= last; ++i) {
        for (int k = 0; k < 4; ++k) {
            nodes->InsertNextPoint(i, k % 2, k / 2);
            temperature->InsertNextValue(10 * i + k);
        }
    }
    vtkNew<vtkUnstructuredGrid> piece;
    piece->SetPoints(nodes);
    piece->GetPointData()->AddArray(temperature);
    vtkNew<vtkIdTypeArray> ids;
    ids->SetName("cell");
    for (vtkIdType i = first; i < last; ++i) {
        for (vtkIdType k = 0; k < 5; ++k) {
            vtkIdType cell[4];
            for (int c = 0; c < 4; ++c) cell[c] = 4 * (i - first) + (corners[k][c] ^ i % 2 * 4);
            piece->InsertNextCell(VTK_TETRA, 4, cell);
            ids->InsertNextValue(5 * i + k);
        }
    }
    piece->GetCellData()->SetGlobalIds(ids);

    vtkNew<vtkPoints> where;
    for (int i = 0; i <= 8 && rank == 0; ++i) where->InsertNextPoint(0.5 * i, 0.25, 0.5);
    vtkNew<vtkPolyData> points;
    points->SetPoints(where);

    vtkNew<vtkPBarycertProbe> probe;
    probe->SetController(controller);
    probe->SetSourceData(piece);
    probe->SetInputData(points);
    probe->Update();
    const bool failed = probe->GetErrorCode() != 0;

    vtkPointData* const rows = probe->GetOutput()->GetPointData();
    for (vtkIdType i = 0; i < points->GetNumberOfPoints() && !failed; ++i) {
        std::printf("x = %.1f: cell %2g, T = %g\n", points->GetPoint(i)[0], rows->GetArray("cell")->GetTuple1(i),
                    rows->GetArray("T")->GetTuple1(i));
    }
    vtkMultiProcessController::SetGlobalController(nullptr);
    controller->Finalize();
    return failed ? 1 : 0;
}
