/// Parts that sources of points with carried columns share, and sinks of rows. Errors are thrown as Exceptions.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/mesh.hpp"
#include "barycert/point_files.hpp"
#include "barycert/result.hpp"
#include "barycert/table.hpp"
#include "barycert/table_files.hpp"
#include "core/base/text.hpp"
#include "files/output_file.hpp"
#include "io/parallel.hpp"
#include "mesh/columns.hpp"

namespace barycert::io {

struct TableColumns {
    std::vector<std::string> names;  ///< of files that name none column1, column2, ...
    bool named = true;
    std::string file = {};
    std::size_t line = 0;         ///< of the names, in a text
    std::size_t coordinates = 0;  ///< so many columns, the first ones, are the coordinates by the format of the file
};

/// column1, column2, ...
inline std::string column_number(std::size_t column) {
    return "column" + std::to_string(column + 1);
}

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

/// The places of x, y[, z] or other known names, in the plane also of a z beside them; or nothing. Error: a name twice.
std::optional<PointColumns> find_coordinates(const TableColumns& all, int dimension);

/// The texts, each cut at its commas unless there are `count` of them.
std::vector<std::string> parts_of(const std::vector<std::string>& texts, std::size_t count);

/// The place of a column, from 1, if the text is one; whether all are.
inline std::optional<std::size_t> place_of(std::string_view column) {
    const std::optional<std::size_t> place = base::whole_number<std::size_t>(column);
    return place == std::size_t{0} ? std::nullopt : place;
}
inline bool are_places(const std::vector<std::string>& columns) {
    return std::ranges::all_of(columns, [](const std::string& text) { return place_of(text).has_value(); });
}

/// By PointOptions. Errors: columns that are not there, or not clear; a coordinate that is to be carried through.
PointColumns choose_columns(const TableColumns& all, int dimension, const PointOptions& options);

/// The subject of errors that NonfinitePoints::nan would let pass, and how their remedies end.
inline constexpr const char* nonfinite_points = "options.nonfinite_points";
inline constexpr const char* or_nan_for_it = ", or take NaN for its values: options.nonfinite_points nan";

/// Refuses a z that is not 0 beside a mesh in the plane. `row`: of which point, or empty.
[[noreturn]] inline void refuse_off_plane(const std::string& file, const std::string& row, const std::string& found) {
    throw Exception(
        about("options.columns",
              file_error("point.off-plane", file, "a point off the plane z = 0" + (row.empty() ? row : ": " + row),
                         "z = 0, for the mesh is 2D", found, "options.columns x,y leaves z out of account")));
}

/// "a", "b", ...: at most 8.
std::string listed(const std::vector<std::string>& names);

class ColumnSource : public PointSource {
public:
    explicit ColumnSource(int dimension) : dimension_(static_cast<std::size_t>(dimension)) {}

    int dimension() const override { return static_cast<int>(dimension_); }
    std::vector<ColumnFormat> carried() const override { return formats_; }
    void take_carried(std::vector<Column>& columns) override { std::swap(columns, carried_); }
    Notes notes() const override { return notes_; }

    Result<std::size_t> read(std::size_t max_points, std::vector<double>& out) override {
        const ExactEnvironment environment;
        if (error_) return *error_;
        mesh::begin_columns(formats_, carried_);
        try {
            return next(max_points, out);
        } catch (const Exception& problem) {
            error_ = problem.error();
            return *error_;
        }
    }

protected:
    /// As read(); `carried_` has empty columns for what goes with the points. An Error is thrown; not called after one.
    virtual std::size_t next(std::size_t max_points, std::vector<double>& out) = 0;

    std::size_t dimension_;
    std::vector<ColumnFormat> formats_;  ///< of the carried columns
    std::vector<Column> carried_;        ///< of the last points given
    Notes notes_;

private:
    std::optional<Error> error_;  // what every further call tells
};

class RowSink : public TableSink {
public:
    /// "-" is the standard output.
    RowSink(const std::string& path, TableFormat format);

    Status write(const TableView& rows) override;
    Status commit() override { return error_ ? Status(*error_) : file_.commit(); }

protected:
    /// Error: the file cannot hold something of these rows, which fit together.
    virtual Status check(const TableView&) const { return Done{}; }
    /// The bytes that a row of these takes at most.
    virtual std::size_t longest_row(const TableView& rows) const = 0;
    /// Puts the rows [first, last) there; the place after them. Called on all threads.
    virtual char* put_rows(const TableView& rows, std::size_t first, std::size_t last, char* at) const = 0;

    /// put(value, k) for all that a row has, in the order of its columns; k: the number of a carried one.
    template <class Put>
    void put_row(const TableView& rows, std::size_t row, const Put& put) const {
        const auto dimension = static_cast<std::size_t>(format_.dimension);
        for (const double x : rows.points.subspan(row * dimension, dimension)) put(x, 0);
        put(rows.cells[row], 0);
        put(rows.features[row], 0);
        for (const double x : rows.values.subspan(row * columns_, columns_)) put(x, 0);
        if (format_.distances) put(rows.distances[row], 0);
        for (std::size_t k = 0; k < rows.carried.size(); ++k)
            std::visit([&](const auto& values) { put(values[row], k); }, rows.carried[k].values);
    }

    std::string path_;
    TableFormat format_;
    std::size_t columns_;  ///< of values
    base::OutputFile file_;

private:
    std::vector<ByteRoom> pieces_;
    std::optional<Error> error_;  // rows that do not fit
};

}  // namespace barycert::io
