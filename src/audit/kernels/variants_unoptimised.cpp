// Compiled with -O0 (CMakeLists.txt beside this file).
#include "audit/kernels/tetrahedron_formulas.hpp"
#include "audit/kernels/triangle_formulas.hpp"
#include "audit/kernels/variants.hpp"

namespace barycert::kernels {

constexpr Variants unoptimised_variants{&signed_area<double>, &signed_volume<double>, &two_cross_products<double>,
                                        &cramer<double>};

}  // namespace barycert::kernels
