// One line of the table of bench_mpi.sh: a probe in a job of some ranks.
//
//   mpi_job cut FOLDER RANKS CUT POINTS CUBES   one process: writes the pieces, and what the answer is
//   mpi_job run FOLDER CUT WHERE POINTS        in a job: probes them, and prints the line
//
// CUT: slabs, blocks (halves of halves) or scattered (each cell anywhere). WHERE: "aligned", points lie on the rank
// whose slab or block they are in, or "scattered", anywhere. CUBES: 0, the large mesh of the benchmarks; else cubes
// along each edge of a lattice. The mesh is that of a unit cube, and the points are random in it.
//
// The answer is that of vtkBarycertProbe on the whole mesh: a sum over all points of a mixture of the point's number
// and all bytes of its row, so that it does not matter who has the row.

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkMPIController.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include "core/base/random.hpp"
#include "cube_mesh.hpp"
#include "peak_memory.hpp"
#include "require.hpp"
#include "vtkPBarycertProbe.h"

namespace {

using namespace barycert;
using bench::require;

// The parts along each axis: all along x, or as even as they can be.
std::array<int, 3> parts(std::string_view cut, int ranks) {
    std::array<int, 3> n{1, 1, 1};
    if (cut == "slabs") {
        n[0] = ranks;
    } else {
        for (std::size_t a = 0; ranks > 1; a = (a + 1) % 3, ranks /= 2) n[a] *= 2;
    }
    return n;
}

int part_of(const std::array<int, 3>& n, const double* x) {
    int part = 0;
    for (std::size_t a = 0; a < 3; ++a) part = n[a] * part + std::clamp(static_cast<int>(x[a] * n[a]), 0, n[a] - 1);
    return part;
}

std::array<double, 3> point(std::uint64_t number) {
    base::Random random(number + 1);
    std::array<double, 3> x{};
    for (double& c : x) c = random.uniform(0, 1);
    return x;
}

std::uint64_t mix(std::uint64_t x) {
    x = (x ^ x >> 31) * 0x9e3779b97f4a7c15;
    x = (x ^ x >> 29) * 0xbf58476d1ce4e5b9;
    return x ^ x >> 32;
}

std::uint64_t sum_of(vtkDataSet* output, const std::vector<std::uint64_t>& numbers) {
    vtkPointData* const rows = output->GetPointData();
    auto* const f = vtkDoubleArray::SafeDownCast(rows->GetArray("f"));
    auto* const cell = vtkIdTypeArray::SafeDownCast(rows->GetArray("cell"));
    vtkDataArray* const mask = rows->GetArray("vtkValidPointMask");
    require(f != nullptr && cell != nullptr && mask != nullptr, "arrays");
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto at = static_cast<vtkIdType>(i);
        std::uint64_t row = mix(numbers[i]);
        row = mix(row ^ std::bit_cast<std::uint64_t>(f->GetValue(at)));
        row = mix(row ^ static_cast<std::uint64_t>(cell->GetValue(at)));
        sum += mix(row ^ static_cast<std::uint64_t>(mask->GetTuple1(at)));
    }
    return sum;
}

struct Piece {
    std::vector<double> points, values;
    std::vector<vtkIdType> cells, ids;

    template <class File>
    void visit(File&& file) {
        file(points);
        file(values);
        file(cells);
        file(ids);
    }
};

std::string path(const std::string& folder, int rank) {
    return folder + "/piece-" + std::to_string(rank);
}

void write(Piece& piece, const std::string& name) {
    std::FILE* const file = std::fopen(name.c_str(), "wb");
    require(file != nullptr, "cannot write a piece");
    piece.visit([&](const auto& values) {
        const std::size_t count = values.size();
        require(std::fwrite(&count, sizeof count, 1, file) == 1, "cannot write a piece");
        require(std::fwrite(values.data(), sizeof values[0], count, file) == count, "cannot write a piece");
    });
    require(std::fclose(file) == 0, "cannot write a piece");
}

Piece read(const std::string& name) {
    Piece piece;
    std::FILE* const file = std::fopen(name.c_str(), "rb");
    require(file != nullptr, "cannot read a piece");
    piece.visit([&](auto& values) {
        std::size_t count = 0;
        require(std::fread(&count, sizeof count, 1, file) == 1, "cannot read a piece");
        values.resize(count);
        require(std::fread(values.data(), sizeof values[0], count, file) == count, "cannot read a piece");
    });
    std::fclose(file);
    return piece;
}

template <class Array, class T>
vtkSmartPointer<Array> array_of(const char* name, const std::vector<T>& values, int components = 1) {
    auto array = vtkSmartPointer<Array>::New();
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / components);
    std::copy(values.begin(), values.end(), array->GetPointer(0));
    return array;
}

