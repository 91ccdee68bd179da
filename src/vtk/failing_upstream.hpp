/// A pipeline that executes its algorithm although what comes before it has failed, so that the algorithm can tell
/// others.
#pragma once

#include <map>
#include <string>
#include <utility>

#include <vtkStreamingDemandDrivenPipeline.h>

namespace barycert::in_vtk {

/// Takes data sets alone: a composite one would make the algorithm run as often as it has parts, on each process
/// another number of times.
class FailingUpstream : public vtkStreamingDemandDrivenPipeline {
public:
    static FailingUpstream* New();
    vtkTypeMacro(FailingUpstream, vtkStreamingDemandDrivenPipeline)

    /// What failed before an input, and has not been modified since then: its output is not to be used, although VTK
    /// takes it for the result from then on. Empty if nothing failed. Readers tell their failures by GetErrorCode()
    /// alone.
    std::string failure() const { return failures_.empty() ? std::string() : failures_.begin()->second.what; }

protected:
    int ForwardUpstream(vtkInformation* request) override;
    /// An execution that failed is repeated, on all processes.
    int NeedToExecuteData(int port, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
    struct Failure {
        vtkExecutive* of;
        vtkMTimeType time;
        std::string what;
    };
    void forward(int port, int connection, vtkInformation* request);

    std::map<std::pair<int, int>, Failure> failures_;  ///< by port and connection
};

}  // namespace barycert::in_vtk
