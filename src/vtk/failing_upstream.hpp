/// A pipeline that executes its algorithm although what comes before it has failed, so that the algorithm can tell
/// others.
#pragma once

#include <vtkStreamingDemandDrivenPipeline.h>

namespace barycert::in_vtk {

/// Takes data sets alone: a composite one would make the algorithm run as often as it has parts, on each process
/// another number of times.
class FailingUpstream : public vtkStreamingDemandDrivenPipeline {
public:
    static FailingUpstream* New();
    vtkTypeMacro(FailingUpstream, vtkStreamingDemandDrivenPipeline)

    /// Whether the last request of any kind failed before the algorithm.
    bool failed() const { return data_object_ || information_ || extent_ || data_; }

protected:
    using vtkStreamingDemandDrivenPipeline::ForwardUpstream;
    int ForwardUpstream(vtkInformation* request) override;

private:
    bool data_object_ = false, information_ = false, extent_ = false, data_ = false;
};

}  // namespace barycert::in_vtk
