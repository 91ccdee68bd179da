/// Which columns of a table are the coordinates of points, and which are carried through. Errors are thrown as
/// Exceptions.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/io.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

/// The columns of a file.
struct TableColumns {
    std::vector<std::string> names;  ///< of files that name none column1, column2, ...
    bool named = true;
    std::string file = {};
    std::size_t line = 0;         ///< of the names, in a text
    std::size_t coordinates = 0;  ///< so many columns, the first ones, are the coordinates by the format of the file
};

/// column1, column2, ...
std::string column_number(std::size_t column);

/// What the columns are taken for.
struct PointColumns {
    struct Kept {
        std::size_t column = 0;
        std::string name;
    };
    std::vector<std::size_t> axes;      ///< of each coordinate
    std::optional<std::size_t> zero{};  ///< a z beside a mesh in the plane
    std::vector<Kept> kept{};
    Notes notes{};  ///< what is left out

    bool is_coordinate(std::size_t column) const {
        return zero == column || std::find(axes.begin(), axes.end(), column) != axes.end();
    }
};

/// The places of x, y[, z], or of one of the other names that are known; nothing if none of them is there as a whole.
/// In the plane also of the z that belongs to them. Error: two columns of one of these names.
std::optional<PointColumns> find_coordinates(const TableColumns& all, int dimension);

/// The texts, each cut at its commas unless there are `count` of them.
std::vector<std::string> parts_of(const std::vector<std::string>& texts, std::size_t count);

/// True if all are numbers from 1: columns by their places.
bool are_places(const std::vector<std::string>& columns);

/// By PointOptions. Errors: columns that are not there, or not clear; a coordinate that is to be carried through.
PointColumns choose_columns(const TableColumns& all, int dimension, const PointOptions& options);

/// The end of what to do with a point that is not finite.
inline constexpr const char* or_nan_for_it = ", or take NaN for its values: options.nonfinite_points nan";

/// A z that is not 0 beside a mesh in the plane. `row`: of which point, or empty.
Error off_plane(const std::string& file, std::size_t line, const std::string& row, const std::string& found);

/// "a", "b", ...: at most 8.
std::string listed(const std::vector<std::string>& names);

}  // namespace barycert::io
