// Files that Gmsh and meshio write are read as meshio reads them. Skipped where they are not installed.
#include <cstdlib>
#include <cstring>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/fix.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/plc.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "tests/io/medit/medit_files.hpp"

namespace barycert::testing {
namespace {

bool runs(const std::string& command) {
    return std::system(("(" + command + ") >/dev/null 2>&1 </dev/null").c_str()) == 0;
}

/// The python3 that has meshio; empty if none has.
std::string meshio_python() {
    for (const char* python : {"python3", "/usr/bin/python3"}) {
        if (runs(std::string(python) + " -c 'import meshio'")) return python;
    }
    return {};
}

template <class T>
std::vector<T> numbers_in(const std::string& path) {
    const std::string bytes = get(path);
    std::vector<T> numbers(bytes.size() / sizeof(T));
    std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(T));
    return numbers;
}

/// Coordinates, cells and references as meshio reads them.
void expect_as_meshio(const std::string& path, const Mesh& mesh, const TemporaryFolder& folder) {
    const std::string python = meshio_python();
    if (python.empty()) return;
    put(folder / "read.py", R"(
import sys, meshio, numpy as np
m = meshio.read(sys.argv[1], file_format="medit")
d = int(sys.argv[3])
kind = "tetra" if d == 3 else "triangle"
m.points[:, :d].astype("f8").tofile(sys.argv[2] + "/points")
np.concatenate([c.data for c in m.cells if c.type == kind]).astype("i4").tofile(sys.argv[2] + "/cells")
ref = [r for c, r in zip(m.cells, m.cell_data["medit:ref"]) if c.type == kind]
np.concatenate(ref).astype("f8").tofile(sys.argv[2] + "/ref")
m.point_data["medit:ref"].astype("i8").tofile(sys.argv[2] + "/marker")
)");
    const std::string command =
        python + " " + folder / "read.py" + " " + path + " " + folder / "" + " " + std::to_string(mesh.dimension);
    ASSERT_TRUE(runs(command)) << command;
    EXPECT_EQ(mesh.points, numbers_in<double>(folder / "points"));
    EXPECT_EQ(mesh.cells, numbers_in<Mesh::Index>(folder / "cells"));
    const std::vector<double> none(mesh.cell_count(), 0);
    EXPECT_EQ(mesh.cell_fields.empty() ? none : mesh.cell_fields[0].data, numbers_in<double>(folder / "ref"));
    const std::vector<std::int64_t> no_marks(mesh.point_count(), 0);
    EXPECT_EQ(mesh.point_markers.empty() ? no_marks : mesh.point_markers, numbers_in<std::int64_t>(folder / "marker"));
}

const char* const box = R"(
Point(1) = {0,0,0,0.4}; Point(2) = {1,0,0,0.4}; Point(3) = {1,1,0,0.4}; Point(4) = {0,1,0,0.4};
Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,1};
Curve Loop(1) = {1,2,3,4}; Plane Surface(5) = {1};
v[] = Extrude {0,0,1} { Surface{5}; };
)";

TEST(MeditPrograms, GmshWrites) {
    if (!runs("gmsh --version")) GTEST_SKIP() << "no gmsh";
    for (const int dimension : {2, 3}) {
        for (const int order : {1, 2}) {
            SCOPED_TRACE(std::to_string(dimension) + "D of order " + std::to_string(order));
            const TemporaryFolder folder;
            put(folder / "m.geo", box);
            const std::string command = "gmsh -" + std::to_string(dimension) + " -order " + std::to_string(order) +
                                        " -nt 1 -save_all " + folder / "m.geo" + " -o " + folder / "m.mesh";
            ASSERT_TRUE(runs(command)) << command;
            Result<Mesh> mesh = read_mesh(folder / "m.mesh");
            if (dimension == 2) {  // the extruded sides stand up
                ASSERT_FALSE(mesh);
                EXPECT_TRUE(mesh.error().what.starts_with("z of point")) << mesh.error().message();
                continue;
            }
            ASSERT_TRUE(mesh) << mesh.error().message();
            EXPECT_TRUE(check_mesh(*mesh).certified());
            EXPECT_FALSE(mesh->faces.empty());
            EXPECT_EQ(mesh->mid_edge_order, order == 2 ? MidEdgeOrder::vtk : MidEdgeOrder::none);
            if (order == 1) expect_as_meshio(folder / "m.mesh", *mesh, folder);
        }
    }
}

TEST(MeditPrograms, MeshioWrites) {
    const std::string python = meshio_python();
    if (python.empty()) GTEST_SKIP() << "no meshio";
    const TemporaryFolder folder;
    put(folder / "write.py", R"(
import sys, meshio, numpy as np
r = np.random.default_rng(7)
for d, kind in ((2, "triangle"), (3, "tetra")):
    points = r.random((50, d)) * 10.0 ** r.integers(-300, 300, (50, d))
    for itype in ("i4", "i8"):
        cells = np.array([r.permutation(50)[:d + 1] for _ in range(40)], dtype=itype)
        m = meshio.Mesh(points, [(kind, cells), ("line", cells[:, :2])],
            cell_data={"a": [np.arange(40, dtype=itype), np.arange(40, dtype=itype)]},
            point_data={"b": np.arange(-3, 47, dtype=itype)})
        for suffix in ("mesh", "meshb"):
            m.write(f"{sys.argv[1]}/{d}{itype}.{suffix}", file_format="medit")
)");
    ASSERT_TRUE(runs(python + " " + folder / "write.py" + " " + folder / ""));
    for (const char* name :
         {"2i4.mesh", "2i8.mesh", "3i4.mesh", "3i8.mesh", "2i4.meshb", "2i8.meshb", "3i4.meshb", "3i8.meshb"}) {
        SCOPED_TRACE(name);
        const Result<Mesh> mesh = read_mesh(folder / name);
        ASSERT_TRUE(mesh) << mesh.error().message();
        EXPECT_EQ(mesh->point_count(), 50U);
        expect_as_meshio(folder / name, *mesh, folder);
    }
}

}  // namespace
}  // namespace barycert::testing
