// Means at nodes: the filter's and the integers', against GMP's rationals.
#include "mesh/sample/quantity/quantities.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "mesh/sample/quantity/mean_lanes.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/check/random_complexes.hpp"
#include "tests/mesh/sample/points/rows.hpp"
#include "tests/mesh/sample/quantity/quantities.hpp"

namespace barycert::testing {
namespace {

/// Every mean is the exact one, correctly rounded; NaN where there is none.
void expect_true_means(const Mesh& mesh, const Field& of_cells, const std::string& what) {
    const Field mean = sample::nodal_mean(mesh, of_cells);
    const auto components = static_cast<std::size_t>(of_cells.components);
    for (std::size_t node = 0; node < mesh.point_count(); ++node) {
        for (std::size_t c = 0; c < components; ++c) {
            const auto exact = exact_mean(mesh, of_cells, c, static_cast<Mesh::Index>(node));
            const double found = mean.data[components * node + c];
            if (!exact) {
                EXPECT_TRUE(std::isnan(found)) << what << node;
            } else {
                EXPECT_TRUE(same(found, second_path::nearest(*exact))) << what << node << ": " << found;
            }
        }
    }
}

/// How many cells the filter has no bound for, and how many volumes are not within it.
std::size_t unknown_volumes(const Mesh& mesh) {
    std::vector<sample::CellVolume> volumes(mesh.cell_count());
    sample::volume_lanes(mesh, 0, volumes.size(), volumes.data());
    std::size_t unknown = 0;
    for (std::size_t cell = 0; cell < volumes.size(); ++cell) {
        if (!std::isfinite(volumes[cell].error)) {
            ++unknown;
            continue;
        }
        const Rational exact = abs(exact_determinant(mesh, static_cast<Mesh::Index>(cell)));
        const Rational off = abs(Rational(volumes[cell].high) + Rational(volumes[cell].low) - exact);
        EXPECT_LE(off, Rational(volumes[cell].error)) << cell;
    }
    return unknown;
}

TEST(NodalMean, TheFilterKnowsGoodCells) {
    for (const char* stem : {"cube-hole", "needle-slit", "plate", "cube-hole-o2", "bracket"})
        EXPECT_EQ(unknown_volumes(own_mesh(stem)), 0U) << stem;
}

TEST(NodalMean, BadMeshesAndAwkwardValues) {
    std::size_t unknown = 0;
    for (const int d : {2, 3}) {
        for (std::uint64_t k = 0; k < 200 && !HasFailure(); ++k) {
            base::Random random = base::Random::stream(11, static_cast<std::uint64_t>(d), k);
            Mesh mesh = k % 3 == 0   ? random_soup(d, random)
                        : k % 3 == 1 ? grown_complex(d, random)
                                     : damaged_box(d, random);
            if (mesh.cells.empty()) continue;
            constexpr double scales[] = {1, 0x1p-99, 0x1p99, 0x1p-340, 0x1p300};
            for (double& x : mesh.points) x *= scales[k / 3 % 5];
            unknown += unknown_volumes(mesh);
            for (const bool awkward : {false, true})
                expect_true_means(mesh, random_fields(mesh.cell_count(), {2}, awkward, random)[0],
                                  std::to_string(k) + ": ");
        }
    }
    EXPECT_GT(unknown, 100U) << "the integers were asked as well";
}

// Means that cancel, that lie halfway between doubles or next to it, and that are 0.
TEST(NodalMean, MeansThatAreHardToRound) {
    base::Random random(12);
    for (const char* stem : {"lattice-eighths", "lattice-box", "plate"}) {
        const Mesh mesh = own_mesh(stem);
        for (int k = 0; k < 6; ++k) {
            Field field{"g", 1, {}};
            for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
                const double sign = random.integer(0, 1) == 0 ? 1 : -1;
                const double one = 1 + static_cast<double>(random.integer(0, 3)) * 0x1p-52;
                field.data.push_back(k == 0   ? sign
                                     : k == 1 ? 0.0
                                     : k == 2 ? one
                                     : k == 3 ? sign * 0x1p-1000
                                     : k == 4 ? sign * one * std::ldexp(1, static_cast<int>(random.integer(-120, 120)))
                                              : sign * std::ldexp(1, static_cast<int>(random.integer(-1070, 1000))));
            }
            expect_true_means(mesh, field, std::string(stem) + ' ' + std::to_string(k) + ": ");
        }
    }
}

// The integers are the exception.
TEST(NodalMean, TheFilterDecidesNearlyAll) {
    const Mesh mesh = own_mesh("flange");
    base::Random random(13);
    std::vector<sample::CellVolume> volumes(mesh.cell_count());
    sample::volume_lanes(mesh, 0, volumes.size(), volumes.data());
    std::vector<double> values;
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) values.push_back(random.uniform(1, 2));
    const base::Lists<Mesh::Index> cells(mesh.point_count(), [&](auto add) {
        for (std::size_t i = 0; i < mesh.cells.size(); ++i)
            add(static_cast<std::size_t>(mesh.cells[i]), static_cast<Mesh::Index>(i / 4));
    });
    std::vector<double> means(mesh.point_count());
    std::vector<std::uint32_t> undecided(mesh.point_count());
    const sample::MeanInput input{cells, volumes, values, 1};
    undecided.resize(sample::mean_lanes(input, 0, mesh.point_count(), means.data(), undecided.data()));
    // The mean over two cells of the same volume may lie halfway between doubles.
    EXPECT_LE(undecided.size(), mesh.point_count() / 1000);
    const Field mean = sample::nodal_mean(mesh, {"g", 1, values});
    for (const std::uint32_t node : undecided) means[node] = mean.data[node];
    EXPECT_EQ(mean.data, means);
}

}  // namespace
}  // namespace barycert::testing
