// Files that are refused, and the words.
#include "tests/io/gmsh/msh_files.hpp"

namespace barycert::testing {
namespace {

const std::string head = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
const std::string nodes = "$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n";
const std::string elements = "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n";

/// Replaces the only `from`.
std::string with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    EXPECT_EQ(text.find(from, at + 1), std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

struct Case {
    std::string text;
    std::size_t line;
    const char* what;
    const char* expected;
    const char* found;
};

TEST(GmshErrors, WithLineAndRemedy) {
    const std::string good = head + nodes + elements;
    ASSERT_TRUE(read_bytes(good));
    EXPECT_TRUE(read_bytes(with(good, "4.1 0 8", "4.100000 0 8"))) << "as some write it";
    const std::string old = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n$EndNodes\n$Elements\n";
    const std::vector<Case> cases{
        {"", 1, "not a file of Gmsh", "a first line \"$MeshFormat\"", "the end of the file"},
        {"solid x\n", 1, "not a file of Gmsh", nullptr, "\"solid\""},
        {"$NOD\n1\n", 1, "a .msh file of version 1", "version 2.2 or 4.1", "\"$NOD\""},
        {with(good, "4.1 0 8", "4.10001 0 8"), 2, "unknown version of the format", "2.2 or 4.1", "\"4.10001\""},
        {with(good, "4.1 0 8", "4.1x 0 8"), 2, "unknown version of the format", "2.2 or 4.1", "\"4.1x\""},
        {with(good, "4.1 0 8", "3 0 8"), 2, "unknown version of the format", "2.2 or 4.1", "\"3\""},
        {with(good, "4.1 0 8", "4 1 8"), 2, "a binary file of version 4.0", "version 4.1 or 2.2", "\"4\""},
        {with(good, "4.1 0 8", "4.1 1 4"), 2, "bad data size in $MeshFormat", "8 in a binary file", "\"4\""},
        {with(good, "4.1 0 8", "4.1 2 8"), 2, "bad file type in $MeshFormat", nullptr, "\"2\""},
        {with(good, "4.1 0 8", "4.1"), 2, "bad $MeshFormat", nullptr, "\"4.1\""},
        {with(good, "4.1 0 8", "4.1 1 8"), 2, "bad byte order mark in $MeshFormat", nullptr, nullptr},
        {head + nodes, 0, "the file contains no elements", "a section $Elements", "none"},
        {head + elements, 0, "the file contains no nodes", "a section $Nodes", "none"},
        {head + nodes + nodes + elements, 16, "a second section $Nodes", nullptr, nullptr},
        {with(good, "$EndElements\n", ""), 16, "section $Elements has no end", "a line \"$EndElements\"", nullptr},
        {with(good, "$EndNodes\n", "$EndNodes\nx\n"), 16, "text between sections", nullptr, "\"x\""},
        {with(good, "\n0 1 0\n", "\n0 1,5 0\n"), 13, "bad number in $Nodes", "a finite coordinate", "\"1,5\""},
        {with(good, "\n0 1 0\n", "\n0 nan 0\n"), 13, "bad number in $Nodes", "a finite coordinate", "\"nan\""},
        {with(good, "\n0 1 0\n", "\n0 1e999 0\n"), 13, "bad number in $Nodes", "a finite coordinate", "\"1e999\""},
        {with(good, "\n0 1 0\n", "\n0 1\n"), 10, "the section ends too early in $Nodes", "4 nodes", "3"},
        {with(good, "\n0 1 0\n", "\n0 1 0 7\n"), 14, "more than its header tells in $Nodes", "the end of the section",
         "\"1\""},
        {with(good, "1 4 1 4", "1 5 1 4"), 14, "the blocks do not add up in $Nodes", "5 nodes", "4"},
        {with(good, "3 1 0 4", "3 1 0 4000000000"), 6, "too many nodes in $Nodes", "at most 2147483647", "more"},
        {with(good, "3 1 0 4", "3 1 0 2000000000"), 6, "the section ends too early in $Nodes",
         "2000000000 tags of nodes", "fewer"},
        {with(good, "3 1 0 4", "5 1 0 4"), 6, "bad dimension of an entity in $Nodes", "0 to 3", "5"},
        {with(good, "1\n2\n3\n4\n0", "1\n2\n2\n4\n0"), 4, "two nodes with the tag 2", "each tag once",
         "it again at node 2 from 0"},
        {with(good, "1\n2\n3\n4\n0", "1\n2\n-2\n4\n0"), 9, "bad tag of a node in $Nodes", nullptr, "-2"},
        {with(good, "1 1 2 3 4\n", "1 1 2 3 5\n"), 19, "an unknown node in $Elements", "the tag of a node of $Nodes",
         "5"},
        {with(good, "1 1 2 3 4\n", "1 1 2 3\n"), 18, "the section ends too early in $Elements", "1 elements", "0"},
        {with(good, "3 1 4 1\n", "3 1 140 1\n"), 18, "an unknown type of elements in $Elements", nullptr, "140"},
        {with(good, "3 1 4 1\n", "3 1 5 1\n"), 18, "the section ends too early in $Elements", nullptr, nullptr},
        {head + nodes + "$Elements\n1 1 1 1\n1 1 1 1\n1 1 2\n$EndElements\n", 0, "the file contains no mesh", nullptr,
         "1 line"},
        {head + nodes + "$Elements\n1 1 1 1\n3 1 7 1\n1 1 2 3 4 9\n$EndElements\n", 19, "an unknown node in $Elements",
         "the tag of a node of $Nodes", "9"},
        {head + nodes + "$Elements\n1 1 1 1\n3 1 7 1\n1 1 2 3 4\n$EndElements\n", 18,
         "the section ends too early in $Elements", "1 elements", "0"},
        {head + nodes + "$Elements\n2 2 1 2\n3 1 4 1\n1 1 2 3 4\n3 1 5 1\n2 1 2 3 4 1 2 3 7\n$EndElements\n", 21,
         "an unknown node in $Elements", nullptr, "7"},
        {head + nodes + "$Elements\n1 1 1 1\n2 1 3 1\n1 1 2 3 4\n$EndElements\n", 0, "z of node 3 (from 0)",
         "0, as the mesh is 2D", "1"},
        {head + nodes + "$Elements\n2 3 1 3\n2 1 2 1\n1 1 2 3\n2 1 9 2\n2 1 2 3 1 2 3\n3 1 2 3 1 2 3\n$EndElements\n",
         0, "z of node 3 (from 0)", "0, as the mesh is 2D", "1"},
        {head + nodes + "$Elements\n1 1 1 1\n2 1 21 1\n1 1 2 3 4 1 2 3 4 1\n$EndElements\n", 18,
         "the section ends too early in $Elements", "1 elements", "0"},
        {old + "1\n1 4 2 0 0 1 1 1 2\n$EndElements\n", 10, "an unknown node in $Elements", nullptr, "2"},
        {old + "1\n1 4 -1 1 1 1 1\n$EndElements\n", 10, "bad number in $Elements", nullptr, "-1"},
        {old + "2\n1 4 2 0 0 1 1 1 1\n$EndElements\n", 11, "bad number in $Elements", "the tag of an element", nullptr},
        {good + "$NodeData\n1\n\"T\"\n0\n2\n0\n1\n$EndNodeData\n", 27, "bad header of $NodeData",
         "the number of values", "-1"},
        {good + "$NodeData\n1\n\"T\"\n0\n3\n0\n1\n1\n1 x\n$EndNodeData\n", 29, "bad number in $NodeData", "a number",
         "\"x\""},
        {good + "$NodeData\n1\n\"T\"\n0\n3\n0\n1\n9\n1 2\n$EndNodeData\n", 29,
         "the section ends too early in $NodeData", "9 values", "fewer"},
        {good + "$NodeData\n1\n\"T\"\n0\n3\n0\n100\n30000\n" + std::string(30000, '\n') + "$EndNodeData\n", 29,
         "the section ends too early in $NodeData", "30000 values", "0"},
        {good + "$PhysicalNames\n1\n3 1 inner\n$EndPhysicalNames\n", 23, "bad line in $PhysicalNames", nullptr,
         "\"3\""},
        {good + "$Entities\n0 0 0 1\n1 0 0 0 1 1\n$EndEntities\n", 24, "bad number in $Entities", "a coordinate",
         "\"$EndEntities\""},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.text);
        for (const int threads : {1, 2})
            expect_error(read_bytes(c.text, {.step = {}, .threads = threads}), "m.msh", c.line, c.what, c.expected,
                         c.found, nullptr);
    }
}

TEST(GmshErrors, Binary) {
    for (const Form form : {Form::little, Form::big}) {
        for (const int version : {22, 41}) {
            Msh msh = two_tetrahedra();
            msh.blocks[3].elements[0].nodes[1] = 5;
            Result<Mesh> mesh = read_msh(msh, {version, form});
            ASSERT_FALSE(mesh);
            EXPECT_EQ(mesh.error().what, "an unknown node in $Elements, row 1 from 0");
            EXPECT_EQ(mesh.error().found, "5");
            EXPECT_EQ(mesh.error().line, 0U);
            msh = two_tetrahedra();
            msh.nodes[2].at[1] = INFINITY;
            mesh = read_msh(msh, {version, form});
            ASSERT_FALSE(mesh);
            EXPECT_TRUE(mesh.error().what.starts_with("a number that is not finite in $Nodes, row "))
                << mesh.error().what;
        }
    }
}

TEST(GmshErrors, FilesThatAreNotThereOrAreNoFiles) {
    const TemporaryFolder folder;
    EXPECT_EQ(read_gmsh(folder / "no.msh").error().what, read_tetgen(folder / "no").error().what);
    EXPECT_FALSE(read_gmsh(folder / "."));
    EXPECT_FALSE(read_gmsh_points(folder / "no.msh", 3));
    EXPECT_FALSE(gmsh_steps(folder / "no.msh"));
    put(folder / "m.msh", head + nodes);
    EXPECT_EQ(read_gmsh_points(folder / "m.msh", 3).value(), (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}));
    EXPECT_EQ(read_gmsh_points(folder / "m.msh", 2).error().what, "z of node 3 (from 0)");
    EXPECT_FALSE(read_gmsh_points(folder / "m.msh", 1));
}

}  // namespace
}  // namespace barycert::testing
