// The rows of a .node file, one after the other. The grammar and the words of its errors are those of the mesh's.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/point_columns.hpp"
#include "barycert/io/tetgen/row_errors.hpp"
#include "barycert/io/tetgen/tetgen_reader.hpp"
#include "barycert/io/tetgen/text_table.hpp"
#include "barycert/mesh/columns.hpp"

namespace barycert::io {
namespace {

using barycert::io::ColumnKind;
using barycert::io::header_error;
using barycert::io::header_field;
using barycert::io::Scanner;
using barycert::io::TextTable;

class NodeSource final : public PointSource {
public:
    NodeSource(TextTable table, int dimension) : table_(std::move(table)), dimension_(dimension) {}

    Status begin(const PointOptions& options);

    int dimension() const override { return dimension_; }
    std::optional<std::uint64_t> count() const override { return table_.rows; }
    Result<std::size_t> read(std::size_t max, std::vector<double>& out) override;
    std::vector<ColumnFormat> carried() const override { return formats_; }
    void take_carried(std::vector<Column>& columns) override { std::swap(columns, carried_); }
    Notes notes() const override { return notes_; }

private:
    Status choose(const PointOptions& options);
    bool parse(Scanner& scanner);
    Status take(std::vector<double>& out);
    Status check_end() const;

