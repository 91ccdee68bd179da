/// The command line of barycert-tetgen.
#pragma once

#include <optional>
#include <string>

namespace CLI {
class App;
}  // namespace CLI

namespace barycert {

/// The options as they are written: numbers are texts, to be judged later. `barycert` explains and completes them for
/// its subcommand mesh, so TetGen has no part in this.
struct OptionTable {
    std::string input, output, ratio, min_dihedral, max_volume, switches, timeout;
    std::string order = "1", index_base;
    bool keep_boundary = false, quiet = false;
};

/// The table must live as long as the app.
void add_options(CLI::App& app, OptionTable& table);

struct Options {
    std::string input;
    std::string output;  ///< the stem; never empty after parsing
    bool quality = false;
    double ratio = 2.0;  ///< largest radius-edge ratio; TetGen's own default
    std::optional<double> min_dihedral;
    std::optional<double> max_volume;
    int order = 1;
    bool keep_boundary = false;
    std::optional<std::string> switches;  ///< instead of all of the above
    std::optional<int> index_base;        ///< none: as the input's
    bool quiet = false;
    double timeout = 0;  ///< seconds; 0: none

    /// TetGen's switches, without a dash.
    std::string tetgen_switches() const;
    /// Only looks for self-intersections (TetGen's -d).
    bool diagnoses() const;
    /// The command that makes this mesh, without folders and the output's name: the same on every machine.
    std::string described() const;
};

/// The options, or the code to exit with: 0 after --help or --version, 2 after an error told on stderr.
struct Parsed {
    Options options;
    std::optional<int> exit_code;
};
Parsed parse_options(int argc, char** argv);

/// STEM.1 of STEM.poly; STEM.2 of STEM.1.poly, as TetGen counts.
std::string default_output(const std::string& input);

}  // namespace barycert
