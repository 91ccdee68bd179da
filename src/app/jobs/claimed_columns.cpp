#include "app/jobs/claimed_columns.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "app/jobs/job_files.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/table.hpp"
#include "barycert/verify_job.hpp"
#include "core/base/nearest_name.hpp"
#include "core/base/text.hpp"
#include "mesh/sample/quantity/quantities.hpp"

namespace barycert::jobs {
namespace {

bool has(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

constexpr const char* none = "none";

/// `member`: of the job, which names the column; `what`: what the column is of, in words.
[[noreturn]] void refuse_column(const VerifyJob& job, const std::string& member, const std::string& what,
                                const std::string& name, const std::vector<std::string>& there) {
    refuse_member("column.unknown", member, job.results, what + ": the results have no such column",
                  listed(there, base::quoted), base::quoted(name),
                  base::did_you_mean(name, there, "name one of these"));
}

TableField columns_of(const Mesh& mesh, const FieldChoice& choice) {
    return {sample::name_of(choice), static_cast<int>(sample::shape_of(mesh, choice)->components)};
}

/// The column of component c of a field: what the job says, or one of the usual names; empty: none.
std::string column_of(const VerifyJob& job, const TableField& field, int c, const std::vector<std::string>& there) {
    const std::string number = std::to_string(c);
    std::string own = field.components == 1 ? field.name : field.name + '.' + number;
    if (const auto named = job.values.find(own); named != job.values.end()) return named->second;
    if (has(there, own)) return own;
    for (const char sign : {':', '_'}) {
        if (std::string name = field.name + sign + number; field.components != 1 && has(there, name)) return name;
    }
    return "";
}

void check_named(const VerifyJob& job, const Mesh& mesh, const std::vector<FieldChoice>& fields,
                 const std::vector<std::string>& there) {
    std::vector<TableField> all(fields.size());
    std::ranges::transform(fields, all.begin(), [&](const FieldChoice& choice) { return columns_of(mesh, choice); });
    const std::vector<std::string> known = column_names(all);
    for (const auto& [value, column] : job.values) {
        if (!has(known, value))
            refuse_member("field.unknown", "job.values", "", "job.values: the mesh has no such value",
                          listed(known, base::quoted, "no field at all: give one with job.field_files"),
                          base::quoted(value), base::did_you_mean(value, known));
        if (!has(there, column)) refuse_column(job, "job.values", "job.values", column, there);
    }
    for (const auto& [member, column] :
         {std::pair("job.cell_column", job.cell_column), {"job.mask_column", job.mask_column}}) {
        if (!column.empty() && column != none && !has(there, column)) refuse_column(job, member, member, column, there);
    }
}

std::string chosen(const std::string& asked, const std::string& usual, const std::vector<std::string>& there) {
    if (asked == none) return "";
    if (!asked.empty()) return asked;
    return has(there, usual) ? usual : "";
}

/// Numbers of a column as doubles; NaN for an empty text. A mask may have the bytes 0 and 1, too, as
/// vtkDelimitedTextWriter writes them.
std::vector<double> numbers_of(const std::vector<Column>& columns, const std::string& name, const VerifyJob& job,
                               std::uint64_t first_row, bool mask = false) {
    const Column& column = *std::ranges::find(columns, name, &Column::name);
    if (const auto* const numbers = std::get_if<std::vector<double>>(&column.values)) return *numbers;
    std::vector<double> out;
    out.reserve(column.size());
    if (const auto* const integers = std::get_if<std::vector<std::int64_t>>(&column.values)) {
        for (const std::int64_t x : *integers) out.push_back(static_cast<double>(x));
        return out;
    }
    for (const std::string& text : std::get<std::vector<std::string>>(column.values)) {
        std::optional<double> x = base::parse_double(text);
        if (text.empty()) x = std::numeric_limits<double>::quiet_NaN();
        if (mask && text.size() == 1 && (text[0] == '\0' || text[0] == '\1')) x = text[0];
        if (!x)
            refuse_member(
                "file.number", "job.values", job.results,
                "row " + std::to_string(first_row + out.size()) + " (from 0), column " + base::quoted(column.name),
                "a number, nan, or nothing", base::quoted(text),
                "choose the columns to compare: job.fields, job.values, job.cell_column");
        out.push_back(*x);
    }
    return out;
}

/// Index in the mesh; beyond the last cell where the mesh has no such number.
std::int64_t index_of(std::int64_t number, const Mesh& mesh) {
    if (number < 0) return -1;
    const auto cells = static_cast<std::int64_t>(mesh.cell_count());
    if (mesh.cell_numbers.empty()) return std::min(number, cells);
    const auto at = std::lower_bound(mesh.cell_numbers.begin(), mesh.cell_numbers.end(), number);
    return at != mesh.cell_numbers.end() && *at == number ? at - mesh.cell_numbers.begin() : cells;
}

}  // namespace

std::vector<std::string> ClaimedColumns::names() const {
    std::vector<std::string> all = values, once;
    all.insert(all.end(), {cell, mask});
    for (const std::string& name : all) {
        if (!name.empty() && !has(once, name)) once.push_back(name);
    }
    return once;
}

ClaimedColumns claimed_columns(const VerifyJob& job, const Mesh& mesh, const std::vector<FieldChoice>& fields,
                               const std::vector<ColumnFormat>& formats, Notes& notes) {
    std::vector<std::string> there(formats.size());
    std::ranges::transform(formats, there.begin(), &ColumnFormat::name);
    check_named(job, mesh, fields, there);
    ClaimedColumns out;
    for (const FieldChoice& choice : fields) {
        const TableField own = columns_of(mesh, choice);
        std::vector<std::string> columns;
        columns.reserve(static_cast<std::size_t>(own.components));
        for (int c = 0; c < own.components; ++c) columns.push_back(column_of(job, own, c, there));
        if (!has(columns, "")) {
            out.fields.push_back(choice);
            out.values.insert(out.values.end(), columns.begin(), columns.end());
        } else if (!job.fields.empty()) {
            refuse_column(job, "job.fields", "field " + base::quoted(own.name), own.name, there);
        } else {
            notes.push_back(
                {Note::Kind::left_out,
                 "field " + base::quoted(own.name) + " of the mesh: the results have no column of that name",
                 job.results});
        }
    }
    out.cell = chosen(job.cell_column, "cell", there);
    out.mask = chosen(job.mask_column, "vtkValidPointMask", there);
    const std::vector<std::string> used = out.names();
    std::vector<std::string> unused = there;
    std::erase_if(unused, [&](const std::string& name) { return has(used, name); });
    if (!unused.empty())
        notes.push_back({Note::Kind::left_out,
                         "columns that are not compared: " + listed(unused, [](const auto& name) { return name; }),
                         job.results});
    if (!used.empty()) return out;
    const auto name = [](const FieldChoice& choice) { return base::quoted(choice.field->name); };
    refuse_member(
        "column.unknown", "job.values", job.results, "the results have no column to compare",
        "columns named as fields of the mesh (" + listed(fields, name, "it has none") +
            "), `cell` or vtkValidPointMask",
        listed(there, base::quoted),
        "say which column is which: job.values FIELD=COLUMN, job.cell_column NAME; fields that are not in the mesh "
        "file: job.field_files NAME=FILE");
}

Claims claims_of(const ClaimedColumns& which, const std::vector<Column>& columns, const Mesh& mesh,
                 const VerifyJob& job, std::uint64_t first_row) {
    Claims out;
    const std::size_t rows = columns.empty() ? 0 : columns.front().size(), width = which.values.size();
    out.values.resize(rows * width);
    for (std::size_t c = 0; c < width; ++c) {
        const std::vector<double> numbers = numbers_of(columns, which.values[c], job, first_row);
        for (std::size_t i = 0; i < rows; ++i) out.values[width * i + c] = numbers[i];
    }
    if (!which.cell.empty()) {
        const std::vector<double> numbers = numbers_of(columns, which.cell, job, first_row);
        for (std::size_t i = 0; i < rows; ++i) {
            const double x = numbers[i];
            if (!std::isnan(x) && (std::floor(x) != x || std::fabs(x) > 0x1p53))
                refuse_member("file.number", "job.cell_column", job.results,
                              "the cell of row " + std::to_string(first_row + i) + " (from 0)", "an integer",
                              base::shortest(x), "name the column of cells: job.cell_column NAME, or none");
            const std::int64_t number = std::isnan(x) ? -1 : static_cast<std::int64_t>(x);
            out.cells.push_back(number < 0 ? -1 : index_of(number - job.cell_base, mesh));
        }
    }
    if (!which.mask.empty()) {
        for (const double x : numbers_of(columns, which.mask, job, first_row, true))
            out.inside.push_back(x != 0 && !std::isnan(x) ? 1 : 0);
    }
    return out;
}

}  // namespace barycert::jobs
