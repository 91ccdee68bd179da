#include <vtkCellArray.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSelectEnclosedPoints.h>
#include <vtkStaticCellLocator.h>

#include "surface_query_peers.hpp"

namespace barycert::bench {

QueryPeers vtk_peers(const Surface& surface) {
    const auto data = vtkSmartPointer<vtkPolyData>::New();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (std::size_t i = 0; i < surface.points.size(); i += 3) points->InsertNextPoint(&surface.points[i]);
    vtkNew<vtkCellArray> cells;
    for (std::size_t i = 0; i < surface.cells.size(); i += 3) {
        const vtkIdType corners[3] = {surface.cells[i], surface.cells[i + 1], surface.cells[i + 2]};
        cells->InsertNextCell(3, corners);
    }
    data->SetPoints(points);
    data->SetPolys(cells);
    const auto locator = vtkSmartPointer<vtkStaticCellLocator>::New();
    locator->SetDataSet(data);
    QueryPeers peers;
    peers.nearest.push_back({"vtkStaticCellLocator", [data, locator](const auto& at, auto& answers, auto& distances) {
                                 locator->BuildLocator();
                                 vtkNew<vtkGenericCell> cell;
                                 for (std::size_t i = 0; i < answers.size(); ++i) {
                                     double p[3] = {at[3 * i], at[3 * i + 1], at[3 * i + 2]}, closest[3], square = 0;
                                     vtkIdType id = -1;
                                     int sub = 0;
                                     locator->FindClosestPoint(p, closest, cell, id, sub, square);
                                     answers[i] = id;
                                     distances[i] = std::sqrt(square);
                                 }
                             }});
    peers.inside.push_back({"vtkSelectEnclosedPoints", [data](const auto& at, auto& answers, auto&) {
                                vtkNew<vtkSelectEnclosedPoints> select;
                                select->Initialize(data);
                                for (std::size_t i = 0; i < answers.size(); ++i) {
                                    double p[3] = {at[3 * i], at[3 * i + 1], at[3 * i + 2]};
                                    answers[i] = select->IsInsideSurface(p);
                                }
                                select->Complete();
                            }});
    return peers;
}

}  // namespace barycert::bench
