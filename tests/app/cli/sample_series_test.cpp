// barycert sample and resample: series of fields, weights as a matrix, what is made of fields.

#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include <gtest/gtest.h>

#include "process.hpp"
#include "sample_meshes.hpp"

namespace barycert::cli_test {
namespace {

class Series : public ::testing::Test {
protected:
    /// The field of step k is k times (1 + 2x + 4y + 8z) at the nodes.
    void put_steps(const std::vector<int>& steps, const std::string& before = "step-") {
        for (const int k : steps) {
            std::string text;
            for (const int f : {1, 3, 5, 9, 15}) text += std::to_string(k * f) + "\n";
            scratch.put(before + std::to_string(k) + ".txt", text);
        }
    }
    Words sample(const Words& more) const { return plus({"sample", two, "--points", points, "--quiet"}, more); }
    /// Runs it in the folder of the test.
    Ended run_there(const Words& more) const { return run(sample(more), {.folder = scratch.folder()}); }

    Scratch scratch;
    std::string two = put_two_cells(scratch), points = scratch.put("p.csv", six_points);
};

TEST_F(Series, BecomeColumnsInNaturalOrder) {
    put_steps({2, 10, 0});
    const Ended r = run_there({"--field", "T@step-*.txt", "--fields", "T", "--output", "-"});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.out,
              "x,y,z,cell,feature,T@0,T@2,T@10\n0.25,0.25,0.25,0,interior,0,9,45\n0.5,0.5,0.5,1,interior,0,16,80\n"
              "0.25,0.25,0.5,0,face,0,13,65\n0.5,0.5,0,0,edge,0,8,40\n1,0,0,0,vertex,0,6,30\n2,2,2,-1,outside,nan,nan,"
              "nan\n");
    const Words made = lines_of(
        run_there({"--field", "T@step-*.txt", "--fields", "grad(T).z,cell:attribute0,T@2", "--output", "-"}).out);
    EXPECT_EQ(made[0], "x,y,z,cell,feature,T@2,grad(T@0).z,grad(T@2).z,grad(T@10).z,cell:attribute0");
    EXPECT_EQ(made[1], "0.25,0.25,0.25,0,interior,9,0,16,80,7");
    const Words all = lines_of(run_there({"--field", "T@step-*.txt", "--output", "-"}).out);
    EXPECT_EQ(all[0], "x,y,z,cell,feature,attribute0,T@0,T@2,T@10,cell:attribute0");
}

TEST_F(Series, BecomeAFileAStep) {
    put_steps({2, 10, 0});
    scratch.put("k.txt", "0 1\n0 1\n0 1\n0 1\n0 1\n");
    const Words asked{"--field", "k=k.txt", "--fields", "|k|,T,grad(T)"};
    for (const std::string outside : {"nan", "nearest", "fill=7"}) {
        const Ended r = run_there(plus(asked, {"--field", "T@step-*.txt", "--output", "rows-{step}.csv", "--outside",
                                               outside, "--json", "j.json"}));
        EXPECT_EQ(r.code, 0) << r.err;
        for (const std::string step : {"0", "2", "10"}) {
            const Ended one =
                run_there(plus(asked, {"--field", "T=step-" + step + ".txt", "--output", "-", "--outside", outside}));
            EXPECT_EQ(read_file(scratch.path("rows-" + step + ".csv")), one.out) << step << outside;
        }
        const auto json = parse(read_file(scratch.path("j.json")));
        EXPECT_EQ(json["steps"], (nlohmann::json{"0", "2", "10"}));
        EXPECT_EQ(json["output"], "rows-{step}.csv");
        EXPECT_EQ(json["points"], 6);
        EXPECT_EQ(json["rows"], 6);
    }
    // The same for every cell that holds a point, and from a map, which is saved by the way.
    EXPECT_EQ(run_there({"--field", "T@step-*.txt", "--output", "all-{step}.csv", "--on-boundary", "all", "--save-map",
                         "a.map"})
                  .code,
              0);
    const Ended r = run({"sample", two, "--map", scratch.path("a.map"), "--field", "T@" + scratch.path("step-*.txt"),
                         "--output", scratch.path("map-{step}.csv")});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.out, "steps      3: 0 to 10")) << r.out;
    for (const std::string step : {"0", "2", "10"}) {
        const std::string all = read_file(scratch.path("all-" + step + ".csv"));
        EXPECT_EQ(lines_of(all).size(), 10U) << "some points have several rows";
        EXPECT_EQ(read_file(scratch.path("map-" + step + ".csv")), all);
    }
}

