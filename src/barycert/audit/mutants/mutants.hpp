/// How the file of each kind of kernel adds its mutants.
#pragma once

#include "barycert/audit_search.hpp"

namespace barycert::audit {

void add_plain_mutants(std::vector<Mutant>& list);
void add_certified_mutants(std::vector<Mutant>& list);

/// A mutant of a kernel: the same but for its weights.
inline Mutant mutant_of(const Kernel& sound, const char* fault, const char* change, WeightsFunction weights) {
    Mutant m{sound, sound, fault, change};
    m.kernel.name += std::string("!") + fault;
    m.kernel.weights = weights;
    m.kernel.fails = change;
    return m;
}

/// A kernel of the catalogue.
inline Kernel catalogued(const char* name) {
    return kernels_matching(name).at(0);
}

}  // namespace barycert::audit
