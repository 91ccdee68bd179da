#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "core/base/text.hpp"
#include "files/child_process.hpp"
#include "files/descriptor.hpp"
#include "files/embedded.hpp"
#include "files/input_file.hpp"
#include "io/converted/converted.hpp"
#include "io/errors.hpp"
#include "io/in_space.hpp"
#include "io/paths.hpp"
#include "io/vtk/raw_grid.hpp"
#include "mesh/cell_types.hpp"

BARYCERT_EMBED(barycert_meshio_script, BARYCERT_MESHIO_SCRIPT);

namespace barycert::io {
namespace {

constexpr std::chrono::seconds most_time{600};
constexpr std::size_t most_text = std::size_t{1} << 18;  // of each stream

/// Returns how the first bytes of a file must look. Formats in HDF5 and NetCDF are told by them.
base::Text beginning_of(const base::InputFile& file, const std::string& path, const std::string& format) {
    std::array<char, 4> magic{};
    const Result<std::size_t> size = file.read_at(0, magic, path);
    const std::string_view head(magic.data(), size ? *size : 0);
    if (head == "\x89HDF" || head.starts_with("CDF") || format == "ugrid") return base::Text::none;
    return format == "ansys" ? base::Text::head : base::Text::all;
}

/// The types of cells that meshio has a name for, in JSON: VTK's numbers by names.
std::string types_by_meshio() {
    nlohmann::json numbers;
    for (const CellType& type : cell_types())
        if (!type.meshio.empty()) numbers[std::string(type.meshio)] = type.number;
    return numbers.dump();
}

struct MeshioFile {
    base::Descriptor descriptor;  ///< of the mesh as a .vtu file without a name
    std::string vtu = {};         ///< its path
    std::string answer = {};      ///< what was read, JSON
    std::string messages = {};    ///< what meshio printed, cut off where it is long
};

/// Has `path` read as what meshio calls `format`, by the Python of BARYCERT_MESHIO, else python3 or /usr/bin/python3.
///
/// The process is started without fork(), in a session of its own, with limits of time, memory and output; it is ended
/// as a whole, also by the end of this process, and leaves no file. Error: no meshio, or none that may be used or ends.
MeshioFile run_meshio(const std::string& path, const std::string& format) {
    const char* const named = std::getenv("BARYCERT_MESHIO");
    if (named != nullptr && *named == '\0')
        refuse_file("tool.missing", path, "this file is read by way of meshio, which BARYCERT_MESHIO turns off", {}, {},
                    "unset BARYCERT_MESHIO, or set it to a Python that has meshio");
    const base::InputFile input = base::InputFile::open(path).value();
    const auto keyword = [&](std::string_view block, std::uint64_t) -> Status {
        if (format != "abaqus" || block.starts_with('*') || block.find("\n*") != std::string_view::npos) return Done{};
        return file_error("file.format", path, "not a mesh of Abaqus",
                          "a keyword, such as *NODE, in the first " + std::to_string(block.size()) + " bytes", "none",
                          "check the path, or write the file again");
    };
    input.check(beginning_of(input, path, format), path, keyword).value();
    std::vector<std::string> pythons{"python3", "/usr/bin/python3"};
    if (named != nullptr) pythons = {named};
    const std::string memory = std::to_string(static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) / 2 *
                                              static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)));
    const bool packed = path.ends_with(".gz");  // formats that name files beside them are not packed
    const std::vector<std::string> arguments{"-c",
                                             barycert_meshio_script,
                                             packed ? "/dev/fd/4" : path,
                                             format,
                                             memory,
                                             memory,
                                             std::to_string(most_time.count()),
                                             types_by_meshio()};
    std::string tried;
    for (const std::string& python : pythons) {
        MeshioFile file{.descriptor = base::Descriptor(::memfd_create("barycert-meshio", MFD_CLOEXEC))};
        if (!file.descriptor) throw Exception(base::read_failure(path, errno));
        file.vtu = "/proc/self/fd/" + std::to_string(file.descriptor.number);
        base::Pipe life, answer, messages;
        const std::array<int, 5> descriptors{life.out.number, answer.in.number, messages.in.number,
                                             file.descriptor.number, input.descriptor()};
        base::ChildProcess process = base::ChildProcess::run(python, arguments, descriptors);
        for (base::Descriptor* const end : {&life.out, &answer.in, &messages.in}) end->close();
        std::array<base::Stream, 2> streams{base::Stream{answer.out.number, {}, most_text},
                                            base::Stream{messages.out.number, {}, most_text}};
        const bool ended = !process || process.listen(streams, most_time);
        const int status = process.end();
        file.answer = std::move(streams[0].text);
        file.messages = std::move(streams[1].text);
        tried += (tried.empty() ? "" : ", ") + python + ": ";
        if (process.failure() != 0) {
            tried += std::strerror(process.failure());
        } else if (file.answer.find("\"missing\"") != std::string::npos) {
            tried += "no such module";
        } else if (!file.answer.empty()) {
            return file;
        } else {
            refuse_file(
                "tool.failed", path, "meshio did not come to its end",
                "an answer within " + std::to_string(most_time.count()) + " s, in half of the memory of this machine",
                !ended                ? "none"
                : WIFSIGNALED(status) ? ::strsignal(WTERMSIG(status))
                                      : "an end without an answer: " + file.messages.substr(0, 500),
                "convert the file to .vtu with the program that it is of");
        }
    }
    refuse_file("tool.missing", path, "this file is read by way of meshio, which is not installed",
                "a Python with the module meshio", tried,
                "install it: `apt install python3-meshio`, or `python3 -m pip install 'meshio[all]'`; "
                "BARYCERT_MESHIO names the Python to use");
}

