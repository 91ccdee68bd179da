// barycert render mesh: what of a mesh is drawn, and how; barycert sample --plot.

#include <cmath>

#include <gtest/gtest.h>

#include "barycert/raster.hpp"
#include "process.hpp"
#include "sample_meshes.hpp"

namespace barycert::cli_test {
namespace {

class RenderMesh : public ::testing::Test {
protected:
    Words line(const Words& more) const {
        return plus({"render", "mesh", mesh("cube-hole"), "--size", "240x180", "--output", png_}, more);
    }
    Image drawn(const Words& more) const {
        const Ended r = run(line(more));
        EXPECT_EQ(r.code, 0) << r.err;
        const Result<Image> image = read_png(png_);
        return image ? *image : blank_image(1, 1, {}).value();
    }
    /// Pixels that are not white.
    static std::size_t ink(const Image& image) {
        std::size_t count = 0;
        for (std::int32_t k = 0; k < image.width * image.height; ++k)
            count += image.pixel(k % image.width, k / image.width) != Rgba{255, 255, 255, 255} ? 1U : 0U;
        return count;
    }
    Scratch scratch_;
    std::string png_ = scratch_.path("p.png");
};

TEST_F(RenderMesh, EveryChoiceShowsItsPart) {
    const Words bare{"--axes", "none", "--no-bar"};
    const std::size_t whole = ink(drawn(bare));
    EXPECT_GT(whole, 5000U);
    const auto part = [&](const Words& more) { return ink(drawn(plus(bare, more))); };
    const std::size_t outline = part({"--no-surface", "--outline"});
    EXPECT_GT(outline, 300U);
    EXPECT_LT(outline, whole / 3);
    EXPECT_LT(part({"--slice", "z=0.5"}), whole);
    EXPECT_GT(part({"--slice", "z=0.5", "--slice", "x=0.25", "--outline"}), part({"--slice", "z=0.5"}));
    EXPECT_GT(part({"--iso", "attribute0=1.2,2.5"}), 500U);
    EXPECT_GT(part({"--mark", "0,1,2"}), outline);
    EXPECT_GT(part({"--threshold", "attribute0=1,2"}), 500U);
    EXPECT_GT(part({"--clip", "0,1,0,1,0.5,1"}), 500U);
    // Cut open, with the section: as much is covered from there, in other colours.
    const Image open = drawn(plus(bare, {"--clip", "x=0.5", "--field", "attribute0"}));
    EXPECT_GT(ink(open), 5000U);
    EXPECT_NE(open, drawn(plus(bare, {"--field", "attribute0"})));
    EXPECT_NE(drawn(bare), drawn(plus(bare, {"--edges"})));
}

TEST_F(RenderMesh, ColoursAxesAndCameras) {
    const Words field{"--field", "attribute0"};
    const Image first = drawn(field);
    for (const Words& more : std::vector<Words>{{"--colormap", "coolwarm"},
                                                {"--colormap", "viridis_r"},
                                                {"--range", "0,0.5"},
                                                {"--title", "a title"},
                                                {"--unit", "K"},
                                                {"--background", "dark"},
                                                {"--background", "#ffeedd"},
                                                {"--axes", "box"},
                                                {"--axes", "none"},
                                                {"--no-bar"},
                                                {"--view", "+x"},
                                                {"--camera", "45,10"},
                                                {"--zoom", "1.5"},
                                                {"--parallel"},
                                                {"--samples", "1"}})
        EXPECT_NE(drawn(plus(field, more)), first) << more[0];
    EXPECT_EQ(drawn(plus(field, {"--resolution", "2"})).width, 480);
    EXPECT_EQ(drawn(plus(field, {"--background", "none"})).pixel(0, 0)[3], 0);
    for (const auto& [option, value] : std::vector<std::pair<std::string, std::string>>{{"--colormap", "jet"},
                                                                                        {"--background", "grey"},
                                                                                        {"--axes", "cube"},
                                                                                        {"--view", "x"},
                                                                                        {"--camera", "1"},
                                                                                        {"--zoom", "0"},
                                                                                        {"--samples", "9"},
                                                                                        {"--samples", "0"},
                                                                                        {"--clip", "x"},
                                                                                        {"--clip", "1,2,3,4,5"},
                                                                                        {"--clip", "1,0,0,1,0,1"},
                                                                                        {"--threshold", "a=2,1"},
                                                                                        {"--threshold", "a=1"},
                                                                                        {"--iso", "a"},
                                                                                        {"--slice", "w=1"},
                                                                                        {"--mark", "-1"},
                                                                                        {"--resolution", "0"}})
        expect_error(line({option, value}), option);
    expect_error(line({"--mark", "99999999"}), "no such cell to mark");
    expect_error(line({"--threshold", "attribute0=7,8"}), "no cell is left to draw");
    expect_error(line({"--arrows", "attribute0"}), "arrows are of a field of nodes");
    expect_error(line({"--iso", "cell:attribute0=1"}), "");
    expect_error(line({"--no-surface"}), "nothing to draw");
    expect_error(line({"--slice", "x=-5"}), "a slice is empty");
    expect_error(line({"--iso", "attribute0=99"}), "the iso-surface of a value is empty");
    expect_error(line({"--slice", "x=0.5", "--clip", "y=0.5"}), "cutting open by a plane is for the boundary");
}

TEST_F(RenderMesh, VectorsStayVectors) {
    for (const std::string name : {"p.svg", "p.pdf"}) {
        const Ended r = run({"render", "mesh", mesh("plate"), "--field", "attribute0", "--title", "plate", "--edges",
                             "--output", scratch_.path(name)});
        EXPECT_EQ(r.code, 0) << r.err;
    }
    EXPECT_TRUE(contains(read_file(scratch_.path("p.svg")), ">plate</text>"));
    EXPECT_TRUE(contains(read_file(scratch_.path("p.pdf")), "%PDF"));
    expect_error({"render", "mesh", mesh("plate"), "--output", scratch_.path("p.jpg")}, ".png .svg .pdf or .html");
    const Ended sized = run({"render", "mesh", mesh("plate"), "--scale", "100", "--axes", "none", "--output", png_});
    EXPECT_EQ(sized.code, 0) << sized.err;
}

TEST_F(RenderMesh, ArrowsOfAField) {
    const std::string two = put_two_cells(scratch_);
    const std::string v = "v=" + scratch_.put("v.txt", "0 0 0\n3 4 0\n0 0 2\n0 0 0\n1 1 1\n");
    const Words bare{"render", "mesh", two, "--field-file", v, "--axes", "none", "--no-surface", "--output", png_};
    const Ended r = run(plus(bare, {"--arrows", "v"}));
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_GT(ink(read_png(png_).value()), 100U);
    expect_error(plus(bare, {"--arrows", "w"}), "one of 3 components, of which there is: v");
}

TEST_F(RenderMesh, PointsOfATable) {
    const std::string points = scratch_.put("p.csv", "t,a,b,c\n0,0.1,0.5,0.5\n1,0.9,0.5,0.5\n2,3,0.5,0.5\n");
    const Words bare{"--axes", "none", "--no-bar", "--no-surface", "--field", "attribute0", "--points", points};
    expect_error(line(bare), "columns");
    const Ended r = run(line(plus(bare, {"--columns", "a,b,c", "--point-size", "20"})));
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.out, "values of 1 of 3 points, which lie in no cell: grey")) << r.out;
    EXPECT_NEAR(static_cast<double>(ink(read_png(png_).value())), 3 * 306, 80);  // one is cut off a little
    const Ended out = run(line(plus(bare, {"--columns", "2,3,4", "--threshold", "attribute0=1,2"})));
    EXPECT_TRUE(contains(out.out, "values of 2 of 3 points")) << out.out << out.err;
    expect_error(line({"--columns", "1,2,3"}), "--points");
}

