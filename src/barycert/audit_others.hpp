/// What `./run flags` and `./run systems` measured, for the page of an audit: formulas under compiler flags, and other
/// systems held against exact answers. Both write JSON, which is read here.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "barycert/result.hpp"

namespace barycert {

/// Formulas in rows, sets of compiler flags in columns.
struct FlagsMatrix {
    struct Column {
        std::string compiler, label, flags;
    };
    /// Answers of a formula under a set of flags; `cases` is 0 where it was not run. `changed`: other than the strict
    /// build's by a bit or more; `newly_wrong` and `newly_right`: wrong here and not there, and the reverse.
    struct Cell {
        std::uint64_t cases = 0, changed = 0, wrong = 0, newly_wrong = 0, newly_right = 0;
    };
    struct Row {
        std::string kernel;
        std::vector<Cell> cells;  ///< one a column
    };
    std::uint64_t seed = 0, count = 0;  ///< cases of each family
    std::size_t families = 0;
    std::vector<std::string> compilers;  ///< by name and version
    std::vector<Column> columns;
    std::vector<Row> rows;
};

/// What systems answered to points, held against the exact owners and values.
struct SystemsLeague {
    struct Standing {
        std::string name = {}, version = {};
        int dimension = 3;
        std::string not_run = {};  ///< why; then there are no counts
        std::uint64_t points = 0, inside = 0, outside = 0;
        std::uint64_t inside_called_outside = 0, outside_called_inside = 0;
        std::optional<std::uint64_t> wrong_owner = {};  ///< not containing the point; nothing if it names none
        std::optional<double> max_value_error = {};  ///< in parts of the field's range; nothing if it gives no values
        std::optional<double> ns = {};               ///< a random point
        std::vector<std::string> failures = {};      ///< meshes without answers or times, and why
    };
    std::uint64_t seed = 0, count = 0;  ///< points of each set on each mesh
    std::vector<Standing> standings;
};

using OtherResults = std::variant<FlagsMatrix, SystemsLeague>;

/// Reads a file of `./run flags --json` or `./run systems --json`. Errors: the file cannot be read, is no JSON, or
/// is neither of the two; a member is missing, or does not fit the others.
Result<OtherResults> read_other_results(const std::string& path);

}  // namespace barycert
