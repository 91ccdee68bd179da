/// Worst-case search: walks through the cases of one kernel, uphill towards its faults, and brings back the worst of
/// each kind and the plainest case that shows it.
///
/// Input: a kernel; families, from whose worst cases walks start. Each step makes one case, asks the oracle and
/// compares. Output: for each class of finding that was met, and for the errors, a witness as found and a plain one.
///
/// A walk starts from a family's worst, from the worst so far, or from a new pattern of exponents; its steps move
/// coordinates by ulps, redraw significands, shift exponents, and jump by a secant of the exact weights to where a
/// weight, or the whole determinant, is zero: beside these sets the condition number of a sign is unbounded. The idea
/// of a search led by condition numbers is that of ATOMU (Zou, Zeng, Xiong, Fu, Zhang, Su, POPL 2020).
///
/// The result depends on the kernel's answers, the options and nothing else, unless time or the user ends the search,
/// or the kernel is given up. The number of threads changes nothing. A kernel in a process of its own
/// (load_contained_kernel) may crash or hang: that is a finding, too, whose plainest case is the plainest that was met.
#pragma once

#include <map>

#include "barycert/audit.hpp"
#include "barycert/baseline.hpp"
#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/choices.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/finding.hpp"
#include "barycert/fix.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/kernels.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc.hpp"
#include "barycert/rule_audit.hpp"
#include "barycert/statistics.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/surface_rules.hpp"
#include "barycert/threshold.hpp"
#include "barycert/witness.hpp"

namespace barycert {

struct SearchProgress {
    std::uint64_t steps_done = 0, steps_total = 0;
    double worst_weight_ulp = -1;
    std::uint64_t wrong_cases = 0;  ///< with a finding
};

struct SearchOptions {
    Kernel kernel;                                  ///< asked on several threads at once
    std::vector<Family> families = all_families();  ///< those for other kernels or from meshes are passed over
    std::uint64_t family_count = 200;               ///< cases of each family to start with
    std::uint64_t steps = 1000000;                  ///< cases in all
    double seconds = 0;                             ///< ends the search early; 0: no limit
    std::uint64_t seed = 1;
    int threads = 0;                                      ///< 0: one per core
    int min_exponent = -1074;                             ///< of coordinates other than zero, as 2^e <= |x| < 2^(e+1)
    int max_exponent = 1023;                              ///< likewise; depths of perspective likewise
    std::function<bool(const SearchProgress&)> progress;  ///< called now and then; false ends the search
};

/// One kind of fault.
struct SearchFind {
    std::string reason;          ///< reason_name(), or "worst_relative_error"
    std::uint64_t cases = 0;     ///< that showed it; of errors: in which one could be measured
    Witness found;               ///< the worst
    double weight_ulp = -1;      ///< its largest error of a weight in ulps; -1 if undefined
    double relative_error = -1;  ///< its max |weight - exact weight| / max |exact weight|, likewise
    Witness plain;  ///< the same kind of fault on the plainest coordinates; of errors: at least 1/1024 of it
    double plain_weight_ulp = -1, plain_relative_error = -1;  ///< of `plain`
    int plain_bits = 0;                                       ///< significant bits of all its coordinates together
};

struct SearchReport : AuditRun {
    Kernel kernel;
    std::uint64_t steps_asked = 0, steps = 0, walks = 0;
    std::uint64_t plain_steps = 0;  ///< further cases, to make witnesses plain
    int min_exponent = 0, max_exponent = 0;
    bool stopped = false;  ///< by time or by the user: the same options may give another result
    /// The kernel, in a process of its own, failed to answer too often: the rest of the steps was not made, and what
    /// was found depends on threads and time.
    bool given_up = false;
    std::uint64_t wrong_cases = 0;
    std::vector<SearchFind> finds;  ///< in the order of Finding, then the errors
};

/// Errors: a floating-point environment in which results cannot be exact; no step; exponents out of range or order.
Result<SearchReport> search_worst_case(const SearchOptions& options);

/// Error: a rule that a search has no figure for. It has any, wrong_cases, the classes of finding, worst_weight_ulp and
/// worst_value_ulp.
Status check_search_rules(const std::vector<Threshold>& rules);

/// A kernel that gave no weights where there are some has an infinite error.
std::vector<Violation> violations(const SearchReport& report, const std::vector<Threshold>& rules);

/// The witness on plainer coordinates: fewer significant bits, smaller exponents, zeros and ones, as long as its reason
/// stays. A witness of an error keeps a 1024th of it at least. One that does not show its reason comes back as it is.
/// Its exponents stay within the bounds. `steps`, if given, is increased by the number of cases asked.
Witness plainest_witness(const Kernel& kernel, const Witness& witness, std::uint64_t* steps = nullptr,
                         int min_exponent = -1074, int max_exponent = 1023);

/// {"schema": 1, "witnesses": [...]} of the plain witnesses, for `barycert replay`.
std::string witnesses_json(const SearchReport& report);

// Gaps and overlaps: does a kernel give each point of a mesh to a cell that holds it, and to one only? Cells are asked
// one by one. At points on shared faces, edges and vertices, and within a few ulps of them, a kernel that rounds may
// have no cell say yes (a gap: the point is lost), several, or a cell that does not hold the point.

/// When a cell claims a point.
enum class ClaimRule : std::uint8_t {
    strict,    ///< every weight > 0
    exact,     ///< every weight >= 0: with exact weights, the closed cell
    tolerant,  ///< every weight >= -tolerance
    own,       ///< as the kernel says: of kernels that classify, or have a tolerance
};

inline constexpr std::array all_claim_rules{ClaimRule::strict, ClaimRule::exact, ClaimRule::tolerant, ClaimRule::own};

constexpr std::string_view name(ClaimRule r) {
    return std::array<std::string_view, 4>{"strict", "exact", "tolerant", "own"}[static_cast<std::size_t>(r)];
}

/// Faults at a point. The first four occur where a cell holds the point, the last where none does.
enum class ClaimFault : std::uint8_t {
    gap,              ///< no cell claims it
    several,          ///< more than one does; right where it lies on what they share
    wrong,            ///< a cell claims it that does not hold it
    wrong_first,      ///< the one of the lowest number among those that claim it does not hold it
    outside_claimed,  ///< a cell claims it
};

inline constexpr std::size_t claim_fault_count = 5;

constexpr std::string_view name(ClaimFault f) {
    constexpr std::string_view names[claim_fault_count]{"gaps", "several", "wrong", "wrong_first", "outside_claimed"};
    return names[static_cast<std::size_t>(f)];
}

/// A point at which something went wrong. Cells by their numbers in the mesh's file, nodes by their numbers from 0.
struct ClaimWitness {
    Feature feature = Feature::vertex;  ///< what the point was made on: face, edge or vertex
    std::uint64_t index = 0;            ///< number of the point among those of this feature
    std::vector<Mesh::Index> nodes;     ///< of the feature
    std::array<double, 3> point{};
    std::vector<Mesh::Index> holders;    ///< cells that hold the point, exactly
    std::vector<Mesh::Index> claimants;  ///< cells that claim it
};

struct ClaimCounts {
    std::uint64_t inside = 0;   ///< points that a cell holds
    std::uint64_t outside = 0;  ///< points that no cell around the feature holds
    std::array<std::uint64_t, claim_fault_count> faults{};

