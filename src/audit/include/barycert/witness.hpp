/// Witnesses: cases that show a finding, their files, and what kernels answer to them today.
///
/// Example:
///
///     #include <cstdio>
///     for (const Witness& witness : read_witnesses("witnesses.json").value()) {
///         const Replay replay = replay_witness(witness, kernels_matching("*"));
///         if (!replay.not_reproduced.empty()) std::puts(replay.not_reproduced.c_str());
///     }
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "barycert/family.hpp"
#include "barycert/finding.hpp"
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

/// Case `index` of a family. `witness`, if given, is told the case and how it is made. Requires:
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

    /// Verdict on an identity: interpolation along auxiliary lines or, for perspective, ray casting gives the same
    /// weights. `undefined` for segments and triangle3d.
    IdentityVerdict identity = IdentityVerdict::undefined;
    std::vector<KernelAnswer> answers;  ///< of the kernels for such cases
    std::string not_reproduced;  ///< why it no longer shows its finding; empty if it does, or names no kernel or reason
};

Replay replay_witness(const Witness& witness, const std::vector<Kernel>& kernels);

inline constexpr int witness_schema = 1;

/// Reads the output of witnesses_json(), or the "witnesses" of an audit's JSON report, from a regular file or a pipe.
/// Errors: the file cannot be read, is not JSON or of another schema; a witness is malformed.
Result<std::vector<Witness>> read_witnesses(const std::string& path);

}  // namespace barycert