TEST(SamplePlot, AlongALineAndOverTime) {
    const Scratch scratch;
    const std::string svg = scratch.path("p.svg"), csv = scratch.path("p.csv");
    const Words line{"sample", mesh("cube-hole"), "--line", "0,0.5,0.5:1,0.5,0.5", "--count", "101"};
    const Ended r = run(plus(line, {"--fields", "attribute0", "--plot", svg, "--output", csv, "--unit", "K"}));
    EXPECT_EQ(r.code, 0) << r.err;
    const std::string text = read_file(svg);
    EXPECT_TRUE(contains(text, ">length from the first point</text>")) << text;
    EXPECT_TRUE(contains(text, ">attribute0 (K)</text>"));
    // The hole breaks the curve: two pieces, and no mark.
    std::size_t pieces = 0;
    for (std::size_t at = text.find("<path fill=\"none\" stroke=\"#d55e00\""); at != std::string::npos;
         at = text.find("<path fill=\"none\" stroke=\"#d55e00\"", at + 1))
        ++pieces;
    EXPECT_EQ(pieces, 3U) << "two, and one in the legend";
    EXPECT_EQ(lines_of(read_file(csv)).size(), 102U);
    EXPECT_TRUE(contains(read_file(csv), "\n0.5,0.5,0.5,")) << "the middle";
    EXPECT_EQ(run(plus(line, {"--fields", "attribute0", "--plot", svg})).code, 0) << "without rows";
    expect_error(line, "no output");
    expect_error(plus(line, {"--plot", scratch.path("p.gif")}), ".png, .svg or .pdf");
    expect_error(plus(line, {"--plot", svg, "--points", "x.csv"}), "--points");
    expect_error({"sample", mesh("cube-hole"), "--line", "0,0:1,1", "--plot", svg}, "--line");
    expect_error({"sample", mesh("cube-hole"), "--line", "0,0,0", "--plot", svg}, "--line");
    const std::string two = put_two_cells(scratch);
    for (const char* step : {"0", "1", "2"})
        scratch.put("u-" + std::string(step) + ".txt", "1\n2\n3\n4\n" + std::string(step) + "\n");
    const Ended over = run({"sample", two, "--points", scratch.put("p.csv", "x,y,z\n0.1,0.1,0.1\n0.2,0.2,0.2\n"),
                            "--field", "u@" + scratch.path("u-*.txt"), "--fields", "u", "--plot", svg});
    EXPECT_EQ(over.code, 0) << over.err;
    EXPECT_TRUE(contains(read_file(svg), ">u, point 1</text>")) << read_file(svg);
}

}  // namespace
}  // namespace barycert::cli_test