TEST_F(Series, OfGridsAndOtherMeshes) {
    put_steps({1, 3});
    const std::string field = "T@" + scratch.path("step-*.txt");
    for (const Words& target : {Words{"--grid", "4x3x5"}, Words{"--onto", two}}) {
        for (const std::string suffix : {".csv", ".npy"}) {
            const Ended r = run(plus({"resample", two, "--field", field, "--fields", "T,|grad(T)|", "--output",
                                      scratch.path("r-{step}" + suffix), "--quiet"},
                                     target));
            EXPECT_EQ(r.code, 0) << r.err;
            for (const std::string step : {"1", "3"}) {
                const std::string one = scratch.path("one" + suffix);
                EXPECT_EQ(run(plus({"resample", two, "--field", "T=" + scratch.path("step-" + step + ".txt"),
                                    "--fields", "T,|grad(T)|", "--output", one, "--quiet"},
                                   target))
                              .code,
                          0);
                EXPECT_EQ(read_file(scratch.path("r-" + step + suffix)), read_file(one)) << step << suffix;
            }
        }
    }
    EXPECT_EQ(run({"resample", two, "--field", field, "--fields", "T", "--onto", two, "--output",
                   scratch.path("s-{step}.node"), "--quiet"})
                  .code,
              0);
    EXPECT_TRUE(contains(read_file(scratch.path("s-3.node")), "27"));
    EXPECT_EQ(run({"resample", two, "--field", field, "--fields", "T", "--grid", "5x5x1", "--output",
                   scratch.path("s-{step}.png"), "--quiet"})
                  .code,
              0);
    EXPECT_FALSE(read_file(scratch.path("s-3.png")).empty());
}

TEST_F(Series, OfFoldersAndNamesWithSigns) {
    for (const std::string run : {"run-1", "run-02"}) {
        ::mkdir(scratch.path(run).c_str(), 0777);
        scratch.put(run + "/T.txt", "1\n1\n1\n1\n1\n");
    }
    ::mkdir(scratch.path("run-none").c_str(), 0777);
    const Words lines = lines_of(run_there({"--field", "T@run-*/T.txt", "--fields", "T", "--output", "-"}).out);
    EXPECT_EQ(lines[0], "x,y,z,cell,feature,T@1,T@02");
    // A name with an @ is what it was; so is a file with an =.
    EXPECT_EQ(lines_of(run_there({"--field", "a@b=run-1/T.txt", "--fields", "a@b", "--output", "-"}).out)[0],
              "x,y,z,cell,feature,a@b");
    scratch.put("t=5.txt", "1\n2\n3\n4\n5\n");
    EXPECT_EQ(lines_of(run_there({"--field", "T@t=*.txt", "--fields", "T", "--output", "-"}).out)[0],
              "x,y,z,cell,feature,T@5");
}

