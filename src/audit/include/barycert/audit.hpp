/// The audit: runs kernels over families of cases and compares each answer with the oracle's.
///
/// Memory does not grow with the number of cases; the result, times aside, does not depend on the number of threads.
#pragma once

#include <algorithm>
#include <map>
#include <numeric>

#include "barycert/check.hpp"
#include "barycert/environment.hpp"
#include "barycert/kernels.hpp"
#include "barycert/oracle.hpp"

namespace barycert {

// What an audit can find wrong with a kernel's answers, and the statistics of many answers.

/// Worst first.
enum class Finding : std::uint8_t {
    crashed,  // per case from here on; the first seven are what a user's kernel does besides answering
    raised,
    hung,
    out_of_bounds,
    forked,
    changed_environment,
    printed,
    false_certificate,
    false_declaration,
    false_inside,
    false_outside,
    missed_degenerate,
    opposite_sign,  // per weight from here on
    false_zero,
    false_nonzero,
    not_finite,
};

inline constexpr std::size_t finding_count = 16;

struct FindingText {
    std::string_view name, meaning;
};

inline constexpr std::array<FindingText, finding_count> finding_texts{{
    {"crashed", "the kernel's process ended: there is no answer"},
    {"raised", "the kernel, a callable of Python, raised an exception: there is no answer"},
    {"hung", "the kernel gave no answer within the time limit"},
    {"out_of_bounds", "the kernel touched memory beside its arrays, or wrote to its input"},
    {"forked", "the kernel left a process behind that it had started"},
    {"changed_environment", "the kernel came back with another rounding mode, or with subnormal numbers flushed"},
    {"printed", "the kernel wrote to stdout or stderr"},
    {"false_certificate", "the kernel certifies its answers, and this one has a finding or is not correctly rounded"},
    {"false_declaration", "the kernel declares a simplex degenerate that is not"},
    {"false_inside", "the point is outside; the kernel says interior or boundary"},
    {"false_outside", "the point is inside or on the boundary; the kernel says outside"},
    {"missed_degenerate", "the simplex is degenerate; the kernel gives finite weights"},
    {"opposite_sign", "a weight has the sign opposite to the exact one"},
    {"false_zero", "a weight is zero and the exact one is not"},
    {"false_nonzero", "a weight is not zero and the exact one is"},
    {"not_finite", "a weight is NaN or infinite and the simplex is not degenerate"},
}};

constexpr std::string_view name(Finding f) {
    return finding_texts[static_cast<std::size_t>(f)].name;
}

constexpr std::optional<Finding> finding_named(std::string_view text) {
    const auto at = std::ranges::find(finding_texts, text, &FindingText::name);
    return at == finding_texts.end() ? std::nullopt : std::optional(static_cast<Finding>(at - finding_texts.begin()));
}

/// One answer of a kernel, compared with the oracle's.
struct Comparison {
    Region claimed = Region::outside;
    std::array<std::uint8_t, finding_count> counts{};  ///< weights, or 1 for a case, per class of finding
    std::array<double, 4> weight_ulps{};               ///< error of each weight in ulps; -1 if undefined
    double value_ulp = -1;                             ///< error of the value in ulps; -1 if undefined
    /// Max |weight - exact weight|, infinite without finite weights; for a missed degenerate simplex the max |weight|.
    double weight_error = 0;
    /// The same over max(1, max |exact weight|); -1 if the simplex is degenerate.
    double relative_error = -1;

    bool wrong() const { return counts != decltype(counts){}; }
    double worst_weight_ulp() const { return *std::max_element(weight_ulps.begin(), weight_ulps.end()); }
};

/// How many numbers lie in each bin.
template <std::size_t n>
struct BinCounts {
    static constexpr std::size_t bins = n;
    std::array<std::uint64_t, n> counts{};

