// No output is an input, whatever the subcommand, and by whatever name the file goes.

#include <algorithm>
#include <filesystem>
#include <map>

#include <gtest/gtest.h>

#include "process.hpp"
#include "sample_meshes.hpp"

namespace barycert::cli_test {
namespace {

namespace fs = std::filesystem;

/// A folder with an input of every kind.
class Inputs {
public:
    Inputs() {
        for (const std::string suffix : {".node", ".ele"}) {
            fs::copy_file(fs::path(mesh("bracket")).replace_extension(suffix), scratch_.path("m" + suffix));
        }
        scratch_.put("m.face", "0 0\n");
        scratch_.put("p.csv", "0,0,0\n");
        scratch_.put("f.txt", "1\n");
        scratch_.put("s.json", R"({"texture": {"image": "t.png"}})");
        scratch_.put("t.png", "t");
        scratch_.put("part.poly", "0 3 0 0\n");
        scratch_.put("part.node", "0 3 0 0\n");
        fs::copy_file(BARYCERT_USER_KERNEL, scratch_.path("k.so"));
        for (const auto& entry : fs::directory_iterator(scratch_.folder()))
            before_[entry.path().filename().string()] = read_file(entry.path().string());
        fs::create_directory(scratch_.path("other"));
        fs::create_directory_symlink(scratch_.folder(), scratch_.path("way"));
    }

    /// Every name under which the file can be reached.
    Words names_of(const std::string& file) {
        const std::string hard = "other/hard-" + file, soft = "other/soft-" + file;
        if (!fs::exists(scratch_.path(hard)) && fs::exists(scratch_.path(file))) {
            fs::create_hard_link(scratch_.path(file), scratch_.path(hard));
            fs::create_symlink("../" + file, scratch_.path(soft));
        }
        Words names{file, "./" + file, "other/../" + file, scratch_.path(file), "way/" + file};
        if (fs::exists(scratch_.path(file))) names.insert(names.end(), {hard, soft});
        return names;
    }

