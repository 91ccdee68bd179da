/// The audit: kernels x families x cases, each case asked of the oracle once.
///
/// Cases are made, asked and compared in blocks, on all threads. Memory does not grow with their number, and the
/// result (times aside) does not depend on the number of threads.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/check.hpp"
#include "barycert/environment.hpp"
#include "barycert/kernels.hpp"
#include "barycert/mesh.hpp"
#include "barycert/oracle.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"

// What an audit can find wrong with a kernel's answer, worst first.

namespace barycert {
class Random;
}

namespace barycert::audit {

enum class Finding : std::uint8_t {
    false_certificate,  // per case from here on
    false_declaration,
    false_inside,
    false_outside,
    missed_degenerate,
    opposite_sign,  // per weight from here on
    false_zero,
    false_nonzero,
    not_finite,
};

inline constexpr std::size_t finding_count = 9;

struct FindingText {
    std::string_view name;
    std::string_view meaning;
};

inline constexpr std::array<FindingText, finding_count> finding_texts{{
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
    for (std::size_t i = 0; i < finding_count; ++i) {
        if (finding_texts[i].name == text) return static_cast<Finding>(i);
    }
    return std::nullopt;
}

// One kernel's answer held against the oracle's.

/// What to hand to a kernel: weights that are not an answer.
inline constexpr std::array<double, 4> unset_weights = [] {
    std::array<double, 4> w{};
    w.fill(std::numeric_limits<double>::quiet_NaN());
    return w;
}();

struct Comparison {
    Region claimed = Region::outside;
    std::array<std::uint8_t, finding_count> counts{};  ///< weights, or 1 for a case, per class of finding
    std::array<double, 4> weight_ulps{};               ///< error of each weight in ulps; -1 where there is no measure
    double value_ulp = -1;                             ///< error of the value in ulps; -1 where there is no measure
    /// Largest |weight - exact weight|, infinite if a weight is not finite or none was given; for a missed degenerate
    /// simplex the largest weight.
    double weight_error = 0;

    bool wrong() const {
        for (const auto n : counts) {
            if (n != 0) return true;
        }
        return false;
    }
};

/// There is no measure in ulps where the exact number is zero (a wrong weight is then a false_nonzero), where either
/// is not finite, or where the simplex is degenerate. An exact weight beyond the largest double is measured from there.
/// `claimed` is always what the kernel's weights say; but a kernel whose weights are all correctly rounded has no
/// finding, even where they under- or overflow and so no longer tell the region.
Comparison compare(const Kernel& kernel, const Case& c, const exact::Answer& answer, int status,
                   std::span<const double> weights);

// Running totals of comparisons, of a size that does not depend on their number, and mergeable in any order.

/// Counts of non-negative numbers by magnitude. Bins are exact for the integers 0 to 16 and eight to an octave above,
/// up to 2^128; larger numbers share the last.
class LogHistogram {
public:
    void add(double x) { ++bins_[bin(x)]; }
    void merge(const LogHistogram& other);
    std::uint64_t total() const;

    /// The least bin edge that at least the given fraction of the numbers do not exceed; -1 if there are none.
    double quantile(double fraction) const;

private:
    static constexpr std::size_t bin_count = 1 + 8 * 128;
    static std::size_t bin(double x);
    static double upper_edge(std::size_t bin);
    std::array<std::uint64_t, bin_count> bins_{};
};

/// The largest value seen and the case it came from; of equal ones the first case, so that order does not matter.
struct Worst {
    double value = -1;
    std::uint64_t index = 0;  ///< of the case in its family

    void include(double v, std::uint64_t i) {
        if (v > value || (v == value && i < index)) *this = {v, i};
    }
};

/// What there is a witness of: every class of finding, then the error of a weight and of the value in ulps.
inline constexpr std::size_t witness_reasons = finding_count + 2;

/// "opposite_sign", ... "worst_weight_ulp", "worst_value_ulp".
constexpr std::string_view reason_name(std::size_t reason) {
    if (reason < finding_count) return finding_texts[reason].name;
    return reason == finding_count ? "worst_weight_ulp" : "worst_value_ulp";
}

struct Statistics {
    std::uint64_t cases = 0;
    std::uint64_t wrong_cases = 0;  ///< with at least one finding
    std::array<std::uint64_t, finding_count> counts{};
    std::array<std::array<std::uint64_t, 4>, 4> confusion{};  ///< [exact region][claimed region]
    LogHistogram weight_ulps;
    LogHistogram value_ulps;
    Worst weight_ulp;
    Worst value_ulp;
    Worst partition_residual;                      ///< |sum of weights - 1|, exact, rounded once
    Worst reproduction_residual;                   ///< |sum of weight * vertex - point|, exact, rounded once
    std::array<Worst, witness_reasons> witnesses;  ///< by Comparison::weight_error, the last two by ulps

    /// 99.9th percentiles: edges of bins, never above the worst; -1 if there is no measure.
    double p999_weight_ulp() const { return std::min(weight_ulps.quantile(0.999), weight_ulp.value); }
    double p999_value_ulp() const { return std::min(value_ulps.quantile(0.999), value_ulp.value); }

    void add(const Comparison& comparison, Region exact, std::uint64_t index);

    /// `index` of the result is the other's where the other is worse: merging different families needs care of that.
    void merge(const Statistics& other);
};

// What the condition number of a cell predicts of a kernel's error, beside what was measured.
//
// The prediction: where nothing under- or overflows, a kernel that works with differences of coordinates has weights
// within C * 2^-53 * kappa of the exact ones for points of the cell, with a small constant C (condition.hpp).
// Cases are sorted by log2(kappa), the bits that the cell may cost, one bit a bin.

/// kappa of the case's cell where there is something to predict: a triangle or tetrahedron, not degenerate, with the
/// point in it or on its boundary, and no product of differences far out in the range of double. NaN elsewhere.
/// `region` is the exact one.
double predicting_condition(const Case& c, Region region);

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

    /// The largest error / (2^-53 kappa) where kappa < 2^47, up to which the prediction is one of first order: the
    /// constant C that would have held. -1 without such cases.
    double worst_factor() const { return worst_factor_; }

    /// Those that hold cases, ascending.
    std::vector<Bin> bins() const;

private:
    struct Row {
        double worst = 0;
        std::vector<std::uint64_t> errors;  ///< by magnitude, as long as it takes
    };
    std::vector<Row> rows_;  ///< by bits, likewise
    double worst_factor_ = -1;
};

// Meshes as a supply of simplices for cases: cells, and the faces and edges of cells.

/// A mesh prepared for drawing simplices: its neighbours, hull and bounding box.
struct PreparedMesh {
    std::string name;
    Mesh mesh;
    std::vector<Mesh::Index> neighbours;    ///< as compute_neighbours gives them
    std::vector<std::int64_t> hull_facets;  ///< cell * corners + opposite corner
    std::array<double, 3> low{}, high{};    ///< bounding box
    check::Certificate certificate;         ///< what is known of the mesh
};

/// A simplex drawn from a mesh, with the cell it belongs to.
struct Draw {
    const PreparedMesh* from = nullptr;
    Mesh::Index cell = 0;
    std::array<Mesh::Index, 4> nodes{};
    Case simplex;  ///< vertices and nodal values set, point not
};

class MeshSource {
public:
    /// `certificate`: of this mesh, if it was checked.
    void add(std::string name, Mesh mesh, const check::Certificate& certificate = {});

