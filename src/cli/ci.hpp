/// Reports for continuous integration: --junit, --sarif, --annotations.
#pragma once

#include <string>
#include <vector>

#include "barycert/base/named_file.hpp"
#include "barycert/report.hpp"
#include "barycert/result.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace barycert::cli {

struct CiOptions {
    std::string junit, sarif;
    bool annotations = false;

    bool asked() const { return !junit.empty() || !sarif.empty() || annotations; }
    /// True if a report takes stdout for itself.
    bool on_stdout() const { return junit == "-" || sarif == "-"; }
};

/// `failures`: what is reported as failed, as in "broken rules".
void add_ci_options(CLI::App& sub, CiOptions& o, const std::string& failures);

/// The outputs, for check_outputs(). Annotations follow the table; without one stdout is theirs alone.
void add_ci_outputs(const CiOptions& o, bool table, std::vector<base::NamedFile>& outputs);

/// What is asked for, the annotations last, on stdout. Each write's status is added.
void write_ci(const CiOptions& o, const CiReport& report, std::vector<Status>& written);

}  // namespace barycert::cli
