// Files cut and changed at every byte: an error or a mesh, the same on any number of threads. Run under sanitizers too.
#include "tests/io/gmsh/msh_files.hpp"

namespace barycert::testing {
namespace {

Msh small() {
    Msh msh = two_tetrahedra();
    msh.views = {{"NodeData", "T", 0, 0, 1, {{50, {1.5}}, {7, {2}}, {9, {3}}, {8, {4}}, {1000, {5}}, {3, {-6}}}},
                 {"ElementData", "c", 0, 0, 3, {{10, {1, 2, 3}}, {20, {4, 5, 6}}}}};
    return msh;
}

/// Whatever is read is whole: it can be written and read again.
void expect_whole(const Mesh& mesh) {
    const TemporaryFolder folder;
    for (const Mesh::Index node : mesh.cells) ASSERT_LT(static_cast<std::size_t>(node), mesh.point_count());
    const Status written = write_gmsh(mesh, folder / "again.msh");
    if (written) {
        EXPECT_TRUE(read_gmsh(folder / "again.msh"));
    } else {  // names may have got quotes, or be gone
        EXPECT_TRUE(written.error().what.starts_with("a name of ")) << written.error().what;
    }
}

TEST(GmshDamage, CutAnywhere) {
    for (const MshKind& kind : msh_kinds) {
        SCOPED_TRACE(name_of(kind));
        const std::string bytes = MshBytes(small(), kind.version, kind.form).bytes();
        const Mesh whole = read_bytes(bytes).value();
        const TemporaryFolder folder;
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            put(folder / "m.msh", bytes.substr(0, size));
            const Result<Mesh> read = read_gmsh(folder / "m.msh", {.step = {}, .threads = 2});
            if (!read) {
                EXPECT_FALSE(read.error().what.empty());
                continue;
            }
            // All but the views are there, or only the last line end is not.
            EXPECT_EQ(read->points, whole.points);
            EXPECT_EQ(read->cells, whole.cells);
            EXPECT_TRUE(bytes.substr(0, size).ends_with("Data\n") || bytes.substr(0, size).ends_with("Data") ||
                        bytes.substr(0, size).ends_with("$EndElements") ||
                        bytes.substr(0, size).ends_with("$EndElements\n"))
                << size;
        }
    }
}

TEST(GmshDamage, ChangedAnywhere) {
    constexpr std::string_view alphabet = "0123456789 \n\r-.$eEn\xFF";
    for (const MshKind& kind : msh_kinds) {
        SCOPED_TRACE(name_of(kind));
        const std::string bytes = MshBytes(small(), kind.version, kind.form).bytes();
        const TemporaryFolder folder;
        base::Random random(static_cast<std::uint64_t>(kind.version));
        int accepted = 0, refused = 0;
        for (std::size_t place = 0; place < bytes.size(); ++place) {
            for (int way = 0; way < 3; ++way) {
                std::string text = bytes;
                text[place] = way == 0   ? static_cast<char>(text[place] ^ (1 << random.below(8)))
                              : way == 1 ? alphabet[random.below(alphabet.size())]
                                         : static_cast<char>(0xFF);
                put(folder / "m.msh", text);
                const Result<Mesh> one = read_gmsh(folder / "m.msh", {.step = {}, .threads = 1});
                const Result<Mesh> two = read_gmsh(folder / "m.msh", {.step = {}, .threads = 2});
                ASSERT_EQ(one.has_value(), two.has_value());
                if (one) {
                    ++accepted;
                    expect_same_with_labels(*one, *two);
                    expect_whole(*one);
                } else {
                    ++refused;
                    EXPECT_EQ(one.error().message(), two.error().message());
                    EXPECT_NE(one.error().what, "not one row a line");
                    EXPECT_NE(one.error().what, "a row is refused once and not again");
                }
            }
        }
        EXPECT_GT(accepted, 100);
        EXPECT_GT(refused, 100);
    }
}

TEST(GmshDamage, CountsThatNoFileBearsOut) {
    // Each number of a header replaced by one that is far too large: an error at once, without the memory.
    for (const MshKind& kind : {MshKind{41, Form::little}, MshKind{41, Form::big}, MshKind{22, Form::little}}) {
        const std::string bytes = MshBytes(small(), kind.version, kind.form).bytes();
        for (std::size_t place = bytes.find("$Nodes\n") + 7; place + 8 < bytes.size(); ++place) {
            std::string text = bytes;
            for (std::size_t i = 0; i < 8; ++i) {
                const bool high = kind.form == Form::little ? i >= 6 : i < 2;
                text[place + i] = static_cast<char>(high ? 0 : 0xF1);
            }
            const Result<Mesh> read = read_bytes(text);
            if (read) expect_whole(*read);
        }
    }
}

}  // namespace
}  // namespace barycert::testing
