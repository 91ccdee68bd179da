/// Which SIMD target batches run on. Answers never depend on it; time does.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace barycert {

/// Names of the targets that this build has and this processor can run, the widest first: on x86-64 "AVX-512", "AVX2"
/// and "scalar", the fallback that every processor can run.
std::vector<std::string> simd_targets();

/// The target in use.
std::string simd_target();

/// Use this target from now on; an empty name restores the choice at start. Returns false, and changes nothing, if the
/// name is none of simd_targets(). For tests and measurements: not to be called while a batch runs.
bool use_simd_target(std::string_view name);

}  // namespace barycert