    std::uint64_t of(ClaimFault f) const { return faults[static_cast<std::size_t>(f)]; }
    void add(const ClaimCounts& other);
};

struct ClaimResult {
    std::string kernel;  ///< empty: exact arithmetic
    ClaimRule rule = ClaimRule::exact;
    std::array<ClaimCounts, 3> by_feature{};  ///< face, edge, vertex
    /// Pairs of point and cell without an answer, as the kernel ended, took too long, or had been given up: not
    /// claimed.
    std::uint64_t unanswered = 0;
    std::map<ClaimFault, ClaimWitness> witnesses;  ///< the first of each fault

    ClaimCounts total() const;
};

struct GapsOptions {
    std::vector<Kernel> kernels;  ///< those for the cells of the mesh take part
    std::uint64_t count = 10000;  ///< points on faces, on edges and on vertices each
    std::uint64_t seed = 1;
    int threads = 0;                    ///< 0: one per core
    double tolerance = 1e-10;           ///< of ClaimRule::tolerant
    std::vector<ClaimRule> rules = {};  ///< no others are looked at; empty: all
};

struct GapsReport : AuditRun {
    std::string mesh;
    int dimension = 3;
    Verdict verdict = Verdict::not_checked;
    CurvedCells curved;  ///< of the mesh: taken with straight sides
    Notes notes;         ///< of the file of the mesh
    double tolerance = 0;
    OracleCounts oracles;              ///< by pairs of point and cell
    std::vector<ClaimResult> results;  ///< exact arithmetic first, then the kernels as given, rule by rule
};

/// `name` is what the user calls the mesh, `verdict` what is known of it. Points depend on seed and mesh alone. Errors:
/// a floating-point environment in which results cannot be exact; a mesh without cells; no kernel for its cells, or
/// none that has one of the rules; two oracles that disagree.
Result<GapsReport> find_gaps(const GapsOptions& options, const Mesh& mesh, const std::string& name, Verdict verdict);

/// FAULT or FAULT>NUMBER: more such points than that fail.
struct GapsLimit {
    ClaimFault fault = ClaimFault::gap;
    double most = 0;
};
Result<GapsLimit> parse_gaps_limit(std::string_view text);

/// The features of ClaimResult::by_feature.
inline constexpr std::array<Feature, 3> claim_features{Feature::face, Feature::edge, Feature::vertex};

// The mutation score of the families: which of them tell kernels with seeded faults from the sound ones that they were
// made from. A family that no mutant needs may be idle; a mutant that no family catches shows a gap. Faults are of
// kinds seen in public code: a constant off by ten, a guard left out, vertices swapped, a term dropped, a tie decided
// the other way.

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
