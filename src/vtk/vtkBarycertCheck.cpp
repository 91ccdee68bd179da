#include "vtkBarycertCheck.h"

#include <string>

#include <vtkCellData.h>
#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTable.h>
#include <vtkUnsignedCharArray.h>

#include "barycert/check.hpp"
#include "barycert/report.hpp"
#include "vtk/check_arrays.hpp"
#include "vtk/simplices.hpp"
#include "vtk/straight_sides.hpp"

using namespace barycert;

vtkStandardNewMacro(vtkBarycertCheck);

vtkBarycertCheck::vtkBarycertCheck() {
    SetNumberOfOutputPorts(3);
}

vtkBarycertCheck::~vtkBarycertCheck() = default;

void vtkBarycertCheck::PrintSelf(ostream& os, vtkIndent indent) {
    Superclass::PrintSelf(os, indent);
    os << indent << "Delaunay: " << (Delaunay != 0 ? "On" : "Off") << "\n";
    os << indent << "Examples: " << Examples << "\n";
    os << indent << "Contacts: " << Contacts << "\n";
    os << indent << "Certified: " << (Certified ? "yes" : "no") << "\n";
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
    const auto make = [&]<class T>(int port, T* (*create)(vtkDataSet*), const char* type) {
        vtkDataObject* const now = vtkDataObject::GetData(outputs, port);
        if (now != nullptr && now->IsA(type) != 0) return;
        const auto made = vtkSmartPointer<T>::Take(create(input));
        outputs->GetInformationObject(port)->Set(vtkDataObject::DATA_OBJECT(), made);
    };
    make(
        0, +[](vtkDataSet* like) { return like->NewInstance(); }, input->GetClassName());
    make(
        1, +[](vtkDataSet*) { return vtkTable::New(); }, "vtkTable");
    make(
        2, +[](vtkDataSet*) { return vtkPolyData::New(); }, "vtkPolyData");
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
    in_vtk::ExactIndex index;
    std::string reason = in_vtk::read_simplices(*in_vtk::straight_sides(*input), index);
    if (reason.empty()) reason = in_vtk::add_mid_nodes(*input, index.ids, index.mesh);
    if (!reason.empty()) {
        vtkErrorMacro("this data set cannot be checked: "
                      << reason << "; expected tetrahedra, or triangles in one plane across an axis");
        return 0;
    }
    // The report's text names cells by their ids.
    index.mesh.cell_numbers.assign(index.ids.begin(), index.ids.end());
    CheckOptions options;
    options.delaunay = Delaunay != 0;
    options.examples = static_cast<std::size_t>(Examples);
    options.contacts = static_cast<std::size_t>(Contacts);
    const CheckReport report = check_mesh(index.mesh, options);
    Certified = report.certified();

    output->ShallowCopy(input);
    in_vtk::add_measures(report, index, *output);
    output->GetCellData()->SetActiveScalars("problems");
    const std::string text = check_text(report, index.mesh, "input", {});
    if (report.curved.cells != 0) vtkWarningMacro("" << message(report.curved));
    // The verdict stands below what is told of curved cells, which takes two lines.
    std::size_t verdict = 0;
    for (int line = 0; line < (message(report.curved).empty() ? 0 : 2); ++line) verdict = text.find('\n', verdict) + 1;
    if (!Certified) vtkWarningMacro("" << text.substr(verdict, text.find('\n', verdict) - verdict));
    in_vtk::add_lines("barycert_check", text, *output);
    vtkNew<vtkUnsignedCharArray> certified;
    certified->SetName("certified");
    certified->InsertNextValue(Certified ? 1 : 0);
    output->GetFieldData()->AddArray(certified);
    in_vtk::fill_defects(report, index, *defects);
    in_vtk::fill_contacts(report, index, *points);
    return 1;
}
