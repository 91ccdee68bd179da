#include "barycert/jobs/kept_columns.hpp"

#include <set>
#include <utility>

#include "barycert/base/text.hpp"
#include "barycert/jobs/field_files.hpp"

namespace barycert::jobs {
namespace {

class FewerColumns final : public TableSink {
public:
    FewerColumns(std::vector<bool> kept, std::unique_ptr<TableSink> sink)
        : kept_(std::move(kept)), sink_(std::move(sink)) {}

    Status write(const TableView& rows) override {
        carried_.clear();
        for (std::size_t i = 0; i < rows.carried.size(); ++i) {
            if (kept_[i]) carried_.push_back(rows.carried[i]);
        }
        TableView fewer = rows;
        fewer.carried = carried_;
        return sink_->write(fewer);
    }
    Status commit() override { return sink_->commit(); }

private:
    std::vector<bool> kept_;
    std::unique_ptr<TableSink> sink_;
    std::vector<Column> carried_;
};

}  // namespace

std::vector<bool> columns_to_keep(const Engine& engine, const TableFormat& format,
                                  const std::vector<ColumnFormat>& carried) {
    std::set<std::string> names;
    for (const std::string& name : format.columns()) names.insert(name);
    for (const Column* const label : engine.labels()) names.insert(label->name);
    std::vector<bool> kept;
    kept.reserve(carried.size());
    for (const ColumnFormat& column : carried)
        kept.push_back(!is_name_of_rows(column.name) && !names.contains(column.name));
    return kept;
}

Note leave_out(const std::vector<bool>& kept, std::vector<ColumnFormat>& carried, const std::string& file) {
    std::string names, first;
    std::size_t at = 0;
    std::erase_if(carried, [&](const ColumnFormat& column) {
        if (kept[at++]) return false;
        const std::string name = base::printable(column.name);
        if (names.empty()) first = name;
        names += (names.empty() ? "" : ",") + name;
        return true;
    });
    return {Note::Kind::left_out,
            "columns " + names + ": the rows have columns of these names; --keep OTHER=" + first +
                " carries one through under another name",
            file};
}

std::unique_ptr<TableSink> rows_without(const std::vector<bool>& kept, std::unique_ptr<TableSink> sink) {
    return std::make_unique<FewerColumns>(kept, std::move(sink));
}

}  // namespace barycert::jobs
