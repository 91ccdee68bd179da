// Maps written and read: round trips, the format, meshes that fit and that do not, rows that no map can hold.
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <limits>

#include "tests/io/map/maps.hpp"

namespace barycert::testing {
namespace {

Mesh two_cells() {
    Mesh mesh;
    mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
    mesh.cells = {0, 1, 2, 3, 1, 2, 3, 4};
    return mesh;
}

Mesh two_triangles() {
    Mesh mesh;
    mesh.dimension = 2;
    mesh.points = {0, 0, 1, 0, 0, 1, 1, 1};
    mesh.cells = {0, 1, 2, 1, 3, 2};
    return mesh;
}

TEST(MapFile, RoundTripInAnyPieces) {
    const TemporaryFolder folder;
    base::Random random(1);
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{7}, block_rows - 1, block_rows,
                                    block_rows + 1, 3 * block_rows, 3 * block_rows + 4321}) {
        for (const int dimension : {2, 3}) {
            SCOPED_TRACE(std::to_string(count) + " rows in " + std::to_string(dimension) + "D");
            const Mesh mesh = dimension == 2 ? two_triangles() : two_cells();
            const bool all = random.coin();
            Table rows;
            Result<MapWriter> writer = MapWriter::open(folder / "map", mesh, all);
            ASSERT_TRUE(writer);
            while (rows.cells.size() < count) {
                const Table piece = any_rows(random, dimension, mesh.cell_count(),
                                             std::min<std::size_t>(count - rows.cells.size(), random.below(9999)));
                ASSERT_TRUE(writer->write(piece.view()));
                append(rows, piece);
            }
            ASSERT_TRUE(writer->commit());
            EXPECT_TRUE(writer->commit());

            const Result<MapReader> reader = MapReader::open(folder / "map", mesh);
            ASSERT_TRUE(reader) << reader.error().message();
            EXPECT_EQ(reader->dimension(), dimension);
            EXPECT_EQ(reader->all(), all);
            EXPECT_EQ(reader->rows(), count);
            for (const std::size_t max : {std::size_t{1}, std::size_t{999}, block_rows, std::size_t{100000}}) {
                const Result<Table> read = read_map(folder / "map", mesh, max);
                ASSERT_TRUE(read) << read.error().message();
                EXPECT_TRUE(same(*read, rows));
            }
        }
    }
    EXPECT_EQ(folder.file_count(), 1U);
}

TEST(MapFile, BlocksAreFullUntilTheEnd) {
    const TemporaryFolder folder;
    base::Random random(2);
    const std::size_t count = 2 * block_rows + 5;
    ASSERT_TRUE(write_map(folder / "map", two_cells(), false, any_rows(random, 3, 2, count)));
    Result<MapReader> reader = MapReader::open(folder / "map", two_cells());
    ASSERT_TRUE(reader);
    MapReader moved = std::move(*reader);
    Table block;
    for (std::size_t left = count; left != 0;) {
        const std::size_t expected = std::min<std::size_t>(left, 5000);
        ASSERT_EQ(moved.read(5000, block).value(), expected);
        EXPECT_EQ(block.cells.size(), expected);
        EXPECT_EQ(block.points.size(), 3 * expected);
        EXPECT_EQ(block.features.size(), expected);
        left -= expected;
    }
    EXPECT_EQ(moved.read(5000, block).value(), 0U);
    EXPECT_EQ(moved.read(5000, block).value(), 0U);
    EXPECT_TRUE(block.cells.empty());
}

/// The bytes are those that the description in map.hpp asks for: files of today can be read tomorrow.
TEST(MapFile, BytesAreAsDescribed) {
    const TemporaryFolder folder;
    base::Random random(3);
    for (const std::size_t count : {std::size_t{0}, std::size_t{5}, block_rows, 2 * block_rows + 3}) {
        for (const int dimension : {2, 3}) {
            for (const bool all : {false, true}) {
                const Mesh mesh = dimension == 2 ? two_triangles() : two_cells();
                const Table rows = any_rows(random, dimension, 2, count);
                ASSERT_TRUE(write_map(folder / "map", mesh, all, rows));
                PlainMap plain(mesh, rows);
                plain.all = all ? 1 : 0;
                EXPECT_TRUE(get(folder / "map") == plain.bytes());
            }
        }
    }
    // Computed apart, from the description: were they to change, every map made before would be refused.
    EXPECT_EQ(mesh_fingerprint(two_cells()), 0xcdde86eecb7653a1ULL);
    EXPECT_EQ(mesh_fingerprint(two_triangles()), 0xf1845dae4f876dc6ULL);
    Mesh odd = two_triangles();
    odd.cells.resize(3);
    EXPECT_EQ(mesh_fingerprint(odd), 0x141cf677bcdfd100ULL);
}

