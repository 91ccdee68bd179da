// Results of a tool held against the exact ones.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "barycert/base/nearest_name.hpp"
#include "barycert/environment.hpp"
#include "barycert/jobs/stream.hpp"
#include "barycert/sample/quantity/quantities.hpp"

namespace barycert::jobs {
namespace {

// Which columns of a file of results say what, and their values as claims.

bool has(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Names of columns; empty: none.
struct ClaimedColumns {
    std::vector<FieldChoice> fields;  ///< those of which all components were found, in their order
    std::vector<std::string> values;  ///< for each component of these
    std::string cell, mask;

    /// All of them, each once.
    std::vector<std::string> names() const {
        std::vector<std::string> all = values, once;
        all.insert(all.end(), {cell, mask});
        for (const std::string& name : all) {
            if (!name.empty() && !has(once, name)) once.push_back(name);
        }
        return once;
    }
};

struct Claims {
    std::vector<std::int64_t> cells;
    std::vector<std::uint8_t> inside;
    std::vector<double> values;
};

constexpr const char* none = "none";

[[noreturn]] void refuse_column(const VerifyJob& job, const std::string& what, const std::string& name,
                                const std::vector<std::string>& there) {
    refuse(job.results, what + ": the results have no such column", listed(there, base::quoted), base::quoted(name),
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
            refuse("", "job.values: the mesh has no such value",
                   listed(known, base::quoted, "no field at all: give one with job.field_files"), base::quoted(value),
                   base::did_you_mean(value, known));
        if (!has(there, column)) refuse_column(job, "job.values", column, there);
    }
    for (const auto& [member, column] :
         {std::pair("job.cell_column", job.cell_column), {"job.mask_column", job.mask_column}}) {
        if (!column.empty() && column != none && !has(there, column)) refuse_column(job, member, column, there);
    }
}

std::string chosen(const std::string& asked, const std::string& usual, const std::vector<std::string>& there) {
    if (asked == none) return "";
    if (!asked.empty()) return asked;
    return has(there, usual) ? usual : "";
}

/// As doubles; NaN for an empty text. Of a mask also the bytes 0 and 1, as vtkDelimitedTextWriter writes them.
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
            refuse(job.results,
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

/// Chooses among the columns of the results; notes what is not compared. Refused: one is not there, or none is left.
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
            refuse_column(job, "field " + base::quoted(own.name), own.name, there);
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
    refuse(job.results, "the results have no column to compare",
           "columns named as fields of the mesh (" + listed(fields, name, "it has none") +
               "), `cell` or vtkValidPointMask",
           listed(there, base::quoted),
           "say which column is which: job.values FIELD=COLUMN, job.cell_column NAME; fields that are not in the mesh "
           "file: job.field_files NAME=FILE");
}

/// What the columns say. Cells are as index_of() gives them. Refused: a text that is no number, a cell no integer.
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
                refuse(job.results, "the cell of row " + std::to_string(first_row + i) + " (from 0)", "an integer",
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

}  // namespace
}  // namespace barycert::jobs

namespace barycert {
namespace {

using jobs::Claims;
using jobs::refuse;
using jobs::Stopwatch;

constexpr double tolerance_of_floats = 1e-6;

/// Is every number of the columns of values single precision? False if there is none.
bool are_floats(const Claims& claims) {
    std::size_t numbers = 0;
    for (const double x : claims.values) {
        if (std::isnan(x) || x == 0) continue;
        if (static_cast<double>(static_cast<float>(x)) != x) return false;
        ++numbers;
    }
    return numbers > 0;
}

bool has_digits(double x, int digits) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), x, std::chars_format::general, digits).ptr;
    return base::parse_double({text.data(), end}) == x;
}

/// Were the numbers written with six digits, as printf and streams do unless told otherwise?
bool are_cut_to_six_digits(const Claims& claims) {
    bool cut = false;
    for (const double x : claims.values) {
        if (!std::isfinite(x)) continue;
        if (!has_digits(x, 6)) return false;
        cut = cut || !has_digits(x, 5);
    }
    return cut;
}

/// Are these the errors of a tool that stops an iteration in second-order cells at 1e-5, as VTK does? A coordinate of
/// the cell that is off by s changes a value by up to 5 s of the range: at a vertex the slopes of the shape functions
/// are -4, -1, 1, 4. So 1e-4 is a bound, but for all three coordinates at their worst. Rounding leaves 1e-12 at most,
/// single precision 1e-7: few values are so good where an iteration stopped.
bool may_be_of_iteration(const ValueErrors& e) {
    const auto count = [&](int from_decade, int to_decade) {  // of errors from 10^from on, below 10^to
        const auto bin = e.by_relative.begin() + 19;
        return std::accumulate(bin + from_decade, bin + to_decade, std::uint64_t{0});
    };
    const bool single = e.floats == e.values;
    return e.values == e.identical || (e.values >= 10 && e.missing == 0 && e.spurious == 0 && count(-4, 3) == 0 &&
                                       count(-19, single ? -7 : -12) <= e.values / 10);
}

class Verification {
public:
    explicit Verification(const VerifyJob& job) : job_(job) {}

