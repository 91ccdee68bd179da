// Exact signs and correctly rounded values of single simplices and of batches.

#include <barycert/barycert.hpp>

#include <cstdint>
#include <cstdio>
#include <vector>

using namespace barycert;

int main() {
    const double cell[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, point[] = {0.25, 0.25, 0.5};
    const double values[] = {10, 20, 30, 40};

    const Sign side = orient3d(cell, cell + 3, cell + 6, point);  // of the point to the face 0, 1, 2
    std::printf("%d\n", static_cast<int>(side));

    const WeightSigns signs = weight_signs(Simplex::tetrahedron, cell, point);
    std::printf("%s, %s\n", signs.contains() ? "inside" : "outside", name(signs.feature(Simplex::tetrahedron)).data());

    const Value value = interpolate(Simplex::tetrahedron, cell, point, values).value();
    const Gradient slope = gradient(Simplex::tetrahedron, cell, values).value();
    std::printf("%g, gradient %g %g %g\n", value.value, slope.gradient[0], slope.gradient[1], slope.gradient[2]);

    // Many points at once, point j in cell cells[j] of a mesh. Values may be float or double, with any number of
    // components.
    const std::vector<double> nodes = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
    const std::vector<std::int32_t> corners = {0, 1, 2, 3, 4, 1, 2, 3}, cells = {0, 1};
    const std::vector<double> points = {0.25, 0.25, 0.5, 0.25, 0.25, 0.5};  // on the common face of both cells
    const std::vector<float> temperature = {10, 20, 30, 40, 50};
    std::vector<double> out(2);
    TierCounts tiers;  // how many the filter, double-double and integers decided
    interpolate(MeshQueries{Simplex::tetrahedron, nodes, corners, cells, points}, NodalValues<float>{temperature}, out,
                &tiers)
        .value();
    std::printf("%s\n", out[0] == out[1] ? "the same bits from both cells" : "different");
}
