// Compiled with -ffast-math, without contraction (CMakeLists.txt beside this file).
#include "audit/kernels/tetrahedron_formulas.hpp"
#include "audit/kernels/triangle_formulas.hpp"
#include "audit/kernels/variants.hpp"

namespace barycert::kernels {

constexpr Variants fast_math_variants{&signed_area<double>, &signed_volume<double>, &two_cross_products<double>,
                                      &cramer<double>};

}  // namespace barycert::kernels
