// VTK's files of every kind, those that name files among them: partitioned data sets, blocks and series.
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
#include <system_error>
#include <utility>
#include <vector>

#include "barycert/error_codes.hpp"
#include "barycert/mesh.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/result.hpp"
#include "barycert/series.hpp"
#include "barycert/table.hpp"
#include "barycert/vtk_files.hpp"
#include "core/base/text.hpp"
#include "files/format.hpp"
#include "files/input_file.hpp"
#include "io/formats.hpp"
#include "io/number_word.hpp"
#include "io/streams.hpp"
#include "io/vtk/numbers.hpp"
#include "io/vtk/raw_grid.hpp"
#include "io/vtk/xml.hpp"
#include "io/words.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert::io {
namespace {

struct CollectionFile {
    std::string path;      ///< as it can be opened: relative ones are taken from the folder of the collection
    std::string block;     ///< its name, where it has one
    double time = 0;       ///< of a series
    std::size_t line = 0;  ///< where it is named; 0: not known
};

struct Collection {
    bool is_series = false;                  ///< of steps in time
    std::vector<CollectionFile> files = {};  ///< in their order
};

struct VtkFile {
    std::shared_ptr<const base::InputFile> input;
    base::MappedFile file = {};
    std::string_view text = {};                 ///< all of it but for a byte order mark
    std::optional<XmlTree> tree = {};           ///< of XML; without one and names it is a legacy file
    std::optional<Collection> collection = {};  ///< the files that it names
};

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

/// By the first word. Throws an Exception: a file that is not of VTK, or names none where it should.
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

/// Consecutive files of one time are one step.
std::vector<SeriesStep> steps_of(std::span<const CollectionFile> files) {
    std::vector<SeriesStep> steps;
    for (const CollectionFile& file : files) {
        if (steps.empty() || steps.back().time != file.time) steps.push_back({file.time, {}});
        steps.back().files.push_back(file.path);
    }
    return steps;
}

/// Kind of blocks that make the mesh: unstructured grids; where there are none, structured ones; else polygons.
enum class GridKind : std::uint8_t { unstructured, structured, polygons };

bool is_structured(FormatKind kind) {
    return kind == FormatKind::vti || kind == FormatKind::vtr || kind == FormatKind::vts;
}

GridKind kind_of_block(const std::string& path) {
    const FormatKind kind = base::kind_of(path);
    if (kind == FormatKind::vtp || kind == FormatKind::pvtp) return GridKind::polygons;
    return is_structured(kind) ? GridKind::structured : GridKind::unstructured;
}

/// Chooses the kind by the files, or those that they name.
GridKind blocks_of_mesh(std::span<const CollectionFile> files) {
    GridKind kind = GridKind::polygons;
    for (const CollectionFile& file : files) {
        for (const std::string& own : vtk_mesh_files(file.path)) {
            const FormatKind of_file = base::kind_of(own);
            if (of_file == FormatKind::vtu || of_file == FormatKind::vtk || is_structured(of_file))
                kind = std::min(kind, kind_of_block(own));
        }
    }
    return kind;
}

/// Kinds that are not read: pieces of structured grids, trees, hypertrees.
bool is_unread(const std::string& path) {
    return has_one_of(path, {".pvti", ".pvtr", ".pvts", ".vtt", ".vth"});
}

/// Reads files, and files that these name, each once. Errors are thrown as Exceptions.
class GridReader {
public:
    explicit GridReader(Wanted part, const StepChoice& step = {}) : part_(part), step_(step) {}

