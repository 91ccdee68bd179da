// barycert render drift and texels: tables, JSON, a picture; and perspective in audit and replay.

#include <gtest/gtest.h>

#include "process.hpp"

namespace barycert::cli_test {
namespace {

TEST(RenderDrift, PrintsATableAndWritesFiguresAndAPlot) {
    const Scratch scratch;
    const Ended r =
        run({"render", "drift", "--count", "50", "--output", scratch.path("d.svg"), "--json", scratch.path("d.json")});
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.out, "triangle.scanline-increments.float32")) << r.out;
    EXPECT_TRUE(contains(r.out, "4096")) << r.out;
    const auto j = parse(read_file(scratch.path("d.json")));
    ASSERT_EQ(j["kernels"].size(), 5U);
    EXPECT_EQ(j["kernels"][0]["sizes"].size(), 11U);
    EXPECT_EQ(j["count"], 50);
    EXPECT_TRUE(read_file(scratch.path("d.svg")).starts_with("<svg "));
    // The same again, on stdout alone.
    const Ended again = run({"render", "drift", "--count", "50", "--output", "-"});
    EXPECT_EQ(again.out, read_file(scratch.path("d.svg")));
    EXPECT_EQ(run({"render", "drift", "--count", "50", "--json", "-"}).out, read_file(scratch.path("d.json")));
    EXPECT_EQ(run({"render", "drift", "--count", "50", "--quiet"}).out, "");
}

TEST(RenderDrift, RefusesOneFileForTwoOutputs) {
    const Scratch scratch;
    const Ended r =
        run({"render", "drift", "--count", "50", "--output", scratch.path("d"), "--json", scratch.path("d")});
    EXPECT_EQ(r.code, 2);
    EXPECT_EQ(r.out, "");
    EXPECT_EQ(scratch.names(), Words{});
}

TEST(RenderDrift, TakesAKernelOfTheUserAndRefusesAnotherSimplex) {
    const Ended r = run({"render", "drift", "--count", "50", "--kernel-library", BARYCERT_USER_KERNEL});
    EXPECT_EQ(r.code, 2);
    EXPECT_TRUE(contains(r.err, "tetrahedron.user-volume")) << r.err;
}

TEST(RenderTexels, ShowsTheRim) {
    const Scratch scratch;
    const Ended r = run({"render", "texels", "--count", "5000", "--json", scratch.path("t.json")});
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.out, "texture.clamp-to-w")) << r.out;
    EXPECT_TRUE(contains(r.out, "past_end: u = 1 ")) << r.out;
    const auto report = parse(read_file(scratch.path("t.json")));
    for (const auto& rule : report["rules"]) {
        const std::string name = rule["name"];
        EXPECT_EQ(rule["past_end"] > 0, name == "texture.clamp-to-w" || name == "texture.fraction") << name;
        if (contains(name, "exact")) {
            EXPECT_EQ(rule["witnesses"].size(), 0U) << name;
        }
    }
}

TEST(Perspective, IsAuditedAndReplayed) {
    const Scratch scratch;
    const std::string witnesses = scratch.path("w.json");
    const Ended r = run({"audit", "--kernel", "triangle.perspective-*", "--family", "perspective.*", "--count", "300",
                         "--wide", "--witnesses", witnesses});
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.out, "triangle.perspective-exact: no witness")) << r.out;
    const Ended replay = run({"replay", witnesses});
    EXPECT_EQ(replay.code, 0) << replay.err;
    EXPECT_TRUE(contains(replay.out, "triangle.perspective-projected-z")) << replay.out;
    const Ended made = run({"replay", "--family", "perspective.edge-on", "--case", "3"});
    EXPECT_EQ(made.code, 0) << made.err;
    EXPECT_TRUE(contains(made.out, "triangle in a window")) << made.out;
}

}  // namespace
}  // namespace barycert::cli_test
