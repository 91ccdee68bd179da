#include "vtkBarycertProbe.h"

#include <vtkCellData.h>
#include <vtkCharArray.h>
#include <vtkDataSet.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include "barycert/environment.hpp"
#include "vtk/probe_arrays.hpp"

using namespace barycert;

vtkStandardNewMacro(vtkBarycertProbe);

vtkBarycertProbe::vtkBarycertProbe() {
    SetNumberOfInputPorts(2);
    vtkBarycertProbe::SetValidPointMaskArrayName("vtkValidPointMask");
}

vtkBarycertProbe::~vtkBarycertProbe() {
    delete[] ValidPointMaskArrayName;
}

void vtkBarycertProbe::PrintSelf(ostream& os, vtkIndent indent) {
    Superclass::PrintSelf(os, indent);
    const std::pair<const char*, bool> settings[] = {{"CategoricalData", CategoricalData != 0},
                                                     {"SpatialMatch", SpatialMatch != 0},
                                                     {"PassCellArrays", PassCellArrays != 0},
                                                     {"PassPointArrays", PassPointArrays != 0},
                                                     {"PassFieldArrays", PassFieldArrays != 0},
                                                     {"ComputeTolerance", ComputeTolerance},
                                                     {"OutsideIsNaN", OutsideIsNaN}};
    for (const auto& [name, on] : settings) os << indent << name << ": " << (on ? "On" : "Off") << "\n";
    os << indent << "Tolerance: " << Tolerance << "\n"
       << indent << "Interpolation: " << Interpolation << "\n"
       << indent << "CurvedCells: " << CurvedCells << "\n"
       << indent << "ValidPointMaskArrayName: " << MaskName() << "\n"
       << indent << "ValidPoints: " << ValidPoints->GetNumberOfTuples() << "\n"
       << indent << "Exact: " << (Exact ? "yes" : "no") << "\n";
}

// The output has the times of the source, whose values it shows.
int vtkBarycertProbe::RequestInformation(vtkInformation* request, vtkInformationVector** inputs,
                                         vtkInformationVector* outputs) {
    using Pipeline = vtkStreamingDemandDrivenPipeline;
    vtkInformation* const source = inputs[1]->GetInformationObject(0);
    vtkInformation* const out = outputs->GetInformationObject(0);
    for (vtkInformationDoubleVectorKey* const key : {Pipeline::TIME_STEPS(), Pipeline::TIME_RANGE()})
        if (source != nullptr && source->Has(key) != 0) out->CopyEntry(source, key);
    return Superclass::RequestInformation(request, inputs, outputs);
}

// All of the source is needed whatever piece of the output is asked for, unless pieces match.
int vtkBarycertProbe::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs,
                                          vtkInformationVector* outputs) {
    using Pipeline = vtkStreamingDemandDrivenPipeline;
    vtkInformation* const source = inputs[1]->GetInformationObject(0);
    vtkInformation* const out = outputs->GetInformationObject(0);
    if (source == nullptr) return 1;
    if (source->Has(Pipeline::WHOLE_EXTENT()) != 0)
        source->Set(Pipeline::UPDATE_EXTENT(), source->Get(Pipeline::WHOLE_EXTENT()), 6);
    const bool match = SpatialMatch != 0 && out->Has(Pipeline::UPDATE_PIECE_NUMBER()) != 0;
    const auto request = [&](vtkInformationIntegerKey* key, int whole) {
        source->Set(key, match && out->Has(key) != 0 ? out->Get(key) : whole);
    };
    request(Pipeline::UPDATE_PIECE_NUMBER(), 0);
    request(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
    request(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    return 1;
}

int vtkBarycertProbe::RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) {
    vtkDataSet* const input = vtkDataSet::GetData(inputs[0]);
    vtkDataSet* const source = vtkDataSet::GetData(inputs[1]);
    vtkDataSet* const output = vtkDataSet::GetData(outputs);
    ValidPoints->Reset();
    if (input == nullptr || source == nullptr || output == nullptr) {
        vtkErrorMacro("input or source is missing");
        return 0;
    }
    output->CopyStructure(input);
    if (!Sample(input, source, output)) return 0;
    PassArrays(input, output);
    return 1;
}

bool vtkBarycertProbe::Sample(vtkDataSet* input, vtkDataSet* source, vtkDataSet* output) {
    const ExactEnvironment environment;
    const std::shared_ptr<const in_vtk::ExactIndex> made =
        in_vtk::exact_index(*source, in_vtk::shape_of(Interpolation, CurvedCells));
    const in_vtk::ExactIndex& index = *made;
    Exact = index.exact();
    if (!Exact) {
        vtkErrorMacro("this source cannot be probed exactly: " << index.reason);
        return false;
    }
    if (const std::string fault = in_vtk::fault_of_arrays(*source, CategoricalData != 0); !fault.empty()) {
        vtkErrorMacro(<< fault);
        return false;
    }
    const double tolerance = ComputeTolerance ? 0 : Tolerance;
    const vtkIdType count = input->GetNumberOfPoints();
    in_vtk::ProbeArrays arrays(index, *source, *output, CategoricalData != 0, MaskName());
    arrays.allocate(count, OutsideValue());
    WarnOfInexact(arrays.inexact());
    for (const Note& note : index.notes) vtkWarningMacro("" << message(note));
    if (index.mesh.cells.empty() || count == 0) return true;

    if (tolerance > 0) arrays.number_cells();
    const Status done = [&]() -> Status {
        if (index.on_surface) return in_vtk::sample_surface(index, *input, tolerance, arrays);
        const Result<Sampler> sampler = Sampler::build(*index.locator, arrays.choices());
        if (!sampler) return sampler.error();
        return in_vtk::sample_data_set(*sampler, index, *input, tolerance, arrays);
    }();
    if (!done) {
        vtkErrorMacro("" << done.error().message());
        return false;
    }
    ListValidPoints(*arrays.mask());
    return true;
}

void vtkBarycertProbe::WarnOfInexact(const std::vector<std::string>& names) {
    for (const std::string& name : names)
        vtkWarningMacro("the point array " << name << " has integers beyond 2^53: they become doubles first");
}

void vtkBarycertProbe::ListValidPoints(vtkCharArray& mask) {
    const vtkIdType count = mask.GetNumberOfTuples();
    const char* const valid = mask.GetPointer(0);
    ValidPoints->Allocate(std::count(valid, valid + count, 1));
    for (vtkIdType i = 0; i < count; ++i)
        if (valid[i] != 0) ValidPoints->InsertNextValue(i);
}

void vtkBarycertProbe::PassArrays(vtkDataSet* input, vtkDataSet* output) {
    const auto pass = [](vtkDataSetAttributes* from, vtkDataSetAttributes* to) {
        for (int i = 0; i < from->GetNumberOfArrays(); ++i) {
            vtkAbstractArray* const array = from->GetAbstractArray(i);
            if (array->GetName() == nullptr || to->HasArray(array->GetName()) == 0) to->AddArray(array);
        }
        for (int role = 0; role < vtkDataSetAttributes::NUM_ATTRIBUTES; ++role) {
            vtkAbstractArray* const array = from->GetAbstractAttribute(role);
            if (array != nullptr && array->GetName() != nullptr && to->GetAbstractAttribute(role) == nullptr)
                to->SetActiveAttribute(array->GetName(), role);
        }
    };
    if (PassPointArrays != 0) pass(input->GetPointData(), output->GetPointData());
    if (PassCellArrays != 0) pass(input->GetCellData(), output->GetCellData());
    // The pipeline has passed field data.
    if (PassFieldArrays == 0) output->GetFieldData()->Initialize();
}