// Meshes with arrays are steps, too: by a pattern, or by a .pvd or .vtu.series file, whose times are their names.
TEST_F(Series, OfVtkFiles) {
    put_steps({1, 2});
    for (const std::string step : {"1", "2"}) {
        const Ended made = run({"resample", two, "--onto", two, "--field", "T=" + scratch.path("step-" + step + ".txt"),
                                "--fields", "T", "--output", scratch.path("m-" + step + ".vtu"), "--quiet"});
        ASSERT_EQ(made.code, 0) << made.err;
    }
    scratch.put("all.pvd",
                "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\"><Collection>\n"
                "<DataSet timestep=\"0.5\" file=\"m-1.vtu\"/>\n<DataSet timestep=\"2\" file=\"m-2.vtu\"/>\n"
                "</Collection></VTKFile>\n");
    scratch.put("all.vtu.series",
                "{\"file-series-version\": \"1.0\", \"files\": [{\"name\": \"m-1.vtu\", \"time\": 0.5},\n"
                "{\"name\": \"m-2.vtu\", \"time\": 2}]}\n");
    const std::string ends = "0.25,0.25,0.25,0,interior,";
    for (const std::string series :
         {"m-*.vtu", "m-*.vtu:T", "all.pvd", "all.pvd:T", "all.vtu.series", "all.vtu.series:T"}) {
        const Ended r = run_there({"--field", "T@" + series, "--fields", "T", "--output", "-"});
        ASSERT_EQ(r.code, 0) << series << r.err;
        const bool times = contains(series, "all");
        EXPECT_EQ(lines_of(r.out)[0], std::string("x,y,z,cell,feature,T@") + (times ? "0.5,T@2" : "1,T@2")) << series;
        EXPECT_EQ(lines_of(r.out)[1], ends + "4.5,9") << series;
    }
    // The field of the mesh makes place for the series.
    const Ended r =
        run({"sample", scratch.path("m-1.vtu"), "--points", points, "--field", "T@" + scratch.path("all.pvd"),
             "--fields", "T", "--output", scratch.path("t-{step}.csv"), "--quiet"});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(lines_of(read_file(scratch.path("t-0.5.csv")))[1], ends + "4.5");
    EXPECT_EQ(lines_of(read_file(scratch.path("t-2.csv")))[1], ends + "9");
    expect_error(sample({"--field", "T@" + scratch.path("none.pvd"), "--output", "-"}), "none.pvd");
    expect_error(sample({"--field", "T@" + scratch.path("m-*.vtu:U"), "--output", "-"}), "no such array");
}

// Columns of the points are there in every step.
TEST_F(Series, KeepColumnsOfPoints) {
    put_steps({1, 2});
    const std::string named = scratch.put("named.csv", "x,y,z,id\n.25,.25,.25,a\n2,2,2,b\n");
    const Ended r = run({"sample", two, "--points", named, "--keep", "id", "--field", "T@" + scratch.path("step-*.txt"),
                         "--fields", "T", "--output", scratch.path("k-{step}.csv"), "--quiet"});
    EXPECT_EQ(r.code, 0) << r.err;
    for (const std::string step : {"1", "2"}) {
        const Words lines = lines_of(read_file(scratch.path("k-" + step + ".csv")));
        ASSERT_EQ(lines.size(), 3U);
        EXPECT_EQ(lines[0], "x,y,z,cell,feature,T,id");
        EXPECT_EQ(lines[1], "0.25,0.25,0.25,0,interior," + std::string(step == "1" ? "4.5" : "9") + ",a");
        EXPECT_EQ(lines[2], "2,2,2,-1,outside,nan,b");
    }
}

TEST_F(Series, ThatCannotBeAreRefused) {
    put_steps({1, 2});
    put_steps({1, 3}, "other-");
    const std::string steps = scratch.path("step-*.txt");
    const auto refused = [&](const Words& more, const std::string& says) { expect_error(sample(more), says); };
    const Words out{"--output", scratch.path("o-{step}.csv")};
    refused(plus({"--field", "T@" + scratch.path("none-*.txt")}, out), "no file of the series \"T\"");
    refused(plus({"--field", "T@" + scratch.path("no-folder/s-*.txt")}, out), "no file of the series \"T\"");
    refused(plus({"--field", "T@" + scratch.path("step-1.txt")}, out), "expected one *");
    refused(plus({"--field", "T@" + scratch.path("*-*.txt")}, out), "expected one *");
    refused(plus({"--field", "T@" + steps, "--field", "U@" + scratch.path("other-*.txt")}, out),
            "the series \"U\" and \"T\" have different steps: expected step \"2\", found step \"3\"");
    refused(plus({"--field", "T@" + steps, "--field", "T@" + steps}, out), "a field of this name exists already");
    refused({"--field", "T@" + steps, "--output", scratch.path("step-{step}.txt")}, "unknown suffix");
    // An output that is an input; a step of another shape: those before it are there, whole.
    scratch.put("s-1.csv", "1\n1\n1\n1\n1\n");
    refused({"--field", "T@" + scratch.path("s-*.csv"), "--output", scratch.path("s-{step}.csv")},
            "--output would overwrite field T");
    scratch.put("step-3.txt", "1\n2\n");
    refused(plus({"--field", "T@" + steps}, out),
            "step-3.txt: the steps of field \"T\" differ: expected 5 rows of 1 component, as in the first step, found "
            "2 rows of 1 component");
    EXPECT_EQ(lines_of(read_file(scratch.path("o-2.csv"))).size(), 7U);
    const Words names = scratch.names();
    EXPECT_EQ(std::count(names.begin(), names.end(), "o-3.csv"), 0);
    for (int k = 0; k < 257; ++k) scratch.put("m-" + std::to_string(k), "1\n1\n1\n1\n1\n");
    refused({"--field", "T@" + scratch.path("m-*"), "--output", scratch.path("m.csv")},
            "too many steps for columns of one output");
    EXPECT_EQ(run(sample({"--field", "T@" + scratch.path("m-*"), "--output", scratch.path("m-{step}.csv")})).code, 0);
}

