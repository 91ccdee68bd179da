// Damaged and random files: an error or points, never a crash. Run under sanitizers too.
#include <algorithm>

#include "tests/io/row_data.hpp"

namespace barycert::io::testing {
namespace {

struct Sample {
    std::string name;
    std::string bytes;
};

std::vector<Sample> samples() {
    const std::string numbers = bits_of({1, 2.5, -3, 4, 5e-324, 6, 7, 8, 9});
    return {{"a.csv", "# c\nx,y,z,n\n1,2.5,-3,\"a\"\"b\"\n4,5e-3,6,c\n\n7,8,9,\n"},
            {"b.csv", "1 2.5 -3.5\n4 5e-3 6\n7 8 9.25\n"},
            {"c.csv",
             "\xEF\xBB\xBF"
             "x;y;z\r\n1;2.5;-3\r\n4;5;\"6\"\r\n"},
            {"d.csv", "1\t2\t3\t\n4\t5\t6\t\n"},
            {"e.npy", npy_bytes(npy_dictionary("<f8", "(3, 3)"), numbers)},
            {"f.npy", npy_bytes(npy_dictionary(">f4", "(6, 3)", true), numbers, 2)},
            {"g.node", "3 3 1 1\n1 1 2.5 -3 0 1\n2 4 5e-3 6 0 1 # c\n3 7 8 9 0 1\n"}};
}

void expect_sane(const Result<std::vector<double>>& read, const std::string& bytes) {
    if (read) {
        for (const double x : *read) ASSERT_TRUE(std::isfinite(x));
        ASSERT_EQ(read->size() % 3, 0U);
        return;
    }
    ASSERT_FALSE(read.error().what.empty());
    ASSERT_FALSE(read.error().file.empty());
    ASSERT_LE(read.error().line, static_cast<std::size_t>(std::count(bytes.begin(), bytes.end(), '\n')) + 1);
}

TEST(Damage, SamplesAreGood) {
    for (const Sample& sample : samples()) {
        const Result<std::vector<double>> read = read_bytes(sample.name, sample.bytes, 3);
        ASSERT_TRUE(read) << sample.name << ": " << read.error().message();
        EXPECT_GE(read->size(), 6U);
    }
}

TEST(Damage, AFileCutAnywhere) {
    for (const Sample& sample : samples()) {
        const std::vector<double> whole = read_bytes(sample.name, sample.bytes, 3).value();
        for (std::size_t size = 0; size < sample.bytes.size(); ++size) {
            SCOPED_TRACE(sample.name + " " + std::to_string(size));
            const std::string bytes = sample.bytes.substr(0, size);
            const Result<std::vector<double>> read = read_bytes(sample.name, bytes, 3);
            expect_sane(read, bytes);
            if (!read || sample.name.ends_with(".csv")) continue;
            ADD_FAILURE() << "a file that tells its size was accepted when cut";
        }
        // CSV does not tell its size. Wherever it is cut, it holds points that the whole has, too, or is refused.
        if (!sample.name.ends_with(".csv")) continue;
        int accepted = 0;
        for (std::size_t size = 0; size <= sample.bytes.size(); ++size) {
            const Result<std::vector<double>> read = read_bytes(sample.name, sample.bytes.substr(0, size), 3);
            if (!read) continue;
            ++accepted;
            ASSERT_LE(read->size(), whole.size());
            EXPECT_EQ(bits_of(*read),
                      bits_of({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(read->size())}))
                << size;
        }
        EXPECT_GE(accepted, 3);
    }
}

TEST(Damage, ChangedBytes) {
    constexpr std::string_view alphabet = "0123456789  \n\n\r\t,;+-.#\"'eExyz()[]{}\xFF\xEF";
    const std::vector<Sample> all = samples();
    const TemporaryFolder folder;
    int accepted = 0, refused = 0;
    for (std::uint64_t seed = 0; seed < 14000; ++seed) {
        base::Random random(seed);
        const Sample& sample = all[random.below(all.size())];
        std::string bytes = sample.bytes;
        for (std::uint64_t i = 1 + random.below(4); i > 0 && !bytes.empty(); --i) {
            const std::size_t place = random.below(bytes.size());
            const char byte =
                random.coin() ? alphabet[random.below(alphabet.size())] : static_cast<char>(random.below(256));
            const std::uint64_t how = random.below(3);
            if (how == 0) bytes[place] = byte;
            if (how == 1) bytes.insert(place, 1, byte);
            if (how == 2) bytes.erase(place, 1 + random.below(3));
        }
        SCOPED_TRACE(seed);
        put(folder / sample.name, bytes);
        const Result<std::vector<double>> one = read_file(folder / sample.name, 3, 1);
        const Result<std::vector<double>> two = read_file(folder / sample.name, 3, 100);
        ASSERT_EQ(one.has_value(), two.has_value());
        ASSERT_EQ(one ? bits_of(*one) : one.error().message(), two ? bits_of(*two) : two.error().message());
        expect_sane(one, bytes);
        ++(one ? accepted : refused);
    }
    EXPECT_GT(accepted, 500);  // both happen
    EXPECT_GT(refused, 500);
}

TEST(Damage, RandomBytes) {
    const TemporaryFolder folder;
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        base::Random random(seed);
        std::string bytes;
        for (std::uint64_t size = random.below(200); size > 0; --size) bytes += static_cast<char>(random.below(256));
        const char* const name = seed % 3 == 0 ? "p.csv" : seed % 3 == 1 ? "p.npy" : "p.node";
        if (seed % 3 == 1) bytes = std::string("\x93NUMPY\x01\0\x40\0", 10) + bytes;
        put(folder / name, bytes);
        expect_sane(read_file(folder / name, 3), bytes);
    }
}

}  // namespace
}  // namespace barycert::io::testing
