// The contents of pictures of kernels: errors by the size of triangles, signs beside a side.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "audit/asking.hpp"
#include "audit/recipes.hpp"
#include "barycert/audit_pictures.hpp"
#include "barycert/environment.hpp"
#include "barycert/kernels.hpp"
#include "barycert/oracle.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "core/base/random.hpp"
#include "core/base/ulp.hpp"

namespace barycert {

using namespace audit;

namespace {

// Errors by the size of triangles.

constexpr int min_size = 4, max_size = 4096;

void add(DriftPoint& point, double value, double exact, std::uint64_t index) {
    if (!std::isfinite(value)) {
        ++point.not_finite;
        return;
    }
    ++point.cases;
    const double ulps = base::ulp_error(value, exact);
    if (ulps > point.worst_ulp) {
        point.worst_ulp = ulps;
        point.index = index;
    }
    // Off by the roundings of a difference and a quotient.
    point.worst_relative = std::max(point.worst_relative, std::fabs(value - exact) / exact);
}

// Signs of a weight at points around a side.

/// Vertex 2 is the one off the side; the others lie in x = y.
constexpr std::size_t apex = 2;

SignPicture exact_picture(Simplex s, bool perspective) {
    SignPicture picture{.kernel = {}, .simplex = s, .perspective = perspective, .signs = {}, .wrong = 0};
    for (int j = 0; j < SignPicture::side; ++j) {
        for (int i = 0; i < SignPicture::side; ++i)
            picture.signs.push_back(ask_oracle(sign_case(s, perspective, i, j)).signs[apex]);
    }
    return picture;
}

std::int8_t sign_of(const Statement& s) {
    const double w = s.weights[apex];
    if (!s.answered || s.status != 0 || !std::isfinite(w)) return 2;
    return static_cast<std::int8_t>(w > 0 ? 1 : w < 0 ? -1 : 0);
}

SignPicture picture_of(const Kernel& kernel, const SignPicture& exact) {
    SignPicture picture = exact;
    picture.kernel = kernel.name;
    std::vector<Case> cases(SignPicture::side);
    std::vector<Statement> statements(SignPicture::side);
    auto sign = picture.signs.begin();
    for (int j = 0; j < SignPicture::side; ++j) {
        for (int i = 0; i < SignPicture::side; ++i)
            cases[static_cast<std::size_t>(i)] = sign_case(kernel.simplex, kernel.perspective, i, j);
        ask_kernel(kernel, cases, statements, false);
        for (const Statement& said : statements) {
            const std::int8_t seen = sign_of(said);
            picture.wrong += seen != *sign ? 1 : 0;
            *sign++ = seen;
        }
    }
    return picture;
}

}  // namespace

Case drift_case(int size, std::uint64_t seed, std::uint64_t index) {
    const ExactEnvironment environment;
    base::Random random = base::Random::stream(seed, base::hash64("drift") + static_cast<std::uint64_t>(size), index);
    Case c{.simplex = Simplex::triangle};
    for (int attempt = 0; attempt < 64; ++attempt) {
        set_pixel_case(c, random, size, false, 1);
        // Exact: see families_window.cpp.
        const double twice_area = (c.vertex(1, 0) - c.vertex(0, 0)) * (c.vertex(2, 1) - c.vertex(0, 1)) -
                                  (c.vertex(1, 1) - c.vertex(0, 1)) * (c.vertex(2, 0) - c.vertex(0, 0));
        if (std::fabs(twice_area) >= size * size / 4.0) break;
    }
    for (std::size_t i = 0; i < 3; ++i) c.values[i] = random.uniform(1, 2);
    return c;
}

Result<DriftReport> measure_drift(const DriftOptions& options) {
    const ExactEnvironment environment;
    if (options.kernels.empty() || options.count == 0)
        return Error{
            .code = "argument.value", .what = "nothing to measure", .expected = "a kernel and at least one case"};
    for (const Kernel& k : options.kernels) {
        if (k.simplex != Simplex::triangle || k.perspective)
            return Error{
                .code = "kernel.unfit", .what = "the kernel is not for triangles without perspective", .found = k.name};
    }
    DriftReport report{options.seed, options.count, {}};
    for (const Kernel& k : options.kernels) report.curves.push_back({k, {}});
    for (int size = min_size; size <= max_size; size *= 2) {
        for (DriftCurve& curve : report.curves) curve.points.push_back({.size = size});
        for (std::uint64_t i = 0; i < options.count; ++i) {
            const Case c = drift_case(size, options.seed, i);
            const OracleAnswer answer = ask_oracle(c);
            if (!is_inside(answer.region)) continue;
            for (DriftCurve& curve : report.curves) {
                Statement said;
                ask_kernel(curve.kernel, std::span(&c, 1), std::span(&said, 1), false);
                add(curve.points.back(), said.value, answer.value, i);
            }
        }
    }
    return report;
}

Case sign_case(Simplex s, bool perspective, int i, int j) {
    Case c{.simplex = s, .values = {1, 2, 3, 4}, .perspective = perspective};
    const auto set = [&](int vertex, double x, double y, double z) {
        c.vertex(vertex, 0) = x;
        c.vertex(vertex, 1) = y;
        if (c.stride() == 3) c.vertex(vertex, 2) = z;
    };
    const bool solid = s == Simplex::tetrahedron;
    set(0, 12, 12, solid ? 12 : perspective ? 1 : 0.5);
    set(1, 24, 24, solid ? 24 : perspective ? 2 : 0.5);
    set(2, 24, 12, solid ? 30 : perspective ? 3 : 0.5);
    if (solid) set(3, 48, 48, 7);
    c.point = {0.5 + i * 0x1p-53, 0.5 + j * 0x1p-53, space_dimension(s) == 3 ? 0.5 : 0.0};
    return c;
}

std::vector<SignPicture> sign_pictures(const std::vector<Kernel>& kernels) {
    const ExactEnvironment environment;
    std::vector<SignPicture> pictures;
    for (const Kernel& k : kernels) {
        if (k.simplex == Simplex::segment) continue;
        auto exact = std::ranges::find_if(pictures, [&](const SignPicture& p) {
            return p.kernel.empty() && p.simplex == k.simplex && p.perspective == k.perspective;
        });
        if (exact == pictures.end()) exact = pictures.insert(exact, exact_picture(k.simplex, k.perspective));
        pictures.push_back(picture_of(k, *exact));
    }
    return pictures;
}

}  // namespace barycert
