#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/report.hpp"
#include "barycert/report/common/terminal_text.hpp"
#include "barycert/report/verify/verify_words.hpp"

namespace barycert {

using namespace report;

namespace {

std::string verdict_lines(const VerifyReport& s, const Colours& paint) {
    const Verdicts& v = s.verdicts;
    std::string out = fmt::format("{}: {}\n", base::printable(s.results),
                                  v.wrong() == 0 ? paint.good(verdict_sentence(s)) : paint.bad(verdict_sentence(s)));
    out += fmt::format("{} row{}: {}\n\n", v.rows, v.rows == 1 ? "" : "s", places_sentence(v));
    for (const VerdictLine& line : verdict_table(s))
        out +=
            fmt::format("{:<12} {:>12} {:>7} %  {}\n", line.name, line.count, percent(line.count, v.rows), line.what);
    return out;
}

std::string value_lines(const VerifyReport& s, const Colours& paint) {
    if (s.columns.empty()) return "\nvalues       not compared\n";
    const std::string over = fmt::format("over {}", s.exact ? "0" : base::shortest(s.tolerance));
    std::string out = fmt::format("\n{:<20} {:>12} {:>12} {:>12} {:>12} {:>10}\n", "values of", "compared",
                                  "bits right %", "max ulps", "max error", over);
    for (std::size_t c = 0; c < s.columns.size(); ++c) {
        const ValueErrors& e = s.verdicts.columns[c];
        const std::string wrong = std::to_string(e.over + e.missing + e.spurious);
        out += fmt::format("{:<20} {:>12} {:>12} {:>12} {:>12} {:>10}\n", base::printable(s.columns[c]), e.values,
                           percent(e.identical, e.values), brief(e.max_ulps), brief(e.max_relative),
                           e.over + e.missing + e.spurious == 0 ? wrong : paint.bad(fmt::format("{:>10}", wrong)));
    }
    return out + fmt::format("{}\n", fmt::join(scale_sentences(s), "\n"));
}

std::string histogram_lines(const VerifyReport& s) {
    std::string out;
    for (std::size_t c = 0; c < s.columns.size(); ++c) {
        const ValueErrors& e = s.verdicts.columns[c];
        if (e.values == e.identical) continue;
        out += fmt::format("\nerrors of {} in parts of its range\n", base::printable(s.columns[c]));
        const auto [first, last] = used_bins(e);
        std::uint64_t most = 1;
        for (std::size_t b = first; b <= last; ++b) most = std::max(most, e.by_relative[b]);
        for (std::size_t b = first; b <= last; ++b) {
            const auto width = static_cast<std::size_t>(
                std::ceil(50 * static_cast<double>(e.by_relative[b]) / static_cast<double>(most)));
            out += fmt::format("{:>14} {:>12}  {}\n", bin_label(b), e.by_relative[b], std::string(width, '#'));
        }
    }
    return out;
}

std::string example_lines(const VerifyReport& s, const Colours& paint) {
    const auto& examples = s.verdicts.examples;
    if (examples.empty()) return "";
    std::string out = "\nworst rows, counted from 0\n";
    for (const WrongRow& row : examples) {
        out += fmt::format("{:<12} row {}: {}\n", name(row.verdict), row.row, example_sentence(s, row));
        out += fmt::format("{:<12} {}\n", "", paint.dim(example_command(s, row)));
    }
    return out;
}

}  // namespace

std::string verify_text(const VerifyReport& summary, bool colour) {
    const ExactEnvironment environment;
    const Colours paint(colour);
    std::string out = curved_lines(summary.curved, paint) + verdict_lines(summary, paint) +
                      value_lines(summary, paint) + histogram_lines(summary) + example_lines(summary, paint);
    out +=
        fmt::format("\n{:<10} {} cells, {} nodes: {}\n", "mesh", summary.cells, summary.nodes, mesh_sentence(summary));
    for (const Note& note : summary.notes)
        out += fmt::format("{:<10} {}{}\n", name(note.kind), base::printable(note.text),
                           note.file.empty() ? "" : " (" + base::printable(note.file) + ")");
    const SampleSeconds& t = summary.seconds;
    out += fmt::format(
        "{:<10} {:.3g} s on {} thread{}: mesh {:.3g}, locator {:.3g}, results {:.3g}, comparing {:.3g}\n", "time",
        t.total, summary.threads, summary.threads == 1 ? "" : "s", t.mesh, t.build, t.read, t.sample);
    return out;
}

}  // namespace barycert
