// barycert render: pictures, their summaries, and everything that cannot be drawn.

#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "barycert/raster.hpp"
#include "process.hpp"

namespace barycert::cli_test {
namespace {

/// The picture that the arguments draw; they get --output.
Image picture(const Scratch& scratch, Words arguments) {
    const std::string path = scratch.path("picture.png");
    arguments.insert(arguments.begin(), "render");
    arguments.insert(arguments.end(), {"--output", path});
    const Ended r = run(arguments);
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.err, "");
    const Result<Image> image = read_png(path);
    EXPECT_TRUE(image) << ::testing::PrintToString(arguments);
    return image ? *image : blank_image(1, 1, {}).value();
}

constexpr Rgba white{255, 255, 255, 255};

TEST(RenderPictures, GradientHasARedAGreenAndABlueCorner) {
    const Scratch scratch;
    const Image first = picture(scratch, {"gradient", "--size", "200x160", "--rounding", "correct"});
    ASSERT_EQ(first.width, 200);
    ASSERT_EQ(first.height, 160);
    EXPECT_EQ(first.pixel(0, 0), white);
    EXPECT_GT(first.pixel(13, 17)[0], 240);
    EXPECT_GT(first.pixel(186, 17)[1], 240);
    EXPECT_GT(first.pixel(100, 149)[2], 240);
    const Rgba middle = first.pixel(100, 62);  // the mean of the corners' heights is 61.3
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(middle[k], 85, 3);
    // All methods give the same picture: no value is off by more than one step of 255.
    for (const std::string method : {"barycentric", "scanline", "bilinear"}) {
        const Image other = picture(scratch, {"gradient", "--size", "200x160", "--method", method});
        for (std::size_t i = 0; i < first.data.size(); ++i) ASSERT_NEAR(other.data[i], first.data[i], 1) << method;
    }
}

TEST(RenderPictures, TextureWithTheOriginAtTheLowerLeft) {
    const Scratch scratch;
    const Image four = four_colours();
    const Image once = picture(scratch, {"texture", "--size", "10x10"});
    for (std::int32_t j = 0; j < 10; ++j) {
        for (std::int32_t i = 0; i < 10; ++i) EXPECT_EQ(once.pixel(i, j), four.pixel(i / 5, j / 5));
    }
    // The same from a file.
    ASSERT_TRUE(write_png(scratch.path("four.png"), four));
    EXPECT_EQ(picture(scratch, {"texture", "--size", "10x10", "--image", scratch.path("four.png")}), once);
    const Image repeated = picture(scratch, {"texture", "--size", "8x8", "--coordinates", "0,2", "--wrap", "repeat"});
    EXPECT_EQ(repeated.pixel(4, 0), four.pixel(0, 0));
    const Image mirrored = picture(scratch, {"texture", "--size", "8x8", "--coordinates", "0,2", "--wrap", "mirror"});
    EXPECT_EQ(mirrored.pixel(4, 0), four.pixel(1, 0));
    const Image clamped = picture(scratch, {"texture", "--size", "8x8", "--coordinates", "-1,1"});
    EXPECT_EQ(clamped.pixel(0, 0), four.pixel(0, 0));
    const Image triangle =
        picture(scratch, {"texture", "--shape", "triangle", "--filter", "bilinear", "--size", "9x9"});
    EXPECT_EQ(triangle.pixel(0, 8), white);
    EXPECT_EQ(triangle.pixel(1, 0), four.pixel(0, 0));
}

TEST(RenderPictures, CubeOnceRightAndOnceWrong) {
    const Scratch scratch;
    const auto error = [&](const std::string& interpolation) {
        const Ended r = run({"render", "cube", "--interpolation", interpolation, "--json", "-", "--quiet", "--output",
                             scratch.path("cube.png")});
        EXPECT_EQ(r.code, 0) << r.err;
        const nlohmann::json j = parse(r.out);
        EXPECT_EQ(j["interpolation"], interpolation);
        EXPECT_EQ(j["triangles"]["count"], 12);
        EXPECT_EQ(j["triangles"]["drawn"], 12);
        return j["texel_error"]["texels"].get<double>();
    };
    EXPECT_LT(error("perspective"), 1e-10);
    EXPECT_GT(error("affine"), 5);
    EXPECT_GT(error("projected-z"), 5);
}

TEST(RenderPictures, ClipLeavesWhatIsInTheBox) {
    const Scratch scratch;
    const Image image = picture(scratch, {"clip", "--size", "400x200"});
    // Panels of 200 pixels; the box is 105 of them wide. Around the right one there is nothing.
    for (std::int32_t j = 0; j < 200; ++j) {
        for (const std::int32_t i : {201, 220, 240, 360, 399}) EXPECT_EQ(image.pixel(i, j), white) << i << ' ' << j;
    }
    for (std::int32_t i = 200; i < 400; ++i) {
        for (const std::int32_t j : {0, 20, 40, 160, 199}) EXPECT_EQ(image.pixel(i, j), white) << i << ' ' << j;
    }
    std::size_t beside = 0, same = 0;
    for (std::int32_t j = 60; j < 140; ++j) {
        for (std::int32_t i = 60; i < 140; ++i) {
            const Rgba left = image.pixel(i, j), right = image.pixel(i + 200, j);
            ++beside;
            bool near = true;
            for (std::size_t k = 0; k < 4; ++k) near = near && std::abs(left[k] - right[k]) <= 1;
            same += near ? 1U : 0U;
        }
    }
    EXPECT_GT(same, beside * 98 / 100);  // but at the ends of lines
}

TEST(RenderPictures, MeshInTheColoursOfAField) {
    const Scratch scratch;
    const std::string path = scratch.path("mesh.png");
    for (const std::string name : {"bracket", "cube-hole", "cube-hole-o2", "torus", "plate"}) {
        const Ended r = run({"render", "mesh", mesh(name), "--field", "attribute0", "--size", "300x200", "--output",
                             path, "--json", scratch.path("mesh.json")});
        ASSERT_EQ(r.code, 0) << r.err;
        EXPECT_TRUE(contains(r.out, "triangles")) << r.out;
        EXPECT_TRUE(contains(r.out, "colours    attribute0 from")) << r.out;
        const nlohmann::json j = parse(read_file(scratch.path("mesh.json")));
        EXPECT_EQ(j["width"], 300);
        EXPECT_EQ(j["colours"]["field"], "attribute0");
        EXPECT_EQ(j["triangles"]["outside"], 0);
        EXPECT_EQ(j["triangles"]["clipped"], 0);
        const std::uint64_t pixels = j["pixels"]["count"];
        EXPECT_GT(pixels, 300U * 200 / 10);  // it fills a part of the window
        const Image image = read_png(path).value();
        EXPECT_EQ(image.width, 300);
        EXPECT_EQ(image.height, 200);
    }
}

TEST(RenderPictures, MeshWithFieldsFromFiles) {
    const Scratch scratch;
    // Two triangles; values nan at one: grey.
    scratch.put("m.node", "4 2 0 0\n0 0 0\n1 1 0\n2 1 1\n3 0 1\n");
    scratch.put("m.ele", "2 3 0\n0 0 1 2\n1 0 2 3\n");
    const std::string values = scratch.put("v.txt", "1\nnan\n");
    const Words line{"render", "mesh",   scratch.path("m"), "--cell-field", "v=" + values,         "--field",
                     "cell:v", "--size", "300x200",         "--output",     scratch.path("m.png"), "--json",
                     "-",      "--quiet"};
    const Ended r = run(line);
    ASSERT_EQ(r.code, 0) << r.err;
    const nlohmann::json j = parse(r.out);
    EXPECT_EQ(j["colours"]["low"], 1);
    EXPECT_EQ(j["colours"]["without_value"], 1);
    const std::string vectors = scratch.put("w.txt", "1 5\n2 6\n");
    const Words vector{"render",       "mesh",    scratch.path("m"), "--cell-field",
                       "w=" + vectors, "--quiet", "--output",        scratch.path("w.png"),
                       "--json",       "-",       "--field"};
    Words second = vector;
    second.push_back("w.1");
    EXPECT_EQ(parse(run(second).out)["colours"]["low"], 5);
    for (const auto& [name, says] :
         {std::pair("w", "w.0 to w.1"), {"w.2", "0 to 1"}, {"w.-1", "no field"}, {"zzz", "no field"}}) {
        Words bad = vector;
        bad.push_back(name);
        const Ended refused = run(bad);
        EXPECT_EQ(refused.code, 2);
        EXPECT_TRUE(contains(refused.err, says)) << refused.err;
    }
}

TEST(RenderPictures, ScenesOfTheProject) {
    const Scratch scratch;
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(BARYCERT_DATA_DIR "/scenes")) {
        if (entry.path().extension() != ".json") continue;
        ++count;
        EXPECT_GT(picture(scratch, {entry.path().string()}).width, 100);
    }
    EXPECT_GE(count, 2U);
}

