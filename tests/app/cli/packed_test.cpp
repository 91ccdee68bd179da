// Files packed by gzip.

#include <gtest/gtest.h>

#include <filesystem>

#include "process.hpp"
#include "sample_meshes.hpp"

namespace barycert::cli_test {
namespace {

/// The mesh of put_two_cells and its points in the formats of meshes, points and fields.
class Packed : public ::testing::Test {
protected:
    void SetUp() override {
        put_two_cells(scratch_, "m");
        scratch_.put("p.csv", six_points);
        scratch_.put("T.txt", "1\n3\n5\n9\n15\n");
        shell(
            "for f in m.vtu m.vtk m.msh; do barycert resample m --onto m --output $f --quiet; done; "
            "barycert sample m --points p.csv --output p.npy --quiet; barycert sample m --points p.csv --output p.vtu "
            "--quiet");
        expected_ = rows("m", "--points p.csv");
        EXPECT_EQ(lines_of(expected_).size(), 7U);
    }
    Ended shell(const std::string& line) const { return run_shell(line, {.folder = scratch_.folder()}); }
    std::string rows(const std::string& mesh, const std::string& more) const {
        const Ended r = shell("barycert sample " + mesh + " --output - --quiet --fields attribute0 " + more);
        EXPECT_EQ(r.code, 0) << mesh << ' ' << more << '\n' << r.err;
        return r.out;
    }
    Scratch scratch_;
    std::string expected_;
};

TEST_F(Packed, Meshes) {
    shell("gzip -k m.vtu m.vtk m.msh; mkdir t; cp m.node m.ele t; gzip t/m.node t/m.ele");
    for (const char* mesh : {"m.vtu.gz", "m.vtk.gz", "m.msh.gz", "t/m", "t/m.node.gz", "t/m.node", "t/m.ele.gz"}) {
        const std::string got = rows(mesh, "--points p.csv");
        EXPECT_EQ(got, expected_) << mesh;
    }
    // By what it is, whatever its name.
    shell("cp m.vtu.gz odd.vtu");
    EXPECT_EQ(rows("odd.vtu", "--points p.csv"), expected_);
}

TEST_F(Packed, PointsAndFields) {
    shell("gzip -k p.csv p.npy p.vtu T.txt m.node");
    for (const char* points : {"p.csv.gz", "p.npy.gz", "p.vtu.gz"})
        EXPECT_EQ(rows("m", std::string("--points ") + points), expected_) << points;
    EXPECT_EQ(rows("m", "--points m.node.gz"), rows("m", "--points m.node"));
    for (const char* field : {"T.txt", "m.vtu:attribute0", "p.csv:x"}) {
        const std::string file(field), name = file.substr(0, file.find(':')), rest = file.substr(name.size());
        if (name == "m.vtu") shell("gzip -k m.vtu");
        if (name == "p.csv") shell("head -n 6 p.csv > p5.csv; gzip -k p5.csv");
        const std::string plain = name == "p.csv" ? "p5.csv" : name;
        const auto with = [&](const std::string& path) {
            return shell("barycert sample m --points p.csv --output - --quiet --point-field U=" + path + rest);
        };
        const Ended packed = with(plain + ".gz"), unpacked = with(plain);
        EXPECT_EQ(packed.code, 0) << packed.err;
        EXPECT_EQ(packed.out, unpacked.out) << field;
    }
}

TEST_F(Packed, SeveralMembersAreOneFile) {
    shell("head -n 3 p.csv | gzip > q.csv.gz; tail -n +4 p.csv | gzip >> q.csv.gz");
    EXPECT_EQ(rows("m", "--points q.csv.gz"), expected_);
}

TEST_F(Packed, StandardInput) {
    shell("gzip -k p.csv; head -c 40 p.csv.gz > cut.gz");
    EXPECT_EQ(rows("m", "--points - < p.csv.gz"), expected_);
    const Ended cut = shell("barycert sample m --points - --output - < cut.gz"),
                stream = shell("cat p.csv.gz | barycert sample m --points - --output -");
    EXPECT_EQ(cut.code, 2);
    EXPECT_NE(cut.err.find("cannot be unpacked"), std::string::npos) << cut.err;
    EXPECT_EQ(stream.code, 2);
    EXPECT_NE(stream.err.find("gunzip"), std::string::npos) << stream.err;
    shell("gzip < p.csv.gz > p.csv.gz.gz; printf '\\3757zXZ\\000' > p.xz");
    for (const char* packed : {"p.csv.gz.gz", "p.xz"}) {
        const Ended refused = shell(std::string("barycert sample m --points - --output - < ") + packed);
        EXPECT_EQ(refused.code, 2) << packed;
        EXPECT_TRUE(contains(refused.err, "unpack it first: gunzip, xz -dc")) << refused.err;
    }
}

/// A solution is told whether the mesh beside it is packed or not.
TEST_F(Packed, TheFileBesideTheMesh) {
    scratch_.put("t.mesh",
                 "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
                 "Tetrahedra\n1\n1 2 3 4 0\nEnd\n");
    scratch_.put("t.sol", "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n4\n1 1\n1\n2\n3\n4\nEnd\n");
    shell("gzip -k t.mesh");
    for (const char* mesh : {"t.mesh", "t.mesh.gz"}) {
        const Ended check = shell(std::string("barycert check ") + mesh);
        EXPECT_EQ(check.code, 0) << check.err;
        EXPECT_TRUE(contains(check.out + check.err, "t.sol, unless it is named")) << check.out << check.err;
    }
}

/// The nodes of a PLC in a file of their own, packed or not.
TEST_F(Packed, PlcAndItsNodes) {
    shell(
        "printf '4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n' > q.node; "
        "printf '0 3 0 0\n4 0\n1\n3 0 2 1\n1\n3 0 1 3\n1\n3 1 2 3\n1\n3 2 0 3\n0\n0\n' > q.poly; gzip -k q.poly");
    for (const char* packs : {"rm q.poly", "gzip q.node"}) {
        const Ended mesh = shell(std::string(packs) + "; barycert mesh q.poly.gz --output q1 && barycert check q1");
        EXPECT_EQ(mesh.code, 0) << mesh.err;
    }
}

TEST_F(Packed, Surfaces) {
    shell("printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n' | gzip > s.off.gz");
    const Ended mesh = shell("barycert mesh s.off.gz --output s && barycert check s");
    EXPECT_EQ(mesh.code, 0) << mesh.err;
}

TEST_F(Packed, DamagedAndCutFiles) {
    shell(
        "gzip -k m.vtu; head -c -20 m.vtu.gz > cut.vtu.gz; head -c 2 m.vtu.gz > short.vtu.gz; cp m.vtu.gz bad.vtu.gz; "
        "printf X | dd of=bad.vtu.gz bs=1 seek=60 conv=notrunc; cat m.vtu.gz p.csv > tail.vtu.gz");
    for (const char* name : {"cut.vtu.gz", "short.vtu.gz", "bad.vtu.gz", "tail.vtu.gz"}) {
        const Ended check = shell(std::string("barycert check ") + name);
        EXPECT_EQ(check.code, 2) << name;
        EXPECT_TRUE(contains(check.err, std::string(name) + ": the file is packed by gzip, and ")) << check.err;
    }
}

/// 1 MiB for each KiB.
TEST_F(Packed, Bombs) {
    shell("{ echo x,y,z; yes 0,0,0 | head -c 600M; } | gzip > z.csv.gz");
    const Ended check = shell("ulimit -v 4000000; barycert sample m --points z.csv.gz --output -");
    EXPECT_EQ(check.code, 2);
    EXPECT_TRUE(contains(check.err, "takes too much memory once it is unpacked")) << check.err;
}

// In less memory than they take.
TEST_F(Packed, GigabytesOfZerosAreToldByTheirBeginning) {
    shell("truncate -s 2G z; gzip -1 < z > z.gz; rm z; cp m.node z.node");
    for (const char* line : {"check z.vtu.gz", "check z.msh.gz", "check z.ele.gz", "check z.mesh.gz", "mesh z.off.gz",
                             "sample m --points p.csv --output - --field T=z.txt.gz"}) {
        const std::string words(line), name = words.substr(words.find("z."), words.find(".gz") - words.find("z.") + 3);
        const Ended check = shell("cp z.gz " + name + "; ulimit -v 1500000; barycert " + line);
        EXPECT_EQ(check.code, 2) << line;
        EXPECT_TRUE(contains(check.err, name + ":")) << check.err;
        EXPECT_FALSE(contains(check.err, "memory")) << check.err;
    }
}

TEST_F(Packed, NothingIsWrittenSo) {
    for (const char* line : {"sample m --points p.csv --output o.csv.gz", "resample m --onto m --output o.vtu.gz",
                             "check m --json o.json.gz"}) {
        const Ended refused = shell(std::string("barycert ") + line);
        EXPECT_EQ(refused.code, 2) << line;
        EXPECT_TRUE(contains(refused.err, ".gz")) << refused.err;
    }
    for (const std::string& name : scratch_.names()) EXPECT_FALSE(name.ends_with(".gz")) << name;
}

TEST_F(Packed, InputsAreNotOverwritten) {
    shell("mkdir t; cp m.node m.ele t; gzip t/m.node t/m.ele");
    const Ended refused = shell("barycert sample t/m --points p.csv --output - --json t/m.node.gz");
    EXPECT_EQ(refused.code, 2) << refused.err;
    EXPECT_EQ(rows("t/m", "--points p.csv"), expected_);
}

}  // namespace
}  // namespace barycert::cli_test