TEST(MapFile, FieldsOfTheMeshMayChange) {
    const TemporaryFolder folder;
    base::Random random(4);
    const Mesh mesh = two_cells();
    const Table rows = any_rows(random, 3, 2, 20);
    ASSERT_TRUE(write_map(folder / "map", mesh, false, rows));
    Mesh other = mesh;
    other.point_fields = {{"t", 1, {1, 2, 3, 4, 5}}};
    other.cell_fields = {{"k", 1, {1, 2}}};
    other.point_markers = {1, 2, 3, 4, 5};
    other.faces = {0, 1, 2};
    other.neighbours = {1, -1, -1, -1, -1, -1, -1, 0};
    other.index_base = 1;
    other.points[0] = -0.0;
    const Result<Table> read = read_map(folder / "map", other);
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_TRUE(same(*read, rows));
}

TEST(MapFile, AnotherMeshIsRefused) {
    const TemporaryFolder folder;
    base::Random random(5);
    const Mesh mesh = two_cells();
    ASSERT_TRUE(write_map(folder / "map", mesh, false, any_rows(random, 3, 2, 20)));
    const auto refused = [&](const Mesh& other) {
        const Result<MapReader> reader = MapReader::open(folder / "map", other);
        if (reader) return std::string("accepted");
        EXPECT_EQ(reader.error().what, "the map was made for another mesh");
        EXPECT_EQ(reader.error().expected, "one of 5 nodes and 2 cells");
        EXPECT_EQ(reader.error().remedy, "name the mesh of the map, or create the map again for this mesh");
        return reader.error().found;
    };
    const std::string same_size = "one of that size with other coordinates or cells";
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        Mesh other = mesh;
        other.points[i] = std::nextafter(other.points[i], 2);
        EXPECT_EQ(refused(other), same_size);
    }
    for (std::size_t i = 0; i < mesh.cells.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            Mesh other = mesh;
            std::swap(other.cells[i], other.cells[j]);
            if (other.cells == mesh.cells) continue;
            EXPECT_EQ(refused(other), same_size);
        }
    }
    Mesh more = mesh;
    more.points.insert(more.points.end(), {2, 2, 2});
    EXPECT_EQ(refused(more), "one of 6 nodes and 2 cells");
    Mesh fewer = mesh;
    fewer.cells.resize(4);
    EXPECT_EQ(refused(fewer), "one of 5 nodes and 1 cells");
    EXPECT_EQ(refused(two_triangles()), "one of 4 nodes and 2 triangles");
    EXPECT_EQ(refused({}), "one of 0 nodes and 0 cells");
}

TEST(MapFile, RowsThatNoMapCanHold) {
    const TemporaryFolder folder;
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    struct Row {
        int dimension;
        std::vector<double> point;
        Mesh::Index cell;
        int feature;
        bool good;
    };
    const std::vector<Row> rows{{3, {0, 0, 0}, 1, 0, true},
                                {3, {0, 0, 0}, 0, 1, true},
                                {3, {0, 0, 0}, -1, 4, true},
                                {3, {0, 0, 0}, 2, 0, false},
                                {3, {0, 0, 0}, -2, 4, false},
                                {3, {0, 0, 0}, -2, 0, false},
                                {3, {0, 0, 0}, -1, 0, false},
                                {3, {0, 0, 0}, 1, 4, false},
                                {3, {0, 0, 0}, 1, 5, false},
                                {3, {0, 0, 0}, -1, 5, false},
                                {3, {0, 0, 0}, 1, 255, false},
                                {3, {0, nan, 0}, 1, 0, false},
                                {3, {0, 0, -inf}, -1, 4, true},
                                {2, {0, 0}, 1, 2, true},
                                {2, {0, 0}, 1, 1, false},
                                {2, {inf, 0}, 1, 2, false},
                                {3, {0, 0, 0}, 2147483647, 0, false}};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        SCOPED_TRACE(i);
        const Row& row = rows[i];
        const Mesh mesh = row.dimension == 2 ? two_triangles() : two_cells();
        Table bad;
        bad.points = row.point;
        bad.cells = {row.cell};
        bad.features = {static_cast<Feature>(row.feature)};
        put(folder / "map", "old");
        const Status written = write_map(folder / "map", mesh, false, bad);
        EXPECT_EQ(written.has_value(), row.good);
        EXPECT_EQ(get(folder / "map") == "old", !row.good);
        // The reader judges for itself, though every checksum fits.
        put(folder / "plain", PlainMap(mesh, bad).bytes());
        const Result<Table> read = read_map(folder / "plain", mesh);
        EXPECT_EQ(read.has_value(), row.good);
        if (!row.good) {
            EXPECT_EQ(written.error().what, "row 0 is not valid in a map");
            EXPECT_EQ(read.error().what, "row 0 is not valid in a map");
            EXPECT_EQ(read.error().expected, written.error().expected);
            EXPECT_FALSE(read.error().remedy.empty());
        }
    }
}

