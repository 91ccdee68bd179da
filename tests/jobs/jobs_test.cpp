// Whole jobs as a library calls them. Their output is tested by way of the command line, in tests/cli.
#include "barycert/job.hpp"
#include "barycert/sample_job.hpp"
#include "barycert/check_job.hpp"
#include "barycert/verify_job.hpp"
#include "barycert/render_job.hpp"
#include "barycert/contour_job.hpp"
#include "barycert/check.hpp"
#include "barycert/certificate.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/fix.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/plc.hpp"
#include "barycert/surface.hpp"
#include "barycert/figure.hpp"
#include "barycert/grid.hpp"
#include "barycert/verify.hpp"
#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/io/tetgen/mesh_files.hpp"

namespace barycert::testing {
namespace {

const std::string mesh = BARYCERT_DATA_DIR "/meshes/cube-hole";

TEST(Jobs, SampleTellsWhatItDoesAndDid) {
    const TemporaryFolder folder;
    std::vector<std::string> stages;
    SampleJob job;
    job.mesh = mesh;
    job.fields = {"attribute0"};
    job.points = mesh + ".node";
    job.output = folder / "rows.csv";
    job.progress = [&](const JobProgress& p) { stages.emplace_back(p.stage); };
    const auto summary = sample_files(job);
    ASSERT_TRUE(summary) << summary.error().message();
    EXPECT_EQ(summary->command, "sample");
    EXPECT_EQ(summary->cells, 1590U);
    EXPECT_EQ(summary->rows, 409U);
    EXPECT_EQ(summary->counts.locations.vertex, 409U) << "each point is a node";
    EXPECT_EQ(summary->columns, std::vector<std::string>{"attribute0"});
    EXPECT_EQ(summary->method, FoundBy::walk);
    EXPECT_EQ(summary->verdict, Verdict::certified);
    ASSERT_GE(stages.size(), 3U);
    EXPECT_EQ(stages.front(), "reading " + mesh);
    EXPECT_EQ(stages.back(), "proving the partition");
    EXPECT_TRUE(std::filesystem::exists(job.output));
}

TEST(Jobs, ResampleOntoAGrid) {
    const TemporaryFolder folder;
    ResampleJob job;
    job.mesh = mesh;
    job.fields = {"attribute0"};
    job.counts = {4, 4, 4};
    job.output = folder / "grid.npy";
    const auto summary = resample_files(job);
    ASSERT_TRUE(summary) << summary.error().message();
    EXPECT_EQ(summary->rows, 64U);
    EXPECT_EQ(summary->from, PointsFrom::grid);
    ASSERT_TRUE(summary->grid);
    EXPECT_EQ(summary->grid->counts[2], 4);
}

TEST(Jobs, ContoursTellWhatTheyDid) {
    const TemporaryFolder folder;
    ContourJob job;
    job.mesh = mesh;
    job.field = "attribute1";
    job.value = 0.3;
    job.output = folder / "s.ply";
    const auto surface = contour_files(job);
    ASSERT_TRUE(surface) << surface.error().message();
    EXPECT_EQ(surface->cells, 1590U);
    EXPECT_EQ(surface->fields.size(), 5U);
    EXPECT_EQ(surface->counts.at_nodes + surface->counts.on_edges, surface->points);
    EXPECT_GT(surface->parts, 0U);
    EXPECT_LE(surface->low, 0.3);
    EXPECT_GE(surface->high, 0.3);
    job.value.reset();
    job.plane = Plane{{0, 1, 0}, 0.75};
    job.output = folder / "s.png";
    job.width = 64;
    job.figure.samples = 1;
    const auto picture = contour_files(job);
    ASSERT_TRUE(picture) << picture.error().message();
    ASSERT_TRUE(picture->pixels);
    // Seen against y, x runs to the left and z upwards.
    const PixelGrid& pixels = *picture->pixels;
    EXPECT_EQ(pixels.height, 64);
    EXPECT_EQ(pixels.step_right[0], -1.0 / 64);
    EXPECT_EQ(pixels.step_up[2], 1.0 / 64);
    EXPECT_EQ(pixels.middle(0, 0), (std::array<double, 3>{1 - 1.0 / 128, 0.75, 1.0 / 128}));
    EXPECT_EQ(picture->drawn.grid.drawn + picture->drawn.grid.outside, 64U * 64U);
    EXPECT_EQ(picture->samples.locations.points(), 64U * 64U);
}

TEST(Jobs, RefusedJobsWriteNothing) {
    const TemporaryFolder folder;
    SampleJob both;
    both.mesh = mesh;
    both.points = mesh + ".node";
    both.map = "m";
    both.output = folder / "rows.csv";
    EXPECT_FALSE(sample_files(both));
    SampleJob same;
    same.mesh = mesh;
    same.points = mesh + ".node";
    same.output = folder / "rows.csv";
    same.reports = {{"the report", same.output}};
    EXPECT_FALSE(sample_files(same)) << "the report is to go where the rows go";
    ResampleJob none;
    none.mesh = mesh;
    none.output = folder / "grid.npy";
    EXPECT_FALSE(resample_files(none));
    ContourJob neither;
    neither.mesh = mesh;
    neither.output = folder / "s.vtp";
    EXPECT_FALSE(contour_files(neither));
    neither.value = 1;
    neither.plane = Plane{};
    EXPECT_FALSE(contour_files(neither)) << "both";
    neither.plane.reset();
    EXPECT_FALSE(contour_files(neither)) << "no field";
    EXPECT_EQ(folder.file_count(), 0U);
}

}  // namespace
}  // namespace barycert::testing
