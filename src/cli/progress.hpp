/// What is being done, on one line of stderr.
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

namespace barycert::cli {

/// Writes over the same line again and again; does nothing unless `on`, which is for terminals.
class Progress {
public:
    explicit Progress(bool on) : on_(on) {}
    ~Progress() { clear(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void stage(std::string_view text);
    /// The same, but not oftener than ten times a second.
    void count(std::string_view what, std::uint64_t done);
    void clear();

private:
    bool on_, shown_ = false;
    std::chrono::steady_clock::time_point last_{};
};

}  // namespace barycert::cli
