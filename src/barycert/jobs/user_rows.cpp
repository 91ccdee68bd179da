#include "barycert/jobs/user_rows.hpp"

#include <set>
#include <string>
#include <utility>

#include "barycert/base/text.hpp"
#include "barycert/jobs/field_files.hpp"
#include "barycert/mesh/columns.hpp"

namespace barycert::jobs {
namespace {

class UserRows final : public TableSink {
public:
    UserRows(const Engine& engine, std::unique_ptr<TableSink> sink) : engine_(engine), sink_(std::move(sink)) {}

    Status write(const TableView& rows) override {
        TableView shown = rows;
        if (!engine_.labels().empty()) {
            carried_.clear();
            for (const Column* const labels : engine_.labels())
                carried_.push_back(mesh::labels_at(*labels, rows.cells));
            carried_.insert(carried_.end(), rows.carried.begin(), rows.carried.end());
            shown.carried = carried_;
        }
        const Mesh& mesh = engine_.mesh();
        if (!mesh.cell_numbers.empty()) {
            cells_.assign(rows.cells.begin(), rows.cells.end());
            for (Mesh::Index& cell : cells_) cell = mesh.cell_number(cell);
            shown.cells = cells_;
        }
        return sink_->write(shown);
    }
    Status commit() override { return sink_->commit(); }

private:
    const Engine& engine_;
    std::unique_ptr<TableSink> sink_;
    std::vector<Mesh::Index> cells_;
    std::vector<Column> carried_;
};

}  // namespace

Result<TableFormat> user_format(const Engine& engine, TableFormat format, std::vector<ColumnFormat> carried) {
    std::set<std::string> names;
    for (const std::string& name : format.columns()) names.insert(name);
    const std::size_t labels = engine.labels().size();
    for (const Column* const label : engine.labels()) format.carried.push_back(mesh::format_of(*label));
    for (ColumnFormat& column : carried) format.carried.push_back(std::move(column));
    for (std::size_t i = 0; i < format.carried.size(); ++i) {
        const std::string& name = format.carried[i].name;
        if (!is_name_of_rows(name) && names.insert(name).second) continue;
        return Error{.what = i < labels ? "a label of cells has the name of another column"
                                        : "a column to keep has the name of another column of the rows",
                     .found = base::quoted(name),
                     .remedy = i < labels ? "leave it, or the other one, out of --fields"
                                          : "name the columns to keep, with another name for this one: --keep OTHER=" +
                                                base::printable(name)};
    }
    return format;
}

std::unique_ptr<TableSink> user_rows(const Engine& engine, std::unique_ptr<TableSink> sink) {
    if (sink == nullptr || (engine.labels().empty() && engine.mesh().cell_numbers.empty())) return sink;
    return std::make_unique<UserRows>(engine, std::move(sink));
}

}  // namespace barycert::jobs
