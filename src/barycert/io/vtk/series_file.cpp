#include "barycert/io/vtk/series_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "barycert/base/input_file.hpp"
#include "barycert/base/text.hpp"

namespace barycert::io {
namespace {

using Json = nlohmann::json;

/// Read, a file takes some ten times as much memory.
constexpr std::size_t longest_series = std::size_t{64} << 20;

Error wrong(const std::string& path, std::size_t line, const std::string& what, const std::string& expected,
            const std::string& found) {
    return {
        .what = what, .file = path, .line = line, .expected = expected, .found = found, .remedy = "correct the file"};
}

const char* kind_of(const Json& object, const char* member) {
    return object.is_object() && object.contains(member) ? object[member].type_name() : "none";
}

}  // namespace

bool is_series_file(std::string_view bytes) {
    bytes = bytes.substr(0, base::first_block);
    return next_word(bytes).starts_with('{');
}

Result<std::vector<CollectionFile>> series_files(std::string_view bytes, const std::string& path) {
    if (bytes.size() > longest_series)
        return wrong(path, 0, "the series file is too large", "at most " + std::to_string(longest_series) + " bytes",
                     std::to_string(bytes.size()));
    const auto no_json = [&](std::size_t byte) {
        const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(std::min(byte, bytes.size()));
        return wrong(path, 1 + static_cast<std::size_t>(std::count(bytes.begin(), end, '\n')), "the series is no JSON",
                     "a file as ParaView writes it (NAME.vtu.series)", "");
    };
    Json series;
    try {
        series = Json::parse(bytes);
    } catch (const Json::parse_error& error) {
        return no_json(error.byte);
    } catch (const Json::exception&) {  // a number that no double holds
        return wrong(path, 0, "the series", "numbers in the range of double", "a larger one");
    }
    if (!series.is_object() || !series.contains("files") || !series["files"].is_array())
        return wrong(path, 0, "the files of the series", "a member \"files\", an array", kind_of(series, "files"));
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    std::vector<CollectionFile> files;
    for (const Json& entry : series["files"]) {
        const std::string where = "entry " + std::to_string(files.size() + 1) + " of \"files\"";
        if (!entry.is_object() || !entry.contains("name") || !entry["name"].is_string() ||
            entry["name"].get_ref<const std::string&>().empty())
            return wrong(path, 0, where, "a member \"name\", the path of a file", kind_of(entry, "name"));
        if (!entry.contains("time") || !entry["time"].is_number() || !std::isfinite(entry["time"].get<double>()))
            return wrong(path, 0, where, "a member \"time\", a finite number", kind_of(entry, "time"));
        CollectionFile file;
        file.path = (folder / std::filesystem::path(entry["name"].get<std::string>())).string();
        file.time = entry["time"].get<double>();
        files.push_back(std::move(file));
    }
    return files;
}

}  // namespace barycert::io