    void expect_refused(const Words& arguments, const std::string& option, const std::string& file,
                        const std::string& what, const std::string& program = BARYCERT_PROGRAM) {
        for (const std::string& name : names_of(file)) {
            Words all = arguments;
            all.insert(all.end(), {option, name});
            const Ended r = run(all, {.folder = scratch_.folder(), .program = program});
            EXPECT_EQ(r.code, 2) << ::testing::PrintToString(all);
            EXPECT_EQ(r.out, "");
            EXPECT_TRUE(contains(r.err, option + " would overwrite " + what)) << ::testing::PrintToString(all) << r.err;
        }
        for (const auto& [kept, bytes] : before_) EXPECT_EQ(read_file(scratch_.path(kept)), bytes) << kept;
    }
    bool untouched() const {
        Words names;
        for (const auto& [name, bytes] : before_) names.push_back(name);
        names.insert(names.end(), {"other", "way"});
        std::sort(names.begin(), names.end());
        Words found;  // not what names_of put into folders
        for (const auto& entry : fs::directory_iterator(scratch_.folder()))
            found.push_back(entry.path().filename().string());
        std::sort(found.begin(), found.end());
        return found == names;
    }
    const Scratch& scratch() const { return scratch_; }

private:
    Scratch scratch_;
    std::map<std::string, std::string> before_;
};

TEST(Overwriting, Audit) {
    Inputs inputs;
    const Words line{"audit", "m", "--count", "2", "--kernel", "segment.*", "--kernel-library", "k.so"};
    for (const std::string option : {"--json", "--witnesses", "--plot"}) {
        for (const std::string file : {"m.node", "m.ele", "m.face", "m.neigh"})
            inputs.expect_refused(line, option, file, "the mesh");
        inputs.expect_refused(line, option, "k.so", "--kernel-library");
    }
    // Its own meshes are inputs too, where none is named.
    const std::string data = inputs.scratch().path("data");
    fs::create_directories(data + "/meshes");
    fs::rename(inputs.scratch().path("m.node"), data + "/meshes/m.node");
    const Ended own = run({"audit", "--count", "2", "--json", data + "/meshes/m.node"},
                          {.environment = {"BARYCERT_DATA_DIR=" + data}});
    EXPECT_EQ(own.code, 2);
    EXPECT_TRUE(contains(own.err, "--json would overwrite the mesh")) << own.err;
}

TEST(Overwriting, Check) {
    Inputs inputs;
    const Words line{"check", "m.ele", "--conforms-to", "part.poly"};
    for (const std::string option : {"--json", "--html"}) {
        for (const std::string file : {"m.node", "m.ele", "m.face", "m.neigh"})
            inputs.expect_refused(line, option, file, "the mesh");
        for (const std::string file : {"part.poly", "part.node"})
            inputs.expect_refused(line, option, file, "the PLC of --conforms-to");
    }
    EXPECT_TRUE(inputs.untouched());
}

TEST(Overwriting, SampleAndResample) {
    Inputs inputs;
    const Words sample{"sample", "m", "--points", "p.csv", "--field", "f=f.txt"};
    Words with_output = sample;
    with_output.insert(with_output.end(), {"--output", "r.csv"});
    for (const std::string file : {"m.node", "m.ele", "m.face", "m.neigh"}) {
        inputs.expect_refused(with_output, "--json", file, "the mesh");
        inputs.expect_refused(with_output, "--save-map", file, "the mesh");
        inputs.expect_refused({"resample", "m", "--grid", "2x2x2", "--output", "r.vti"}, "--json", file, "the mesh");
        inputs.expect_refused({"resample", mesh("plate"), "--onto", "m", "--output", "r.csv"}, "--json", file,
                              "the mesh of --onto");
    }
    inputs.expect_refused(sample, "--output", "p.csv", "--points");
    inputs.expect_refused(with_output, "--json", "f.txt", "field f");
    EXPECT_TRUE(inputs.untouched());
}

TEST(Overwriting, Render) {
    Inputs inputs;
    for (const std::string file : {"m.node", "m.ele"})
        inputs.expect_refused({"render", "mesh", "m", "--output", "r.png"}, "--json", file, "the mesh");
    inputs.expect_refused({"render", "mesh", "m", "--field-file", "f=f.txt", "--output", "r.png"}, "--json", "f.txt",
                          "field f");
    inputs.expect_refused({"render", "s.json", "--output", "r.png"}, "--json", "s.json", "the scene");
    inputs.expect_refused({"render", "s.json"}, "--output", "t.png", "an image of the scene");
    inputs.expect_refused({"render", "texture", "--image", "t.png"}, "--output", "t.png", "--image");
    EXPECT_TRUE(inputs.untouched());
}

#ifdef BARYCERT_TETGEN_PROGRAM
TEST(Overwriting, Mesh) {
    Inputs inputs;
    const fs::path cube = std::string(BARYCERT_DATA_DIR) + "/plc/cube-hole.poly";
    fs::create_symlink(cube, inputs.scratch().path("c.node"));
    const How here{.folder = inputs.scratch().folder(), .program = BARYCERT_TETGEN_PROGRAM};
    const Ended through_a_link = run({cube.string(), "--output", "c"}, here);
    EXPECT_EQ(through_a_link.code, 2);
    EXPECT_TRUE(contains(through_a_link.err, "--output would overwrite the PLC")) << through_a_link.err;
}
#endif

/// Pieces of what names files are inputs, wherever it is named.
class Pieces : public ::testing::Test {
protected:
    void SetUp() override {
        for (const std::string name : {"0.vtu", "1.vtu"})
            ASSERT_EQ(run({"sample", two, "--points", points, "--quiet", "--output", scratch.path(name)}).code, 0);
        scratch.put("all.pvtu",
                    "<VTKFile type='PUnstructuredGrid'><PUnstructuredGrid GhostLevel='0'><Piece Source='0.vtu'/>"
                    "<Piece Source='1.vtu'/></PUnstructuredGrid></VTKFile>");
        scratch.put("all.vtm",
                    "<VTKFile type='vtkMultiBlockDataSet'><vtkMultiBlockDataSet><DataSet index='0' file='0.vtu'/>"
                    "<DataSet index='1' file='1.vtu'/></vtkMultiBlockDataSet></VTKFile>");
        scratch.put("all.pvd",
                    "<VTKFile type='Collection'><Collection><DataSet timestep='0' file='0.vtu'/>"
                    "<DataSet timestep='0' part='1' file='1.vtu'/></Collection></VTKFile>");
        scratch.put("all.vtu.series", R"({"files": [{"name": "0.vtu", "time": 0}, {"name": "1.vtu", "time": 1}]})");
        scratch.put("outer.pvtu",
                    "<VTKFile type='PUnstructuredGrid'><PUnstructuredGrid><Piece Source='all.pvtu'/>"
                    "</PUnstructuredGrid></VTKFile>");
        std::filesystem::create_symlink("1.vtu", scratch.path("link.vtu"));
        std::filesystem::create_hard_link(scratch.path("1.vtu"), scratch.path("hard.vtu"));
        bytes = read_file(scratch.path("1.vtu"));
    }
    void expect_refused(const Words& arguments) {
        const Ended r = run(arguments, {.folder = scratch.folder()});
        EXPECT_EQ(r.code, 2) << ::testing::PrintToString(arguments) << r.err;
        EXPECT_TRUE(contains(r.err, " would overwrite ")) << ::testing::PrintToString(arguments) << r.err;
        EXPECT_EQ(read_file(scratch.path("1.vtu")), bytes) << ::testing::PrintToString(arguments);
        EXPECT_FALSE(std::filesystem::exists(scratch.path("r.csv"))) << "the run was refused too late";
    }

