#include <vtkCellTreeLocator.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkGenericCell.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkProbeFilter.h>
#include <vtkSmartPointer.h>
#include <vtkStaticCellLocator.h>
#include <vtkUnstructuredGrid.h>

#include <limits>

#include "sample_peers.hpp"
#include "sample_subject.hpp"
#include "tests/mesh/whole_cells.hpp"
#include "tests/vtk_grid.hpp"

namespace barycert::bench {

void use_one_vtk_thread();  // sample_vtk_threads.cpp

namespace {

vtkSmartPointer<vtkAbstractCellLocator> new_locator(VtkPeer::Which which) {
    if (which == VtkPeer::Which::static_locator) return vtkSmartPointer<vtkStaticCellLocator>::New();
    return vtkSmartPointer<vtkCellTreeLocator>::New();
}

class Vtk final : public VtkPeer {
public:
    Vtk(const Mesh& mesh, const std::vector<double>& values, std::span<const double> points, const Grid& grid);

    std::size_t build(Which which) override;
    void drop(Which which) override { locator(which) = nullptr; }
    void find(Which which, std::vector<Mesh::Index>& cells) override;
    void find_all(Which which, std::span<const double> points, std::vector<Mesh::Index>& cells) override;
    void interpolate(Which which, std::vector<double>& values) override;
    void probe(Which which) override { probe(points_, grid_, new_locator(which)); }
    void probe_image() override { probe(image_, grid_, nullptr); }
    void set_image(std::vector<double>& values) override;
    void probe_in_image() override { probe(points_, image_, nullptr); }
    std::vector<double> probed() const override;

private:
    vtkSmartPointer<vtkAbstractCellLocator>& locator(Which which) {
        return locators_[which == Which::static_locator ? 0 : 1];
    }

    /// visit(number of the point, cell or -1, generic cell, weights) for each point.
    template <class Visit>
    void for_found(Which which, std::span<const double> points, Visit visit) {
        vtkNew<vtkGenericCell> cell;
        double parametric[3], weights[VTK_CELL_SIZE];
        for (std::size_t i = 0; i < points.size() / 3; ++i) {
            double at[3] = {points[3 * i], points[3 * i + 1], points[3 * i + 2]};
            visit(i, locator(which)->FindCell(at, 0, cell, parametric, weights), cell.Get(), weights);
        }
    }

    void probe(vtkDataSet* where, vtkDataSet* source, vtkAbstractCellLocator* prototype) {
        vtkNew<vtkProbeFilter> filter;
        filter->SetInputData(where);
        filter->SetSourceData(source);
        if (prototype != nullptr) filter->SetCellLocatorPrototype(prototype);
        filter->Update();
        probed_ = filter->GetOutput();
    }

    vtkSmartPointer<vtkUnstructuredGrid> grid_;
    vtkNew<vtkPolyData> points_;
    vtkNew<vtkImageData> image_;
    const std::vector<double>& values_;
    std::span<const double> coordinates_;
    std::array<vtkSmartPointer<vtkAbstractCellLocator>, 2> locators_;
    vtkSmartPointer<vtkDataSet> probed_;
};

Vtk::Vtk(const Mesh& mesh, const std::vector<double>& values, std::span<const double> points, const Grid& grid)
    : values_(values), coordinates_(points) {
    use_one_vtk_thread();
    const test::CellArrays cells = test::whole_cells(mesh);
    grid_ = test::vtk_grid(test::vtk_points(mesh.points), cells.types, cells.ends, cells.nodes, "field", values);
    points_->SetPoints(test::vtk_points(points));
    image_->SetDimensions(static_cast<int>(grid.counts[0]), static_cast<int>(grid.counts[1]),
                          static_cast<int>(grid.counts[2]));
    image_->SetOrigin(grid.origin.data());
    image_->SetSpacing(grid.spacing.data());
}

std::size_t Vtk::build(Which which) {
    const std::size_t before = handed_out();
    auto made = new_locator(which);
    made->SetDataSet(grid_);
    made->BuildLocator();
    locator(which) = made;
    return handed_out() - before;
}

void Vtk::find(Which which, std::vector<Mesh::Index>& cells) {
    find_all(which, coordinates_, cells);
}

void Vtk::find_all(Which which, std::span<const double> points, std::vector<Mesh::Index>& cells) {
    cells.resize(points.size() / 3);
    for_found(which, points, [&](std::size_t i, vtkIdType found, vtkGenericCell*, const double*) {
        cells[i] = static_cast<Mesh::Index>(found);
    });
}

void Vtk::interpolate(Which which, std::vector<double>& values) {
    values.resize(coordinates_.size() / 3);
    for_found(which, coordinates_, [&](std::size_t i, vtkIdType found, vtkGenericCell* cell, const double* weights) {
        double sum = 0;
        for (int k = 0; found >= 0 && k < cell->GetNumberOfPoints(); ++k)
            sum += weights[k] * values_[static_cast<std::size_t>(cell->GetPointId(k))];
        values[i] = found >= 0 ? sum : std::numeric_limits<double>::quiet_NaN();
    });
}

void Vtk::set_image(std::vector<double>& values) {
    vtkNew<vtkDoubleArray> field;
    field->SetName("field");
    field->SetArray(values.data(), static_cast<vtkIdType>(values.size()), 1);
    image_->GetPointData()->SetScalars(field);
}

std::vector<double> Vtk::probed() const {
    if (!probed_) return {};
    vtkDataArray* const field = probed_->GetPointData()->GetArray("field");
    vtkDataArray* const mask = probed_->GetPointData()->GetArray("vtkValidPointMask");
    if (field == nullptr || mask == nullptr) return {};
    std::vector<double> values(static_cast<std::size_t>(field->GetNumberOfTuples()));
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto id = static_cast<vtkIdType>(i);
        values[i] = mask->GetTuple1(id) != 0 ? field->GetTuple1(id) : std::numeric_limits<double>::quiet_NaN();
    }
    return values;
}

}  // namespace

std::unique_ptr<VtkPeer> make_vtk_peer(const Mesh& mesh, const std::vector<double>& values,
                                       std::span<const double> points, const Grid& grid) {
    return std::make_unique<Vtk>(mesh, values, points, grid);
}

}  // namespace barycert::bench
