/// What a check found, as VTK's arrays, tables and points.
#pragma once

#include <string>

#include "barycert/check.hpp"
#include "vtk/exact_index.hpp"

class vtkPolyData;
class vtkTable;

namespace barycert::in_vtk {

/// Adds measures and defects of cells as cell arrays of the data set.
void add_measures(const CheckReport& report, const ExactIndex& index, vtkDataSet& output);

/// Adds a field array of strings, one a line of the text.
void add_lines(const char* name, const std::string& text, vtkDataSet& output);

/// A row a defect.
void fill_defects(const CheckReport& report, const ExactIndex& index, vtkTable& table);

/// A vertex for each pair of cells that meet where they must not.
void fill_contacts(const CheckReport& report, const ExactIndex& index, vtkPolyData& points);

}  // namespace barycert::in_vtk