    void merge(const BinCounts& other) {
        for (std::size_t i = 0; i < n; ++i) counts[i] += other.counts[i];
    }
    std::uint64_t total() const { return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}); }

    /// The first bin by which at least that many are reached, or the last.
    std::size_t bin_reaching(std::uint64_t wanted) const {
        std::size_t i = 0;
        for (std::uint64_t seen = counts[0]; seen < wanted && i + 1 < n;) seen += counts[++i];
        return i;
    }
};

/// Numbers >= 0 by magnitude. Bins are exact for the integers 0 to 16 and eight to an octave above, up to 2^128; larger
/// numbers share the last.
struct LogHistogram : BinCounts<1 + 8 * 128> {
    void add(double x) { ++counts[bin(x)]; }

    /// The min bin edge that at least the given fraction of the numbers do not exceed; -1 if there are no numbers.
    double quantile(double fraction) const;

private:
    static std::size_t bin(double x);
    static double upper_edge(std::size_t bin);
};

/// The max value and its case, of equal values the first: the order of insertion does not matter.
struct WorstCase {
    double value = -1;
    std::uint64_t index = 0;  ///< of the case in its family

    void include(double v, std::uint64_t i) {
        if (v > value || (v == value && i < index)) *this = {v, i};
    }
};

/// How large errors are, of one number a case: Comparison::relative_error. [0]: no error; [k]: 10^(k-19) <= error <
/// 10^(k-18), [1] all smaller ones, [21] all larger ones; [22]: no finite answer.
struct ErrorSizes : BinCounts<23> {
    WorstCase worst;  ///< of the finite ones

    void add(double error, std::uint64_t index);  ///< below 0: not counted; infinite: no finite answer
    void merge(const ErrorSizes& other);
    std::uint64_t unanswered() const { return counts[bins - 1]; }
    /// The upper edge of the first bin by which at least that share of the cases with a finite answer is reached: 0,
    /// 1e-17, ..., 100, infinity. -1 if there are no such cases.
    double within(double share) const;
};

/// The reasons for a witness: each class of finding, then the error of a weight and of the value in ulps.
inline constexpr std::size_t witness_reasons = finding_count + 2;

/// "opposite_sign", ... "worst_weight_ulp", "worst_value_ulp".
constexpr std::string_view reason_name(std::size_t reason) {
    if (reason < finding_count) return finding_texts[reason].name;
    return reason == finding_count ? "worst_weight_ulp" : "worst_value_ulp";
}

struct KernelStatistics {
    std::uint64_t cases = 0;
    std::uint64_t wrong_cases = 0;  ///< with at least one finding
    std::uint64_t not_run = 0;      ///< cases left out, none of the above: the kernel had failed to answer too often
    std::array<std::uint64_t, finding_count> counts{};
    std::array<std::array<std::uint64_t, 4>, 4> confusion{};  ///< [exact region][claimed region]
    LogHistogram weight_ulps;
    LogHistogram value_ulps;
    ErrorSizes errors;
    WorstCase weight_ulp;
    WorstCase value_ulp;
    WorstCase partition_residual;                      ///< |sum of weights - 1|, exact, rounded once
    WorstCase reproduction_residual;                   ///< |sum of weight * vertex - point|, exact, rounded once
    std::array<WorstCase, witness_reasons> witnesses;  ///< by Comparison::weight_error, the last two by ulps

    /// 99.9th percentiles: edges of bins, at most the worst; -1 if there are no errors to measure.
    double p999_weight_ulp() const { return std::min(weight_ulps.quantile(0.999), weight_ulp.value); }
    double p999_value_ulp() const { return std::min(value_ulps.quantile(0.999), value_ulp.value); }

    void add(const Comparison& comparison, Region exact, std::uint64_t index);

    /// Case indices are kept from either side: they mean nothing after merging different families.
    void merge(const KernelStatistics& other);
};

/// Errors of a kernel by the condition number kappa of the cell, one bit of log2(kappa) a bin. Where nothing under- or
/// overflows, a kernel that works with differences of coordinates has weights within C * 2^-53 * kappa of the exact
/// ones for points of the cell, with a small constant C (weights.hpp).
class Prediction {
public:
    static constexpr int last_bits = 1100;  ///< and more: above the log2 of every double

