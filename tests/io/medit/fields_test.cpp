// .sol and .solb: fields for a mesh that stands in another file, or in the same.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "app/jobs/field_files.hpp"
#include "barycert/job.hpp"
#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/result.hpp"
#include "io/medit/medit.hpp"
#include "tests/io/gmsh/msh_files.hpp"
#include "tests/io/medit/medit_files.hpp"
#include "tests/temporary_folder.hpp"

namespace barycert::testing {
namespace {

/// A scalar, a vector and a symmetric matrix of each node, a scalar of each tetrahedron and of each triangle.
Medit solution() {
    Medit file{3,
               {{"SolAtVertices", 62, 10, {}, {1, 2, 3}},
                {"SolAtTetrahedra", 66, 1, {{0.5}, {-0.25}}, {1}},
                {"SolAtTriangles", 64, 1, {{4}, {5}}, {1}},
                {"SolAtEdges", 63, 1, {{4}}, {1}}}};
    for (int node = 0; node < 6; ++node) {
        file.parts[0].rows.emplace_back();
        for (int k = 0; k < 10; ++k) file.parts[0].rows.back().push_back(node + k / 16.);
    }
    return file;
}

TEST(MeditFields, AllVersionsAndForms) {
    const TemporaryFolder folder;
    for (const MeditForm& form : medit_forms) {
        SCOPED_TRACE(name_of(form));
        put(folder / "m.sol", medit_bytes(solution(), form.version, form.form));
        const Result<Mesh> fields = io::read_medit_fields(folder / "m.sol", 3);
        ASSERT_TRUE(fields) << fields.error().message();
        ASSERT_EQ(fields->point_fields.size(), 3U);
        EXPECT_EQ(fields->point_fields[0].name, "solution0");
        EXPECT_EQ(fields->point_fields[0].data, (std::vector<double>{0, 1, 2, 3, 4, 5}));
        EXPECT_EQ(fields->point_fields[1].name, "solution1");
        EXPECT_EQ(fields->point_fields[1].components, 3);
        EXPECT_EQ(fields->point_fields[1].data[5], 1 + 3 / 16.);
        EXPECT_EQ(fields->point_fields[2].components, 6);
        EXPECT_EQ(fields->point_fields[2].data[35], 5 + 9 / 16.);
        ASSERT_EQ(fields->cell_fields.size(), 1U);
        EXPECT_EQ(fields->cell_fields[0].data, (std::vector<double>{0.5, -0.25}));
        EXPECT_NE(find_note(*fields, "SolAtTriangles"), nullptr);
        EXPECT_NE(find_note(*fields, "\"SolAtEdges\""), nullptr);
        EXPECT_EQ(io::read_medit_fields(folder / "m.sol", 2)->cell_fields.at(0).data, (std::vector<double>{4, 5}));
    }
}

TEST(MeditFields, InThePlane) {
    const Medit file{2, {{"SolAtVertices", 62, 9, {{1, 2, 3, 4, 5, 6, 7, 8, 9}}, {2, 3, 4}}}};
    const TemporaryFolder folder;
    for (const MeditForm& form : medit_forms) {
        put(folder / "m.sol", medit_bytes(file, form.version, form.form));
        const Mesh fields = io::read_medit_fields(folder / "m.sol", 2).value();
        EXPECT_EQ(fields.point_fields.at(0).data, (std::vector<double>{1, 2}));
        EXPECT_EQ(fields.point_fields.at(1).data, (std::vector<double>{3, 4, 5}));
        EXPECT_EQ(fields.point_fields.at(2).data, (std::vector<double>{6, 7, 8, 9}));
    }
}

TEST(MeditFields, InTheFileOfTheMesh) {
    Medit file = two_of_medit();
    for (const MeditPart& part : solution().parts) file.parts.push_back(part);
    for (const MeditForm& form : medit_forms) {
        const Result<Mesh> mesh = read_medit_bytes(medit_bytes(file, form.version, form.form));
        ASSERT_TRUE(mesh) << mesh.error().message();
        EXPECT_EQ(mesh->point_fields.size(), 3U);
        EXPECT_EQ(mesh->cell_fields.at(1).name, "solution0");
    }
    file.parts[5].rows.pop_back();
    const Result<Mesh> fewer = read_medit_bytes(medit_bytes(file, 2, Form::text));
    ASSERT_FALSE(fewer);
    EXPECT_EQ(fewer.error().what, "the rows of solution0");
}

TEST(MeditFields, NamedAsFieldFiles) {
    const TemporaryFolder folder;
    Mesh mesh = read_medit_bytes(medit_bytes(two_of_medit(), 2, Form::text)).value();
    const auto add = [&](const std::string& name, const std::string& file, const std::string& column,
                         FieldFile::Of of = FieldFile::Of::either) -> Result<jobs::FieldPlace> {
        try {
            return jobs::add_field(jobs::field_input({of, name, folder / file, column}), mesh, false);
        } catch (const Exception& e) {
            return e.error();
        }
    };
    Medit one = solution();
    one.parts = {one.parts[1]};
    put(folder / "one.sol", medit_bytes(one, 2, Form::text));
    put(folder / "one.mesh", medit_bytes(two_of_medit(), 2, Form::text));
    EXPECT_NE(find_note(read_mesh(folder / "one.mesh").value(), "one.sol, unless it is named: --field NAME="), nullptr);
    put(folder / "all.solb", medit_bytes(solution(), 3, Form::big));
    ASSERT_TRUE(add("c", "one.sol", "")) << "the only field of a file need not be named";
    EXPECT_EQ(mesh.cell_fields.back().data, (std::vector<double>{0.5, -0.25}));
    ASSERT_TRUE(add("v", "all.solb", "solution1"));
    EXPECT_EQ(mesh.point_fields.back().name, "v");
    EXPECT_EQ(mesh.point_fields.back().components, 3);
    EXPECT_EQ(find_note(mesh, "are in the order of the mesh"), nullptr);
    EXPECT_NE(find_note(mesh, "SolAtTriangles"), nullptr);
    const auto unnamed = add("T", "all.solb", "");
    ASSERT_FALSE(unnamed);
    EXPECT_EQ(unnamed.error().what, "it is not said which array of the file is meant");
    EXPECT_NE(unnamed.error().found.find("\"solution2\""), std::string::npos);
    const auto both = add("T", "all.solb", "solution0");
    ASSERT_FALSE(both);
    EXPECT_EQ(both.error().what, "there is an array of nodes and one of cells of that name");
    ASSERT_TRUE(add("T", "all.solb", "solution0", FieldFile::Of::points));
    EXPECT_EQ(mesh.point_fields.back().data, (std::vector<double>{0, 1, 2, 3, 4, 5}));
    Medit few = one;
    few.parts[0].rows.pop_back();
    put(folder / "few.sol", medit_bytes(few, 2, Form::text));
    EXPECT_FALSE(add("d", "few.sol", ""));
}

TEST(MeditFields, Errors) {
    const TemporaryFolder folder;
    const std::string head = "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n";
    struct Refused {
        std::string text, what;
        std::size_t line;
    };
    for (const Refused& one :
         std::vector<Refused>{{"2\n1 7\n0\n0\n", "the type of a field", 5},
                              {"2\n0\n0\n0\n", "the number of fields", 5},
                              {"2\n1 1\n0\n", "the end of SolAtVertices", 7},
                              {"2\n1 1\n0\n0\n0\n", "more numbers in SolAtVertices", 7},
                              {"2\n1 1\n0\n0", "the last row has no line end, so the file may be cut short", 7},
                              {"2\n1 1\n0\nx\n", "the end of SolAtVertices", 7}}) {
        put(folder / "m.sol", head + one.text);
        const Result<Mesh> fields = io::read_medit_fields(folder / "m.sol", 3);
        ASSERT_FALSE(fields) << one.text;
        EXPECT_EQ(fields.error().what, one.what) << one.text;
        EXPECT_EQ(fields.error().line, one.line) << one.text;
    }
}

}  // namespace
}  // namespace barycert::testing
