// Perspective-correct values at the pixels of a triangle: correctly rounded, against the plain formula in double.
// Answers are verified elsewhere (tests/core); here that batches and single calls agree.
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/perspective.hpp"
#include "core/base/random.hpp"
#include "exact_table.hpp"
#include "require.hpp"

namespace {

using namespace barycert;
using bench::require;

/// Vertices on the grid of 1/256 pixel, or anywhere; the pixel centres of its box that are in it.
struct Subject {
    double vertices[9] = {};
    std::vector<double> points;
};

Subject subject(bool on_grid) {
    Subject s;
    base::Random random(on_grid ? 1 : 2);
    const double corner[3][2] = {{10, 20}, {510, 60}, {200, 500}};
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 2; ++k) {
            const double x = corner[i][k] + random.unit();
            s.vertices[3 * i + k] = on_grid ? std::floor(256 * x) / 256 : x;
        }
        s.vertices[3 * i + 2] = random.uniform(1, 10);
    }
    for (int y = 0; y < 512; ++y) {
        for (int x = 0; x < 512; ++x) {
            const double p[2] = {x + 0.5, y + 0.5};
            const auto w = perspective_weights(s.vertices, p);
            if (!w || w->weights[0] < 0 || w->weights[1] < 0 || w->weights[2] < 0) continue;
            s.points.push_back(p[0]);
            s.points.push_back(p[1]);
        }
    }
    return s;
}

constexpr double texture[6] = {0.1, 0.2, 0.9, 0.3, 0.4, 0.95};  // u, v at each vertex

/// The textbook's two steps, 1/Z and then u and v, a pixel at a time.
void plain(const Subject& s, std::vector<double>& out) {
    const double* const v = s.vertices;
    const double area = (v[3] - v[0]) * (v[7] - v[1]) - (v[4] - v[1]) * (v[6] - v[0]);
    for (std::size_t j = 0; j < s.points.size() / 2; ++j) {
        const double x = s.points[2 * j], y = s.points[2 * j + 1];
        const double a = ((v[6] - v[3]) * (y - v[4]) - (v[7] - v[4]) * (x - v[3])) / area / v[2];
        const double b = ((v[0] - v[6]) * (y - v[7]) - (v[1] - v[7]) * (x - v[6])) / area / v[5];
        const double c = ((v[3] - v[0]) * (y - v[1]) - (v[4] - v[1]) * (x - v[0])) / area / v[8];
        const double z = 1 / (a + b + c);
        for (std::size_t k = 0; k < 2; ++k)
            out[2 * j + k] = z * (a * texture[k] + b * texture[2 + k] + c * texture[4 + k]);
    }
}

template <class Run>
double ns_per_point(std::size_t points, Run run) {
    std::vector<double> times;
    for (int i = 0; i < 15; ++i) {
        const double start = bench::seconds();
        run();
        times.push_back(1e9 * (bench::seconds() - start) / static_cast<double>(points));
    }
    return bench::median(times);
}

}  // namespace

int main() {
    for (const bool on_grid : {true, false}) {
        const Subject s = subject(on_grid);
        const std::size_t count = s.points.size() / 2;
        std::vector<double> out(2 * count), of_plain(2 * count);
        TierCounts tiers;
        require(perspective_values(s.vertices, s.points, texture, 2, out, &tiers).has_value(), "an error");
        for (std::size_t j = 0; j < count; ++j) {
            for (std::size_t k = 0; k < 2; ++k) {
                const double f[3] = {texture[k], texture[2 + k], texture[4 + k]};
                const auto one = perspective_value(s.vertices, s.points.data() + 2 * j, f);
                require(std::bit_cast<std::uint64_t>(one->value) == std::bit_cast<std::uint64_t>(out[2 * j + k]),
                        "batch and single call");
            }
        }
        std::printf("vertices %s: %zu pixels, two attributes; double-double %.4f %%, exact %.4f %%\n",
                    on_grid ? "on the grid of 1/256 pixel" : "anywhere", count,
                    100 * static_cast<double>(tiers.double_double) / static_cast<double>(count),
                    100 * static_cast<double>(tiers.exact) / static_cast<double>(count));
        for (const std::string& target : simd_targets()) {
            use_simd_target(target);
            const double batch = ns_per_point(count, [&] {
                require(perspective_values(s.vertices, s.points, texture, 2, out).has_value(), "an error");
            });
            const double single = ns_per_point(count, [&] {
                for (std::size_t j = 0; j < count; ++j)
                    out[j] = perspective_value(s.vertices, s.points.data() + 2 * j, texture)->value;
            });
            std::printf("  correctly rounded, %-8s two in a batch %8.2f ns a pixel, one in a call %8.2f\n",
                        target.c_str(), batch, single);
        }
        use_simd_target("");
        std::printf("  plain double, two %35.2f\n", ns_per_point(count, [&] { plain(s, of_plain); }));
    }
    return 0;
}
