/// The output of bench_sample: one table in Markdown, and each demand as met or not.
#pragma once

#include <string>
#include <vector>

namespace barycert::bench {

/// A number with three significant digits and a unit, "72.3 ns", "1.25x"; "" for NaN.
std::string with_unit(double value, const char* unit);

class SampleTable {
public:
    /// Cells that are empty are shown as a dash, or as "not built" where that peer is missing.
    struct Line {
        std::string what = {}, ours = {}, vtk = {}, cgal = {}, scipy = {}, ratio = {};
    };
    void add(Line line) { lines_.push_back(std::move(line)); }

    /// `found` >= limit, or with `at_most` <= limit. NaN: nothing to compare with, and so the demand is not decided.
    void demand(const std::string& what, double found, double limit, bool at_most = false,
                const std::string& remark = {}, const char* unit = "x");

    void print() const;
    void print_demands() const;

    bool vtk = false, cgal = false, scipy = true;  ///< these peers are there, as far as was seen

private:
    std::vector<Line> lines_;
    std::vector<std::string> demands_;
};

}  // namespace barycert::bench
