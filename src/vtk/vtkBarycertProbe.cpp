#include "vtkBarycertProbe.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

#include <vtkCellData.h>
#include <vtkCharArray.h>
#include <vtkDataSet.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkProbeFilter.h>
#include <vtkStaticCellLocator.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include "barycert/environment.hpp"
#include "barycert/grid.hpp"
#include "vtk/exact_index.hpp"
#include "vtk/probe_arrays.hpp"
#include "vtk/probe_points.hpp"

using namespace barycert;

namespace {

Status sample_grid(const Sampler& sampler, const Grid& grid, const SampleOptions& options,
                   in_vtk::ProbeArrays& arrays) {
    const auto nx = static_cast<std::uint64_t>(grid.counts[0]), ny = static_cast<std::uint64_t>(grid.counts[1]);
    const Result<SampleCounts> counts = resample(sampler, grid, options, [&](const TableView& rows) -> Status {
        const auto place = [&](std::size_t row, double* point) {
            const std::uint64_t id = rows.first_row + row;
            point[0] = grid.coordinate(0, static_cast<std::int64_t>(id % nx));
            point[1] = grid.coordinate(1, static_cast<std::int64_t>(id / nx % ny));
            point[2] = grid.coordinate(2, static_cast<std::int64_t>(id / nx / ny));
        };
        arrays.write(rows, nullptr, static_cast<vtkIdType>(rows.first_row), place);
        return Done{};
    });
    if (!counts) return counts.error();
    return Done{};
}

// In blocks, so that memory for rows does not grow with the number of points.
Status sample_points(const Sampler& sampler, const in_vtk::ProbePoints& points, const SampleOptions& options,
                     in_vtk::ProbeArrays& arrays) {
    constexpr std::size_t block = std::size_t{1} << 20;
    const auto d = static_cast<std::size_t>(sampler.locator().mesh().dimension);
    const std::size_t count = points.coordinates.size() / d;
    Table rows;
    for (std::size_t first = 0; first < count; first += block) {
        const auto some = points.coordinates.subspan(d * first, d * std::min(block, count - first));
        if (Status done = sampler.sample(some, options, rows, first); !done) return done;
        const auto place = [&](std::size_t row, double* point) { std::copy_n(some.data() + d * row, d, point); };
        const vtkIdType* const ids = points.ids.empty() ? nullptr : points.ids.data() + first;
        arrays.write(rows.view(), ids, static_cast<vtkIdType>(first), place);
    }
    return Done{};
}

}  // namespace

vtkStandardNewMacro(vtkBarycertProbe);

vtkBarycertProbe::vtkBarycertProbe() {
    SetNumberOfInputPorts(2);
    SetValidPointMaskArrayName("vtkValidPointMask");
}

vtkBarycertProbe::~vtkBarycertProbe() {
    delete[] ValidPointMaskArrayName;
}

void vtkBarycertProbe::PrintSelf(ostream& os, vtkIndent indent) {
    Superclass::PrintSelf(os, indent);
    const auto line = [&](const char* name, bool on) { os << indent << name << ": " << (on ? "On" : "Off") << "\n"; };
    line("CategoricalData", CategoricalData != 0);
    line("SpatialMatch", SpatialMatch != 0);
    line("PassCellArrays", PassCellArrays != 0);
    line("PassPointArrays", PassPointArrays != 0);
    line("PassFieldArrays", PassFieldArrays != 0);
    line("ComputeTolerance", ComputeTolerance);
    line("OutsideIsNaN", OutsideIsNaN);
    os << indent << "Tolerance: " << Tolerance << "\n";
    os << indent << "ValidPointMaskArrayName: " << (ValidPointMaskArrayName ? ValidPointMaskArrayName : "(none)")
       << "\n";
    os << indent << "ValidPoints: " << ValidPoints->GetNumberOfTuples() << "\n";
    os << indent << "Exact: " << (Exact ? "yes" : "no") << "\n";
}

void vtkBarycertProbe::SetSourceData(vtkDataObject* source) {
    SetInputData(1, source);
}

void vtkBarycertProbe::SetSourceConnection(vtkAlgorithmOutput* output) {
    SetInputConnection(1, output);
}

vtkDataObject* vtkBarycertProbe::GetSource() {
    return GetNumberOfInputConnections(1) > 0 ? GetInputDataObject(1, 0) : nullptr;
}

