#include "vtk/failing_upstream.hpp"

#include <exception>
#include <string>

#include <vtkAlgorithm.h>
#include <vtkAlgorithmOutput.h>
#include <vtkErrorCode.h>
#include <vtkInformation.h>
#include <vtkObjectFactory.h>

#include "vtk/error_watch.hpp"

namespace barycert::in_vtk {

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
