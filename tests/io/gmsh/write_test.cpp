// Written meshes are read back to the bit.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/io/gmsh/msh_files.hpp"
#include "tests/io/tetgen/random_mesh.hpp"

namespace barycert::testing {
namespace {

constexpr std::array<GmshWriteOptions, 4> all_options{{{GmshWriteOptions::Version::v41, true},
                                                       {GmshWriteOptions::Version::v41, false},
                                                       {GmshWriteOptions::Version::v22, true},
                                                       {GmshWriteOptions::Version::v22, false}}};

std::string name_of(const GmshWriteOptions& o) {
    return std::string(o.version == GmshWriteOptions::Version::v41 ? "4.1" : "2.2") + (o.binary ? " binary" : " text");
}

Mesh round_trip(const Mesh& mesh, const GmshWriteOptions& options) {
    const TemporaryFolder folder;
    const Status written = write_gmsh(mesh, folder / "m.msh", options);
    EXPECT_TRUE(written) << written.error().message();
    EXPECT_EQ(folder.file_count(), 1U);
    const Result<Mesh> read = read_gmsh(folder / "m.msh");
    EXPECT_TRUE(read) << read.error().message();
    return *read;
}

TEST(GmshWrite, RandomMeshesComeBack) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        base::Random random(seed);
        Mesh mesh;
        if (random.coin()) {
            mesh = any_mesh(random);
            if (mesh.cells.empty()) continue;
        } else {
            const int dimension = random.integer(2, 3);
            mesh = second_order_mesh(dimension, dimension == 3 ? MidEdgeOrder::gmsh : MidEdgeOrder::vtk,
                                     1 + random.below(5), seed, 1e-3);
        }
        // Equal cells one after the other are, in 2.2, one cell in two groups.
        for (std::size_t i = mesh.corners(); i < mesh.cells.size(); i += mesh.corners()) {
            const auto at = mesh.cells.begin() + static_cast<std::ptrdiff_t>(i);
            const auto corners = static_cast<std::ptrdiff_t>(mesh.corners());
            if (std::equal(at, at + corners, at - corners)) *at = static_cast<Mesh::Index>(*at == 0);
        }
        if (mesh.point_count() == 1) continue;
        const std::size_t cells = mesh.cell_count();
        mesh.index_base = 1;
        mesh.faces.clear(), mesh.face_mid_nodes.clear(), mesh.face_markers.clear(), mesh.neighbours.clear();
        mesh.point_markers.clear();
        if (random.coin()) mesh.point_fields.push_back({"v", 3, any_doubles(random, 3 * mesh.point_count())});
        if (random.coin()) mesh.point_fields.push_back({" a b ", 2, any_doubles(random, 2 * mesh.point_count())});
        if (random.coin()) {
            mesh.cell_fields.push_back({"nan", 1, std::vector<double>(cells, std::nan(""))});
            mesh.cell_fields.back().data[0] = -INFINITY;
        }
        Field physical{"gmsh:physical", 1, {}}, geometrical{"gmsh:geometrical", 1, {}};
        const std::uint64_t kinds = random.below(4);
        for (std::size_t i = 0; i < cells; ++i) {
            const int group = random.integer(-2, 2);
            physical.data.push_back(kinds == 3 ? 0.5 * group : group);
            geometrical.data.push_back(kinds == 0 ? group + 10 : random.integer(3, 5));
        }
        if (random.coin()) mesh.cell_fields.push_back(physical);
        if (random.coin()) mesh.cell_fields.push_back(geometrical);
        if (random.coin()) {
            std::vector<std::int64_t> tags;
            for (std::size_t i = 0; i < cells; ++i) tags.push_back(static_cast<std::int64_t>(1000 + 7 * (cells - i)));
            mesh.cell_labels.push_back({"gmsh:tag", std::move(tags)});
        }
        for (const GmshWriteOptions& options : all_options) {
            SCOPED_TRACE(name_of(options));
            Mesh read = round_trip(mesh, options);
            // Groups stand after other fields; entities that groups made necessary are an addition.
            std::vector<Field> expected = mesh.cell_fields;
            const auto find = [](std::vector<Field>& fields, const std::string& name) {
                return std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
            };
            if (find(expected, "gmsh:geometrical") == expected.end()) {
                const auto added = find(read.cell_fields, "gmsh:geometrical");
                if (added != read.cell_fields.end()) read.cell_fields.erase(added);
            }
            const auto by_name = [](const Field& a, const Field& b) { return a.name < b.name; };
            std::sort(expected.begin(), expected.end(), by_name);
            std::sort(read.cell_fields.begin(), read.cell_fields.end(), by_name);
            Mesh same = mesh;
            same.cell_fields = expected;
            expect_same_with_labels(read, same, false);
        }
    }
}

