// Certified meshes whose parts touch: there the owner of a point need not be connected over facets to where a walk
// ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/locate/points.hpp"
#include "tests/mesh/locate/ways.hpp"

namespace barycert::testing {
namespace {

/// The cubes of a box for which keep(x, y, z) holds.
template <class Keep>
Mesh cubes(int d, std::array<int, 3> size, Keep keep) {
    const int cells_of_cube = d == 2 ? 2 : 6;
    std::vector<bool> kept;
    for (int z = 0; z < (d == 2 ? 1 : size[2]); ++z) {
        for (int y = 0; y < size[1]; ++y) {
            for (int x = 0; x < size[0]; ++x) {
                for (int i = 0; i < cells_of_cube; ++i) kept.push_back(keep(x, y, z));
            }
        }
    }
    return only(box(d, size), kept);
}

void expect_right_renumbered(const Mesh& mesh, const std::string& what) {
    for (std::uint64_t n = 0; n < 4; ++n) {
        base::Random random = base::Random::stream(1, n, 0);
        Mesh other = n == 0 ? mesh : renumbered(mesh, random);
        if (n == 3) flip_some(other, random);
        EXPECT_TRUE(expect_right(other, awkward_points(other, 30, random), random, what, {.targets = n == 0}))
            << what << " is to be certified";
    }
}

TEST(LocateContacts, L1CubesThatShareAVertex) {
    expect_right_renumbered(cubes(2, {2, 2, 1}, [](int x, int y, int) { return x == y; }), "two squares");
    expect_right_renumbered(cubes(3, {2, 2, 2}, [](int x, int y, int z) { return x == y && y == z; }), "two cubes");
}

TEST(LocateContacts, L1CubesThatShareAnEdge) {
    expect_right_renumbered(cubes(3, {2, 2, 1}, [](int x, int y, int) { return x == y; }), "two cubes");
    expect_right_renumbered(cubes(3, {2, 2, 3}, [](int x, int y, int) { return x != y; }), "two columns");
}

TEST(LocateContacts, L1Chequered) {
    const auto odd = [](int x, int y, int z) { return (x + y + z) % 2 == 1; };
    expect_right_renumbered(cubes(2, {5, 4, 1}, odd), "chequered squares");
    expect_right_renumbered(cubes(3, {4, 4, 4}, odd), "chequered cubes");
}

TEST(LocateContacts, L1PartsApartAndCavities) {
    const auto slabs = [](int x, int, int) { return x % 2 == 0; };
    expect_right_renumbered(cubes(2, {7, 2, 1}, slabs), "strips");
    expect_right_renumbered(cubes(3, {7, 2, 2}, slabs), "slabs");
    const auto shells = [](int x, int y, int z) {
        const int away = std::max({std::abs(x - 3), std::abs(y - 3), std::abs(z - 3)});
        return away % 2 == 1;
    };
    expect_right_renumbered(cubes(3, {7, 7, 7}, shells), "shells in each other");
    expect_right_renumbered(cubes(2, {7, 7, 1}, [&](int x, int y, int) { return shells(x, y, 3); }), "frames");
    // A spiral: the straight way to a point leaves the domain many times.
    const std::vector<std::string> spiral{"#########", "#........", "#.#######", "#.#.....#", "#.#.###.#",
                                          "#.#...#.#", "#.#####.#", "#.......#", "#########"};
    expect_right_renumbered(cubes(2, {9, 9, 1},
                                  [&](int x, int y, int) {
                                      return spiral[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] == '#';
                                  }),
                            "spiral");
}

// Parts that share no nodes but touch are no complex: they must be asked cell by cell.
TEST(LocateContacts, L1PartsThatShareNoNodes) {
    for (const int d : {2, 3}) {
        base::Random random(1);
        const Mesh one = box(d, {2, 2, 2});
        for (const std::array<double, 3> shift : {std::array<double, 3>{2, 0, 0}, {2, 2, 0}, {2, 2, 2}, {1, 0, 0}}) {
            const Mesh two = joined(one, mapped(one, {1, 1, 1}, shift));
            expect_right(two, awkward_points(two, 40, random), random, "two boxes");
        }
    }
}

}  // namespace
}  // namespace barycert::testing
