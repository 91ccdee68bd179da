// Owners and values at points, however mesh and points are cut: those of the whole mesh.

#include "mesh/pieces/distribution.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>

#include "barycert/locator.hpp"
#include "core/base/random.hpp"
#include "tests/mesh/check/meshes.hpp"
#include "tests/mesh/locate/points.hpp"
#include "tests/mesh/pieces/threads.hpp"

namespace barycert::testing {
namespace {

using pieces::Distribution;
using pieces::Piece;

constexpr double plane = 0.25;  ///< of triangles

/// Puts, for a tuple, a text whose length depends on the last digit of the cell's number, and the number.
struct Numbers : pieces::Tuples {
    void put(std::size_t tuple, std::vector<char>& bytes) const override {
        const std::string text(static_cast<std::size_t>(of[tuple] % 10) + 1, static_cast<char>('a' + of[tuple] % 26));
        bytes.push_back(static_cast<char>(text.size()));
        bytes.insert(bytes.end(), text.begin(), text.end());
        bytes.resize(bytes.size() + sizeof of[tuple]);
        std::memcpy(bytes.data() + bytes.size() - sizeof of[tuple], &of[tuple], sizeof of[tuple]);
    }
    const char* take(std::size_t tuple, const char* bytes, bool set) override {
        bytes += 1 + *bytes;
        if (set) std::memcpy(&of[tuple], bytes, sizeof of[tuple]);
        return bytes + sizeof of[tuple];
    }
    std::vector<std::int64_t> of;  ///< each tuple; -1: none
};

struct Job {
    Mesh mesh;
    std::vector<double> points;               ///< in space
    std::vector<int> ranks;                   ///< of each cell
    bool numbered = true;                     ///< cells have numbers, and these are not those of the ranks
    std::vector<std::int64_t> expected = {};  ///< owners of the points, by the whole mesh
};

std::vector<std::int64_t> owners_of(const Job& job) {
    const Locator whole = Locator::build(job.mesh).value();
    std::vector<std::int64_t> owners;
    for (std::size_t i = 0; i < job.points.size(); i += 3) {
        const double* const x = job.points.data() + i;
        const bool in_plane = job.mesh.dimension == 3 || x[2] == plane;
        const Result<Location> found = in_plane ? whole.locate(x) : Result<Location>(Location{});
        owners.push_back(found ? found->cell : -1);  // an Error: not finite
    }
    return owners;
}

Piece piece_of(const Job& job, int rank, std::vector<std::int64_t>& numbers) {
    Piece piece;
    piece.mesh.dimension = job.mesh.dimension;
    piece.mesh.points = job.mesh.points;
    if (job.mesh.dimension == 2) {
        piece.normal = 2;
        piece.plane = plane;
    }
    const auto corners = static_cast<std::ptrdiff_t>(job.mesh.corners());
    for (std::size_t i = 0; i < job.ranks.size(); ++i) {
        if (job.ranks[i] != rank) continue;
        const auto from = job.mesh.cells.begin() + corners * static_cast<std::ptrdiff_t>(i);
        piece.mesh.cells.insert(piece.mesh.cells.end(), from, from + corners);
        numbers.push_back(static_cast<std::int64_t>(i));
    }
    return piece;
}

void expect_owners(const Job& job, int size) {
    const std::vector<std::int64_t>& expected = job.expected;
    Threads(size).run([&](pieces::Communicator& ranks) {
        std::vector<std::int64_t> numbers;
        const Piece piece = piece_of(job, ranks.rank(), numbers);
        // Every size-th point is this rank's.
        std::vector<std::size_t> mine;
        for (auto i = static_cast<std::size_t>(ranks.rank()); i < expected.size(); i += static_cast<std::size_t>(size))
            mine.push_back(i);
        const auto at = [&](std::size_t i, double* x) { std::copy_n(job.points.data() + 3 * mine[i], 3, x); };
        pieces::Exchange exchange(ranks);
        Distribution distribution(exchange, piece, {mine.size(), at});
        ASSERT_TRUE(distribution.ask().has_value());
        const std::vector<double> others = distribution.points_of_others();
        EXPECT_EQ(distribution.points_received(), others.size() / 3);

        Numbers tuples;
        std::vector<Mesh::Index> owners;
        std::optional<Locator> locator;
        if (!piece.mesh.cells.empty()) locator = Locator::build(piece.mesh).value();
        const auto locate = [&](const double* x) {
            double point[3];
            const Result<Location> found =
                locator && piece.project(x, point) ? locator->locate(point) : Result<Location>(Location{});
            owners.push_back(found ? found->cell : -1);
            tuples.of.push_back(owners.back() < 0 ? -1 : numbers[static_cast<std::size_t>(owners.back())]);
        };
        for (const std::size_t i : mine) locate(job.points.data() + 3 * i);
        for (std::size_t i = 0; i < others.size(); i += 3) locate(others.data() + i);
        ASSERT_TRUE(
            distribution.swap_values(owners, job.numbered ? numbers : std::vector<std::int64_t>(), tuples).has_value());
        std::vector<char> valid(mine.size());
        for (std::size_t i = 0; i < mine.size(); ++i) valid[i] = owners[i] >= 0 ? 1 : 0;
        distribution.merge(tuples, valid.data());
        for (std::size_t i = 0; i < mine.size(); ++i) {
            ASSERT_EQ(tuples.of[i], expected[mine[i]]) << "point " << mine[i] << ", rank " << ranks.rank();
            ASSERT_EQ(valid[i], expected[mine[i]] < 0 ? 0 : 1);
        }
    });
}

std::vector<double> in_space(const Mesh& mesh, const std::vector<double>& points) {
    if (mesh.dimension == 3) return points;
    std::vector<double> all;
    for (std::size_t i = 0; i < points.size(); i += 2)
        all.insert(all.end(), {points[i], points[i + 1], i % 10 == 8 ? plane + 1 : plane});
    return all;
}

Job job_of(const Mesh& mesh, int awkward, std::size_t many) {
    base::Random random(5);
    Job job{mesh, in_space(mesh, awkward_points(mesh, awkward, random)), {}};
    for (std::size_t i = 0; i < 3 * many; ++i) job.points.push_back(random.uniform(0, 1));
    job.points.insert(job.points.end(), {0, std::numeric_limits<double>::quiet_NaN(), 0});
    job.expected = owners_of(job);
    return job;
}

TEST(Distributions, FindTheOwnersOfTheWhole) {
    for (const int d : {2, 3}) {
        // So many points that ranks tell finer boxes of their pieces than one.
        for (const std::size_t many : {std::size_t{0}, std::size_t{2000}}) {
            Job job = job_of(box(d, {4, 2, 2}), 40, many);
            const std::size_t cells = job.mesh.cell_count();
            for (const int size : {1, 2, 3, 8}) {
                base::Random random(7);
                for (const char* const cut : {"scattered", "slabs", "one rank"}) {
                    SCOPED_TRACE(std::to_string(d) + " axes, " + cut + ", ranks: " + std::to_string(size));
                    job.ranks.clear();
                    for (std::size_t i = 0; i < cells; ++i) {
                        const auto slab = static_cast<int>(i * static_cast<std::size_t>(size) / cells);
                        const auto luck = static_cast<int>(random.below(static_cast<std::uint64_t>(size)));
                        job.ranks.push_back(*cut == 's' ? (cut[1] == 'c' ? luck : size - 1 - slab) : size - 1);
                    }
                    expect_owners(job, size);
                }
            }
        }
    }
}

// Cells in slabs of their order: those of lower ranks come first.
TEST(Distributions, NumberCellsByRankWithoutNumbers) {
    Job job = job_of(box(3, {3, 3, 2}), 40, 0);
    job.numbered = false;
    for (std::size_t i = 0; i < job.mesh.cell_count(); ++i)
        job.ranks.push_back(static_cast<int>(i * 4 / job.mesh.cell_count()));
    expect_owners(job, 4);
}

TEST(Distributions, AskNoRankThatIsFar) {
    Job job = job_of(box(3, {8, 1, 1}), 0, 0);
    Threads(2).run([&](pieces::Communicator& ranks) {
        Piece piece;
        const double at = ranks.rank() == 0 ? 0 : 10;
        piece.mesh.points = {at, 0, 0, at + 1, 0, 0, at, 1, 0, at, 0, 1};
        piece.mesh.cells = {0, 1, 2, 3};
        pieces::Exchange exchange(ranks);
        Distribution distribution(exchange, piece, {1, [&](std::size_t, double* x) {
                                                        x[0] = at;
                                                        x[1] = x[2] = 0.25;
                                                    }});
        ASSERT_TRUE(distribution.ask().has_value());
        EXPECT_TRUE(exchange.partners().empty());
        EXPECT_EQ(distribution.points_sent(), 0U);
        EXPECT_EQ(distribution.ranks_with_cells(), 2);
    });
}

}  // namespace
}  // namespace barycert::testing