TEST(RenderPictures, ATextureBesideTheSceneIsFoundAndKept) {
    const Scratch scratch;
    std::filesystem::create_directory(scratch.path("parts"));
    ASSERT_TRUE(write_png(scratch.path("parts/four.png"), four_colours()));
    const std::string scene = scratch.put("parts/s.json", R"({"size": [8, 8], "texture": {"image": "four.png"},
        "positions": [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, -1, 0], [1, 1, 0], [-1, 1, 0]],
        "uv": [[0, 0], [1, 0], [1, 1], [0, 0], [1, 1], [0, 1]]})");
    EXPECT_EQ(picture(scratch, {scene}).pixel(7, 0), four_colours().pixel(1, 0));
    const Ended r = run({"render", scene, "--output", scratch.path("parts/four.png")});
    EXPECT_EQ(r.code, 2);
    EXPECT_TRUE(contains(r.err, "would overwrite")) << r.err;
    EXPECT_EQ(read_png(scratch.path("parts/four.png")).value(), four_colours());
    const Ended same = run({"render", scene, "--json", scene, "--output", scratch.path("o.png")});
    EXPECT_EQ(same.code, 2);
    EXPECT_TRUE(contains(same.err, "would overwrite")) << same.err;
}

TEST(RenderPictures, SummariesAndWhereTheyGo) {
    const Scratch scratch;
    const std::string path = scratch.path("g.png");
    EXPECT_EQ(run({"render", "gradient", "--quiet", "--output", path}).out, "");
    const Ended told = run({"render", "gradient", "--output", path});
    EXPECT_TRUE(contains(told.out, "picture    gradient, 400 x 400 pixels")) << told.out;
    const Ended json = run({"render", "gradient", "--output", path, "--json", "-"});
    EXPECT_EQ(parse(json.out)["picture"], "gradient");
    EXPECT_TRUE(contains(json.err, "picture    gradient")) << json.err;
}

