#include "vtk/check_arrays.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSignedCharArray.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedIntArray.h>

namespace barycert::in_vtk {

namespace {

template <class Array>
vtkSmartPointer<Array> named(const char* name) {
    auto array = vtkSmartPointer<Array>::New();
    array->SetName(name);
    return array;
}

// One value a cell of the data set: of(i) for cell i of the mesh, `other` for cells that are not in it.
template <class Array, class T, class Of>
void add_cell_array(vtkDataSet& output, const ExactIndex& index, const char* name, T other, Of&& of) {
    const auto array = named<Array>(name);
    array->SetNumberOfValues(output.GetNumberOfCells());
    array->Fill(static_cast<double>(other));
    for (std::size_t i = 0; i < index.mesh.cell_count(); ++i)
        array->SetValue(index.id(static_cast<Mesh::Index>(i)), static_cast<T>(of(i)));
    output.GetCellData()->AddArray(array);
}

template <std::size_t n, class IdOf>
void append_used(std::string& text, const char* one, const char* more, const std::array<Mesh::Index, n>& all,
                 IdOf&& id_of) {
    const auto count = std::count_if(all.begin(), all.end(), [](Mesh::Index i) { return i >= 0; });
    if (count == 0) return;
    if (!text.empty() && text.back() != ' ') text += ", ";
    text += count == 1 ? one : more;
    for (const Mesh::Index i : all)
        if (i >= 0) text += ' ' + std::to_string(id_of(i));
}

// "cells 3 17, points 4 5 6; ...".
std::string places_of(const Defect& defect, const ExactIndex& index) {
    std::string all;
    for (const DefectPlace& place : defect.places) {
        std::string text;
        append_used(text, "cell", "cells", place.cells, [&](Mesh::Index cell) { return index.id(cell); });
        append_used(text, "point", "points", place.nodes, [](Mesh::Index node) { return vtkIdType{node}; });
        const bool hangs = defect.kind == DefectKind::hanging_node || defect.kind == DefectKind::near_hanging;
        const char* const word = hangs ? "on" : "and";
        append_used(text, word, word, place.other_nodes, [](Mesh::Index node) { return vtkIdType{node}; });
        if (*place.detail != '\0') text += std::string(" (") + place.detail + ")";
        if (!all.empty()) all += "; ";
        all += text;
    }
    return all;
}

}  // namespace

void add_measures(const CheckReport& report, const ExactIndex& index, vtkDataSet& output) {
    const CellMeasures& measures = report.measures;
    for (const Field& field : measure_fields(measures)) {
        const char* const name = field.name.c_str();
        const auto value = [&](std::size_t i) { return field.data[i]; };
        if (field.name == "orientation")
            add_cell_array<vtkSignedCharArray, signed char>(output, index, name, 0, value);
        else if (field.name == "problems")
            add_cell_array<vtkUnsignedIntArray, unsigned int>(output, index, name, 0, value);
        else
            add_cell_array<vtkDoubleArray>(output, index, name, std::numeric_limits<double>::quiet_NaN(), value);
    }
    DefectSet found = 0;
    for (const DefectSet some : measures.defects) found |= some;
    for (const DefectText& text : defect_texts) {
        const DefectSet bit = defect_bit(text.kind);
        if ((found & bit) == 0) continue;
        add_cell_array<vtkUnsignedCharArray, unsigned char>(
            output, index, std::string(text.name).c_str(), 0,
            [&](std::size_t i) { return (measures.defects[i] & bit) != 0; });
    }
}

void add_lines(const char* name, const std::string& text, vtkDataSet& output) {
    const auto lines = named<vtkStringArray>(name);
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines->InsertNextValue(line);
    output.GetFieldData()->AddArray(lines);
}

void fill_defects(const CheckReport& report, const ExactIndex& index, vtkTable& table) {
    const auto defect = named<vtkStringArray>("defect");
    const auto count = named<vtkTypeInt64Array>("count");
    const auto at_least = named<vtkUnsignedCharArray>("at_least");
    const auto breaks = named<vtkUnsignedCharArray>("breaks");
    const auto meaning = named<vtkStringArray>("meaning");
    const auto remedy = named<vtkStringArray>("remedy");
    const auto places = named<vtkStringArray>("places");
    for (const Defect& found : report.defects) {
        const DefectText& text = defect_text(found.kind);
        defect->InsertNextValue(std::string(text.name));
        count->InsertNextValue(static_cast<vtkTypeInt64>(found.count));
        at_least->InsertNextValue(found.at_least ? 1 : 0);
        breaks->InsertNextValue(found.breaks() ? 1 : 0);
        meaning->InsertNextValue(std::string(text.text));
        remedy->InsertNextValue(std::string(found.remedy()));
        places->InsertNextValue(places_of(found, index));
    }
    for (vtkAbstractArray* const column :
         {static_cast<vtkAbstractArray*>(defect), static_cast<vtkAbstractArray*>(count),
          static_cast<vtkAbstractArray*>(at_least), static_cast<vtkAbstractArray*>(breaks),
          static_cast<vtkAbstractArray*>(meaning), static_cast<vtkAbstractArray*>(remedy),
          static_cast<vtkAbstractArray*>(places)})
        table.AddColumn(column);
}

void fill_contacts(const CheckReport& report, const ExactIndex& index, vtkPolyData& points) {
    vtkNew<vtkPoints> places;
    places->SetDataTypeToDouble();
    vtkNew<vtkCellArray> vertices;
    const auto cell_a = named<vtkIdTypeArray>("cell_a"), cell_b = named<vtkIdTypeArray>("cell_b");
    const auto overlap = named<vtkUnsignedCharArray>("overlap"), exact = named<vtkUnsignedCharArray>("exact");
    for (const CellContact& contact : report.contacts) {
        std::array<double, 3> x{};
        if (index.normal >= 0) x[static_cast<std::size_t>(index.axes[2])] = index.plane;
        for (std::size_t a = 0; a < static_cast<std::size_t>(index.mesh.dimension); ++a)
            x[static_cast<std::size_t>(index.axes[a])] = contact.common.point[a];
        const vtkIdType at = places->InsertNextPoint(x.data());
        vertices->InsertNextCell(1, &at);
        cell_a->InsertNextValue(index.id(contact.cells[0]));
        cell_b->InsertNextValue(index.id(contact.cells[1]));
        overlap->InsertNextValue(contact.overlap ? 1 : 0);
        exact->InsertNextValue(contact.common.exact ? 1 : 0);
    }
    points.SetPoints(places);
    points.SetVerts(vertices);
    for (vtkDataArray* const array : {static_cast<vtkDataArray*>(cell_a), static_cast<vtkDataArray*>(cell_b),
                                      static_cast<vtkDataArray*>(overlap), static_cast<vtkDataArray*>(exact)})
        points.GetPointData()->AddArray(array);
}

}  // namespace barycert::in_vtk