    struct Bin {
        int bits = 0;  ///< floor(log2(kappa))
        std::uint64_t cases = 0;
        double median = 0;  ///< of the cases' largest errors, in units of 2^-53; the upper edge of half an octave
        double worst = 0;   ///< the largest of them, likewise
    };

    /// One case: kappa >= 1 and the largest |weight - exact weight|, finite.
    void add(double kappa, double error);
    void merge(const Prediction& other);

    std::uint64_t cases() const;

    /// The C that would have held: the max error / (2^-53 kappa) over cases with kappa < 2^47, where the first-order
    /// prediction applies. -1 without such cases.
    double worst_factor() const { return worst_factor_; }

    /// The non-empty bins, ascending.
    std::vector<Bin> bins() const;

private:
    struct Row {
        double worst = 0;
        std::vector<std::uint64_t> errors;  ///< by magnitude, as long as it takes
    };
    std::vector<Row> rows_;  ///< by bits, likewise
    double worst_factor_ = -1;
};

// Families of cases, and the meshes that some of them draw simplices from.

namespace base {
class Random;
}
namespace audit {
struct PreparedMesh;
struct Draw;
}  // namespace audit

/// Meshes whose cells, and the faces and edges of these, become simplices of cases. Copies share the meshes.
class MeshSource {
public:
    /// `certificate`: of this mesh, if it was checked.
    void add(std::string name, Mesh mesh, const Certificate& certificate = {});

    bool supplies(Simplex s) const;

    /// For recipes: the meshes as audit/recipes.hpp has them.
    const std::vector<std::shared_ptr<const audit::PreparedMesh>>& meshes() const { return meshes_; }

private:
    std::vector<std::shared_ptr<const audit::PreparedMesh>> meshes_;
};

/// A recipe for cases that tests a particular way in which formulas fail. Case i depends on (seed, family, simplex, i)
/// and, for mesh families, on the meshes; on nothing else. Only correctly rounded operations are used (+ - * / sqrt and
/// powers of two), so the same seed gives the same bits on every machine.
struct Family {
    std::string name;
    std::string tests;       ///< what it tests, one line
    std::string parameters;  ///< the recipe with its numbers
    std::vector<Simplex> simplices;

    /// Fills `c` (its simplex is set, all else zero). `index` is the case's number.
    void (*recipe)(Case& c, base::Random& random, std::uint64_t index) = nullptr;
    /// Of a family from meshes: returns the draw that the simplex is.
    audit::Draw (*mesh_recipe)(base::Random& random, const MeshSource& meshes, Simplex s) = nullptr;

    bool needs_mesh = false;
    bool perspective = false;  ///< its cases are for kernels with Kernel::perspective, and no others

    bool applies_to(Simplex s) const;
};

/// All families in a fixed order, those from meshes first.
const std::vector<Family>& all_families();

std::vector<Family> families_matching(std::string_view glob);

// Witnesses: cases that show a finding, their files, and what kernels answer to them today.

/// A case that shows a finding, and how to make it again.
struct Witness {
    std::string kernel;
    std::string reason;  ///< class of finding, or "worst_weight_ulp"
    std::string family;
    std::uint64_t seed = 0;
    std::uint64_t index = 0;
    double magnitude = 0;    ///< |weight - exact weight|, or ulps
    std::string mesh;        ///< the mesh that the simplex comes from; empty if it comes from none
    std::int64_t cell = -1;  ///< its cell, by the number in the mesh's file, from 0; -1 if it comes from none
    std::string detail;      ///< of findings up to `printed`: what happened, in words
    Case c;
};

/// Case `index` of a family. `witness`, if given, is told the case and how it is made. Preconditions:
/// family.applies_to(s); family.needs_mesh implies meshes.supplies(s).
Case make_case(const Family& family, Simplex s, std::uint64_t seed, std::uint64_t index, const MeshSource& meshes,
               Witness* witness = nullptr);

