/// The mutation score of the families: which of them tell kernels with seeded faults from the sound ones that they were
/// made from. A family that no mutant needs may be idle; a mutant that no family catches shows a gap. Faults are of
/// kinds seen in public code: a constant off by ten, a guard left out, vertices swapped, a term dropped, a tie decided
/// the other way.
///
/// Example:
///
///     const AuditOptions options{.kernels = kernels_matching("*"), .families = all_families(), .count = 1000};
///     const MutantReport report = audit_mutants(options, {}).value();
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "barycert/audit.hpp"
#include "barycert/family.hpp"
#include "barycert/kernels.hpp"
#include "barycert/result.hpp"

namespace barycert {

struct Mutant {
    Kernel kernel;  ///< its name is the sound kernel's, "!" and the fault
    Kernel sound;
    std::string fault;   ///< the kind: "dropped-term", ...
    std::string change;  ///< what is wrong, one line
};

/// All of them, in a fixed order.
const std::vector<Mutant>& all_mutants();

/// A family in which the mutant does worse than the sound kernel on the same cases.
struct MutantCatch {
    std::string family;
    std::string figure;            ///< the most telling one: a class of finding, wrong_cases or an error
    double sound = 0, mutant = 0;  ///< that figure of both; -1: none
};

struct MutantResult {
    Mutant mutant;
    std::uint64_t families = 0;        ///< that have cases for it
    std::vector<MutantCatch> catches;  ///< most telling first
};

struct MutantReport : AuditRun {
    std::vector<MutantResult> mutants;

    std::uint64_t caught() const;
};

/// Audits the mutants and their sound kernels; options.kernels are ignored. A family catches a mutant if more of its
/// cases have a finding, or if an error, worst or 99.9th percentile, of weight or value, is more than twice that of the
/// sound kernel. Errors: as run_audit().
Result<MutantReport> audit_mutants(AuditOptions options, const MeshSource& meshes,
                                   const std::vector<Mutant>& mutants = all_mutants());

}  // namespace barycert
