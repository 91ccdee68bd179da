#include "barycert/jobs/cell_labels.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "barycert/base/text.hpp"
#include "barycert/mesh/columns.hpp"
#include "barycert/sample/quantity/expression.hpp"

namespace barycert::jobs {
namespace {

constexpr std::string_view prefix = "cell:";

const Column* label_named(const Mesh& mesh, std::string_view name) {
    for (const std::string& full : {std::string(name), std::string(prefix) + std::string(name)}) {
        if (sample::field_named(mesh.point_fields, full) != nullptr ||
            sample::field_named(mesh.cell_fields, full) != nullptr)
            return nullptr;
    }
    for (int part = 0; part < 2; ++part) {
        for (const Column& label : mesh.cell_labels) {
            if (label.name == name || label.name == std::string(prefix) + std::string(name)) return &label;
        }
        if (!name.starts_with(prefix)) break;
        name.remove_prefix(prefix.size());
    }
    return nullptr;
}

Status check_label(const Mesh& mesh, const Column& label) {
    if (label.size() != mesh.cell_count())
        return Error{.what = "a label of cells does not fit the mesh",
                     .expected = std::to_string(mesh.cell_count()) + " values",
                     .found = std::to_string(label.size()) + " of " + base::quoted(label.name)};
    const auto* const integers = std::get_if<std::vector<std::int64_t>>(&label.values);
    if (integers != nullptr && std::find(integers->begin(), integers->end(), mesh::no_label) != integers->end())
        return Error{.what = "a label of cells has the integer that stands for points outside",
                     .expected = "integers above " + std::to_string(mesh::no_label),
                     .found = base::quoted(label.name),
                     .remedy = "leave it out of job.fields"};
    return Done{};
}

}  // namespace

Result<std::vector<const Column*>> take_labels(const Mesh& mesh, std::vector<std::string>& names) {
    std::vector<const Column*> taken;
    if (mesh.cell_labels.empty()) return taken;
    std::vector<std::string> rest;
    for (const std::string& text : names) {
        if (const Column* const label = label_named(mesh, text)) {
            taken.push_back(label);
            continue;
        }
        std::string others;
        std::size_t begin = 0, labels = 0;
        for (bool more = true; more;) {
            const std::size_t comma = text.find(',', begin);
            const std::string part = text.substr(begin, comma - begin);
            more = comma != std::string::npos;
            begin = comma + 1;
            if (const Column* const label = label_named(mesh, part)) {
                taken.push_back(label);
                ++labels;
            } else {
                others += (others.empty() ? "" : ",") + part;
            }
        }
        if (labels == 0) others = text;
        if (labels == 0 || !others.empty()) rest.push_back(std::move(others));
    }
    for (std::size_t i = 0; i < taken.size(); ++i) {
        if (std::find(taken.begin(), taken.begin() + static_cast<std::ptrdiff_t>(i), taken[i]) !=
            taken.begin() + static_cast<std::ptrdiff_t>(i))
            return Error{.what = "a label of cells is named twice",
                         .found = base::quoted(taken[i]->name),
                         .remedy = "name it once in job.fields"};
        if (Status fits = check_label(mesh, *taken[i]); !fits) return fits.error();
    }
    names = std::move(rest);
    return taken;
}

void note_labels(const Mesh& mesh, const std::vector<std::string>& names, Notes& notes) {
    if (mesh.cell_labels.empty() || !names.empty()) return;
    std::string text = mesh.cell_labels.size() == 1 ? "label of cells " : "labels of cells ";
    for (std::size_t i = 0; i < mesh.cell_labels.size(); ++i) text += (i == 0 ? "" : ", ") + mesh.cell_labels[i].name;
    notes.push_back({Note::Kind::left_out, text + "; name fields and labels in job.fields to have them"});
}

}  // namespace barycert::jobs