/// Nothing is written, an error says what is wrong.
void expect_undrawn(const Words& arguments, const std::string& says, const Scratch& scratch) {
    Words all = arguments;
    all.insert(all.begin(), "render");
    all.insert(all.end(), {"--output", scratch.path("out.png")});
    const Ended r = run(all);
    EXPECT_EQ(r.code, 2) << ::testing::PrintToString(all) << r.err;
    EXPECT_EQ(r.out, "");
    EXPECT_TRUE(contains(r.err, says)) << ::testing::PrintToString(all) << " says " << r.err;
    EXPECT_FALSE(std::filesystem::exists(scratch.path("out.png")));
}

TEST(RenderPictures, WhatCannotBeDrawnIsRefused) {
    const Scratch scratch;
    expect_undrawn({}, "nothing to draw", scratch);
    expect_undrawn({"missing.json"}, "missing.json", scratch);
    for (const std::string size : {"0x5", "5", "5x", "x5", "5x5x5", "-5x5", "1e2x5", "32769x1", "99999999999x9", ""})
        expect_undrawn({"gradient", "--size", size}, "--size", scratch);
    expect_undrawn({"gradient", "--size", "32768x32768"}, "too large", scratch);
    expect_undrawn({"gradient", "--method", "zzz"}, "--method", scratch);
    expect_undrawn({"gradient", "--method", "scanline", "--rounding", "correct"}, "barycentric", scratch);
    expect_undrawn({"cube", "--interpolation", "zzz"}, "--interpolation", scratch);
    expect_undrawn({"cube", "--interpolation", "projected-z", "--rounding", "correct"}, "correct rounding", scratch);
    expect_undrawn({"texture", "--wrap", "zzz"}, "--wrap", scratch);
    expect_undrawn({"texture", "--coordinates", "1"}, "--coordinates", scratch);
    expect_undrawn({"texture", "--coordinates", "0,inf"}, "--coordinates", scratch);
    expect_undrawn({"texture", "--image", "missing.png"}, "missing.png", scratch);
    const std::string text = scratch.put("text.png", "no picture at all");
    expect_undrawn({"texture", "--image", text}, "text.png", scratch);
    expect_undrawn({"mesh"}, "MESH", scratch);
    expect_undrawn({"mesh", "missing"}, "missing", scratch);
    expect_undrawn({"mesh", mesh("bracket"), "--field", "zzz"}, "no field of that name", scratch);
    expect_undrawn({"mesh", mesh("bracket"), "--range", "2,1"}, "--range", scratch);
    expect_undrawn({"mesh", mesh("bracket"), "--camera", "nan,0"}, "--camera", scratch);
    expect_undrawn({"mesh", mesh("bracket"), "--field", "attribute0", "--size", "20x20"}, "no room beside bar and axes",
                   scratch);
    // Other suffixes, folders that are not there, stdout.
    for (const std::string name : {"out.jpg", "-", "no/such/folder/out.png", ""}) {
        const Ended r = run({"render", "gradient", "--output", name}, {.folder = scratch.folder()});
        EXPECT_EQ(r.code, 2) << name;
        EXPECT_EQ(r.out, "");
    }
    EXPECT_EQ(run({"render", "gradient"}).code, 2);
}

