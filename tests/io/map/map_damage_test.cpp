// Damaged maps: always an error with a remedy, never a crash and never a wrong row.
#include "tests/io/map/maps.hpp"

namespace barycert::testing {
namespace {

Mesh small_mesh(int dimension) {
    base::Random random(dimension == 2 ? 21 : 31);
    Mesh mesh;
    mesh.dimension = dimension;
    mesh.points = any_doubles(random, 9 * static_cast<std::size_t>(dimension));
    mesh.cells = any_indices(random, 5 * mesh.corners(), 9);
    return mesh;
}

/// Reads what it can; rows that are given must be those of `rows`, from the first on. True if all was accepted.
bool accepted(const std::string& path, const Mesh& mesh, const Table& rows, std::size_t max = 3) {
    Result<MapReader> reader = MapReader::open(path, mesh);
    if (!reader) {
        EXPECT_FALSE(reader.error().remedy.empty()) << reader.error().message();
        EXPECT_EQ(reader.error().file, path);
        return false;
    }
    const auto dimension = static_cast<std::size_t>(mesh.dimension);
    Table got, block;
    while (true) {
        const Result<std::size_t> count = reader->read(max, block);
        if (!count) {
            EXPECT_FALSE(count.error().remedy.empty()) << count.error().message();
            EXPECT_TRUE(block.cells.empty() && block.points.empty() && block.features.empty());
            const Result<std::size_t> again = reader->read(max, block);
            EXPECT_FALSE(again.has_value());
        }
        if (!count || *count == 0) {
            EXPECT_LE(got.cells.size(), rows.cells.size());
            Table start = rows;
            start.points.resize(dimension * got.cells.size());
            start.cells.resize(got.cells.size());
            start.features.resize(got.cells.size());
            EXPECT_TRUE(same(got, start)) << "a wrong row";
            return count.has_value();
        }
        append(got, block);
    }
}

TEST(MapDamage, EveryBitCounts) {
    const TemporaryFolder folder;
    base::Random random(7);
    for (const int dimension : {2, 3}) {
        for (const std::size_t count : {0U, 1U, 6U}) {
            const Mesh mesh = small_mesh(dimension);
            const Table rows = any_rows(random, dimension, 5, count);
            ASSERT_TRUE(write_map(folder / "map", mesh, true, rows));
            const std::string text = get(folder / "map");
            ASSERT_TRUE(accepted(folder / "map", mesh, rows));
            for (std::size_t bit = 0; bit < 8 * text.size(); ++bit) {
                std::string other = text;
                other[bit / 8] = static_cast<char>(other[bit / 8] ^ 1 << bit % 8);
                put(folder / "map", other);
                ASSERT_FALSE(accepted(folder / "map", mesh, rows)) << "bit " << bit;
            }
        }
    }
}

TEST(MapDamage, EveryBitNearTheEndsOfBlocks) {
    const TemporaryFolder folder;
    base::Random random(8);
    const Mesh mesh = small_mesh(3);
    const Table rows = any_rows(random, 3, 5, 2 * block_rows + 1);
    ASSERT_TRUE(write_map(folder / "map", mesh, false, rows));
    const std::string text = get(folder / "map");
    const std::size_t block = 29 * block_rows + 8;
    ASSERT_EQ(text.size(), 56 + 2 * block + 32 + 8);
    for (const std::size_t at : {56 + block - 8, 56 + block, 56 + 2 * block - 1, 56 + 2 * block, text.size() - 9}) {
        for (int bit = 0; bit < 8; ++bit) {
            std::string other = text;
            other[at] = static_cast<char>(other[at] ^ 1 << bit);
            put(folder / "map", other);
            ASSERT_FALSE(accepted(folder / "map", mesh, rows, 5000)) << "byte " << at << ", bit " << bit;
        }
    }
}

TEST(MapDamage, AMapCutOffOrWithMore) {
    const TemporaryFolder folder;
    base::Random random(9);
    for (const std::size_t count : {std::size_t{0}, std::size_t{6}, block_rows + 2}) {
        const Mesh mesh = small_mesh(3);
        const Table rows = any_rows(random, 3, 5, count);
        ASSERT_TRUE(write_map(folder / "map", mesh, false, rows));
        const std::string text = get(folder / "map");
        const std::size_t step = count > 100 ? 1009 : 1;
        for (std::size_t size = 0; size < text.size(); size += step) {
            put(folder / "map", text.substr(0, size));
            const Result<MapReader> reader = MapReader::open(folder / "map", mesh);  // told before any row
            ASSERT_FALSE(reader) << "cut to " << size;
            ASSERT_EQ(reader.error().what, size == 0 ? "not a map" : "the map is cut off") << "cut to " << size;
        }
        for (const std::size_t more : {1U, 8U, 40U, 100000U}) {
            put(folder / "map", text + std::string(more, '\0'));
            const Result<MapReader> reader = MapReader::open(folder / "map", mesh);
            ASSERT_FALSE(reader);
            ASSERT_EQ(reader.error().what, "the map has bytes after its end");
        }
    }
}

TEST(MapDamage, CutOffOrChangedWhileItIsRead) {
    const TemporaryFolder folder;
    base::Random random(10);
    const Mesh mesh = small_mesh(3);
    ASSERT_TRUE(write_map(folder / "map", mesh, false, any_rows(random, 3, 5, 3 * block_rows)));
    Result<MapReader> reader = MapReader::open(folder / "map", mesh);
    ASSERT_TRUE(reader);
    Table block;
    ASSERT_EQ(reader->read(block_rows, block).value(), block_rows);
    std::filesystem::resize_file(folder / "map", 300000);
    const Result<std::size_t> cut = reader->read(block_rows, block);
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().what, "the map is cut off");
    EXPECT_TRUE(block.cells.empty());
}

/// Blocks carry their place: with each other's content, or with that of another map of the same mesh, they are refused.
TEST(MapDamage, BlocksOutOfPlace) {
    const TemporaryFolder folder;
    base::Random random(11);
    const Mesh mesh = small_mesh(2);
    const Table rows = any_rows(random, 2, 5, 3 * block_rows), others = any_rows(random, 2, 5, 3 * block_rows);
    ASSERT_TRUE(write_map(folder / "map", mesh, false, rows));
    ASSERT_TRUE(write_map(folder / "other", mesh, false, others));
    const std::string text = get(folder / "map"), other = get(folder / "other");
    const std::size_t size = 21 * block_rows + 8;
    ASSERT_EQ(text.size(), 56 + 3 * size);
    const auto block = [&](const std::string& of, std::size_t k) { return of.substr(56 + k * size, size); };
    const std::string head = text.substr(0, 56);
    put(folder / "map", head + block(text, 0) + block(text, 1) + block(text, 2));
    EXPECT_TRUE(accepted(folder / "map", mesh, rows, 5000));
    for (const std::string& blocks :
         {block(text, 1) + block(text, 0) + block(text, 2), block(text, 0) + block(text, 2) + block(text, 1),
          block(text, 0) + block(text, 0) + block(text, 2), block(text, 0) + block(other, 1) + block(text, 2),
          block(text, 0) + block(text, 1) + block(other, 2)}) {
        put(folder / "map", head + blocks);
        EXPECT_FALSE(accepted(folder / "map", mesh, rows, 5000));
    }
}

TEST(MapDamage, HeadersThatLie) {
    const TemporaryFolder folder;
    base::Random random(12);
    const Mesh mesh = small_mesh(3);
    const Table rows = any_rows(random, 3, 5, 6);
    const PlainMap good(mesh, rows);
    const auto what = [&](const PlainMap& map) {
        put(folder / "map", map.bytes());
        const Result<MapReader> reader = MapReader::open(folder / "map", mesh);
        return reader ? std::string() : reader.error().what;
    };
    EXPECT_EQ(what(good), "");
    PlainMap map = good;
    map.version = 2;
    EXPECT_EQ(what(map), "a map of another version");
    map.version = 1U << 24;  // 1 in big-endian order
    EXPECT_EQ(what(map), "a map of another version");
    map = good;
    map.magic[3] = 'X';
    EXPECT_EQ(what(map), "not a map");
    map = good;
    map.all = 2;
    EXPECT_EQ(what(map), "the header of the map is damaged");
    map = good;
    map.taken = 1;
    EXPECT_EQ(what(map), "the map was made of cells taken otherwise");
    map.taken = 8;
    EXPECT_EQ(what(map), "the header of the map is damaged");
    map = good;
    map.dimension = 4;
    map.points.resize(24);
    EXPECT_EQ(what(map), "the header of the map is damaged");
    map = good;
    map.row_count = 5;
    EXPECT_EQ(what(map), "the map has bytes after its end");
    for (const std::uint64_t count : {std::uint64_t{7}, std::uint64_t{1} << 40, std::uint64_t{1} << 63,
                                      ~std::uint64_t{0}, std::uint64_t{0x8d3dcb08d3dcb09}}) {
        map = good;
        map.row_count = count;
        EXPECT_EQ(what(map), "the map is cut off");
    }
    map = good;
    map.nodes = 8;
    EXPECT_EQ(what(map), "the map was made for another mesh");
    map = good;
    map.cell_count = ~std::uint64_t{0};
    EXPECT_EQ(what(map), "the map was made for another mesh");
    map = good;
    map.fingerprint ^= 1;
    EXPECT_EQ(what(map), "the map was made for another mesh");
    for (const std::string& text :
         {std::string("x,y,z\n0,0,0\n"), std::string(1000, '\0'), std::string("\x89PNG\r\n"), std::string(1, 'x')}) {
        put(folder / "map", text);
        const Result<MapReader> reader = MapReader::open(folder / "map", mesh);
        ASSERT_FALSE(reader);
        EXPECT_EQ(reader.error().what, "not a map");
    }
}

TEST(MapDamage, RandomChanges) {
    const TemporaryFolder folder;
    int changed = 0;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        base::Random random(seed);
        const int dimension = random.integer(2, 3);
        const Mesh mesh = small_mesh(dimension);
        const Table rows = any_rows(random, dimension, 5, random.below(40));
        const std::string text = PlainMap(mesh, rows).bytes();
        std::string other = text;
        for (std::uint64_t i = 1 + random.below(6); i > 0; --i) {
            const std::size_t at = random.below(other.size());
            const std::size_t length = std::min<std::size_t>(other.size() - at, random.below(20));
            switch (random.below(5)) {
                case 0:
                    other[at] = static_cast<char>(random.below(256));
                    break;
                case 1:
                    other.erase(at, length);
                    break;
                case 2:
                    other.insert(at, std::string(length, static_cast<char>(random.below(256))));
                    break;
                case 3:
                    other.replace(random.below(other.size() - length + 1), length, other.substr(at, length));
                    break;
                default:
                    other.resize(at + 1);
            }
        }
        if (other == text) continue;
        ++changed;
        put(folder / "map", other);
        ASSERT_FALSE(accepted(folder / "map", mesh, rows, 7)) << "seed " << seed;
    }
    EXPECT_GT(changed, 3000);
}