struct KernelAnswer {
    std::string kernel;
    bool answered = true;  ///< false: it ended, or took too long
    int status = 0;        ///< 1: declared degenerate
    std::array<double, 4> weights{};
    Comparison comparison;
    std::string detail;  ///< what it did besides answering, in words; empty if nothing
};

struct Replay {
    Witness witness;
    OracleAnswer exact;
    int affine_dimension = 0;  ///< of the simplex

    /// Of interpolation along auxiliary lines or, for perspective, ray casting; `undefined` for segments and
    /// triangle3d.
    IdentityVerdict identity = IdentityVerdict::undefined;
    std::vector<KernelAnswer> answers;  ///< of the kernels for such cases
    std::string not_reproduced;  ///< why it no longer shows its finding; empty if it does, or names no kernel or reason
};

Replay replay_witness(const Witness& witness, const std::vector<Kernel>& kernels);

inline constexpr int witness_schema = 1;

/// Reads the output of witnesses_json(), or the "witnesses" of an audit's JSON report, from a regular file or a pipe.
/// Errors: the file cannot be read, is not JSON or of another schema; a witness is malformed.
Result<std::vector<Witness>> read_witnesses(const std::string& path);

/// Who says what is right.
enum class OracleChoice : std::uint8_t {
    /// The core where its error bounds decide, unless a kernel of the same cases computes with it; else the integers. A
    /// sample of what the core decided is put to the integers as well, and to CGAL a sample of all, and all that took
    /// integers wider than the machine's.
    automatic,
    integers,  ///< ask_oracle() alone
    cgal,      ///< ask_cgal() alone
    both,      ///< the integers, and CGAL besides, in every case
};

constexpr std::string_view name(OracleChoice o) {
    constexpr std::array<std::string_view, 4> names{"automatic", "integers", "cgal", "both"};
    return names[static_cast<std::size_t>(o)];
}

/// How many cases each oracle decided, and how many it confirmed. A disagreement is an error of run_audit().
struct OracleCounts {
    std::uint64_t core = 0, integers = 0, cgal = 0;
    std::uint64_t wide = 0;                          ///< of the integers: wider ones than the machine's
    std::uint64_t also_integers = 0, also_cgal = 0;  ///< confirmed by

    void add(const OracleCounts& other) {
        using O = OracleCounts;
        for (const auto count : {&O::core, &O::integers, &O::wide, &O::cgal, &O::also_integers, &O::also_cgal})
            this->*count += other.*count;
    }
    friend bool operator==(const OracleCounts&, const OracleCounts&) = default;
};

struct AuditProgress {
    std::uint64_t cases_done = 0, cases_total = 0;
    std::string family;
};

struct AuditOptions {
    std::vector<Kernel> kernels;
    std::vector<Family> families;
    std::uint64_t count = 10000;  ///< cases per family and simplex
    std::uint64_t seed = 1;
    int threads = 0;  ///< 0: one per core
    OracleChoice oracle = OracleChoice::automatic;
    OracleAnswer (*cgal)(const Case&) = ask_cgal;        ///< for tests: who is asked as CGAL
    std::function<void(const AuditProgress&)> progress;  ///< called from one thread at a time
};

/// One family's part of a kernel's result.
struct FamilyResult {
    std::size_t family = 0;  ///< index into AuditReport::families
    KernelStatistics statistics;
};

struct KernelResult {
    Kernel kernel;
    KernelStatistics total;  ///< over all families; case indices are valid in `families` only
    std::vector<FamilyResult> families;
    Prediction prediction;           ///< over all families
    double ns = 0;                   ///< time per evaluation, median over blocks, with the call through a pointer
    std::vector<Witness> witnesses;  ///< the worst of each reason, in the order of Finding, worst_weight_ulp last
};

/// What each kind of run says of itself.
struct AuditRun {
    Environment environment;
    std::uint64_t seed = 0, count = 0;
    int threads = 0;
    double seconds = 0;
};

