/// What sources of points with carried columns have alike.
#pragma once

#include <memory>
#include <utility>
#include <vector>

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
        Result<std::size_t> taken = next(max_points, out);
        if (!taken) error_ = taken.error();
        return taken;
    }

protected:
    /// As read(); `carried_` has empty columns for what goes with the points. Not called after an Error.
    virtual Result<std::size_t> next(std::size_t max_points, std::vector<double>& out) = 0;

    std::size_t dimension_;
    std::vector<ColumnFormat> formats_;  ///< of the carried columns
    std::vector<Column> carried_;        ///< of the last points given
    Notes notes_;

private:
    Error error_;
};

/// The source or sink, unless its begin(arguments...) fails.
template <class Base, class Made, class... Arguments>
Result<std::unique_ptr<Base>> begun(std::unique_ptr<Made> made, const Arguments&... arguments) {
    if (Status status = made->begin(arguments...); !status) return status.error();
    return std::unique_ptr<Base>(std::move(made));
}

}  // namespace barycert::io
