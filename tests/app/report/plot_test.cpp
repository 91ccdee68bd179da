// The picture of errors against condition numbers: what it shows, and that it can be read.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "barycert/audit_report.hpp"
#include "draw/axes.hpp"
#include "small_audit.hpp"

namespace barycert::report_test {
namespace {

AuditReport only(const std::string& glob) {
    AuditReport report = audited();
    const std::vector<Kernel> wanted = kernels_matching(glob);
    std::erase_if(report.kernels, [&](const KernelResult& k) {
        return std::none_of(wanted.begin(), wanted.end(), [&](const Kernel& w) { return w.name == k.kernel.name; });
    });
    return report;
}

struct Text {
    double left, right, top, bottom;
    std::string words;
};

/// Texts that are read from left to right, with the room they take: letters are at most 0.6 of their size wide on
/// average in the fonts named.
std::vector<Text> texts(const std::string& svg) {
    const std::regex text(
        "<text font-size=\"([0-9.]+)\" fill=\"[^\"]*\"([^>]*) x=\"([-0-9.]+)\" y=\"([-0-9.]+)\"([^>]*)>([^<]*)</text>");
    std::vector<Text> out;
    for (std::sregex_iterator it(svg.begin(), svg.end(), text), end; it != end; ++it) {
        const std::string style = (*it)[2].str(), words = (*it)[6];
        const double size = std::stod((*it)[1]), x = std::stod((*it)[3]), y = std::stod((*it)[4]);
        const auto is = [&](const char* word) { return style.find(word) != std::string::npos; };
        if ((*it)[5].str().find("rotate") != std::string::npos) continue;
        const auto letters = std::count_if(words.begin(), words.end(), [](char c) { return (c & 0xc0) != 0x80; });
        const double width = 0.53 * size * static_cast<double>(letters);
        const double left = is("middle") ? x - width / 2 : is("end") ? x - width : x;
        out.push_back({left, left + width, y - 0.75 * size, y + 0.2 * size, words});
    }
    return out;
}

/// Drawn, self-contained, inside its frame, no text over another.
void expect_readable(const std::string& svg) {
    EXPECT_TRUE(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 980 620\""));
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
    for (const char* alien : {"nan", "inf\"", "href", "url(", "<script", "<image"})
        EXPECT_EQ(svg.find(alien), std::string::npos) << alien;
    const std::regex number("(?:x=\"|y=\"|cx=\"|cy=\"|M|L|M[-0-9.]+ |L[-0-9.]+ )([-0-9.]+)");
    for (std::sregex_iterator it(svg.begin(), svg.end(), number), end; it != end; ++it) {
        EXPECT_GE(std::stod((*it)[1]), 0) << it->str();
        EXPECT_LE(std::stod((*it)[1]), 980) << it->str();
    }
    const std::vector<Text> all = texts(svg);
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_GE(all[i].left, 0) << all[i].words;
        EXPECT_LE(all[i].right, 980) << all[i].words;
        EXPECT_LE(all[i].bottom, 620) << all[i].words;
        for (std::size_t j = 0; j < i; ++j) {
            const bool apart = all[i].left >= all[j].right || all[j].left >= all[i].right ||
                               all[i].top >= all[j].bottom || all[j].top >= all[i].bottom;
            EXPECT_TRUE(apart) << all[i].words << " / " << all[j].words;
        }
    }
}

/// The kernels in the legend.
std::set<std::string> shown(const std::string& svg) {
    std::set<std::string> names;
    const std::vector<Text> all = texts(svg);
    for (std::size_t i = 1; i < all.size(); ++i) {
        if (all[i].words.starts_with("worst factor ")) names.insert(all[i - 1].words);
    }
    return names;
}

TEST(Svg, TicksAreRoundAndFew) {
    EXPECT_EQ(draw::round_numbers(0, 10, 12), (std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}));
    EXPECT_EQ(draw::round_numbers(-2, 58, 12), (std::vector<double>{0, 5, 10, 15, 20, 25, 30, 35, 40, 45, 50, 55}));
    EXPECT_EQ(draw::round_numbers(0, 1100, 6), (std::vector<double>{0, 200, 400, 600, 800, 1000}));
    for (int max = 2; max < 15; ++max) {
        for (double high = 0.37; high < 2000; high *= 1.7) {
            const auto ticks = draw::round_numbers(-high / 3, high, max);
            EXPECT_LE(ticks.size(), static_cast<std::size_t>(max)) << high;
            EXPECT_GE(ticks.size(), 1U) << high;
        }
    }
}

TEST(Svg, NamesCannotBreakOut) {
    EXPECT_EQ(draw::xml_escaped("a<b>&\"c\n\x01"), "a&lt;b&gt;&amp;&quot;c  ");
    draw::Picture svg(10, 10, "\"/><script>");
    svg.text({0, 0}, "</text><script>", "");
    EXPECT_EQ(draw::svg_markup(svg).find("<script"), std::string::npos);
}

