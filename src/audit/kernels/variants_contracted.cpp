// Compiled with -mfma -ffp-contract=fast. Call them only on a CPU with FMA (CMakeLists.txt beside this file).
#include "audit/kernels/tetrahedron_formulas.hpp"
#include "audit/kernels/triangle_formulas.hpp"
#include "audit/kernels/variants.hpp"

namespace barycert::kernels {

constexpr Variants contracted_variants{&signed_area<double>, &signed_volume<double>, &two_cross_products<double>,
                                       &cramer<double>};

}  // namespace barycert::kernels
