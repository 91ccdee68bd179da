#include "barycert/io.hpp"

#include "io/points_files.hpp"

namespace barycert::points::testing {
namespace {

TEST(Formats, by_suffix) {
    EXPECT_EQ(format_of("-").value(), Format::csv);
    EXPECT_EQ(format_of("a/b.c.csv").value(), Format::csv);
    EXPECT_EQ(format_of("B.NPY").value(), Format::npy);
    EXPECT_EQ(format_of("b.Node").value(), Format::node);
    EXPECT_EQ(format_of("b.vtu").value(), Format::vtu);
    const Result<Format> other = format_of("a/b.vtk");
    expect_error(
        other, "a/b.vtk",
        {0, "a format that is not known by its suffix",
         ".csv, .npy, .node or .vtu, or - for CSV from standard input or on standard output", "'.vtk'", "convert"});
    expect_error(format_of("a.csv/b"), "b",
                 {0, "a format that is not known by its suffix", nullptr, "no suffix", nullptr});
    EXPECT_FALSE(format_of(""));
    EXPECT_FALSE(format_of("csv"));
}

TEST(Formats, sources) {
    expect_error(open_source("p.vtu", 3), "p.vtu",
                 {0, "cannot read points from a VTU file here", "a .csv, .npy or .node file", nullptr, "VTK"});
    expect_error(open_source("p.txt", 3), "p.txt",
                 {0, "a format that is not known by its suffix", nullptr, "'.txt'", nullptr});
    expect_error(open_source("p.csv", 4), "p.csv", {0, "points of an impossible dimension", "2 or 3", "4", nullptr});
}

TEST(Formats, sinks) {
    expect_error(open_sink("p.node", {}), "p.node",
                 {0, "cannot write rows in the format of that suffix",
                  ".csv or .npy, or - for CSV on the standard output", "a format for points alone", nullptr});
    expect_error(open_sink("p.txt", {}), "p.txt",
                 {0, "cannot write rows in the format of that suffix", nullptr, "'.txt'", nullptr});
    expect_error(open_sink("p.csv", {.dimension = 1}), "p.csv",
                 {0, "rows of an impossible dimension", "2 or 3", "1", nullptr});
}

TEST(MemorySource, gives_the_points) {
    const auto source = memory_source({1, 2, 3, 4, 5, 6, 7}, 2);
    EXPECT_EQ(source->dimension(), 2);
    EXPECT_EQ(source->count(), 3U);
    std::vector<double> out{0};
    EXPECT_EQ(source->read(2, out).value(), 2U);
    EXPECT_EQ(source->read(2, out).value(), 1U);
    EXPECT_EQ(source->read(2, out).value(), 0U);
    EXPECT_EQ(out, (std::vector<double>{0, 1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(memory_source({}, 3)->count(), 0U);
}

}  // namespace
}  // namespace barycert::points::testing