TEST(Svg, ALineIsCutAtTheFrame) {
    const draw::Axis x{.low = 0, .high = 10, .from = 100, .to = 200, .title = {}};
    const draw::Axis y{.low = 0, .high = 5, .from = 300, .to = 200, .title = {}};
    const auto drawn = [&](draw::Pixel a, draw::Pixel b) {
        draw::Picture svg(400, 400, "");
        draw::draw_line_through(svg, x, y, a, b, "");
        return draw::svg_markup(svg);
    };
    EXPECT_NE(drawn({1, 1}, {2, 2}).find("M100.0 300.0L150.0 200.0"), std::string::npos);
    EXPECT_NE(drawn({0, 3}, {1, 3}).find("M100.0 240.0L200.0 240.0"), std::string::npos);
    EXPECT_EQ(drawn({0, 6}, {1, 6}).find("<path"), std::string::npos);
}

TEST(Plot, OfEverythingShowsSixKernels) {
    const std::string svg = condition_plot(audited());
    expect_readable(svg);
    const auto names = shown(svg);
    EXPECT_EQ(names.size(), 6U);
    EXPECT_TRUE(names.contains("homogeneous") || names.contains("stubborn"));
    for (const std::string& name : names) EXPECT_EQ(name.find('.'), std::string::npos) << name;
    EXPECT_NE(svg.find("prediction: κ"), std::string::npos);
    EXPECT_NE(svg.find("without variants"), std::string::npos);
    EXPECT_NE(svg.find(": tetrahedra</title>"), std::string::npos);
    EXPECT_EQ(svg, condition_plot(audited()));
}

TEST(Plot, OfAFewShowsThemVariantsToo) {
    const std::string svg = condition_plot(only("tetrahedron.signed-volume*"));
    expect_readable(svg);
    EXPECT_EQ(svg.find("without variants"), std::string::npos);
    EXPECT_EQ(shown(svg), (std::set<std::string>{"signed-volume", "signed-volume.O0", "signed-volume.contracted",
                                                 "signed-volume.fast-math", "signed-volume.float32"}));
}

TEST(Plot, OfTrianglesIfThereAreNoTetrahedra) {
    const std::string svg = condition_plot(only("triangle.*"));
    expect_readable(svg);
    EXPECT_NE(svg.find(": triangles</title>"), std::string::npos);
    EXPECT_EQ(shown(svg).size(), 6U);
}

TEST(DriftPlot, ShowsEachKernelByName) {
    DriftOptions options;
    options.kernels = kernels_matching("triangle.scanline-increments*");
    options.kernels.push_back(kernels_matching("triangle.exact").at(0));
    options.count = 100;
    const DriftReport report = measure_drift(options).value();
    const std::string svg = drift_plot(report);
    expect_readable(svg);
    std::set<std::string> words;
    for (const Text& t : texts(svg)) words.insert(t.words);
    for (const char* word :
         {"scanline-increments", "scanline-increments.float32", "exact", "4", "64", "4096", "0", "2⁰"})
        EXPECT_TRUE(words.contains(word)) << word;
    EXPECT_EQ(svg, drift_plot(report));
    EXPECT_NE(svg.find("<rect width=\"980\" height=\"620\" fill=\"#ffffff\"/>"),
              std::string::npos);  // in dark mode too
}

TEST(DriftPlot, OfManyOrNoneStaysReadable) {
    DriftOptions options;
    options.kernels = kernels_matching("triangle.*");
    std::erase_if(options.kernels, [](const Kernel& k) { return k.perspective; });
    options.count = 20;
    const DriftReport report = measure_drift(options).value();
    EXPECT_GT(report.curves.size(), 6U);
    expect_readable(drift_plot(report));
    expect_readable(drift_plot({}));
}

TEST(Plot, AxesFitTheData) {
    AuditReport report = only("tetrahedron.signed-volume");
    ASSERT_EQ(report.kernels.size(), 1U);
    report.kernels[0].prediction = Prediction();
    for (int bits = 20; bits < 30; ++bits)
        report.kernels[0].prediction.add(std::ldexp(1.5, bits), std::ldexp(1, bits - 60));
    const std::string svg = condition_plot(report);
    expect_readable(svg);
    // From 20 bits at the left to 30 at the right.
    EXPECT_TRUE(std::regex_search(svg, std::regex("<text [^>]*middle\" x=\"76\\.0\" y=\"519\\.0\"[^>]*>20</text>")));
    EXPECT_TRUE(std::regex_search(svg, std::regex("<text [^>]*middle\" x=\"700\\.0\" y=\"519\\.0\"[^>]*>30</text>")));
    // Upwards no farther than the errors, 22 bits.
    for (const char* far : {">40</text>", ">50</text>", "error of 1<"})
        EXPECT_EQ(svg.find(far), std::string::npos) << far;
}

TEST(Plot, WithNothingToShowSaysSo) {
    for (const char* glob : {"segment.*", "triangle3d.*", "*.exact"}) {
        const std::string svg = condition_plot(only(glob));
        expect_readable(svg);
        EXPECT_NE(svg.find("Nothing to show"), std::string::npos) << glob;
        EXPECT_TRUE(shown(svg).empty());
    }
}

}  // namespace
}  // namespace barycert::report_test
