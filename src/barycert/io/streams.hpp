/// What sources of points with carried columns have alike.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "barycert/base/output_file.hpp"
#include "barycert/environment.hpp"
#include "barycert/io.hpp"
#include "barycert/mesh/columns.hpp"

namespace barycert::io {

class ColumnSource : public PointSource {
public:
    explicit ColumnSource(int dimension) : dimension_(static_cast<std::size_t>(dimension)) {}

    int dimension() const override { return static_cast<int>(dimension_); }
    std::vector<ColumnFormat> carried() const override { return formats_; }
    void take_carried(std::vector<Column>& columns) override { std::swap(columns, carried_); }
    Notes notes() const override { return notes_; }

    Result<std::size_t> read(std::size_t max_points, std::vector<double>& out) override {
        const ExactEnvironment environment;
        if (!error_.what.empty()) return error_;
        mesh::begin_columns(formats_, carried_);
        try {
            return next(max_points, out);
        } catch (const Exception& problem) {
            return error_ = problem.error();
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
    Error error_;
};

class RowSink : public TableSink {
public:
    /// "-" is the standard output.
    RowSink(const std::string& path, TableFormat format);

    Status write(const TableView& rows) override;
    Status commit() override { return error_.what.empty() ? file_.commit() : Status(error_); }

protected:
    /// What the file cannot hold of rows that fit together.
    virtual Status check(const TableView&) const { return Done{}; }
    /// The bytes that a row of these takes at most.
    virtual std::size_t longest_row(const TableView& rows) const = 0;
    /// Puts the rows [first, last) there; the place after them. Called on all threads.
    virtual char* put_rows(const TableView& rows, std::size_t first, std::size_t last, char* at) const = 0;

    std::string path_;
    TableFormat format_;
    std::size_t columns_;  ///< of values
    base::OutputFile file_;

private:
    std::vector<std::vector<char>> pieces_;
    Error error_;  // rows that do not fit
};

}  // namespace barycert::io
