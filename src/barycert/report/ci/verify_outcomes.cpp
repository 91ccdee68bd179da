#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "barycert/environment.hpp"
#include "barycert/report.hpp"
#include "barycert/report/verify/verify_words.hpp"

namespace barycert {

using namespace report;

namespace {

using State = CiOutcome::State;

/// "3 of 7 rows: what such rows are. Worst: row 5: ...".
std::string kind_message(const VerifyReport& s, RowVerdict kind, const VerdictLine& line) {
    std::string text = fmt::format("{} of {} rows: {}", line.count, s.verdicts.rows, line.what);
    const auto& examples = s.verdicts.examples;
    const auto worst =
        std::find_if(examples.begin(), examples.end(), [&](const WrongRow& row) { return row.verdict == kind; });
    if (worst == examples.end()) return text;
    return text + fmt::format(". Worst: row {}, counted from 0: {}", worst->row, example_sentence(s, *worst));
}

}  // namespace

CiReport verify_outcomes(const VerifyReport& s, const std::vector<VerifyLimit>& limits,
                         const Environment& environment) {
    const ExactEnvironment exact;
    CiReport ci{"barycert verify", "resource", environment, s.seconds.total};
    const std::string artifact = s.results == "-" ? "" : s.results;
    const std::vector<VerdictLine> table = verdict_table(s);
    const auto add = [&](std::size_t kind, std::string name, State state) {
        const auto verdict = static_cast<RowVerdict>(kind);
        const std::string rule(handle(verdict));
        ci.outcomes.push_back({s.results, std::move(name), rule, std::string(meaning(verdict)), state,
                               state == State::passed ? "" : kind_message(s, verdict, table[kind]), artifact});
    };
    for (std::size_t kind = 1; kind < table.size(); ++kind) {
        const auto verdict = static_cast<RowVerdict>(kind);
        bool limited = false;
        for (const VerifyLimit& limit : limits) {
            if (limit.verdict != verdict || !compared(s, verdict)) continue;
            limited = true;
            add(kind, fmt::format("{} <= {}", handle(verdict), limit.most),
                exceeded(s.verdicts, {limit}).empty() ? State::passed : State::failed);
        }
        if (!limited && table[kind].count != 0) add(kind, std::string(handle(verdict)), State::noted);
    }
    return ci;
}

}  // namespace barycert