class WeightFiles : public Series {};

TEST_F(WeightFiles, GiveTheValuesOfAnyField) {
    const std::string npz = scratch.path("W.npz");
    const Ended alone = run(sample({"--weights", npz, "--save-map", scratch.path("m.map")}));
    EXPECT_EQ(alone.code, 0) << alone.err;
    const std::string bytes = read_file(npz);
    EXPECT_EQ(run(sample({"--weights", npz, "--output", scratch.path("r.csv")})).code, 0);
    EXPECT_EQ(read_file(npz), bytes) << "with rows beside";
    EXPECT_EQ(run({"sample", two, "--map", scratch.path("m.map"), "--weights", npz, "--quiet"}).code, 0);
    EXPECT_EQ(read_file(npz), bytes) << "from a map";
    std::string python;
    for (const char* const one : {"python3", "/usr/bin/python3"}) {
        if (std::system((std::string(one) + " -c 'import scipy.sparse' >/dev/null 2>&1").c_str()) == 0) python = one;
    }
    if (python.empty()) GTEST_SKIP() << "python3 has no scipy";
    const std::string script = scratch.put("script.py", R"(
import sys, numpy as np, scipy.sparse
W = scipy.sparse.load_npz(sys.argv[1])
assert W.shape == (6, 5)
assert (W @ np.array([1.0, 3, 5, 9, 15]) == [4.5, 8, 6.5, 4, 3, 0]).all()
assert (np.load(sys.argv[1])['cell'] == [0, 1, 0, 0, 0, -1]).all()
assert (np.diff(W.indptr) == [4, 4, 3, 2, 1, 0]).all(), W.indptr
)");
    EXPECT_EQ(std::system((python + " " + script + " " + npz).c_str()), 0);
    // A real mesh, values of which are not exact: a few units in the last place.
    scratch.put("close.py", R"(
import sys, numpy as np, scipy.sparse
rows = np.load(sys.argv[2])
values = scipy.sparse.load_npz(sys.argv[1]) @ np.loadtxt(sys.argv[3])
inside = rows['cell'] >= 0
assert inside.sum() > 100
assert (values[~inside] == 0).all()
assert (abs(values - rows['T'])[inside] <= 8 * np.spacing(100.0)).all()
)");
    const Ended grid = run({"resample", mesh("bracket"), "--grid", "12x11x10", "--output", scratch.path("g.csv")});
    EXPECT_EQ(grid.code, 0) << grid.err;
    std::string field;
    const std::size_t nodes = parse(run({"check", mesh("bracket"), "--json", "-", "--quiet"}).out)["nodes"];
    for (std::size_t i = 0; i < nodes; ++i) field += std::to_string(static_cast<double>(i % 97) + 0.1) + "\n";
    const std::string t = scratch.put("t.txt", field);
    const Ended far = run({"sample", mesh("bracket"), "--points", scratch.path("g.csv"), "--field", "T=" + t,
                           "--fields", "T", "--output", scratch.path("g.npy"), "--weights", npz, "--quiet"});
    EXPECT_EQ(far.code, 0) << far.err;
    EXPECT_EQ(
        std::system(
            (python + " " + scratch.path("close.py") + " " + npz + " " + scratch.path("g.npy") + " " + t).c_str()),
        0);
}

