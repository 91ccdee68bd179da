// The nearest point of a mesh, held against a slow twin in rational numbers.
#include <algorithm>
#include <cmath>
#include <limits>

#include "barycert/locator.hpp"
#include "tests/fuzz/drawn.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/mesh/locate/judge.hpp"
#include "tests/mesh/locate/nearest_judge.hpp"

namespace barycert::fuzz {

BARYCERT_FUZZ_TARGET(nearest, {std::size_t{32} << 20, 256}) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Draws draws(input);
    const Drawn drawn = draw_mesh(draws, 8, 4);
    const Mesh& mesh = drawn.mesh;
    const Result<Locator> locator =
        Locator::build(mesh, {.prove = draws.below(2) == 0 ? Prove::at_once : Prove::never, .threads = 1});
    expect(bool(locator), "a consistent mesh is not indexed");
    const testing::NearestJudge judge(mesh);
    const testing::PointJudge holders(mesh);
    const auto d = static_cast<std::size_t>(mesh.dimension);
    for (std::size_t i = 0; i * d < drawn.points.size(); ++i) {
        const double* const point = drawn.points.data() + d * i;
        const Result<Nearest> found = locator->nearest(point, infinity);
        expect(bool(found), "nothing is nearest");
        const std::vector<testing::Held> inside = holders.holders(point);
        if (!inside.empty()) {
            expect(found->distance == 0 && found->cell == inside.front().cell, "a point inside is away from the mesh");
            continue;
        }
        const testing::TrueNearest truth = judge.nearest(point);
        expect(found->cell == (truth.cells.empty() ? -1 : truth.cells.front()), "the nearest cell is wrong");
        if (truth.cells.empty()) continue;
        if (std::isfinite(found->distance))
            expect(testing::ulps_from_root(found->distance, truth.square) <= 0.5 + 0x1p-40, "a distance is wrong");
        // The nodes span what is nearest.
        const auto none = std::find(found->nodes.begin(), found->nodes.end(), -1);
        expect(none != found->nodes.begin(), "a point outside is nearest to no feature");
        const std::span<const Mesh::Index> hull(found->nodes.begin(), none);
        expect(judge.to_hull(point, hull) == truth.square, "what the nodes span is not so near");
    }
}

}  // namespace barycert::fuzz
