// The report on a mesh as an HTML page: well-formed, complete, bounded, whatever the mesh.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "app/report/check/check_pictures.hpp"
#include "barycert/raster.hpp"
#include "barycert/report.hpp"
#include "check_meshes.hpp"
#include "draw/axes.hpp"
#include "lines.hpp"
#include "tests/io/tetgen/mesh_files.hpp"
#include "well_formed.hpp"

namespace barycert::report_test {
namespace {

using report::BinRule;
using report::Bins;
using report::Vector;
using Kind = BinRule::Kind;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::size_t count(const std::string& text, std::string_view part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
}

/// Cells in each histogram: in bars and counted apart, together.
std::vector<std::uint64_t> cells_in_histograms(const std::string& page) {
    std::vector<std::uint64_t> sums;
    static const std::regex bar(" to [^:<]*: ([0-9,]+) cells?</title>"), counted(": ([0-9,]+)");
    const auto number = [](std::string digits) {
        std::erase(digits, ',');
        return static_cast<std::uint64_t>(std::stoull(digits));
    };
    // A picture, or a sentence in its place.
    static const std::regex mark(": number of cells</title>|: no cell in a bar\\.");
    for (std::sregex_iterator m(page.begin(), page.end(), mark), last; m != last; ++m) {
        const auto at = static_cast<std::size_t>(m->position());
        const std::string figure =
            page.substr(at, page.find(page[at + 2] == 'n' && page[at + 3] == 'u' ? "</figure>" : "</p>", at) - at);
        std::uint64_t sum = 0;
        for (std::sregex_iterator it(figure.begin(), figure.end(), bar), end; it != end; ++it) sum += number((*it)[1]);
        const std::size_t rest = figure.find("Not in the bars");
        if (rest != std::string::npos) {
            const std::string clauses = figure.substr(rest + std::string("Not in the bars:").size());
            for (std::sregex_iterator it(clauses.begin(), clauses.end(), counted), end; it != end; ++it)
                sum += number((*it)[1]);
        }
        sums.push_back(sum);
    }
    return sums;
}

std::string page_of(const Mesh& mesh, const std::string& name = "mesh") {
    return check_html(checked(mesh, true), mesh, name);
}

void expect_complete(const Mesh& mesh) {
    const std::string page = page_of(mesh);
    expect_well_formed(page);
    EXPECT_EQ(cells_in_histograms(page), std::vector<std::uint64_t>(6, mesh.cell_count()));
    EXPECT_LT(page.size(), 2000000U);
}

Mesh scaled(Mesh mesh, double factor) {
    for (double& x : mesh.points) x *= factor;
    return mesh;
}

std::uint64_t all(const Bins& h) {
    std::uint64_t sum = h.unknown + h.infinite + h.zero;
    for (const std::uint64_t c : h.counts) sum += c;
    return sum;
}

TEST(CheckHtml, SaysWhatIsWrongBeforeAllAndPraisesNothingElse) {
    const Mesh mesh = cracked_and_hanging();
    const std::string page = check_html(checked(mesh), mesh, "part");
    EXPECT_FALSE(contains(page, "exactly equal")) << "green, on a page that says NOT certified";
    EXPECT_TRUE(contains(page, "node 0 within edge 9 10 of cell 2"));
    EXPECT_TRUE(contains(page, "Red: cells with defects.")) << "a legend of the map";
    EXPECT_LT(page.find("<svg"), page.find("of cells that meet where they must not")) << "pictures before numbers";
    const Mesh good = pair_of_cells();
    EXPECT_TRUE(contains(check_html(checked(good), good, "part"), "exactly equal"));
    // Where no cell has a value there is no picture of it, but a sentence.
    const Mesh flat = tetrahedra(pair_of_cells().points, {0, 1, 2, 9});
    const std::string of_flat = check_html(checked(flat), flat, "part");
    const std::size_t shapes = of_flat.find("Shapes and sizes of the cells");
    ASSERT_NE(shapes, std::string::npos);
    EXPECT_EQ(of_flat.find("<svg", shapes), std::string::npos);
    EXPECT_NE(of_flat.find("no cell in a bar", shapes), std::string::npos);
}

/// Pixels of each colour in the first picture behind `at`.
std::map<Rgba, std::size_t> colours_of_picture(const std::string& page, std::size_t at) {
    constexpr std::string_view head = "data:image/png;base64,",
                               letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    std::uint32_t bits = 0, count = 0;
    for (at = page.find(head, at) + head.size(); letters.find(page[at]) != std::string_view::npos; ++at) {
        bits = bits << 6 | static_cast<std::uint32_t>(letters.find(page[at]));
        if ((count += 6) < 8) continue;
        count -= 8;
        bytes += static_cast<char>(bits >> count & 0xFFU);
    }
    const testing::TemporaryFolder folder;
    std::ofstream(folder / "p.png", std::ios::binary) << bytes;
    const Image image = read_png(folder / "p.png").value();
    std::map<Rgba, std::size_t> all;
    for (std::int32_t k = 0; k < image.width * image.height; ++k) ++all[image.pixel(k % image.width, k / image.width)];
    return all;
}

TEST(CheckHtml, MeshesInThePlaneAreDrawnBesideTheirDefects) {
    Mesh plane;
    plane.dimension = 2;
    plane.points = {0, 0, 2, 0, 0, 2, 1, 1, 2, 2};
    plane.cells = {0, 1, 2, 1, 3, 4};
    const std::string page = check_html(checked(plane), plane, "part");
    const std::size_t map = page.find("class=\"map\"");
    ASSERT_NE(map, std::string::npos);
    // Cells with defects are red, those with the smallest angles as well, which others are blue.
    auto colours = colours_of_picture(page, map);
    EXPECT_GT((colours[{200, 16, 46, 255}]), 1000U);
    EXPECT_EQ((colours[{0, 114, 178, 255}]), 0U);
    plane.cells = {0, 1, 2};
    const std::string good = check_html(checked(plane), plane, "part");
    colours = colours_of_picture(good, good.find("class=\"map\""));
    EXPECT_GT((colours[{0, 114, 178, 255}]), 1000U);
}

TEST(Bins, EveryValueIsCountedOnce) {
    const std::vector<std::vector<double>> samples{
        {},
        {nan},
        {infinity, infinity},
        {0},
        {0, 0, nan},
        {1, 1, 1},
        {1, 2, 3, 4, 1000, infinity, nan, 0},
        {5e-324, 1.7976931348623157e308, 0},
        {1.7976931348623157e308, 1.7976931348623157e308},
        {0.5, 0.5000000000000001},
        {5e-324},
    };
    for (const std::vector<double>& values : samples) {
        for (const Kind kind : {Kind::given, Kind::linear, Kind::logarithmic, Kind::chosen}) {
            const Bins h = report::bins_of(values, {kind, 0, 10, 0.5});
            EXPECT_EQ(all(h), values.size());
            EXPECT_GE(h.counts.size(), 1U);
            EXPECT_TRUE(std::isfinite(h.low) && std::isfinite(h.high()) && h.width > 0);
            EXPECT_LE(h.counts.size(), 52U);
        }
    }
}

TEST(Bins, BinsAreRoundAndWhereTheyShouldBe) {
    const Bins given = report::bins_of({0, 1.9, 2, 71.9, 80}, {Kind::given, 0, 72, 2});
    ASSERT_EQ(given.counts.size(), 36U);
    EXPECT_EQ(given.counts[0], 2U);
    EXPECT_EQ(given.counts[1], 1U);
    EXPECT_EQ(given.counts[35], 2U);  // 80 as well
    const Bins plain = report::bins_of({1, 10}, {.kind = Kind::chosen});
    EXPECT_FALSE(plain.logarithmic);
    EXPECT_DOUBLE_EQ(plain.width, 0.2);
    const Bins wide = report::bins_of({1, 1e6}, {.kind = Kind::chosen});
    EXPECT_TRUE(wide.logarithmic);
    EXPECT_EQ(wide.counts.front(), 1U);
    const Bins flat = report::bins_of({0, 1, 100}, {.kind = Kind::logarithmic});
    EXPECT_EQ(flat.zero, 1U);
}

TEST(Labels, KeepClearOfEachOther) {
    report::Picture svg(240, 184, "labels");
    std::vector<report::Label> labels;
    for (int i = 0; i < 6; ++i) labels.push_back({{100 + 7.0 * i, 90}, std::to_string(1234560 + i), "id"});
    place_labels(svg, labels, 20);
    const std::string text = svg_markup(svg);
    static const std::regex place("class=\"id m\" x=\"([-0-9.]+)\" y=\"([-0-9.]+)\">");
    std::vector<std::pair<double, double>> at;
    for (std::sregex_iterator it(text.begin(), text.end(), place), end; it != end; ++it)
        at.emplace_back(std::stod((*it)[1]), std::stod((*it)[2]));
    ASSERT_EQ(at.size(), 6U);
    for (std::size_t i = 0; i < at.size(); ++i) {
        EXPECT_GT(at[i].first, 20);
        EXPECT_LT(at[i].first, 220);
        for (std::size_t j = 0; j < i; ++j) {
            EXPECT_TRUE(std::fabs(at[i].first - at[j].first) > 45 || std::fabs(at[i].second - at[j].second) > 11);
        }
    }
}

TEST(View, ScaleDoesNotMatter) {
    const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.25, 0.25, 0.5};
    std::vector<Vector> first;
    for (const double factor : {1.0, 0x1p1000, 0x1p-1000, 0x1p1023, -0x1p1022}) {
        double p[12];
        for (int i = 0; i < 12; ++i) p[i] = corners[i] * factor;
        const report::Normalised n(3, {p, p + 3, p + 6, p + 9});
        if (first.empty()) first = n.points();
        for (std::size_t i = 0; i < 4; ++i) {
            for (int k = 0; k < 3; ++k) EXPECT_DOUBLE_EQ(std::fabs(n.points()[i][k]), std::fabs(first[i][k]));
        }
    }
    // The largest difference of doubles.
    const double low[] = {-1.7e308, -1.7e308}, high[] = {1.7e308, 1e-300};
    const report::Normalised n(2, {low, high});
    EXPECT_EQ(n.points()[0][0], -1);
    EXPECT_EQ(n.points()[1][0], 1);
}

TEST(View, AFlatCellIsSeenFlatFromTheSide) {
    const std::vector<Vector> flat{{-1, -1, 0}, {1, -1, 1e-6}, {1, 1, 0}, {-1, 1, 1e-6}};
    const report::View side = report::broad_view(flat, 0), above = report::broad_view(flat, 1);
    for (const Vector& p : flat) EXPECT_LT(std::fabs(side(p)[1]), 1e-5);
    EXPECT_GT(std::fabs(above.z[2]), 0.999);
    const auto edge = report::sharpest_edge(flat);
    const report::View along = report::along_edge(flat, edge);
    EXPECT_NEAR(along.x.dot(along.y), 0, 1e-12);
    const Vector e = flat[edge[1]] - flat[edge[0]];
    EXPECT_NEAR(along(e)[0], 0, 1e-12);
    EXPECT_NEAR(along(e)[1], 0, 1e-12);
}

TEST(CheckHtml, GoodMeshes) {
    for (const char* name : {"flange", "plate", "needle-slit", "cube-hole-o2", "lattice-eighths"}) {
        SCOPED_TRACE(name);
        const Mesh mesh = own_mesh(name);
        expect_complete(mesh);
        const std::string page = page_of(mesh, name);
        EXPECT_TRUE(has(page, "<b>Certified</b>"));
        EXPECT_FALSE(has(page, "Cells with defects"));
        EXPECT_EQ(count(page, "<figure class=\"card\">"), 6U);
        EXPECT_FALSE(has(page, "violations</th></tr>\n</table>"));
        EXPECT_EQ(page.find(mesh.dimension == 2 ? "tetrahedr" : "triangles</span>"), std::string::npos);
    }
}

TEST(CheckHtml, BrokenMeshes) {
    for (const Mesh& mesh : {overlapping(), thoroughly_broken(), broken_plane()}) {
        expect_complete(mesh);
        const std::string page = page_of(mesh);
        EXPECT_TRUE(has(page, "<b>NOT certified</b>"));
        EXPECT_TRUE(has(page, "Cells with defects"));
        EXPECT_TRUE(has(page, "Defects and remedies"));
        EXPECT_TRUE(has(page, "class=\"witness\""));
        for (const Defect& f : checked(mesh).defects)
            EXPECT_TRUE(has(page, report::xml_escaped(defect_text(f.kind).text))) << defect_text(f.kind).name;
    }
}

TEST(CheckHtml, TheExhibitsAreTheWorstCells) {
    const Mesh mesh = own_mesh("needle-slit");
    const CheckReport r = checked(mesh);
    const auto worst = report::worst_cells(r, mesh, 6);
    ASSERT_EQ(worst.size(), 6U);
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        bool shown = false;
        for (const report::Exhibit& e : worst) shown |= e.cells[0] == static_cast<Mesh::Index>(cell);
        const auto last = static_cast<std::size_t>(worst.back().cells[0]);
        EXPECT_TRUE(shown || r.measures.min_angle[cell] >= r.measures.min_angle[last]) << cell;
    }
    EXPECT_TRUE(report::defect_cells(r, mesh, 6).empty());
    // A degenerate cell is a problem, not the worst shape; each kind of problem gets its turn.
    const Mesh broken = thoroughly_broken();
    const CheckReport found = checked(broken);
    for (const report::Exhibit& e : report::worst_cells(found, broken, 6))
        EXPECT_NE(found.measures.orientation[static_cast<std::size_t>(e.cells[0])], 0);
    bool degenerate = false, overlap = false;
    for (const report::Exhibit& e : report::defect_cells(found, broken, 6)) {
        degenerate |= has(e.what, "degenerate cell");
        overlap |= e.contact != nullptr && e.contact->overlap;
    }
    EXPECT_TRUE(degenerate);
    EXPECT_TRUE(overlap);
}

