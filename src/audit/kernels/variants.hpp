/// The same formulas compiled again under other flags. Declarations only: a source with flags of its own
/// must not emit an inline function that the linker could take for everyone.
#pragma once

namespace barycert::kernels {

struct Variants {
    using Function = int (*)(const double* vertices, const double* point, double* weights);
    Function signed_area, signed_volume, two_cross_products, cramer;
};

extern const Variants fast_math_variants;    ///< -ffast-math
extern const Variants contracted_variants;   ///< -mfma -ffp-contract=fast; x86-64 with FMA only
extern const Variants unoptimised_variants;  ///< -O0

}  // namespace barycert::kernels
