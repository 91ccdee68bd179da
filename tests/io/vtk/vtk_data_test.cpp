/// Every way in which numbers are written, read here and by meshio.
#include <tbb/global_control.h>

#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <thread>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "tests/io/tetgen/random_mesh.hpp"
#include "tests/io/vtk/mesh_notes.hpp"

namespace barycert::testing {
namespace {

constexpr std::array<VtkData, 5> all_data{VtkData::raw, VtkData::zlib, VtkData::lz4, VtkData::lzma, VtkData::ascii};

void expect_round_trip(const Mesh& mesh, const char* name, VtkData data) {
    SCOPED_TRACE(std::string(name) + " " + std::string(barycert::name(data)));
    const TemporaryFolder folder;
    const Status written = write_vtk(mesh, folder / name, data);
    ASSERT_TRUE(written) << written.error().message();
    EXPECT_EQ(folder.file_count(), 1U);
    const Result<Mesh> read = read_vtk(folder / name);
    ASSERT_TRUE(read) << read.error().message();
    expect_same(*read, as_in_vtk(mesh));
}

TEST(VtkDataModes, Names) {
    for (const VtkData data : all_data) EXPECT_EQ(vtk_data_named(name(data)), data);
    EXPECT_EQ(vtk_data_named("zip"), std::nullopt);
}

TEST(VtkDataModes, MeshesOfTheDataFolder) {
    for (const char* name : {"cube-hole", "cube-hole-o2", "plate", "bracket"}) {
        const Mesh mesh = mesh_of_data(name);
        for (const VtkData data : all_data) {
            expect_round_trip(mesh, "m.vtu", data);
            if (data == VtkData::raw || data == VtkData::ascii) expect_round_trip(mesh, "m.vtk", data);
        }
    }
}

TEST(VtkDataModes, RandomMeshes) {
    base::Random random(7);
    for (int i = 0; i < 60; ++i) {
        const Mesh mesh = any_mesh(random);
        if (mesh.cell_count() == 0) continue;
        for (const VtkData data : all_data) expect_round_trip(mesh, "m.vtu", data);
    }
}

/// More than one block of compressed data, one part of text, and numbers that are none.
TEST(VtkDataModes, LongArraysAreTheSameBytesOnAnyNumberOfThreads) {
    Mesh mesh;
    base::Random random(8);
    for (int i = 0; i < 60001; ++i) {
        for (int k = 0; k < 3; ++k) mesh.points.push_back(random.uniform(-1, 1));
    }
    for (Mesh::Index i = 0; i < 60000; ++i)
        mesh.cells.insert(mesh.cells.end(), {i, i + 1, 3 * i % 60001, 7 * i % 60001});
    Field field{"T", 1, any_doubles(random, mesh.point_count())}, other{"U", 1, {}};
    field.data[5] = std::numeric_limits<double>::infinity();
    field.data[6] = -field.data[5];
    field.data[7] = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < mesh.cell_count(); ++i) other.data.push_back(static_cast<double>(i / 100));
    mesh.point_fields = {field};
    mesh.cell_fields = {other};
    const TemporaryFolder folder;
    for (const VtkData data : all_data) {
        SCOPED_TRACE(name(data));
        expect_round_trip(mesh, "m.vtu", data);
        std::vector<std::string> bytes;
        for (const std::size_t threads : {1, 2, 3}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            ASSERT_TRUE(write_vtu(mesh, folder / "m.vtu", data));
            bytes.push_back(get(folder / "m.vtu"));
            const Result<Mesh> read = read_vtk(folder / "m.vtu");
            ASSERT_TRUE(read) << read.error().message();
            EXPECT_EQ(bits_of(read->points), bits_of(mesh.points));
        }
        EXPECT_EQ(bytes[0], bytes[1]);
        EXPECT_EQ(bytes[0], bytes[2]);
    }
    expect_round_trip(mesh, "m.vtk", VtkData::ascii);
}

TEST(VtkDataModes, PayloadsOfNans) {
    Mesh mesh = mesh_of_data("plate");
    const double payload = std::bit_cast<double>(0xfff8000000abcdefU);
    mesh.point_fields = {{"T", 1, std::vector<double>(mesh.point_count(), payload)}};
    mesh.cell_fields.clear();
    for (const VtkData data : {VtkData::raw, VtkData::zlib, VtkData::lz4, VtkData::lzma})
        expect_round_trip(mesh, "m.vtu", data);
    const TemporaryFolder folder;
    ASSERT_TRUE(write_vtu(mesh, folder / "m.vtu", VtkData::ascii));
    EXPECT_TRUE(std::isnan(read_vtk(folder / "m.vtu").value().point_fields[0].data[0]));
}

TEST(VtkDataModes, WhatALegacyFileDoesNotKnow) {
    const TemporaryFolder folder;
    const Status status = write_vtk(mesh_of_data("plate"), folder / "m.vtk", VtkData::zlib);
    ASSERT_FALSE(status);
    EXPECT_EQ(status.error().what, "legacy files of VTK (.vtk) know no compression");
    EXPECT_EQ(folder.file_count(), 0U);
}

TEST(VtkDataModes, APipeTakesCompressedData) {
    const Mesh mesh = mesh_of_data("plate");
    const TemporaryFolder folder;
    ASSERT_TRUE(write_vtu(mesh, folder / "m.vtu", VtkData::zlib));
    ASSERT_EQ(
        std::system(
            ("mkfifo '" + folder / "pipe" + "' && cat '" + folder / "pipe" + "' > '" + folder / "out" + "' &").c_str()),
        0);
    while (!std::filesystem::exists(folder / "pipe")) std::this_thread::yield();
    ASSERT_TRUE(write_vtu(mesh, folder / "pipe", VtkData::zlib));
    const std::string expected = get(folder / "m.vtu");
    for (int i = 0; i < 1000 && get(folder / "out").size() < expected.size(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_EQ(get(folder / "out"), expected);
}

bool meshio_is_there() {
    return std::system("/usr/bin/python3 -c 'import meshio' >/dev/null 2>&1") == 0;
}

bool run_script(const TemporaryFolder& folder, const std::string& script) {
    put(folder / "script.py", script);
    return std::system(("cd '" + folder / "." + "' && /usr/bin/python3 script.py >out.txt 2>&1").c_str()) == 0;
}

/// meshio reads what is written here, and what it writes is read here.
TEST(VtkDataModes, Meshio) {
    if (!meshio_is_there()) GTEST_SKIP() << "python3 has no meshio";
    Mesh mesh = mesh_of_data("cube-hole");
    mesh.point_markers.clear();
    base::Random random(9);
    mesh.point_fields = {{"T", 1, any_doubles(random, mesh.point_count())},
                         {"u", 3, any_doubles(random, 3 * mesh.point_count())}};
    mesh.cell_fields = {{"c", 1, any_doubles(random, mesh.cell_count())}};
    const TemporaryFolder folder;
    const std::string check =
        "import meshio, numpy as np\nm = meshio.read('m.vtu')\n"
        "assert (m.points == np.fromfile('p.bin').reshape(-1, 3)).all()\n"
        "assert (m.cells_dict['tetra'] == np.fromfile('c.bin', dtype='<i4').reshape(-1, 4)).all()\n"
        "assert (m.point_data['T'] == np.fromfile('T.bin')).all()\n"
        "assert (m.point_data['u'] == np.fromfile('u.bin').reshape(-1, 3)).all()\n"
        "assert (m.cell_data['c'][0] == np.fromfile('f.bin')).all()\n";
    put(folder / "p.bin", bits_of(mesh.points));
    put(folder / "c.bin", {reinterpret_cast<const char*>(mesh.cells.data()), mesh.cells.size() * 4});
    put(folder / "T.bin", bits_of(mesh.point_fields[0].data));
    put(folder / "u.bin", bits_of(mesh.point_fields[1].data));
    put(folder / "f.bin", bits_of(mesh.cell_fields[0].data));
    // meshio 5.3 decodes appended data of any writer to the end of the file, and relies on Python to stop before that.
    const bool appended = run_script(folder, "import base64\nassert base64.b64decode(b'AA==AA==') == b'\\0'\n");
    for (const VtkData data : {VtkData::raw, VtkData::zlib, VtkData::lzma, VtkData::ascii}) {
        if (!appended && data != VtkData::ascii) continue;
        SCOPED_TRACE(name(data));
        ASSERT_TRUE(write_vtu(mesh, folder / "m.vtu", data));
        EXPECT_TRUE(run_script(folder, check)) << get(folder / "out.txt");
    }
    ASSERT_TRUE(write_vtu(mesh, folder / "m.vtu", appended ? VtkData::raw : VtkData::ascii));
    for (const char* how : {"binary=True, compression='zlib'", "binary=True, compression='lzma'",
                            "binary=True, compression=None", "binary=False"}) {
        SCOPED_TRACE(how);
        ASSERT_TRUE(run_script(folder, std::string("import meshio\nm = meshio.read('m.vtu')\n"
                                                   "meshio.vtu.write('n.vtu', m, ") +
                                           how + ")\n"))
            << get(folder / "out.txt");
        const Result<Mesh> read = read_vtk(folder / "n.vtu");
        ASSERT_TRUE(read) << read.error().message();
        if (std::string_view(how) == "binary=False") {  // it writes 11 digits
            EXPECT_EQ(read->cells, mesh.cells);
        } else {
            expect_same(*read, as_in_vtk(mesh));
        }
    }
}

}  // namespace
}  // namespace barycert::testing
