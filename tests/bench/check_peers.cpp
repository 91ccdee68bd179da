#include "check_peers.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCellValidator.h>
#include <vtkDoubleArray.h>
#include <vtkMeshQuality.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkShortArray.h>
#include <vtkUnstructuredGrid.h>

struct VtkPeers::Data {
    vtkNew<vtkUnstructuredGrid> grid;
};

VtkPeers::VtkPeers(const barycert::Mesh& mesh) : data_(std::make_unique<Data>()) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.point_count()));
    for (std::size_t i = 0; i < mesh.point_count(); ++i)
        points->SetPoint(static_cast<vtkIdType>(i), mesh.points.data() + 3 * i);
    vtkNew<vtkCellArray> cells;
    cells->AllocateExact(static_cast<vtkIdType>(mesh.cell_count()), static_cast<vtkIdType>(mesh.cells.size()));
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        vtkIdType corners[4];
        for (std::size_t i = 0; i < 4; ++i) corners[i] = mesh.cells[4 * c + i];
        cells->InsertNextCell(4, corners);
    }
    data_->grid->SetPoints(points);
    data_->grid->SetCells(VTK_TETRA, cells);
}

VtkPeers::~VtkPeers() = default;

long VtkPeers::count_invalid() {
    vtkNew<vtkCellValidator> validator;
    validator->SetInputData(data_->grid);
    validator->Update();
    auto* const state = validator->GetOutput()->GetCellData()->GetArray("ValidityState");
    long invalid = 0;
    for (vtkIdType i = 0; i < state->GetNumberOfTuples(); ++i) invalid += state->GetTuple1(i) != 0 ? 1 : 0;
    return invalid;
}

std::vector<double> VtkPeers::quality(Quality measure) {
    vtkNew<vtkMeshQuality> filter;
    filter->SetInputData(data_->grid);
    filter->SaveCellQualityOn();
    if (measure == Quality::aspect) filter->SetTetQualityMeasureToAspectRatio();
    if (measure == Quality::min_angle) filter->SetTetQualityMeasureToMinAngle();
    if (measure == Quality::radius_ratio) filter->SetTetQualityMeasureToRadiusRatio();
    filter->Update();
    auto* const array = filter->GetOutput()->GetCellData()->GetArray("Quality");
    std::vector<double> values(static_cast<std::size_t>(array->GetNumberOfTuples()));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = array->GetTuple1(static_cast<vtkIdType>(i));
    return values;
}
