// Damaged files: an error or the right mesh, never a crash. Run under sanitizers too.
#include "tests/io/tetgen/mesh_files.hpp"
#include "tests/io/tetgen/random_mesh.hpp"

namespace barycert::testing {
namespace {

const char* const suffixes[] = {".node", ".ele", ".face", ".neigh"};

Mesh small_mesh() {
    Mesh mesh;
    mesh.index_base = 1;
    mesh.points = {0, 0, 0, 1.25, 0, 0, 0, 1e-3, 0, 0, 0, 12345.678, 1, 1, 1};
    mesh.cells = {0, 1, 2, 3, 1, 2, 3, 4};
    mesh.point_fields = {{"attribute0", 1, {1.5, 22.25, -3, 4, 55}}};
    mesh.point_markers = {10, 0, -12, 13, 14};
    mesh.cell_fields = {{"attribute0", 1, {0.5, 12}}};
    mesh.faces = {0, 1, 2};
    mesh.face_mid_nodes = {1, 2, 3};
    mesh.face_markers = {11};
    mesh.neighbours = {1, -1, -1, -1, -1, -1, -1, 0};
    return mesh;
}

TEST(Damage, AFileCutAnywhere) {
    const Mesh mesh = small_mesh();
    for (const char* comment : {"", "the end"}) {
        const TemporaryFolder folder;
        ASSERT_TRUE(write_tetgen(mesh, folder / "m", {.comment = comment}));
        int whole = 0;
        for (const char* suffix : suffixes) {
            const std::string file = folder / ("m" + std::string(suffix));
            const std::string text = get(file);
            for (std::size_t size = 0; size < text.size(); ++size) {
                SCOPED_TRACE(suffix + std::to_string(size));
                put(file, text.substr(0, size));
                const Result<Mesh> read = read_tetgen(folder / "m", {.threads = 2});
                whole += read.has_value();
                if (read) expect_same(*read, mesh);
            }
            put(file, text);
        }
        // Only the comment can be missing: its 10 bytes, in each of the files.
        EXPECT_EQ(whole, *comment == '\0' ? 0 : 40);
    }
}

TEST(Damage, RandomBytes) {
    constexpr std::string_view alphabet = "0123456789999  \n\n\r\t,+-.#;eEdDnx\xFF\xEF";
    const TemporaryFolder folder;
    ASSERT_TRUE(write_tetgen(small_mesh(), folder / "m", {.comment = "the end"}));
    std::vector<std::string> texts;
    for (const char* suffix : suffixes) texts.push_back(get(folder / ("m" + std::string(suffix))));
    int accepted = 0;
    for (std::uint64_t seed = 0; seed < 6000; ++seed) {
        base::Random random(seed);
        const std::size_t which = random.below(4);
        const std::string file = folder / ("m" + std::string(suffixes[which]));
        std::string text = texts[which];
        for (std::uint64_t i = 1 + random.below(4); i > 0; --i) {
            const std::size_t place = random.below(text.size());
            const char byte =
                random.coin() ? alphabet[random.below(alphabet.size())] : static_cast<char>(random.below(256));
            switch (random.below(3)) {
                case 0:
                    text[place] = byte;
                    break;
                case 1:
                    text.insert(place, 1, byte);
                    break;
                default:
                    text.erase(place, 1 + random.below(3));
            }
        }
        put(file, text);
        const Result<Mesh> one = read_tetgen(folder / "m", {.threads = 1});
        const Result<Mesh> two = read_tetgen(folder / "m", {.threads = 2});
        put(file, texts[which]);
        ASSERT_EQ(one.has_value(), two.has_value());
        if (one) {
            ++accepted;
            expect_same(*one, *two);
            for (const Mesh::Index corner : one->cells) ASSERT_LT(static_cast<std::size_t>(corner), one->point_count());
            const TemporaryFolder again;  // whatever is read is a mesh that can be written
            EXPECT_TRUE(write_tetgen(*one, again / "m"));
        } else {
            EXPECT_EQ(one.error().message(), two.error().message());
            EXPECT_FALSE(one.error().what.empty());
            EXPECT_NE(one.error().line, 0U);
            // The words for "refused, but no reason found" fit one case only: a row without line end.
            if (one.error().what.starts_with("the last row has no line end")) {
                EXPECT_FALSE(text.ends_with('\n'));
            }
        }
    }
    EXPECT_GT(accepted, 100);
    EXPECT_LT(accepted, 3000);
}

/// A file of several blocks is read in parts; behind a comment longer than its first block it is read whole. Both must
/// say the same, of good files and of damaged ones, also where damage, blank lines or comments lie across the bounds of
/// blocks.
TEST(Damage, ReadInPartsAsReadWhole) {
    constexpr std::size_t block = std::size_t{1} << 19;
    constexpr std::string_view alphabet = "0123456789 \n\r\t,+-.#eEx";
    const TemporaryFolder folder;
    const std::string node = folder / "m.node";
    std::string comment = "#";
    while (comment.size() < block / 4) comment += " c";
    comment += '\n';
    put(folder / "m.ele", "1 4 0\n0 0 1 2 3\n");
    std::string good = "80000 3 0 0\n";
    for (int i = 0; i < 80000; ++i) good += std::to_string(i) + ' ' + std::to_string(i % 7) + ".5 0.25 1e-3\n";
    ASSERT_GT(good.size(), 3 * block);
    int refused = 0;
    for (int n = 0; n < 150; ++n) {
        base::Random random(static_cast<std::uint64_t>(n));
        std::string text = good;
        const std::size_t bound = block * (1 + random.below(3)), near = bound - 60 + random.below(120);
        if (n % 5 == 1) text.insert(good.find('\n', near) + 1, std::string(random.below(9000), "\n #"[n % 3]) + '\n');
        if (n % 5 == 2)
            text.insert(good.find('\n', near) + 1, "# 7 " + std::string(random.below(2 * block), '1') + '\n');
        if (n % 5 == 3) text[near] = alphabet[random.below(alphabet.size())];
        if (n % 5 == 4) text.resize(n % 2 == 0 ? near : random.below(good.size()));
        put(node, text);
        const Result<Mesh> parts = read_tetgen(node, {.threads = 2});
        put(node, comment + text);
        const Result<Mesh> whole = read_tetgen(node, {.threads = 1});
        ASSERT_EQ(parts.has_value(), whole.has_value()) << n;
        if (parts) {
            expect_same(*parts, *whole);
            continue;
        }
        ++refused;
        EXPECT_EQ(parts.error().line + 1, whole.error().line) << n;
        EXPECT_EQ(parts.error().what + parts.error().expected + parts.error().found + parts.error().remedy,
                  whole.error().what + whole.error().expected + whole.error().found + whole.error().remedy)
            << n;
    }
    EXPECT_GT(refused, 30);
    EXPECT_LT(refused, 75);
}

}  // namespace
}  // namespace barycert::testing
