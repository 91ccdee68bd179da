/// What a check of a surface or a PLC found, for people.
#pragma once

#include "barycert/report/common/document.hpp"

namespace barycert::report {

void tell_surface_verdict(Document& d, const CheckReport& r, const std::string& name);

/// Its shells, the regions that they enclose, and the points of a PLC.
void tell_surface(Document& d, const CheckReport& r);

}  // namespace barycert::report
