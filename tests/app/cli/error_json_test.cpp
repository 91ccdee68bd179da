// A command that fails writes the error as JSON where its report would have gone, and destroys nothing by it.

#include <filesystem>

#include <gtest/gtest.h>

#include "process.hpp"

namespace barycert::cli_test {
namespace {

using Json = nlohmann::json;

TEST(ErrorJson, StandsOnStdoutInPlaceOfTheReport) {
    const Ended r = run({"check", "no-such-mesh.vtu", "--json", "-"});
    EXPECT_EQ(r.code, 2);
    const Json failure = parse(r.out);
    EXPECT_EQ(failure["schema"], 1);
    EXPECT_EQ(failure["error"]["code"], "file.missing");
    EXPECT_EQ(failure["error"]["file"], "no-such-mesh.vtu");
    EXPECT_EQ(r.err, "error: " + failure["error"]["message"].get<std::string>() + "\n");
}

TEST(ErrorJson, NamesFileAndLine) {
    const Scratch scratch;
    const std::string points = scratch.put("p.csv", "x,y,z\n0.1,0.2,0.3\n0.1,oops,0.3\n");
    const std::string report = scratch.path("r.json");
    const Ended r =
        run({"sample", mesh("bracket"), "--points", points, "--output", scratch.path("o.csv"), "--json", report});
    EXPECT_EQ(r.code, 2);
    const Json error = parse(read_file(report))["error"];
    EXPECT_EQ(error["code"], "file.number");
    EXPECT_EQ(error["file"], points);
    EXPECT_EQ(error["line"], 3);
    EXPECT_EQ(error["found"], "\"oops\"");
    EXPECT_FALSE(std::filesystem::exists(scratch.path("o.csv")));
}

TEST(ErrorJson, NamesTheMemberAndItsOption) {
    const Ended r = run({"sample", mesh("bracket"), "--output", "o.csv", "--json", "-"});
    EXPECT_EQ(r.code, 2);
    const Json error = parse(r.out)["error"];
    EXPECT_EQ(error["code"], "option.missing");
    EXPECT_EQ(error["subject"], "job.points");
    EXPECT_EQ(error["option"], "--points");
    EXPECT_TRUE(contains(error["expected"], "--points FILE")) << error;
    EXPECT_FALSE(contains(r.err, "job.")) << r.err;
}

/// A name that looks like a member of a job stays as it is: the error is about no member.
TEST(ErrorJson, FilesKeepTheirNames) {
    const Ended r = run({"check", "my job.points.vtu", "--json", "-"});
    EXPECT_EQ(r.code, 2);
    EXPECT_TRUE(contains(r.err, "my job.points.vtu")) << r.err;
    EXPECT_EQ(parse(r.out)["error"]["subject"], "");
}

TEST(ErrorJson, DestroysNothing) {
    const Scratch scratch;
    const std::string notes = scratch.put("notes.txt", "mine");
    EXPECT_EQ(run({"check", "no-such-mesh.vtu", "--json", notes}).code, 2);
    EXPECT_EQ(read_file(notes), "mine");
    // An input, although it is JSON, and although the run ends before it is read.
    const std::string other = scratch.put("a.vtu", "{}");
    EXPECT_EQ(run({"check", other, "--json", other, "--fix", scratch.path("x.none")}).code, 2);
    EXPECT_EQ(read_file(other), "{}");
    EXPECT_EQ(run({"check", other, "--json=" + other}).code, 2);
    EXPECT_EQ(read_file(other), "{}");
    // A report of an earlier run is out of date.
    const std::string old = scratch.put("old.json", "{\"schema\": 1}");
    EXPECT_EQ(run({"check", "no-such-mesh.vtu", "--json", old}).code, 2);
    EXPECT_EQ(parse(read_file(old))["error"]["code"], "file.missing");
}

TEST(ErrorJson, LeavesAReportThatIsThere) {
    const Scratch scratch;
    const std::string report = scratch.path("r.json");
    const Ended r = run({"check", mesh("bracket"), "--json", report, "--html", "/dev/full"});
    EXPECT_EQ(r.code, 2) << r.err;
    EXPECT_TRUE(parse(read_file(report)).contains("verdict"));
}

TEST(ErrorJson, IsNotWrittenUnlessAsked) {
    const Ended r = run({"check", "no-such-mesh.vtu"});
    EXPECT_EQ(r.code, 2);
    EXPECT_EQ(r.out, "");
}

}  // namespace
}  // namespace barycert::cli_test
