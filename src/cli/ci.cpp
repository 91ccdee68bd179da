#include "ci.hpp"

#include <CLI/CLI.hpp>

#include "files.hpp"

namespace barycert::cli {

void add_ci_options(CLI::App& sub, CiOptions& o, const std::string& failures) {
    file_option(sub, "--junit", o.junit,
                "Write " + failures + " as failures in JUnit XML; - is stdout and suppresses the table");
    file_option(sub, "--sarif", o.sarif,
                "Write all that was found as SARIF 2.1.0, " + failures + " as errors; - is stdout likewise");
    sub.add_flag("--annotations", o.annotations,
                 "Print " + failures + " as annotations of GitHub's workflows, after the table");
}

void add_ci_outputs(const CiOptions& o, bool table, std::vector<base::NamedFile>& outputs) {
    outputs.push_back({"--junit", o.junit});
    outputs.push_back({"--sarif", o.sarif});
    if (table) {
        outputs.push_back({"the table", "-"});
    } else if (o.annotations) {
        outputs.push_back({"--annotations", "-"});
    }
}

void write_ci(const CiOptions& o, const CiReport& report, std::vector<Status>& written) {
    if (!o.junit.empty()) written.push_back(write_output(o.junit, ci_junit(report)));
    if (!o.sarif.empty()) written.push_back(write_output(o.sarif, ci_sarif(report)));
    if (o.annotations) written.push_back(write_output("-", ci_annotations(report)));
}

}  // namespace barycert::cli