TEST_F(WeightFiles, ThatCannotBeAreRefused) {
    expect_error(sample({}), "no output: expected --output FILE, --weights FILE or --plot FILE, found none");
    expect_error(sample({"--weights", scratch.path("w.npy")}), "unknown suffix of --weights: expected .npz");
    expect_error(sample({"--weights", scratch.path("w.npz"), "--fields", "attribute0"}),
                 "fields or columns without --output");
    expect_error({"resample", two, "--grid", "2x2x2", "--weights", scratch.path("w.npz"), "--output", "-"},
                 "--weights needs --onto here");
    expect_error(sample({"--weights", scratch.path("no/w.npz")}), "no/w.npz");
    expect_error(sample({"--weights", scratch.path("w.npz"), "--save-map", scratch.path("w.npz")}),
                 "name the same output");
    const Words names = scratch.names();
    EXPECT_EQ(std::count(names.begin(), names.end(), "w.npz"), 0);
    EXPECT_EQ(
        run({"resample", two, "--onto", two, "--weights", scratch.path("w.npz"), "--output", "-", "--quiet"}).code, 0);
    EXPECT_FALSE(read_file(scratch.path("w.npz")).empty());
}

TEST_F(Series, WhatIsMadeOfFields) {
    const std::string v = "v=" + scratch.put("v.txt", "3 4\n3 4\n3 4\n3 4\n3 4\n");
    const Words lines =
        lines_of(run(sample({"--field", v, "--fields",
                             "|v|,grad(attribute0),v.y,mean(cell:attribute0),|grad(attribute0)|", "--output", "-"}))
                     .out);
    EXPECT_EQ(lines[0],
              "x,y,z,cell,feature,v.y,mean(cell:attribute0),grad(attribute0).0,grad(attribute0).1,grad(attribute0).2,"
              "|grad(attribute0)|,|v|");
    // Cell 0 has the volume 1/6 and the value 7, cell 1 1/3 and 9; the mean at the common nodes is 25/3.
    EXPECT_EQ(lines[5], "1,0,0,0,vertex,4,8.333333333333334,2,4,8,9.16515138991168,5");
    EXPECT_EQ(lines[6], "2,2,2,-1,outside,nan,nan,nan,nan,nan,nan,nan");
    const Ended image = run({"resample", two, "--grid", "3x3x1", "--fields", "|grad(attribute0)|", "--output",
                             scratch.path("g.png"), "--quiet"});
    EXPECT_EQ(image.code, 0) << image.err;
    EXPECT_EQ(run({"resample", two, "--grid", "3x3x3", "--field", v, "--fields", "|v|,grad(attribute0)", "--output",
                   scratch.path("g.vti"), "--quiet"})
                  .code,
              0);
    EXPECT_TRUE(contains(read_file(scratch.path("g.vti")), "grad(attribute0)"));
}

/// A series as MESH: steps 0 and 1 have one mesh, step 2 another one.
class SeriesOfMeshes : public ::testing::Test {
protected:
    void SetUp() override {
        for (const int k : {0, 1, 2}) {
            // The field of step k is k at all nodes but the last, where it is 10 k.
            std::string values;
            for (int i = 0; i < 4; ++i) values += std::to_string(i == 3 ? 10 * k : k) + " ";
            const std::string top = k == 2 ? "2" : "1", n = std::to_string(k);
            scratch.put("s" + n + ".vtu",
                        "<VTKFile type='UnstructuredGrid'><UnstructuredGrid><Piece NumberOfPoints='4' "
                        "NumberOfCells='1'><PointData><DataArray type='Float64' Name='T'>" +
                            values +
                            "</DataArray></PointData><CellData/><Points><DataArray type='Float64' "
                            "NumberOfComponents='3'>0 0 0 1 0 0 0 1 0 0 0 " +
                            top +
                            "</DataArray></Points><Cells><DataArray type='Int64' Name='connectivity'>0 1 2 "
                            "3</DataArray><DataArray type='Int64' Name='offsets'>4</DataArray><DataArray type='UInt8' "
                            "Name='types'>10</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>");
        }
        scratch.put("p.csv", "x,y,z\n0.25,0.25,0.25\n0.125,0.125,1\n");
        scratch.put("run.pvd",
                    "<VTKFile type='Collection'><Collection><DataSet timestep='0' file='s0.vtu'/><DataSet "
                    "timestep='0.5' file='s1.vtu'/><DataSet timestep='2' file='s2.vtu'/></Collection></VTKFile>");
    }
    Ended there(const Words& words) const { return run(words, {.folder = scratch.folder()}); }
    std::string of(const std::string& name) const { return read_file(scratch.path(name)); }

