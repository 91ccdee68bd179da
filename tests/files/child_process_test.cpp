/// Programs and copies that end, that do not, and that leave others behind.
#include "files/child_process.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>

namespace barycert::base {
namespace {

using std::chrono::milliseconds;

/// Output of `/bin/sh -c script` on its descriptor 1, of which `most` bytes are kept; its stdin is `/dev/null`.
struct Shell {
    Pipe out;
    Descriptor null{::open("/dev/null", O_RDONLY | O_CLOEXEC)};
    std::array<Stream, 1> heard;
    ChildProcess process;

    explicit Shell(const std::string& script, std::size_t most = 1000) {
        heard[0] = {out.out.number, {}, most};
        process = ChildProcess::run("/bin/sh", {"-c", script}, std::array{null.number, out.in.number});
        out.in.close();
    }
};

TEST(ChildProcess, ProgramIsHeardAndEnds) {
    Shell shell("echo one; echo two; exit 7");
    ASSERT_TRUE(shell.process);
    EXPECT_TRUE(shell.process.listen(shell.heard, milliseconds(60'000)));
    EXPECT_EQ(shell.heard[0].text, "one\ntwo\n");
    const int status = shell.process.wait();
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 7);
}

TEST(ChildProcess, MissingProgramIsToldByErrno) {
    const ChildProcess process = ChildProcess::run("/no/such/program", {}, {});
    EXPECT_FALSE(process);
    EXPECT_EQ(process.failure(), ENOENT);
}

TEST(ChildProcess, ProgramHasNoDescriptorButThoseGiven) {
    const Descriptor kept(::open("/dev/null", O_RDONLY));  // no O_CLOEXEC
    Shell shell("for n in 2 3 4 5 6 7 8 9; do (true <&$n) && echo $n; done");
    EXPECT_TRUE(shell.process.listen(shell.heard, milliseconds(60'000)));
    EXPECT_EQ(shell.heard[0].text, "");
}

TEST(ChildProcess, LeavesOutWhatIsTooMuch) {
    Shell shell("head -c 1000000 /dev/zero", 1);
    EXPECT_TRUE(shell.process.listen(shell.heard, milliseconds(60'000)));
    EXPECT_GE(shell.heard[0].text.size(), 1U);
    EXPECT_LE(shell.heard[0].text.size(), 4096U);  // one block
    EXPECT_EQ(shell.process.wait(), 0);
}

TEST(ChildProcess, TakesTooLongAndIsKilled) {
    Shell shell("echo begun; exec sleep 1000");
    EXPECT_FALSE(shell.process.listen(shell.heard, milliseconds(200)));
    const int status = shell.process.end();
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    EXPECT_FALSE(shell.process);
}

// The end of the process is the end of what is heard; and what it has left behind ends with it.
TEST(ChildProcess, IsNotHeldUpByWhatItLeavesBehind) {
    Shell shell("sleep 1000 & echo $!");
    EXPECT_TRUE(shell.process.listen(shell.heard, milliseconds(60'000)));
    const pid_t left = std::atoi(shell.heard[0].text.c_str());
    ASSERT_GT(left, 1);
    EXPECT_TRUE(shell.process.has_ended());
    EXPECT_EQ(shell.process.end(), 0);
    EXPECT_TRUE(readable(shell.out.out.number, milliseconds(10'000)));  // the end: `left` held the other end
}

TEST(ChildProcess, CopyWorksAndEnds) {
    Pipe pipe;
    ChildProcess copy = ChildProcess::copy([&] { pipe.in.write("done"); });
    pipe.in.close();
    std::array<Stream, 1> heard{Stream{.descriptor = pipe.out.number}};
    EXPECT_TRUE(copy.listen(heard));
    EXPECT_EQ(heard[0].text, "done");
    EXPECT_EQ(copy.wait(), 0);
    EXPECT_EQ(copy.wait(), 0);  // once
}

TEST(ChildProcess, CopyIsKilledWithItsObject) {
    Pipe pipe;
    {
        const ChildProcess copy = ChildProcess::copy([&] { ::pause(); });
        pipe.in.close();
        EXPECT_FALSE(copy.has_ended());
        EXPECT_FALSE(readable(pipe.out.number, milliseconds(20)));
    }
    EXPECT_TRUE(readable(pipe.out.number, milliseconds(0)));
}

}  // namespace
}  // namespace barycert::base
