// Witness files that are not: refused with their name, and with what is wrong where.

#include <sys/stat.h>

#include <filesystem>

#include <gtest/gtest.h>

#include "process.hpp"

namespace barycert::cli_test {
namespace {

using Json = nlohmann::json;

const Json good = Json::parse(R"({"simplex": "triangle", "kernel": "triangle.inverse",
    "vertices": [["0x0p+0", "0x0p+0"], ["0x1p+0", "0x0p+0"], ["0x0p+0", "0x1p+0"]],
    "point": ["0x1p-2", "0x1p-2"], "values": ["0x0p+0", "0x1p+0", "0x1p+1"]})");

std::string file_of(const Json& witness) {
    return Json{{"schema", 1}, {"witnesses", Json::array({good, witness})}}.dump();
}

void expect_refused(const std::string& text, const std::string& says) {
    const Scratch scratch;
    const std::string path = scratch.put("w.json", text);
    const Ended r = run({"replay", path});
    EXPECT_EQ(r.code, 2) << text;
    EXPECT_EQ(r.out, "") << text;
    EXPECT_EQ(r.err.rfind("error: " + path + ": ", 0), 0U) << r.err;
    EXPECT_TRUE(contains(r.err, says)) << r.err;
    EXPECT_EQ(lines_of(r.err).size(), 1U) << r.err;
}

TEST(WitnessInput, TheGoodOneIsShown) {
    const Scratch scratch;
    const Ended r = run({"replay", scratch.put("w.json", file_of(good))});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.out, "exact: interior"));
    // Written by hand: decimal numbers, no kernel, no values.
    Json plain = good;
    plain.erase("kernel");
    plain.erase("values");
    plain["point"] = Json::parse(R"([0.25, "1e-3"])");
    EXPECT_EQ(run({"replay", scratch.put("w.json", file_of(plain))}).code, 0);
}

TEST(WitnessInput, NotJsonOrAnotherSchema) {
    for (const char* text : {"", "{", "3 2 0 0\n", "{\"schema\": 1,}", "\xff\xfe", "{\"schema\": 1, \"witnesses\": ["})
        expect_refused(text, "expected JSON");
    expect_refused("[]", "expected a member \"schema\"");
    expect_refused("7", "expected a member \"schema\"");
    expect_refused("{}", "expected a member \"schema\"");
    expect_refused(R"({"schema": 2, "witnesses": []})", "unknown schema: expected 1, found 2");
    expect_refused(R"({"schema": "1", "witnesses": []})", "unknown schema");
    expect_refused(R"({"schema": 1})", "expected a member \"witnesses\"");
    expect_refused(R"({"schema": 1, "witnesses": {}})", "expected an array");
    expect_refused(R"({"schema": 1, "witnesses": []})", "no witness matches");
    expect_refused(R"({"schema": 1, "witnesses": [7]})", "witness 0");
}

TEST(WitnessInput, MembersMissingOrMalformed) {
    for (const char* key : {"simplex", "vertices", "point"}) {
        Json w = good;
        w.erase(key);
        expect_refused(file_of(w), std::string("witness 1: expected a member \"") + key + '"');
    }
    const auto with = [](const char* key, const char* value) {
        Json w = good;
        w[key] = Json::parse(value);
        return file_of(w);
    };
    expect_refused(with("simplex", "\"pentagon\""), "expected segment, triangle, triangle3d or tetrahedron");
    expect_refused(with("simplex", "3"), "expected segment, triangle, triangle3d or tetrahedron");
    expect_refused(with("vertices", "[[0, 0], [1, 0]]"),
                   "witness 1, vertices: expected an array of 3, found 2 entries");
    expect_refused(with("vertices", "[[0, 0], [1, 0], [0, 1, 0]]"), "witness 1, vertex 2: expected 2 coordinates");
    expect_refused(with("vertices", "\"none\""), "expected an array of 3");
    expect_refused(with("point", "[0]"), "witness 1, point: expected an array of 2, found 1 entries");
    expect_refused(with("values", "[0, 1]"), "witness 1, values: expected an array of 3, found 2 entries");
    // Right lengths for another simplex are wrong for this one.
    expect_refused(with("simplex", "\"tetrahedron\""), "expected an array of 4");
}