    Scratch scratch;
    const Words sample{"sample", "run.pvd", "--points", "p.csv"};
};

TEST_F(SeriesOfMeshes, HaveAFileAStep) {
    const Ended r = there(plus(sample, {"--output", "ts_{step}_{time}.csv", "--json", "j.json"}));
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(r.err, "");
    for (const auto& [step, name] :
         {std::pair("0", "ts_0_0.csv"), std::pair("1", "ts_1_0.5.csv"), std::pair("2", "ts_2_2.csv")}) {
        const Ended one = there({"sample", std::string("s") + step + ".vtu", "--points", "p.csv", "--output", "-"});
        EXPECT_EQ(of(name), one.out) << step;
        const Ended chosen = there(plus(sample, {"--step", step, "--output", "-", "--quiet"}));
        EXPECT_EQ(chosen.out, one.out) << chosen.err;
    }
    EXPECT_TRUE(contains(r.out, "steps      3: 0 to 2, times 0 to 2; on 2 meshes")) << r.out;
    const auto json = parse(of("j.json"));
    EXPECT_EQ(json["steps"], (nlohmann::json{"0", "1", "2"}));
    EXPECT_EQ(json["times"], (nlohmann::json{0, 0.5, 2}));
    EXPECT_EQ(json["meshes"], 2);
    EXPECT_EQ(json["points"], 4) << "two in each of two meshes";
    EXPECT_EQ(json["outside"]["count"], 1) << "the second point, in the first mesh";
    EXPECT_EQ(there(plus(sample, {"--step", "all", "--output", "all_{step}.npy", "--quiet"})).code, 0);
    EXPECT_FALSE(of("all_2.npy").empty());
    const Ended last = there(plus(sample, {"--step", "last", "--output", "l_{step}.csv", "--quiet"}));
    EXPECT_EQ(last.code, 0) << last.err;
    EXPECT_EQ(of("l_2.csv"), of("ts_2_2.csv"));
    EXPECT_EQ(there(plus(sample, {"--time", "0.5", "--output", "-", "--quiet"})).out, of("ts_1_0.5.csv"));
}

TEST_F(SeriesOfMeshes, OnGridsAndOtherMeshes) {
    for (const Words& target : {Words{"--grid", "3x3x3", "--bounds", "0,1,0,1,0,1"}, Words{"--onto", "s2.vtu"}}) {
        EXPECT_EQ(there(plus({"resample", "run.pvd", "--output", "r{step}.csv", "--quiet"}, target)).code, 0);
        for (const std::string step : {"0", "1", "2"}) {
            EXPECT_EQ(there(plus({"resample", "s" + step + ".vtu", "--output", "one.csv", "--quiet"}, target)).code, 0);
            EXPECT_EQ(of("r" + step + ".csv"), of("one.csv")) << step;
        }
    }
    // All steps are on one grid, that of the first one's box.
    const Ended r = there({"resample", "run.pvd", "--grid", "2x2x2", "--output", "g{step}.csv"});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.err, "lies in the box of the mesh of the first one")) << r.err;
    EXPECT_EQ(lines_of(of("g2.csv")).back().substr(0, 5), "1,1,1");
}

TEST_F(SeriesOfMeshes, WithoutAChoiceTheFirstIsReadAndTold) {
    const Ended r = there(plus(sample, {"--output", "r.csv"}));
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.err, "all steps but the first of a series of 3: read is the time 0")) << r.err;
    EXPECT_TRUE(contains(r.out, "all steps but the first of a series of 3")) << r.out;
}

