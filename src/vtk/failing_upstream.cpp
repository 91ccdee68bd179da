#include "vtk/failing_upstream.hpp"

#include <vtkInformation.h>
#include <vtkObjectFactory.h>

namespace barycert::in_vtk {

vtkStandardNewMacro(FailingUpstream);

int FailingUpstream::ForwardUpstream(vtkInformation* request) {
    const bool fails = Superclass::ForwardUpstream(request) == 0;
    if (request->Has(REQUEST_DATA_OBJECT()) != 0) data_object_ = fails;
    if (request->Has(REQUEST_INFORMATION()) != 0) information_ = fails;
    if (request->Has(REQUEST_UPDATE_EXTENT()) != 0) extent_ = fails;
    if (request->Has(REQUEST_DATA()) != 0) data_ = fails;
    return 1;
}

}  // namespace barycert::in_vtk
