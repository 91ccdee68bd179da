/// The options of barycert-tetgen as they are written: numbers are texts, to be judged later. `barycert` explains and
/// completes them for its subcommand mesh, so TetGen has no part in this.
#pragma once

#include <string>

namespace CLI {
class App;
}  // namespace CLI

namespace barycert {

struct OptionTable {
    std::string input, output, ratio, min_dihedral, max_volume, switches, timeout;
    std::string order = "1", index_base;
    bool keep_boundary = false, quiet = false;
};

/// The table must live as long as the app.
void add_options(CLI::App& app, OptionTable& table);

}  // namespace barycert