TEST(CheckHtml, NothingToLookAt) {
    expect_well_formed(page_of(Mesh{}));
    EXPECT_TRUE(has(page_of(Mesh{}), "no cells"));
    Mesh plane;
    plane.dimension = 2;
    plane.points = {0, 0, 1, 1};
    expect_well_formed(page_of(plane));
    // Arrays that do not make cells, and dimensions that are none.
    expect_well_formed(page_of(tetrahedra({0, 0, 0, 1}, {0, 1, 2})));
    expect_well_formed(page_of(tetrahedra({0, 0, 0, 1, 1}, {0, 1, 2, 3})));
    for (const int dimension : {1, 7}) {
        Mesh mesh = overlapping();
        mesh.dimension = dimension;
        const std::string page = page_of(mesh);
        expect_well_formed(page);
        EXPECT_TRUE(has(page, "not checked"));
    }
}

TEST(CheckHtml, CellsWithoutAPlaceAreNotDrawn) {
    Mesh mesh = pair_of_cells();
    mesh.points.insert(mesh.points.end(), {nan, 0, 0, 0, infinity, 0});
    mesh.cells.insert(mesh.cells.end(),
                      {0, 1, 2, 5, 0, 1, 2, 6, 0, 1, 2, 7, -1, 1, 2, 3, 0, 1, 2, 2147483647, 0, 0, 0, 0});
    expect_complete(mesh);
    EXPECT_TRUE(has(page_of(mesh), "cells with no place in space: 6"));
    // Not one cell that could be drawn.
    expect_complete(tetrahedra({0, 0, 0}, {0, 1, 2, 3}));
    expect_complete(tetrahedra({nan, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 1, 2, 3}));
    expect_complete(tetrahedra({1, 2, 3}, {0, 0, 0, 0}));
    expect_complete(tetrahedra({1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3}, {0, 1, 2, 3}));  // a point
    expect_complete(tetrahedra({0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3}, {0, 1, 2, 3}));  // collinear
}