vtkIdTypeArray* vtkBarycertProbe::GetValidPoints() {
    return ValidPoints;
}

// The output has the times of the source, whose values it shows.
int vtkBarycertProbe::RequestInformation(vtkInformation* request, vtkInformationVector** inputs,
                                         vtkInformationVector* outputs) {
    using Pipeline = vtkStreamingDemandDrivenPipeline;
    vtkInformation* const source = inputs[1]->GetInformationObject(0);
    vtkInformation* const out = outputs->GetInformationObject(0);
    if (source->Has(Pipeline::TIME_STEPS()) != 0) out->CopyEntry(source, Pipeline::TIME_STEPS());
    if (source->Has(Pipeline::TIME_RANGE()) != 0) out->CopyEntry(source, Pipeline::TIME_RANGE());
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
    vtkDataArray* const scalars = source->GetPointData()->GetScalars();
    if (CategoricalData != 0 && (scalars == nullptr || scalars->GetNumberOfComponents() != 1)) {
        vtkErrorMacro("CategoricalData takes point scalars of one component, of the source");
        return 0;
    }
    const std::shared_ptr<const in_vtk::ExactIndex> index = in_vtk::exact_index(*source);
    Exact = index->exact();
    if (!Exact)
        vtkWarningMacro(
            "not exact with this source, a vtkProbeFilter with a vtkStaticCellLocator answers: " << index->reason);
    if (!(Exact ? Sample(*index, input, source, output) : AskVTK(input, source, output))) return 0;
    PassArrays(input, output);
    return 1;
}

bool vtkBarycertProbe::Sample(const in_vtk::ExactIndex& index, vtkDataSet* input, vtkDataSet* source,
                              vtkDataSet* output) {
    const ExactEnvironment environment;
    const double tolerance = ComputeTolerance ? 0 : Tolerance;
    const vtkIdType count = input->GetNumberOfPoints();
    const char* const mask_name = ValidPointMaskArrayName != nullptr ? ValidPointMaskArrayName : "vtkValidPointMask";
    in_vtk::ProbeArrays arrays(index, *source, *output, count, CategoricalData != 0, mask_name,
                               OutsideIsNaN ? std::numeric_limits<double>::quiet_NaN() : 0);
    for (const std::string& name : arrays.inexact())
        vtkWarningMacro("the point array " << name << " has integers beyond 2^53: they become doubles first");
    if (!index.locator || count == 0) return true;

    SampleOptions options;
    if (tolerance > 0) {
        options.outside = {.kind = Outside::nearest, .limit = tolerance};
        arrays.number_cells();
    }
    const Result<Sampler> sampler = Sampler::build(*index.locator, arrays.choices());
    if (!sampler) {
        vtkErrorMacro("" << sampler.error().message());
        return false;
    }
    const std::optional<Grid> grid = in_vtk::probe_grid(index, *input);
    const Status done = grid ? sample_grid(*sampler, *grid, options, arrays)
                             : sample_points(*sampler, in_vtk::probe_points(index, *input, tolerance), options, arrays);
    if (!done) {
        vtkErrorMacro("" << done.error().message());
        return false;
    }
    const char* const valid = arrays.mask()->GetPointer(0);
    ValidPoints->Allocate(std::count(valid, valid + count, 1));
    for (vtkIdType i = 0; i < count; ++i)
        if (valid[i] != 0) ValidPoints->InsertNextValue(i);
    return true;
}

bool vtkBarycertProbe::AskVTK(vtkDataSet* input, vtkDataSet* source, vtkDataSet* output) {
    vtkNew<vtkProbeFilter> probe;
    vtkNew<vtkStaticCellLocator> locator;
    probe->SetInputData(input);
    probe->SetSourceData(source);
    probe->SetCellLocatorPrototype(locator);
    probe->SetCategoricalData(CategoricalData);
    probe->SetValidPointMaskArrayName(ValidPointMaskArrayName);
    probe->SetComputeTolerance(ComputeTolerance);
    probe->SetTolerance(Tolerance);
    probe->Update();
    output->GetPointData()->ShallowCopy(probe->GetOutput()->GetPointData());
    ValidPoints->DeepCopy(probe->GetValidPoints());
    return true;
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
