/// Reports as text for a terminal or a log.
#pragma once

#include <string>
#include <vector>

#include "barycert/audit/replay.hpp"
#include "barycert/audit/runner.hpp"

namespace barycert::report {

struct TerminalStyle {
    bool colour = false;
    std::string command = "barycert";  ///< how the user calls the program, for commands to repeat
    /// What replays a witness: appended to "barycert replay"; a file name, or empty to name the family and case
    /// instead.
    std::string witness_path = {};
    std::vector<std::string> mesh_arguments = {};     ///< as the user gave them, repeated in replay commands
    std::vector<std::string> library_arguments = {};  ///< likewise: the user's kernel libraries
};

/// The table of kernels, worst first; below it the families; below them each kernel's worst witness with the command
/// that replays it.
std::string terminal_report(const audit::Report& report, const TerminalStyle& style);

/// One witness: the case, the exact answer, and every kernel's next to it.
std::string terminal_witness(const audit::Replay& replay, const TerminalStyle& style);

/// The catalogue and the families, one paragraph each.
std::string terminal_kernels(const std::vector<Kernel>& kernels);
std::string terminal_families(const std::vector<audit::Family>& families);

/// One line: version, rounding, SIMD target, compiler.
std::string environment_line(const Environment& environment);

}  // namespace barycert::report
