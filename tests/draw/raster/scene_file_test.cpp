// Scene files: the picture is what they say. Anything else is an Error, and never more than that. The words of each
// error are tested on the command line.
#include <gtest/gtest.h>

#include "barycert/scene.hpp"
#include "core/base/random.hpp"
#include "tests/temporary_folder.hpp"

namespace barycert {
namespace {

using testing::put;
using testing::TemporaryFolder;

const std::string whole = R"({
  "size": [30, 20], "background": [0, 0.5, 1, 0.25],
  "camera": {"eye": [0, 0, 3], "centre": [0, 0, 0], "up": [0, 1, 0], "perspective": {"fovy": 60, "near": 1, "far": 9}},
  "model": [1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
  "positions": [[-1, -1, 0], [1, "-0x1p0", 0, 1], [0, 1, 0]],
  "colours": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  "uv": [[0, 0], [1, 0], [0.5, 1]],
  "triangles": [[0, 1, 2]],
  "texture": {"pattern": "checkerboard", "cells": 2, "texels": 3, "wrap": "repeat", "filter": "bilinear"},
  "method": "scanline", "interpolation": "affine", "rounding": "plain"
})";

TEST(SceneFile, SaysWhatIsDrawn) {
    const TemporaryFolder folder;
    put(folder / "s.json", whole);
    const Scene s = read_scene(folder / "s.json").value();
    EXPECT_EQ(s.size, (RasterSize{30, 20}));
    EXPECT_EQ(s.background, (Rgba{0, 128, 255, 64}));
    EXPECT_EQ(s.positions, (std::vector<double>{-1, -1, 0, 1, 1, -1, 0, 1, 0, 1, 0, 1}));
    EXPECT_EQ(s.colours, (std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1}));
    EXPECT_EQ(s.texture_coordinates, (std::vector<double>{0, 0, 1, 0, 0.5, 1}));
    EXPECT_EQ(s.triangles, (std::vector<std::int32_t>{0, 1, 2}));
    ASSERT_TRUE(s.texture);
    EXPECT_EQ(s.texture->image, checkerboard(2, 3).value());
    EXPECT_EQ(s.texture->wrap, Wrap::repeat);
    EXPECT_EQ(s.texture->filter, Filter::bilinear);
    EXPECT_EQ(s.method, FillMethod::scanline);
    EXPECT_EQ(s.interpolation, Interpolation::affine);
    EXPECT_EQ(s.to_clip, perspective(60, 1.5, 1, 9).value() * look_at({0, 0, 3}, {0, 0, 0}, {0, 1, 0}).value() *
                             translation({0.5, 0, 0}));
    EXPECT_TRUE(render(s));
    EXPECT_TRUE(scene_files(folder / "s.json").empty());
}

TEST(SceneFile, CutShortOrChangedAnywhere) {
    const TemporaryFolder folder;
    base::Random random(1);
    for (std::size_t n = 0; n < whole.size(); ++n) {
        put(folder / "s.json", whole.substr(0, n));
        const Result<Scene> cut = read_scene(folder / "s.json");
        ASSERT_FALSE(cut) << n;
        ASSERT_EQ(cut.error().file, folder / "s.json");
    }
    const std::string characters = "{}[],:\"0123456789.-+eE\\ xnullatrue\n\x80\xff";
    std::size_t good = 0;
    for (int k = 0; k < 3000; ++k) {
        std::string changed = whole;
        for (std::uint64_t times = 1 + random.below(3); times > 0; --times) {
            const std::size_t at = random.below(changed.size());
            changed[at] = characters[random.below(characters.size())];
        }
        put(folder / "s.json", changed);
        const Result<Scene> scene = read_scene(folder / "s.json");
        static_cast<void>(scene_files(folder / "s.json"));
        if (!scene) continue;
        ++good;
        if (std::int64_t{scene->size.width} * scene->size.height < 100000) static_cast<void>(render(*scene));
    }
    EXPECT_GT(good, 50U);
}

TEST(SceneFile, ImagesAreBesideTheScene) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_png(folder / "four.png", four_colours()));
    put(folder / "s.json",
        R"({"size": [1, 1], "positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "uv": [[0, 0], [1, 0], [0, 1]],
            "texture": {"image": "four.png"}})");
    EXPECT_EQ(read_scene(folder / "s.json").value().texture->image, four_colours());
    EXPECT_EQ(scene_files(folder / "s.json"), (std::vector<std::string>{folder / "four.png"}));
    std::filesystem::remove(folder / "four.png");
    const Result<Scene> missing = read_scene(folder / "s.json");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().file, folder / "four.png");
    EXPECT_FALSE(read_scene(folder / "none.json"));
    EXPECT_TRUE(scene_files(folder / "none.json").empty());
}

}  // namespace
}  // namespace barycert
