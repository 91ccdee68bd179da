#include "barycert/jobs/user_rows.hpp"

#include <unistd.h>

#include <algorithm>
#include <set>
#include <utility>

#include "barycert/base/text.hpp"
#include "barycert/jobs/field_files.hpp"
#include "barycert/mesh/columns.hpp"

namespace barycert::jobs {
namespace {

class UserRows final : public TableSink {
public:
    UserRows(const SampledMesh& mesh, std::unique_ptr<TableSink> sink, std::vector<bool> kept)
        : mesh_(mesh), sink_(std::move(sink)), kept_(std::move(kept)) {}

    Status write(const TableView& rows) override {
        TableView shown = rows;
        if (!mesh_.labels().empty() || !kept_.empty()) {
            carried_.clear();
            for (const Column* const labels : mesh_.labels()) carried_.push_back(mesh::labels_at(*labels, rows.cells));
            for (std::size_t i = 0; i < rows.carried.size(); ++i) {
                if (kept_.empty() || kept_[i]) carried_.push_back(rows.carried[i]);
            }
            shown.carried = carried_;
        }
        const Mesh& mesh = mesh_.mesh();
        if (!mesh.cell_numbers.empty()) {
            cells_.assign(rows.cells.begin(), rows.cells.end());
            for (Mesh::Index& cell : cells_) cell = mesh.cell_number(cell);
            shown.cells = cells_;
        }
        return sink_->write(shown);
    }
    Status commit() override { return sink_->commit(); }

private:
    const SampledMesh& mesh_;
    std::unique_ptr<TableSink> sink_;
    std::vector<bool> kept_;
    std::vector<Mesh::Index> cells_;
    std::vector<Column> carried_;
};

/// Rows on a terminal: their texts move no cursor.
class PrintableTexts final : public TableSink {
public:
    explicit PrintableTexts(std::unique_ptr<TableSink> sink) : sink_(std::move(sink)) {}

    Status write(const TableView& rows) override {
        std::vector<Column> carried(rows.carried.begin(), rows.carried.end());
        for (Column& column : carried) {
            auto* const texts = std::get_if<std::vector<std::string>>(&column.values);
            if (texts == nullptr) continue;
            for (std::string& text : *texts) text = base::printable(text);
        }
        TableView shown = rows;
        shown.carried = carried;
        return sink_->write(shown);
    }
    Status commit() override { return sink_->commit(); }

private:
    std::unique_ptr<TableSink> sink_;
};

}  // namespace

KeptColumns keep_all(const SampledMesh& mesh, const TableFormat& format, const std::vector<ColumnFormat>& carried,
                     const std::string& file) {
    std::set<std::string> of_rows;
    for (const std::string& name : format.columns()) of_rows.insert(name);
    for (const Column* const label : mesh.labels()) of_rows.insert(label->name);
    KeptColumns of;
    std::string names, first;
    for (const ColumnFormat& column : carried) {
        of.kept.push_back(!is_name_of_rows(column.name) && !of_rows.contains(column.name));
        if (of.kept.back()) {
            of.columns.push_back(column);
            continue;
        }
        const std::string name = base::printable(column.name);
        if (names.empty()) first = name;
        names += (names.empty() ? "" : ",") + name;
    }
    if (names.empty()) {
        of.kept.clear();
        return of;
    }
    of.left_out.push_back({Note::Kind::left_out,
                           "columns " + names + ": the rows have columns of these names; job.keep OTHER=" + first +
                               " carries one through under another name",
                           file});
    return of;
}

Result<TableFormat> user_format(SampledMesh& mesh, TableFormat format, const std::vector<ColumnFormat>& carried) {
    std::set<std::string> names;
    for (const std::string& name : format.columns()) names.insert(name);
    const std::size_t labels = mesh.labels().size();
    for (const Column* const label : mesh.labels()) format.carried.push_back(mesh::format_of(*label));
    format.carried.insert(format.carried.end(), carried.begin(), carried.end());
    mesh.report.carried.clear();
    for (std::size_t i = 0; i < format.carried.size(); ++i) {
        const std::string& name = format.carried[i].name;
        mesh.report.carried.push_back(name);
        if (!is_name_of_rows(name) && names.insert(name).second) continue;
        return Error{.what = i < labels ? "a label of cells has the name of another column"
                                        : "a column to keep has the name of another column of the rows",
                     .found = base::quoted(name),
                     .remedy = i < labels
                                   ? "leave it, or the other one, out of job.fields"
                                   : "name the columns to keep, with another name for this one: job.keep OTHER=" +
                                         base::printable(name)};
    }
    return format;
}

std::unique_ptr<TableSink> user_rows(const SampledMesh& mesh, std::unique_ptr<TableSink> sink, std::vector<bool> kept) {
    if (kept.empty() && mesh.labels().empty() && mesh.mesh().cell_numbers.empty()) return sink;
    return std::make_unique<UserRows>(mesh, std::move(sink), std::move(kept));
}

Result<std::unique_ptr<TableSink>> open_rows(const std::string& path, const TableFormat& format) {
    if (path != "-" || isatty(STDOUT_FILENO) != 1) return open_table(path, format);
    TableFormat shown = format;
    for (TableField& field : shown.fields) field.name = base::printable(field.name);
    for (ColumnFormat& column : shown.carried) column.name = base::printable(column.name);
    Result<std::unique_ptr<TableSink>> sink = open_table(path, shown);
    if (!sink || shown.carried.empty()) return sink;
    return std::unique_ptr<TableSink>(std::make_unique<PrintableTexts>(std::move(*sink)));
}

}  // namespace barycert::jobs