    Scratch scratch;
    std::string two = put_two_cells(scratch), points = scratch.put("p.csv", six_points), bytes;
};

TEST_F(Pieces, AreInputs) {
    const Words suffixes{"all.pvtu", "all.vtm", "all.pvd", "all.vtu.series", "outer.pvtu"};
    for (const std::string& all : suffixes) {
        const Words rows{"--output", "r.csv"};
        for (const std::string name : {"1.vtu", "link.vtu", "hard.vtu"}) {
            const Words sample{"sample", two, "--points", all};
            expect_refused(plus(sample, {"--output", name}));
            expect_refused(plus(plus(sample, rows), {"--json", name}));
            expect_refused(plus(plus(sample, rows), {"--save-map", name}));
            const Words field{"sample", two, "--points", "p.csv", "--output", "r.csv"};
            expect_refused(plus(field, {"--point-field", "k=" + all + ":attribute0", "--json", name}));
            expect_refused(plus(field, {"--field", "k=" + all + ":attribute0", "--json", name}));
            expect_refused({"resample", two, "--onto", all, "--output", "r.csv", "--json", name});
            expect_refused({"verify", two, "--results", all, "--json", name});
            expect_refused({"verify", two, "--results", all, "--html", name});
            expect_refused({"render", "mesh", two, "--field-file", "k=" + all + ":attribute0", "--output", "r.png",
                            "--json", name});
            expect_refused({"check", all, "--json", name});
        }
    }
}

TEST_F(Pieces, OfEveryStepOfASeriesOfFields) {
    scratch.put("run-0.pvtu",
                "<VTKFile type='PUnstructuredGrid'><PUnstructuredGrid><Piece Source='0.vtu'/>"
                "</PUnstructuredGrid></VTKFile>");
    scratch.put("run-1.pvtu",
                "<VTKFile type='PUnstructuredGrid'><PUnstructuredGrid><Piece Source='1.vtu'/>"
                "</PUnstructuredGrid></VTKFile>");
    const Words fields{"sample", two, "--points", "p.csv", "--point-field", "attribute0@run-*.pvtu"};
    expect_refused(plus(fields, {"--output", "r.csv", "--json", "1.vtu"}));
    expect_refused(plus(fields, {"--output", "{step}.vtu"}));
}

TEST(Overwriting, StandardStreams) {
    Inputs inputs;
    const How here{.folder = inputs.scratch().folder()};
    for (const std::string line : {"barycert sample m --points - --output p.csv < p.csv",
                                   "barycert sample m --points - --output - < p.csv >> p.csv",
                                   "barycert sample m --points p.csv --output - >> p.csv",
                                   "barycert sample m --points - --output r.csv --json p.csv < p.csv",
                                   "barycert sample m --points /dev/stdin --output p.csv < p.csv",
                                   "barycert verify m --results - --json p.csv < p.csv"}) {
        const Ended r = run_shell(line, here);
        EXPECT_EQ(r.code, 2) << line;
        EXPECT_TRUE(contains(r.err, " would overwrite ")) << line << r.err;
        EXPECT_EQ(read_file(inputs.scratch().path("p.csv")), "0,0,0\n") << line;
    }
    EXPECT_TRUE(inputs.untouched());
}

TEST(Overwriting, DevicesAreNoFiles) {
    const Ended r = run({"audit", "--quiet", "--count", "2", "--kernel", "segment.*", "--json", "/dev/null"});
    EXPECT_EQ(r.code, 0) << r.err;
    const Ended same =
        run_shell("barycert sample " + mesh("bracket") + " --points /dev/stdin --output - < /dev/null > /dev/null");
    EXPECT_FALSE(contains(same.err, "would overwrite")) << same.err;
}

}  // namespace
}  // namespace barycert::cli_test