TEST(RenderPictures, BrokenScenes) {
    const Scratch scratch;
    const std::string rest = R"(, "positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]})";
    const std::string good = R"({"size": [20, 10])" + rest;
    const std::vector<std::pair<std::string, std::string>> broken{
        {"", "s.json:1: the scene is no JSON"},
        {"{\n\"size\": [20, 10],\n\"positions\": [[0, 0, 0]", "s.json:3: the scene is no JSON"},
        {"[]", "the scene: expected an object"},
        {"{}", "expected a member \"size\""},
        {R"({"size": [20, 10]})", "expected a member \"positions\""},
        {R"({"size": [0, 10])" + rest, "/size/0: expected an integer from 1 to 32768, found 0"},
        {R"({"size": [20, 1e9])" + rest, "/size/1"},
        {R"({"size": [20, 99999999999999999999])" + rest, "/size/1"},
        {R"({"size": [32768, 32768])" + rest, "too large"},
        {R"({"size": 20)" + rest, "/size: expected an array"},
        {R"({"size": [20, 10], "siez": 1)" + rest, "/siez: expected one of the members size"},
        {R"({"size": [20, 10], "size": [2, 1])" + rest, "a member occurs twice in one object: found \"size\""},
        {R"({"size": [20, 10], "positions": [[0, 0, 0], [1, 0], [0, 1, 0]]})",
         "/positions/1: expected x, y, z or x, y, z, w"},
        {R"({"size": [20, 10], "positions": [[0, 0, 0], [1, 0, "nan"], [0, 1, 0]]})",
         "/positions/1/2: expected a finite number"},
        {R"({"size": [20, 10], "positions": [[0, 0, 0], [1, 0, null], [0, 1, 0]]})",
         "/positions/1/2: expected a finite number, found null"},
        {R"({"size": [20, 10], "positions": [[0, 0, 0], [1e999, 0, 0], [0, 1, 0]]})", "s.json"},
        {R"({"size": [20, 10], "positions": [[0, 0, 0], [1, 0, 0]]})",
         "/positions: expected three vertices a triangle"},
        {R"({"size": [20, 10], "triangles": [[0, 1, 3]])" + rest,
         "/triangles/0/2: expected an integer from 0 to 2, found 3"},
        {R"({"size": [20, 10], "triangles": [[0, 1]])" + rest, "/triangles/0: expected an array of 3"},
        {R"({"size": [20, 10], "triangles": [[0, 1, -1]])" + rest, "/triangles/0/2"},
        {R"({"size": [20, 10], "triangles": [[0, 1, 1.5]])" + rest, "/triangles/0/2"},
        {R"({"size": [20, 10], "colours": [[1, 0, 0]])" + rest, "/colours: expected an entry for each of 3 vertices"},
        {R"({"size": [20, 10], "colours": [[1, 0, 0], [1, 0], [1, 0, 0]])" + rest,
         "/colours/1: expected an array of 3 numbers"},
        {R"({"size": [20, 10], "texture": {"pattern": "four-colours"})" + rest, "/texture: expected a member /uv"},
        {R"({"size": [20, 10], "uv": [[0, 0], [1, 0], [0, 1]], "texture": {"pattern": "stripes"})" + rest,
         "/texture/pattern: expected one of"},
        {R"({"size": [20, 10], "uv": [[0, 0], [1, 0], [0, 1]], "texture": {"image": "missing.png"})" + rest,
         "missing.png"},
        {R"({"size": [20, 10], "uv": [[0, 0], [1, 0], [0, 1]], "texture": {"pattern": "checkerboard", "cells": 9000})" +
             rest,
         "/texture/cells"},
        {R"({"size": [20, 10], "uv": [[0, 0], [1, 0], [0, 1]], "texture": {"pattern": "checkerboard", "cells": 900, "texels": 900})" +
             rest,
         "/texture"},
        {R"({"size": [20, 10], "matrix": [1, 2, 3])" + rest, "/matrix: expected an array of 16 numbers"},
        {R"({"size": [20, 10], "matrix": [1e300,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1], "model": [1e300,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1])" +
             rest,
         "matrix"},
        {R"({"size": [20, 10], "camera": {})" + rest, "/camera: expected either \"perspective\" or \"orthographic\""},
        {R"({"size": [20, 10], "camera": {"perspective": {"fovy": 200, "near": 1, "far": 2}})" + rest,
         "/camera/perspective: the angle of sight"},
        {R"({"size": [20, 10], "camera": {"perspective": {"fovy": 50, "near": 0, "far": 2}})" + rest, "0 < near < far"},
        {R"({"size": [20, 10], "camera": {"eye": [0, 0, 0], "centre": [0, 0, 0], "perspective": {"fovy": 50, "near": 1, "far": 2}})" +
             rest,
         "/camera: a camera that looks nowhere"},
        {R"({"size": [20, 10], "camera": {"eye": [0, 0, 0], "perspective": {"fovy": 50, "near": 1, "far": 2}})" + rest,
         "expected a member \"centre\""},
        {R"({"size": [20, 10], "method": "fast")" + rest, "/method: expected one of"},
        {R"({"size": [20, 10], "background": [1, 2, 0])" + rest, "/background/1"},
        {R"({"size": [20, 10], "rounding": "correct", "method": "scanline")" + rest, "barycentric"},
        {std::string(200000, '['), "s.json:1"},
    };
    const std::string path = scratch.put("s.json", good);
    EXPECT_EQ(run({"render", path, "--quiet", "--output", scratch.path("good.png")}).code, 0);
    for (const auto& [json, says] : broken) {
        scratch.put("s.json", json);
        expect_undrawn({path}, says, scratch);
    }
}

