/// Code that the kernels of this folder share. Each is one formula of a known library as barycert/kernel.h has it,
/// under a name with the version of the library.
#pragma once

#include "barycert/kernel.h"

namespace barycert::libraries {

inline void describe(struct barycert_kernel_info* info, const char* name, const char* simplex, const char* formula,
                     const char* source, bool declares_degenerate) {
    info->abi = BARYCERT_KERNEL_ABI;
    info->name = name;
    info->simplex = simplex;
    info->formula = formula;
    info->source = source;
    info->declares_degenerate = declares_degenerate ? 1 : 0;
}

}  // namespace barycert::libraries