    VerifyReport run() {
        Stopwatch whole;
        read_all();
        build();
        check_limits();
        compare();
        if (report_.verdicts.rows == 0)
            refuse(job_.results == "-" ? "standard input" : job_.results, "there are no results to verify",
                   "a row for each point", "no row", "look at what should have written them: nothing was compared");
        for (WrongRow& row : report_.verdicts.examples) {
            row.exact.cell = mesh_.cell_number(row.exact.cell);
            if (row.claimed_cell >= static_cast<std::int64_t>(mesh_.cell_count())) continue;
            row.claimed_cell = mesh_.cell_number(static_cast<Mesh::Index>(row.claimed_cell));
        }
        report_.seconds.total = whole.lap();
        return std::move(report_);
    }

private:
    void read_all() {
        Stopwatch watch;
        mesh_ = jobs::open_mesh_with_fields(job_, job_.options.threads, report_);
        const std::vector<FieldChoice> fields = sample::quantities_named(mesh_, job_.fields).value();
        report_.seconds.mesh = watch.lap();
        report_.results = job_.results;
        report_.program = job_.program;
        PointOptions options{
            .columns = job_.columns, .keep = {"all"}, .nonfinite_points = job_.options.nonfinite_points};
        const auto open = [&] { source_ = open_points(job_.results, mesh_.dimension, options).value(); };
        open();
        columns_ = jobs::claimed_columns(job_, mesh_, fields, source_->carried(), report_.notes);
        options.keep = columns_.names();
        if (!jobs::is_read_once(job_.results)) open();
    }

    void build() {
        Stopwatch watch;
        locator_ = jobs::build_locator(job_, mesh_, job_.options.threads);
        jobs::report_maps(job_, *locator_, report_);
        sampler_ = Sampler::build(*locator_, columns_.fields).value();
        report_.certified = locator_->certified();
        report_.contested_cells = locator_->contested_cells();
        report_.columns = sampler_->columns();
        report_.found_in = columns_.values;
        report_.cell_column = columns_.cell;
        report_.mask_column = columns_.mask;
        report_.seconds.build = watch.lap();
    }

    void check_limits() {
        report_.limits = job_.limits;
        for (const RowVerdict kind : kinds_of_wrong) {
            if (job_.limits.empty()) report_.limits.push_back({kind, 0});
        }
        for (const VerifyLimit& limit : job_.limits) {
            if (report_.compared(limit.verdict)) continue;
            const bool cells = limit.verdict == RowVerdict::wrong_cell;
            refuse(job_.results, "a rule that no row can break: " + std::string(handle(limit.verdict)),
                   cells ? "a column that names cells" : "a column of values of a field", "none",
                   cells ? "name it with job.cell_column, or leave the rule out"
                         : "name it with job.values, or leave the rule out");
        }
    }

    void guess(std::string text) {
        report_.notes.push_back({Note::Kind::guessed, std::move(text), job_.results, true});
    }

    /// Single precision is told by the first block.
    void choose_tolerance(const jobs::Block& first, VerifyOptions& options) {
        if (job_.tolerance) options.tolerance = *job_.tolerance;
        if (job_.tolerance || options.exact) return;
        const Claims claims = claims_of(first);
        cut_ = are_cut_to_six_digits(claims);
        if (cut_)
            return guess(
                "values have six digits: what was cut off counts as an error; let the tool write 17 digits, of "
                "coordinates as well, or see job.tolerance");
        if (!are_floats(claims)) return;
        options.tolerance = tolerance_of_floats;
        guess(
            "values are single precision: errors up to 1e-6 of the range count as right; job.tolerance says otherwise");
    }

