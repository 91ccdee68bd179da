/// Meshes as data sets of VTK, and points too.
#pragma once

#include <string>
#include <vector>

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include "barycert/mesh.hpp"
#include "barycert/surface.hpp"

class vtkDataArray;

namespace barycert::testing {

/// Tetrahedra, or triangles at z = plane, with the fields as double arrays.
vtkSmartPointer<vtkUnstructuredGrid> grid_of(const Mesh& mesh, double plane = 0);

/// Triangles with the axes of the plane turned: coordinates x, y of the mesh go to the axes after `normal`.
vtkSmartPointer<vtkPolyData> surface_of(const Mesh& mesh, int normal, double plane);

/// A surface in space.
vtkSmartPointer<vtkPolyData> poly_data_of(const Surface& surface);

/// Points alone, three coordinates each.
vtkSmartPointer<vtkPolyData> points_of(const std::vector<double>& points);

/// Keeps what VTK and classes on it say while one of these lives, and does not print it.
class Messages {
public:
    Messages();
    ~Messages();
    Messages(const Messages&) = delete;
    Messages& operator=(const Messages&) = delete;
    int count(const std::string& part) const;
    std::string all() const;
};

}  // namespace barycert::testing
