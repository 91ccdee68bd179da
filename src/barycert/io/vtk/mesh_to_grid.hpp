/// VTK data sets on the memory of meshes and fields. Includes VTK.
#pragma once

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <span>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

/// Whether names are to stand in XML attributes.
enum class Names : bool { any, xml };

/// What is wrong with the mesh or the names of its fields, in one clause; empty if nothing is.
std::string fault_of_mesh(const Mesh& mesh, Names names);

/// Empty if every name can be written and is the only one of its kind, `others` among them: VTK keeps but one array of
/// a name.
std::string fault_of_names(const std::vector<Field>& fields, std::vector<std::string> others, Names names);

/// That `what` ("the mesh") cannot be written because of that fault.
Error cannot_write(const std::string& what, const std::string& fault, const std::string& path);

/// An array of VTK's on memory that it neither frees nor writes to: its interface knows no const.
vtkSmartPointer<vtkDoubleArray> view_of(std::span<const double> values, int components);

/// Points of 3 coordinates: a view, or in dimension 2 a copy with z = 0.
vtkSmartPointer<vtkPoints> points_of(std::span<const double> points, int dimension);

/// Adds the fields under their names, escaped if they are to stand in XML attributes, which VTK 9.1 writes as given.
void add_fields(vtkFieldData* data, const std::vector<Field>& fields, Names names);

/// Points, cells, fields and markers. The mesh must be without fault and outlive the grid.
vtkSmartPointer<vtkUnstructuredGrid> grid_of(const Mesh& mesh, Names names);

/// True if offsets into the list of nodes do not fit in 32 bits.
bool needs_wide_indices(const Mesh& mesh);

}  // namespace barycert::io
