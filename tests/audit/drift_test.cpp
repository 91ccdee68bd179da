// Drift: increments lose with the size, kernels that compute each pixel afresh do not.

#include "barycert/audit_pictures.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "audit_helpers.hpp"
#include "barycert/audit_report.hpp"

namespace barycert::audit {
namespace {

DriftReport drift_of(const std::vector<const char*>& names, std::uint64_t count = 500) {
    DriftOptions options;
    for (const char* name : names) options.kernels.push_back(kernel_named(name));
    options.count = count;
    return measure_drift(options).value();
}

TEST(Drift, GrowsWithTheSizeForIncrementsAlone) {
    const DriftReport r = drift_of({"triangle.scanline-increments", "triangle.scanline-increments.float32",
                                    "triangle.bilinear", "triangle.signed-area", "triangle.exact"});
    ASSERT_EQ(r.curves.size(), 5U);
    for (const DriftCurve& curve : r.curves) {
        ASSERT_EQ(curve.points.size(), 11U);
        int size = 4;
        for (const DriftPoint& p : curve.points) {
            EXPECT_EQ(p.size, size);
            size *= 2;
            EXPECT_GT(p.cases, 400U) << curve.kernel.name;
            // An ulp is 2^-52 between 1 and 2.
            EXPECT_LE(p.worst_relative, p.worst_ulp * 0x1p-52);
            EXPECT_GE(p.worst_relative, p.worst_ulp * 0x1p-53 * 0.999);
        }
    }
    const auto growth = [&](std::size_t k) {
        return r.curves[k].points.back().worst_ulp / r.curves[k].points.front().worst_ulp;
    };
    EXPECT_GT(growth(0), 50);
    EXPECT_GT(growth(1), 50);
    EXPECT_LT(growth(2), 50);
    EXPECT_LT(growth(3), 50);
    for (const DriftPoint& p : r.curves[3].points) EXPECT_LE(p.worst_ulp, 8) << p.size;
    for (const DriftPoint& p : r.curves[4].points) EXPECT_EQ(p.worst_ulp, 0) << p.size;
}

// The worst case of a curve, made again, has the error of the curve.
TEST(Drift, TheWorstCaseIsTheOneNamed) {
    const DriftReport r = drift_of({"triangle.scanline-increments"}, 200);
    const Kernel& k = kernel_named("triangle.scanline-increments");
    for (const DriftPoint& p : r.curves[0].points) {
        const Case c = drift_case(p.size, r.seed, p.index);
        const double value = k.interpolate(c.vertices.data(), c.point.data(), c.values.data());
        EXPECT_EQ(std::fabs(value - ask_oracle(c).value) / 0x1p-52, p.worst_ulp);
    }
}

// A kernel that crashes has no value: that is told, and is not an error of 0.
TEST(Drift, WithoutAValueThereIsNoError) {
    const DriftReport r =
        measure_drift(
            {.kernels = {load_contained_kernel(BARYCERT_UNRULY_DIR "/unruly-triangle.so", 1).value()}, .count = 2})
            .value();
    for (const DriftPoint& p : r.curves.at(0).points) {
        EXPECT_EQ(p.cases, 0U);
        EXPECT_EQ(p.not_finite, 2U);
    }
    const std::string text = drift_text(r, {});
    EXPECT_NE(text.find("\ntriangle.unruly         -         -"), std::string::npos) << text;
    EXPECT_NE(text.find("-  and 22 cases without a finite value\n"), std::string::npos) << text;
    const std::string plot = drift_plot(r);
    EXPECT_EQ(plot.find("<polyline"), plot.rfind("<polyline")) << "more than the frame";
    EXPECT_EQ(plot.find("relative "), std::string::npos);
}

TEST(Drift, WhatCannotBeMeasuredIsAnError) {
    EXPECT_FALSE(measure_drift({}));
    DriftOptions options;
    options.kernels = {kernel_named("tetrahedron.cramer")};
    ASSERT_FALSE(measure_drift(options));
    EXPECT_EQ(measure_drift(options).error().found, "tetrahedron.cramer");
    options.kernels = {kernel_named("triangle.perspective-affine")};
    EXPECT_FALSE(measure_drift(options));
    options.kernels = {kernel_named("triangle.signed-area")};
    options.count = 0;
    EXPECT_FALSE(measure_drift(options));
}

}  // namespace
}  // namespace barycert::audit
