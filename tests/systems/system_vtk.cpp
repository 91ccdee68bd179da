// VTK's locators and filters. SYSTEM: static-locator, cell-tree, cell-locator, probe, resample.
//
// Locators are asked by FindCell with a tolerance of 0, and its weights are summed up with the nodal values; filters
// get the points as polygon data, and are left as they are. In C++17: VTK 9.1's vtkSMPTools.h does not compile as
// C++20.
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellLocator.h>
#include <vtkCellTreeLocator.h>
#include <vtkCellType.h>
#include <vtkGenericCell.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkProbeFilter.h>
#include <vtkResampleWithDataSet.h>
#include <vtkSMPTools.h>
#include <vtkSmartPointer.h>
#include <vtkStaticCellLocator.h>
#include <vtkUnstructuredGrid.h>
#include <vtkVersion.h>

#include <limits>

#include "tests/systems/exchange.hpp"
#include "tests/vtk_grid.hpp"

namespace {

using barycert::systems::Answer;
using barycert::systems::now;
using barycert::systems::Question;
using barycert::test::vtk_points;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The mesh with its field f, and the field cell of cells: their numbers.
vtkSmartPointer<vtkUnstructuredGrid> grid_of(const Question& question) {
    std::vector<std::uint8_t> types = question.types;
    std::vector<std::int64_t> ends = question.ends;
    if (types.empty()) {
        types.assign(question.cell_count(), question.dimension == 3 ? VTK_TETRA : VTK_TRIANGLE);
        for (std::size_t c = 1; c <= types.size(); ++c)
            ends.push_back(static_cast<std::int64_t>(c * (question.dimension + 1)));
    }
    auto grid = barycert::test::vtk_grid(vtk_points(question.nodes, question.dimension), types, ends, question.cells,
                                         "f", question.values);
    vtkNew<vtkIdTypeArray> numbers;
    numbers->SetName("cell");
    for (std::size_t c = 0; c < question.cell_count(); ++c) numbers->InsertNextValue(static_cast<vtkIdType>(c));
    grid->GetCellData()->AddArray(numbers);
    return grid;
}

void find(vtkAbstractCellLocator* locator, const Question& question, vtkUnstructuredGrid* grid, Answer& answer) {
    const double start = now();
    locator->SetDataSet(grid);
    locator->BuildLocator();
    const double built = now();
    vtkNew<vtkGenericCell> cell;
    double parametric[3], weights[VTK_CELL_SIZE];
    for (std::size_t i = 0; i < question.point_count(); ++i) {
        const double* const x = question.points.data() + question.dimension * i;
        double at[3] = {x[0], x[1], question.dimension == 3 ? x[2] : 0};
        const vtkIdType found = locator->FindCell(at, 0, cell, parametric, weights);
        double sum = found < 0 ? nan : 0;
        for (int k = 0; found >= 0 && k < cell->GetNumberOfPoints(); ++k)
            sum += weights[k] * question.values[static_cast<std::size_t>(cell->GetPointId(k))];
        answer.owners[i] = found;
        answer.sampled[i] = sum;
    }
    answer.index_seconds = built - start;
    answer.seconds = now() - built;
}

/// vtkProbeFilter or vtkResampleWithDataSet. Their index is made and used in one go.
template <class Filter>
void filter(const Question& question, vtkUnstructuredGrid* grid, Answer& answer) {
    vtkNew<vtkPolyData> points;
    points->SetPoints(vtk_points(question.points, question.dimension));
    // vtkResampleWithDataSet of VTK 9.1 ends the process where there are no cells
    // (tests/findings/vtk_resample_points.py).
    vtkNew<vtkCellArray> vertices;
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i) vertices->InsertNextCell(1, &i);
    points->SetVerts(vertices);
    vtkNew<Filter> filter;
    filter->SetInputDataObject(0, points);
    filter->SetSourceData(grid);
    const double start = now();
    filter->Update();
    answer.seconds = now() - start;
    auto* const output = vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0));
    vtkDataArray* const mask = output->GetPointData()->GetArray("vtkValidPointMask");
    vtkDataArray* const field = output->GetPointData()->GetArray("f");
    vtkDataArray* const numbers = output->GetPointData()->GetArray("cell");
    for (std::size_t i = 0; i < question.point_count(); ++i) {
        const auto id = static_cast<vtkIdType>(i);
        const bool valid = mask->GetTuple1(id) != 0;
        answer.owners[i] = valid ? static_cast<std::int64_t>(numbers->GetTuple1(id)) : -1;
        answer.sampled[i] = valid ? field->GetTuple1(id) : nan;
    }
}

}  // namespace

int main(int count, char** words) {
    if (count != 4 || std::string(words[2]) != "locate") return 2;
    const std::string system = words[1];
    const Question question(words[3]);
    // Initialize(1) would not reach the sorting with which vtkStaticCellLocator makes its index.
    vtkSMPTools::SetBackend("Sequential");
    const vtkSmartPointer<vtkUnstructuredGrid> grid = grid_of(question);
    Answer answer;
    answer.owners.resize(question.point_count());
    answer.sampled.resize(question.point_count());
    if (system == "static-locator") {
        find(vtkNew<vtkStaticCellLocator>(), question, grid, answer);
    } else if (system == "cell-tree") {
        find(vtkNew<vtkCellTreeLocator>(), question, grid, answer);
    } else if (system == "cell-locator") {
        find(vtkNew<vtkCellLocator>(), question, grid, answer);
    } else if (system == "probe") {
        filter<vtkProbeFilter>(question, grid, answer);
    } else if (system == "resample") {
        filter<vtkResampleWithDataSet>(question, grid, answer);
    } else {
        return 2;
    }
    answer.write(question.folder);
    std::printf("%s\n", vtkVersion::GetVTKVersion());
    return 0;
}
