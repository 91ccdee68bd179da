#include "barycert/jobs/job_files.hpp"

#include <unistd.h>

#include <set>
#include <string>
#include <utility>

#include "barycert/base/text.hpp"
#include "barycert/io.hpp"
#include "barycert/io/formats.hpp"

namespace barycert::jobs {
namespace {

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

namespace {

Status check_steps(const SamplingJob& job, const std::vector<Step>& steps) {
    std::set<std::string> names;
    for (const std::vector<FieldFile>* const files : {&job.field_files, &job.series}) {
        for (const FieldFile& file : *files) {
            if (names.insert(file.name).second || files == &job.field_files) continue;
            return Error{.what = "a field of this name exists already",
                         .file = file.path,
                         .found = '"' + file.name + '"',
                         .remedy = "give it another name: --field OTHER@" + file.path};
        }
    }
    if (has_step_place(job.output) || steps.size() <= most_steps_of_columns) return Done{};
    return Error{.what = "too many steps for columns of one output",
                 .file = job.output,
                 .expected = "at most " + std::to_string(most_steps_of_columns),
                 .found = std::to_string(steps.size()),
                 .remedy = "write each step to a file of its own: --output 'rows-{step}.npy'"};
}

}  // namespace

Status check_files(const SamplingJob& job, const std::vector<Step>& steps,
                   const std::vector<base::NamedFile>& more_inputs, std::vector<base::NamedFile> outputs) {
    if (!job.weights.empty() && !io::has_suffix(job.weights, ".npz"))
        return Error{.what = "unknown suffix of --weights",
                     .file = job.weights,
                     .expected = ".npz",
                     .remedy = "choose another name"};
    if (Status data = check_vtk_data(job.vtk_data, job.output); !data) return data;
    std::vector<base::NamedFile> to_read = more_inputs;
    // The reader of meshes has hints at what may be meant.
    std::erase_if(to_read, [](const base::NamedFile& f) { return f.what.starts_with("the mesh"); });
    std::vector<base::NamedFile> inputs = base::named_files("the mesh", mesh_files(job.mesh));
    const auto add = [&](const std::string& what, const std::string& path) {
        const std::vector<base::NamedFile> files = input_files(what, path);
        inputs.insert(inputs.end(), files.begin(), files.end());
    };
    for (const FieldFile& f : job.field_files) {
        add("field " + f.name, f.path);
        to_read.push_back({"field " + f.name, f.path});
    }
    for (const FieldFile& f : job.series) add("field " + f.name, f.path);
    for (const base::NamedFile& file : more_inputs) add(file.what, file.path);
    if (!steps.empty()) {
        if (Status few = check_steps(job, steps); !few) return few;
        for (const Step& step : steps) {
            for (const FieldFile& f : step.files) add("field " + f.name, f.path);
        }
        for (base::NamedFile& output : outputs) {
            if (output.what != "--output" || !has_step_place(output.path)) continue;
            if (Status distinct = check_step_outputs(inputs, output.path, steps); !distinct) return distinct;
            output.path = output_of_step(output.path, steps.front());
        }
    }
    outputs.push_back({"--weights", job.weights});
    outputs.push_back({"--json", job.report});
    if (Status readable = base::check_inputs(to_read); !readable) return readable;
    return base::check_outputs(inputs, std::move(outputs));
}

std::vector<base::NamedFile> input_files(const std::string& what, const std::string& path) {
    if (!io::is_vtk_points_file(path)) return {{what, path}};
    return base::named_files(what, vtk_mesh_files(path));
}

Status check_vtk_data(std::optional<VtkData> data, const std::string& path) {
    if (!data) return Done{};
    const bool legacy = io::has_suffix(path, ".vtk");
    if (legacy && *data != VtkData::raw && *data != VtkData::ascii) {
        return Error{.what = "--vtk-data: legacy files of VTK know no compression",
                     .file = path,
                     .expected = "raw or ascii",
                     .found = std::string(name(*data)),
                     .remedy = "name a .vtu file"};
    }
    if (legacy || io::has_suffix(path, ".vtu") || io::has_suffix(path, ".vtp") || io::has_suffix(path, ".vti"))
        return Done{};
    return Error{.what = "--vtk-data is for files of VTK",
                 .file = path,
                 .expected = ".vtu, .vtk, .vtp or .vti",
                 .remedy = "leave it out, or name such a file"};
}

Error unknown_output(const std::string& path, const std::string& expected) {
    const std::size_t dot = path.find_last_of("./");
    const bool suffix = dot != std::string::npos && path[dot] == '.';
    return {.what = "unknown suffix of --output",
            .file = path,
            .expected = expected,
            .found = suffix ? '"' + path.substr(dot) + '"' : "no suffix",
            .remedy = "choose another name"};
}

Status check_rows_format(const std::string& path) {
    if (path == "-" || io::has_suffix(path, ".csv") || io::has_suffix(path, ".npy")) return Done{};
    if (!io::has_suffix(path, ".vtu")) return unknown_output(path, ".csv, .npy or .vtu, or - for CSV on stdout");
    return Done{};
}

Result<std::unique_ptr<TableSink>> open_rows(const SamplingJob& job, const TableFormat& format) {
    if (job.output != "-" || isatty(STDOUT_FILENO) != 1) return open_table(job.output, format);
    TableFormat shown = format;
    for (TableField& field : shown.fields) field.name = base::printable(field.name);
    for (ColumnFormat& column : shown.carried) column.name = base::printable(column.name);
    Result<std::unique_ptr<TableSink>> sink = open_table(job.output, shown);
    if (!sink || shown.carried.empty()) return sink;
    return std::unique_ptr<TableSink>(std::make_unique<PrintableTexts>(std::move(*sink)));
}

}  // namespace barycert::jobs
