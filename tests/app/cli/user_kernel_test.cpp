// Kernels of the user's, by the C interface: audited beside the catalogue's, and found out.

#include <gtest/gtest.h>

#include "process.hpp"

namespace barycert::cli_test {
namespace {

using Json = nlohmann::json;

TEST(UserKernel, AloneOrBesideTheCatalogue) {
    const Words library{"--kernel-library", BARYCERT_USER_KERNEL};
    const auto kernels_of = [&](Words arguments) {
        arguments.insert(arguments.end(), library.begin(), library.end());
        Words names;
        const Json report = parse(run(arguments).out);
        for (const Json& k : report["kernels"]) names.push_back(k["name"]);
        return names;
    };
    EXPECT_EQ(kernels_of({"audit", "--count", "5", "--json", "-"}), Words{"tetrahedron.user-volume"});
    EXPECT_EQ(kernels_of({"audit", "--count", "5", "--json", "-", "--kernel", "tetrahedron.inverse"}).size(), 2U);
    EXPECT_EQ(kernels_of({"kernels", "--json", "-"}), Words{"tetrahedron.user-volume"});
}

TEST(UserKernel, ARightFormulaIsCleanWhereCasesAreEasyAndASwappedOneNowhere) {
    const auto wrong_share = [](const char* library) {
        const Ended r =
            run({"audit", "--count", "200", "--family", "mesh.inside", "--kernel-library", library, "--json", "-"});
        const Json kernel = parse(r.out)["kernels"][0];
        return std::pair(kernel["wrong_cases"].get<int>(), kernel["false_certificate"].get<int>());
    };
    EXPECT_EQ(wrong_share(BARYCERT_USER_KERNEL), std::pair(0, 0));
    // Inside, swapped weights have the right signs: only the certificate can give them away.
    EXPECT_EQ(wrong_share(BARYCERT_SWAPPED_KERNEL).second, 200);
    const Ended table =
        run({"audit", "--count", "50", "--kernel-library", BARYCERT_SWAPPED_KERNEL, "--fail-on", "false_certificate"});
    EXPECT_EQ(table.code, 1);
    EXPECT_TRUE(contains(table.out, "certifies its answers, and "));
    EXPECT_TRUE(contains(table.err, "fails: tetrahedron.user-swapped: false_certificate = "));
}

TEST(UserKernel, WhatIsNoKernelLibraryIsRefused) {
    const Scratch scratch;
    const std::string text = scratch.put("text.so", "not a library\n");
    for (const std::string& path : {text, scratch.path("none.so"), scratch.folder()}) {
        for (const Words& arguments :
             std::vector<Words>{{"audit"}, {"kernels"}, {"replay", "--family", "huge", "--case", "1"}}) {
            Words words = arguments;
            words.insert(words.end(), {"--kernel-library", path});
            const Ended r = run(words);
            EXPECT_EQ(r.code, 2);
            EXPECT_EQ(r.out, "");
            EXPECT_EQ(r.err.rfind("error: " + path + ": cannot load the kernel library", 0), 0U) << r.err;
        }
    }
}

}  // namespace
}  // namespace barycert::cli_test
