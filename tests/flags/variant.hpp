/// Interface of a library of formulas. It uses no standard library, whose inline functions would be compiled under the
/// variant's flags.
#pragma once

using FlagsFunction = int (*)(const double* vertices, const double* point, double* weights);

struct FlagsEntry {
    const char* name;  ///< as in the catalogue
    FlagsFunction weights;
};

extern "C" const FlagsEntry* flags_entries(int* count);