TEST(WitnessInput, DepthsOfPerspective) {
    Json w = good;
    w["kernel"] = "triangle.perspective-affine";
    w["perspective"] = true;
    expect_refused(file_of(w), "witness 1, vertex 0: expected 2 coordinates and w");
    w["vertices"] = Json::parse("[[0, 0, 1], [8, 0, 3], [0, 8, 2]]");
    w["point"] = Json::parse("[4, 0]");
    const Scratch scratch;
    const Ended r = run({"replay", scratch.put("w.json", file_of(w)), "--kernel", "triangle.perspective-affine"});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.out, "triangle in a window (vertices x, y, w)")) << r.out;
    EXPECT_TRUE(contains(r.out, "exact: boundary (edge)")) << r.out;
    EXPECT_TRUE(contains(r.out, "ray casting and interpolation of 1/w give the same weights here")) << r.out;
    for (const char* depth : {"0", "-1", "\"-0x1p-1074\"", "\"nan\""}) {
        Json bad = w;
        bad["vertices"][1][2] = Json::parse(depth);
        expect_refused(file_of(bad), "witness 1, vertex 1: expected a");
    }
    w["simplex"] = "tetrahedron";
    expect_refused(file_of(w), "witness 1, perspective: expected false, or true for a triangle");
}

TEST(WitnessInput, NumbersThatAreNone) {
    for (const Json& x : std::vector<Json>{"nan", "NaN", "inf", "-inf", "0x1p+9999", "1e999", "", " 1", "1 ", "0x",
                                           "1.5.2", nullptr, true, Json::array()}) {
        Json w = good;
        w["point"][1] = x;
        expect_refused(file_of(w), "witness 1, point: expected a finite number");
        w = good;
        w["vertices"][2][0] = x;
        expect_refused(file_of(w), "witness 1, vertex 2: expected a finite number");
        w = good;
        w["values"][0] = x;
        expect_refused(file_of(w), "witness 1, values: expected a finite number");
    }
    expect_refused(
        R"({"schema":1,"witnesses":[{"simplex":"triangle","vertices":[[0,0],[1,0],[0,1]],"point":[1e999,0]}]})", "");
}

TEST(WitnessInput, NoFileOrAFolder) {
    const Scratch scratch;
    for (const std::string& path : {scratch.path("none.json"), scratch.folder()}) {
        const Ended r = run({"replay", path});
        EXPECT_EQ(r.code, 2);
        EXPECT_EQ(r.out, "");
        EXPECT_EQ(r.err.rfind("error: " + path + ": cannot read the witnesses", 0), 0U) << r.err;
    }
}

TEST(WitnessInput, APipeWithoutAWriterIsToldAndNotWaitedFor) {
    const Scratch scratch;
    const std::string path = scratch.path("w.json");
    ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
    const Ended r = run({"replay", path});
    EXPECT_EQ(r.code, 2);
    EXPECT_EQ(r.signal, 0);
    EXPECT_EQ(r.out, "");
    EXPECT_EQ(r.err.rfind("error: " + path +
                              ": cannot read the witnesses: expected data, found nothing: a pipe that nobody writes to",
                          0),
              0U)
        << r.err;
}

TEST(WitnessInput, APipeWithAWriterIsReadToItsEnd) {
    const Scratch scratch;
    const std::string path = scratch.put("w.json", file_of(good));
    const std::string expected = run({"replay", path}).out;
    EXPECT_FALSE(expected.empty());
    // As <(...) makes one: /dev/fd/N.
    const Ended r = run_shell("{ sleep 0.2; cat " + path + "; } | barycert replay /dev/stdin");
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.out, expected);
}

}  // namespace
}  // namespace barycert::cli_test
