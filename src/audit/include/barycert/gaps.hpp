/// Gaps and overlaps: does a kernel give each point of a mesh to a cell that holds it, and to one only? Cells are asked
/// one by one. At points on shared faces, edges and vertices, and within a few ulps of them, a kernel that rounds may
/// have no cell say yes (a gap: the point is lost), several, or a cell that does not hold the point.
///
/// Example:
///
///     const Mesh mesh{.dimension = 2, .points = {0, 0, 1, 0, 0, 1}, .cells = {0, 1, 2}};
///     const GapsReport report = find_gaps({}, mesh, "triangle", Verdict::not_checked).value();
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/audit.hpp"
#include "barycert/certificate.hpp"
#include "barycert/kernels.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"

namespace barycert {

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

}  // namespace barycert