TEST(RenderPictures, NumbersOfScenesThatHurtButCanBeDrawn) {
    const Scratch scratch;
    const std::vector<std::pair<std::string, std::string>> drawn{
        {"[[0, 0, 0, 0], [1, 0, 0], [0, 1, 0]]", "1 without area"},                            // w = 0 at a vertex
        {"[[0, 0, 0], [0.5, 0.5, 0], [1, 1, 0]]", "1 without area"},                           // on a line
        {"[[0, 0, 0], [1e-3, 0, 0], [0, 1e-3, 0]]", "1 too small for the middle of a pixel"},  // smaller than a pixel
        {"[[1e308, 0, 0], [-1e308, 1, 0], [0, -1e308, 0]]", "1 drawn; 1 clipped"},             // huge
        {"[[0, 0, 5], [1, 0, 5], [0, 1, 5]]", "1 out of sight"},
        {"[[0, 0, 0, -1], [1, 0, 0, -1], [0, 1, 0, -1]]", "1 out of sight"},
        {"[[5e-324, 0, 0, 5e-324], [0, 5e-324, 0, 5e-324], [\"-0x1p-1074\", 0, 0, 5e-324]]", "1 drawn"},
        {"[]", "triangles  0"},
    };
    for (const auto& [positions, says] : drawn) {
        const std::string path = scratch.put("s.json", R"({"size": [20, 10], "positions": )" + positions + "}");
        for (const std::string rounding : {"plain", "correct"}) {
            const Ended r = run({"render", path, "--output", scratch.path("out.png")});
            EXPECT_EQ(r.code, 0) << r.err;
            EXPECT_TRUE(contains(r.out, says)) << positions << r.out;
        }
    }
}