    /// `depth`: of the files that name it.
    RawGrid read(const std::string& path, int depth = 0) {
        constexpr int deepest = 16;
        if (depth == deepest)
            refuse_file("file.unsupported", path, "files that name files too deeply",
                        "at most " + std::to_string(deepest) + " of them one in the other", "more");
        std::error_code ignored;
        if (!seen_.insert(std::filesystem::weakly_canonical(path, ignored).string()).second)
            refuse_file("file.duplicate", path, "a file that is named twice in a collection of files",
                        "every piece once", {}, "correct the file that names it");
        VtkFile file = open_vtk(path);
        if (const auto& named = file.collection; named)
            return named->is_series ? read_step(named->files, path, depth) : read_all(named->files, path, depth);
        RawGrid grid = file.tree ? read_xml(*std::move(file.tree), part_) : read_legacy(file.text, path, part_);
        file.input->unchanged(path).value();
        return grid;
    }

    bool step_left() const { return step_.made(); }

private:
    RawGrid read_all(std::span<const CollectionFile> files, const std::string& path, int depth) {
        RawGrid grid;
        std::vector<std::string> others;
        if (!blocks_) blocks_ = blocks_of_mesh(files);
        for (const CollectionFile& file : files) {
            if (part_ == Wanted::all && (is_unread(file.path) || kind_of_block(file.path) > *blocks_)) {
                others.push_back(file.block.empty() ? file.path : file.block + " (" + file.path + ")");
                continue;
            }
            std::error_code unknown;
            if (std::filesystem::status(file.path, unknown).type() == std::filesystem::file_type::not_found)
                refuse_line("file.missing", path, file.line, "a file that is named here is missing", file.path,
                            "no such file", "put it there, or correct the name");
            append_piece(grid, read(file.path, depth + 1), path);
        }
        const std::string left_out = std::to_string(others.size()) + " blocks beside those with the mesh: ";
        if (!others.empty()) grid.notes.push_back({Note::Kind::left_out, left_out + list_of(others), path, true});
        if (part_ == Wanted::all) join_pieces(grid, path);
        return grid;
    }

    /// The step that is chosen; of a series within a series the first.
    RawGrid read_step(std::span<const CollectionFile> files, const std::string& path, int depth) {
        const std::vector<SeriesStep> steps = steps_of(files);
        const StepChoice choice = std::exchange(step_, {});
        const std::size_t number = chosen_step(steps, choice, path).value();
        std::size_t begin = 0;
        for (std::size_t i = 0; i < number; ++i) begin += steps[i].files.size();
        RawGrid grid = read_all(files.subspan(begin, steps[number].files.size()), path, depth);
        // Who names a number knows what is read.
        if (steps.size() == 1 || choice.number) return grid;
        const std::string which = number == 0 ? "the first" : "number " + std::to_string(number),
                          others = "all steps but " + which + " of a series of " + std::to_string(steps.size()),
                          time = base::shortest(steps[number].time);
        grid.notes.push_back({Note::Kind::left_out, others + ": read is the time " + time, path, !choice.made()});
        return grid;
    }

    Wanted part_;
    StepChoice step_;  ///< not yet made use of
    std::optional<GridKind> blocks_;
    std::set<std::string> seen_;
};

/// `arrays`: too, of these names or all. `labels`: such are integers of one component; points not finite have a remedy.
Result<PointTable> read_table(const std::string& path, int dimension, bool arrays,
                              const std::vector<std::string>* names, bool labels, bool finite) {
    return read_guarded(path, [&]() -> Result<PointTable> {
        RawGrid grid = GridReader(arrays ? Wanted::point_arrays : Wanted::points).read(path);
        PointTable table;
        table.dimension = dimension;
        table.notes = std::move(grid.notes);
        table.unread = std::move(grid.unread_arrays);
        try {
            table.points = finite ? to_points(std::move(grid.points), dimension, path) : std::move(grid.points);
        } catch (const Exception& problem) {
            Error error = problem.error();
            if (labels) error = about(nonfinite_points, std::move(error)), error.remedy += or_nan_for_it;
            return error;
        }
        if (names != nullptr)
            std::erase_if(grid.point_arrays, [&](auto& array) { return std::ranges::count(*names, array.name) == 0; });
        for (RawArray& array : grid.point_arrays) {
            if (labels && array.type < NumberType::float32 && array.components == 1) array.make_labels();
        }
        take_fields(grid.point_arrays, "point array", path, table.fields, &table.labels, table.notes);
        note_narrow_points(grid, path, table.notes);
        return table;
    });
}

}  // namespace

