// Gigabytes of zeros or of something else are an error by their first block.

#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include "process.hpp"
#include "sample_meshes.hpp"

namespace barycert::cli_test {
namespace {

/// Each reader, with NAME for a file of its kind.
struct Reader {
    const char* suffix;
    const char* command;
};
constexpr std::array readers{
    Reader{"node", "check NAME"},
    Reader{"ele", "check NAME"},
    Reader{"msh", "check NAME"},
    Reader{"vtu", "check NAME"},
    Reader{"vtk", "check NAME"},
    Reader{"vtp", "check NAME"},
    Reader{"pvtu", "check NAME"},
    Reader{"vtm", "check NAME"},
    Reader{"pvd", "check NAME"},
    Reader{"vtu.series", "check NAME"},
    Reader{"mesh", "check NAME"},
    Reader{"inp", "check NAME"},
    Reader{"csv", "sample m --points NAME --output -"},
    Reader{"npy", "sample m --points NAME --output -"},
    Reader{"node", "sample m --points NAME --output -"},
    Reader{"vtu", "sample m --points NAME --output -"},
    Reader{"vti", "sample m --points NAME --output -"},
    Reader{"txt", "sample m --points p.csv --output - --field T=NAME"},
    Reader{"npy", "sample m --points p.csv --output - --field T=NAME"},
    Reader{"vtu", "sample m --points p.csv --output - --field T=NAME:T"},
    Reader{"csv", "sample m --points p.csv --output - --field T=NAME:x"},
    Reader{"map", "sample m --map NAME --output -"},
    Reader{"csv", "verify m --results NAME"},
    Reader{"vtu", "verify m --results NAME"},
    Reader{"json", "render NAME --output o.png"},
    Reader{"json", "replay NAME"},
    Reader{"off", "mesh NAME"},
    Reader{"stl", "mesh NAME"},
    Reader{"ply", "mesh NAME"},
    Reader{"poly", "mesh NAME"},
    Reader{"smesh", "mesh NAME"},
};

/// Bytes that a file of 2 GiB consists of, again and again; the shell makes one that takes no room on the disk.
struct Filling {
    const char* name;
    const char* make;  ///< shell that writes "block", 64 KiB of it
};
constexpr std::array fillings{
    Filling{"zeros", ": > block"},
    Filling{"letters", "head -c 65536 /dev/zero | tr '\\0' a > block"},
    Filling{"blanks", "head -c 65536 /dev/zero | tr '\\0' ' ' > block"},
    Filling{"newlines", "head -c 65536 /dev/zero | tr '\\0' '\\n' > block"},
    Filling{"words", "yes 'aaa bbb ccc ddd eee' | head -c 65536 > block"},
    Filling{"random", "head -c 65536 /dev/urandom > block; tail -c +2 block > cut; printf 'Q' | cat - cut > block"},
};

class Beginnings : public ::testing::TestWithParam<Filling> {};

/// With less memory than the file: who maps or reads all of it fails otherwise.
TEST_P(Beginnings, Decide) {
    const Scratch scratch;
    put_two_cells(scratch, "m");
    scratch.put("p.csv", six_points);
    const How here{.folder = scratch.folder()};
    // The block four times, so that a reader that looks further finds the same, and nothing up to 2 GiB.
    ASSERT_EQ(
        run_shell(std::string(GetParam().make) + "; cat block block block block > big; truncate -s 2G big", here).code,
        0);
    for (const Reader& reader : readers) {
        std::string line = reader.command;
        const std::string name = std::string("big.") + reader.suffix;
        line.replace(line.find("NAME"), 4, name);
        const Ended done =
            run_shell("ln -sf big " + name + "; ulimit -v 1500000; BARYCERT_MESHIO= barycert " + line, here);
        EXPECT_EQ(done.code, 2) << line << '\n' << done.err;
        EXPECT_TRUE(contains(done.err, "big.")) << line << '\n' << done.err;
        for (const char* word : {"emory", "Killed", "allocate"})
            EXPECT_FALSE(contains(done.err, word)) << line << '\n' << done.err;
        EXPECT_LT(done.err.size(), 2000U) << line;
        std::filesystem::remove(scratch.path(name));
    }
}

/// Files that began well, and to which nothing was written after that.
TEST(GoodBeginnings, OfZerosAreToldAtOnce) {
    const Scratch scratch;
    const How here{.folder = scratch.folder()};
    for (const auto& [name, text] :
         {std::pair("a.vtu", "<?xml version=\"1.0\"?>\\n<VTKFile type=\"UnstructuredGrid\">\\n"),
          {"a.msh", "$MeshFormat\\n2.2 0 8\\n$EndMeshFormat\\n$Nodes\\n3\\n1 0 0 0\\n"},
          {"a.mesh", "MeshVersionFormatted 2\\nDimension 3\\nVertices\\n3\\n0 0 0 0\\n"},
          {"a.node", "4 3 0 0\\n0 0 0 0\\n"}}) {
        const std::string file(name);
        const Ended done = run_shell("printf '" + std::string(text) + "' > " + file + "; truncate -s 2G " + file +
                                         "; ulimit -v 1500000; barycert check " + file + "; rm " + file,
                                     here);
        EXPECT_TRUE(contains(done.err, file + ": the file does not begin as text: expected words, found NUL bytes"))
            << done.err;
    }
}

INSTANTIATE_TEST_SUITE_P(files_of, Beginnings, ::testing::ValuesIn(fillings),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace barycert::cli_test