struct AuditReport : AuditRun {
    std::vector<std::string> meshes;
    std::vector<Verdict> verdicts;    ///< one per mesh
    std::vector<CurvedCells> curved;  ///< likewise: their cells were taken with straight sides
    std::vector<Family> families;
    std::uint64_t cases = 0;  ///< asked of the oracle
    OracleChoice oracle = OracleChoice::automatic;
    OracleCounts oracles;                    ///< who decided these cases
    std::array<std::uint64_t, 4> regions{};  ///< number of cases per exact Region
    std::vector<KernelResult> kernels;       ///< worst first
};

/// Errors: a floating-point environment in which results cannot be exact; no kernel; no family that applies; two
/// oracles that disagree, with the case.
Result<AuditReport> run_audit(const AuditOptions& options, const MeshSource& meshes);

/// The witness of the kernel's worst class of finding; null if it has none.
const Witness* worst_witness(const KernelResult& result);

/// {"schema": 1, "witnesses": [...]} of all kernels of a report, one witness a line of finding.
std::string witnesses_json(const AuditReport& report);

/// A kernel fails if its figure `name` exceeds `limit`.
struct Threshold {
    std::string name;
    double limit = 0;
};

/// A figure of a kernel that exceeds its threshold.
struct Violation {
    std::string kernel, figure;
    double value = 0, limit = 0;
};

/// NAME or NAME>NUMBER, NUMBER 0 by default. NAME: a class of finding, `wrong_cases` or `any` (cases with a finding),
/// an error in ulps or a residual: threshold_names(). Error sizes are taken over the cases that have one; without any,
/// because weights were not finite or the simplex was wrongly declared degenerate, they are infinite.
Result<Threshold> parse_threshold(std::string_view text);

std::vector<Violation> violations(const AuditReport& report, const std::vector<Threshold>& rules);

/// The names that parse_threshold() accepts.
std::vector<std::string> threshold_names();

// An audit compared with an earlier one. The same seed, count, families and meshes give the same cases, so that figures
// are compared exactly: one wrong case more is one more. Audits of different cases are not compared.

/// The figures of one kernel in one family.
struct BaselineEntry {
    std::string kernel, family;
    std::uint64_t cases = 0;
    std::uint64_t not_run = 0;               ///< of the others: cases left out, as the kernel had been given up
    std::array<std::uint64_t, 4> regions{};  ///< cases by exact region: tells the same cases from others
    std::vector<double> figures;             ///< in the order of baseline_figures(); -1: none
};

struct Baseline {
    std::string path;
    std::uint64_t seed = 0, count = 0;
    std::vector<std::string> meshes;
    std::vector<BaselineEntry> entries;
};

/// The figures that are compared: wrong_cases, not_run, classes of finding, errors, residuals. Less is better of each.
const std::vector<std::string>& baseline_figures();

/// Reads what `barycert audit --json` wrote. Errors: the file cannot be read, is not JSON or of another schema, or a
/// member is missing or malformed.
Result<Baseline> read_baseline(const std::string& path);

/// An Error if an audit with these options would not meet the cases of the baseline.
Status check_comparable(const Baseline& baseline, const AuditOptions& options, const MeshSource& meshes);

struct BaselineChange {
    std::string kernel, family, figure;
    double before = 0, after = 0;
};

struct BaselineComparison {
    std::uint64_t compared = 0;  ///< pairs of kernel and family
    /// Of those: given up in one audit, so that not_run alone is compared, or in both, so that nothing is.
    std::uint64_t given_up = 0;
    std::uint64_t not_now = 0;           ///< pairs of the baseline that this audit does not have
    std::uint64_t not_before = 0;        ///< pairs of this audit that the baseline does not have
    std::vector<BaselineChange> worse;   ///< in the order of the report
    std::vector<BaselineChange> better;  ///< likewise

    void add(BaselineChange change);  ///< to the one or the other, if it is one
};

