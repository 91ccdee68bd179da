#include "barycert/io/vtk/collection.hpp"

#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string_view>

#include "barycert/base/text.hpp"

namespace barycert::io {
namespace {

/// Types of files, the element that holds the names, and the attribute in which they stand.
struct CollectionKind {
    std::string_view type, entry, attribute;
};
constexpr std::array<CollectionKind, 6> collection_kinds{{{"PUnstructuredGrid", "Piece", "Source"},
                                                          {"PPolyData", "Piece", "Source"},
                                                          {"vtkMultiBlockDataSet", "DataSet", "file"},
                                                          {"vtkPartitionedDataSet", "DataSet", "file"},
                                                          {"vtkPartitionedDataSetCollection", "DataSet", "file"},
                                                          {"Collection", "DataSet", "file"}}};

const CollectionKind* kind_of_collection(const XmlTree& tree) {
    if (tree.root().name != "VTKFile") return nullptr;
    const std::string_view type = tree.root().attribute("type").value_or("");
    for (const CollectionKind& kind : collection_kinds) {
        if (type == kind.type && tree.child(tree.root(), type) != nullptr) return &kind;
    }
    return nullptr;
}

}  // namespace

bool is_collection(const XmlTree& tree) {
    return kind_of_collection(tree) != nullptr;
}

bool is_series(const XmlTree& tree) {
    return is_collection(tree) && tree.root().attribute("type") == "Collection";
}

Result<std::vector<CollectionFile>> collection_files(const XmlTree& tree, std::string_view bytes,
                                                     const std::string& path) {
    const CollectionKind& kind = *kind_of_collection(tree);
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    std::vector<CollectionFile> files;
    // All elements of the data set stand behind its own, blocks within blocks in their order.
    for (const XmlElement& element : tree.elements) {
        if (element.name != kind.entry) continue;
        const std::optional<std::string_view> name = element.attribute(kind.attribute);
        if (!name.has_value() || name->empty()) {
            if (kind.type.starts_with("vtk")) continue;  // an empty block
            return Error{.what = "an entry without a file",
                         .file = path,
                         .line = line_of(bytes, element.begin),
                         .expected = "an attribute " + std::string(kind.attribute),
                         .found = "none"};
        }
        CollectionFile file;
        file.path = (folder / std::filesystem::path(*name)).string();
        file.line = line_of(bytes, element.begin);
        file.block = element.attribute("name").value_or("");
        if (kind.type == "Collection") {
            const std::string_view time = element.attribute("timestep").value_or("0");
            const std::optional<double> value = base::parse_double(time);
            if (!value || !std::isfinite(*value)) {
                return Error{.what = "the time of a step",
                             .file = path,
                             .line = line_of(bytes, element.begin),
                             .expected = "a finite number",
                             .found = in_quotes(time)};
            }
            file.time = *value;
        }
        files.push_back(std::move(file));
    }
    return files;
}

std::vector<SeriesStep> steps_of(const std::vector<CollectionFile>& files) {
    std::vector<SeriesStep> steps;
    for (const CollectionFile& file : files) {
        if (steps.empty() || steps.back().time != file.time) steps.push_back({file.time, {}});
        steps.back().files.push_back(file.path);
    }
    return steps;
}

Result<std::size_t> chosen_step(const std::vector<SeriesStep>& steps, const StepChoice& choice,
                                const std::string& path) {
    const std::size_t number = choice.last ? steps.size() - 1 : choice.number.value_or(0);
    const auto error = [&](const std::string& expected, const std::string& found) {
        return Error{.what = "no such step of the series",
                     .file = path,
                     .expected = expected,
                     .found = found,
                     .remedy = "choose one of its steps"};
    };
    if (steps.empty())
        return Error{
            .what = "a series without steps", .file = path, .expected = "a file for each step", .found = "none"};
    if (number >= steps.size())
        return error("a number from 0 to " + std::to_string(steps.size() - 1), std::to_string(number));
    if (!choice.time) return number;
    constexpr std::size_t most_listed = 100;
    std::string times;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (steps[i].time == *choice.time) return i;
        if (i < most_listed) times += (i == 0 ? "" : ", ") + base::shortest(steps[i].time);
    }
    if (steps.size() > most_listed) times += ", ... (" + std::to_string(steps.size()) + " steps)";
    return error("one of the times " + times, base::shortest(*choice.time));
}

Error no_series(const std::string& path) {
    return {.what = "a step is chosen, and this is no series of steps",
            .file = path,
            .expected = "a .pvd, .vtu.series or .vtp.series file",
            .remedy = "leave --step and --time out"};
}

}  // namespace barycert::io