using Json = nlohmann::json;

Error not_read(const Json& answer, const std::string& messages, const std::string& path, const std::string& format) {
    const std::string module = answer.value("module", Json()).is_string() ? answer["module"].get<std::string>() : "";
    return file_error(
        "tool.failed", path, "meshio " + answer.value("meshio", std::string("?")) + " cannot read the file",
        "what meshio takes for " + format,
        base::printable(answer["error"].get<std::string>() + (messages.empty() ? "" : ": ") + messages.substr(0, 300)),
        module.empty() ? "save it as .vtu or Gmsh's .msh in the program that it is of"
                       : "install the Python module " + module + " beside meshio");
}

/// Returns the script's own error about the file.
Error refused(const Json& by, const std::string& path) {
    const auto text = [&](const char* member) { return by.at(member).get<std::string>(); };
    return file_error("file.unsupported", path, text("what"), text("expected"), text("found"), text("remedy"));
}

/// Checks that the file is complete: compares what meshio counted with what was read. Polygons in space come back as
/// triangles, and are not compared.
void check_complete(const Json& answer, const Mesh& mesh, const InSpace& space, const std::string& path) {
    const auto need = [&](const std::string& what, std::size_t counted, std::size_t read) {
        if (counted != read)
            refuse_file("tool.failed", path, "a mesh that is incomplete after its conversion", {},
                        std::to_string(counted) + " " + what + ", of which " + std::to_string(read) + " came through");
    };
    need("nodes", answer.at("nodes"), mesh.point_count());
    std::size_t cells = 0;
    for (const auto& [type, count] : answer.at("types").items()) {
        if (mesh::cell_type(whole_number<std::uint8_t>(type).value_or(0)).dimension() == mesh.dimension)
            cells += count.get<std::size_t>();
    }
    if (space.facets.empty()) need("cells of dimension " + std::to_string(mesh.dimension), cells, mesh.whole_count());
    for (const bool of_cells : {false, true}) {
        const std::size_t rows = of_cells ? mesh.cell_count() : mesh.point_count();
        const Json& shapes = answer.at("rows").at(of_cells ? "CellData" : "PointData");
        // Others are labels, markers, or told by the reader.
        for (const Field& field : of_cells ? mesh.cell_fields : mesh.point_fields) {
            if (const auto shape = shapes.find(field.name); shape != shapes.end())
                need("values of " + base::quoted(field.name), rows * shape->at(1).get<std::size_t>(),
                     field.data.size());
        }
    }
}

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
        std::string said = "meshio says: " + base::printable(line.substr(0, longest));
        if (line.size() > longest) said += "...";
        notes.push_back({Note::Kind::converted, said, path, true});
    }
}

Mesh checked(const Json& answer, const MeshioFile& file, const std::string& path, const std::string& format,
             InSpace* space) {
    // Opens the files that meshio opened beside this one: this run reads them, too, and what it opens is recorded.
    for (const Json& beside : answer.value("files", Json::array()))
        static_cast<void>(base::InputFile::open(beside.get<std::string>()));
    if (answer.contains("refused")) throw Exception(refused(answer["refused"], path));
    if (answer.contains("error")) throw Exception(not_read(answer, file.messages, path, format));
    Result<Mesh> read = read_vtk_in_space(file.vtu, {}, space);
    if (!read) {
        Error error = read.error();
        // They name the intermediate file.
        for (std::string* part : {&error.what, &error.file, &error.found, &error.remedy}) {
            for (const char* more : {"-", "."}) base::replace_all(*part, file.vtu + more, stem_of(path) + more);
            base::replace_all(*part, file.vtu, path);
        }
        throw Exception(error);
    }
    Mesh& mesh = *read;
    for (Note& note : mesh.notes) base::replace_all(note.file, file.vtu, path);
    check_complete(answer, mesh, space != nullptr ? *space : InSpace(), path);
    Notes notes{{Note::Kind::converted,
                 "by meshio " + answer.at("meshio").get<std::string>() + ", as " + format +
                     "; nodes and cells are in its order",
                 path, true}};
    for (const Json& lost : answer.at("lost"))
        notes.push_back({Note::Kind::left_out, base::printable(lost.get<std::string>()), path});
    tell_messages(file.messages, path, notes);
    mesh.notes.insert(mesh.notes.begin(), notes.begin(), notes.end());
    return std::move(mesh);
}

}  // namespace

Result<Mesh> read_converted(const std::string& path, const std::string& format, InSpace* space) try {
    const MeshioFile file = run_meshio(path, format);
    return checked(Json::parse(file.answer), file, path, format, space);
} catch (const Exception& problem) {
    return problem.error();
} catch (const Json::exception&) {
    return file_error("tool.failed", path, "meshio gave no answer that can be read");
}

std::vector<std::string> converted_files(const std::string& path) {
    std::vector<std::string> files{path};
    std::filesystem::path beside(without_gz(path));
    for (const char* suffix : {".h5", ".bin"}) {
        beside.replace_extension(suffix);
        if (beside != path && exists(beside.string())) files.push_back(beside.string());
    }
    return files;
}

}  // namespace barycert::io
