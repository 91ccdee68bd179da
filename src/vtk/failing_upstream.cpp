#include "vtk/failing_upstream.hpp"

#include <algorithm>
#include <exception>
#include <string>
#include <vector>

#include <vtkAlgorithm.h>
#include <vtkAlgorithmOutput.h>
#include <vtkCallbackCommand.h>
#include <vtkErrorCode.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

namespace barycert::in_vtk {

namespace {

// Whether an algorithm or one before it reports an error. Many readers do nothing else when a file is bad: they return
// success, and an empty data set. Watches from its construction to its end. Errors are shown as if it did not.
class ErrorWatch {
public:
    explicit ErrorWatch(vtkAlgorithm& last) {
        command_->SetCallback(see);
        command_->SetClientData(this);
        add(last);
    }
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

    // Those before it, too, each once.
    void add(vtkAlgorithm& algorithm) {
        const auto same = [&](const Watched& one) { return one.algorithm == &algorithm; };
        if (std::any_of(watched_.begin(), watched_.end(), same)) return;
        const bool shown = algorithm.HasObserver(vtkCommand::ErrorEvent) != 0;
        watched_.push_back({&algorithm, algorithm.AddObserver(vtkCommand::ErrorEvent, command_), shown});
        for (int port = 0; port < algorithm.GetNumberOfInputPorts(); ++port) {
            for (int i = 0; i < algorithm.GetNumberOfInputConnections(port); ++i)
                if (vtkAlgorithm* const before = algorithm.GetInputAlgorithm(port, i)) add(*before);
        }
    }

    // An object that is observed does not show its errors itself.
    static void see(vtkObject* who, unsigned long, void* self, void* text) {
        auto& watch = *static_cast<ErrorWatch*>(self);
        if (watch.first_.empty()) watch.first_ = who->GetClassName();
        for (const Watched& one : watch.watched_)
            if (one.algorithm == who && !one.shown && text != nullptr)
                vtkOutputWindowDisplayErrorText(static_cast<const char*>(text));
    }

    vtkNew<vtkCallbackCommand> command_;
    std::vector<Watched> watched_;
    std::string first_;
};

}  // namespace

vtkStandardNewMacro(FailingUpstream);

void FailingUpstream::forward(int port, int connection, vtkInformation* request) {
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

int FailingUpstream::ForwardUpstream(vtkInformation* request) {
    for (int port = 0; port < GetNumberOfInputPorts(); ++port)
        for (int i = 0; i < GetAlgorithm()->GetNumberOfInputConnections(port); ++i) forward(port, i, request);
    return 1;
}

int FailingUpstream::NeedToExecuteData(int port, vtkInformationVector** inputs, vtkInformationVector* outputs) {
    if (GetAlgorithm()->GetErrorCode() != vtkErrorCode::NoError) return 1;
    return Superclass::NeedToExecuteData(port, inputs, outputs);
}

}  // namespace barycert::in_vtk