/// The pictures of the documents are those that their commands draw, where these need no other files: no component is
/// off by more than one step, but in one pixel of a thousand, for tangent and sine may differ from machine to machine
/// in their last bit, and so may a centre's side of an edge.
TEST(RenderPictures, AreThoseOfTheDocuments) {
    const Scratch scratch;
    const std::string folder = scratch.path(".");
    std::filesystem::create_directory_symlink(BARYCERT_DATA_DIR, scratch.path("data"));
    std::size_t count = 0;
    for (const std::string document : {"rendering", "gallery"}) {
        for (const std::string& line : lines_of(read_file(BARYCERT_DATA_DIR "/../doc/" + document + ".md"))) {
            if (line.starts_with("awk ")) {
                ASSERT_EQ(run_shell("cd " + folder + " && " + line).code, 0) << line;
            }
            const std::string begin = "./run barycert ", end = contains(line, " --plot ") ? " --plot " : " --output ";
            const std::size_t output = line.find(end);
            if (!line.starts_with(begin) || output == std::string::npos) continue;
            std::string name =
                line.substr(output + end.size(), line.find(' ', output + end.size()) - output - end.size());
            const std::string path = scratch.path(name);
            name = name == "flange.png" ? "mesh.png" : name;
            const std::string golden = BARYCERT_DATA_DIR "/../doc/" + document + "/" + name;
            if (!name.ends_with(".png") || !std::filesystem::exists(golden)) continue;
            if (contains(line, "mesh broken") || contains(line, "probes.csv")) continue;
            ++count;
            const std::string command = line.substr(begin.size(), output - begin.size());
            const Ended r = run_shell("cd " + folder + " && barycert " + command + " --quiet" + end + path);
            ASSERT_EQ(r.code, 0) << r.err;
            const Image drawn = read_png(path).value(), kept = read_png(golden).value();
            ASSERT_EQ(drawn.width, kept.width);
            ASSERT_EQ(drawn.height, kept.height);
            std::size_t off = 0;
            for (std::size_t i = 0; i < kept.data.size(); i += 4) {
                bool near = true;
                for (std::size_t k = i; k < i + 4; ++k) near = near && std::abs(drawn.data[k] - kept.data[k]) <= 1;
                off += near ? 0U : 1U;
            }
            EXPECT_LE(off, kept.data.size() / 4 / 1000) << name;
            EXPECT_LT(std::filesystem::file_size(golden), 150000U) << name;
        }
    }
    EXPECT_GE(count, 19U);
}

}  // namespace
}  // namespace barycert::cli_test
