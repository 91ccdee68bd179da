/// What a run found, for the systems that run it: JUnit's XML, SARIF 2.1.0, annotations of GitHub's workflows.
///
/// All three say the same outcomes. One fails where the program's exit code says so and nowhere else: a rule of
/// --fail-on that is broken, a figure that is worse than the baseline's. Findings without a rule against them are told
/// and pass.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "barycert/audit.hpp"
#include "barycert/audit_baseline.hpp"
#include "barycert/environment.hpp"

namespace barycert {

struct CiOutcome {
    enum class State : unsigned char { passed, noted, failed };
    std::string subject;  ///< a kernel
    std::string name;     ///< what was asked: a rule, a family, a class of finding
    std::string rule;     ///< the class or figure, a handle that stays the same from run to run
    State state = State::passed;
    std::string message;   ///< one line; empty if passed
    std::string artifact;  ///< the file that the subject comes from; may be empty
};

struct CiReport {
    std::string command;  ///< "barycert audit"
    Environment environment;
    double seconds = 0;
    std::vector<CiOutcome> outcomes;  ///< those of one subject together

    bool failed() const;
};

/// The outcomes of an audit. `comparison` may be null. `artifacts`: kernel to file, of kernels from libraries.
CiReport audit_outcomes(const AuditReport& report, const std::vector<Threshold>& rules,
                        const BaselineComparison* comparison, const std::map<std::string, std::string>& artifacts);

/// A suite a subject, a case an outcome. Valid by the schema of Jenkins (junit-10.xsd).
std::string ci_junit(const CiReport& report);

/// Static Analysis Results Interchange Format 2.1.0: a result for each outcome that failed (error) or is noted (note).
std::string ci_sarif(const CiReport& report);

/// A line `::error title=...::...` for each outcome that failed.
std::string ci_annotations(const CiReport& report);

/// What got worse and better, some lines of each; what could not be compared.
std::string baseline_text(const BaselineComparison& comparison, const std::string& path);

}  // namespace barycert
