#include "barycert/io/vtk/collection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "barycert/base/input_file.hpp"
#include "barycert/base/text.hpp"
#include "barycert/io/formats.hpp"

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

/// Discarded where there is none.
const Json& member_of(const Json& object, const char* name) {
    static const Json none(Json::value_t::discarded);
    return object.is_object() && object.contains(name) ? object[name] : none;
}

/// What the root of a .pvtu, .pvtp, .vtm, .vtpd, .vtpc or .pvd names; nothing if it is another. Error: an entry without
/// a file, or a time that is none.
Status name_files(const XmlTree& tree, std::optional<Collection>& named) {
    const std::string_view type = tree.root().attribute("type").value_or("");
    const auto* const kind = std::find_if(collection_kinds.begin(), collection_kinds.end(),
                                          [&](const CollectionKind& known) { return type == known.type; });
    if (tree.root().name != "VTKFile" || kind == collection_kinds.end() || tree.child(&tree.root(), type) == nullptr)
        return Done{};
    Collection& collection = named.emplace(Collection{.is_series = type == "Collection", .files = {}});
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
    return Done{};
}

/// What ParaView's series file (NAME.vtu.series) names: {"files": [{"name": "a.vtu", "time": 0.5}, ...]}. Error: no
/// JSON, a member that is missing or of another kind, a time that is not finite, a file of more than 64 MiB.
Result<Collection> read_series_file(std::string_view bytes, const std::string& path) {
    const auto wrong = [&](const std::string& what, const std::string& expected, const std::string& found,
                           const char* remedy = "correct the file") {
        return file_error(path, what, expected, found, remedy);
    };
    const auto kind = [](const Json& json) { return json.is_discarded() ? "none" : json.type_name(); };
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
    const Json& files = member_of(series, "files");
    if (!files.is_array()) return wrong("the files of the series", "a member \"files\", an array", kind(files));
    Collection collection{.is_series = true, .files = {}};
    std::set<double> times;
    for (const Json& entry : files) {
        const std::string where = "entry " + std::to_string(collection.files.size() + 1) + " of \"files\"";
        const Json &name = member_of(entry, "name"), &time = member_of(entry, "time");
        if (!name.is_string() || name.get_ref<const std::string&>().empty())
            return wrong(where, "a member \"name\", the path of a file", kind(name));
        const double value = time.is_number() ? time.get<double>() : HUGE_VAL;
        if (!std::isfinite(value)) return wrong(where, "a member \"time\", a finite number", kind(time));
        if (!times.insert(value).second)
            return wrong(where, "a time of its own", "that of another entry",
                         "gather the parts of a step in a .pvtu file");
        collection.files.push_back({path_beside(path, name.get_ref<const std::string&>()), {}, value, 0});
    }
    return collection;
}

enum class Kind : std::uint8_t { legacy, xml, series, other };

/// By the first word. A byte order mark is taken off.
Kind kind_of(std::string_view& bytes) {
    if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
    if (bytes.starts_with("# vtk")) return Kind::legacy;
    std::string_view start = bytes.substr(0, base::first_block);
    const std::string_view word = next_word(start);
    return word.starts_with('<') ? Kind::xml : word.starts_with('{') ? Kind::series : Kind::other;
}

Error not_of_vtk(const std::string& path, const char* what = "not a file of VTK") {
    return file_error(path, what, "XML (.vtu, .vtp) or a first line '# vtk DataFile Version ...' (.vtk)", {},
                      "check the path; unpack a compressed file first");
}

}  // namespace

/// The first block has to show that the file is of VTK.
Result<VtkFile> open_vtk(const std::string& path) {
    const auto check = [&](std::string_view block, std::uint64_t) -> Status {
        const Kind kind = kind_of(block);
        if (kind == Kind::legacy) return check_legacy_head(block, path);
        const bool other = kind == Kind::xml ? block.find("<VTKFile") == std::string_view::npos : kind == Kind::other;
        if (other) return not_of_vtk(path);
        // Data may follow as they are.
        const bool text = kind == Kind::xml && block.find("<AppendedData") == std::string_view::npos;
        return base::check_beginning(block, text ? base::Text::all : base::Text::head, path);
    };
    Result<base::MappedFile> mapped = base::MappedFile::open(path, 1, base::Text::head, check);
    if (!mapped) return mapped.error();
    VtkFile file{std::move(*mapped)};
    std::string_view bytes = file.file.bytes();
    const Kind kind = kind_of(bytes);
    if (kind == Kind::other) return bytes.empty() ? not_of_vtk(path, "the file is empty") : not_of_vtk(path);
    if (kind == Kind::legacy) file.legacy = bytes;
    if (kind == Kind::series) {
        Result<Collection> series = read_series_file(bytes, path);
        if (!series) return series.error();
        file.collection = std::move(*series);
    } else if (kind == Kind::xml) {
        Result<XmlTree> tree = parse_xml(bytes, path);
        if (!tree) return tree.error();
        file.tree = std::move(*tree);
        if (Status named = name_files(*file.tree, file.collection); !named) return named.error();
    }
    return file;
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

namespace barycert {

Result<std::vector<SeriesStep>> read_series(const std::string& path) {
    return io::read_guarded(path, [&]() -> Result<std::vector<SeriesStep>> {
        const Result<io::VtkFile> file = io::open_vtk(path);
        if (!file) return file.error();
        if (file->collection && file->collection->is_series) return io::steps_of(file->collection->files);
        const std::string found =
            file->tree ? io::in_quotes(file->tree->root().attribute("type").value_or(file->tree->root().name))
                       : "neither XML nor JSON";
        return Error{"the kind of the file", path, 1,
                     "a VTKFile of type Collection (.pvd), or ParaView's JSON (.vtu.series)", found};
    });
}

std::vector<std::string> vtk_mesh_files(const std::string& path) {
    std::vector<std::string> all{path};
    const std::string suffix = std::filesystem::path(path).extension().string();
    if (suffix == ".vtu" || suffix == ".vtk" || suffix == ".vtp") return all;
    // Names within names; what cannot be read is told by the reader.
    std::set<std::string> known{path};
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Result<io::VtkFile> file = io::open_vtk(all[i]);
        if (!file || !file->collection) continue;
        for (const io::CollectionFile& named : file->collection->files) {
            if (known.insert(named.path).second) all.push_back(named.path);
        }
    }
    return all;
}

}  // namespace barycert