TEST(CheckHtml, ExtremeCoordinates) {
    for (const double factor : {1e300, 1e-300, 1e308, 5e-324, 1e-160, 1e100}) {
        SCOPED_TRACE(factor);
        expect_complete(scaled(pair_of_cells(), factor));
        expect_complete(scaled(broken_plane(), factor));
        expect_complete(scaled(overlapping(), factor));
    }
    Mesh mixed = pair_of_cells();
    for (std::size_t i = 0; i < mixed.points.size(); i += 3) mixed.points[i] *= 1e300, mixed.points[i + 1] *= 1e-300;
    expect_complete(mixed);
    Mesh far = pair_of_cells();
    for (double& x : far.points) x += 0x1p50;
    expect_complete(far);
}

TEST(CheckHtml, NamesCannotBreakOut) {
    const std::string page = page_of(pair_of_cells(), "a<b>&\"</title><script>\xff\xc3(\x01");
    expect_well_formed(page);
    EXPECT_TRUE(has(page, "a&lt;b&gt;&amp;&quot;&lt;/title&gt;&lt;script&gt;\xef\xbf\xbd\xef\xbf\xbd( "));
    EXPECT_EQ(report::xml_escaped("κ ≥ 1 \xf0\x9f\x98\x80"), "κ ≥ 1 \xf0\x9f\x98\x80");
    EXPECT_EQ(report::xml_escaped("\xed\xa0\x80\xc0\x80"),
              "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd");
}

