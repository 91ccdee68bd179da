// The rows of a .node file, one after the other. The grammar and the words of its errors are those of the mesh's.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "barycert/base/text.hpp"
#include "barycert/io/streams.hpp"
#include "barycert/io/formats.hpp"
#include "barycert/io/point_columns.hpp"
#include "barycert/io/tetgen/text_table.hpp"

namespace barycert::io {
namespace {

class NodeSource final : public ColumnSource {
public:
    NodeSource(TextTable table, int dimension) : ColumnSource(dimension), table_(std::move(table)) {}

    Status begin(const PointOptions& options);

    std::optional<std::uint64_t> count() const override { return table_.rows; }

private:
    Result<std::size_t> next(std::size_t max, std::vector<double>& out) override;
    Status choose(const PointOptions& options);
    Status take(std::vector<double>& out);
    Status check_end() const;

    TextTable table_;
    std::vector<double> values_;       // of a row: coordinates, attributes
    std::int64_t marker_ = 0;          // of the row
    std::vector<std::size_t> axes_;    // of values_
    std::optional<std::size_t> zero_;  // likewise: a z that must be 0
    std::vector<std::size_t> places_;  // likewise, of the carried columns; the marker is behind them
    const char* at_ = nullptr;
    std::size_t row_ = 0;
};

Status NodeSource::begin(const PointOptions& options) {
    const std::int64_t dimension = table_.header_field(1, 3);
    // Points in space may lie in the plane of a mesh.
    const auto asked = static_cast<std::int64_t>(dimension_);
    if ((dimension < asked && options.columns.empty()) || dimension < 2 || dimension > 3) {
        const std::string d = std::to_string(asked);
        return header_error(table_, "bad dimension in the header", d + ", for the mesh is " + d + "-dimensional",
                            std::to_string(dimension), "give points of the dimension of the mesh");
    }
    table_.any_real = options.nonfinite_points == NonfinitePoints::nan;
    table_.surplus_remedy = "mend the header: nodes, dimension, attributes, markers";
    table_.finite_remedy = std::string("remove the point, give it coordinates") + or_nan_for_it;
    if (Status settled = settle_node_columns(table_, dimension); !settled) return settled;
    // The rows have been found to have room for so many; where there are none, nothing is known of them.
    if (table_.rows == 0) table_.columns[2].count = 0;
    values_.resize(static_cast<std::size_t>(dimension) + table_.columns[2].count);
    table_.columns[1].reals = values_.data();
    table_.columns[2].reals = values_.data() + dimension;
    table_.columns[3].integers = &marker_;
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
    if (table_.columns[3].count != 0) all.names.emplace_back("marker");
    Result<PointColumns> columns = choose_columns(all, dimension(), options);
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
    return file_error(table_.file, "a marker cannot be a coordinate", {}, {},
                      "name coordinates or attributes in options.columns");
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

Result<std::size_t> NodeSource::next(std::size_t max, std::vector<double>& out) {
    std::size_t taken = 0;
    for (; taken != max && row_ != table_.rows; ++taken, ++row_) {
        Scanner scanner{at_, table_.end()};
        if (!scanner.next_row(table_.end())) return too_few_rows(table_, row_);
        if (!parse_row(table_, scanner, row_)) return row_error(table_, scanner.at, row_);
        if (Status given = take(out); !given) return given.error();
        at_ = scanner.at;
    }
    if (taken != 0 && row_ == table_.rows) {
        if (Status end = check_end(); !end) return end.error();
    }
    return taken;
}

}  // namespace

Result<std::unique_ptr<PointSource>> open_node_source(const std::string& path, int dimension,
                                                      const PointOptions& options) {
    constexpr std::array names{"nodes", "dimensions", "attributes", "markers"};
    Result<TextTable> table = open_table(path, names, 1);
    if (!table) return table.error();
    return begun<PointSource>(std::make_unique<NodeSource>(std::move(*table), dimension), options);
}

}  // namespace barycert::io