/// Random content behind checksums that fit: rows that no map can hold are refused, others are given as they stand.
TEST(MapDamage, RandomContentWithChecksumsThatFit) {
    const TemporaryFolder folder;
    const Mesh mesh = small_mesh(3);
    int good = 0, bad = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        base::Random random(seed);
        const Table rows = any_rows(random, 3, 5, 4);
        PlainMap map(mesh, rows);
        const std::size_t at = random.below(4);
        switch (random.below(3)) {
            case 0:
                map.cells[at] =
                    random.coin()
                        ? random.integer(-2, 6)  // the last cell and one more among them
                        : static_cast<std::int32_t>(static_cast<std::uint32_t>(random.bits() >> random.below(64)));
                break;
            case 1:
                map.features[at] = static_cast<std::uint8_t>(random.bits() >> random.below(64));
                break;
            default:
                map.points[3 * at] = std::bit_cast<double>(random.bits() | (random.coin() ? 0x7ff0ULL << 48 : 0));
        }
        bool fits = true;
        for (std::size_t i = 0; i < 4; ++i) {
            fits = fits && map.cells[i] >= -1 && map.cells[i] < 5 && map.features[i] < 5;
            fits = fits && (map.cells[i] == -1) == (map.features[i] == 4);
            fits = fits && (map.cells[i] == -1 || std::isfinite(map.points[3 * i]));
        }
        put(folder / "map", map.bytes());
        const Result<Table> read = read_map(folder / "map", mesh, 3);
        ASSERT_EQ(read.has_value(), fits) << "seed " << seed;
        (fits ? good : bad) += 1;
    }
    EXPECT_GT(good, 200);
    EXPECT_GT(bad, 200);
}

}  // namespace
}  // namespace barycert::testing
