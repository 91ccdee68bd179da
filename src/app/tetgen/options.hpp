/// The command line of barycert-tetgen.
#pragma once

#include <optional>
#include <string>

namespace CLI {
class App;
}  // namespace CLI

namespace barycert {

struct Options {
    std::string input;
    std::string output;           ///< the stem; never empty after parsing
    std::optional<double> ratio;  ///< largest radius-edge ratio; 2 of cells to be refined, as TetGen has it
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
    bool refines() const { return ratio || min_dihedral || max_volume; }
    /// Only looks for self-intersections (TetGen's -d).
    bool diagnoses() const;
    /// The command that makes this mesh, without folders and the output's name: the same on every machine.
    std::string described() const;
};

/// Tells the parser the options, which must live as long as it. `barycert` explains them, too: no part of TetGen here.
void add_options(CLI::App& app, Options& options);

/// Sets the options, or returns the code to exit with, after --help or --version. Throws what is wrong with them.
std::optional<int> parse_options(int argc, char** argv, Options& options);

}  // namespace barycert
