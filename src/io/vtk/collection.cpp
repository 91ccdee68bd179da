#include "io/vtk/collection.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/error_codes.hpp"
#include "barycert/result.hpp"
#include "barycert/series.hpp"
#include "files/input_file.hpp"
#include "io/errors.hpp"
#include "io/number_word.hpp"
#include "io/vtk/raw_grid.hpp"
#include "io/vtk/xml.hpp"
#include "io/words.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::io {
namespace {

using Json = nlohmann::json;

/// Read, a file takes some ten times as much memory.
constexpr std::size_t longest_series = std::size_t{64} << 20;

std::string path_beside(const std::string& collection, std::string_view name) {
    return (std::filesystem::path(collection).parent_path() / std::filesystem::path(name)).string();
}

/// Types of files. Types with pieces (P...) have the names in <Piece Source="...">, the others in <DataSet file="...">.
constexpr std::string_view collection_types =
    "PUnstructuredGrid PPolyData vtkMultiBlockDataSet vtkPartitionedDataSet vtkPartitionedDataSetCollection Collection";

/// Discarded where there is none.
const Json& member_of(const Json& object, const char* name) {
    static const Json none(Json::value_t::discarded);
    return object.is_object() && object.contains(name) ? object[name] : none;
}

/// Returns the files that a root of collection_types names; nothing for another root. Error: an entry without file or
/// time.
std::optional<Collection> files_of(const XmlTree& tree) {
    const std::string_view type = tree.root().attribute_or("type", "");
    if (tree.root().name != "VTKFile" || !has_word(collection_types, type) || tree.child(&tree.root(), type) == nullptr)
        return std::nullopt;
    const bool pieces = type.starts_with('P');
    const std::string_view entry = pieces ? "Piece" : "DataSet", attribute = pieces ? "Source" : "file";
    Collection collection{.is_series = type == "Collection"};
    // All elements of the data set stand behind its own, blocks within blocks in their order.
    for (const XmlElement& element : tree.elements) {
        if (element.name != entry) continue;
        const std::string_view name = element.attribute_or(attribute, "");
        if (name.empty() && type.starts_with("vtk")) continue;  // an empty block
        if (name.empty())
            tree.refuse_at("file.syntax", element, "an entry without a file", "an attribute " + std::string(attribute),
                           "none");
        const std::string_view time = collection.is_series ? element.attribute_or("timestep", "0") : "0";
        const double value = real_of_word(time, true).value_or(HUGE_VAL);
        if (!std::isfinite(value))
            tree.refuse_at("file.number", element, "the time of a step", "a finite number", in_quotes(time));
        collection.files.push_back({path_beside(tree.path, name), std::string(element.attribute_or("name", "")), value,
                                    line_of(tree.bytes, tree.bytes.data() + element.begin)});
    }
    return collection;
}

/// Returns the files that ParaView's series file (NAME.vtu.series) names: {"files": [{"name": "a.vtu", "time": 0.5},
/// ...]}. Error: no JSON, a member that is missing or of another kind, a time that is not finite, a file of more than
/// 64 MiB.
Collection read_series_file(std::string_view bytes, const std::string& path) {
    const auto refuse = [&](ErrorCode code, const std::string& what, const std::string& expected,
                            const std::string& found, std::size_t line = 0) {
        refuse_line(code, path, line, what, expected, found, "correct the file");
    };
    const auto kind = [](const Json& json) { return json.is_discarded() ? "none" : json.type_name(); };
    if (bytes.size() > longest_series)
        refuse("file.too-large", "the series file is too large", "at most " + std::to_string(longest_series) + " bytes",
               std::to_string(bytes.size()));
    Json series;
    try {
        series = Json::parse(bytes);
    } catch (const Json::parse_error& error) {
        refuse("file.syntax", "the series is no JSON", "a file as ParaView writes it (NAME.vtu.series)", "",
               line_of(bytes, bytes.data() + std::min(error.byte, bytes.size())));
    } catch (const Json::exception&) {  // a number that no double holds
        refuse("file.number", "the series", "numbers in the range of double", "a larger one");
    }
    const Json& files = member_of(series, "files");
    if (!files.is_array())
        refuse("file.syntax", "the files of the series", "a member \"files\", an array", kind(files));
    Collection collection{.is_series = true};
    std::set<double> times;
    for (const Json& entry : files) {
        const std::string where = "entry " + std::to_string(collection.files.size() + 1) + " of \"files\"";
        const Json &name = member_of(entry, "name"), &time = member_of(entry, "time");
        if (!name.is_string() || name.get_ref<const std::string&>().empty())
            refuse("file.syntax", where, "a member \"name\", the path of a file", kind(name));
        const double value = time.is_number() ? time.get<double>() : HUGE_VAL;
        if (!std::isfinite(value)) refuse("file.number", where, "a member \"time\", a finite number", kind(time));
        if (!times.insert(value).second)
            refuse_file("file.duplicate", path, where, "a time of its own", "that of another entry",
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

[[noreturn]] void refuse_other(const std::string& path, const char* what) {
    refuse_file("file.format", path, what, "XML (.vtu, .vtp) or a first line '# vtk DataFile Version ...' (.vtk)", {},
                "check the path; unpack a compressed file first");
}

void check_block(std::string_view block, const std::string& path) {
    const Kind kind = kind_of(block);
    if (kind == Kind::legacy) return check_legacy_head(block, path);
    if (kind == Kind::other || (kind == Kind::xml && block.find("<VTKFile") == std::string_view::npos))
        refuse_other(path, "not a file of VTK");
    // Data may follow as they are.
    const bool text = kind == Kind::xml && block.find("<AppendedData") == std::string_view::npos;
    base::check_beginning(block, text ? base::Text::all : base::Text::head, path).value();
}

/// Raw data to which the first block of XML leads are read to where they belong, not twice in memory. False: otherwise.
bool read_beginning(VtkFile& file, const std::string& path) {
    if (file.input->size() <= base::first_block) return false;
    file.file = base::MappedFile::read(*file.input, path, base::first_block).value();
    file.text = file.file.bytes();
    const std::string_view block = file.text.substr(0, base::first_block);
    const std::size_t tag = block.find("<AppendedData"), end = block.find('_', std::min(tag, block.size()));
    if (kind_of(file.text) != Kind::xml || end == std::string_view::npos) return false;
    const Status good = status_of([&] { file.tree = parse_xml(file.text, path); });
    if (!good || !file.tree->appended_raw || file.tree->appended.data() != block.data() + end + 1) return false;
    file.tree->read_part = [input = file.input, begin = block.data(), path](std::string_view part, char* to) {
        const auto at = static_cast<std::uint64_t>(part.data() - begin);
        if (input->read_at(at, {to, part.size()}, path).value() == part.size()) return;
        input->unchanged(path).value();
        refuse_file("file.truncated", path, "the file ends before its size", std::to_string(input->size()) + " bytes",
                    "fewer", cut_off);
    };
    file.collection = files_of(*file.tree);
    return true;
}

}  // namespace

VtkFile open_vtk(const std::string& path) {
    const auto check = [&](std::string_view block, std::uint64_t) {
        return status_of([&] { check_block(block, path); });
    };
    VtkFile file{
        std::make_shared<base::InputFile>(base::InputFile::open(path, base::save_first, base::Text::head).value())};
    file.input->check(base::Text::head, path, check).value();
    if (read_beginning(file, path)) return file;
    const auto size = static_cast<std::size_t>(file.input->size());
    file.file = base::MappedFile::read(*file.input, path, size, base::arena_threads()).value();
    file.text = file.file.bytes();
    const Kind kind = kind_of(file.text);
    if (kind == Kind::other) refuse_other(path, file.text.empty() ? "the file is empty" : "not a file of VTK");
    if (kind == Kind::series) file.collection = read_series_file(file.text, path);
    if (kind == Kind::xml) {
        file.tree = parse_xml(file.text, path);
        file.collection = files_of(*file.tree);
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

}  // namespace barycert::io
