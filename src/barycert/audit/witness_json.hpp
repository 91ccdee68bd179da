/// One witness as JSON, for the witness file and the report. Public headers stand on the standard library
/// alone.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "barycert/audit.hpp"

namespace barycert::audit {

nlohmann::ordered_json witness_json(const Witness& witness);

}  // namespace barycert::audit
