// A job for few points writes what it writes with an index, byte for byte.
#include "barycert/pipeline/few_points.hpp"

#include <gtest/gtest.h>

#include "barycert/base/random.hpp"
#include "barycert/base/text.hpp"
#include "barycert/pipeline.hpp"
#include "bench/generated_mesh.hpp"
#include "io/tetgen/mesh_files.hpp"

namespace barycert::testing {
namespace {

/// 24,576 cells with fields of nodes and cells.
const Mesh& cube() {
    static const Mesh mesh = [] {
        Mesh made = bench::jittered_cube(16, 3);
        made.point_fields = {{"t", 1, {}}, {"v", 1, {}}};
        made.cell_fields = {{"c", 1, {}}};
        base::Random random(4);
        for (std::size_t i = 0; i < made.point_count(); ++i) {
            made.point_fields[0].data.push_back(random.uniform(-1, 1));
            made.point_fields[1].data.push_back(random.uniform(-1, 1));
        }
        for (std::size_t c = 0; c < made.cell_count(); ++c) made.cell_fields[0].data.push_back(random.uniform(0, 9));
        return made;
    }();
    return mesh;
}

/// Inside, at nodes, on faces and edges of the lattice, outside: 50 in all.
std::string points() {
    base::Random random(5);
    std::string text = "x,y,z\n";
    const auto add = [&](double x, double y, double z) {
        text += base::shortest(x) + ',' + base::shortest(y) + ',' + base::shortest(z) + '\n';
    };
    for (int i = 0; i < 20; ++i) {
        const double x = random.uniform(0, 1), y = random.uniform(0, 1);
        add(x, y, random.uniform(0, 1));
    }
    for (int i = 0; i < 15; ++i) {
        const double* const at = cube().points.data() + 3 * random.below(cube().point_count());
        add(at[0], at[1], at[2]);
    }
    for (int i = 0; i < 10; ++i) {
        const double x = random.uniform(0, 1);
        add(x, i % 2 == 0 ? 0 : 0.25, i % 3 == 0 ? 1 : 0);
    }
    for (int i = 0; i < 5; ++i) add(2 * i - 1.5, 0.5, 1e300);
    return text;
}

struct Outcome {
    std::string rows, map, error;
    SampleSummary summary;
};

Outcome outcome(SampleJob job, Certify certify) {
    const TemporaryFolder folder;
    job.certify = certify;
    job.output = folder / "rows.csv";
    job.save_map = folder / "map";
    const auto summary = sample_files(job);
    if (!summary) return {{}, {}, summary.error().message(), {}};
    return {get(job.output), get(job.save_map), {}, *summary};
}

TEST(FewPoints, same_bytes_as_with_an_index) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_tetgen(cube(), folder / "cube"));
    put(folder / "p.csv", points());
    ASSERT_TRUE(pipeline::needs_no_index(50, cube().cell_count()));
    for (const bool all : {false, true}) {
        for (const OutsidePolicy outside :
             {OutsidePolicy{}, OutsidePolicy{.kind = Outside::fill, .fill = 7}, OutsidePolicy{.kind = Outside::error},
              OutsidePolicy{.kind = Outside::nearest}, OutsidePolicy{.kind = Outside::extrapolate}}) {
            for (const Rounding rounding : {Rounding::correct, Rounding::plain}) {
                for (const int threads : {1, 2, 5}) {
                    SampleJob job;
                    job.mesh = folder / "cube";
                    job.points = folder / "p.csv";
                    job.all = all;
                    job.options = {rounding, outside, threads};
                    const Outcome few = outcome(job, Certify::automatic), usual = outcome(job, Certify::never);
                    EXPECT_EQ(few.rows, usual.rows);
                    EXPECT_EQ(few.map, usual.map);
                    EXPECT_EQ(few.error, usual.error);
                    const bool nearest = outside.kind == Outside::nearest || outside.kind == Outside::extrapolate;
                    if (outside.kind == Outside::error) {
                        EXPECT_NE(few.error.find("point 45, counted from 0, is outside"), std::string::npos)
                            << few.error;
                        continue;
                    }
                    EXPECT_EQ(few.summary.method == FoundBy::pass, !nearest);
                    EXPECT_EQ(few.summary.cells, 24576U);
                    EXPECT_EQ(few.summary.counts.locations.outside, usual.summary.counts.locations.outside);
                    EXPECT_EQ(few.summary.counts.locations.vertex, usual.summary.counts.locations.vertex);
                    EXPECT_GE(few.summary.counts.locations.vertex, 15U);
                }
            }
        }
    }
}

TEST(FewPoints, the_summary_names_the_way) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_tetgen(cube(), folder / "cube"));
    put(folder / "p.csv", "0.5,0.5,0.5\n");
    SampleJob job;
    job.mesh = folder / "cube";
    job.points = folder / "p.csv";
    job.fields = {"attribute1"};
    const Outcome one = outcome(job, Certify::automatic);
    EXPECT_EQ(one.summary.method, FoundBy::pass);
    EXPECT_EQ(name(one.summary.method), "pass");
    EXPECT_EQ(one.summary.reason.substr(0, 22), "no index for 1 point: ") << one.summary.reason;
    EXPECT_EQ(one.rows.substr(0, 41), "x,y,z,cell,feature,attribute1\n0.5,0.5,0.5");
    put(folder / "p.csv", "");
    EXPECT_NE(outcome(job, Certify::automatic).error, "");
    put(folder / "p.csv", "x,y,z\n");
    const Outcome none = outcome(job, Certify::automatic);
    EXPECT_EQ(none.rows, "x,y,z,cell,feature,attribute1\n");
}

TEST(FewPoints, a_mesh_whose_cells_all_may_hold_a_point_gets_an_index) {
    const TemporaryFolder folder;
    Mesh mesh = cube();
    mesh.point_fields.clear();
    mesh.cell_fields.clear();
    for (std::size_t i = 0; i < mesh.points.size(); ++i) mesh.points[i] *= i % 3 == 2 ? 1e-9 : 1;
    ASSERT_TRUE(write_tetgen(mesh, folder / "flat"));
    std::string text;
    for (int i = 0; i < 61; ++i) text += base::shortest(i / 60.0) + ' ' + base::shortest(i * 7 % 61 / 60.0) + " 1e-3\n";
    put(folder / "p.csv", text + "0.5 0.5 -1e-3\n");
    SampleJob job;
    job.mesh = folder / "flat";
    job.points = folder / "p.csv";
    const Outcome few = outcome(job, Certify::automatic), usual = outcome(job, Certify::never);
    EXPECT_EQ(few.rows, usual.rows);
}

}  // namespace
}  // namespace barycert::testing
