#include "barycert/audit_pictures.hpp"

#include "barycert/audit/asking.hpp"
#include "barycert/audit/recipes.hpp"
#include "barycert/environment.hpp"
#include "barycert/oracle.hpp"

namespace barycert {

using namespace audit;

namespace {

constexpr int min_size = 4, max_size = 4096;

/// Exact: see families_window.cpp.
double twice_area(const Case& c) {
    return std::fabs((c.vertex(1, 0) - c.vertex(0, 0)) * (c.vertex(2, 1) - c.vertex(0, 1)) -
                     (c.vertex(1, 1) - c.vertex(0, 1)) * (c.vertex(2, 0) - c.vertex(0, 0)));
}

/// The kernel's value; NaN if it gives none.
double value_of(const Kernel& k, const Case& c) {
    Statement s;
    ask_kernel(k, std::span(&c, 1), std::span(&s, 1), false);
    return s.value;
}

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

}  // namespace

Case drift_case(int size, std::uint64_t seed, std::uint64_t index) {
    const ExactEnvironment environment;
    base::Random random = base::Random::stream(seed, base::hash64("drift") + static_cast<std::uint64_t>(size), index);
    Case c;
    c.simplex = Simplex::triangle;
    for (int attempt = 0; attempt < 64; ++attempt) {
        set_pixel_case(c, random, size, false, 1);
        if (twice_area(c) >= size * size / 4.0) break;
    }
    for (std::size_t i = 0; i < 3; ++i) c.values[i] = random.uniform(1, 2);
    return c;
}

Result<DriftReport> measure_drift(const DriftOptions& options) {
    const ExactEnvironment environment;
    if (options.kernels.empty() || options.count == 0)
        return Error{.what = "nothing to measure", .expected = "a kernel and at least one case"};
    for (const Kernel& k : options.kernels) {
        if (k.simplex != Simplex::triangle || k.perspective)
            return Error{.what = "the kernel is not for triangles without perspective", .found = k.name};
    }
    DriftReport report{options.seed, options.count, {}};
    for (const Kernel& k : options.kernels) report.curves.push_back({k, {}});
    for (int size = min_size; size <= max_size; size *= 2) {
        for (DriftCurve& curve : report.curves) curve.points.push_back({.size = size});
        for (std::uint64_t i = 0; i < options.count; ++i) {
            const Case c = drift_case(size, options.seed, i);
            const OracleAnswer answer = ask_oracle(c);
            if (answer.region != Region::interior && answer.region != Region::boundary) continue;
            for (DriftCurve& curve : report.curves)
                add(curve.points.back(), value_of(curve.kernel, c), answer.value, i);
        }
    }
    return report;
}

}  // namespace barycert
