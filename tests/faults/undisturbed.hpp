/// Results of a command that nothing disturbs, and requirements when something does.
#pragma once

#include <chrono>
#include <map>
#include <string>

#include "commands.hpp"

namespace barycert::faults {

class Undisturbed {
public:
    /// Runs the command twice: for its time and files, and with the shim to count its calls.
    explicit Undisturbed(const Command& command);

    /// A folder with the inputs, and old files where the outputs are to be.
    void prepare(const test::Scratch& folder) const;

    /// Runs the command in such a folder.
    cli_test::Ended run(const test::Scratch& folder, cli_test::How how = {}) const;
    /// The same with the shim, which these variables instruct.
    cli_test::Ended run_with_shim(const test::Scratch& folder, Words variables) const;

    /// Says what is wrong about the files: each must be the old one or the new one, whole. Empty if nothing is. Sets
    /// `old` to how many are the old one. After SIGKILL an unfinished name may be left beside a whole file.
    std::string wrong_files(const test::Scratch& folder, std::size_t& old, bool may_leave_names = false) const;

    const std::map<std::string, long>& calls() const { return calls_; }  ///< by kind
    const std::string& out() const { return out_; }
    std::chrono::microseconds time() const { return time_; }

private:
    bool is_new(const std::string& name, const std::string& bytes) const;

    const Command& command_;
    Files inputs_, files_;
    std::map<std::string, long> calls_;
    std::string out_;
    std::chrono::microseconds time_{};
};

}  // namespace barycert::faults
