// barycert::barycert: the example of the README, one case and a batch on a mesh. Prints what the test expects.

#include <cstdio>
#include <vector>

#include <barycert/barycert.hpp>

int main() {
    using namespace barycert;
    const std::vector<double> nodes = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
    const std::vector<std::int32_t> corners = {0, 1, 2, 3, 4, 1, 2, 3};  // two tetrahedra with a face in common
    const double point[] = {0.25, 0.25, 0.5};                            // on that face

    const WeightSigns signs = weight_signs(Simplex::tetrahedron, nodes.data(), point);
    const bool on_face = signs.contains() && signs.feature(Simplex::tetrahedron) == Feature::face;

    // The same point in both cells: the same bits, whichever is asked.
    const std::vector<std::int32_t> cells = {0, 1};
    const std::vector<double> points = {0.25, 0.25, 0.5, 0.25, 0.25, 0.5};
    const std::vector<float> temperature = {10, 20, 30, 40, 50};
    std::vector<double> values(2);
    TierCounts tiers;
    const Status status = interpolate(MeshQueries{Simplex::tetrahedron, nodes, corners, cells, points},
                                      NodalValues<float>{temperature}, values, &tiers);
    if (!status) return std::fprintf(stderr, "%s\n", status.error().message().c_str()), 2;
    std::printf("%s, %g and %g, %s, %d cases\n", on_face ? "on a face" : "elsewhere", values[0], values[1],
                values[0] == values[1] ? "same bits" : "different", static_cast<int>(tiers.cases()));
    return 0;
}