Result<std::size_t> chosen_step(const std::vector<SeriesStep>& steps, const StepChoice& choice,
                                const std::string& path) {
    const std::size_t number = choice.last ? steps.size() - 1 : choice.number.value_or(0);
    const auto error = [&](const std::string& expected, const std::string& found) {
        return file_error("series.step", path, "no such step of the series", expected, found,
                          "choose one of its steps");
    };
    if (steps.empty()) return file_error("series.step", path, "a series without steps", "a file for each step", "none");
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
    return file_error("series.none", path, "a step is chosen, and this is no series of steps",
                      "one of " + base::suffix_list_read(base::Use::steps), {}, "leave --step and --time out");
}

}  // namespace barycert::io

namespace barycert {

Result<std::vector<SeriesStep>> read_series(const std::string& path) {
    return io::read_guarded(path, [&]() -> Result<std::vector<SeriesStep>> {
        const io::VtkFile file = io::open_vtk(path);
        if (file.collection && file.collection->is_series) return io::steps_of(file.collection->files);
        io::refuse_line("file.format", path, 1, "the kind of the file",
                        "a VTKFile of type Collection (.pvd), or ParaView's JSON (.vtu.series)",
                        file.tree ? io::in_quotes(file.tree->root().attribute_or("type", file.tree->root().name))
                                  : "neither XML nor JSON");
    });
}

std::vector<std::string> vtk_mesh_files(const std::string& path) {
    std::vector<std::string> all{path};
    const base::FormatKind kind = base::kind_of(path);
    if (base::is_vtk(kind) && kind <= base::FormatKind::vts) return all;  // the kinds that name no other files
    std::set<std::string> known{path};
    for (std::size_t i = 0; i < all.size(); ++i) {
        std::optional<io::Collection> named;
        // Names within names; what cannot be read is told by the reader.
        static_cast<void>(io::status_of([&] { named = io::open_vtk(all[i]).collection; }));
        for (const io::CollectionFile& one : named.value_or(io::Collection()).files) {
            if (known.insert(one.path).second) all.push_back(one.path);
        }
    }
    return all;
}

Result<io::PointTable> io::read_vtk_table(const std::string& path, bool arrays, NonfinitePoints nonfinite) {
    // A legacy file has no list of its arrays.
    return read_table(path, 3, arrays || base::kind_of(path) == FormatKind::vtk, nullptr, true,
                      nonfinite == NonfinitePoints::error);
}

Result<Mesh> io::read_vtk_in_space(const std::string& path, const ReadOptions& options, InSpace* space) {
    return read_guarded(path, [&]() -> Result<Mesh> {
        GridReader reader(Wanted::all, options.step);
        RawGrid grid = reader.read(path);
        if (reader.step_left()) return no_series(path);
        return to_mesh(std::move(grid), path, space, options.list_grids);
    });
}

Result<Mesh> read_vtk(const std::string& path, const StepChoice& step) {
    return io::read_vtk_in_space(path, {.step = step}, nullptr);
}

Result<std::vector<double>> read_vtk_points(const std::string& path, int dimension) {
    Result<PointData> data = read_vtk_point_data(path, dimension, std::vector<std::string>());
    if (!data) return data.error();
    return std::move(data->points);
}

Result<PointData> read_vtk_point_data(const std::string& path, int dimension,
                                      const std::optional<std::vector<std::string>>& names) {
    if (dimension != 2 && dimension != 3)
        return file_error("point.dimension", path, "the dimension of points", "2 or 3", std::to_string(dimension));
    Result<io::PointTable> table =
        io::read_table(path, dimension, !names || !names->empty(), names ? &*names : nullptr, false, true);
    if (!table) return table.error();
    return static_cast<PointData&&>(*table);
}

}  // namespace barycert
