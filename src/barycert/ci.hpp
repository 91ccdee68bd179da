/// What a run found, for the systems that run it: JUnit's XML, SARIF 2.1.0, annotations of GitHub's workflows.
///
/// All three say the same outcomes. One fails where the program's exit code says so and nowhere else: a mesh that is
/// not certified, rows that are wrong, a broken rule of --fail-on. What else was found is told and passes.
#pragma once

#include <string>
#include <vector>

#include "barycert/check.hpp"
#include "barycert/environment.hpp"
#include "barycert/mesh.hpp"
#include "barycert/verification.hpp"

namespace barycert {

struct CiOutcome {
    enum class State : unsigned char { passed, noted, failed };
    std::string subject;  ///< a kernel, a mesh, a file of results
    std::string name;     ///< what was asked: a rule, a condition, a family, a class of finding
    std::string rule;     ///< the class or figure, a handle that stays the same from run to run
    std::string meaning;  ///< of the rule, one sentence
    State state = State::passed;
    std::string message;   ///< one line; empty if passed
    std::string artifact;  ///< the file that the subject comes from; may be empty
};

struct CiReport {
    std::string command;  ///< "barycert audit"
    std::string kind;     ///< what subjects are, as SARIF calls it: function, resource
    Environment environment;
    double seconds = 0;
    std::vector<CiOutcome> outcomes = {};  ///< those of one subject together

    bool failed() const;
};

/// The conditions of the certificate that hold, and the defects by kind, each with its first places. `name` is what the
/// user calls the mesh, `artifact` the file that it is in.
CiReport check_outcomes(const CheckReport& report, const Mesh& mesh, const std::string& name,
                        const std::string& artifact, const Environment& environment);

/// Kinds of wrong rows with their number and the worst; those fail of which there are more than a limit says.
CiReport verify_outcomes(const VerifySummary& summary, const std::vector<VerifyLimit>& limits,
                         const Environment& environment);

/// A suite a subject, a case an outcome. Valid by the schema of Jenkins (junit-10.xsd).
std::string ci_junit(const CiReport& report);

/// Static Analysis Results Interchange Format 2.1.0: a result for each outcome that failed (error) or is noted (note).
std::string ci_sarif(const CiReport& report);

/// A line `::error title=...::...` for each outcome that failed.
std::string ci_annotations(const CiReport& report);

}  // namespace barycert