vtkSmartPointer<vtkPoints> points_of(const std::vector<double>& coordinates) {
    auto points = vtkSmartPointer<vtkPoints>::New();
    points->SetData(array_of<vtkDoubleArray>("", coordinates, 3));
    return points;
}

vtkSmartPointer<vtkUnstructuredGrid> grid_of(const Piece& piece) {
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    grid->SetPoints(points_of(piece.points));
    vtkNew<vtkCellArray> cells;
    for (std::size_t i = 0; i < piece.cells.size(); i += 4) cells->InsertNextCell(4, piece.cells.data() + i);
    grid->SetCells(VTK_TETRA, cells);
    grid->GetPointData()->AddArray(array_of<vtkDoubleArray>("f", piece.values));
    grid->GetCellData()->SetGlobalIds(array_of<vtkIdTypeArray>("cell", piece.ids));
    return grid;
}

int cut(const std::string& folder, int ranks, const std::string& how, std::uint64_t points, int cubes) {
    const Mesh mesh = bench::cube_mesh(cubes);
    std::vector<Piece> pieces(static_cast<std::size_t>(ranks));
    std::vector<vtkIdType> number(mesh.point_count(), -1);
    const std::array<int, 3> n = parts(how, ranks);
    std::vector<int> of(mesh.cell_count());
    for (std::size_t i = 0; i < of.size(); ++i) {
        std::array<double, 3> middle{};
        for (std::size_t k = 0; k < 4; ++k)
            for (std::size_t a = 0; a < 3; ++a)
                middle[a] += mesh.points[3 * static_cast<std::size_t>(mesh.cells[4 * i + k]) + a] / 4;
        of[i] = how == "scattered" ? static_cast<int>(mix(i) % static_cast<std::uint64_t>(ranks))
                                   : part_of(n, middle.data());
    }
    const auto value = [](std::size_t node) { return static_cast<double>(mix(node) >> 11) * 0x1p-53; };
    for (int rank = 0; rank < ranks; ++rank) {
        Piece& piece = pieces[static_cast<std::size_t>(rank)];
        std::fill(number.begin(), number.end(), -1);
        for (std::size_t i = 0; i < of.size(); ++i) {
            if (of[i] != rank) continue;
            for (std::size_t k = 0; k < 4; ++k) {
                const auto node = static_cast<std::size_t>(mesh.cells[4 * i + k]);
                if (number[node] < 0) {
                    number[node] = static_cast<vtkIdType>(piece.values.size());
                    piece.values.push_back(value(node));
                    piece.points.insert(piece.points.end(), mesh.points.data() + 3 * node,
                                        mesh.points.data() + 3 * node + 3);
                }
                piece.cells.push_back(number[node]);
            }
            piece.ids.push_back(static_cast<vtkIdType>(i));
        }
        write(piece, path(folder, rank));
        piece = {};
    }

    Piece all;
    all.points = mesh.points;
    for (std::size_t i = 0; i < mesh.point_count(); ++i) all.values.push_back(value(i));
    all.cells.assign(mesh.cells.begin(), mesh.cells.end());
    for (std::size_t i = 0; i < mesh.cell_count(); ++i) all.ids.push_back(static_cast<vtkIdType>(i));
    std::vector<double> where;
    std::vector<std::uint64_t> numbers;
    for (std::uint64_t i = 0; i < points; ++i) {
        const std::array<double, 3> x = point(i);
        where.insert(where.end(), x.begin(), x.end());
        numbers.push_back(i);
    }
    vtkNew<vtkPolyData> input;
    input->SetPoints(points_of(where));
    vtkNew<vtkBarycertProbe> probe;
    probe->SetSourceData(grid_of(all));
    probe->SetInputData(input);
    probe->Update();
    std::FILE* const file = std::fopen((folder + "/answer").c_str(), "w");
    require(file != nullptr, "cannot write the answer");
    std::fprintf(file, "%llu %llu\n", static_cast<unsigned long long>(sum_of(probe->GetOutput(), numbers)),
                 static_cast<unsigned long long>(mesh.cell_count()));
    std::fclose(file);
    return 0;
}

