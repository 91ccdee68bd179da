// A process that starts in another floating-point environment writes the same bytes as one that does not.
#include <gtest/gtest.h>

#include <regex>

#include "process.hpp"
#include "sample_meshes.hpp"

#ifdef BARYCERT_OTHER_ENVIRONMENT
namespace barycert::cli_test {
namespace {

/// To nearest flushing results, operands, both; the other modes; one of them flushing too. `n0`: none of it.
const Words environments{"n8000", "n0040", "n8040", "u0", "d0", "z0", "d8040"};

How started_in(const std::string& environment) {
    return {.environment = {"LD_PRELOAD=" BARYCERT_OTHER_ENVIRONMENT, "OTHER_ENVIRONMENT=" + environment}};
}

/// Without what two runs of the same differ in.
std::string without_times(std::string text) {
    static const std::regex times[] = {std::regex(R"x(time   .*)x"),
                                       std::regex(R"x("(seconds|ns)": (\{[^}]*\}|[-+.e0-9]+))x"),
                                       std::regex(R"x([0-9.]+(e[-+]?[0-9]+)? (s|ms|us|ns)\b)x")};
    for (const std::regex& time : times) text = std::regex_replace(text, time, "TIME");
    return text;
}

struct Outcome {
    int code = -1;
    std::string out, err, file;
    friend bool operator==(const Outcome&, const Outcome&) = default;
};

Outcome outcome(const Words& arguments, const std::string& environment, const std::string& file) {
    const Ended r = run(arguments, started_in(environment));
    EXPECT_EQ(r.signal, 0);
    return {r.code, without_times(r.out), without_times(r.err), file.empty() ? "" : without_times(read_file(file))};
}

/// `arguments` write to `file`, if there is one.
void expect_same_bytes(const Words& arguments, int code, const std::string& file = {}) {
    const Outcome right = outcome(arguments, "n0", file);
    EXPECT_EQ(right.code, code) << right.err;
    for (const std::string& e : environments) {
        const Outcome got = outcome(arguments, e, file);
        EXPECT_TRUE(got == right) << ::testing::PrintToString(arguments) << " in " << e << ": code " << got.code << ", "
                                  << got.err << (got.out == right.out ? "" : "; another stdout")
                                  << (got.file == right.file ? "" : "; another file");
    }
}

/// The two cells and their values, all subnormal.
std::string put_smallest_cells(const Scratch& scratch) {
    scratch.put("tiny.node",
                "5 3 1 0\n0 0 0 0 5e-324\n1 4e-323 0 0 1.5e-323\n2 0 4e-323 0 -2.5e-323\n3 0 0 4e-323 4.4e-323\n"
                "4 4e-323 4e-323 4e-323 0.1\n");
    scratch.put("tiny.ele", "2 4 1\n0 0 1 2 3 7e-320\n1 1 2 3 4 9\n");
    return scratch.path("tiny");
}

const std::string min_points =
    "x,y,z\n1e-323,1e-323,1e-323\n2e-323,2e-323,2e-323\n4e-323,0,0\n5e-324,5e-324,0\n"
    "9e-323,9e-323,9e-323\n0.1,0.2,0.3\n";

TEST(Environment, OfCheck) {
    const Scratch scratch;
    const std::string tiny = put_smallest_cells(scratch);
    expect_same_bytes({"check", tiny}, 0);
    expect_same_bytes({"check", tiny, "--json", "-", "--delaunay"}, 0);
    for (const std::string name : {"plate", "bracket"}) expect_same_bytes({"check", mesh(name), "--json", "-"}, 0);
    // Two cells that overlap: a witness in fractions, and whether its doubles are exact.
    scratch.put("over.node", "5 3 0 0\n0 0 0 0\n1 4e-323 0 0\n2 0 4e-323 0\n3 0 0 4e-323\n4 5e-324 5e-324 1e-323\n");
    scratch.put("over.ele", "2 4 0\n0 0 1 2 3\n1 0 1 2 4\n");
    expect_same_bytes({"check", scratch.path("over"), "--json", "-"}, 1);
    expect_same_bytes({"check", scratch.path("over"), "--html", scratch.path("over.html")}, 1,
                      scratch.path("over.html"));
}

TEST(Environment, OfSample) {
    const Scratch scratch;
    const std::string tiny = put_smallest_cells(scratch), points = scratch.put("p.csv", min_points);
    for (const std::string rounding : {"correct", "plain"}) {
        for (const std::string outside : {"nan", "nearest", "fill=4.9e-324"}) {
            expect_same_bytes({"sample", tiny, "--points", points, "--rounding", rounding, "--outside", outside,
                               "--output", "-", "--quiet"},
                              0);
        }
        expect_same_bytes({"sample", mesh("bracket"), "--points", points, "--rounding", rounding, "--outside",
                           "nearest", "--output", scratch.path("r.npy"), "--json", "-"},
                          0, scratch.path("r.npy"));
    }
    // Cells of ordinary size: plain arithmetic keeps subnormal values where the process was started to flush them.
    scratch.put("values.node", "4 3 1 0\n0 0 0 0 5e-324\n1 1 0 0 1.5e-323\n2 0 1 0 -2.5e-323\n3 0 0 1 4.4e-323\n");
    scratch.put("values.ele", "1 4 1\n0 0 1 2 3 7e-320\n");
    const std::string corner = scratch.put("c.csv", "x,y,z\n1,0,0\n");
    const Ended plain =
        run({"sample", scratch.path("values"), "--points", corner, "--rounding", "plain", "--output", "-", "--quiet"},
            started_in("n8040"));
    EXPECT_TRUE(contains(plain.out, "\n1,0,0,0,vertex,1.5e-323,7e-320\n")) << plain.out;
}

TEST(Environment, OfResample) {
    const Scratch scratch;
    const std::string tiny = put_smallest_cells(scratch);
    for (const std::string rounding : {"correct", "plain"}) {
        expect_same_bytes({"resample", tiny, "--grid", "9x9x5", "--rounding", rounding, "--output", "-", "--quiet"}, 0);
        expect_same_bytes({"resample", mesh("plate"), "--grid", "40x30", "--rounding", rounding, "--outside", "nearest",
                           "--output", scratch.path("g.vti")},
                          0, scratch.path("g.vti"));
        expect_same_bytes(
            {"resample", mesh("plate"), "--spacing", "0.1", "--rounding", rounding, "--output", scratch.path("g.csv")},
            0, scratch.path("g.csv"));
    }
}

TEST(Environment, OfAuditAndReplay) {
    const Scratch scratch;
    const std::string witnesses = scratch.path("w.json");
    expect_same_bytes(
        {"audit", "--count", "100", "--json", "-", "--witnesses", witnesses, mesh("plate"), mesh("cube-hole")}, 0,
        witnesses);
    expect_same_bytes({"replay", witnesses}, 0);
}

}  // namespace
}  // namespace barycert::cli_test
#endif
