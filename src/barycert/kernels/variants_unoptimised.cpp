// Compiled with -O0 (CMakeLists.txt beside this file).
#include "barycert/kernels/tetrahedron_formulas.hpp"
#include "barycert/kernels/triangle_formulas.hpp"
#include "barycert/kernels/variants.hpp"

namespace barycert::kernels {

constexpr Variants unoptimised_variants{&signed_area<double>, &signed_volume<double>, &two_cross_products<double>,
                                        &cramer<double>};

}  // namespace barycert::kernels
