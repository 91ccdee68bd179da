// barycert sample: fields from files, and the choice among fields.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <gtest/gtest.h>

#include "process.hpp"
#include "sample_meshes.hpp"

namespace barycert::cli_test {
namespace {

/// An NPY file of version 1.
std::string npy(const std::string& descr, const std::string& shape, const std::string& data, bool fortran = false) {
    std::string text =
        "{'descr': '" + descr + "', 'fortran_order': " + (fortran ? "True" : "False") + ", 'shape': (" + shape + "), }";
    text.resize((10 + text.size() + 1 + 63) / 64 * 64 - 10, ' ');
    text.back() = '\n';
    return std::string("\x93NUMPY\1\0", 8) + static_cast<char>(text.size() % 256) +
           static_cast<char>(text.size() / 256) + text + data;
}

template <class T>
std::string bytes(const std::vector<T>& numbers, bool swap = false) {
    std::string out;
    for (const T x : numbers) {
        std::array<char, sizeof(T)> b{};
        std::memcpy(b.data(), &x, sizeof(T));
        if (swap) std::reverse(b.begin(), b.end());
        out.append(b.data(), b.size());
    }
    return out;
}

class Fields : public ::testing::Test {
protected:
    Ended sample(const Words& more) const {
        return run(plus({"sample", two, "--points", points, "--output", "-", "--quiet"}, more));
    }
    /// The columns of the only row.
    std::string row(const Words& more) const {
        const Ended r = sample(more);
        EXPECT_EQ(r.code, 0) << r.err;
        const Words lines = lines_of(r.out);
        return lines.size() == 2 ? lines[0].substr(18) + " " + lines[1].substr(25) : r.out;
    }