TEST_F(SeriesOfMeshes, WhatCannotBeMeantIsRefused) {
    const How here{.folder = scratch.folder()};
    for (const std::string name : {"ts_{step}.csv", "ts_{time}.csv"}) {
        expect_error({"sample", "s0.vtu", "--points", "p.csv", "--output", name}, "there are no steps to fill it",
                     here);
        expect_error({"check", "run.pvd", "--json", name}, "there are no steps to fill it", here);
        EXPECT_FALSE(std::filesystem::exists(scratch.path(name)));
    }
    expect_error(plus(sample, {"--output", "r{step}.csv", "--json", "j{step}.json"}), "no steps to fill it", here);
    expect_error(plus(sample, {"--step", "all", "--output", "r.csv"}), "expected {step} or {time} in --output", here);
    expect_error(plus(sample, {"--output", "r_{setp}.csv"}), "found {setp}; did you mean {step}?", here);
    scratch.put("twice.vtu.series", R"({"files": [{"name": "s0.vtu", "time": 1}, {"name": "s1.vtu", "time": 1}]})");
    expect_error({"check", "twice.vtu.series"}, "entry 2 of \"files\": expected a time of its own", here);
    expect_error(plus(sample, {"--step", "3", "--output", "r.csv"}), "expected a number from 0 to 2", here);
    expect_error(plus(sample, {"--time", "1", "--output", "r.csv"}), "one of the times 0, 0.5, 2", here);
    expect_error(plus(sample, {"--step", "first", "--output", "r.csv"}), "all or last", here);
    expect_error({"check", "run.pvd", "--step", "all"}, "a number from 0, or last", here);
    for (const Words& line :
         {Words{"sample", "s0.vtu", "--points", "p.csv", "--output", "r.csv"}, Words{"check", "s0.vtu"},
          Words{"verify", "s0.vtu", "--results", "p.csv"}, Words{"render", "mesh", "s0.vtu", "--output", "r.png"}})
        expect_error(plus(line, {"--step", "0"}), "this is no series of steps", here);
    const Ended pipe = run_shell("barycert sample run.pvd --points - --output 'r{step}.csv' < p.csv", here);
    EXPECT_EQ(pipe.code, 2);
    EXPECT_TRUE(contains(pipe.err, "points of a pipe can be read once")) << pipe.err;
    expect_error(plus(sample, {"--output", "q{step}.csv", "--weights", "w.npz"}), "--weights is of one mesh", here);
    expect_error(plus(sample, {"--output", "q{step}.csv", "--save-map", "m.npz"}), "another mesh in step 2", here);
    for (const char* const none : {"q0.csv", "w.npz", "m.npz"})
        EXPECT_FALSE(std::filesystem::exists(scratch.path(none))) << none;
    expect_error(plus(sample, {"--output", "s{step}.vtu"}), "would overwrite", here);
}

TEST_F(SeriesOfMeshes, AreCheckedVerifiedAndDrawnByStep) {
    EXPECT_EQ(there({"check", "run.pvd", "--step", "2", "--vtu", "c.vtu", "--quiet"}).code, 0);
    EXPECT_TRUE(contains(there({"check", "run.pvd", "--time", "2"}).out, "number 2 of a series of 3"));
    EXPECT_EQ(there(plus(sample, {"--step", "1", "--output", "one.csv", "--quiet"})).code, 0);
    EXPECT_EQ(there({"verify", "run.pvd", "--time", "0.5", "--results", "one.csv", "--quiet"}).code, 0);
    EXPECT_EQ(there({"verify", "run.pvd", "--step", "2", "--results", "one.csv", "--quiet"}).code, 1);
    for (const std::string step : {"0", "last"})
        EXPECT_EQ(there({"render", "mesh", "run.pvd", "--step", step, "--output", step + ".png", "--quiet"}).code, 0);
    EXPECT_NE(of("0.png"), of("last.png"));
    EXPECT_EQ(there({"render", "iso", "run.pvd", "--step", "1", "--field", "T", "--value", "5", "--output", "i.vtp",
                     "--quiet"})
                  .code,
              0);
}

