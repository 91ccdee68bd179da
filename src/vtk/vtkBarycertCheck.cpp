#include "vtkBarycertCheck.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataObjectTypes.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
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

#include "barycert/check.hpp"
#include "barycert/report.hpp"
#include "vtk/exact_index.hpp"

using namespace barycert;

namespace {

using in_vtk::ExactIndex;

// One value for each of `all`: of(one).
template <class Array, class All, class Of>
vtkSmartPointer<Array> array_of(const char* name, const All& all, Of&& of) {
    auto array = vtkSmartPointer<Array>::New();
    array->SetName(name);
    for (const auto& one : all) array->InsertNextValue(of(one));
    return array;
}

// One value a cell of the data set: of(i) for cell i of the mesh, `other` for cells that are not in it.
template <class Array, class Of>
void add_cell_array(vtkDataSet& output, const ExactIndex& index, std::string_view name, Of&& of, double other = 0) {
    vtkNew<Array> array;
    array->SetName(std::string(name).c_str());
    array->SetNumberOfValues(output.GetNumberOfCells());
    array->Fill(other);
    for (std::size_t i = 0; i < index.mesh.cell_count(); ++i)
        array->SetValue(index.id(static_cast<Mesh::Index>(i)), static_cast<typename Array::ValueType>(of(i)));
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

// Measures and defects of cells as cell arrays of the data set.
void add_measures(const CheckReport& report, const ExactIndex& index, vtkDataSet& output) {
    const CellMeasures& measures = report.measures;
    for (const Field& field : measure_fields(measures)) {
        const auto value = [&](std::size_t i) { return field.data[i]; };
        if (field.name == "orientation")
            add_cell_array<vtkSignedCharArray>(output, index, field.name, value);
        else if (field.name == "problems")
            add_cell_array<vtkUnsignedIntArray>(output, index, field.name, value);
        else
            add_cell_array<vtkDoubleArray>(output, index, field.name, value, std::numeric_limits<double>::quiet_NaN());
    }
    DefectSet found = 0;
    for (const DefectSet some : measures.defects) found |= some;
    for (const DefectText& text : defect_texts) {
        const DefectSet bit = defect_bit(text.kind);
        if ((found & bit) != 0)
            add_cell_array<vtkUnsignedCharArray>(output, index, text.name,
                                                 [&](std::size_t i) { return (measures.defects[i] & bit) != 0; });
    }
}

// A row a defect.
void fill_defects(const std::vector<Defect>& all, const ExactIndex& index, vtkTable& table) {
    using D = const Defect&;
    table.AddColumn(array_of<vtkStringArray>("defect", all, [](D d) { return std::string(defect_text(d.kind).name); }));
    table.AddColumn(array_of<vtkTypeInt64Array>("count", all, [](D d) { return vtkTypeInt64(d.count); }));
    table.AddColumn(array_of<vtkUnsignedCharArray>("at_least", all, [](D d) { return d.at_least; }));
    table.AddColumn(array_of<vtkUnsignedCharArray>("breaks", all, [](D d) { return d.breaks(); }));
    table.AddColumn(
        array_of<vtkStringArray>("meaning", all, [](D d) { return std::string(defect_text(d.kind).text); }));
    table.AddColumn(array_of<vtkStringArray>("remedy", all, [](D d) { return std::string(d.remedy()); }));
    table.AddColumn(array_of<vtkStringArray>("places", all, [&](D d) { return places_of(d, index); }));
}

// A vertex for each pair of cells that meet where they must not.
void fill_contacts(const std::vector<CellContact>& all, const ExactIndex& index, vtkPolyData& points) {
    vtkNew<vtkPoints> places;
    places->SetDataTypeToDouble();
    vtkNew<vtkCellArray> vertices;
    for (const CellContact& contact : all) {
        std::array<double, 3> x{};
        index.place(contact.common.point.data(), x.data());
        const vtkIdType at = places->InsertNextPoint(x.data());
        vertices->InsertNextCell(1, &at);
    }
    points.SetPoints(places);
    points.SetVerts(vertices);
    using Contact = const CellContact&;
    vtkPointData& data = *points.GetPointData();
    data.AddArray(array_of<vtkIdTypeArray>("cell_a", all, [&](Contact c) { return index.id(c.cells[0]); }));
    data.AddArray(array_of<vtkIdTypeArray>("cell_b", all, [&](Contact c) { return index.id(c.cells[1]); }));
    data.AddArray(array_of<vtkUnsignedCharArray>("overlap", all, [](Contact c) { return c.overlap; }));
    data.AddArray(array_of<vtkUnsignedCharArray>("exact", all, [](Contact c) { return c.common.exact; }));
}

}  // namespace

vtkStandardNewMacro(vtkBarycertCheck);

vtkBarycertCheck::vtkBarycertCheck() {
    SetNumberOfOutputPorts(3);
}

void vtkBarycertCheck::PrintSelf(ostream& os, vtkIndent indent) {
    Superclass::PrintSelf(os, indent);
    os << indent << "Delaunay: " << (Delaunay != 0 ? "On" : "Off") << "\n"
       << indent << "Examples: " << Examples << "\n"
       << indent << "Contacts: " << Contacts << "\n"
       << indent << "Certified: " << (Certified ? "yes" : "no") << "\n";
}

vtkTable* vtkBarycertCheck::GetDefects() {
    return vtkTable::SafeDownCast(GetOutputDataObject(1));
}

vtkPolyData* vtkBarycertCheck::GetCommonPoints() {
    return vtkPolyData::SafeDownCast(GetOutputDataObject(2));
}

int vtkBarycertCheck::FillOutputPortInformation(int port, vtkInformation* info) {
    info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkDataSet" : port == 1 ? "vtkTable" : "vtkPolyData");
    return 1;
}

// The base class would make every output of the type of the input.
int vtkBarycertCheck::RequestDataObject(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) {
    vtkDataSet* const input = vtkDataSet::GetData(inputs[0]);
    if (input == nullptr) return 0;
    const std::array<int, 3> types{input->GetDataObjectType(), VTK_TABLE, VTK_POLY_DATA};
    for (int port = 0; port < 3; ++port) {
        const int type = types[static_cast<std::size_t>(port)];
        vtkDataObject* const now = vtkDataObject::GetData(outputs, port);
        if (now != nullptr && now->GetDataObjectType() == type) continue;
        const auto made = vtkSmartPointer<vtkDataObject>::Take(vtkDataObjectTypes::NewDataObject(type));
        outputs->GetInformationObject(port)->Set(vtkDataObject::DATA_OBJECT(), made);
    }
    return 1;
}

int vtkBarycertCheck::RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) {
    vtkDataSet* const input = vtkDataSet::GetData(inputs[0]);
    vtkDataSet* const output = vtkDataSet::GetData(outputs, 0);
    vtkTable* const defects = vtkTable::GetData(outputs, 1);
    vtkPolyData* const points = vtkPolyData::GetData(outputs, 2);
    Certified = false;
    if (input == nullptr || output == nullptr || defects == nullptr || points == nullptr) {
        vtkErrorMacro("the input is missing");
        return 0;
    }
    ExactIndex index;
    if (const std::string reason = in_vtk::read_simplices(*input, index, {}, in_vtk::Sides::straight);
        !reason.empty()) {
        vtkErrorMacro("this data set cannot be checked: "
                      << reason << "; expected tetrahedra, or triangles in one plane across an axis");
        return 0;
    }
    // The report's text names cells by their ids.
    index.mesh.cell_numbers.assign(index.ids.begin(), index.ids.end());
    const CheckReport report = check_mesh(index.mesh, {.delaunay = Delaunay != 0,
                                                       .examples = static_cast<std::size_t>(Examples),
                                                       .contacts = static_cast<std::size_t>(Contacts)});
    Certified = report.certified();

    output->ShallowCopy(input);
    add_measures(report, index, *output);
    output->GetCellData()->SetActiveScalars("problems");
    const std::string text = check_text(report, index.mesh, "input", {});
    if (report.curved.cells != 0) vtkWarningMacro("" << message(report.curved));
    // The verdict stands below what is told of curved cells, which takes two lines.
    std::size_t verdict = 0;
    for (int line = 0; line < (message(report.curved).empty() ? 0 : 2); ++line) verdict = text.find('\n', verdict) + 1;
    if (!Certified) vtkWarningMacro("" << text.substr(verdict, text.find('\n', verdict) - verdict));
    vtkNew<vtkStringArray> lines;
    lines->SetName("barycert_check");
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines->InsertNextValue(line);
    vtkFieldData& told = *output->GetFieldData();
    told.AddArray(lines);
    told.AddArray(array_of<vtkUnsignedCharArray>("certified", std::array{Certified}, std::identity()));
    fill_defects(report.defects, index, *defects);
    fill_contacts(report.contacts, index, *points);
    return 1;
}