/// Errors: other cases, told by their exact regions (a mesh has changed, or barycert's families); nothing in common.
Result<BaselineComparison> compare_with_baseline(const AuditReport& report, const Baseline& baseline);

// Kernels and families by names.

/// Kernels by their names, and those of users' libraries.
struct KernelChoice {
    std::vector<std::string> names = {};  ///< * and ? are wildcards; empty: all, beside libraries none of the catalogue
    std::vector<std::string> libraries = {};
    bool in_process = false;                     ///< else each library's kernel is run in a process of its own
    double seconds = 1;                          ///< that it may take for a case there
    std::optional<double> class_tolerance = {};  ///< of kernels that have no rule of their own
};

/// Of the catalogue, in its order, then those of the libraries. Error: a name that none has; a library that cannot be
/// loaded; two with one name.
Result<std::vector<Kernel>> choose_kernels(const KernelChoice& choice);

/// Exactly one: that of the library, or the one that the name has. Error also: both are given, or neither.
Result<Kernel> choose_kernel(const KernelChoice& choice);

/// Those that match one of the names, in their order; all if there is none. Error: a name that none has.
Result<std::vector<Family>> choose_families(const std::vector<std::string>& names);

// Rules that answer cases of their own. A tally has what a rule answers to the cases of a family.

template <class Rule, class Tally>
struct RuleResult {
    Rule rule;
    std::vector<Tally> families;
    Tally total;  ///< indices of cases mean nothing here
};

template <class Rule, class Tally>
struct RuleAudit {
    std::uint64_t seed = 1, count = 10000;                    ///< cases of each family, and shape
    int threads = 0;                                          ///< 0: one per core
    std::function<void(const AuditProgress&)> progress = {};  ///< called from one thread at a time
    std::vector<Rule> rules = {};                             ///< empty: all
    std::vector<RuleResult<Rule, Tally>> results = {};        ///< in the order of the rules
};

// Rules on triangles in space: how far a point is from a triangle, whether it is inside a closed surface, whether two
// triangles meet. Rules that are in use are held against CGAL's exact answers, on cases where such code is known to
// fail; barycert's own stand among them.

enum class SurfaceQuestion : std::uint8_t {
    distance,  ///< of the point from the only triangle
    inside,    ///< 1 if the point is inside the closed surface, else 0; of a point on it either is right
    meet,      ///< 1 if the two triangles have a point in common, else 0
};

constexpr std::string_view name(SurfaceQuestion q) {
    constexpr std::array<std::string_view, 3> names{"distance", "inside", "meet"};
    return names[static_cast<std::size_t>(q)];
}

using TriangleInSpace = std::array<double, 9>;  ///< corner after corner

struct SurfaceCase {
    std::vector<TriangleInSpace> triangles;  ///< of non-zero area
    std::array<double, 3> point{};
};

struct SurfaceRule {
    std::string name;  ///< `question.rule`
    SurfaceQuestion question{};
    std::string formula, source, fails;  ///< one line each, as those of Kernel
    double (*answer)(const SurfaceCase&) = nullptr;
};

struct SurfaceFamily {
    std::string name;  ///< `question.family`
    SurfaceQuestion question{};
    std::string tests;                                    ///< one line
    SurfaceCase (*make)(base::Random& random) = nullptr;  ///< case i depends on (seed, family, i) alone
};

/// All, in a fixed order.
const std::vector<SurfaceRule>& surface_rules();
const std::vector<SurfaceFamily>& surface_families();

SurfaceCase make_surface_case(const SurfaceFamily& family, std::uint64_t seed, std::uint64_t index);

/// What a rule answers to the cases of a family.
struct SurfaceTally {
    std::size_t family = 0;                     ///< index into surface_families()
    std::uint64_t cases = 0, yes = 0;           ///< the exact answer is yes; of a distance: it is 0
    std::uint64_t false_yes = 0, false_no = 0;  ///< the rule says yes, and it is no; and the reverse
    std::uint64_t not_finite = 0;               ///< of a distance
    LogHistogram ulps;                          ///< errors of finite distances that are exactly not 0
    WorstCase worst;                            ///< of them
    WorstCase wrong;                            ///< the first case with one of the three; value 1

