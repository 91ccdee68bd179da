/// Small files cut off at every byte, and with every byte changed: an error, or a mesh; soon, and in little memory.
#include <sys/resource.h>

#include <chrono>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "core/base/random.hpp"
#include "io/vtk/packed.hpp"
#include "tests/io/tetgen/mesh_files.hpp"
#include "tests/io/vtk/mesh_notes.hpp"
#include "tests/sanitized.hpp"

namespace barycert::testing {
namespace {

Mesh small_mesh() {
    Mesh mesh;
    mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0.1, 1, 1, 1};
    mesh.cells = {0, 1, 2, 3, 1, 2, 3, 4};
    mesh.point_fields = {{"T", 1, {1, 2, 3, 4, 5}}};
    mesh.cell_labels = {{"id", std::vector<std::int64_t>{9007199254740993, 1}},
                        {"s", std::vector<std::string>{"ab", ""}}};
    return mesh;
}

bool is_same(const Mesh& a, const Mesh& b) {
    return a.cells == b.cells && bits_of(a.points) == bits_of(b.points) && a.point_fields.size() == 1 &&
           bits_of(a.point_fields[0].data) == bits_of(b.point_fields[0].data);
}

long peak_kilobytes() {
    struct rusage usage {};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

struct Damage {
    const char* name;
    VtkData data;
};

TEST(VtkDamage, AtEveryByte) {
    const Mesh mesh = small_mesh();
    const TemporaryFolder folder;
    const auto start = std::chrono::steady_clock::now();
    const long before = peak_kilobytes();
    for (const auto& [name, data] :
         {Damage{"m.vtu", VtkData::raw}, Damage{"m.vtu", VtkData::zlib}, Damage{"m.vtu", VtkData::lz4},
          Damage{"m.vtu", VtkData::lzma}, Damage{"m.vtu", VtkData::ascii}, Damage{"m.vtk", VtkData::raw},
          Damage{"m.vtk", VtkData::ascii}}) {
        SCOPED_TRACE(std::string(name) + " " + std::string(barycert::name(data)));
        ASSERT_TRUE(write_vtk(mesh, folder / name, data));
        const std::string whole = get(folder / name);
        const std::string path = folder / (std::string("d") + name);
        std::size_t good = 0;
        // Behind the numbers of a raw file nothing is looked at.
        for (std::size_t size = 0; size < whole.size(); ++size) {
            put(path, whole.substr(0, size));
            const Result<Mesh> read = read_vtk(path);
            if (read) {
                ++good;
                EXPECT_TRUE(is_same(*read, mesh) || std::string_view(name) == "m.vtk") << size;
            } else {
                EXPECT_EQ(read.error().file, path);
            }
        }
        EXPECT_LT(good, whole.size() / 4);
        for (std::size_t at = 0; at < whole.size(); ++at) {
            for (const unsigned flip : {1U, 0x10U, 0x80U}) {
                std::string text = whole;
                text[at] = static_cast<char>(static_cast<unsigned char>(text[at]) ^ flip);
                put(path, text);
                const Result<Mesh> read = read_vtk(path);
                if (!read) {
                    EXPECT_FALSE(read.error().what.empty());
                }
                (void)read_vtk_points(path, 3).has_value();
            }
        }
    }
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 300);
    // A sanitizer keeps what was freed for a while.
    if (!sanitized) {
        EXPECT_LT(peak_kilobytes() - before, 400L << 10);
    }
}

/// Compressed data whose checksum catches a change, or that give another size, are errors: never other numbers.
TEST(VtkDamage, AChangedByteOfZlibDataIsFound) {
    Mesh mesh = mesh_of_data("plate");
    const TemporaryFolder folder;
    ASSERT_TRUE(write_vtu(mesh, folder / "m.vtu", VtkData::zlib));
    const std::string whole = get(folder / "m.vtu");
    const std::size_t data = whole.find("<AppendedData");
    std::size_t wrong = 0;
    for (std::size_t at = data + 40; at + 40 < whole.size(); at += 3) {
        std::string text = whole;
        text[at] = static_cast<char>(text[at] ^ 4);
        put(folder / "d.vtu", text);
        const Result<Mesh> read = read_vtk(folder / "d.vtu");
        if (read && !(read->cells == mesh.cells && read->points == mesh.points)) ++wrong;
    }
    EXPECT_EQ(wrong, 0U);
}

/// Few bytes that claim many numbers.
TEST(VtkDamage, HeadersThatLie) {
    const TemporaryFolder folder;
    const long before = peak_kilobytes();
    const auto head = [](const char* compressor) {
        return std::string("<VTKFile type='UnstructuredGrid' header_type='UInt64' ") + compressor +
               "><UnstructuredGrid><Piece NumberOfPoints='100000000' NumberOfCells='0'><Points><DataArray "
               "type='Float64' "
               "NumberOfComponents='3' format='appended' offset='0'/></Points></Piece></UnstructuredGrid>"
               "<AppendedData encoding='raw'>_";
    };
    const auto words = [](const std::vector<std::uint64_t>& all) {
        return std::string(reinterpret_cast<const char*>(all.data()), all.size() * 8);
    };
    const std::uint64_t size = 2400000000U;
    for (const char* name : {"", "compressor='vtkZLibDataCompressor'", "compressor='vtkLZ4DataCompressor'",
                             "compressor='vtkLZMADataCompressor'"}) {
        for (const std::vector<std::uint64_t>& header : {std::vector<std::uint64_t>{size},
                                                         {1, size, 0, 50},
                                                         {1, size, size, 50},
                                                         {1000, size / 1000, 0, 1, 1, 1}}) {
            put(folder / "m.vtu", head(name) + words(header) + std::string(400, 'x') + "</AppendedData></VTKFile>");
            EXPECT_FALSE(read_vtk_points(folder / "m.vtu", 3));
        }
    }
    EXPECT_LT(peak_kilobytes() - before, 200L << 10);
}

/// A bound that is too low would refuse files: the most that each compressor makes of a byte is near its bound, and
/// below.
TEST(VtkDamage, WhatCompressedBytesCanHold) {
    const std::string zeros(std::size_t{1} << 25, '\0');
    const auto ratio = [&](VtkData compressor) {
        const std::string packed = io::pack(compressor, zeros);
        EXPECT_LE(zeros.size(), io::max_unpacked(compressor, packed.size()));
        std::string again(zeros.size(), 'x');
        EXPECT_TRUE(io::unpack(compressor, packed, again.data(), again.size()));
        EXPECT_TRUE(again == zeros);
        return static_cast<double>(zeros.size()) / static_cast<double>(packed.size());
    };
    EXPECT_GT(ratio(VtkData::zlib), 900);
    EXPECT_GT(ratio(VtkData::lz4), 250);
    EXPECT_GT(ratio(VtkData::lzma), 6600);
}

/// A file that is read in parts: its first block leads up to raw data. Behind a comment as long as a block it is read
/// whole. Both must say the same, of the good file and of each damaged one.
TEST(VtkDamage, ReadInPartsAsReadWhole) {
    constexpr std::size_t many = 40000;
    const std::string comment = "<!--" + std::string(std::size_t{1} << 17, 'c') + "-->";
    Mesh mesh = small_mesh();
    mesh.cell_labels.clear();
    for (std::size_t i = mesh.point_count(); i < many; ++i) {
        const auto x = static_cast<double>(i);
        mesh.points.insert(mesh.points.end(), {x, x * 0.1, -x});
        mesh.point_fields[0].data.push_back(1 / x);
        const auto node = static_cast<Mesh::Index>(i);
        mesh.cells.insert(mesh.cells.end(), {node - 3, node - 2, node - 1, node});
    }
    const TemporaryFolder folder;
    const std::string path = folder / "m.vtu";
    base::Random random(35);
    for (const VtkData data : {VtkData::raw, VtkData::zlib, VtkData::lz4, VtkData::lzma}) {
        SCOPED_TRACE(barycert::name(data));
        ASSERT_TRUE(write_vtu(mesh, path, data));
        const std::string good = get(path);
        ASSERT_GT(good.size(), std::size_t{1} << 17);
        const std::size_t behind_tag = good.find(">\n") + 1, numbers = good.find('_');
        ASSERT_LT(numbers, std::size_t{1} << 15);
        std::size_t refused = 0;
        for (int n = 0; n < 120; ++n) {
            std::string text = good;
            if (n % 3 == 1) text.resize(numbers + random.below(good.size() - numbers));
            for (int k = 0; k < n % 3 * 2; ++k) {
                const std::size_t at = n % 2 == 0 ? numbers + random.below(64)
                                                  : behind_tag + 1 + random.below(good.size() - behind_tag - 1);
                if (at < text.size()) text[at] = static_cast<char>(text[at] ^ 1 << random.below(8));
            }
            put(path, text);
            const Result<Mesh> parts = read_vtk(path);
            put(path, text.insert(behind_tag, comment));
            const Result<Mesh> whole = read_vtk(path);
            ASSERT_EQ(parts.has_value(), whole.has_value()) << n;
            if (parts) {
                expect_same(*parts, *whole);
            } else {
                ++refused;
                EXPECT_EQ(parts.error().message(), whole.error().message()) << n;
            }
            if (n == 0) {
                ASSERT_TRUE(parts);
                EXPECT_TRUE(is_same(*parts, mesh));
            }
        }
        EXPECT_GT(refused, 30U);
        EXPECT_LT(refused, 115U);
    }
}

}  // namespace
}  // namespace barycert::testing
