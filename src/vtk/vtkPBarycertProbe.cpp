#include "vtkPBarycertProbe.h"

#include <string>

#include <vtkCharArray.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataSet.h>
#include <vtkErrorCode.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiProcessController.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include "vtk/distributed_probe.hpp"
#include "vtk/failing_upstream.hpp"

using namespace barycert;

vtkStandardNewMacro(vtkPBarycertProbe);
vtkCxxSetObjectMacro(vtkPBarycertProbe, Controller, vtkMultiProcessController);

vtkPBarycertProbe::vtkPBarycertProbe() {
    SetController(vtkMultiProcessController::GetGlobalController());
}

vtkPBarycertProbe::~vtkPBarycertProbe() {
    SetController(nullptr);
}

void vtkPBarycertProbe::PrintSelf(ostream& os, vtkIndent indent) {
    Superclass::PrintSelf(os, indent);
    os << indent << "Controller: " << Controller << "\n"
       << indent << "PointsSent: " << PointsSent << "\n"
       << indent << "PointsReceived: " << PointsReceived << "\n"
       << indent << "BytesSent: " << BytesSent << "\n"
       << indent << "BytesGathered: " << BytesGathered << "\n"
       << indent << "NumberOfPartners: " << NumberOfPartners << "\n";
}

vtkExecutive* vtkPBarycertProbe::CreateDefaultExecutive() {
    return in_vtk::FailingUpstream::New();
}

// A process may have no piece. Composite data sets are refused here: an executive that knows them, as ParaView's, takes
// apart what a filter does not.
int vtkPBarycertProbe::FillInputPortInformation(int port, vtkInformation* info) {
    if (port == 1) info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
    if (Superclass::FillInputPortInformation(port, info) == 0) return 0;
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
    return 1;
}

// Where there is no data set that the output could be like, something takes its place, for all tell of the error.
int vtkPBarycertProbe::RequestDataObject(vtkInformation* request, vtkInformationVector** inputs,
                                         vtkInformationVector* outputs) {
    if (vtkCompositeDataSet::GetData(inputs[0]) == nullptr)
        return Superclass::RequestDataObject(request, inputs, outputs);
    outputs->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), vtkNew<vtkPolyData>());
    return 1;
}

int vtkPBarycertProbe::RequestInformation(vtkInformation* request, vtkInformationVector** inputs,
                                          vtkInformationVector* outputs) {
    if (inputs[1]->GetNumberOfInformationObjects() == 0) return 1;
    return Superclass::RequestInformation(request, inputs, outputs);
}

// The piece of the source goes with the piece of the output, as that of the input does. Ghosts are not needed.
int vtkPBarycertProbe::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs,
                                           vtkInformationVector* outputs) {
    using Pipeline = vtkStreamingDemandDrivenPipeline;
    vtkInformation* const source = inputs[1]->GetInformationObject(0);
    vtkInformation* const out = outputs->GetInformationObject(0);
    if (source == nullptr) return 1;
    for (vtkInformationIntegerKey* const key : {Pipeline::UPDATE_PIECE_NUMBER(), Pipeline::UPDATE_NUMBER_OF_PIECES()})
        if (out->Has(key) != 0) source->Set(key, out->Get(key));
    source->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    return 1;
}

int vtkPBarycertProbe::RequestData(vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) {
    vtkDataSet* const input = vtkDataSet::GetData(inputs[0]);
    vtkDataSet* const source = vtkDataSet::GetData(inputs[1]);
    vtkDataSet* const output = vtkDataSet::GetData(outputs);
    GetValidPoints()->Reset();
    SetErrorCode(vtkErrorCode::NoError);
    Status ready = Done{};
    const auto* const pipeline = dynamic_cast<in_vtk::FailingUpstream*>(GetExecutive());
    if (pipeline != nullptr && !pipeline->failure().empty())
        ready = Error{.what = "what comes before this filter failed: " + pipeline->failure()};
    else if (vtkCompositeDataSet::GetData(inputs[0]) != nullptr || vtkCompositeDataSet::GetData(inputs[1]) != nullptr)
        ready = Error{.what = "this filter takes no composite data sets", .remedy = "merge the blocks before"};
    else if (input == nullptr || output == nullptr)
        ready = Error{.what = "the input is missing"};
    else
        output->CopyStructure(input);

    if (ready && !GetComputeTolerance() && GetTolerance() > 0)
        ready = Error{.what = "this filter has no Tolerance: points are inside the mesh or not",
                      .remedy = "leave ComputeTolerance on"};
    in_vtk::Processes processes(Controller);
    pieces::Exchange exchange(processes);
    in_vtk::ProbeReport report;
    const Status done = in_vtk::probe_pieces(
        exchange, {.categorical = GetCategoricalData() != 0, .outside = OutsideValue(), .mask = MaskName()}, ready,
        input, source, output, report);
    PointsSent = static_cast<vtkIdType>(report.points_sent);
    PointsReceived = static_cast<vtkIdType>(report.points_received);
    BytesSent = static_cast<vtkIdType>(exchange.sent());
    BytesGathered = static_cast<vtkIdType>(exchange.gathered());
    NumberOfPartners = static_cast<int>(exchange.partners().size());
    Exact = done.has_value();
    if (!done) {
        if (output != nullptr) output->Initialize();
        SetErrorCode(vtkErrorCode::UserError);
        vtkErrorMacro("" << done.error().message());
        return 0;
    }
    WarnOfInexact(report.inexact);
    if (report.numbered_by_ranks && exchange.rank() == 0)
        vtkWarningMacro(
            "the cells of some source have no global ids: they are numbered by process, and owners of points on seams "
            "depend on how the mesh is cut");
    ListValidPoints(*report.mask);
    PassArrays(input, output);
    return 1;
}
