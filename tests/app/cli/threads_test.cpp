// --threads is how many threads there are, in all that a command does.

#include <gtest/gtest.h>

#include "process.hpp"
#include "sample_meshes.hpp"

namespace barycert::cli_test {
namespace {

#ifdef BARYCERT_COUNTED_THREADS
// One machine's single core would make none in any case; two cores make some unless told otherwise.
TEST(Threads, OneIsTheProgramSOwn) {
    const Words audit{"audit", "--quiet", "--count", "10", "--kernel", "tetrahedron.cramer", "--family", "mesh.faces"};
    const Words gaps{"gaps", mesh("bracket"), "--quiet", "--count", "10", "--kernel", "tetrahedron.cramer"};
    for (const Words& command : {audit, gaps}) {
        const auto made = [&](const std::string& threads) {
            const Ended r =
                run(plus(command, {"--threads", threads}), {.environment = {"LD_PRELOAD=" BARYCERT_COUNTED_THREADS}});
            EXPECT_EQ(r.code, 0) << r.err;
            const std::string says = "threads made: ";
            const std::size_t at = r.err.find(says);
            EXPECT_NE(at, std::string::npos) << r.err;
            return at == std::string::npos ? -1 : std::stoi(r.err.substr(at + says.size()));
        };
        EXPECT_EQ(made("1"), 0) << command[0];
        EXPECT_GT(made("2"), 0) << command[0] << ": the library counts";
    }
}
#endif

}  // namespace
}  // namespace barycert::cli_test
