#include "barycert/io/converted/read_converted.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>

#include "barycert/base/input_file.hpp"
#include "barycert/base/run_files.hpp"
#include "barycert/base/text.hpp"
#include "barycert/io.hpp"
#include "barycert/io/converted/meshio_process.hpp"

namespace barycert::io {
namespace {

using Json = nlohmann::json;

Error not_read(const Json& answer, const std::string& messages, const std::string& path, const std::string& format) {
    const std::string module = answer.value("module", Json()).is_string() ? answer["module"].get<std::string>() : "";
    return {.what = "meshio " + answer.value("meshio", std::string("?")) + " cannot read the file",
            .file = path,
            .expected = "what meshio takes for " + format,
            .found = base::printable(answer["error"].get<std::string>() + (messages.empty() ? "" : ": ") +
                                     messages.substr(0, 300)),
            .remedy = module.empty() ? "save it as .vtu or Gmsh's .msh in the program that it is of"
                                     : "install the Python module " + module + " beside meshio"};
}

/// The text with the path of the file where the intermediate one is named.
void rename_in(std::string& text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

/// Whether the file is complete: what meshio counted, against what was read.
std::string difference(const Json& answer, const Mesh& mesh) {
    const auto differs = [](const std::string& what, std::size_t counted, std::size_t read) {
        return counted == read
                   ? ""
                   : std::to_string(counted) + " " + what + ", of which " + std::to_string(read) + " came through";
    };
    if (std::string text = differs("nodes", answer.at("nodes"), mesh.point_count()); !text.empty()) return text;
    const std::string type = mesh.dimension == 3      ? mesh.mid_nodes.empty() ? "tetra" : "tetra10"
                             : mesh.mid_nodes.empty() ? "triangle"
                                                      : "triangle6";
    if (std::string text =
            differs("cells of type " + type, answer.at("types").value(type, std::size_t{0}), mesh.cell_count());
        !text.empty())
        return text;
    for (const bool of_cells : {false, true}) {
        const std::size_t rows = of_cells ? mesh.cell_count() : mesh.point_count();
        const std::vector<Field>& fields = of_cells ? mesh.cell_fields : mesh.point_fields;
        for (const auto& [name, shape] : answer.at("rows").at(of_cells ? "CellData" : "PointData").items()) {
            const auto field =
                std::find_if(fields.begin(), fields.end(), [&, &n = name](const Field& f) { return f.name == n; });
            // Others are labels, markers, or told by the reader.
            if (field == fields.end()) continue;
            if (std::string text = differs("values of " + base::quoted(name), rows * shape.at(1).get<std::size_t>(),
                                           field->data.size());
                !text.empty())
                return text;
        }
    }
    return {};
}

/// Each line that meshio printed, once.
void tell_messages(const std::string& messages, const std::string& path, Notes& notes) {
    constexpr std::size_t most = 20, longest = 200;
    std::set<std::string_view> told;
    for (std::string_view rest = messages; !rest.empty();) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
        if (line.find_first_not_of(" \r") == std::string_view::npos || !told.insert(line).second) continue;
        if (told.size() > most) {
            notes.push_back({Note::Kind::left_out, "more messages of meshio", path, true});
            return;
        }
        notes.push_back(
            {Note::Kind::converted,
             "meshio says: " + base::printable(line.substr(0, longest)) + (line.size() > longest ? "..." : ""), path,
             true});
    }
}

/// What meshio has opened beside the file is read by this run, too.
void record(const Json& files) {
    for (const Json& file : files) {
        const std::string path = file.get<std::string>();
        if (const Result<base::InputFile> input = base::InputFile::open(path); input)
            base::record_input(input->descriptor(), path);
    }
}

Result<Mesh> checked(const Json& answer, const MeshioFile& file, const std::string& path, const std::string& format) {
    record(answer.value("files", Json::array()));
    if (answer.contains("error")) return not_read(answer, file.messages, path, format);
    Result<Mesh> mesh = read_vtk(file.vtu);
    if (!mesh) {
        Error error = mesh.error();
        for (std::string* part : {&error.what, &error.file, &error.found, &error.remedy})
            rename_in(*part, file.vtu, path);
        return error;
    }
    for (Note& note : mesh->notes) rename_in(note.file, file.vtu, path);
    if (const std::string found = difference(answer, *mesh); !found.empty())
        return Error{.what = "a mesh that is incomplete after its conversion", .file = path, .found = found};
    Notes notes{{Note::Kind::converted,
                 "by meshio " + answer.at("meshio").get<std::string>() + ", as " + format +
                     "; nodes and cells are in its order",
                 path, true}};
    for (const Json& lost : answer.at("lost"))
        notes.push_back({Note::Kind::left_out, base::printable(lost.get<std::string>()), path});
    tell_messages(file.messages, path, notes);
    mesh->notes.insert(mesh->notes.begin(), notes.begin(), notes.end());
    return mesh;
}

}  // namespace

Result<Mesh> read_converted(const std::string& path, const std::string& format) {
    const Result<MeshioFile> file = run_meshio(path, format);
    if (!file) return file.error();
    try {
        return checked(Json::parse(file->answer), *file, path, format);
    } catch (const Json::exception&) {
        return Error{.what = "meshio gave no answer that can be read", .file = path};
    }
}

std::vector<std::string> converted_files(const std::string& path) {
    std::vector<std::string> files{path};
    std::filesystem::path beside(path);
    std::error_code ignored;
    for (const char* suffix : {".h5", ".bin"}) {
        beside.replace_extension(suffix);
        if (beside != path && std::filesystem::exists(beside, ignored)) files.push_back(beside.string());
    }
    return files;
}

}  // namespace barycert::io