    std::uint64_t wrong_cases() const { return false_yes + false_no + not_finite; }
    void add(SurfaceQuestion question, double answer, double exact, std::uint64_t index);
    void merge(const SurfaceTally& other);
};

using SurfaceAudit = RuleAudit<SurfaceRule, SurfaceTally>;

/// Fills `results`, the same for any number of threads, which it sets.
void audit_surfaces(SurfaceAudit& audit);

// Inverse maps: which point of the reference hexahedron, wedge, pyramid or quadrilateral is taken to a point, and the
// value there. Newton's method as it is in use is held against barycert's own maps, whose answers are proved
// (CellInterpolation::multilinear); a test holds these against Newton's method in 100 digits.

struct InverseCase {
    std::uint8_t type = 12;  ///< VTK's number: 9 of a quadrilateral in the plane, 12 hexahedron, 13 wedge, 14 pyramid
    std::vector<double> nodes;   ///< in VTK's order, 3 coordinates a node, 2 in the plane
    std::vector<double> values;  ///< one a node
    std::vector<double> point;
};

struct InverseAnswer {
    bool found = false;         ///< else there is no answer
    bool inside = false;        ///< the point is in the cell or on its boundary
    std::array<double, 3> x{};  ///< of the reference cell, 0 to 1
    double value = 0;
};

/// What is right. Without a proof that the map is injective the region is `degenerate`, and there is nothing else.
struct ExactInverse {
    Region region = Region::degenerate;
    /// Correctly rounded, of points in the cell; of x, of a pyramid the third alone, the others 0. NaN: not proved.
    std::array<double, 3> x{};
    double value = 0;
};

/// Precondition: a type of the rules (9, 12, 13, 14), and as many numbers as its nodes and axes ask for.
ExactInverse exact_inverse(const InverseCase& c);

struct InverseRule {
    std::string name;  ///< `shape.rule`
    std::uint8_t type = 12;
    std::string formula, source, fails;  ///< one line each, as those of Kernel
    std::function<InverseAnswer(const InverseCase&)> answer = {};
};

struct InverseFamily {
    std::string name, tests;  ///< one line
    /// Sets nodes and point of a case of that type, all else zero; the map is proved to be injective.
    void (*make)(InverseCase& c, base::Random& random) = nullptr;
};

/// All, in a fixed order.
const std::vector<InverseRule>& inverse_rules();
const std::vector<InverseFamily>& inverse_families();

/// Depends on these alone. Values are random, from -1 to 1. Precondition: a type of the rules (9, 12, 13, 14).
InverseCase make_inverse_case(const InverseFamily& family, std::uint8_t type, std::uint64_t seed, std::uint64_t index);

/// What a rule answers to the cases of a family.
struct InverseTally {
    std::size_t family = 0;  ///< index into inverse_families()
    std::uint64_t cases = 0;
    /// [exact region: interior, boundary, outside][inside, outside, no answer]
    std::array<std::array<std::uint64_t, 3>, 3> told{};
    LogHistogram x_ulps, value_ulps;  ///< errors of points rightly told inside, of numbers that are exactly not 0
    WorstCase x_ulp, value_ulp;
    ErrorSizes errors;  ///< of these values, relative to the range of the values at the nodes
    WorstCase wrong;    ///< the first wrong case; value 1

    /// Points of the cell told outside or without an answer; points outside told inside.
    std::uint64_t wrong_cases() const;
    void add(const InverseAnswer& answer, const ExactInverse& exact, const InverseCase& c, std::uint64_t index);
    void merge(const InverseTally& other);
};

using InverseAudit = RuleAudit<InverseRule, InverseTally>;

/// Likewise.
void audit_inverses(InverseAudit& audit);

}  // namespace barycert
