// Kernels from shared libraries: what loads, and what each refusal says.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "barycert/kernels/kernel.hpp"

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

TEST(Plugin, RefusalsSayWhatIsWrong) {
    expect_refusal(plugin("no_such_library"), "cannot load the kernel library");
    expect_refusal("no_such_library.so", "cannot load the kernel library");
    expect_refusal(__FILE__, "cannot load the kernel library");
    expect_refusal(plugin("example_kernel_no_weights"), "expected the function barycert_kernel_weights");
    expect_refusal(plugin("example_kernel_wrong_abi"), "expected 1, found 99");
    expect_refusal(plugin("example_kernel_wrong_simplex"), "found 'pentagon'");
    expect_refusal(plugin("example_kernel_wrong_name"), "found 'two words'");
    expect_refusal(plugin("example_kernel_taken_name"), "found tetrahedron.signed-volume");
}

TEST(Plugin, RefusedLibraryIsUnloaded) {
    const std::string path = plugin("example_kernel_wrong_abi");
    EXPECT_FALSE(load_kernel_library(path).has_value());
    EXPECT_EQ(dlopen(path.c_str(), RTLD_NOW | RTLD_NOLOAD), nullptr);
}

}  // namespace
}  // namespace barycert
