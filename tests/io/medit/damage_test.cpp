// Files cut and changed at every byte: an error or a mesh, the same on any number of threads. Run under sanitizers too.
#include "mesh/consistency.hpp"
#include "tests/io/medit/medit_files.hpp"

namespace barycert::testing {
namespace {

Medit all_of_it() {
    Medit file = two_of_medit();
    file.parts.push_back({"SolAtTetrahedra", 66, 4, {{1, 2, 3, 4}, {5, 6, 7, 8}}, {1, 2}});
    return file;
}

TEST(MeditDamage, CutAnywhere) {
    for (const MeditForm& form : medit_forms) {
        SCOPED_TRACE(name_of(form));
        const std::string bytes = medit_bytes(all_of_it(), form.version, form.form);
        const TemporaryFolder folder;
        int read = 0;
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            put(folder / "m.mesh", bytes.substr(0, size));
            const Result<Mesh> mesh = read_mesh(folder / "m.mesh");
            if (!mesh) continue;
            ++read;
            EXPECT_EQ(mesh->cell_count(), 2U);
            // Text that ends before a section, or within the last keyword.
            const std::string rest = bytes.substr(size);
            EXPECT_TRUE(rest.size() < 9 || rest.find("SolAt") == 0 || rest.find("\nSolAt") == 0) << rest;
        }
        EXPECT_EQ(read != 0, form.form == Form::text) << "binary files have an end";
    }
}

TEST(MeditDamage, ChangedAnywhere) {
    constexpr std::string_view alphabet = "0123456789 \n\r-.#\"eEnT\xFF";
    int accepted = 0, refused = 0;
    for (const MeditForm& form : medit_forms) {
        SCOPED_TRACE(name_of(form));
        const std::string bytes = medit_bytes(all_of_it(), form.version, form.form);
        const TemporaryFolder folder;
        base::Random random(static_cast<std::uint64_t>(form.version));
        for (std::size_t place = 0; place < bytes.size(); ++place) {
            std::string text = bytes;
            const auto bit = random.below(8);
            const auto letter = random.below(alphabet.size());
            text[place] = place % 2 == 0 ? static_cast<char>(text[place] ^ (1 << bit)) : alphabet[letter];
            put(folder / "m.mesh", text);
            const Result<Mesh> one = read_mesh(folder / "m.mesh", {.threads = 1});
            const Result<Mesh> two = read_mesh(folder / "m.mesh", {.threads = 2});
            ASSERT_EQ(one.has_value(), two.has_value());
            if (one) {
                ++accepted;
                expect_same_with_labels(*one, *two, false);
                EXPECT_EQ(mesh::inconsistency(*one, mesh::FieldValues::any), nullptr);
            } else {
                ++refused;
                EXPECT_EQ(one.error().what, two.error().what);
                EXPECT_FALSE(one.error().expected.empty() && one.error().remedy.empty()) << one.error().message();
            }
        }
    }
    EXPECT_GT(accepted, 100);
    EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace barycert::testing