/// Cubes of six cells each, all of them with wide bins and many boundary facets.
Mesh cubes(int n) {
    Mesh mesh;
    const auto node = [&](int i, int j, int k) { return static_cast<Mesh::Index>((i * (n + 1) + j) * (n + 1) + k); };
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
            for (int k = 0; k <= n; ++k) mesh.points.insert(mesh.points.end(), {1.0 * i, 1.0 * j, 1.0 * k});
        }
    }
    constexpr int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (int cube = 0; cube < n * n * n; ++cube) {
        for (const auto& axes : order) {
            int at[3] = {cube / n / n, cube / n % n, cube % n};
            mesh.cells.push_back(node(at[0], at[1], at[2]));
            for (const int axis : axes) {
                ++at[axis];
                mesh.cells.push_back(node(at[0], at[1], at[2]));
            }
        }
    }
    return mesh;
}

TEST(CheckHtml, SizeIsBounded) {
    const Mesh large = cubes(30);  // 162,000 cells
    expect_complete(large);
    // However many places and contacts are kept.
    Mesh folded = cubes(3);
    const Mesh again = folded;
    for (const Mesh::Index i : again.cells) folded.cells.push_back(i + static_cast<Mesh::Index>(again.point_count()));
    for (const double x : again.points) folded.points.push_back(x * 0.9 + 0.05);
    CheckOptions options;
    options.examples = options.contacts = 100000;
    const std::string page = check_html(check_mesh(folded, options), folded, "folded");
    expect_well_formed(page);
    EXPECT_LT(page.size(), 400000U);
}

}  // namespace
}  // namespace barycert::report_test
