/// The words of reports on verified results: the same on the terminal and in HTML.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/jobs.hpp"

namespace barycert::report {

/// How many rows are where.
std::string places_sentence(const Verdicts& verdicts);

/// "every row is right", or how many are wrong.
std::string verdict_sentence(const VerifyReport& summary);

struct VerdictLine {
    std::string name;
    std::uint64_t count = 0;
    std::string what;  ///< what such rows are
};
/// A line for each RowVerdict.
std::vector<VerdictLine> verdict_table(const VerifyReport& summary);

/// What a wrong row of that kind is, whatever the results.
std::string_view meaning(RowVerdict verdict);

/// The first and the last bin of ValueErrors::by_relative that has an entry. Precondition: some bin has.
std::pair<std::size_t, std::size_t> used_bins(const ValueErrors& errors);
/// What is in a bin: "right", "< 1e-16".
std::string bin_label(std::size_t bin);

/// What errors are in parts of, a sentence for all fields that vary and one for each that does not.
std::vector<std::string> scale_sentences(const VerifyReport& summary);

/// What is wrong with a row.
std::string example_sentence(const VerifyReport& summary, const WrongRow& row);
/// A command that shows what the exact answer is.
std::string example_command(const VerifyReport& summary, const WrongRow& row);

std::string mesh_sentence(const VerifyReport& summary);

}  // namespace barycert::report