/// The cells have volumes 1/6 and 1/3, and the values 7 and 9; at nodes the first cell that has the node gives it.
TEST_F(Series, IntegralsOfCellFieldsAtNodes) {
    const Ended r = run({"resample", two, "--fields", "cell:attribute0", "--onto", two, "--output",
                         scratch.path("r.csv"), "--json", scratch.path("j.json")});
    EXPECT_EQ(r.code, 0) << r.err;
    EXPECT_TRUE(contains(r.err, "1 field of cells into values at nodes")) << r.err;
    // 7/6 + 9/3; (7 + 7 + 7 + 7) / 4 / 6 + (7 + 7 + 7 + 9) / 4 / 3.
    EXPECT_TRUE(contains(r.out,
                         "integral   cell:attribute0: 4.166666666666667 over MESH, 3.6666666666666665 over "
                         "MESH2\n"))
        << r.out;
    const auto json = parse(read_file(scratch.path("j.json")));
    EXPECT_EQ(json["integrals"][0]["column"], "cell:attribute0");
    EXPECT_EQ(json["integrals"][0]["source"], 25.0 / 6);
    EXPECT_EQ(json["integrals"][0]["target"], 22.0 / 6);
    EXPECT_EQ(json["integrals"][0]["target_left_out"], 0);
    // A node outside has no value, and its cells count as left out.
    scratch.put("far.node", "5 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n4 9 9 9\n");
    scratch.put("far.ele", "2 4 0\n0 0 1 2 3\n1 1 2 3 4\n");
    const Ended far = run({"resample", two, "--fields", "cell:attribute0", "--onto", scratch.path("far"), "--output",
                           scratch.path("far.vtu")});
    EXPECT_TRUE(contains(far.out, "1.1666666666666667 over MESH2 (1 cell without a finite value left out)")) << far.out;
}

TEST_F(SeriesOfMeshes, BesideASeriesOfFieldsOneStepIsChosen) {
    const Words both = plus(sample, {"--field", "U@run.pvd:T", "--output", "b_{time}.csv", "--quiet"});
    const Ended r = there(both);
    EXPECT_EQ(r.code, 2) << r.out;
    EXPECT_TRUE(contains(r.err, "choose one step of the mesh: --step N")) << r.err;
    EXPECT_EQ(there(plus(both, {"--step", "0"})).code, 0);
}

TEST_F(SeriesOfMeshes, WhatIsWrongWithAStepIsSaidOfThatStep) {
    std::string other = of("s2.vtu");
    other.replace(other.find("Name='T'"), 8, "Name='W'");
    scratch.put("s2.vtu", other);
    const Ended all = there(plus(sample, {"--output", "a_{step}.csv"}));
    EXPECT_EQ(all.code, 0) << all.err;
    EXPECT_TRUE(contains(all.err, "in step 2 the fields of the first step: there they are \"T\", here \"W\""))
        << all.err;
    const Ended named = there(plus(sample, {"--fields", "T", "--output", "n_{step}.csv"}));
    EXPECT_EQ(named.code, 2);
    EXPECT_TRUE(contains(named.err, "step 2: no field of that name")) << named.err;
    // A piece that is not there is known before anything is written.
    std::filesystem::remove(scratch.path("s2.vtu"));
    const Ended missing = there(plus(sample, {"--output", "m_{step}.csv"}));
    EXPECT_EQ(missing.code, 2);
    EXPECT_TRUE(contains(missing.err, "s2.vtu: no such file, which step 2 of the series names")) << missing.err;
    EXPECT_FALSE(std::filesystem::exists(scratch.path("m_0.csv")));
}

TEST_F(SeriesOfMeshes, IntegralsOfCellFieldsThatAreNotPrintedAreTold) {
    for (const std::string step : {"0", "1", "2"}) {
        std::string text = of("s" + step + ".vtu");
        const std::string empty = "<CellData/>";
        text.replace(text.find(empty), empty.size(),
                     "<CellData><DataArray type='Float64' Name='k' NumberOfComponents='2'>1 2</DataArray></CellData>");
        scratch.put("s" + step + ".vtu", text);
    }
    const Ended all = there({"resample", "run.pvd", "--onto", "s0.vtu", "--output", "r_{step}.vtu"});
    EXPECT_EQ(all.code, 0) << all.err;
    EXPECT_TRUE(contains(all.err, "their integrals are printed for one step alone: --step N")) << all.err;
    const Ended part = there({"resample", "s0.vtu", "--onto", "s0.vtu", "--fields", "k.x", "--output", "c.vtu"});
    EXPECT_EQ(part.code, 0) << part.err;
    EXPECT_TRUE(contains(part.err, "integrals are printed of whole fields, not of \"k.x\"")) << part.err;
}

}  // namespace
}  // namespace barycert::cli_test
