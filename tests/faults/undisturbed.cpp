#include "undisturbed.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace barycert::faults {

using cli_test::Ended;
using cli_test::How;
using test::Scratch;

Undisturbed::Undisturbed(const Command& command) : command_(command) {
    const Scratch inputs, first, second, logs;
    put_inputs(inputs);
    inputs_ = files_of(inputs);
    prepare(first);
    const Ended counted = run_with_shim(first, {"FAULT_COUNTS=" + logs.path("counts")});
    EXPECT_EQ(counted.code, command_.code) << counted.err;
    std::istringstream counts(cli_test::read_file(logs.path("counts")));
    std::string kind;
    for (long count = 0; counts >> kind >> count;) calls_[kind] = count;
    EXPECT_EQ(calls_.size(), 11U);
    files_ = files_of(first);

    prepare(second);
    const auto begin = std::chrono::steady_clock::now();
    const Ended r = run(second);
    time_ = std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - begin);
    EXPECT_EQ(r.code, command_.code) << r.err;
    out_ = r.out;
}

void Undisturbed::prepare(const Scratch& folder) const {
    for (const auto& [name, bytes] : inputs_) folder.put(name, bytes);
    for (const auto& [name, bytes] : files_)
        if (!inputs_.contains(name)) folder.put(name, "old");
}

Ended Undisturbed::run(const Scratch& folder, How how) const {
    how.folder = folder.folder();
    how.program = command_.program;
    return cli_test::run(command_.arguments, how);
}

Ended Undisturbed::run_with_shim(const Scratch& folder, Words variables) const {
    variables.emplace_back("LD_PRELOAD=" BARYCERT_FAULT_LIBRARY);
    if (command_.forks) variables.emplace_back("FAULT_FORKED=1");
    return run(folder, {.environment = std::move(variables)});
}

bool Undisturbed::is_new(const std::string& name, const std::string& bytes) const {
    const auto good = files_.find(name);
    if (good == files_.end()) return false;
    const bool has_times = name.ends_with(".json") || name.ends_with(".html");
    const auto lasting = [](const std::string& text) { return without_numbers(without_ticks(text)); };
    return bytes == good->second || (has_times && lasting(bytes) == lasting(good->second));
}

std::string Undisturbed::wrong_files(const Scratch& folder, std::size_t& old, bool may_leave_names) const {
    const Files files = files_of(folder);
    old = 0;
    for (const auto& [name, bytes] : files) {
        const bool known = files_.contains(name) || inputs_.contains(name);
        if (!known && may_leave_names && is_new(name.substr(0, name.rfind(".tmp-")), bytes)) continue;
        if (!known) return "a file is left: " + name;
        if (inputs_.contains(name)) {
            if (bytes != inputs_.at(name)) return "an input has changed: " + name;
        } else if (bytes == "old") {
            ++old;
        } else if (!is_new(name, bytes)) {
            return name + " is neither the old file nor the new one, but " + std::to_string(bytes.size()) + " bytes";
        }
    }
    for (const auto& [name, bytes] : files_)
        if (!files.contains(name)) return "lost: " + name;
    return "";
}

}  // namespace barycert::faults
