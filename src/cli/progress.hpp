/// Progress on a terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

namespace barycert::cli {

/// One line of stderr that is written over and over and cleared at the end.
class Progress {
public:
    /// `on`: false where there is no terminal or the user wants no progress; then nothing is written.
    explicit Progress(bool on) : on_(on) {}
    ~Progress() { clear(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void stage(std::string_view text);

    /// stage("what: done"), at most ten times a second.
    void count(std::string_view what, std::uint64_t done);

    /// True if a line is shown at all and the last one is a tenth of a second old.
    bool due() const;

    void clear();

private:
    bool on_, shown_ = false;
    std::chrono::steady_clock::time_point last_{};
};

}  // namespace barycert::cli
