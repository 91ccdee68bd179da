// Witnesses: written, shown, reproduced; and the commands printed under the table do what they say.

#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include "process.hpp"

namespace barycert::cli_test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// A line "KERNEL: REASON in FAMILY, case N (...)" under the table, and the command below it.
struct Printed {
    std::string kernel, reason, command;
};

std::vector<Printed> printed_commands(const std::string& table) {
    std::vector<Printed> all;
    const Words lines = lines_of(table);
    for (std::size_t i = 1; i < lines.size(); ++i) {
        if (lines[i].rfind("    barycert replay ", 0) != 0) continue;
        const std::string& head = lines[i - 1];
        const std::size_t colon = head.find(": "), in = head.find(" in ", colon);
        all.push_back({head.substr(0, colon), head.substr(colon + 2, in - colon - 2), lines[i].substr(4)});
    }
    return all;
}

/// Runs each command as a user would who copies it, and looks for the finding in the rows of the kernel, and for what
/// is wider than a terminal.
void expect_commands_work(const std::string& table, std::size_t at_least, const How& how) {
    const std::vector<Printed> commands = printed_commands(table);
    EXPECT_GE(commands.size(), at_least) << table;
    for (const Printed& p : commands) {
        const Ended r = run_shell(p.command, how);
        EXPECT_EQ(r.code, 0) << p.command << '\n' << r.err;
        EXPECT_EQ(r.err, "");
        const std::size_t row = r.out.find("> " + p.kernel + " ");
        ASSERT_NE(row, std::string::npos) << p.command << '\n' << r.out;
        // Region and errors, weights, findings.
        const Words lines = lines_of(r.out.substr(row));
        ASSERT_GE(lines.size(), 3U) << r.out;
        if (p.reason != "worst_weight_ulp") {
            EXPECT_TRUE(contains(lines[2], p.reason)) << p.command << '\n' << r.out;
        }
        for (const std::string& line : lines_of(r.out)) EXPECT_LE(line.size(), 100U) << p.command << '\n' << line;
    }
}

TEST(Replay, PrintedCommandsByWitnessFile) {
    const Scratch scratch;
    const How there{.folder = scratch.folder()};
    const Ended r =
        run({"audit", "--wide", "--count", "30", "--witnesses", "it's the worst.json", "--json", "r.json"}, there);
    ASSERT_EQ(r.code, 0) << r.err;
    expect_commands_work(r.out, 40, there);
    const Ended by_report =
        run({"audit", "--wide", "--count", "30", "--kernel", "triangle.*", "--json", "r.json"}, there);
    expect_commands_work(by_report.out, 10, there);
}

TEST(Replay, PrintedCommandsByFamilyAndCase) {
    const Ended built =
        run({"audit", "--wide", "--count", "30", "--seed", "77", "--kernel", "*.inverse", "--kernel", "segment.*"});
    expect_commands_work(built.out, 6, {});
    EXPECT_TRUE(contains(built.out, "--seed 77"));
    // Cases of barycert's own meshes, then of the user's, in a folder whose name wants quoting.
    expect_commands_work(run({"audit", "--wide", "--count", "60", "--family", "mesh.*.ulp"}).out, 40, {});
    const Scratch scratch;
    const How there{.folder = scratch.folder()};
    fs::create_directory(scratch.path("my $mesh"));
    for (const char* ending : {".node", ".ele"}) {
        const auto from = fs::path(mesh("bracket")).replace_extension(ending);
        fs::copy_file(from, scratch.path(std::string("my $mesh/it's") + ending));
    }
    const Ended own =
        run({"audit", "my $mesh/it's.node", mesh("plate"), "--count", "60", "--family", "mesh.*", "--wide"}, there);
    ASSERT_EQ(own.code, 0) << own.err;
    EXPECT_TRUE(contains(own.out, "--mesh 'my $mesh/it'\\''s.node' --mesh " + mesh("plate")));
    expect_commands_work(own.out, 40, there);
}

TEST(Replay, PrintedCommandsNameTheUsersKernelLibrary) {
    const Scratch scratch;
    const How there{.folder = scratch.folder()};
    const Words audit{"audit", "--wide", "--count", "10", "--kernel-library", BARYCERT_SWAPPED_KERNEL};
    expect_commands_work(run(audit, there).out, 1, there);
    Words with_file = audit;
    with_file.insert(with_file.end(), {"--witnesses", "w.json"});
    expect_commands_work(run(with_file, there).out, 1, there);
}

TEST(Replay, TheKernelInQuestionFirstAndTheOthersWithAll) {
    const Words case_of{"replay", "--kernel", "tetrahedron.kahan", "--family", "lattice.tenths", "--case", "360"};
    const std::string alone = run(case_of).out;
    EXPECT_TRUE(contains(alone, "= exact, correctly rounded"));
    EXPECT_TRUE(contains(alone, "> tetrahedron.kahan "));
    EXPECT_FALSE(contains(alone, "tetrahedron.cramer"));
    EXPECT_TRUE(contains(alone, " other kernels: --all"));
    Words with_all = case_of;
    with_all.emplace_back("--all");
    const std::string all = run(with_all).out;
    EXPECT_TRUE(contains(all, "tetrahedron.cramer"));
    EXPECT_FALSE(contains(all, "--all"));
    const Words lines = lines_of(all);
    const auto exact = std::find_if(lines.begin(), lines.end(), [](const auto& l) { return l.starts_with("= exact"); });
    ASSERT_NE(exact, lines.end());
    EXPECT_TRUE((exact + 2)->starts_with("> tetrahedron.kahan "));
    for (const std::string& line : lines) EXPECT_LE(line.size(), 100U) << line;
    // Without a kernel in question all are shown.
    EXPECT_TRUE(contains(run({"replay", "--family", "lattice.tenths", "--case", "360", "--simplex", "tetrahedron"}).out,
                         "tetrahedron.cramer"));
}

