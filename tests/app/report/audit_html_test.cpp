// The audit as an HTML page: well-formed, what is in it, and that it is what the JSON says.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "barycert/audit_pictures.hpp"
#include "barycert/audit_report.hpp"
#include "draw/axes.hpp"
#include "small_audit.hpp"
#include "well_formed.hpp"

namespace barycert::report_test {
namespace {

using Json = nlohmann::json;

std::string page_of(const AuditReport& report, const AuditPage& page = {}) {
    return audit_html(report, page).value();
}

AuditReport only_kernel(const std::string& name) {
    AuditReport report = audited();
    std::erase_if(report.kernels, [&](const KernelResult& k) { return k.kernel.name != name; });
    return report;
}

/// The cells of the row that starts with a head: shown, and sorted by.
struct Cells {
    std::vector<std::string> shown;
    std::vector<double> numbers;
};
Cells row_of(const std::string& page, const std::string& table, const std::string& head) {
    const std::size_t from = page.find(table);
    const std::size_t first = page.find("<th scope=\"row\">" + report::html_name(head) + "</th>", from),
                      last = page.find("</tr>", first);
    Cells cells;
    if (first == std::string::npos || last == std::string::npos) return cells;
    const std::string row = page.substr(first, last - first);
    static const std::regex cell("<td class=\"n[^\"]*\" data-v=\"([^\"]*)\">([^<]*)</td>");
    for (std::sregex_iterator it(row.begin(), row.end(), cell), end; it != end; ++it) {
        cells.numbers.push_back(std::stod((*it)[1]));
        cells.shown.push_back((*it)[2]);
    }
    return cells;
}

double share(const Json& part, std::uint64_t whole) {
    return whole == 0 ? -1 : part.get<double>() / static_cast<double>(whole);
}

std::uint64_t exactly(const Json& kernel, const char* region) {
    std::uint64_t n = 0;
    for (const Json& claimed : kernel["confusion"][region]) n += claimed.get<std::uint64_t>();
    return n;
}

double figure(const Json& x) {
    if (x.is_null()) return -1;
    const double number = x.get<double>();
    return number == std::numeric_limits<double>::max() ? std::numeric_limits<double>::infinity() : number;
}

TEST(AuditHtml, IsWellFormedWithAndWithoutPictures) {
    std::vector<Kernel> kernels;
    for (const KernelResult& k : audited().kernels) kernels.push_back(k.kernel);
    expect_well_formed(page_of(audited()), true);
    const std::string page = page_of(audited(), {.command_line = "a && b < c", .signs = sign_pictures(kernels)});
    expect_well_formed(page, true);
    EXPECT_TRUE(has(page, "<code class=\"copy\">a &amp;&amp; b &lt; c</code>"));
    EXPECT_TRUE(has(page, "src=\"data:image/png;base64,iVBOR"));
    EXPECT_LT(page.size(), 2'000'000U);
    expect_well_formed(page_of(only_kernel("triangle.signed-area")), true);
}

TEST(AuditHtml, TheLeagueIsTheJson) {
    const std::string page = page_of(audited());
    const Json report = Json::parse(audit_json(audited()));
    std::size_t at = 0;
    for (const Json& k : report["kernels"]) {
        const std::string name = k["name"];
        SCOPED_TRACE(name);
        // In the same order.
        const std::size_t here = page.find("<th scope=\"row\">" + report::html_name(name) + "</th>");
        ASSERT_NE(here, std::string::npos);
        EXPECT_GT(here, at);
        at = here;
        const Cells cells = row_of(page, "Kernels, worst first", name);
        ASSERT_EQ(cells.numbers.size(), 10U);
        const std::uint64_t cases = k["cases"];
        EXPECT_EQ(cells.shown[0], std::to_string(cases));
        EXPECT_EQ(cells.numbers[0], cases);
        EXPECT_EQ(cells.numbers[1], share(k["wrong_cases"], cases));
        EXPECT_EQ(cells.numbers[2], share(k["false_outside"], exactly(k, "interior") + exactly(k, "boundary")));
        EXPECT_EQ(cells.numbers[3], share(k["false_inside"], exactly(k, "outside")));
        EXPECT_EQ(cells.numbers[4], share(k["by_error"].back(), cases - exactly(k, "degenerate")));
        EXPECT_EQ(cells.numbers[6], figure(k["worst_error"]));
        double meshes = -1;
        for (const Json& f : k["families"]) {
            if (f["name"].get<std::string>().starts_with("mesh.")) meshes = std::max(meshes, figure(f["worst_error"]));
        }
        EXPECT_EQ(cells.numbers[7], meshes);
        EXPECT_EQ(cells.numbers[8], figure(k["worst_weight_ulp"]));
        EXPECT_EQ(cells.numbers[9], k["ns"]);
        // The bars of its histogram hold the cases that by_error has.
        std::uint64_t errors = 0, bars = 0;
        for (const Json& n : k["by_error"]) errors += n.get<std::uint64_t>();
        const std::size_t figure_at = page.find("<title>" + name + ": number of cases");
        EXPECT_EQ(figure_at == std::string::npos, errors == 0);
        if (errors == 0) continue;
        const std::string svg = page.substr(figure_at, page.find("</svg>", figure_at) - figure_at);
        static const std::regex bar(": ([0-9]+) cases</title>");
        for (std::sregex_iterator it(svg.begin(), svg.end(), bar), end; it != end; ++it) bars += std::stoull((*it)[1]);
        EXPECT_EQ(bars, errors);
        EXPECT_EQ(errors, cases - exactly(k, "degenerate"));
    }
}

TEST(AuditHtml, EveryWitnessOfTheJsonHasItsCommand) {
    const std::string page = page_of(audited(), {.style = {.witness_path = "it's.json"}});
    const Json report = Json::parse(audit_json(audited()));
    EXPECT_GT(report["witnesses"].size(), 100U);
    for (const Json& w : report["witnesses"]) {
        const std::string command = "barycert replay 'it'\\''s.json' --kernel " + w["kernel"].get<std::string>() +
                                    " --reason " + w["reason"].get<std::string>();
        EXPECT_TRUE(has(page, "<code class=\"copy\">" + command + "</code>")) << command;
    }
}

TEST(AuditHtml, OfOneKernelItsFamilies) {
    const AuditReport report = only_kernel("tetrahedron.cramer");
    const std::string page = page_of(report);
    const Json kernel = Json::parse(audit_json(report))["kernels"][0];
    EXPECT_TRUE(has(page, "tetrahedron.cramer is wrong in "));
    EXPECT_TRUE(has(page, "<dt>formula</dt>"));
    for (const Json& f : kernel["families"]) {
        const std::size_t at = page.find(">" + report::html_name(f["name"].get<std::string>()) + "</th>");
        ASSERT_NE(at, std::string::npos) << f["name"];
        const std::string row = page.substr(at, page.find("</tr>", at) - at);
        EXPECT_TRUE(has(row, "data-v=\"" + std::to_string(f["cases"].get<int>()) + "\""));
    }
}

TEST(AuditHtml, Verdicts) {
    EXPECT_TRUE(has(page_of(audited()), "<section class=\"verdict bad\"><b>"));
    EXPECT_TRUE(has(page_of(audited()), "Certified and wrong all the same: tetrahedron.stubborn."));
    const std::string right = page_of(only_kernel("triangle.exact"));
    EXPECT_TRUE(has(right, "<section class=\"verdict good\"><b>triangle.exact: no wrong answer in "));
    EXPECT_TRUE(has(right, "No witness: every weight and value is correctly rounded."));
}

TEST(AuditHtml, CommandsBeginAsTheUserCallsTheProgram) {
    AuditReport report = audited();
    report.verdicts.assign(report.meshes.size(), Verdict::not_certified);
    EXPECT_TRUE(has(page_of(report, {.style = {.command = "./run barycert"}}), "(why: ./run barycert check MESH)"));
}

TEST(AuditHtml, NoTimeWhereNothingWasTimed) {
    AuditReport report = only_kernel("triangle.signed-area");
    EXPECT_TRUE(has(page_of(report), " ns an evaluation"));
    report.kernels.front().ns = 0;
    EXPECT_FALSE(has(page_of(report), " ns an evaluation"));
    report.kernels.push_back(report.kernels.front());
    EXPECT_EQ(row_of(page_of(report), "Kernels, worst first", "triangle.signed-area").shown.back(), "-");
}

TEST(AuditHtml, SaysHowItWasMadeOnce) {
    const std::string page = page_of(audited()), line = environment_line(audited().environment);
    const std::size_t at = page.find(line);
    ASSERT_NE(at, std::string::npos);
    EXPECT_EQ(page.find(line, at + 1), std::string::npos);
    EXPECT_TRUE(has(page, "<dd>seed 1, 30 cases per family and simplex, 2 threads, "));
}

TEST(AuditHtml, TextFromOutsideStaysText) {
    AuditReport report = audited();
    const std::string evil = "<script>alert(1)</script>&\"'\x1b\xff";
    report.meshes = {evil};
    report.verdicts = {Verdict::not_certified};
    for (KernelResult& k : report.kernels) {
        k.kernel.name = "triangle." + evil;
        k.kernel.formula = k.kernel.source = k.kernel.fails = evil;
        k.kernel.note = evil;
        for (Witness& w : k.witnesses) {
            w.kernel = k.kernel.name;
            w.family = w.mesh = w.detail = evil;
            w.cell = 7;
        }
    }
    for (Family& f : report.families) f.name = f.tests = evil;
    std::vector<SignPicture> signs = sign_pictures(kernels_matching("triangle.signed-area"));
    signs.back().kernel = evil;
    const AuditPage page{
        .style = {.command = evil, .witness_path = {}, .mesh_arguments = {evil}, .library_arguments = {evil}},
        .command_line = evil,
        .signs = signs};
    expect_well_formed(page_of(report, page), true);
    EXPECT_FALSE(has(page_of(report, page), "<script>alert"));
    // They are there, as text: the note, and of a witness its family, mesh and detail.
    const std::string text = "&lt;script&gt;alert(1)&lt;/script&gt;&amp;&quot;'";
    const std::string full = page_of(report, page);
    EXPECT_TRUE(has(full, "<p>" + text));
    const std::size_t cell = full.find(", cell 7 of " + text);
    ASSERT_NE(cell, std::string::npos);
    const std::size_t start = full.rfind("<p>", cell);
    const std::string line = full.substr(start, full.find("</p>", start) - start);
    EXPECT_TRUE(line.starts_with("<p>" + text)) << line;
    EXPECT_TRUE(has(line, ": " + text)) << line;
    report.kernels.resize(1);
    expect_well_formed(page_of(report, page), true);
    EXPECT_FALSE(has(page_of(report, page), "<script>alert"));
}

/// Two pixels of two cells, one of them beside the mesh.
MeshMap small_map() {
    MeshMap map;
    map.mesh = "a & b";
    map.axis = 1;
    map.at = 0.5;
    map.low = {0, -1};
    map.high = {2, 1};
    map.width = 3;
    map.height = 1;
    map.pixels = {0, 1, -1};
    map.cells = {7, 9};
    const double none = std::numeric_limits<double>::infinity();
    map.kernels.push_back({.kernel = "triangle.a<b", .errors = {3e-9, 2e-16}, .cases = 8, .wrong = 2});
    map.kernels.push_back({.kernel = "triangle.silent", .errors = {0, none}, .cases = 8, .wrong = 4});
    map.kernels.push_back({.kernel = "triangle.right", .errors = {0, 0}, .cases = 8, .wrong = 0});
    map.kernels.push_back({.kernel = "triangle.gone", .errors = {-1, -1}, .cases = 0, .wrong = 0});
    map.left_out = 3;
    return map;
}

TEST(AuditHtml, MapsOfMeshes) {
    EXPECT_FALSE(has(page_of(audited()), "Maps of the mesh"));
    MeshMap none;
    none.mesh = "<broken>";
    none.why_not = "node 3 is <not> finite";
    const std::string page = page_of(audited(), {.maps = {small_map(), none}});
    expect_well_formed(page, true);
    EXPECT_TRUE(has(page, "<h2>Maps of the meshes</h2>"));
    EXPECT_TRUE(has(page, "<h3>a &amp; b</h3>"));
    EXPECT_TRUE(has(page, "section at y = 0.5, x from 0 to 2 to the right, z from -1 to 1 upwards; 2 cells are seen."));
    EXPECT_TRUE(has(page, " 4 of 7 kernels, worst first, without variants; others: --kernel NAME."));
    EXPECT_TRUE(has(page, "triangle.a&lt;b<br/>largest error <b>3e-09</b>, in cell 7; 25.0 % of the points wrong"));
    EXPECT_TRUE(has(page, "triangle.silent<br/>no finite answer in cell 9; 50.0 % of the points wrong"));
    EXPECT_TRUE(has(page, "triangle.right<br/>no error; 0 % of the points wrong"));
    EXPECT_TRUE(has(page, "triangle.gone<br/>given up; "));
    EXPECT_TRUE(has(page, "No map: node 3 is &lt;not&gt; finite"));
    // From 2e-16 to 3e-9: eight powers of ten have a colour.
    EXPECT_TRUE(has(page, "</i>&lt; 1e-15</span>"));
    EXPECT_TRUE(has(page, "</i>&lt; 1e-8</span>"));
    EXPECT_FALSE(has(page, "</i>&lt; 1e-16</span>"));
    EXPECT_FALSE(has(page, "</i>&lt; 1e-7</span>"));
}

TEST(Page, Base64) {
    using report::data_uri;
    EXPECT_EQ(data_uri("a/b", ""), "data:a/b;base64,");
    EXPECT_EQ(data_uri("a/b", "M"), "data:a/b;base64,TQ==");
    EXPECT_EQ(data_uri("a/b", "Ma"), "data:a/b;base64,TWE=");
    EXPECT_EQ(data_uri("a/b", "Man"), "data:a/b;base64,TWFu");
    EXPECT_EQ(data_uri("a/b", std::string_view("\xff\x00\xfe\x7f", 4)), "data:a/b;base64,/wD+fw==");
}

}  // namespace
}  // namespace barycert::report_test