    TextTable table_;
    int dimension_;
    bool markers_ = false;
    bool any_point_ = false;             // those that are not finite, too
    std::vector<double> values_;         // of a row: coordinates, attributes
    std::int64_t marker_ = 0;            // of the row
    std::vector<std::size_t> axes_;      // of values_
    std::optional<std::size_t> zero_;    // likewise: a z that must be 0
    std::vector<std::size_t> places_;    // likewise, of the carried columns; the marker is behind them
    std::vector<ColumnFormat> formats_;  // of these
    std::vector<Column> carried_;        // of the last points given
    Notes notes_;
    const char* at_ = nullptr;
    std::size_t row_ = 0;
    Error error_;
};

Status NodeSource::begin(const PointOptions& options) {
    const std::int64_t dimension = header_field(table_, 1, 3);
    const std::int64_t attributes = header_field(table_, 2, 0);
    const std::int64_t markers = header_field(table_, 3, 0);
    // Points in space may lie in the plane of a mesh.
    if ((dimension < dimension_ && options.columns.empty()) || dimension < 2 || dimension > 3) {
        const std::string asked = std::to_string(dimension_);
        return header_error(table_, "bad dimension in the header",
                            asked + ", for the mesh is " + asked + "-dimensional", std::to_string(dimension),
                            "give points of the dimension of the mesh");
    }
    if (markers > 1) {
        return header_error(table_, "bad number of markers in the header", "0 or 1", std::to_string(markers),
                            "declare further columns as attributes");
    }
    markers_ = markers != 0;
    any_point_ = options.nonfinite_points == NonfinitePoints::nan;
    table_.columns = {{ColumnKind::id, 1, "id"},
                      {ColumnKind::real, static_cast<std::size_t>(dimension), "coordinate"},
                      {ColumnKind::real, static_cast<std::size_t>(attributes), "attribute"},
                      {ColumnKind::integer, static_cast<std::size_t>(markers), "marker"}};
    table_.surplus_remedy = "mend the header: nodes, dimension, attributes, markers";
    table_.finite_remedy = std::string("remove the point, give it coordinates") + or_nan_for_it;
    const std::vector<std::string_view> first = table_.first_row();
    std::int64_t id = 0;
    table_.base = !first.empty() && barycert::io::scan_integer(first.front().data(), id) != nullptr && id == 1 ? 1 : 0;
    if (Status room = check_room(table_); !room) return room;
    // The rows have been found to have room for so many; where there are none, nothing is known of them.
    if (table_.rows == 0) table_.columns[2].count = 0;
    values_.resize(static_cast<std::size_t>(dimension) + table_.columns[2].count);
    if (Status chosen = choose(options); !chosen) return chosen;
    at_ = table_.body;
    return table_.rows == 0 ? check_end() : Done{};
}

/// Which columns are what.
Status NodeSource::choose(const PointOptions& options) {
    const std::size_t file_axes = values_.size() - table_.columns[2].count;
    TableColumns all{.names = {}, .named = true, .file = table_.file, .line = 0, .coordinates = file_axes};
    for (std::size_t i = 0; i < values_.size(); ++i)
        all.names.push_back(i < file_axes ? std::string(1, "xyz"[i]) : "attribute" + std::to_string(i - file_axes));
    if (markers_) all.names.emplace_back("marker");
    Result<PointColumns> columns = choose_columns(all, dimension_, options);
    if (!columns) return columns.error();
    axes_ = std::move(columns->axes);
    zero_ = columns->zero;
    for (PointColumns::Kept& kept : columns->kept) {
        places_.push_back(kept.column);
        const bool marker = kept.column == values_.size();
        formats_.push_back({std::move(kept.name), marker ? Column::Type::integer : Column::Type::number});
    }
    notes_ = std::move(columns->notes);
    const bool marker_as_coordinate = std::find(axes_.begin(), axes_.end(), values_.size()) != axes_.end();
    if (!marker_as_coordinate) return Done{};
    return Error{.what = "a marker cannot be a coordinate",
                 .file = table_.file,
                 .remedy = "name coordinates or attributes in --columns"};
}

bool NodeSource::parse(Scanner& scanner) {
    if (!scan_id(scanner, row_ + static_cast<std::size_t>(table_.base))) return false;
    for (double& value : values_) {
        if (!scanner.separator()) return false;
        if (scanner.real(value)) continue;
        const char* const after = any_point_ ? scan_nonfinite(scanner.at, scanner.end, value) : nullptr;
        if (after == nullptr) return false;
        scanner.at = after;
    }
    if (markers_ && (!scanner.separator() || !scanner.integer(marker_))) return false;
    return scanner.end_row();
}

/// Gives the row that was parsed.
Status NodeSource::take(std::vector<double>& out) {
    if (zero_ && values_[*zero_] != 0 && std::isfinite(values_[axes_[0]]) && std::isfinite(values_[axes_[1]]))
        return off_plane(table_.file, 0, "node " + std::to_string(row_) + ", counted from 0",
                         base::shortest(values_[*zero_]));
    for (const std::size_t axis : axes_) out.push_back(values_[axis]);
    for (std::size_t k = 0; k < places_.size(); ++k) {
        if (places_[k] == values_.size()) {
            std::get<std::vector<std::int64_t>>(carried_[k].values).push_back(marker_);
        } else {
            std::get<std::vector<double>>(carried_[k].values).push_back(values_[places_[k]]);
        }
    }
    return Done{};
}

Status NodeSource::check_end() const {
    Scanner scanner{at_, table_.end()};
    if (scanner.next_row(table_.end())) return surplus_text(table_, scanner.at);
    return Done{};
}

Result<std::size_t> NodeSource::read(std::size_t max, std::vector<double>& out) {
    const ExactEnvironment environment;
    if (!error_.what.empty()) return error_;
    mesh::begin_columns(formats_, carried_);
    std::size_t taken = 0;
    for (; taken != max && row_ != table_.rows; ++taken, ++row_) {
        Scanner scanner{at_, table_.end()};
        const bool begun = scanner.next_row(table_.end());
        if (!begun || !parse(scanner)) {
            error_ = begun ? row_error(table_, scanner.at, row_) : too_few_rows(table_, row_);
            return error_;
        }
        if (Status given = take(out); !given) return error_ = given.error();
        at_ = scanner.at;
    }
    if (taken != 0 && row_ == table_.rows) {
        if (Status end = check_end(); !end) return error_ = end.error();
    }
    return taken;
}

}  // namespace

Result<std::unique_ptr<PointSource>> open_node_source(const std::string& path, int dimension,
                                                      const PointOptions& options) {
    constexpr std::array names{"nodes", "dimensions", "attributes", "markers"};
    Result<TextTable> table = barycert::io::open_table(path, names, 1);
    if (!table) return table.error();
    auto source = std::make_unique<NodeSource>(std::move(*table), dimension);
    if (Status begun = source->begin(options); !begun) return begun.error();
    return std::unique_ptr<PointSource>(std::move(source));
}

}  // namespace barycert::io
