#include <fmt/format.h>

#include "barycert/audit_report.hpp"
#include "barycert/audit_search.hpp"
#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report/audit/audit_words.hpp"
#include "barycert/report/common/terminal_text.hpp"

namespace barycert {

using namespace report;

namespace {

std::string numbers(int count, auto at) {
    std::string out;
    for (int axis = 0; axis < count; ++axis) out += (axis == 0 ? "" : ", ") + base::shortest(at(axis));
    return out;
}

/// The case in decimal, a vertex a line, and how to see what kernels make of it.
std::string plain_case(const SearchReport& report, const SearchFind& f, const TerminalStyle& style) {
    const Case& c = f.plain.c;
    std::string out;
    if (!f.plain.detail.empty()) out += "    " + base::printable(f.plain.detail) + "\n";
    for (int i = 0; i < vertex_count(c.simplex); ++i)
        out += fmt::format("    v{}  {}\n", i, numbers(c.stride(), [&](int axis) { return c.vertex(i, axis); }));
    out += fmt::format("    p   {}\n", numbers(space_dimension(c.simplex),
                                               [&](int axis) { return c.point[static_cast<std::size_t>(axis)]; }));
    if (!style.witness_path.empty()) out += "    " + replay_from_file(report.kernel.name, f.reason, style) + "\n";
    return out;
}

}  // namespace

std::string search_text(const SearchReport& report, const TerminalStyle& style) {
    const ExactEnvironment environment;
    const Colours paint(style.colour);
    std::string out = environment_line(report.environment) + "\n";
    out +=
        fmt::format("{}: {} cases in {} walks, seed {}, exponents {} to {}, {:.1f} s\n", report.kernel.name,
                    report.steps, report.walks, report.seed, report.min_exponent, report.max_exponent, report.seconds);
    if (report.stopped)
        out +=
            paint.bad(fmt::format("stopped before {} cases: another run may find something else", report.steps_asked)) +
            "\n";
    if (report.given_up)
        out += paint.bad(fmt::format("given up before {} cases: it crashed or gave no answer too often",
                                     report.steps_asked)) +
               "\n";
    if (report.finds.empty()) return out + paint.good("no fault and no error found") + "\n";
    out += fmt::format(
        "wrong: {} % of the cases met on the way (no measure of how often: the search goes where faults are)\n\n",
        percent(report.wrong_cases, report.steps));

    const auto row = [&](const auto&... cells) {
        std::string line = fmt::format("{:<21} {:>7} {:>9} {:>9}   {:>9} {:>9} {:>5}", cells...);
        return line.erase(line.find_last_not_of(' ') + 1) + "\n";
    };
    out += paint.bold(row("", "", "worst:", "ulps of", "plainest:", "ulps of", ""));
    out += paint.bold(row("fault", "cases", "relative", "a weight", "relative", "a weight", "bits"));
    for (const SearchFind& f : report.finds)
        out += row(f.reason, brief_count(f.cases), brief(f.relative_error), brief(f.weight_ulp),
                   brief(f.plain_relative_error), brief(f.plain_weight_ulp), std::to_string(f.plain_bits));
    out += paint.dim(
        "relative: error of a weight over the largest exact weight. plainest: the same fault on coordinates of the\n"
        "fewest significant bits (of an error: at least 1/1024 of it); bits: of all its coordinates together.\n");
    for (const SearchFind& f : report.finds) {
        out += "\n" + paint.bold(f.reason) + "\n";
        out += plain_case(report, f, style);
    }
    return out;
}

}  // namespace barycert
