// Pipes, and memory that does not grow with the number of points.
#include <fcntl.h>
#include <sys/stat.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>

#include "tests/io/row_data.hpp"
#include "tests/sanitized.hpp"

namespace barycert::io::testing {
namespace {

/// All that a source or sink may take, in MiB: their buffers are 1 to 8 MiB.
constexpr double room = 24;

constexpr std::size_t many = 5000000;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void write_fully(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written <= 0) return;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
}

/// Reads `count` points and keeps none; sees that memory stays flat from the first block on.
void expect_flat(PointSource& source, std::size_t count) {
    std::vector<double> block;
    block.reserve(3 * 65536);
    std::size_t points = 0;
    double before = 0;
    const auto start = std::chrono::steady_clock::now();
    while (true) {
        block.clear();
        const Result<std::size_t> taken = source.read(65536, block);
        ASSERT_TRUE(taken) << taken.error().message();
        if (points == 0) before = resident_mib();
        points += *taken;
        if (*taken == 0) break;
        if (!barycert::testing::sanitized) {
            ASSERT_LT(resident_mib(), before + room);
        }
    }
    EXPECT_EQ(points, count);
    std::printf("    %.0f ns a point\n", seconds_since(start) / static_cast<double>(count) * 1e9);
}

TEST(Streams, TheStandardInputIsAPipe) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const Redirected in(STDIN_FILENO, ends[0]);
    std::thread writer([descriptor = ends[1]] {
        // Byte after byte, so that lines come in parts.
        for (const char c : std::string_view("x,y,z\n1,2,3\n4,5,6\n\n7,8,9\n")) write_fully(descriptor, {&c, 1});
        ::close(descriptor);
    });
    const Result<std::vector<double>> points = read_file("-", 3, 2);
    writer.join();
    ASSERT_TRUE(points) << points.error().message();
    EXPECT_EQ(*points, (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

TEST(Streams, APointIsGivenBeforeTheNextHasCome) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const Redirected in(STDIN_FILENO, ends[0]);
    write_fully(ends[1], "x,y,z\n1,2,3\n4,5,6\n7,8");
    // Should it wait for more, it gets the end in time.
    std::atomic<bool> late{false};
    std::thread closer([&, descriptor = ends[1]] {
        for (int i = 0; i < 100 && !late; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
        late = true;
        write_fully(descriptor, ",9\n");
        ::close(descriptor);
    });
    const auto source = open_points("-", 3);
    ASSERT_TRUE(source);
    std::vector<double> points;
    EXPECT_EQ((*source)->read(1, points).value(), 1U);
    EXPECT_EQ((*source)->read(1, points).value(), 1U);
    EXPECT_FALSE(late.exchange(true));
    EXPECT_EQ((*source)->read(5, points).value(), 1U);
    closer.join();
    EXPECT_EQ(points, (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

TEST(Streams, ErrorsOfTheStandardInputHaveLines) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const Redirected in(STDIN_FILENO, ends[0]);
    write_fully(ends[1], "1,2,3\n1,2,c\n");
    ::close(ends[1]);
    expect_error(read_file("-", 3), "standard input", {2, "bad coordinate z", "a number", "\"c\"", nullptr});
}

TEST(Streams, ANumberCutOnTheStandardInput) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const Redirected in(STDIN_FILENO, ends[0]);
    write_fully(ends[1], "1,2,3\n1,2,0.2");
    ::close(ends[1]);
    expect_error(read_file("-", 3), "standard input",
                 {2, "the last row has no line end, so the file may be cut short", "a line end", nullptr, nullptr});
}

TEST(Streams, FiveMillionPointsOfAPipe) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const Redirected in(STDIN_FILENO, ends[0]);
    std::thread writer([descriptor = ends[1]] {
        std::string block;
        base::Random random(1);
        for (int i = 0; i < 1000; ++i) {
            for (const char after : {',', ',', '\n'}) {
                char text[32];
                std::snprintf(text, sizeof text, "%.17g%c", random.unit(), after);
                block += text;
            }
        }
        for (std::size_t i = 0; i < many / 1000; ++i) write_fully(descriptor, block);
        ::close(descriptor);
    });
    const auto source = open_points("-", 3);
    EXPECT_TRUE(source);
    if (source) expect_flat(**source, many);
    writer.join();
}

TEST(Streams, FiveMillionPointsOfNpy) {
    const TemporaryFolder folder;
    for (const bool fortran : {false, true}) {
        const std::string head = npy_bytes(npy_dictionary("<f8", "(5000000, 3)", fortran), "");
        put(folder / "p.npy", head);
        std::filesystem::resize_file(folder / "p.npy", head.size() + 24 * many);  // zeros that take no room
        const auto source = open_points(folder / "p.npy", 3);
        ASSERT_TRUE(source) << source.error().message();
        expect_flat(**source, many);
    }
}

TEST(Streams, FiveMillionPointsOfNode) {
    const TemporaryFolder folder;
    {
        std::ofstream out(folder / "p.node", std::ios::binary);
        std::string text = "5000000 3 0 0\n";
        for (std::size_t i = 1; i <= many; ++i) {
            text += std::to_string(i) + " 0.125 0 1\n";
            if (text.size() > 1000000) {
                out << text;
                text.clear();
            }
        }
        out << text;
    }
    const auto source = open_points(folder / "p.node", 3);
    ASSERT_TRUE(source) << source.error().message();
    expect_flat(**source, many);
}

TEST(Streams, RowsOut) {
    const RowData data = random_rows(100000, {.dimension = 3, .fields = {{"p"}}}, 31);
    RowData plain = data;  // numbers as they come from sampling, not of all magnitudes
    base::Random random(5);
    for (double& x : plain.points) x = random.unit();
    for (double& x : plain.values) x = random.unit();
    for (const char* file : {"r.csv", "r.npy"}) {
        const TemporaryFolder folder;
        const auto sink = open_table(folder / file, data.format);
        ASSERT_TRUE(sink) << sink.error().message();
        double before = 0;
        const auto start = std::chrono::steady_clock::now();
        for (int i = 0; i < 20; ++i) {
            ASSERT_TRUE((*sink)->write(i % 2 == 0 ? plain.rows() : data.rows()));
            if (i == 0) before = resident_mib();
            if (!barycert::testing::sanitized) {
                ASSERT_LT(resident_mib(), before + room);
            }
        }
        ASSERT_TRUE((*sink)->commit());
        std::printf("    %s: %.0f ns a number\n", file, seconds_since(start) / 8e6 * 1e9);
    }
}

}  // namespace
}  // namespace barycert::io::testing
