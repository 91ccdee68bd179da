/// Witnesses: cases that show a finding, their files, and what kernels answer to them today.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "barycert/audit_findings.hpp"
#include "barycert/kernels.hpp"
#include "barycert/oracle.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"

namespace barycert {

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

struct KernelAnswer {
    std::string kernel;
    bool answered = true;  ///< false: it ended, or took too long
    int status = 0;        ///< 1: declared degenerate
    std::array<double, 4> weights{};
    Comparison comparison;
    double worst_weight_ulp = -1;
    std::string detail;  ///< what it did besides answering, in words; empty if nothing
};

struct Replay {
    Witness witness;
    OracleAnswer exact;
    int affine_dimension = 0;  ///< of the simplex

    /// Whether interpolation along auxiliary lines gives the barycentric weights, in rational numbers, or, for
    /// perspective, ray casting the perspective-correct ones; `undefined` for segments and triangle3d.
    IdentityVerdict identity = IdentityVerdict::undefined;
    std::vector<KernelAnswer> answers;  ///< of the kernels for such cases

    /// Why the witness no longer shows its finding; empty if it does, or if it names no kernel or reason.
    std::string not_reproduced;
};

Replay replay_witness(const Witness& witness, const std::vector<Kernel>& kernels);

struct AuditReport;

inline constexpr int witness_schema = 1;

/// {"schema": 1, "witnesses": [...]} of all kernels of a report, one witness a line of finding.
std::string witnesses_json(const AuditReport& report);

/// Reads the output of witnesses_json(), or the "witnesses" of an audit's JSON report, from a regular file or a pipe.
/// Errors: the file cannot be read, is not JSON or of another schema; a witness is malformed.
Result<std::vector<Witness>> read_witnesses(const std::string& path);

}  // namespace barycert
