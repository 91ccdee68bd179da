#include "sample_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>

namespace barycert::bench {

std::string with_unit(double value, const char* unit) {
    if (std::isnan(value)) return {};
    char text[64];
    const int digits = value < 0.995 ? 3 : value < 9.95 ? 2 : value < 99.5 ? 1 : 0;
    std::snprintf(text, sizeof text, "%.*f%s%s", digits, value, *unit != '\0' && unit[1] != '\0' ? " " : "", unit);
    return text;
}

void SampleTable::demand(const std::string& what, double found, double limit, bool at_most, const std::string& remark,
                         const char* unit) {
    const bool met = at_most ? found <= limit : found >= limit;
    char text[256];
    std::snprintf(text, sizeof text, "%-76s %s %8s  %9s  %s", what.c_str(),
                  at_most ? "<=" : ">=", with_unit(limit, unit).c_str(),
                  std::isnan(found) ? "-" : with_unit(found, unit).c_str(),
                  std::isnan(found) ? "not decided: the peer is missing"
                  : met             ? "met"
                                    : "NOT met");
    demands_.push_back(text + (remark.empty() ? "" : "; " + remark));
}

void SampleTable::print() const {
    using Cells = std::array<std::string, 6>;
    std::vector<Cells> rows{{"what", "ours", "VTK", "CGAL", "SciPy", "ratio"}};
    const auto cell = [](const std::string& text, bool built) {
        return !text.empty() ? text : std::string(built ? "-" : "not built");
    };
    for (const Line& l : lines_) {
        rows.push_back({l.what, cell(l.ours, true), cell(l.vtk, vtk), cell(l.cgal, cgal), cell(l.scipy, scipy),
                        cell(l.ratio, true)});
    }
    Cells dashes;
    std::array<std::size_t, 6> width{};
    for (std::size_t i = 0; i < 6; ++i) {
        for (const Cells& row : rows) width[i] = std::max(width[i], row[i].size());
        dashes[i] = std::string(width[i], '-');
    }
    rows.insert(rows.begin() + 1, dashes);
    for (const Cells& row : rows) {
        for (std::size_t i = 0; i < 6; ++i) std::printf("| %-*s ", static_cast<int>(width[i]), row[i].c_str());
        std::printf("|\n");
    }
}

void SampleTable::print_demands() const {
    for (const std::string& line : demands_) std::printf("%s\n", line.c_str());
}

}  // namespace barycert::bench
