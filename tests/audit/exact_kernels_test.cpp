// barycert's own kernels in the audit: no finding in any family, not the last bit off.

#include <gtest/gtest.h>
#include <cmath>

#include "audit_helpers.hpp"

namespace barycert::audit {
namespace {

TEST(ExactKernels, HaveNoFindingInAnyFamily) {
    auto kernels = kernels_matching("*.exact");
    ASSERT_EQ(kernels.size(), all_simplices.size());
    kernels.push_back(kernel_named("triangle.perspective-exact"));
    const AuditReport r = audit_of(kernels, all_families(), 2000, own_meshes());
    for (const KernelResult& k : r.kernels) {
        EXPECT_GE(k.total.cases, 2000U * (k.kernel.perspective ? 5 : 20)) << k.kernel.name;
        EXPECT_EQ(k.total.wrong_cases, 0U) << k.kernel.name;
        for (std::size_t f = 0; f < finding_count; ++f) EXPECT_EQ(k.total.counts[f], 0U) << k.kernel.name << ' ' << f;
        EXPECT_EQ(k.total.weight_ulp.value, 0) << k.kernel.name;
        EXPECT_EQ(k.total.value_ulp.value, 0) << k.kernel.name;
    }
}

/// A value one ulp off, by a kernel whose weights are right.
double off_by_one_ulp(const double* vertices, const double* point, const double* values) {
    const double v = kernels_matching("tetrahedron.exact").at(0).interpolate(vertices, point, values);
    return std::nextafter(v, 2 * v + 1);
}

// Catches a certificate that speaks of the weights alone.
TEST(ExactKernels, AreHeldToTheLastBitOfTheValue) {
    auto kernels = kernels_matching("tetrahedron.exact");
    kernels.at(0).interpolate = off_by_one_ulp;
    const AuditReport r = audit_of(kernels, {family_named("random.inside")}, 100);
    EXPECT_EQ(r.kernels.at(0).total.counts[static_cast<std::size_t>(Finding::false_certificate)], 100U);
}

}  // namespace
}  // namespace barycert::audit
