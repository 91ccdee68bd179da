// The cases that an audit covers; the same seed finds the same.

#include <algorithm>
#include <filesystem>
#include <set>

#include <gtest/gtest.h>

#include "process.hpp"

namespace barycert::cli_test {
namespace {

using Json = nlohmann::json;

Json report_of(Words arguments) {
    arguments.insert(arguments.begin(), "audit");
    arguments.insert(arguments.end(), {"--json", "-"});
    const Ended r = run(arguments);
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.err, "");
    return parse(r.out);
}

std::set<std::string> names(const Json& list) {
    std::set<std::string> names;
    for (const Json& entry : list) names.insert(entry["name"].get<std::string>());
    return names;
}

/// The report's lines without those that tell of time and threads.
std::string timeless(const std::string& text) {
    std::string kept;
    for (const std::string& line : lines_of(text)) {
        const bool of_time =
            contains(line, "\"ns\":") || contains(line, "\"seconds\":") || contains(line, "\"threads\":");
        if (!of_time) kept += line + '\n';
    }
    return kept;
}

TEST(Audit, EveryKernelMeetsEveryFamilyThatApplies) {
    const Json report = report_of({"--count", "20"});
    EXPECT_EQ(report["count"], 20);
    EXPECT_EQ(report["seed"], 1);
    EXPECT_EQ(names(report["kernels"]), names(parse(run({"kernels", "--json", "-"}).out)["kernels"]));
    EXPECT_EQ(names(report["families"]), names(parse(run({"families", "--json", "-"}).out)["families"]));
    for (const Json& kernel : report["kernels"]) {
        std::set<std::string> expected;
        for (const Json& family : report["families"]) {
            const auto& simplices = family["simplices"];
            if (family["perspective"] == kernel["perspective"] &&
                std::find(simplices.begin(), simplices.end(), kernel["simplex"]) != simplices.end())
                expected.insert(family["name"].get<std::string>());
        }
        EXPECT_EQ(names(kernel["families"]), expected) << kernel["name"];
        EXPECT_EQ(kernel["cases"], 20 * expected.size());
        for (const Json& part : kernel["families"]) EXPECT_EQ(part["cases"], 20);
    }
}

TEST(Audit, TellsWhetherMeshesArePartitions) {
    const Scratch scratch;
    // Two triangles, one over the other.
    const std::string folded = scratch.put("folded.node", "4 2 0 0\n1 0 0\n2 1 0\n3 0 1\n4 0.2 0.3\n");
    scratch.put("folded.ele", "2 3 0\n1 1 2 3\n2 1 2 4\n");
    const std::vector<std::string> some{"--family", "mesh.inside", "--count", "20"};
    const auto verdicts = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.end(), some.begin(), some.end());
        return report_of(arguments)["verdicts"];
    };
    EXPECT_EQ(verdicts({folded, mesh("plate")}), Json::array({"not certified", "certified"}));
    EXPECT_EQ(verdicts({mesh("plate"), "--no-check"}), Json::array({"not checked"}));
    const auto text = run({"audit", folded, mesh("plate"), "--family", "mesh.inside", "--count", "20", "--wide"}).out;
    EXPECT_NE(text.find("meshes, certified to be partitions: " + mesh("plate")), std::string::npos) << text;
    EXPECT_NE(text.find("meshes, NOT certified to be partitions: " + folded), std::string::npos) << text;
}

TEST(Audit, AMeshOfTheUsersTakesThePlaceOfTheOwn) {
    const Json plate = report_of({mesh("plate"), "--family", "mesh.inside", "--count", "20"});
    EXPECT_EQ(plate["meshes"], Json::array({mesh("plate")}));
    for (const Json& kernel : plate["kernels"]) EXPECT_EQ(kernel["simplex"], "triangle");
    const Json both = report_of({mesh("plate"), mesh("bracket"), "--family", "mesh.inside", "--count", "20"});
    EXPECT_EQ(both["meshes"].size(), 2U);
    std::set<std::string> simplices;
    for (const Json& kernel : both["kernels"]) simplices.insert(kernel["simplex"].get<std::string>());
    EXPECT_EQ(simplices.size(), 4U);
    // The stem or the .ele names the same mesh.
    const std::string stem = mesh("plate").substr(0, mesh("plate").size() - 5);
    EXPECT_EQ(report_of({stem + ".ele", "--family", "mesh.inside", "--count", "20"})["kernels"].size(),
              plate["kernels"].size());
}

TEST(Audit, GlobsSelectAndEachNameCountsOnce) {
    const Json report = report_of({"--kernel", "segment.*", "--kernel", "triangle.inverse", "--kernel", "seg*.proj*",
                                   "--family", "huge", "--family", "mesh.in?ide", "--count", "10"});
    EXPECT_EQ(names(report["families"]), (std::set<std::string>{"huge", "mesh.inside"}));
    std::set<std::string> expected = names(parse(run({"kernels", "segment.*", "--json", "-"}).out)["kernels"]);
    expected.insert("triangle.inverse");
    EXPECT_EQ(names(report["kernels"]), expected);
    EXPECT_EQ(report["kernels"].size(), expected.size());
}

TEST(Audit, AfterAnOptionThatRepeatsAWordIsAMesh) {
    const Ended r = run({"audit", "--kernel", "triangle.inverse", "--fail-on", "false_certificate", mesh("plate"),
                         "--count", "10", "--json", "-"});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(parse(r.out)["meshes"], Json::array({mesh("plate")}));
}

