#include "vtkBarycertCheck.h"

#include <iterator>
#include <sstream>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataObjectTypes.h>
#include <vtkDoubleArray.h>
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

#include "barycert/report.hpp"
#include "vtk/exact_index.hpp"

using namespace barycert;

namespace {

using in_vtk::ExactIndex;

// An array of one value for each of `all`: of(one).
template <class Array, class All, class Of = std::identity>
void add_array(vtkFieldData& to, std::string_view name, const All& all, const Of& of = {}) {
    vtkNew<Array> array;
    array->SetName(std::string(name).c_str());
    array->Allocate(static_cast<vtkIdType>(std::size(all)));
    for (const auto& one : all) array->InsertNextValue(of(one));
    to.AddArray(array);
}

void append_used(std::string& text, const char* one, const char* more, std::span<const Mesh::Index> all) {
    const auto count = std::count_if(all.begin(), all.end(), [](Mesh::Index i) { return i >= 0; });
    if (count == 0) return;
    if (!text.empty() && text.back() != ' ') text += ", ";
    text += count == 1 ? one : more;
    for (const Mesh::Index i : all)
        if (i >= 0) text += ' ' + std::to_string(i);
}

// "cells 3 17, points 4 5 6; ...".
std::string places_of(const Defect& defect, const CheckReport& report) {
    std::string all;
    for (const DefectPlace& place : defect.places) {
        std::string text;
        append_used(text, "cell", "cells", report.cell_number(place.cells));
        append_used(text, "point", "points", place.nodes);
        const bool hangs = defect.kind == DefectKind::hanging_node || defect.kind == DefectKind::near_hanging ||
                           defect.kind == DefectKind::node_on_facet;
        const char* const word = hangs ? "on" : "and";
        append_used(text, word, word, place.other_nodes);
        if (*place.detail != '\0') text += std::string(" (") + place.detail + ")";
        if (!all.empty()) all += "; ";
        all += text;
    }
    return all;
}

// Joins a measure of two parts of a cell.
double joined(std::string_view measure, double a, double b) {
    if (measure == "orientation") return a == b ? a : 0;
    if (measure == "volume") return a + b;
    return measure == "min_angle" ? std::min(a, b) : std::max(a, b);
}

// Measures and defects of cells as cell arrays of the data set, of which one may be several of the mesh or surface.
void add_measures(const CheckReport& report, vtkDataSet& output) {
    vtkCellData& cells = *output.GetCellData();
    std::vector<DefectSet> defects(static_cast<std::size_t>(output.GetNumberOfCells()), 0);
    const auto id_of = [&](std::size_t i) {
        return static_cast<std::size_t>(report.cell_number(static_cast<std::int64_t>(i)));
    };
    DefectSet found = 0;
    for (std::size_t i = 0; i < report.measures.defects.size(); ++i) {
        defects[id_of(i)] |= report.measures.defects[i];
        found |= report.measures.defects[i];
    }
    for (const Field& field : report.surface ? std::vector<Field>() : measure_fields(report.measures)) {
        std::vector<std::optional<double>> all(defects.size());
        for (std::size_t i = 0; i < field.data.size(); ++i) {
            std::optional<double>& own = all[id_of(i)];
            own = own ? joined(field.name, *own, field.data[i]) : field.data[i];
        }
        using Value = const std::optional<double>&;
        if (field.name == "orientation")
            add_array<vtkSignedCharArray>(cells, field.name, all,
                                          [](Value x) { return static_cast<signed char>(x.value_or(0)); });
        else if (field.name == "problems")
            add_array<vtkUnsignedIntArray>(cells, field.name, defects,
                                           [](DefectSet set) { return static_cast<unsigned>(set); });
        else
            add_array<vtkDoubleArray>(cells, field.name, all,
                                      [](Value x) { return x.value_or(std::numeric_limits<double>::quiet_NaN()); });
    }
    // Kinds of defects of surfaces are beyond 32 bits.
    if (report.surface)
        add_array<vtkTypeInt64Array>(cells, "problems", defects, [](DefectSet set) { return vtkTypeInt64(set); });
    for (const DefectText& text : defect_texts) {
        const DefectSet bit = defect_bit(text.kind);
        if ((found & bit) != 0)
            add_array<vtkUnsignedCharArray>(cells, text.name, defects, [&](DefectSet set) { return (set & bit) != 0; });
    }
}

// A row a defect.
void fill_defects(const CheckReport& report, vtkFieldData& columns) {
    using D = const Defect&;
    const std::vector<Defect>& all = report.defects;
    add_array<vtkStringArray>(columns, "defect", all, [](D d) { return std::string(defect_text(d.kind).name); });
    add_array<vtkTypeInt64Array>(columns, "count", all, [](D d) { return vtkTypeInt64(d.count); });
    add_array<vtkUnsignedCharArray>(columns, "at_least", all, [](D d) { return d.at_least; });
    add_array<vtkUnsignedCharArray>(columns, "breaks", all, [](D d) { return d.breaks(); });
    add_array<vtkStringArray>(columns, "meaning", all, [](D d) { return std::string(defect_text(d.kind).text); });
    add_array<vtkStringArray>(columns, "remedy", all, [](D d) { return std::string(d.remedy()); });
    add_array<vtkStringArray>(columns, "places", all, [&](D d) { return places_of(d, report); });
}

// A vertex for each pair of cells that meet where they must not.
void fill_contacts(const CheckReport& report, const ExactIndex& index, vtkPolyData& points) {
    const std::vector<CellContact>& all = report.contacts;
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
    add_array<vtkIdTypeArray>(data, "cell_a", all, [&](Contact c) { return report.cell_number(c.cells)[0]; });
    add_array<vtkIdTypeArray>(data, "cell_b", all, [&](Contact c) { return report.cell_number(c.cells)[1]; });
    add_array<vtkUnsignedCharArray>(data, "overlap", all, [](Contact c) { return c.overlap; });
    add_array<vtkUnsignedCharArray>(data, "exact", all, [](Contact c) { return c.common.exact; });
}

// The report names cells by their ids. Polygons in space are facets of a PLC, as `barycert check` takes those of files:
// they may be at fault themselves. Its numbers are those of the triangles that they are cut into, and of what cannot
// be.
CheckReport check(vtkDataSet& data, const ExactIndex& index, const CheckOptions& options) {
    if (!index.in_space()) return check_mesh(index.mesh, options);
    Plc plc;
    std::vector<Mesh::Index> numbers = in_vtk::read_polygons(data, plc), ids;
    const bool polygons = !plc.facets.empty();
    if (!polygons) numbers = index.surface.facets;
    CheckReport report = polygons ? check_plc(plc, options) : check_surface(index.surface, options);
    for (std::size_t i = 0; polygons && i < report.cells; ++i)
        ids.push_back(numbers[static_cast<std::size_t>(report.cell_number(static_cast<std::int64_t>(i)))]);
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    if (!numbers.empty()) report.surface->facets = numbers.size();
    if (!polygons) return report;
    report.cell_numbers = ids;
    std::set_difference(numbers.begin(), numbers.end(), ids.begin(), ids.end(),
                        std::back_inserter(report.cell_numbers));
    report.measures.defects.resize(report.cell_numbers.size(), defect_bit(DefectKind::bad_facet));
    return report;
}

}  // namespace

