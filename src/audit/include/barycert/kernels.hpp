/// The catalogue of kernels: plain floating-point formulas for barycentric weights, and barycert's own exact ones.
///
/// Input: the vertices of one simplex and a point, as doubles. Output: one weight a vertex, or the kernel's own
/// statement that the simplex is degenerate. Kernels are what the audit puts to the test: the plain ones are written as
/// the literature writes them, faults included, and nothing in barycert relies on them; `*.exact` call weights.hpp.
///
/// Example:
///
///     const std::vector<Kernel> kernels = kernels_matching("triangle.*");
///     const Result<Kernel> own = load_contained_kernel("./libmykernel.so");  // in a process of its own
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/result.hpp"
#include "barycert/simplex.hpp"

namespace barycert {

namespace kernels {
class Host;
}

/// Weights of `point` in the simplex at `vertices` (layout of Case: of kernels for perspective, x, y, w a vertex).
/// Returns 0 if `weights` is set, 1 if the kernel declares the simplex degenerate (then `weights` is unspecified). Same
/// signature as in barycert/kernel.h.
using WeightsFunction = int (*)(const double* vertices, const double* point, double* weights);

/// The interpolated value from weights and nodal values.
using ValueFunction = double (*)(const double* weights, const double* values);

/// How a point's region is read from a kernel's weights.
enum class RegionRule : unsigned char {
    sign,      ///< any < 0 outside; else any = 0 boundary; else interior
    tolerant,  ///< every weight >= -tolerance interior; else outside
    own,       ///< the kernel's own classification: Kernel::classify
};

/// The kernel's own classification: the number of a Region (any other counts as degenerate). `weights` are those that
/// it gave before. Same signature as in barycert/kernel.h.
using ClassifyFunction = int (*)(const double* vertices, const double* point, const double* weights);

/// The interpolated value straight from the case, for a kernel that does better than to sum up rounded weights.
using CaseValueFunction = double (*)(const double* vertices, const double* point, const double* values);

struct Kernel {
    std::string name;  ///< `simplex.formula[.variant]`, the handle on the command line
    Simplex simplex = Simplex::tetrahedron;
    bool perspective = false;          ///< for cases with Case::perspective, and no others
    std::string formula;               ///< one line of mathematics
    std::string source;                ///< where the formula is published or in use
    std::string fails;                 ///< one line: where and why it goes wrong
    bool declares_degenerate = false;  ///< compares its divisor with 0; the others do not look
    bool certifies = false;  ///< promises exact signs and correctly rounded weights: any finding is then the worst kind
    RegionRule rule = RegionRule::sign;
    double tolerance = 0;                 ///< for RegionRule::tolerant
    ClassifyFunction classify = nullptr;  ///< for RegionRule::own
    WeightsFunction weights = nullptr;
    ValueFunction value = nullptr;
    CaseValueFunction interpolate = nullptr;  ///< if set, used instead of `value`; certified with the weights
    bool core = false;  ///< computes with barycert's own core, which then cannot be the one that judges it

    /// The process of a kernel that runs in one of its own: then the functions above, `value` aside, are null.
    std::shared_ptr<kernels::Host> host;
    /// Set for a callable: returns the exception of its last call, in words, after which `weights` returned 1; empty if
    /// it raised none.
    std::string (*raised)() = nullptr;
    std::string note;  ///< what was noticed when its library was loaded; may be empty
};

/// All kernels that run on this machine, grouped by simplex, in a fixed order.
const std::vector<Kernel>& catalogue();

/// Returns the kernels of the catalogue whose name matches the glob.
std::vector<Kernel> kernels_matching(std::string_view glob);

/// The region that `kernel` claims for a point, by its weights: degenerate if it declared so or a weight is not finite.
/// Requires a rule other than RegionRule::own.
Region claimed_region(const Kernel& kernel, int status, std::span<const double> weights);

/// A kernel from a shared library with the functions of barycert/kernel.h. The library stays loaded. Errors: the file
/// is no whole shared library for this machine, as far as its headers tell, or none with these functions. Its code runs
/// in this process and is trusted.
Result<Kernel> load_kernel_library(const std::string& path);

/// The same in a process of its own, so that accidents (a crash, no answer within `seconds`, a write beside its arrays,
/// a changed floating-point environment, output) become findings of an audit; no protection against malice. The process
/// ends with the last copy of the Kernel. Forks: call it before there are threads, as far as that can be.
Result<Kernel> load_contained_kernel(const std::string& path, double seconds = 1);

}  // namespace barycert
