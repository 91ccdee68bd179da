/// What sinks of rows into files have alike: blocks are cut into pieces that are laid out on all threads.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "barycert/base/output_file.hpp"
#include "barycert/io.hpp"

namespace barycert::io {

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
