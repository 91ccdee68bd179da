#include <string>
#include <string_view>

#include "app/report/common/json.hpp"
#include "barycert/error_report.hpp"
#include "barycert/result.hpp"

namespace barycert {

std::string error_json(const Error& error, std::string_view option) {
    using report::Json;
    const Json of_error =
        report::record("code", error.code.name(), "message", error.message(), "what", error.what, "file", error.file,
                       "line", error.line, "expected", error.expected, "found", error.found, "remedy", error.remedy,
                       "subject", error.subject, "option", option);
    return report::record("schema", 1, "error", of_error).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace barycert
