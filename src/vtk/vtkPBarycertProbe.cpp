#include "vtkPBarycertProbe.h"

#include <map>

#include <vtkAlgorithmOutput.h>
#include <vtkCommand.h>
#include <vtkCompositeDataSet.h>
#include <vtkErrorCode.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include "vtk/distributed_probe.hpp"
#include "vtk/exact_index.hpp"

using namespace barycert;

namespace {

// Whether an algorithm or one before it reports an error. Many readers do nothing else when a file is bad: they return
// success, and an empty data set. Watches from its construction to its end. Errors are shown as if it did not.
class ErrorWatch {
public:
    explicit ErrorWatch(vtkAlgorithm& last) { add(last); }
    ~ErrorWatch() {
        for (const Watched& one : watched_) one.algorithm->RemoveObserver(one.observer);
    }
    ErrorWatch(const ErrorWatch&) = delete;
    ErrorWatch& operator=(const ErrorWatch&) = delete;

    // Who reported the first error, or has an error code; empty if none does.
    std::string error() const {
        if (!first_.empty()) return first_;
        for (const Watched& one : watched_) {
            const unsigned long code = one.algorithm->GetErrorCode();
            if (code != vtkErrorCode::NoError)
                return one.algorithm->GetClassName() + std::string(": ") + vtkErrorCode::GetStringFromErrorCode(code);
        }
        return {};
    }

private:
    struct Watched {
        vtkSmartPointer<vtkAlgorithm> algorithm;
        unsigned long observer;
        bool shown;  // by another observer
    };

    // Watches the algorithm and all before it, each once.
    void add(vtkAlgorithm& algorithm) {
        const auto same = [&](const Watched& one) { return one.algorithm == &algorithm; };
        if (std::any_of(watched_.begin(), watched_.end(), same)) return;
        const bool shown = algorithm.HasObserver(vtkCommand::ErrorEvent) != 0;
        watched_.push_back({&algorithm, algorithm.AddObserver(vtkCommand::ErrorEvent, this, &ErrorWatch::see), shown});
        for (int port = 0; port < algorithm.GetNumberOfInputPorts(); ++port) {
            for (int i = 0; i < algorithm.GetNumberOfInputConnections(port); ++i)
                if (vtkAlgorithm* const before = algorithm.GetInputAlgorithm(port, i)) add(*before);
        }
    }

    // An object that is observed does not show its errors itself.
    void see(vtkObject* who, unsigned long, void* text) {
        if (first_.empty()) first_ = who->GetClassName();
        for (const Watched& one : watched_)
            if (one.algorithm == who && !one.shown && text != nullptr)
                vtkOutputWindowDisplayErrorText(static_cast<const char*>(text));
    }

    std::vector<Watched> watched_;
    std::string first_;
};

// A pipeline that executes its algorithm although what comes before it has failed, so that the algorithm can tell
// others. Takes data sets alone: a composite one would make the algorithm run as often as it has parts, on each process
// another number of times.
class FailingUpstream : public vtkStreamingDemandDrivenPipeline {
public:
    static FailingUpstream* New();
    vtkTypeMacro(FailingUpstream, vtkStreamingDemandDrivenPipeline)

    // The failure of something before an input that has not been modified since then: its output is not to be used,
    // although VTK takes it for the result from then on. Empty if nothing failed. Readers tell it by GetErrorCode()
    // alone.
    std::string failure() const { return failures_.empty() ? std::string() : failures_.begin()->second.what; }

protected:
    int ForwardUpstream(vtkInformation* request) override {
        for (int port = 0; port < GetNumberOfInputPorts(); ++port)
            for (int i = 0; i < GetAlgorithm()->GetNumberOfInputConnections(port); ++i) forward(port, i, request);
        return 1;
    }

    // An execution that failed is repeated, on all processes.
    int NeedToExecuteData(int port, vtkInformationVector** inputs, vtkInformationVector* outputs) override {
        if (GetAlgorithm()->GetErrorCode() != vtkErrorCode::NoError) return 1;
        return Superclass::NeedToExecuteData(port, inputs, outputs);
    }

private:
    struct Failure {
        vtkExecutive* of;
        vtkMTimeType time;
        std::string what;
    };

    void forward(int port, int connection, vtkInformation* request) {
        const std::pair place(port, connection);
        auto* const before = vtkDemandDrivenPipeline::SafeDownCast(GetInputExecutive(port, connection));
        if (before == nullptr) {
            failures_.erase(place);
            return;
        }
        const int own = request->Get(FROM_OUTPUT_PORT());
        request->Set(FROM_OUTPUT_PORT(), GetAlgorithm()->GetInputConnection(port, connection)->GetIndex());
        std::string what;
        const ErrorWatch watch(*before->GetAlgorithm());
        try {
            if (before->ProcessRequest(request, before->GetInputInformation(), before->GetOutputInformation()) == 0)
                what = before->GetAlgorithm()->GetClassName();
        } catch (const std::exception& e) {
            what = before->GetAlgorithm()->GetClassName() + std::string(": ") + e.what();
        }
        if (std::string error = watch.error(); !error.empty()) what = std::move(error);
        request->Set(FROM_OUTPUT_PORT(), own);
        const vtkMTimeType time = before->GetPipelineMTime();
        const auto earlier = failures_.find(place);
        if (!what.empty())
            failures_[place] = {before, time, std::move(what)};
        else if (earlier != failures_.end() && (earlier->second.of != before || earlier->second.time != time))
            failures_.erase(earlier);
    }

    std::map<std::pair<int, int>, Failure> failures_;  //< by port and connection
};

vtkStandardNewMacro(FailingUpstream);

}  // namespace

vtkStandardNewMacro(vtkPBarycertProbe);
vtkCxxSetObjectMacro(vtkPBarycertProbe, Controller, vtkMultiProcessController);

vtkPBarycertProbe::vtkPBarycertProbe() {
    SetController(vtkMultiProcessController::GetGlobalController());
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
    return FailingUpstream::New();
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
    const auto* const pipeline = dynamic_cast<FailingUpstream*>(GetExecutive());
    if (pipeline != nullptr && !pipeline->failure().empty())
        ready = Error{.code = "rank.source", .what = "what comes before this filter failed: " + pipeline->failure()};
    else if (vtkCompositeDataSet::GetData(inputs[0]) != nullptr || vtkCompositeDataSet::GetData(inputs[1]) != nullptr)
        ready = Error{.code = "rank.source",
                      .what = "this filter takes no composite data sets",
                      .remedy = "merge the blocks before"};
    else if (input == nullptr || output == nullptr)
        ready = Error{.code = "argument.value", .what = "the input is missing"};
    else
        output->CopyStructure(input);

    if (ready && !GetComputeTolerance() && GetTolerance() > 0)
        ready = Error{.code = "option.value",
                      .what = "this filter has no Tolerance: points are inside the mesh or not",
                      .remedy = "leave ComputeTolerance on"};
    in_vtk::Processes processes(Controller);
    pieces::Exchange exchange(processes);
    in_vtk::ProbeReport report;
    const Status done = in_vtk::probe_pieces(exchange,
                                             {.categorical = GetCategoricalData() != 0,
                                              .outside = OutsideValue(),
                                              .mask = MaskName(),
                                              .cells = in_vtk::shape_of(GetInterpolation(), GetCurvedCells())},
                                             ready, input, source, output, report);
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
    for (const Note& note : report.notes) vtkWarningMacro("" << message(note));
    ListValidPoints(*report.mask);
    PassArrays(input, output);
    return 1;
}
