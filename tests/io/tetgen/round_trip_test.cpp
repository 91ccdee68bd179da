// Written files are read again, bit for bit.
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include "tests/io/tetgen/mesh_files.hpp"
#include "tests/io/tetgen/random_mesh.hpp"

namespace barycert::testing {
namespace {

void expect_round_trip(const Mesh& mesh, const WriteOptions& options = {}) {
    const TemporaryFolder folder;
    const Status written = write_tetgen(mesh, folder / "m", options);
    ASSERT_TRUE(written) << written.error().message();
    const Result<Mesh> read = read_tetgen(folder / "m", {.threads = 1});
    ASSERT_TRUE(read) << read.error().message();
    expect_same(*read, mesh);
}

RC_GTEST_PROP(RoundTrip, AnyMesh, (std::uint64_t seed)) {
    base::Random random(seed);
    expect_round_trip(any_mesh(random), {.comment = random.coin() ? "a comment\n1 2 3\r4" : ""});
    RC_ASSERT(!::testing::Test::HasFailure());
}

TEST(RoundTrip, ManyDoubles) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        base::Random random(seed);
        Mesh mesh;
        mesh.points = any_doubles(random, 30000);
        expect_round_trip(mesh);
    }
}

TEST(RoundTrip, SecondOrderCellsInEveryOrder) {
    for (const int dimension : {2, 3}) {
        for (const MidEdgeOrder order : orders_in(dimension))
            expect_round_trip(second_order_mesh(dimension, order, 20, 5));
    }
}

TEST(RoundTrip, TheNumberOfThreadsChangesNothing) {
    base::Random random(7);
    Mesh mesh;
    const std::size_t nodes = 60000, cells = 100000;  // several blocks in each file
    mesh.points = any_doubles(random, nodes * 3);
    mesh.point_fields.push_back({"attribute0", 1, any_doubles(random, nodes)});
    mesh.point_markers = any_markers(random, nodes);
    mesh.cells = any_indices(random, cells * 4, nodes);
    mesh.neighbours = any_indices(random, cells * 4, cells);
    mesh.faces = any_indices(random, cells * 3, nodes);
    mesh.face_markers = any_markers(random, cells);
    mesh.index_base = 1;
    const TemporaryFolder folder;
    ASSERT_TRUE(write_tetgen(mesh, folder / "m"));
    for (const int threads : {1, 2, 7, 0}) {
        const Result<Mesh> read = read_tetgen(folder / "m", {.threads = threads});
        ASSERT_TRUE(read) << read.error().message();
        expect_same(*read, mesh);
    }
}

}  // namespace
}  // namespace barycert::testing
