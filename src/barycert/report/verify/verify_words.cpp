#include "barycert/report/verify/verify_words.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "barycert/base/decades.hpp"
#include "barycert/base/text.hpp"
#include "barycert/report/common/terminal_text.hpp"

namespace barycert::report {
namespace {

/// The doubles of a point, with commas.
std::string coordinates(const VerifyReport& summary, const WrongRow& row) {
    std::string text;
    for (int k = 0; k < summary.dimension; ++k)
        text += (k == 0 ? "" : ",") + base::shortest(row.point[static_cast<std::size_t>(k)]);
    return text;
}

std::string where(const WrongRow& row) {
    if (row.exact.cell < 0) return "outside";
    if (row.exact.feature == Feature::interior) return fmt::format("inside cell {}", row.exact.cell);
    return fmt::format("on {} {} of cell {}", row.exact.feature == Feature::edge ? "an" : "a", name(row.exact.feature),
                       row.exact.cell);
}

std::string value_clause(const VerifyReport& summary, const WrongRow& row) {
    if (summary.columns.empty()) return "";
    return fmt::format("{} is {}, should be {}", base::printable(summary.columns[row.column]),
                       base::shortest(row.claimed), base::shortest(row.value));
}

}  // namespace

std::string places_sentence(const Verdicts& v) {
    return fmt::format("{} inside the mesh, {} of them on a face, an edge or a vertex; {} outside{}", v.inside,
                       v.on_boundary, v.outside,
                       v.not_finite == 0 ? "" : fmt::format(", {} of them not finite", v.not_finite));
}

std::string verdict_sentence(const VerifyReport& summary) {
    const Verdicts& v = summary.verdicts;
    if (v.rows == 0) return "no rows";
    const std::string_view of = for_straight_sides(summary.curved);
    if (v.wrong() == 0)
        return v.rows == 1 ? fmt::format("the row is right{}", of) : fmt::format("all {} rows are right{}", v.rows, of);
    return fmt::format("WRONG{}: {} of {} rows", of, v.wrong(), v.rows);
}

std::vector<VerdictLine> verdict_table(const VerifyReport& summary) {
    const Verdicts& v = summary.verdicts;
    const bool named = !summary.cell_column.empty();
    std::string right = summary.exact ? "the exact value, rounded once" : "values off by at most the tolerance";
    if (v.by_other_cell != 0)
        right += fmt::format("; {} by another cell that contains the point, not by the lowest", v.by_other_cell);
    std::string missed = "in a cell, and said to be outside";
    if (v.missed_on_boundary != 0)
        missed += fmt::format("; {} on a face, an edge or a vertex of the cell", v.missed_on_boundary);
    std::string invented = "in no cell, and said to be inside";
    if (v.invented_zero != 0) invented += fmt::format("; {} have the value 0", v.invented_zero);
    if (v.invented_measured != 0) {
        const bool all = v.invented_measured == v.invented;
        invented += all ? "; the farthest" : fmt::format("; the farthest of {} of them", v.invented_measured);
        invented += fmt::format(" lies {} from the mesh", brief(v.invented_distance));
        if (v.invented_near != 0)
            invented += fmt::format(", {} nearer than {} of its diagonal", v.invented_near, brief(near_distance));
    }
    return {
        {"right", v.right, summary.columns.empty() ? "" : right},
        {"missed", v.missed, missed},
        {"invented", v.invented, invented},
        {"wrong cell", v.wrong_cell,
         named ? "inside, but not in the cell that column " + base::quoted(summary.cell_column) + " names"
               : "not compared: the results name no cells"},
        {"wrong value", v.wrong_value,
         summary.columns.empty() ? "not compared: no column of values"
         : summary.exact         ? "not the exact value, rounded once"
                         : fmt::format("off by more than {} of the range, or NaN", base::shortest(summary.tolerance))}};
}

std::string_view meaning(RowVerdict verdict) {
    constexpr std::array<std::string_view, 5> meanings{
        "right rows", "points in a cell that are said to be outside", "points in no cell that are said to be inside",
        "points inside that are not in the cell named",
        "values off by more than the tolerance, or NaN where one is due"};
    return meanings[static_cast<std::size_t>(verdict)];
}

std::vector<std::string> scale_sentences(const VerifyReport& summary) {
    std::vector<std::string> all{"max error: in parts of the range of the field (max - min)"};
    for (std::size_t c = 0; c < summary.columns.size(); ++c) {
        const std::string name = base::printable(summary.columns[c]);
        if (summary.relative_to[c] == RelativeTo::magnitude)
            all.push_back(fmt::format("{} is constant, its range is 0: its errors are in parts of its magnitude, {}",
                                      name, base::shortest(summary.ranges[c])));
        if (summary.relative_to[c] == RelativeTo::one)
            all.push_back(fmt::format("{} is 0 throughout: its errors are absolute", name));
    }
    return all;
}

std::pair<std::size_t, std::size_t> used_bins(const ValueErrors& errors) {
    std::size_t first = 0, last = errors.by_relative.size() - 1;
    while (first < last && errors.by_relative[first] == 0) ++first;
    while (last > first && errors.by_relative[last] == 0) --last;
    return {first, last};
}

std::string bin_label(std::size_t bin) {
    return bin == 0 ? "right" : base::decade_label(bin);
}

std::string example_sentence(const VerifyReport& summary, const WrongRow& row) {
    std::string text = "point (" + coordinates(summary, row) + ") is " + where(row);
    switch (row.verdict) {
        case RowVerdict::missed:
            return text + ", and said to be outside";
        case RowVerdict::invented:
            if (!std::isnan(row.distance)) text += fmt::format(", {} from the mesh", brief(row.distance));
            return text + (summary.columns.empty()
                               ? ", and said to be inside"
                               : fmt::format(", and {} is {}", base::printable(summary.columns[row.column]),
                                             base::shortest(row.claimed)));
        case RowVerdict::wrong_cell:
            return text + fmt::format(", not in cell {}", row.claimed_cell) +
                   (row.relative > 0 ? "; " + value_clause(summary, row) : "");
        default:
            return text + "; " + value_clause(summary, row) +
                   (row.relative > 0 && row.relative < 1e300 ? fmt::format(": {} of the range", brief(row.relative))
                                                             : std::string());
    }
}

std::string example_command(const VerifyReport& summary, const WrongRow& row) {
    return fmt::format("echo {} | {} sample {} --columns 1,2{} --on-boundary all{} --points - --output -",
                       coordinates(summary, row), summary.program, shell_word(summary.mesh),
                       summary.dimension == 3 ? ",3" : "", std::isnan(row.distance) ? " --nonfinite-points nan" : "");
}

std::string mesh_sentence(const VerifyReport& summary) {
    if (summary.certified) return fmt::format("certified{}, no two cells overlap", for_straight_sides(summary.curved));
    if (summary.contested_cells == 0) return "cells meet in common faces";
    return fmt::format("{} cells may meet others beside common faces; any cell that contains a point counts as right",
                       summary.contested_cells);
}

}  // namespace barycert::report