TEST(MapFile, AWriterThatFailedStaysSo) {
    const TemporaryFolder folder;
    const std::vector<double> point{0, 0, 0};
    const std::vector<Mesh::Index> cell{0};
    const std::vector<Feature> feature{Feature::vertex};
    {
        Result<MapWriter> writer = MapWriter::open(folder / "map", two_cells(), false);
        ASSERT_TRUE(writer);
        EXPECT_FALSE(writer->write({.points = point, .cells = cell}));
        EXPECT_FALSE(writer->write({.points = point, .cells = cell, .features = feature}));
        EXPECT_FALSE(writer->commit());
    }
    EXPECT_EQ(folder.file_count(), 0U);
    {
        Result<MapWriter> writer = MapWriter::open(folder / "map", two_cells(), false);
        ASSERT_TRUE(writer);
        EXPECT_FALSE(writer->write({.points = std::span(point).first(2), .cells = cell, .features = feature}));
        EXPECT_FALSE(writer->commit());
    }
    EXPECT_EQ(folder.file_count(), 0U);
    Result<MapWriter> writer = MapWriter::open(folder / "map", two_cells(), false);
    ASSERT_TRUE(writer);
    ASSERT_TRUE(writer->write({.points = point, .cells = cell, .features = feature}));
    ASSERT_TRUE(writer->commit());
    EXPECT_FALSE(writer->write({.points = point, .cells = cell, .features = feature}));
    EXPECT_EQ(read_map(folder / "map", two_cells()).value().cells.size(), 1U);
    // Dropped without a commit: nothing appears.
    { ASSERT_TRUE(MapWriter::open(folder / "other", two_cells(), false)); }
    EXPECT_EQ(folder.file_count(), 1U);
}

TEST(MapFile, PathsThatCannotBe) {
    const TemporaryFolder folder;
    const auto opens = [&](const std::string& path) { return MapWriter::open(path, two_cells(), false); };
    EXPECT_EQ(opens(folder / "none/map").error().remedy, "make the folder first, or name another one");
    EXPECT_EQ(opens(folder / "").error().remedy, "name a file, not a folder");
    EXPECT_EQ(opens("/dev/null").error().what, "cannot write a map to a pipe or device");
    const auto reads = [&](const std::string& path) { return MapReader::open(path, two_cells()); };
    EXPECT_EQ(reads(folder / "none").error().found, "No such file or directory");
    EXPECT_EQ(reads(folder / "").error().remedy, "name a file inside the folder");
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_EQ(reads(folder / "pipe").error().found, "a pipe or device");
}

TEST(MapFile, AFullDiskLeavesTheTarget) {
    const TemporaryFolder folder;
    put(folder / "map", "old");
    base::Random random(6);
    const Table rows = any_rows(random, 3, 2, 20000);  // 580 kB
    struct rlimit before {};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    int failed_writes = 0;
    // The last of these is a byte too few: the header itself still fits, its place is at the beginning.
    const std::size_t whole = PlainMap(two_cells(), rows).bytes().size();
    std::vector<Error> errors;
    for (const std::size_t limit : {std::size_t{0}, std::size_t{100}, std::size_t{300000}, whole - 1}) {
        const struct rlimit small { limit, before.rlim_max };
        ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
        Result<MapWriter> writer = MapWriter::open(folder / "map", two_cells(), false);
        const Status written = writer ? writer->write(rows.view()) : Status(writer.error());
        failed_writes += !written;
        const Status committed = writer ? writer->commit() : written;
        ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
        ASSERT_FALSE(committed);
        errors.push_back(committed.error());
    }
    const struct rlimit enough { whole, before.rlim_max };
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &enough), 0);
    const Status committed = write_map(folder / "new", two_cells(), false, rows);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, handler);
    for (const Error& e : errors) EXPECT_EQ(e.remedy, "free some space, or write to another disk");
    EXPECT_GE(failed_writes, 2);  // told while writing, not at the end alone
    EXPECT_EQ(get(folder / "map"), "old");
    EXPECT_TRUE(committed);
    EXPECT_EQ(folder.file_count(), 2U);
}

}  // namespace
}  // namespace barycert::testing
