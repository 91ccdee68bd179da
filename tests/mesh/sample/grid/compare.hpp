/// Rows of resample against those of sample for the points of the grid, one by one.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "barycert/grid.hpp"
#include "barycert/mesh.hpp"
#include "core/base/random.hpp"
#include "tests/mesh/check/meshes.hpp"

namespace barycert::testing {

/// The points of a grid, the first coordinate running fastest; dimension coordinates a point.
std::vector<double> points_of(const Grid& grid);

struct Resampled {
    Table samples;
    SampleCounts counts;
    std::size_t blocks = 0;
};

/// All blocks, one after the other. Fails the test if resample fails, or blocks are not whole layers in order.
Resampled resampled(const Sampler& sampler, const Grid& grid, const SampleOptions& options = {});

/// The same number, bit for bit, signs of zeros and NaNs too.
bool same_bits(const std::vector<double>& a, const std::vector<double>& b);

/// Owners, features, values, distances, bit for bit.
void expect_same_rows(const Table& expected, const Table& found, const Grid& grid, const std::string& what);

/// All but LocationCounts::tests, and which tiers decided values.
void expect_same_counts(const SampleCounts& expected, const SampleCounts& found, const std::string& what);

/// The law of grid.hpp. Returns the counts.
SampleCounts expect_law(const Sampler& sampler, const Grid& grid, const SampleOptions& options,
                        const std::string& what);

/// The law with all fields of the mesh, with its certificate and without one. Returns the counts of the latter.
SampleCounts expect_law(const Mesh& mesh, const Grid& grid, const std::string& what, const SampleOptions& options = {});

/// The oracle's owners, features and values at every point of the grid; for small ones.
void expect_truth(const Mesh& mesh, const Grid& grid, const std::string& what);

/// grid_over, which must succeed.
Grid over(int dimension, const std::array<std::int64_t, 3>& counts, const std::array<double, 3>& low,
          const std::array<double, 3>& high);

/// Fields of 1 component at nodes, of ordinary values, and of 1 at cells.
void set_simple_fields(Mesh& mesh, base::Random& random);

/// Grids that are awkward for this mesh, of at most about `points` points each: see the names they come with.
struct NamedGrid {
    std::string name;
    Grid grid;
};
std::vector<NamedGrid> awkward_grids(const Mesh& mesh, std::int64_t points, base::Random& random);

}  // namespace barycert::testing
