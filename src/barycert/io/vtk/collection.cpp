#include "barycert/io/vtk/collection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "barycert/base/input_file.hpp"
#include "barycert/base/text.hpp"

namespace barycert::io {
namespace {

using Json = nlohmann::json;

/// Read, a file takes some ten times as much memory.
constexpr std::size_t longest_series = std::size_t{64} << 20;

/// Relative paths are taken from the folder of the collection.
std::string path_beside(const std::string& collection, std::string_view name) {
    return (std::filesystem::path(collection).parent_path() / std::filesystem::path(name)).string();
}

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

const char* kind_of(const Json& object, const char* member) {
    return object.is_object() && object.contains(member) ? object[member].type_name() : "none";
}

}  // namespace

Result<std::optional<Collection>> collection_of(const XmlTree& tree) {
    const std::string_view type = tree.root().attribute("type").value_or("");
    const auto* const kind = std::find_if(collection_kinds.begin(), collection_kinds.end(),
                                          [&](const CollectionKind& known) { return type == known.type; });
    if (tree.root().name != "VTKFile" || kind == collection_kinds.end() || tree.child(tree.root(), type) == nullptr)
        return std::optional<Collection>();
    Collection collection{.is_series = type == "Collection", .files = {}};
    // All elements of the data set stand behind its own, blocks within blocks in their order.
    for (const XmlElement& element : tree.elements) {
        if (element.name != kind->entry) continue;
        const std::string_view name = element.attribute(kind->attribute).value_or("");
        if (name.empty()) {
            if (type.starts_with("vtk")) continue;  // an empty block
            return tree.error(element, "an entry without a file", "an attribute " + std::string(kind->attribute),
                              "none");
        }
        const std::string_view time = collection.is_series ? element.attribute("timestep").value_or("0") : "0";
        const std::optional<double> value = base::parse_double(time);
        if (!value || !std::isfinite(*value))
            return tree.error(element, "the time of a step", "a finite number", in_quotes(time));
        collection.files.push_back({path_beside(tree.path, name), std::string(element.attribute("name").value_or("")),
                                    *value, line_of(tree.bytes, element.begin)});
    }
    return std::optional(std::move(collection));
}

Result<Collection> read_series_file(std::string_view bytes, const std::string& path) {
    const auto wrong = [&](const std::string& what, const std::string& expected, const std::string& found) {
        return file_error(path, what, expected, found, "correct the file");
    };
    if (bytes.size() > longest_series)
        return wrong("the series file is too large", "at most " + std::to_string(longest_series) + " bytes",
                     std::to_string(bytes.size()));
    Json series;
    try {
        series = Json::parse(bytes);
    } catch (const Json::parse_error& error) {
        Error no_json = wrong("the series is no JSON", "a file as ParaView writes it (NAME.vtu.series)", "");
        no_json.line = line_of(bytes, error.byte);
        return no_json;
    } catch (const Json::exception&) {  // a number that no double holds
        return wrong("the series", "numbers in the range of double", "a larger one");
    }
    if (!series.is_object() || !series.contains("files") || !series["files"].is_array())
        return wrong("the files of the series", "a member \"files\", an array", kind_of(series, "files"));
    Collection collection{.is_series = true, .files = {}};
    std::set<double> times;
    for (const Json& entry : series["files"]) {
        const std::string where = "entry " + std::to_string(collection.files.size() + 1) + " of \"files\"";
        if (!entry.is_object() || !entry.contains("name") || !entry["name"].is_string() ||
            entry["name"].get_ref<const std::string&>().empty())
            return wrong(where, "a member \"name\", the path of a file", kind_of(entry, "name"));
        if (!entry.contains("time") || !entry["time"].is_number() || !std::isfinite(entry["time"].get<double>()))
            return wrong(where, "a member \"time\", a finite number", kind_of(entry, "time"));
        if (!times.insert(entry["time"].get<double>()).second) {
            Error twice = wrong(where, "a time of its own", "that of another entry");
            twice.remedy = "gather the parts of a step in a .pvtu file";
            return twice;
        }
        collection.files.push_back(
            {path_beside(path, entry["name"].get_ref<const std::string&>()), {}, entry["time"].get<double>(), 0});
    }
    return collection;
}

std::vector<SeriesStep> steps_of(std::span<const CollectionFile> files) {
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
        return file_error(path, "no such step of the series", expected, found, "choose one of its steps");
    };
    if (steps.empty()) return file_error(path, "a series without steps", "a file for each step", "none");
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
    return file_error(path, "a step is chosen, and this is no series of steps",
                      "a .pvd, .vtu.series or .vtp.series file", {}, "leave --step and --time out");
}

}  // namespace barycert::io