    bool supplies(Simplex s) const;
    const std::vector<PreparedMesh>& meshes() const { return meshes_; }

    /// A random cell, or a random face or edge of one. Nodal values are a component of one of the mesh's point fields,
    /// drawn as well, or random in [-1, 1) if it has none. Precondition: supplies(s).
    Draw any(Simplex s, Random& random) const;

    /// A random cell at the hull, its vertices ordered so that the hull's facet is the one opposite to the last.
    Draw at_hull(Simplex s, Random& random) const;

    /// The simplex that given nodes make.
    static Draw from_nodes(const PreparedMesh& from, Mesh::Index cell, std::array<Mesh::Index, 4> nodes, Simplex s,
                           Random& random);

private:
    const PreparedMesh& pick(Simplex s, Random& random) const;
    std::vector<PreparedMesh> meshes_;
};

// Families: recipes for cases, each after a particular way of going wrong.
//
// Case number i of a family depends on (seed, family, simplex, i) and, for mesh families, on the meshes; on nothing
// else. Only correctly rounded operations are used (+ - * / sqrt and powers of two), so the same seed gives the same
// bits on every machine.

struct Family {
    std::string name;
    std::string after;       ///< what it is after, one line
    std::string parameters;  ///< the recipe with its numbers
    bool needs_mesh = false;
    std::vector<Simplex> simplices;

    /// Fills `c` (its simplex is set, all else zero). `index` is the case's number.
    using Recipe = void (*)(Case& c, Random& random, std::uint64_t index);
    Recipe recipe = nullptr;

    using MeshRecipe = void (*)(Case& c, Random& random, const MeshSource& meshes);
    MeshRecipe mesh_recipe = nullptr;

