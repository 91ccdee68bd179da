// Kernels from shared libraries: what loads, and what each refusal says.
#include <dlfcn.h>
#include <elf.h>
#include <gtest/gtest.h>
#include <link.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "barycert/kernels.hpp"

namespace barycert {
namespace {

std::string plugin(const std::string& name) {
    return (std::filesystem::path(BARYCERT_PLUGIN_DIR) / name).replace_extension(".so").string();
}

/// Expects a refusal that names the file and says `clause` and what to do.
void expect_refusal(const std::string& path, const std::string& clause) {
    const Result<Kernel> kernel = load_kernel_library(path);
    ASSERT_FALSE(kernel.has_value()) << path;
    EXPECT_EQ(kernel.error().file, path);
    EXPECT_NE(kernel.error().message().find(clause), std::string::npos) << kernel.error().message();
    EXPECT_FALSE(kernel.error().remedy.empty());
}

TEST(Plugin, ExampleLoadsAndWorks) {
    const Result<Kernel> kernel = load_kernel_library(plugin("example_kernel"));
    ASSERT_TRUE(kernel.has_value()) << kernel.error().message();
    EXPECT_EQ(kernel->name, "tetrahedron.octant");
    EXPECT_EQ(kernel->simplex, Simplex::tetrahedron);
    EXPECT_EQ(kernel->formula, "W_b = x/h, W_c = y/h, W_d = z/h, W_a = 1 - sum");
    EXPECT_EQ(kernel->source, "");
    EXPECT_TRUE(kernel->declares_degenerate);
    EXPECT_FALSE(kernel->certifies);
    EXPECT_EQ(kernel->rule, RegionRule::sign);
    const double vertices[12] = {0, 0, 0, 8, 0, 0, 0, 8, 0, 0, 0, 8}, point[3] = {1, 2, 4}, values[4] = {1, 10, 100, 8};
    double weights[4];
    ASSERT_EQ(kernel->weights(vertices, point, weights), 0);
    EXPECT_EQ(weights[0], 0.125);
    EXPECT_EQ(weights[3], 0.5);
    EXPECT_EQ(kernel->value(weights, values), 0.125 + 1.25 + 25 + 4);
    const double flat[12] = {};
    EXPECT_EQ(kernel->weights(flat, point, weights), 1);
}

TEST(Plugin, NameWithoutSlashIsTakenFromTheWorkingDirectory) {
    const auto before = std::filesystem::current_path();
    std::filesystem::current_path(BARYCERT_PLUGIN_DIR);
    const Result<Kernel> kernel = load_kernel_library("example_kernel.so");
    std::filesystem::current_path(before);
    ASSERT_TRUE(kernel.has_value()) << kernel.error().message();
}

TEST(Plugin, PerspectiveIsAKindOfCaseOfItsOwn) {
    const Result<Kernel> k = load_kernel_library(plugin("example_kernel_perspective"));
    ASSERT_TRUE(k) << k.error().message();
    EXPECT_EQ(k->name, "triangle.perspective-octant");
    EXPECT_EQ(k->simplex, Simplex::triangle);
    EXPECT_TRUE(k->perspective);
    EXPECT_FALSE(load_kernel_library(plugin("example_kernel"))->perspective);
}

TEST(Plugin, RefusalsSayWhatIsWrong) {
    expect_refusal(plugin("no_such_library"), "cannot load the kernel library");
    expect_refusal("no_such_library.so", "cannot load the kernel library");
    expect_refusal(__FILE__, "cannot load the kernel library");
    expect_refusal(plugin("example_kernel_no_weights"), "expected the function barycert_kernel_weights");
    expect_refusal(plugin("example_kernel_wrong_abi"), "expected 1, found 99");
    expect_refusal(plugin("example_kernel_wrong_simplex"), "found \"pentagon\"");
    expect_refusal(plugin("example_kernel_wrong_name"), "found \"two words\"");
    expect_refusal(plugin("example_kernel_taken_name"), "found tetrahedron.signed-volume");
}

enum class Ending { loaded, refused, killed };

/// Loads the file in a process of its own. A refusal names the file, and says `clause`.
Ending load_apart(const std::string& path, const std::string& clause) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::alarm(60);
        const Result<Kernel> kernel = load_kernel_library(path);
        const bool told = !kernel && kernel.error().file == path &&
                          kernel.error().message().find(clause) != std::string::npos && !kernel.error().remedy.empty();
        ::_exit(kernel ? 0 : told ? 1 : 2);
    }
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    if (!WIFEXITED(status)) return Ending::killed;
    EXPECT_LT(WEXITSTATUS(status), 2) << "the refusal does not tell what it should";
    return WEXITSTATUS(status) == 0 ? Ending::loaded : Ending::refused;
}