// Bytes that a rank sends on the average: doc/mpi.md derives it. `reach` alone was measured, of two slabs.
double predicted(const std::string& how, bool aligned, int ranks, double points, double cells) {
    constexpr double point_bytes = 24 + 1.0 / 8, row_bytes = 8 + 8 + 8, sizes = 2 * 8, boxes = 64 * 48, reach = 0.84;
    if (ranks == 1) return 0;
    const double mine = points / ranks;
    if (how == "scattered")
        return mine * (ranks - 1) * point_bytes + mine * (ranks - 1) / ranks * row_bytes +
               (ranks - 1) * (sizes + boxes);
    const double edge = std::cbrt(6 * std::sqrt(2.0) / cells);  // of a regular tetrahedron of the mean volume
    // Boxes that hold a point, and neighbours of a block: of all, and across a face.
    double copies = 1, neighbours = 1, across = 0;
    for (const int n : parts(how, ranks)) {
        copies *= 1 + 2.0 * (n - 1) * reach * edge;
        neighbours *= 3 - 2.0 / n;
        across += 2 - 2.0 / n;
    }
    if (aligned) return mine * (copies - 1) * point_bytes + (neighbours - 1) * sizes + across * boxes;
    return mine * copies * (ranks - 1) / ranks * point_bytes + mine * (ranks - 1) / ranks * row_bytes +
           (ranks - 1) * (sizes + boxes);
}

int run(vtkMPIController* controller, const std::string& folder, const std::string& how, bool aligned,
        std::uint64_t points) {
    const int rank = controller->GetLocalProcessId(), ranks = controller->GetNumberOfProcesses();
    unsigned long long answer = 0, cells = 0;
    std::FILE* const file = std::fopen((folder + "/answer").c_str(), "r");
    require(file != nullptr && std::fscanf(file, "%llu %llu", &answer, &cells) == 2, "no answer");
    std::fclose(file);
    const std::array<int, 3> n = parts(how, ranks);
    std::vector<double> where;
    std::vector<std::uint64_t> numbers;
    for (std::uint64_t i = 0; i < points; ++i) {
        const std::array<double, 3> x = point(i);
        const int owner = aligned ? part_of(n, x.data()) : static_cast<int>(i % static_cast<std::uint64_t>(ranks));
        if (owner != rank) continue;
        where.insert(where.end(), x.begin(), x.end());
        numbers.push_back(i);
    }
    const vtkSmartPointer<vtkUnstructuredGrid> source = grid_of(read(path(folder, rank)));
    vtkNew<vtkPolyData> input;
    input->SetPoints(points_of(where));
    vtkNew<vtkPBarycertProbe> probe;
    probe->SetController(controller);
    probe->SetSourceData(source);
    probe->SetInputData(input);
    const double before = bench::peak_mib();
    std::array<double, 2> seconds{};  // with the index to make, and again
    for (double& s : seconds) {
        input->GetPoints()->Modified();
        controller->Barrier();
        const auto start = std::chrono::steady_clock::now();
        probe->Update();
        controller->Barrier();
        s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    require(probe->GetErrorCode() == 0, "the probe failed");
    unsigned long long sum = sum_of(probe->GetOutput(), numbers), all = 0;
    controller->AllReduce(&sum, &all, 1, vtkCommunicator::SUM_OP);
    require(all == answer, "not the bytes of one process");

    const std::array<double, 5> mine{static_cast<double>(probe->GetBytesSent()),
                                     static_cast<double>(probe->GetBytesGathered()),
                                     static_cast<double>(probe->GetPointsSent()), bench::peak_mib(), before};
    std::array<double, 5> most{}, total{};
    controller->AllReduce(mine.data(), most.data(), 5, vtkCommunicator::MAX_OP);
    controller->AllReduce(mine.data(), total.data(), 5, vtkCommunicator::SUM_OP);
    if (rank == 0) {
        const double expected = predicted(how, aligned, ranks, static_cast<double>(points), static_cast<double>(cells));
        std::printf("| %d | %s | %s | %.0f | %.0f | %.0f | %.0f | %.2f | %.0f | %.0f | %.0f | %.2f | %.2f |\n", ranks,
                    how.c_str(), aligned ? "aligned" : "scattered", total[2] / ranks, total[0] / ranks, most[0],
                    expected, expected > 0 ? total[0] / ranks / expected : 1, most[1], most[3], most[4], seconds[0],
                    seconds[1]);
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    const std::string mode = argc > 1 ? argv[1] : "";
    if (mode == "cut" && argc == 7)
        return cut(argv[2], std::atoi(argv[3]), argv[4], std::strtoull(argv[5], nullptr, 10), std::atoi(argv[6]));
    vtkNew<vtkMPIController> controller;
    controller->Initialize(&argc, &argv);
    vtkMultiProcessController::SetGlobalController(controller);
    require(mode == "run" && argc == 6,
            "usage: mpi_job cut FOLDER RANKS CUT POINTS CUBES | run FOLDER CUT WHERE POINTS");
    const int result =
        run(controller, argv[2], argv[3], std::string_view(argv[4]) == "aligned", std::strtoull(argv[5], nullptr, 10));
    vtkMultiProcessController::SetGlobalController(nullptr);
    controller->Finalize();
    return result;
}
