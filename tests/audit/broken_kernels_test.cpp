// Six ways to break a kernel, each seen in public code, each found by the audit. The sound kernel beside it is clean in
// the same family, so that what is found is the fault and not the family.

#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>

#include "audit_helpers.hpp"

namespace barycert::audit {
namespace {

using Vector = std::array<double, 3>;

/// Signed volumes of the point with each face, by two cross products; their sum is the whole.
std::array<double, 4> volumes(const double* v, const double* p) {
    const auto at = [&](int i) { return Vector{v[3 * i] - p[0], v[3 * i + 1] - p[1], v[3 * i + 2] - p[2]}; };
    const auto cross = [](const Vector& a, const Vector& b) {
        return Vector{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    const auto dot = [](const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    const Vector ab = cross(at(0), at(1)), cd = cross(at(2), at(3));
    return {dot(at(1), cd), -dot(at(0), cd), dot(at(3), ab), -dot(at(2), ab)};
}

int divided(const std::array<double, 4>& n, double whole, double* w) {
    if (whole == 0) return 1;
    for (std::size_t i = 0; i < 4; ++i) w[i] = n[i] / whole;
    return 0;
}

int sound(const double* v, const double* p, double* w) {
    const auto n = volumes(v, p);
    return divided(n, n[0] + n[1] + n[2] + n[3], w);
}

int flipped_sign(const double* v, const double* p, double* w) {
    const int status = sound(v, p, w);
    w[2] = -w[2];
    return status;
}

int swapped_vertices(const double* v, const double* p, double* w) {
    const int status = sound(v, p, w);
    std::swap(w[0], w[1]);
    return status;
}

int dropped_term(const double* v, const double* p, double* w) {
    auto n = volumes(v, p);
    const double whole = n[0] + n[1] + n[2] + n[3];
    const Vector a{v[0] - p[0], v[1] - p[1], v[2] - p[2]}, c{v[6] - p[0], v[7] - p[1], v[8] - p[2]},
        d{v[9] - p[0], v[10] - p[1], v[11] - p[2]};
    n[1] += a[2] * (c[0] * d[1] - c[1] * d[0]);  // takes the third term of one determinant away
    return divided(n, whole, w);
}

int guarded_denominator(const double* v, const double* p, double* w) {
    const auto n = volumes(v, p);
    const double whole = n[0] + n[1] + n[2] + n[3] + 1e-50;
    for (std::size_t i = 0; i < 4; ++i) w[i] = n[i] / whole;
    return 0;
}

int forced_closure(const double* v, const double* p, double* w) {
    const int status = sound(v, p, w);
    w[3] = 1 - w[0] - w[1] - w[2];
    return status;
}

int clamped(const double* v, const double* p, double* w) {
    if (sound(v, p, w) != 0) return 1;
    double sum = 0;
    for (int i = 0; i < 4; ++i) sum += w[i] = std::max(w[i], 0.0);
    for (int i = 0; i < 4; ++i) w[i] /= sum;
    return 0;
}

Kernel kernel(WeightsFunction weights) {
    Kernel k = kernel_named("tetrahedron.two-cross-products");
    k.name = "tetrahedron.under-test";
    k.weights = weights;
    return k;
}

KernelStatistics audited(WeightsFunction weights, const std::string& family) {
    return statistics_of(kernel(weights), family, 2000, own_meshes());
}

TEST(BrokenKernels, TheSoundOneIsCleanWhereTheyAreFound) {
    for (const char* family : {"mesh.inside", "random.inside", "random", "degenerate.plane", "near-facet.1e-15"}) {
        EXPECT_EQ(audited(sound, family).wrong_cases, 0U) << family;
    }
    EXPECT_LT(audited(sound, "random.inside").weight_ulps.quantile(0.5), 8);
}

TEST(BrokenKernels, FlippedSign) {
    const KernelStatistics s = audited(flipped_sign, "mesh.inside");
    EXPECT_EQ(count_of(s, Finding::opposite_sign), s.cases);
    EXPECT_EQ(count_of(s, Finding::false_outside), s.cases);
}

TEST(BrokenKernels, SwappedVertices) {
    // Inside, every sign is still right: only the size of the error tells, and the point that the weights reproduce.
    const KernelStatistics inside = audited(swapped_vertices, "random.inside");
    EXPECT_EQ(inside.wrong_cases, 0U);
    EXPECT_GT(inside.weight_ulps.quantile(0.75), 1e12);  // two weights of four
    EXPECT_GT(inside.reproduction_residual.value, 0.1);
    EXPECT_LT(inside.partition_residual.value, 1e-14);  // the sum is 1 as it should be: no help
    EXPECT_GT(share(inside, count_of(audited(swapped_vertices, "random"), Finding::opposite_sign)), 0.3);
}

TEST(BrokenKernels, DroppedTerm) {
    const KernelStatistics s = audited(dropped_term, "mesh.inside");
    EXPECT_GT(share(s, s.wrong_cases), 0.05);
    EXPECT_GT(s.weight_ulps.quantile(0.9), 1e9);  // one weight of four
    EXPECT_GT(s.partition_residual.value, 1e-3);
}

TEST(BrokenKernels, AbsoluteGuardInTheDenominator) {
    const KernelStatistics s = audited(guarded_denominator, "degenerate.plane");
    EXPECT_EQ(count_of(s, Finding::missed_degenerate), s.cases);
    // Where volumes are of the guard's size it is no guard but a wrong divisor.
    const KernelStatistics tiny = statistics_of(kernel(guarded_denominator), "tiny", 2000);
    EXPECT_GT(count_of(tiny, Finding::false_zero),
              count_of(statistics_of(kernel(sound), "tiny", 2000), Finding::false_zero));
}

TEST(BrokenKernels, ForcedClosure) {
    // Points of faces that the sound kernel finds exactly: the closure puts rounding noise where a zero belongs.
    ASSERT_EQ(audited(sound, "lattice.integers").wrong_cases, 0U);
    const KernelStatistics s = audited(forced_closure, "lattice.integers");
    EXPECT_GT(count_of(s, Finding::false_nonzero), 0U);
}

TEST(BrokenKernels, Clamp) {
    const KernelStatistics s = audited(clamped, "random");
    const auto& outside = s.confusion[static_cast<std::size_t>(Region::outside)];
    EXPECT_EQ(outside[static_cast<std::size_t>(Region::outside)], 0U);
    EXPECT_EQ(count_of(s, Finding::false_inside), s.cases - s.confusion[0][0]);
}

int sets_nothing(const double*, const double*, double*) {
    return 0;
}

int leaves_another_rounding_mode(const double* v, const double* p, double* w) {
    const int status = sound(v, p, w);
    std::fesetround(FE_UPWARD);
    return status;
}

// Weights that a kernel does not set are no answer, and least of all the answer of the kernel before it.
TEST(BrokenKernels, UnsetWeightsAreNotFinite) {
    Kernel lazy = kernel(sets_nothing);
    lazy.name = "tetrahedron.lazy";
    const AuditReport r = audit_of({kernel(sound), lazy}, {family_named("random.inside")}, 500);
    ASSERT_EQ(r.kernels.front().kernel.name, "tetrahedron.lazy");
    EXPECT_EQ(count_of(r.kernels.front().total, Finding::not_finite), 4 * r.cases);
}

TEST(BrokenKernels, ARoundingModeLeftBehindStaysWithItsKernel) {
    Kernel rude = kernel(leaves_another_rounding_mode);
    rude.name = "tetrahedron.rude";
    const AuditReport beside =
        audit_of({rude, kernel_named("tetrahedron.kahan")}, {family_named("near-facet.1e-14")}, 500, {}, 1);
    EXPECT_EQ(std::fegetround(), FE_TONEAREST);
    const KernelStatistics alone = statistics_of("tetrahedron.kahan", "near-facet.1e-14", 500);
    for (const KernelResult& k : beside.kernels) {
        if (k.kernel.name == "tetrahedron.kahan") {
            EXPECT_EQ(k.total.weight_ulp.value, alone.weight_ulp.value);
        }
    }
}

// One of the six among the whole catalogue is put first by the order of the table.
TEST(BrokenKernels, WorstFirst) {
    std::vector<Kernel> kernels{kernel_named("tetrahedron.cramer"), kernel(flipped_sign),
                                kernel_named("tetrahedron.kahan")};
    const AuditReport r = audit_of(kernels, {family_named("random.inside")}, 500);
    EXPECT_EQ(r.kernels.front().kernel.name, "tetrahedron.under-test");
}

TEST(BrokenKernels, AFalseCertificateOutranksEverything) {
    Kernel certified = kernel_named("tetrahedron.cramer");
    certified.name = "tetrahedron.certified";
    certified.certifies = true;
    const AuditReport r = audit_of({kernel(flipped_sign), certified}, {family_named("random.inside")}, 500);
    EXPECT_EQ(r.kernels.front().kernel.name, "tetrahedron.certified");
    EXPECT_EQ(r.kernels.front().witnesses.front().reason, "false_certificate");
}

}  // namespace
}  // namespace barycert::audit
