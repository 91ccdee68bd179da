// barycert sample and resample: series of fields, weights as a matrix, what is made of fields.

#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>

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

TEST_F(Series, become_columns_in_natural_order) {
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

TEST_F(Series, become_a_file_a_step) {
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
    // Of every cell that holds a point, and from a map, which is saved by the way.
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

TEST_F(Series, of_grids_and_other_meshes) {
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

TEST_F(Series, of_folders_and_names_with_signs) {
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
TEST_F(Series, of_vtk_files) {
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
TEST_F(Series, keep_columns_of_points) {
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

TEST_F(Series, that_cannot_be_are_refused) {
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

TEST_F(WeightFiles, give_the_values_of_any_field) {
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

TEST_F(WeightFiles, that_cannot_be_are_refused) {
    expect_error(sample({}), "no output: expected --output FILE, --weights FILE, or both, found neither");
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

TEST_F(Series, what_is_made_of_fields) {
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

}  // namespace
}  // namespace barycert::cli_test