    Claims claims_of(const jobs::Block& block) const {
        return jobs::claims_of(columns_, block.rows.carried, mesh_, job_, block.first);
    }

    void compare() {
        const jobs::RowSource rows = jobs::rows_of_points(source_);
        jobs::Blocks blocks(rows, job_.options.threads, report_.seconds);
        const jobs::Block& first = blocks.first();
        blocks.locate_in(*locator_);
        VerifyOptions options = job_.options;
        options.threads = 1;  // blocks go side by side
        choose_tolerance(first, options);
        const Verifier verifier(*sampler_, options);
        report_.ranges = verifier.ranges();
        report_.relative_to = verifier.relative_to();
        report_.tolerance = options.tolerance;
        report_.exact = options.exact;
        report_.outside_value = options.outside_value;
        report_.verdicts.columns.resize(report_.columns.size());
        const auto work = [&](jobs::Block& block) {
            const Claims claims = claims_of(block);
            block.found =
                verifier.verify({block.rows.points, claims.cells, claims.inside, claims.values, block.first}).value();
        };
        const auto write = [&](const jobs::Block& block) {
            report_.verdicts.add(block.found, job_.options.examples);
            jobs::tell_stage(job_, "rows", block.first + block.size);
        };
        blocks.run(work, write);
        Stopwatch watch;
        Verifier(*sampler_, job_.options).measure(report_.verdicts).value();
        for (const Note& note : source_->notes()) {
            // Which columns are not compared has been told.
            if (note.kind != Note::Kind::left_out) report_.notes.push_back(note);
        }
        note_iteration();
        report_.seconds.sample += watch.lap();
    }

    /// Curved sides and cut digits explain errors of that size as well, and are told.
    void note_iteration() {
        const std::vector<ValueErrors>& columns = report_.verdicts.columns;
        if (mesh_.mid_nodes.empty() || report_.curved.cells != 0 || cut_ || report_.verdicts.wrong_value == 0 ||
            !std::all_of(columns.begin(), columns.end(), may_be_of_iteration))
            return;
        double most = 0;
        for (const ValueErrors& e : columns) most = std::max(most, e.max_relative);
        guess(
            fmt::format("the errors are of the size of an iterative solver's tolerance: the largest is {:.2g} of the "
                        "range, and few are as small as rounding; a tool that finds points in second-order cells by "
                        "iteration leaves such errors (VTK stops at 1e-5); job.tolerance 1e-4 counts them as right",
                        most));
    }

    const VerifyJob& job_;
    Mesh mesh_;
    jobs::ClaimedColumns columns_;
    std::unique_ptr<PointSource> source_;
    std::optional<Locator> locator_;
    std::optional<Sampler> sampler_;
    bool cut_ = false;  ///< values have six digits
    VerifyReport report_;
};

}  // namespace

Result<VerifyReport> verify_files(const VerifyJob& job) try {
    const base::RunFiles run;
    if (job.cell_base != 0 && job.cell_base != 1) refuse("", "job.cell_base", "0 or 1", std::to_string(job.cell_base));
    jobs::check_files(job, {{"job.results", job.results}}, {});
    const jobs::ThreadLimit limit(job.options.threads);
    return Verification(job).run();
} catch (const Exception& e) {
    return e.error();
}

Result<VerifyLimit> parse_verify_limit(std::string_view text) {
    const ExactEnvironment environment;
    const base::NamedLimit limit = base::named_limit(text);
    std::vector<std::string> names;
    for (const RowVerdict kind : kinds_of_wrong) {
        names.emplace_back(handle(kind));
        if (names.back() == limit.name && limit.most && std::floor(*limit.most) == *limit.most && *limit.most <= 0x1p53)
            return VerifyLimit{kind, static_cast<std::uint64_t>(*limit.most)};
    }
    return file_error("", "unknown rule", "missed, invented, wrong_cell or wrong_value, perhaps >COUNT",
                      '"' + std::string(text) + '"', base::did_you_mean(limit.name, names));
}

bool VerifyReport::compared(RowVerdict verdict) const {
    if (verdict == RowVerdict::wrong_cell) return !cell_column.empty();
    return verdict != RowVerdict::wrong_value || !columns.empty();
}

std::vector<VerifyLimit> VerifyReport::exceeded() const {
    std::vector<VerifyLimit> all = limits;
    std::erase_if(all, [&](const VerifyLimit& l) { return verdicts.of(l.verdict) <= l.most; });
    return all;
}

}  // namespace barycert
