// The terminal's report: order, columns, commands.

#include <algorithm>
#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

#include "barycert/audit_report.hpp"
#include "lines.hpp"
#include "small_audit.hpp"

namespace barycert::report_test {
namespace {

std::string text_of(TerminalStyle style = {}) {
    style.wide = true;
    return audit_text(audited(), style);
}

/// Without --wide.
std::string narrow(const AuditReport& report, const TerminalStyle& style = {}) {
    return audit_text(report, style);
}

double wrong_share(const KernelResult& k) {
    return static_cast<double>(k.total.wrong_cases) / static_cast<double>(k.total.cases);
}

TEST(TerminalReport, WorstFirst) {
    const auto& kernels = audited().kernels;
    EXPECT_EQ(kernels.front().kernel.name, "tetrahedron.stubborn") << "a false certificate is the worst of all";
    EXPECT_TRUE(std::is_sorted(kernels.begin() + 1, kernels.end(),
                               [](const auto& a, const auto& b) { return wrong_share(a) > wrong_share(b); }));
    // The table keeps that order, one row a kernel.
    std::vector<std::string> rows;
    for (const std::string& line : lines_of(text_of())) {
        const std::string word = line.substr(0, line.find(' '));
        const bool kernel =
            std::any_of(kernels.begin(), kernels.end(), [&](const auto& k) { return k.kernel.name == word; });
        if (kernel) rows.push_back(word);
    }
    ASSERT_EQ(rows.size(), kernels.size());
    for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(rows[i], kernels[i].kernel.name);
    EXPECT_TRUE(contains(text_of(), "    certifies its answers, and "));
}

TEST(TerminalReport, WhatAKernelDidBesidesStandsBelowItsRow) {
    AuditReport report = audited();
    KernelResult& k = report.kernels[1];
    k.total.counts[static_cast<std::size_t>(Finding::crashed)] = 3;
    k.total.not_run = 5;
    for (const bool wide : {false, true}) {
        const auto lines = lines_of(audit_text(report, {.wide = wide}));
        const auto row = std::find_if(lines.begin(), lines.end(),
                                      [&](const std::string& line) { return line.starts_with(k.kernel.name + " "); });
        ASSERT_NE(row, lines.end());
        EXPECT_EQ(row[1], "    crashed in 3 cases; given up: 5 cases were not run") << row[-1];
    }
}

TEST(TerminalReport, AnAccidentIsNoWeight) {
    AuditReport report = audited();
    KernelResult& k = report.kernels[0];
    Witness& w = k.witnesses.at(0);
    w.reason = "crashed";
    w.detail.clear();
    w.magnitude = HUGE_VAL;
    EXPECT_TRUE(contains(narrow(report), "(crashed, asked once more, it did not)"));
    EXPECT_TRUE(contains(audit_text(report, {.wide = true}), "--reason crashed\n"));
    w.detail = "SIGABRT (Aborted)";
    EXPECT_TRUE(contains(narrow(report), "(crashed, SIGABRT (Aborted))"));
    w.reason = "false_inside";
    w.detail.clear();
    EXPECT_TRUE(contains(narrow(report), "(false_inside, a weight that is not finite)"));
}

TEST(TerminalReport, WhatWasNotRunIsNotRight) {
    AuditReport report = audited();
    report.kernels.resize(1);
    KernelResult& k = report.kernels[0];
    k.total = {};
    k.total.not_run = 7;
    k.witnesses.clear();
    for (const bool wide : {false, true}) {
        const std::string text = audit_text(report, {.wide = wide});
        EXPECT_FALSE(contains(text, "value is correctly rounded")) << text;
        EXPECT_FALSE(contains(text, "to the last bit")) << text;
    }
    EXPECT_TRUE(contains(narrow(report), ": no wrong answer in 0 cases, 7 not run\n"));
    report.kernels.push_back(k);
    EXPECT_TRUE(contains(narrow(report), "none of 2 kernels gives a wrong answer, but not all cases were run\n"));
}

TEST(TerminalReport, GreenIsWhatIsRightInEveryCase) {
    AuditReport report = audited();
    std::erase_if(report.kernels, [](const KernelResult& k) { return k.kernel.name != "triangle.exact"; });
    report.kernels.push_back(report.kernels.front());
    report.kernels.back().kernel.name = "triangle.unmeasured";
    // No weight can be measured in ulps where all exact ones are zero or degenerate.
    report.kernels.back().total.weight_ulp = {};
    for (const bool wide : {false, true}) {
        const std::string text = audit_text(report, {.colour = true, .wide = wide});
        EXPECT_TRUE(contains(text, "\033[32mtriangle.exact ")) << text;
        EXPECT_TRUE(contains(text, "\033[32mtriangle.unmeasured ")) << text;
    }
}

TEST(TerminalReport, NoTimeWhereNothingWasTimed) {
    AuditReport report = audited();
    for (KernelResult& k : report.kernels) k.ns = 0;
    for (const bool wide : {false, true}) EXPECT_FALSE(contains(audit_text(report, {.wide = wide}), " 0.0\n"));
}

TEST(TerminalReport, ColumnsStandUnderEachOther) {
    // No kernel's figures are wider than their columns: all rows end where the head ends.
    std::size_t head = 0, rows = 0;
    for (const std::string& line : lines_of(text_of())) {
        if (line.rfind("kernel ", 0) == 0) head = line.size();
        if (line.rfind("    certifies", 0) == 0) continue;
        if (line.rfind("wrong %", 0) == 0) break;
        if (head == 0 || line.rfind("kernel ", 0) == 0 || line.starts_with(' ')) continue;
        const std::size_t end = line.find_last_not_of(' ') + 1;
        EXPECT_EQ(line.size(), head) << line;
        rows += end == head ? 1U : 0U;
    }
    EXPECT_EQ(rows, audited().kernels.size());
}

/// Columns that a terminal shows.
std::size_t columns(const std::string& line) {
    return static_cast<std::size_t>(std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

TEST(TerminalReport, FitsATerminal) {
    AuditReport one = audited();
    for (const char* kernel : {"", "tetrahedron.cramer", "tetrahedron.silent", "triangle.exact"}) {
        one = audited();
        if (*kernel != 0) std::erase_if(one.kernels, [&](const KernelResult& k) { return k.kernel.name != kernel; });
        for (const std::string& line : lines_of(narrow(one))) {
            if (contains(line, "barycert replay ")) continue;
            EXPECT_LE(columns(line), 100U) << line;
        }
    }
}

TEST(TerminalReport, OneLineAKernelWithItsFigures) {
    const std::string text = narrow(audited());
    const auto lines = lines_of(text);
    for (const KernelResult& k : audited().kernels) {
        const auto row = std::find_if(lines.begin(), lines.end(),
                                      [&](const std::string& line) { return line.starts_with(k.kernel.name + " "); });
        ASSERT_NE(row, lines.end()) << k.kernel.name;
        std::istringstream in(*row);
        std::string name, wrong, out, outside, none, usual, worst, ulps, ns, more;
        in >> name >> wrong >> out >> outside >> none >> usual >> worst >> ulps >> ns >> more;
        EXPECT_NE(ns, "") << *row;
        EXPECT_EQ(more, "") << *row;
        EXPECT_EQ(wrong == "0", k.total.wrong_cases == 0) << *row;
        EXPECT_EQ(wrong == "100", k.total.wrong_cases == k.total.cases) << *row;
        const auto count = [&](Finding f) { return k.total.counts[static_cast<std::size_t>(f)]; };
        EXPECT_EQ(out == "0", count(Finding::false_outside) == 0) << *row;
        EXPECT_EQ(outside == "0", count(Finding::false_inside) == 0) << *row;
        EXPECT_EQ(usual == "-", k.total.errors.worst.value < 0) << *row;
        EXPECT_EQ(none == "0", k.total.errors.unanswered() == 0) << *row;
        EXPECT_EQ(none == "100", k.total.errors.unanswered() == k.total.errors.total()) << *row;
    }
    EXPECT_TRUE(contains(text, " kernels give wrong answers\n"));
    EXPECT_TRUE(contains(text, "Certified and wrong all the same: tetrahedron.stubborn."));
    EXPECT_TRUE(contains(text, "barycert replay --kernel tetrahedron.stubborn "));
}

TEST(TerminalReport, OneKernelFamilyByFamily) {
    AuditReport one = audited();
    std::erase_if(one.kernels, [](const KernelResult& k) { return k.kernel.name != "tetrahedron.cramer"; });
    const std::string text = narrow(one);
    const KernelResult& k = one.kernels.front();
    EXPECT_TRUE(contains(text, "tetrahedron.cramer is wrong in ")) << text;
    std::size_t rows = 0;
    for (const std::string& line : lines_of(text)) {
        for (const FamilyResult& f : k.families) {
            if (!line.starts_with(one.families[f.family].name + " ")) continue;
            ++rows;
            std::istringstream in(line);
            std::string name, cases, wrong;
            in >> name >> cases >> wrong;
            EXPECT_EQ(cases, "30");
            EXPECT_EQ(wrong == "0", f.statistics.wrong_cases == 0) << line;
        }
    }
    EXPECT_EQ(rows, k.families.size());
    for (const Witness& w : k.witnesses) EXPECT_TRUE(contains(text, "\n" + w.reason)) << w.reason;
    EXPECT_FALSE(contains(text_of(), "\nformula"));
}

TEST(TerminalReport, EveryFamilyAndSimplexHasARowWithItsWorstKernel) {
    const std::string text = text_of();
    const auto lines = lines_of(text);
    std::size_t rows = 0;
    for (const std::string& line : lines) {
        std::istringstream in(line);
        std::string family, simplex, cases, clean, median, worst, kernel;
        in >> family >> simplex >> cases >> clean >> median >> worst >> kernel;
        const auto f = std::find_if(audited().families.begin(), audited().families.end(),
                                    [&](const auto& x) { return x.name == family; });
        if (f == audited().families.end() || !simplex_named(simplex)) continue;
        ++rows;
        std::uint64_t max = 0, all = 0, without = 0;
        for (const auto& k : audited().kernels) {
            for (const auto& part : k.families) {
                if (&audited().families[part.family] != &*f || name(k.kernel.simplex) != simplex) continue;
                max = std::max(max, part.statistics.wrong_cases);
                ++all;
                without += part.statistics.wrong_cases == 0 ? 1U : 0U;
            }
        }
        EXPECT_EQ(cases, "30") << line;
        EXPECT_EQ(clean, std::to_string(without) + "/" + std::to_string(all)) << line;
        EXPECT_EQ(kernel == "-", max == 0) << line;
        EXPECT_EQ(worst == "0", max == 0) << line;
        EXPECT_EQ(worst == "100", max == 30) << line;
    }
    std::size_t expected = 0;
    for (const auto& f : audited().families) expected += f.simplices.size();
    EXPECT_EQ(rows, expected);
}

TEST(TerminalReport, CommandsNameWhatTheyNeed) {
    const std::string plain = text_of();
    EXPECT_TRUE(contains(plain, "barycert replay --kernel "));
    EXPECT_FALSE(contains(plain, "--mesh"));
    const std::string file = text_of({.witness_path = "my w.json"});
    EXPECT_TRUE(contains(file, "barycert replay 'my w.json' --kernel tetrahedron.stubborn --reason false_certificate"));
    EXPECT_FALSE(contains(file, "--family "));
    const std::string libraries = text_of({.mesh_arguments = {"a b"}, .library_arguments = {"./my kernel.so"}});
    for (const std::string& line : lines_of(libraries)) {
        if (!contains(line, "barycert replay ")) continue;
        EXPECT_TRUE(contains(line, "--kernel-library './my kernel.so'")) << line;
        EXPECT_EQ(contains(line, "--mesh 'a b'"), contains(line, "--family mesh.")) << line;
    }
}

TEST(TerminalReport, ColourChangesNoLetter) {
    std::string coloured = text_of({.colour = true});
    EXPECT_TRUE(contains(coloured, "\033["));
    for (std::size_t at; (at = coloured.find('\033')) != std::string::npos;)
        coloured.erase(at, coloured.find('m', at) - at + 1);
    EXPECT_EQ(coloured, text_of());
    EXPECT_FALSE(contains(text_of(), "\033"));
}

}  // namespace
}  // namespace barycert::report_test