class Witnesses : public ::testing::Test {
protected:
    void SetUp() override {
        const Ended r = run({"audit", "--quiet", "--count", "50", "--kernel", "tetrahedron.inverse", "--kernel",
                             "triangle.inverse", "--witnesses", file_});
        ASSERT_EQ(r.code, 0) << r.err;
        all_ = parse(read_file(file_));
        ASSERT_GT(all_["witnesses"].size(), 4U);
    }
    /// Number of witnesses that `replay` shows, each headed "SIMPLEX, REASON of KERNEL".
    static std::size_t shown(const std::string& out, const std::string& part) {
        std::size_t n = 0;
        for (const std::string& line : lines_of(out)) {
            if (!line.empty() && line.front() != ' ' && contains(line, " of ") && contains(line, part)) ++n;
        }
        return n;
    }
    std::size_t with(const char* key, const std::string& value) const {
        std::size_t n = 0;
        for (const Json& w : all_["witnesses"]) n += w[key] == value ? 1U : 0U;
        return n;
    }
    Scratch scratch_;
    std::string file_ = scratch_.path("w.json");
    Json all_;
};

TEST_F(Witnesses, AllAreShownAndReproduced) {
    const Ended r = run({"replay", file_});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.err, "");
    EXPECT_EQ(shown(r.out, ""), all_["witnesses"].size());
    // Every coordinate of the file stands in the text to the last bit.
    for (const Json& w : all_["witnesses"]) {
        for (const Json& x : w["point"]) EXPECT_TRUE(contains(r.out, x.get<std::string>())) << x;
    }
}

TEST_F(Witnesses, Filters) {
    const std::size_t of_triangle = with("kernel", "triangle.inverse"), opposite = with("reason", "opposite_sign");
    ASSERT_GT(of_triangle, 0U);
    ASSERT_GT(opposite, 0U);
    const Ended by_kernel = run({"replay", file_, "--kernel", "triangle.*"});
    EXPECT_EQ(shown(by_kernel.out, ""), of_triangle);
    EXPECT_EQ(shown(by_kernel.out, "of triangle.inverse"), of_triangle);
    const Ended by_reason = run({"replay", file_, "--reason", "opp*"});
    EXPECT_EQ(shown(by_reason.out, "opposite_sign of"), opposite);
    EXPECT_EQ(shown(by_reason.out, ""), opposite);
    const Ended none = run({"replay", file_, "--kernel", "segment.*"});
    EXPECT_EQ(none.code, 2);
    EXPECT_EQ(none.out, "");
    EXPECT_TRUE(contains(none.err, file_ + ": no witness matches; leave out --kernel"));
}

TEST_F(Witnesses, ADoctoredOneIsNotReproduced) {
    for (const Json& whole : all_["witnesses"]) {
        // The unit simplex and a point of eighths: every formula gets the weights right to the last bit.
        Json doctored = whole;
        const bool flat = whole["simplex"] == "triangle";
        doctored["vertices"] =
            Json::parse(flat ? "[[0, 0], [1, 0], [0, 1]]" : "[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]");
        doctored["point"] = Json::parse(flat ? "[0.125, 0.25]" : "[0.125, 0.25, 0.5]");
        const std::string file =
            scratch_.put("d.json", Json{{"schema", 1}, {"witnesses", Json::array({whole, doctored})}}.dump());
        const Ended r = run({"replay", file});
        EXPECT_EQ(r.code, 1);
        EXPECT_EQ(shown(r.out, ""), 2U);
        EXPECT_EQ(lines_of(r.err).size(), 1U) << r.err;
        EXPECT_TRUE(contains(r.err, "not reproduced: " + whole["reason"].get<std::string>() + " of " +
                                        whole["kernel"].get<std::string>()))
            << r.err;
    }
}

TEST_F(Witnesses, WhatCannotBeCheckedDoesNotPass) {
    const auto with_member = [&](const char* key, const char* value) {
        Json w = all_["witnesses"][0];
        w[key] = value;
        return run({"replay", scratch_.put("x.json", Json{{"schema", 1}, {"witnesses", Json::array({w})}}.dump())});
    };
    const Ended kernel = with_member("kernel", "tetrahedron.gone");
    EXPECT_EQ(kernel.code, 1);
    EXPECT_TRUE(contains(kernel.err, "no kernel of that name here")) << kernel.err;
    const Ended reason = with_member("reason", "bad_mood");
    EXPECT_EQ(reason.code, 1);
    EXPECT_TRUE(contains(reason.err, "no class of finding has that name")) << reason.err;
    const Ended simplex = with_member("kernel", "segment.projection");
    EXPECT_EQ(simplex.code, 1);
    EXPECT_TRUE(contains(simplex.err, "the kernel is for another simplex")) << simplex.err;
}

}  // namespace
}  // namespace barycert::cli_test
