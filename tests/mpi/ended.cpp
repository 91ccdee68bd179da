// A job in which one rank goes wrong. Every rank writes how its probe ended, and errors, to said-RANK.
//   ended MODE RANK    what goes wrong, where:
//     none     nothing
//     killed   the rank is killed (SIGKILL) while the others wait for it
//     memory   the rank has no memory left but for what MPI has already
//     broken   the file of its piece is cut off

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <sys/resource.h>
#include <unistd.h>

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkInformationVector.h>
#include <vtkMPIController.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataAlgorithm.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "vtkPBarycertProbe.h"

namespace {

// A bar of many tetrahedra, those of this rank.
vtkSmartPointer<vtkUnstructuredGrid> bar(int rank, int cubes) {
    const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkDoubleArray> x;
    x->SetName("x");
    vtkNew<vtkIdTypeArray> ids;
    ids->SetName("id");
    for (int i = 0; i <= cubes; ++i) {
        for (int k = 0; k < 4; ++k) {
            points->InsertNextPoint(rank * cubes + i, k % 2, k / 2);
            x->InsertNextValue(rank * cubes + i);
        }
    }
    grid->SetPoints(points);
    constexpr int corners[5][4] = {{0, 1, 2, 4}, {3, 1, 2, 7}, {5, 1, 4, 7}, {6, 2, 4, 7}, {1, 2, 4, 7}};
    for (vtkIdType i = 0; i < cubes; ++i) {
        for (const auto& corner : corners) {
            vtkIdType nodes[4];
            for (int k = 0; k < 4; ++k) nodes[k] = 4 * i + corner[k];
            ids->InsertNextValue(grid->InsertNextCell(VTK_TETRA, 4, nodes) + 5 * vtkIdType{rank} * cubes);
        }
    }
    grid->GetPointData()->AddArray(x);
    grid->GetCellData()->SetGlobalIds(ids);
    return grid;
}

struct Points : vtkPolyDataAlgorithm {
    static Points* New();
    vtkTypeMacro(Points, vtkPolyDataAlgorithm)
    Points() { SetNumberOfInputPorts(0); }
    int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override {
        if (die) std::raise(SIGKILL);
        vtkNew<vtkPoints> points;
        for (int i = 0; i < 20000; ++i) points->InsertNextPoint(i * 0.01, 0.25, 0.5);
        vtkPolyData::GetData(outputs)->SetPoints(points);
        return 1;
    }
    bool die = false;
};
vtkStandardNewMacro(Points);

// The address space may not grow from here on.
void take_memory() {
    long pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit limit{};
    getrlimit(RLIMIT_AS, &limit);
    limit.rlim_cur = static_cast<rlim_t>(pages) * 4096 + (rlim_t{8} << 20);
    setrlimit(RLIMIT_AS, &limit);
}

}  // namespace

int main(int argc, char** argv) {
    vtkNew<vtkMPIController> controller;
    controller->Initialize(&argc, &argv);
    vtkMultiProcessController::SetGlobalController(controller);
    const int rank = controller->GetLocalProcessId();
    // Not printed: launchers forward pieces of lines.
    if (std::freopen(("said-" + std::to_string(rank)).c_str(), "w", stdout) == nullptr || ::dup2(1, 2) < 0) return 2;
    const std::string mode = argc > 2 ? argv[1] : "none";
    const bool here = argc > 2 && std::atoi(argv[2]) == rank;

    const std::string file = "piece-" + std::to_string(rank) + ".vtu";
    vtkNew<vtkXMLUnstructuredGridWriter> writer;
    // Large enough that an index does not fit into what is left.
    writer->SetInputData(bar(rank, mode == "memory" ? 40000 : 100));
    writer->SetFileName(file.c_str());
    writer->Write();
    if (mode == "broken" && here) std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);

    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName(file.c_str());
    vtkNew<Points> points;
    points->die = mode == "killed" && here;
    vtkNew<vtkPBarycertProbe> probe;
    probe->SetSourceConnection(reader->GetOutputPort());
    probe->SetInputConnection(points->GetOutputPort());
    if (mode == "memory" && here) {
        reader->Update();
        take_memory();
    }
    probe->Update();
    const bool failed = probe->GetErrorCode() != 0;
    std::printf("rank %d: %s, %lld valid\n", rank, failed ? "error" : "done",
                static_cast<long long>(probe->GetValidPoints()->GetNumberOfTuples()));
    std::fflush(stdout);
    vtkMultiProcessController::SetGlobalController(nullptr);
    controller->Finalize();
    return failed ? 1 : 0;
}
