// The matrix of formulas and compiler flags: what must not change does not, what must does.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "barycert/audit_report.hpp"
#include "matrix.hpp"

namespace barycert::flags {
namespace {

const Matrix& measured() {
    static const Matrix m = measure(FLAGS_LIST, 200, 1).value();
    return m;
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// The cells of columns with that label, of all compilers.
std::uint64_t sum(const std::string& label, std::uint64_t Cell::*figure) {
    const Matrix& m = measured();
    std::uint64_t n = 0;
    bool any = false;
    for (std::size_t k = 0; k < m.columns.size(); ++k) {
        if (m.columns[k].label != label) continue;
        any = true;
        for (const Row& row : m.rows) n += row.cells[k].*figure;
    }
    EXPECT_TRUE(any) << label;
    return n;
}

TEST(Flags, OptimisationWithoutLicenceChangesNoBit) {
    for (const Variant& v : measured().columns) {
        if (has(v.flags, "fast") || has(v.flags, "float") || has(v.flags, "387") || v.flush) continue;
        EXPECT_EQ(sum(v.label, &Cell::changed), 0U) << v.compiler << " " << v.flags;
    }
    EXPECT_GT(sum("-O0", &Cell::cases), 10000U);
}

TEST(Flags, LicenceToChangeIsTaken) {
    EXPECT_GT(sum("-O2 -ffast-math", &Cell::changed), 0U);
    EXPECT_GT(sum("float", &Cell::newly_wrong), 0U);
    for (const Variant& v : measured().columns) {
        if (v.flush) {
            EXPECT_GT(sum(v.label, &Cell::newly_wrong), 0U);
        }
        if (has(v.flags, "contract=fast")) {
            EXPECT_GT(sum(v.label, &Cell::changed), 0U);
        }
    }
}

TEST(Flags, CountsHangTogether) {
    for (const Row& row : measured().rows) {
        ASSERT_EQ(row.cells.size(), measured().columns.size());
        const Cell& strict = row.cells[0];
        EXPECT_GT(strict.cases, 500U) << row.kernel;
        EXPECT_EQ(strict.changed + strict.newly_wrong + strict.newly_right, 0U);
        for (const Cell& c : row.cells) {
            EXPECT_EQ(c.cases, strict.cases);
            EXPECT_EQ(c.wrong, strict.wrong + c.newly_wrong - c.newly_right) << row.kernel;
            EXPECT_LE(c.newly_wrong + c.newly_right, c.changed) << row.kernel;
        }
    }
}

TEST(Flags, ReportsNameEverything) {
    const std::string tables = markdown(measured()), picture_text = picture(measured()), json_text = json(measured());
    for (const Row& row : measured().rows) {
        for (const std::string* text : {&tables, &picture_text, &json_text}) EXPECT_TRUE(has(*text, row.kernel));
    }
    EXPECT_TRUE(has(picture_text, "prefers-color-scheme:dark"));
    // `barycert audit --with` reads it.
    const std::string path = ::testing::TempDir() + "flags-" + std::to_string(::getpid()) + ".json";
    std::ofstream(path) << json_text;
    const auto read = read_other_results(path);
    std::filesystem::remove(path);
    ASSERT_TRUE(read) << read.error().message();
    const auto& matrix = std::get<FlagsMatrix>(*read);
    ASSERT_EQ(matrix.rows.size(), measured().rows.size());
    EXPECT_EQ(matrix.columns.size(), measured().columns.size());
    EXPECT_EQ(matrix.rows.back().cells.back().changed, measured().rows.back().cells.back().changed);
    EXPECT_EQ(measure("/nonexistent/list", 1, 1).has_value(), false);
}

}  // namespace
}  // namespace barycert::flags