    Scratch scratch;
    std::string two = put_two_cells(scratch), points = scratch.put("p.csv", ".25 .25 .25\n");
};

TEST_F(Fields, OfTextFiles) {
    const std::string expected = ",v.0,v.1 ,2.25,-1";
    for (const std::string text :
         {"0 -1\n1 -1\n2 -1\n6 -1\n100 -1\n", "# velocity\n\n0,-1\n1,-1 # here\r\n 2;-1\n6\t-1\n100 , -1\n",
          "0x0p0 -1e0\n1. -1.0\n+2 -1\n6 -1\n1e2 -1\n"}) {
        EXPECT_EQ(row({"--field", "v=" + scratch.put("v.txt", text), "--fields", "v"}), expected) << text;
    }
    EXPECT_EQ(row({"--field", "c=" + scratch.put("c.txt", "5\n6 # here"), "--fields", "c"}), ",c ,5") << "an end";
    EXPECT_EQ(row({"--field", "c=" + scratch.put("c.txt", "5\n6\n"), "--fields", "c"}), ",c ,5")
        << "two rows: of cells";
    EXPECT_EQ(row({"--cell-field", "c=" + scratch.path("c.txt"), "--fields", "c"}), ",c ,5");
    EXPECT_EQ(row({"--point-field", "v=" + scratch.path("v.txt"), "--fields", "v"}), expected);
}

TEST_F(Fields, OfNpyFiles) {
    const std::vector<double> v{0, -1, 1, -1, 2, -1, 6, -1, 100, -1}, by_component{0, 1, 2, 6, 100, -1, -1, -1, -1, -1};
    const std::vector<float> single(v.begin(), v.end());
    const std::vector<std::int64_t> whole(v.begin(), v.end());
    const std::vector<std::int8_t> small(v.begin(), v.end());
    for (const std::string& file :
         {npy("<f8", "5, 2", bytes(v)), npy(">f8", "5, 2", bytes(v, true)), npy("<f4", "5, 2", bytes(single)),
          npy("<f8", "5, 2", bytes(by_component), true), npy("<i8", "5, 2", bytes(whole)),
          npy(">i8", "5, 2", bytes(whole, true)), npy("|i1", "5, 2", bytes(small))}) {
        EXPECT_EQ(row({"--field", "v=" + scratch.put("v.npy", file), "--fields", "v"}), ",v.0,v.1 ,2.25,-1") << file;
    }
    const std::vector<std::uint16_t> one{4, 8, 12, 16, 20};
    EXPECT_EQ(row({"--field", "u=" + scratch.put("u.npy", npy("<u2", "5,", bytes(one))), "--fields", "u"}), ",u ,10");
}

TEST_F(Fields, AreChosenAndOrderedByName) {
    const std::string v = "v=" + scratch.put("v.txt", "0 1\n0 1\n0 1\n0 1\n0 1\n"),
                      c = "c=" + scratch.put("c", "5\n6\n");
    EXPECT_EQ(row({}), ",attribute0,cell:attribute0 ,4.5,7");
    EXPECT_EQ(row({"--field", v, "--field", c}), ",attribute0,v.0,v.1,cell:attribute0,c ,4.5,0,1,7,5");
    EXPECT_EQ(row({"--field", v, "--field", c, "--fields", "c,v"}), ",v.0,v.1,c ,0,1,5") << "those of nodes first";
    EXPECT_EQ(row({"--field", v, "--fields", "v", "--fields", "attribute0"}), ",v.0,v.1,attribute0 ,0,1,4.5");
    EXPECT_EQ(row({"--fields", "cell:attribute0"}), ",cell:attribute0 ,7");
    EXPECT_EQ(row({"--fields", "point:attribute0"}), ",attribute0 ,4.5");
    // Names that rows have themselves, and one with a comma.
    EXPECT_EQ(row({"--field", "cell=" + scratch.path("v.txt"), "--fields", "cell"}), ",point:cell.0,point:cell.1 ,0,1");
    EXPECT_EQ(row({"--field", "a,b=" + scratch.path("c"), "--fields", "a,b"}), ",\"a,b\" ,5");
}

// Nodes 1 and 3 are in both cells, nodes 0 and 4 in one each.
TEST_F(Fields, OfNodesWithoutPartMayBeNotFinite) {
    const std::vector<double> u{std::nan(""), 3, HUGE_VAL, 4, -HUGE_VAL};
    const std::string file = scratch.put("u.npy", npy("<f8", "5,", bytes(u)));
    const std::string at = scratch.put("at.csv", "x,y,z\n1,0,0\n.5,0,.5\n.25,.25,.5\n");
    const Words command{"sample", two, "--points", at, "--field", "u=" + file, "--fields", "u", "--output"};
    for (const std::string rounding : {"correct", "plain"}) {
        const Ended all = run(plus(command, {"-", "--on-boundary", "all", "--rounding", rounding}));
        EXPECT_EQ(all.code, 0) << all.err;
        EXPECT_EQ(all.out,
                  "x,y,z,cell,feature,u\n1,0,0,0,vertex,3\n1,0,0,1,vertex,3\n0.5,0,0.5,0,edge,3.5\n"
                  "0.5,0,0.5,1,edge,3.5\n0.25,0.25,0.5,0,face,nan\n0.25,0.25,0.5,1,face,nan\n");
        EXPECT_TRUE(contains(all.err, "\nnote       field u: 3 of 5 values are not finite\n")) << all.err;
    }
    const Ended told = run(plus(command, {scratch.path("rows.csv"), "--json", "-"}));
    EXPECT_EQ(parse(told.out)["not_finite"], parse(R"([{"field": "u", "of": "nodes", "count": 3, "values": 5}])"));
    // Nothing is said of a field that is not sampled.
    const Ended other = run({"sample", two, "--points", at, "--field", "u=" + file, "--fields", "point:attribute0",
                             "--output", scratch.path("rows.csv"), "--json", "-"});
    EXPECT_TRUE(parse(other.out)["not_finite"].empty()) << other.out;
    const Ended lines = run({"resample", two, "--grid", "3x3x3", "--field", "u=" + file, "--fields", "u", "--output",
                             scratch.path("u.vti")});
    EXPECT_TRUE(contains(lines.out + lines.err, "field u: 3 of 5 values are not finite")) << lines.err;
}

TEST_F(Fields, ThatCannotBeAreRefused) {
    const std::string v = scratch.put("v.txt", "0\n1\n2\n3\n4\n");
    const auto refused = [&](const Words& more, const std::string& says) {
        expect_error(plus({"sample", two, "--points", points, "--output", "-", "--quiet"}, more), says);
    };
    const auto bad_text = [&](const std::string& text, const std::string& says) {
        refused({"--field", "t=" + scratch.put("bad", text)}, "error: " + scratch.path("bad") + says);
    };
    bad_text("0\n1\n2\nthree\n4\n", ":4: a row of field \"t\": expected numbers, found \"three\"");
    bad_text("0\n1\n2\n3,\n4\n", ":4: a row of field \"t\": expected numbers, found \"\"");
    bad_text("0\n1\n,2\n3\n4\n", ":3: a row of field \"t\": expected numbers, found \"\"");
    bad_text("0\n1\n2 2\n3\n4\n", ":3: a row of field \"t\": expected 1 numbers, as in the first row, found 2");
    bad_text("0\n1\n2\n", ": field \"t\": expected 5 rows, one for each node, or 2, one for each cell, found 3 rows");
    bad_text("0\n1\n2\n3\n0.2", ":5: the last row has no line end, so the file may be cut short: expected a line end");
    bad_text("0 0\n1 1\n2 2\n3 3\n4 0.2", ":5: the last row has no line end");
    bad_text("", ": field \"t\": expected 5 rows, one for each node, or 2, one for each cell, found 0 rows");
    refused({"--cell-field", "t=" + v}, "expected 2 rows, one for each cell, found 5 rows");
    refused({"--point-field", "t=" + scratch.put("c", "1\n2\n")}, "expected 5 rows, one for each node, found 2 rows");
    refused({"--field", "attribute0=" + v}, "a field of this name exists already: found \"attribute0\"");
    refused({"--field", "t=" + scratch.path("none")}, "error: " + scratch.path("none") + ": cannot read the file");
    refused({"--field", "t=b=" + v}, "error: b=" + v + ": cannot read the file");
    refused({"--field", "t"}, "--field");
    refused({"--field", "=x"}, "--field");
    refused({"--field", "t="}, "--field");
    refused({"--field", ""}, "--field");
    refused({"--fields", "attribute0,zzz"},
            "no field of that name: found \"zzz\"; there are attribute0, and of cells cell:attribute0");
    refused({"--fields", ""}, "no field of that name: found \"\"");
    refused({"--fields", "attribute0,attribute0"}, "a field is chosen twice: found \"attribute0\"");
    const auto bad_npy = [&](const std::string& file, const std::string& says) {
        refused({"--field", "t=" + scratch.put("t.npy", file)}, says);
    };
    bad_npy("no array", "t.npy");
    bad_npy(npy("<c16", "5,", std::string(80, '\0')), "the type of field \"t\": expected floats");
    bad_npy(npy("<f8", "5, 1, 1", std::string(40, '\0')), "the shape of field \"t\"");
    bad_npy(npy("<f8", "5,", std::string(39, '\0')), "expected 5 rows of 8 bytes, as its header tells, found 39 bytes");
    bad_npy(npy("<f8", "5,", std::string(41, '\0')), "expected 40, as the header tells, found 41");
    bad_npy(npy("<f8", "2305843009213693957,", std::string(40, '\0')), "as its header tells, found 40 bytes");
    bad_npy(npy("<i8", "5,", bytes(std::vector<std::int64_t>{1, 2, (1LL << 53) + 1, 3, 4})),
            "row 2 of field \"t\": expected an integer that a double holds exactly");
    // As many nodes as cells: it has to be said.
    scratch.put("even.node", "4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n");
    scratch.put("even.ele", "4 4 0\n0 0 1 2 3\n1 0 1 2 3\n2 0 1 2 3\n3 0 1 2 3\n");
    const std::string four = "t=" + scratch.put("four", "1\n1\n1\n1\n");
    const Words even{"sample", scratch.path("even"), "--points", points, "--output", "-", "--quiet"};
    expect_error(plus(even, {"--field", four}), "rows of field \"t\" could belong to nodes or to cells");
    for (const std::string option : {"--point-field", "--cell-field"})
        EXPECT_EQ(run(plus(even, {option, four})).out, "x,y,z,cell,feature,t\n0.25,0.25,0.25,0,interior,1\n");
}

}  // namespace
}  // namespace barycert::cli_test