TEST(Audit, TheSameSeedGivesTheSameBytesOnAnyNumberOfThreads) {
    const auto with = [](const Words& more) {
        Words arguments{"audit", "--count", "600", "--kernel", "t*.inverse", "--kernel", "segment.*", "--json", "-"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments).out;
    };
    const std::string one = with({"--threads", "1"});
    EXPECT_GT(one.size(), 10000U);
    EXPECT_EQ(timeless(one), timeless(with({"--threads", "1"})));
    EXPECT_EQ(timeless(one), timeless(with({"--threads", "2"})));
    EXPECT_EQ(timeless(one), timeless(with({"--threads", "2", "--seed", "1"})));
    EXPECT_NE(timeless(one), timeless(with({"--threads", "1", "--seed", "2"})));
    const std::string max = with({"--seed", "18446744073709551615"});
    EXPECT_EQ(parse(max)["seed"], 18446744073709551615U);
}

TEST(Audit, TheTableIsTheReport) {
    const Scratch scratch;
    const Ended r =
        run({"audit", "--wide", "--count", "20", "--kernel", "triangle.*", "--json", scratch.path("r.json")});
    EXPECT_EQ(r.code, 0);
    EXPECT_EQ(r.err, "");
    const Json report = parse(read_file(scratch.path("r.json")));
    // Kernels stand in the table in the report's order, worst first; the first column of digits is the cases.
    std::size_t at = 0;
    for (const Json& kernel : report["kernels"]) {
        const std::string row = "\n" + kernel["name"].get<std::string>() + " ";
        const std::size_t found = r.out.find(row, at);
        ASSERT_NE(found, std::string::npos) << row;
        at = found;
        EXPECT_TRUE(contains(r.out.substr(at, 120), std::to_string(kernel["cases"].get<int>())));
    }
    EXPECT_TRUE(contains(r.out, "seed 1, 20 cases per family and simplex"));
}

TEST(Audit, APageThatSaysHowItWasMade) {
    const Scratch scratch;
    const How there{.environment = {"BARYCERT_COMMAND"}, .folder = scratch.folder()};
    const Ended r = run({"audit", "--quiet", "--count", "10", "--kernel", "segment.*", "--html", "it's.html"}, there);
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.out + r.err, "");
    const std::string page = read_file(scratch.path("it's.html"));
    EXPECT_TRUE(page.starts_with("<!DOCTYPE html>\n") && page.ends_with("</body></html>\n"));
    EXPECT_TRUE(contains(page, "barycert audit --quiet --count 10 --kernel 'segment.*' --html 'it'\\''s.html'</code>"));
    const Ended out = run({"audit", "--count", "10", "--kernel", "segment.*", "--html", "-"}, there);
    EXPECT_TRUE(out.out.starts_with("<!DOCTYPE html>\n") && out.out.ends_with("</body></html>\n"));
    EXPECT_EQ(run({"audit", "--html", "-", "--json", "-"}, there).code, 2);
}

TEST(Audit, APageWithWhatOthersMeasured) {
    const Scratch scratch;
    const std::string measured = std::string(BARYCERT_DATA_DIR) + "/measured/", page = scratch.path("page");
    const Words audit{"audit", "--quiet", "--count", "10", "--kernel", "segment.*"};
    const auto with = [&](Words more) {
        more.insert(more.begin(), audit.begin(), audit.end());
        return run(more);
    };
    const Ended r = with({"--html", page, "--with", measured + "flags.json", "--with", measured + "systems.json"});
    EXPECT_EQ(r.code, 0) << r.err;
    const std::string text = read_file(page);
    EXPECT_TRUE(contains(text, "<h2>Formulas under compiler flags</h2>"));
    EXPECT_TRUE(contains(text, "<h2>Systems: point location and interpolation</h2>"));
    // Refused before the work, with nothing written.
    const std::string other = scratch.path("other"), cut = scratch.put("cut.json", "{\"command\": \"flags\", ");
    const Ended bad = with({"--html", other, "--with", cut});
    EXPECT_EQ(bad.code, 2);
    EXPECT_TRUE(contains(bad.err, cut + ": neither a flags matrix nor a league of systems: expected JSON")) << bad.err;
    EXPECT_FALSE(std::filesystem::exists(other));
    EXPECT_EQ(with({"--html", other, "--with", scratch.path("none")}).code, 2);
    const Ended alone = with({"--with", measured + "flags.json"});
    EXPECT_EQ(alone.code, 2);
    EXPECT_TRUE(contains(alone.err, "--with needs --html")) << alone.err;
    const std::string same = scratch.put("same.json", read_file(measured + "flags.json"));
    EXPECT_EQ(with({"--html", same, "--with", same}).code, 2) << "the page would replace its input";
    EXPECT_EQ(read_file(same), read_file(measured + "flags.json"));
}

TEST(Audit, QuietSaysNothingAndWritesAll) {
    const Scratch scratch;
    const Ended r = run({"audit", "--quiet", "--count", "10", "--kernel", "segment.*", "--json", scratch.path("r"),
                         "--witnesses", scratch.path("w")});
    EXPECT_EQ(r.code, 0);
    EXPECT_EQ(r.out + r.err, "");
    const Json report = parse(read_file(scratch.path("r"))), witnesses = parse(read_file(scratch.path("w")));
    EXPECT_FALSE(report["witnesses"].empty());
    EXPECT_EQ(report["witnesses"], witnesses["witnesses"]);
    const Ended pure = run({"audit", "--count", "10", "--kernel", "segment.*", "--witnesses", "-"});
    EXPECT_EQ(parse(pure.out), witnesses);
}

}  // namespace
}  // namespace barycert::cli_test
