/// Kernels and families by their names.
///
/// Example:
///
///     const std::vector<Kernel> kernels = choose_kernels({.names = {"triangle.*"}}).value();
///     const std::vector<Family> families = choose_families({}).value();  // all
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "barycert/family.hpp"
#include "barycert/kernels.hpp"
#include "barycert/result.hpp"

namespace barycert {

/// Kernels by their names, and those of users' libraries.
struct KernelChoice {
    std::vector<std::string> names = {};  ///< * and ? are wildcards; empty: all, beside libraries none of the catalogue
    std::vector<std::string> libraries = {};
    bool in_process = false;                     ///< else each library's kernel is run in a process of its own
    double seconds = 1;                          ///< that it may take for a case there
    std::optional<double> class_tolerance = {};  ///< of kernels that have no rule of their own
};

/// Returns the chosen kernels of the catalogue, in its order, then those of the libraries. Error: a name that no kernel
/// has; a library that cannot be loaded; two kernels with one name.
Result<std::vector<Kernel>> choose_kernels(const KernelChoice& choice);

/// Exactly one: that of the library, or the one that the name has. Error also: both are given, or neither.
Result<Kernel> choose_kernel(const KernelChoice& choice);

/// Returns the families that match one of the names, in their order; all if there is no name. Error: a name that no
/// family has.
Result<std::vector<Family>> choose_families(const std::vector<std::string>& names);

}  // namespace barycert