TEST(GmshWrite, GroupsWithNames) {
    const Mesh mesh = read_msh(two_tetrahedra(), {41, Form::text}).value();
    for (const GmshWriteOptions& options : all_options) {
        SCOPED_TRACE(name_of(options));
        Mesh read = round_trip(mesh, options);
        EXPECT_EQ(read.cell_labels.at(0).values, mesh.cell_labels.at(0).values);
        EXPECT_EQ(read.cell_labels.at(1).values, mesh.cell_labels.at(1).values) << "elements keep their tags";
        expect_same_fields(read.cell_fields, mesh.cell_fields);
        EXPECT_TRUE(read.cell_numbers.empty());
    }
    // Without the label: what users know a cell as.
    Mesh numbered = mesh;
    numbered.cell_labels.clear();
    EXPECT_EQ(round_trip(numbered, {}).cell_labels.at(0).values, Column::Values(std::vector<std::int64_t>{3, 4}));
}

TEST(GmshWrite, MarkersAreAField) {
    Mesh mesh = read_msh(two_tetrahedra(), {41, Form::text}).value();
    mesh.point_markers = {1, 2, 3, 4, 5, -6};
    const Mesh read = round_trip(mesh, {});
    EXPECT_EQ(read.point_fields.at(0).name, "marker");
    EXPECT_EQ(read.point_fields.at(0).data, (std::vector<double>{1, 2, 3, 4, 5, -6}));
}

TEST(GmshWrite, WhatCannotBeWritten) {
    const TemporaryFolder folder;
    const Mesh good = read_msh(two_tetrahedra(), {41, Form::text}).value();
    const auto what = [&](const Mesh& mesh) {
        const Status status = write_gmsh(mesh, folder / "m.msh");
        EXPECT_EQ(folder.file_count(), 0U);
        return status ? std::string() : status.error().what;
    };
    for (const char* name : {"", "a\"b", "a\nb"}) {
        Mesh mesh = good;
        mesh.point_fields = {{name, 1, std::vector<double>(6)}};
        EXPECT_EQ(what(mesh), "a name of a field that cannot be written");
    }
    Mesh mesh = good;
    mesh.point_fields = {{"a", 1, std::vector<double>(6)}, {"a", 1, std::vector<double>(6)}};
    EXPECT_EQ(what(mesh), "a name of a field that cannot be written");
    mesh = good;
    mesh.cells[0] = 6;
    EXPECT_EQ(what(mesh), "cannot write the mesh: a vertex of a cell is not a node");
    mesh = good;
    mesh.cell_labels[0].values = std::vector<std::string>{"a", "b"};
    mesh.cell_fields[0].data = {7, 7};
    EXPECT_EQ(what(mesh), "a name of physical group 7 that cannot be written") << "two names for one group";
    mesh.cell_labels[0].values = std::vector<std::string>{"a", ""};
    EXPECT_TRUE(write_gmsh(mesh, folder / "m.msh")) << "a cell of the group without a name";
}

}  // namespace
}  // namespace barycert::testing
