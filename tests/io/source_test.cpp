#include "io/paths.hpp"
#include "io/table_format.hpp"
#include "tests/io/points_files.hpp"

namespace barycert::io::testing {
namespace {

TEST(Formats, BySuffix) {
    EXPECT_EQ(io::format_of_table("-").value(), io::FormatKind::csv);
    EXPECT_EQ(io::format_of_table("a/b.c.csv").value(), io::FormatKind::csv);
    EXPECT_EQ(io::format_of_table("B.NPY").value(), io::FormatKind::npy);
    EXPECT_EQ(io::format_of_table("b.Node").value(), io::FormatKind::node);
    EXPECT_EQ(io::format_of_table("b.vtu").value(), io::FormatKind::vtu);
    const Result<io::FormatKind> other = io::format_of_table("a/b.vtk");
    expect_error(
        other, "a/b.vtk",
        {0, "unknown file suffix", ".csv, .npy, .node or .vtu, or - for CSV from standard input or on standard output",
         "\".vtk\"", "convert"});
    expect_error(io::format_of_table("a.csv/b"), "b", {0, "unknown file suffix", nullptr, "no suffix", nullptr});
    EXPECT_FALSE(io::format_of_table(""));
    EXPECT_FALSE(io::format_of_table("csv"));
}

TEST(Formats, Sources) {
    expect_error(open_points("p.vtu", 3), "p.vtu",
                 {0, "cannot read the file", nullptr, "No such file or directory", nullptr});
    expect_error(open_points("p.txt", 3), "p.txt",
                 {0, "cannot read the file", nullptr, "No such file or directory", nullptr});
    expect_error(open_points("p.odt", 3), "p.odt",
                 {0, "unknown file suffix",
                  "points (.csv .txt .dat .xyz .tsv .npy .node .vtu .vtk .vtp .vti .vtr .vts .pvtu .pvtp .vtm .vtpd "
                  ".vtpc .pvd .series, - for "
                  "CSV from stdin) or a mesh",
                  "\".odt\"", nullptr});
    expect_error(open_points("p.csv", 4), "p.csv", {0, "points can have 2 or 3 coordinates", "2 or 3", "4", nullptr});
}

TEST(Formats, Sinks) {
    expect_error(open_table("p.node", {}), "p.node",
                 {0, "cannot write rows in the format of that suffix",
                  ".csv, .npy or .vtu, or - for CSV on the standard output", "a format for points alone", nullptr});
    expect_error(open_table("p.txt", {}), "p.txt",
                 {0, "cannot write rows in the format of that suffix", nullptr, "a format for points alone", nullptr});
    expect_error(open_table("p.odt", {}), "p.odt",
                 {0, "cannot write rows in the format of that suffix", nullptr, "\".odt\"", nullptr});
    expect_error(open_table("p.csv", {.dimension = 1}), "p.csv",
                 {0, "points of rows can have 2 or 3 coordinates", "2 or 3", "1", nullptr});
}

TEST(MemorySource, GivesThePoints) {
    const auto source = memory_points({1, 2, 3, 4, 5, 6, 7}, 2);
    EXPECT_EQ(source->dimension(), 2);
    EXPECT_EQ(source->count(), 3U);
    std::vector<double> out{0};
    EXPECT_EQ(source->read(2, out).value(), 2U);
    EXPECT_EQ(source->read(2, out).value(), 1U);
    EXPECT_EQ(source->read(2, out).value(), 0U);
    EXPECT_EQ(out, (std::vector<double>{0, 1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(memory_points({}, 3)->count(), 0U);
}

}  // namespace
}  // namespace barycert::io::testing
