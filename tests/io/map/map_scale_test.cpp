// Five million rows in the memory of a few blocks.
#include <chrono>

#include "tests/io/map/maps.hpp"
#include "tests/sanitized.hpp"

namespace barycert::testing {
namespace {

/// The most memory held since the last forget(), in KiB; -1 where the system does not tell.
struct Peak {
    static void forget() { std::ofstream("/proc/self/clear_refs") << 5; }
    static long now() {
        std::ifstream in("/proc/self/status");
        for (std::string word; in >> word;) {
            long value = -1;
            if (word == "VmHWM:" && in >> value) return value;
        }
        return -1;
    }
};

TEST(MapScale, MemoryDoesNotGrowWithRows) {
    constexpr std::size_t pieces = 500, piece_rows = 10000;
    constexpr double row_count = 1.0 * pieces * piece_rows;
    const TemporaryFolder folder;
    base::Random random(13);
    Mesh mesh;
    mesh.points = any_doubles(random, 3000);
    mesh.cells = any_indices(random, 4000, 1000);
    // Every piece differs from the others by its first row alone.
    Table piece = any_rows(random, 3, 1000, piece_rows), block;

    Peak::forget();
    const long before = Peak::now();
    const auto start = std::chrono::steady_clock::now();
    Result<MapWriter> writer = MapWriter::open(folder / "map", mesh, false);
    ASSERT_TRUE(writer);
    for (std::size_t k = 0; k < pieces; ++k) {
        piece.points[0] = static_cast<double>(k);
        ASSERT_TRUE(writer->write(piece.view()));
    }
    ASSERT_TRUE(writer->commit());
    const auto middle = std::chrono::steady_clock::now();
    Result<MapReader> reader = MapReader::open(folder / "map", mesh);
    ASSERT_TRUE(reader);
    EXPECT_EQ(reader->rows(), pieces * piece_rows);
    for (std::size_t k = 0; k < pieces; ++k) {
        ASSERT_EQ(reader->read(piece_rows, block).value(), piece_rows);
        piece.points[0] = static_cast<double>(k);
        ASSERT_TRUE(block.points == piece.points && block.cells == piece.cells && block.features == piece.features);
    }
    EXPECT_EQ(reader->read(piece_rows, block).value(), 0U);
    const auto end = std::chrono::steady_clock::now();
    const long grown = Peak::now() - before;

    const auto size = std::filesystem::file_size(folder / "map");
    const std::size_t blocks = (pieces * piece_rows + block_rows - 1) / block_rows;
    EXPECT_EQ(size, 56 + 29 * pieces * piece_rows + 8 * blocks);
    const auto ns = [&](auto from, auto to) {
        return std::to_string(std::chrono::duration<double, std::nano>(to - from).count() / row_count);
    };
    RecordProperty("ns a row, written", ns(start, middle));
    RecordProperty("ns a row, read", ns(middle, end));
    RecordProperty("KiB more", std::to_string(grown));
    if (testing::sanitized) return;
    // All rows are 140 MiB; a block of 10000 and the buffers of writer and reader are well below 1 MiB each.
    EXPECT_LT(grown, 8 << 10);
    EXPECT_GT(before, 0);
}

}  // namespace
}  // namespace barycert::testing