    bool applies_to(Simplex s) const;
};

/// All families in a fixed order, those from meshes first.
const std::vector<Family>& all_families();

std::vector<Family> families_matching(std::string_view glob);

/// The case. Preconditions: family.applies_to(s); family.needs_mesh implies meshes.supplies(s).
Case make_case(const Family& family, Simplex s, std::uint64_t seed, std::uint64_t index, const MeshSource& meshes);

/// The parts of all_families(): from meshes, and built.
std::vector<Family> mesh_families();
std::vector<Family> near_families();
std::vector<Family> shape_families();
std::vector<Family> range_families();

// The audit: kernels x families x cases, each case asked of the oracle once.
//
// Cases are made, asked and compared in blocks, on all threads. Memory does not grow with their number, and the
// result (times aside) does not depend on the number of threads.

struct Progress {
    std::uint64_t cases_done = 0;
    std::uint64_t cases_total = 0;
    std::string family;
};

struct Options {
    std::vector<Kernel> kernels;
    std::vector<Family> families;
    std::uint64_t count = 10000;  ///< cases per family and simplex
    std::uint64_t seed = 1;
    int threads = 0;                                ///< 0: as many as the machine has
    std::function<void(const Progress&)> progress;  ///< called now and then, from one thread at a time
};

/// One family's part of a kernel's result.
struct FamilyResult {
    std::size_t family = 0;  ///< index into Report::families
    Statistics statistics;
};

/// A case that shows a finding, and how to make it again.
struct Witness {
    std::string kernel;
    std::string reason;  ///< class of finding, or "worst_weight_ulp"
    std::string family;
    std::uint64_t seed = 0;
    std::uint64_t index = 0;
    double magnitude = 0;  ///< |weight - exact weight|, or ulps
    Case c;
};

struct KernelResult {
    Kernel kernel;
    Statistics total;  ///< indices in it are meaningless: ask the families
    std::vector<FamilyResult> families;
    Prediction prediction;           ///< over all families
    double ns = 0;                   ///< median over blocks of the time per evaluation, call through a pointer included
    std::vector<Witness> witnesses;  ///< the worst of each reason, in the order of Finding, worst_weight_ulp last
};

struct Report {
    Environment environment;
    std::uint64_t seed = 0;
    std::uint64_t count = 0;
    int threads = 0;
    std::vector<std::string> meshes;
    std::vector<check::Verdict>
        verdicts;  ///< one a mesh: whether it is certified to be a partition, or was not checked
    std::vector<Family> families;
    std::uint64_t cases = 0;                 ///< asked of the oracle
    std::array<std::uint64_t, 4> regions{};  ///< how many of them were what, exactly; by Region
    double seconds = 0;
    std::vector<KernelResult> kernels;  ///< worst first
};

/// Errors: an environment in which results could not be exact; nothing to audit (no kernel, no family that applies).
Result<Report> run(const Options& options, const MeshSource& meshes);

/// The most telling witness of a kernel, or null if it has none.
const Witness* worst_witness(const KernelResult& result);

// A witness asked again: the exact answer, and what each kernel says today.

struct KernelAnswer {
    std::string kernel;
    int status = 0;  ///< 1: declared degenerate
    std::array<double, 4> weights{};
    Comparison comparison;
    double worst_weight_ulp = -1;
};

struct Replay {
    Witness witness;
    exact::Answer exact;
    int affine_dimension = 0;  ///< of the simplex

    /// Interpolation along auxiliary lines against ratios of areas or volumes, in rational numbers; `undefined` for
    /// segments and triangle3d.
    exact::Identity identity = exact::Identity::undefined;
    std::vector<KernelAnswer> answers;  ///< of the kernels on this simplex

    /// Why the witness no longer shows what it says of its kernel; empty if it does, or says nothing.
    std::string not_reproduced;
};

Replay replay(const Witness& witness, const std::vector<Kernel>& kernels);

// Rules that turn a report into a verdict: `NAME` or `NAME>NUMBER`.

/// A kernel fails if its figure `name` exceeds `limit`.
struct Rule {
    std::string name;
    double limit = 0;
};

/// A figure of a kernel that a rule refused.
struct Violation {
    std::string kernel;
    std::string figure;
    double value = 0;
    double limit = 0;
};

/// NAME is a class of finding (counts), `wrong_cases` or `any` (cases with any finding), `worst_weight_ulp`,
/// `p999_weight_ulp`, `worst_value_ulp`, `p999_value_ulp`, `worst_partition_residual` or `worst_reproduction_residual`.
/// NUMBER is 0 if left out. Sizes of errors are taken over what could be measured; where that is nothing because
/// weights were not finite or the simplex was falsely declared degenerate, they are infinite. Pair them with `any`.
Result<Rule> parse_rule(std::string_view text);

std::vector<Violation> violations(const Report& report, const std::vector<Rule>& rules);

/// The names that parse_rule() knows, for help texts.
std::vector<std::string> rule_names();

// Witnesses as JSON: coordinates in hexadecimal floating point, so that they read back to the same bits.

inline constexpr int witness_schema = 1;

/// {"schema": 1, "witnesses": [...]} of all kernels of a report, one witness a line of finding.
std::string witness_file(const Report& report);

/// Reads what witness_file() wrote, or the "witnesses" of an audit's JSON report: from a regular file, or a pipe that
/// is being written to. Errors: the file cannot be read, is not JSON or of another schema; a witness is malformed.
Result<std::vector<Witness>> read_witnesses(const std::string& path);

}  // namespace barycert::audit