class DamagedPlugin : public ::testing::Test {
protected:
    void SetUp() override {
        std::ifstream in(plugin("example_kernel"), std::ios::binary);
        whole_ = {std::istreambuf_iterator<char>(in), {}};
        ASSERT_GT(whole_.size(), sizeof(ElfW(Ehdr)));
        folder_ = std::filesystem::temp_directory_path() / ("barycert-plugin-" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::string path(const char* name) const { return (folder_ / name).string(); }
    std::string put(const std::string& bytes) const {
        std::ofstream(path("kernel.so"), std::ios::binary) << bytes;
        return path("kernel.so");
    }
    ElfW(Ehdr) header() const {
        ElfW(Ehdr) header;
        std::memcpy(&header, whole_.data(), sizeof header);
        return header;
    }

    std::string whole_;
    std::filesystem::path folder_;
};

// Pages that dlopen maps beyond the end of a file end the process when they are touched.
TEST_F(DamagedPlugin, CutAnywhereIsRefused) {
    EXPECT_EQ(load_apart(put(whole_), ""), Ending::loaded);
    EXPECT_EQ(load_apart(put(""), "found an empty file"), Ending::refused);
    for (std::size_t size = 1; size < whole_.size(); size += size < 600 ? 13 : 101) {
        ASSERT_EQ(load_apart(put(whole_.substr(0, size)), "truncated"), Ending::refused) << size;
    }
    ASSERT_EQ(load_apart(put(whole_.substr(0, whole_.size() - 1)), "truncated"), Ending::refused);
}

// The same without a table of sections, as strippers leave it: what has to be mapped is enough to tell.
TEST_F(DamagedPlugin, CutWithoutSectionsIsRefusedOrLoads) {
    ElfW(Ehdr) bare = header();
    bare.e_shoff = bare.e_shnum = bare.e_shstrndx = 0;
    std::memcpy(whole_.data(), &bare, sizeof bare);
    EXPECT_EQ(load_apart(put(whole_), ""), Ending::loaded);
    std::size_t loaded = 0, refused = 0;
    for (std::size_t size = 1; size < whole_.size(); size += size < 600 ? 13 : 101) {
        const Ending ending = load_apart(put(whole_.substr(0, size)), "truncated");
        ASSERT_NE(ending, Ending::killed) << size;
        ASSERT_TRUE(ending == Ending::loaded || loaded == 0) << "a longer one is refused: " << size;
        ++(ending == Ending::loaded ? loaded : refused);
    }
    EXPECT_GT(loaded, 0U);
    EXPECT_GT(refused, 30U);
}

TEST_F(DamagedPlugin, HeadersThatLeadOutOfTheFileAreRefused) {
    const auto with = [&](auto change) {
        ElfW(Ehdr) changed = header();
        change(changed);
        std::string bytes = whole_;
        std::memcpy(bytes.data(), &changed, sizeof changed);
        return put(bytes);
    };
    using Header = ElfW(Ehdr);
    const auto far = ~decltype(Header::e_phoff){0} - 15;
    EXPECT_EQ(load_apart(with([&](Header& h) { h.e_phoff = far; }), "truncated"), Ending::refused);
    EXPECT_EQ(load_apart(with([&](Header& h) { h.e_shoff = far; }), "truncated"), Ending::refused);
    EXPECT_EQ(load_apart(with([&](Header& h) { h.e_phnum = 0xfffe; }), "truncated"), Ending::refused);
    EXPECT_EQ(load_apart(with([&](Header& h) { h.e_phentsize = 7; }), "another size"), Ending::refused);
    EXPECT_EQ(load_apart(with([&](Header& h) { h.e_ident[EI_CLASS] ^= 3; }), "another machine"), Ending::refused);
    EXPECT_EQ(load_apart(with([&](Header& h) { h.e_ident[EI_DATA] ^= 3; }), "another machine"), Ending::refused);
    EXPECT_EQ(load_apart(with([&](Header& h) { h.e_machine = EM_68K; }), "machine"), Ending::refused);
    EXPECT_EQ(load_apart(with([&](Header& h) { h.e_type = ET_REL; }), "another kind"), Ending::refused);
    // A part that would be mapped, and whose end wraps around.
    std::string bytes = whole_;
    ElfW(Phdr) part;
    std::memcpy(&part, bytes.data() + header().e_phoff, sizeof part);
    part.p_filesz = ~decltype(part.p_filesz){0};
    std::memcpy(bytes.data() + header().e_phoff, &part, sizeof part);
    EXPECT_EQ(load_apart(put(bytes), "truncated"), Ending::refused);
}

TEST_F(DamagedPlugin, WhatIsNoRegularFileIsRefused) {
    EXPECT_EQ(load_apart(folder_.string(), "found a folder"), Ending::refused);
    ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
    EXPECT_EQ(load_apart(path("pipe"), "found a pipe or device"), Ending::refused);
    EXPECT_EQ(load_apart("/dev/zero", "found a pipe or device"), Ending::refused);
    EXPECT_EQ(load_apart(put("INPUT(libm.so)\n"), "found another format"), Ending::refused);
}

TEST(Plugin, RefusedLibraryIsUnloaded) {
    const std::string path = plugin("example_kernel_wrong_abi");
    EXPECT_FALSE(load_kernel_library(path).has_value());
    EXPECT_EQ(dlopen(path.c_str(), RTLD_NOW | RTLD_NOLOAD), nullptr);
}

}  // namespace
}  // namespace barycert
