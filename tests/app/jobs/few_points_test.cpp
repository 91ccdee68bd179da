// A job for few points writes what it writes with an index, byte for byte.
#include "app/jobs/sampled_mesh.hpp"

#include <gtest/gtest.h>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_job.hpp"
#include "barycert/check_results.hpp"
#include "barycert/contour_job.hpp"
#include "barycert/defect.hpp"
#include "barycert/figure.hpp"
#include "barycert/fix.hpp"
#include "barycert/gmsh_files.hpp"
#include "barycert/grid.hpp"
#include "barycert/job.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/plc.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/render_job.hpp"
#include "barycert/sample_job.hpp"
#include "barycert/series.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/verify.hpp"
#include "barycert/verify_job.hpp"
#include "barycert/vtk_files.hpp"
#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "tests/bench/generated_mesh.hpp"
#include "tests/io/tetgen/mesh_files.hpp"

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
    std::string text;
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
    SampleReport summary;
};

Outcome outcome(SampleJob job) {
    const TemporaryFolder folder;
    job.output = folder / "rows.csv";
    if (job.map.empty()) job.save_map = folder / "map";
    const auto summary = sample_files(job);
    if (!summary) return {{}, {}, summary.error().message(), {}};
    return {get(job.output), job.map.empty() ? get(job.save_map) : "", {}, *summary};
}

/// Points as a file: `times` times one after the other, under one header.
void put_points(const std::string& path, const std::string& points, int times) {
    std::string text = "x,y,z\n";
    for (int i = 0; i < times; ++i) text += points;
    put(path, text);
}

/// The job for the points in `folder`, few of them and many.
struct Both {
    Outcome few, many;
};
Both both(SampleJob job, const TemporaryFolder& folder) {
    job.mesh = folder / "cube";
    job.points = folder / "few.csv";
    Both result;
    result.few = outcome(job);
    job.points = folder / "many.csv";
    result.many = outcome(job);
    return result;
}

TEST(FewPoints, SameBytesAsWithAnIndex) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_tetgen(cube(), folder / "cube"));
    put_points(folder / "few.csv", points(), 1);
    put_points(folder / "many.csv", points(), 40);
    ASSERT_TRUE(jobs::needs_no_index(50, cube().cell_count()));
    ASSERT_FALSE(jobs::needs_no_index(2000, cube().cell_count()));
    for (const bool all : {false, true}) {
        for (const OutsidePolicy outside :
             {OutsidePolicy{}, OutsidePolicy{.kind = Outside::fill, .fill = 7}, OutsidePolicy{.kind = Outside::error},
              OutsidePolicy{.kind = Outside::nearest}, OutsidePolicy{.kind = Outside::extrapolate}}) {
            for (const Rounding rounding : {Rounding::correct, Rounding::plain}) {
                SampleJob job;
                job.all = all;
                job.options = {rounding, outside, rounding == Rounding::plain ? 1 : 3};
                const auto [few, many] = both(job, folder);
                if (outside.kind == Outside::error) {
                    const std::string what =
                        ": point 45, counted from 0, is outside the mesh: found (-1.5, 0.5, 1e+300)";
                    EXPECT_NE(few.error.find(what), std::string::npos) << few.error;
                    EXPECT_NE(many.error.find(what), std::string::npos) << many.error;
                    continue;
                }
                ASSERT_EQ(few.error + many.error, "");
                EXPECT_EQ(few.rows, many.rows.substr(0, few.rows.size()));
                EXPECT_EQ(many.summary.rows, 40 * few.summary.rows);
                EXPECT_EQ(few.rows.size() - few.rows.find('\n') - 1,
                          (many.rows.size() - many.rows.find('\n') - 1) / 40);
                EXPECT_NE(many.summary.method, FoundBy::pass);
                const bool nearest = outside.kind == Outside::nearest || outside.kind == Outside::extrapolate;
                EXPECT_EQ(few.summary.method == FoundBy::pass, !nearest);
                EXPECT_EQ(few.summary.cells, 24576U);
                EXPECT_EQ(few.summary.counts.locations.outside, 5U);
                EXPECT_GE(few.summary.counts.locations.vertex, 15U);
                // The map names cells as the mesh does.
                put(folder / "map", few.map);
                SampleJob again = job;
                again.mesh = folder / "cube";
                again.map = folder / "map";
                EXPECT_EQ(outcome(again).rows, few.rows);
            }
        }
    }
}

TEST(FewPoints, TheSummaryNamesTheWay) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_tetgen(cube(), folder / "cube"));
    put(folder / "p.csv", "0.5,0.5,0.5\n");
    SampleJob job;
    job.mesh = folder / "cube";
    job.points = folder / "p.csv";
    job.fields = {"attribute1"};
    const Outcome one = outcome(job);
    EXPECT_EQ(one.summary.method, FoundBy::pass);
    EXPECT_EQ(name(one.summary.method), "pass");
    EXPECT_EQ(one.summary.reason.substr(0, 22), "no index for 1 point: ") << one.summary.reason;
    EXPECT_EQ(one.rows.substr(0, 41), "x,y,z,cell,feature,attribute1\n0.5,0.5,0.5");
    put(folder / "p.csv", "");
    EXPECT_NE(outcome(job).error, "");
    put(folder / "p.csv", "x,y,z\n");
    const Outcome none = outcome(job);
    EXPECT_EQ(none.rows, "x,y,z,cell,feature,attribute1\n");
}

TEST(FewPoints, WhereMostCellsMayHoldAPointThereIsAnIndex) {
    const TemporaryFolder folder;
    Mesh mesh = cube();
    // All cells in one bin, but for a node far away.
    for (std::size_t i = 0; i < mesh.points.size(); ++i) mesh.points[i] *= 1e-6;
    const auto far = static_cast<Mesh::Index>(mesh.point_count());
    mesh.points.insert(mesh.points.end(), {1, 1, 1});
    mesh.cells.insert(mesh.cells.end(), {0, 1, 2, far});
    for (Field& field : mesh.point_fields) field.data.push_back(0.5);
    mesh.cell_fields[0].data.push_back(0.5);
    ASSERT_TRUE(write_tetgen(mesh, folder / "cube"));
    const std::string three = "1e-7,2e-7,3e-7\n1,1,1\n0.75,0.5,0.25\n";
    put_points(folder / "few.csv", three, 1);
    put_points(folder / "many.csv", three, 100);
    const auto [few, many] = both({}, folder);
    ASSERT_EQ(few.error + many.error, "");
    EXPECT_EQ(few.summary.method, many.summary.method);
    EXPECT_EQ(few.rows, many.rows.substr(0, few.rows.size()));
    EXPECT_EQ(few.summary.counts.locations.vertex, 1U);
}

}  // namespace
}  // namespace barycert::testing
