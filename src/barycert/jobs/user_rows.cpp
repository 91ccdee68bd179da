#include "barycert/jobs/stream.hpp"

#include <unistd.h>

#include <set>
#include <utility>

#include "barycert/base/text.hpp"
#include "barycert/mesh/columns.hpp"

namespace barycert::jobs {

Sink open_user_rows(SampledMesh& mesh, TableFormat format, const std::vector<ColumnFormat>& carried, bool all,
                    const OpenFormat& open) {
    const std::vector<std::string> columns = format.columns();
    std::set<std::string> names(columns.begin(), columns.end());
    mesh.report.carried.clear();
    const auto add = [&](const ColumnFormat& column) {
        format.carried.push_back(column);
        mesh.report.carried.push_back(column.name);
        return !is_name_of_rows(column.name) && names.insert(column.name).second;
    };
    for (const Column* const label : mesh.labels()) {
        if (!add(mesh::format_of(*label)))
            refuse("", "a label of cells has the name of another column", "", base::quoted(label->name),
                   "leave it, or the other one, out of job.fields");
    }
    const std::set<std::string> of_rows = names;
    std::vector<bool> kept;
    std::string left_out, first;
    for (const ColumnFormat& column : carried) {
        const std::string name = base::printable(column.name);
        kept.push_back(!all || (!is_name_of_rows(column.name) && !of_rows.contains(column.name)));
        if (!kept.back()) {
            if (left_out.empty()) first = name;
            left_out += (left_out.empty() ? "" : ",") + name;
        } else if (!add(column)) {
            refuse("", "a column to keep has the name of another column of the rows", "", base::quoted(column.name),
                   "name the columns to keep, with another name for this one: job.keep OTHER=" + name);
        }
    }
    if (left_out.empty()) {
        kept.clear();
    } else {
        mesh.tell_once({{Note::Kind::left_out,
                         "columns " + left_out + ": the rows have columns of these names; job.keep OTHER=" + first +
                             " carries one through under another name",
                         mesh.report.points}});
    }
    Sink sink = open(format);
    // A sink of its own only where users see something else.
    if (!sink || (kept.empty() && mesh.labels().empty() && mesh.mesh().cell_numbers.empty())) return sink;
    const auto as_users_see_them = [&mesh, kept, shown = std::vector<Column>(),
                                    cells = std::vector<Mesh::Index>()](TableView& rows) mutable {
        if (!mesh.labels().empty() || !kept.empty()) {
            shown.clear();
            for (const Column* const labels : mesh.labels()) shown.push_back(mesh::labels_at(*labels, rows.cells));
            for (std::size_t i = 0; i < rows.carried.size(); ++i) {
                if (kept.empty() || kept[i]) shown.push_back(rows.carried[i]);
            }
            rows.carried = shown;
        }
        if (mesh.mesh().cell_numbers.empty()) return;
        cells.assign(rows.cells.begin(), rows.cells.end());
        for (Mesh::Index& cell : cells) cell = mesh.mesh().cell_number(cell);
        rows.cells = cells;
    };
    return changed(std::move(sink), as_users_see_them);
}

Sink open_rows(const std::string& path, const TableFormat& format) {
    if (path != "-" || isatty(STDOUT_FILENO) != 1) return open_table(path, format).value();
    // Texts on a terminal move no cursor.
    TableFormat shown = format;
    for (TableField& field : shown.fields) field.name = base::printable(field.name);
    for (ColumnFormat& column : shown.carried) column.name = base::printable(column.name);
    Sink sink = open_table(path, shown).value();
    if (shown.carried.empty()) return sink;
    return changed(std::move(sink), [carried = std::vector<Column>()](TableView& rows) mutable {
        carried.assign(rows.carried.begin(), rows.carried.end());
        for (Column& column : carried) {
            auto* const texts = std::get_if<std::vector<std::string>>(&column.values);
            for (std::size_t i = 0; texts != nullptr && i < texts->size(); ++i)
                (*texts)[i] = base::printable((*texts)[i]);
        }
        rows.carried = carried;
    });
}

}  // namespace barycert::jobs
