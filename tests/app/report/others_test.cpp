// Output of `./run flags` and `./run systems`: read, refused, and on the page.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "barycert/audit_report.hpp"
#include "draw/axes.hpp"
#include "small_audit.hpp"
#include "well_formed.hpp"

namespace barycert::report_test {
namespace {

using Json = nlohmann::json;

Json whole(const char* name) {
    std::ifstream in(std::string(BARYCERT_OTHERS) + "/" + name + ".json");
    return Json::parse(in);
}

Result<OtherResults> read_text(const std::string& text) {
    const std::string path = ::testing::TempDir() + "others-" + std::to_string(::getpid()) + ".json";
    std::ofstream(path) << text;
    Result<OtherResults> read = read_other_results(path);
    std::filesystem::remove(path);
    return read;
}

std::string refusal(const Json& j) {
    const auto read = read_text(j.dump());
    return read ? "" : read.error().message();
}

TEST(Others, FlagsAreReadAsTheyStand) {
    const Json j = whole("flags");
    const auto m = std::get<FlagsMatrix>(read_other_results(std::string(BARYCERT_OTHERS) + "/flags.json").value());
    EXPECT_EQ(m.seed, j["seed"]);
    EXPECT_EQ(m.count, j["count"]);
    EXPECT_EQ(m.families, j["families"].size());
    ASSERT_EQ(m.columns.size(), j["columns"].size());
    ASSERT_EQ(m.rows.size(), j["rows"].size());
    for (std::size_t r = 0; r < m.rows.size(); ++r) {
        EXPECT_EQ(Json(m.rows[r].kernel), j["rows"][r]["kernel"]);
        for (std::size_t c = 0; c < m.columns.size(); ++c) {
            EXPECT_EQ(Json(m.columns[c].label), j["columns"][c]["label"]);
            const Json& cell = j["rows"][r]["cells"][c];
            EXPECT_EQ(m.rows[r].cells[c].changed, cell["changed"]);
            EXPECT_EQ(m.rows[r].cells[c].wrong, cell["wrong"]);
            EXPECT_EQ(m.rows[r].cells[c].newly_wrong, cell["newly_wrong"]);
            EXPECT_EQ(m.rows[r].cells[c].newly_right, cell["newly_right"]);
            EXPECT_EQ(m.rows[r].cells[c].cases, cell["cases"]);
        }
    }
}

TEST(Others, SystemsAreReadAsTheyStand) {
    const Json j = whole("systems");
    const auto s = std::get<SystemsLeague>(read_other_results(std::string(BARYCERT_OTHERS) + "/systems.json").value());
    EXPECT_EQ(s.count, j["count"]);
    ASSERT_EQ(s.standings.size(), j["systems"].size());
    for (std::size_t i = 0; i < s.standings.size(); ++i) {
        const SystemsLeague::Standing& x = s.standings[i];
        const Json &row = j["systems"][i], &total = row["total"];
        EXPECT_EQ(Json(x.name), row["name"]);
        EXPECT_EQ(Json(x.version), row["version"]);
        EXPECT_EQ(x.dimension, row["dimension"]);
        EXPECT_EQ(x.inside, total["inside"]);
        EXPECT_EQ(x.outside_called_inside, total["outside_called_inside"]);
        EXPECT_EQ(x.wrong_owner ? Json(*x.wrong_owner) : Json(), total["owner_does_not_contain"]);
        EXPECT_EQ(x.max_value_error ? Json(*x.max_value_error) : Json(), total["max_value_error"]);
        EXPECT_EQ(x.ns ? Json(*x.ns) : Json(), row["ns_a_random_point"]);
    }
}

TEST(Others, BadFilesAreRefusedWithThePlace) {
    EXPECT_NE(read_text("").error().message().find("expected JSON, found something else; make one"), std::string::npos);
    const std::string text = whole("flags").dump();
    for (const std::size_t size : {std::size_t{1}, text.size() / 2, text.size() - 1})
        EXPECT_FALSE(read_text(text.substr(0, size))) << size;
    EXPECT_TRUE(read_text(text));
    struct Bad {
        const char *file, *pointer;
        Json value;
        const char* message;
    };
    const Bad list[] = {
        {"flags", "/command", "audit", "the file, command: expected \"flags\" or \"systems\", found \"audit\""},
        {"flags", "/schema", 2, "unknown schema: expected 1, found 2"},
        {"flags", "/seed", -1, "the flags matrix, seed: expected a count, found -1"},
        {"flags", "/compilers/0", 7, "the flags matrix, compilers: expected strings, found 7"},
        {"flags", "/columns/1/label", nullptr, "column 1, label: expected a string, found null"},
        {"flags", "/rows/2/cells", Json::array(), " cells, one a column, found 0"},
        {"flags", "/rows/0/cells/1/changed", 1e300, ", cell 1, changed: expected a count, found 1e+300"},
        {"flags", "/rows/0/cells/1/changed", 1000000, ", cell 1, changed: expected at most "},
        {"flags", "/rows/0/cells/1/newly_wrong", 999999, ", cell 1, newly_wrong: expected at most "},
        {"flags", "/rows", Json::object(), "the flags matrix, rows: expected an array, found an object"},
        {"systems", "/systems/0/dimension", 4, "barycert, dimension: expected 2 or 3, found 4"},
        {"systems", "/systems/0/total", 3, "barycert, total: expected a member \"points\", found 3"},
        {"systems", "/systems/0/total/inside", 99999999, "barycert, total, inside: expected at most "},
        {"systems", "/systems/0/total/max_value_error", -0.5, "max_value_error: expected a number >= 0 or null, found"},
        {"systems", "/systems/0/ns_a_random_point", "fast", "barycert, ns_a_random_point: expected a number >= 0 or"},
        {"systems", "/systems/0/name", Json::array(), "system 0, name: expected a string, found an array"},
    };
    for (const Bad& bad : list) {
        Json j = whole(bad.file);
        j[Json::json_pointer(bad.pointer)] = bad.value;
        const std::string message = refusal(j);
        EXPECT_NE(message.find(bad.message), std::string::npos) << bad.pointer << '\n' << message;
        EXPECT_NE(message.find("make one with `./run flags --json FILE`"), std::string::npos) << message;
    }
    // Every member that is looked at must be there.
    for (const char* pointer : {"/command", "/schema", "/count", "/families", "/columns/0/flags", "/rows/0/kernel",
                                "/rows/0/cells/0/cases"}) {
        Json j = whole("flags");
        const Json::json_pointer at(pointer);
        j[at.parent_pointer()].erase(at.back());
        EXPECT_NE(refusal(j).find("expected a member \"" + at.back() + '"'), std::string::npos) << pointer;
    }
    // A matrix that would make a page that nobody opens.
    Json j = whole("flags");
    for (int i = 0; i < 3000; ++i) j["rows"].push_back(j["rows"][0]);
    EXPECT_NE(refusal(j).find("the flags matrix: expected at most 20000 cells, found "), std::string::npos);
    EXPECT_FALSE(read_other_results("/nonexistent/flags.json"));
}

std::string page_with(std::vector<OtherResults> others) {
    return audit_html(audited(), {.others = std::move(others)}).value();
}

TEST(Others, OnThePageAsTablesThatSort) {
    EXPECT_EQ(page_with({}).find("Formulas under compiler flags"), std::string::npos);
    const auto read = [](const char* name) {
        return read_other_results(std::string(BARYCERT_OTHERS) + "/" + name + ".json").value();
    };
    const std::string page = page_with({read("flags"), read("systems")});
    expect_well_formed(page, true);
    const auto m = std::get<FlagsMatrix>(read("flags"));
    const auto s = std::get<SystemsLeague>(read("systems"));
    const std::size_t flags_at = page.find("<h2>Formulas under compiler flags</h2>"),
                      wrong_at = page.find("<h3>Answers that get wrong</h3>"), systems_at = page.find("<h2>Systems: ");
    ASSERT_LT(flags_at, wrong_at);
    ASSERT_LT(wrong_at, systems_at);
    // Each row of both tables has the shares of the columns in which something changes, and those columns only.
    static const std::regex cell("data-v=\"([^\"]*)\"");
    const auto numbers = [&](std::size_t from, const std::string& head) {
        const std::size_t at = page.find("<th scope=\"row\">" + report::html_name(head) + "</th>", from);
        const std::string row = page.substr(at, page.find("</tr>", at) - at);
        std::vector<double> list;
        for (std::sregex_iterator it(row.begin(), row.end(), cell), end; it != end; ++it)
            list.push_back(std::stod((*it)[1]));
        return list;
    };
    for (const FlagsMatrix::KernelAnswers& row : m.rows) {
        std::vector<double> changed, wrong;
        for (std::size_t c = 0; c < m.columns.size(); ++c) {
            bool any = false;
            for (const FlagsMatrix::KernelAnswers& other : m.rows) any = any || other.cells[c].changed != 0;
            if (!any) continue;
            const auto cases = static_cast<double>(row.cells[c].cases);
            changed.push_back(static_cast<double>(row.cells[c].changed) / cases);
            wrong.push_back(static_cast<double>(row.cells[c].newly_wrong) / cases);
        }
        EXPECT_EQ(numbers(flags_at, row.kernel), changed) << row.kernel;
        EXPECT_EQ(numbers(wrong_at, row.kernel), wrong) << row.kernel;
    }
    for (const SystemsLeague::Standing& x : s.standings) {
        const std::size_t table = page.find(x.dimension == 3 ? "On meshes of tetrahedra" : "On meshes of triangles");
        const std::vector<double> row = numbers(table, x.name);
        ASSERT_EQ(row.size(), 5U) << x.name;
        EXPECT_EQ(row[0], static_cast<double>(x.inside_called_outside) / static_cast<double>(x.inside)) << x.name;
        EXPECT_EQ(row[4], x.ns.value_or(-1)) << x.name;
    }
}

TEST(Others, TextOfTheFilesStaysText) {
    const std::string evil = "<script>alert(1)</script>&\"'\x1b\xff";
    FlagsMatrix m;
    m.compilers = {evil};
    m.columns = {{evil, evil, evil}, {evil, evil, evil}};
    m.rows = {{evil, {{.cases = 2, .changed = 1, .wrong = 1, .newly_wrong = 1}, {.cases = 2}}}};
    SystemsLeague s;
    s.standings.push_back({.name = evil, .version = evil, .failures = {evil}});
    s.standings.push_back({.name = evil, .not_run = evil});
    const std::string page = page_with({m, s});
    expect_well_formed(page, true);
    EXPECT_EQ(page.find("<script>alert"), std::string::npos);
}

}  // namespace
}  // namespace barycert::report_test