vtkStandardNewMacro(vtkBarycertCheck);

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
    if (const std::string reason = in_vtk::read_cells(*input, index); !reason.empty()) {
        vtkErrorMacro("this data set cannot be checked: " << reason);
        return 0;
    }
    CheckReport report = check(*input, index,
                               {.delaunay = Delaunay != 0,
                                .examples = static_cast<std::size_t>(Examples),
                                .contacts = static_cast<std::size_t>(Contacts)});
    report.notes.insert(report.notes.begin(), index.notes.begin(), index.notes.end());
    Certified = report.certified();
    if (report.surface && Delaunay != 0) vtkWarningMacro("a surface is not tested whether it is Delaunay");

    output->ShallowCopy(input);
    add_measures(report, *output);
    output->GetCellData()->SetActiveScalars("problems");
    const Mesh none;
    const std::string text = check_text(report, report.surface ? none : std::as_const(index.mesh), "input", {});
    for (const Note& note : report.notes) vtkWarningMacro("" << message(note));
    if (report.curved.cells != 0) vtkWarningMacro("" << message(report.curved));
    // The verdict stands below what is told of curved cells, which takes two lines.
    std::size_t verdict = 0;
    for (int line = 0; line < (message(report.curved).empty() ? 0 : 2); ++line) verdict = text.find('\n', verdict) + 1;
    if (!Certified) vtkWarningMacro("" << text.substr(verdict, text.find('\n', verdict) - verdict));
    std::istringstream in(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    vtkFieldData& told = *output->GetFieldData();
    add_array<vtkStringArray>(told, "barycert_check", lines);
    add_array<vtkUnsignedCharArray>(told, "certified", std::array{Certified});
    fill_defects(report, *defects->GetRowData());
    fill_contacts(report, index, *points);
    return 1;
}
