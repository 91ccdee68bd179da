#include "surface_peers.hpp"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkContour3DLinearGrid.h>
#include <vtkContourFilter.h>
#include <vtkCutter.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPlaneCutter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <cstdio>
#include <cstdlib>

namespace barycert::bench {

struct SurfacePeers::Data {
    vtkNew<vtkUnstructuredGrid> grid;
    vtkSmartPointer<vtkPolyData> out;

    void keep(vtkAlgorithm* filter) {
        filter->Update();
        out = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
        if (out == nullptr) {
            std::fprintf(stderr, "VTK gave no triangles\n");
            std::exit(1);
        }
    }

    static vtkSmartPointer<vtkPlane> plane(const std::array<double, 3>& n, double offset) {
        auto plane = vtkSmartPointer<vtkPlane>::New();
        const double scale = offset / (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        plane->SetOrigin(scale * n[0], scale * n[1], scale * n[2]);
        plane->SetNormal(n[0], n[1], n[2]);
        return plane;
    }
};

SurfacePeers::SurfacePeers(const Mesh& mesh) : data_(std::make_unique<Data>()) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.point_count()));
    for (std::size_t i = 0; i < mesh.point_count(); ++i)
        points->SetPoint(static_cast<vtkIdType>(i), mesh.points.data() + 3 * i);
    data_->grid->SetPoints(points);
    vtkNew<vtkCellArray> cells;
    cells->AllocateExact(static_cast<vtkIdType>(mesh.cell_count()), static_cast<vtkIdType>(mesh.cells.size()));
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        vtkIdType ids[4];
        for (std::size_t i = 0; i < 4; ++i) ids[i] = mesh.cells[4 * c + i];
        cells->InsertNextCell(4, ids);
    }
    data_->grid->SetCells(VTK_TETRA, cells);
}

SurfacePeers::~SurfacePeers() = default;

void SurfacePeers::set_field(const Field& field) {
    vtkNew<vtkDoubleArray> values;
    values->SetName("f");
    values->SetNumberOfValues(static_cast<vtkIdType>(field.data.size()));
    for (std::size_t i = 0; i < field.data.size(); ++i) values->SetValue(static_cast<vtkIdType>(i), field.data[i]);
    data_->grid->GetPointData()->SetScalars(values);
}

void SurfacePeers::contour_filter(double value) {
    vtkNew<vtkContourFilter> filter;
    filter->SetInputData(data_->grid);
    filter->SetValue(0, value);
    filter->ComputeNormalsOff();
    filter->ComputeGradientsOff();
    filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    data_->keep(filter);
}

void SurfacePeers::linear_grid(double value, bool merge, bool sequential) {
    vtkNew<vtkContour3DLinearGrid> filter;
    filter->SetInputData(data_->grid);
    filter->SetValue(0, value);
    filter->SetMergePoints(merge);
    filter->ComputeNormalsOff();
    filter->InterpolateAttributesOn();
    filter->SetSequentialProcessing(sequential);
    filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    data_->keep(filter);
}

void SurfacePeers::cutter(const std::array<double, 3>& normal, double offset) {
    vtkNew<vtkCutter> filter;
    filter->SetInputData(data_->grid);
    filter->SetCutFunction(Data::plane(normal, offset));
    filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    data_->keep(filter);
}

void SurfacePeers::plane_cutter(const std::array<double, 3>& normal, double offset) {
    vtkNew<vtkPlaneCutter> filter;
    filter->SetInputData(data_->grid);
    filter->SetPlane(Data::plane(normal, offset));
    filter->ComputeNormalsOff();
    filter->Update();
    data_->out = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
}

PeerSurface SurfacePeers::surface() const {
    PeerSurface s;
    if (data_->out == nullptr) return s;
    vtkPolyData* const out = data_->out;
    for (vtkIdType i = 0; i < out->GetNumberOfPoints(); ++i) {
        double x[3];
        out->GetPoint(i, x);
        s.points.insert(s.points.end(), x, x + 3);
    }
    vtkNew<vtkIdList> ids;
    for (vtkIdType c = 0; c < out->GetNumberOfCells(); ++c) {
        out->GetCellPoints(c, ids);
        // A polygon as a fan.
        for (vtkIdType i = 2; i < ids->GetNumberOfIds(); ++i)
            s.triangles.push_back({ids->GetId(0), ids->GetId(i - 1), ids->GetId(i)});
    }
    return s;
}

}  // namespace barycert::bench
