#include <fmt/format.h>

#include <cctype>
#include <filesystem>
#include <initializer_list>

#include "io/formats.hpp"
#include "io/number_word.hpp"
#include "io/words.hpp"

namespace barycert::io {
namespace {

// In the order in which they are looked for. Suffixes of several formats (.dat, .e) stand with the likelier one.
constexpr std::array formats{
    OtherFormat{" .inp ", "a mesh of Abaqus", "", "abaqus"},
    OtherFormat{" .xdmf .xmf ", "an XDMF file", "", "xdmf"},
    OtherFormat{" .med .rmed .mmed ", "a MED file of Salome or Code_Aster", "", "med"},
    OtherFormat{" .cgns ", "a CGNS file", "{paraview}"},
    OtherFormat{" .exo .e .ex2 .exii .g ", "an Exodus file", "", "exodus"},
    OtherFormat{" .vol ", "a mesh of Netgen", "", "netgen"},
    OtherFormat{" .su2 ", "a mesh of SU2", "", "su2"},
    OtherFormat{" .unv .universal ", "a universal file of I-deas",
                "convert it with {gmsh}; it numbers nodes anew, so that values in files of their own do not fit"},
    OtherFormat{" .bdf .nas .fem ", "a file of Nastran", "", "nastran"},
    OtherFormat{" .foam .openfoam ", "a case of OpenFOAM", "{paraview}"},
    OtherFormat{" .xml ", "an XML file, perhaps a mesh of DOLFIN", "", "dolfin-xml"},
    OtherFormat{" .avs .ucd ", "a mesh of AVS", "", "avsucd"},
    OtherFormat{" .ugrid ", "a mesh of UGRID", "", "ugrid"},
    OtherFormat{" .mdpa ", "a mesh of Kratos", "", "mdpa"},
    OtherFormat{" .f3grid ", "a mesh of FLAC3D", "", "flac3d"},
    OtherFormat{" .h5m ", "a mesh of MOAB", "", "h5m"},
    OtherFormat{" .hmf ", "an HMF file", "", "hmf"},
    OtherFormat{" .post .dato ", "a mesh of PERMAS", "", "permas"},
    OtherFormat{" .tec .dat ", "a file of Tecplot", "", "tecplot"},
    OtherFormat{" .cas ", "a case of Fluent", "{paraview}"},
    OtherFormat{" .off .stl .ply .obj ", "a surface, not a mesh",
                "check and sample take surfaces; slices, pictures and all else take meshes: if it is closed, fill it "
                "with `barycert mesh {in}`",
                nullptr, false},
    OtherFormat{" .poly .smesh ", "a PLC, not a mesh", "mesh it first with `barycert mesh {in}`", nullptr, false},
    OtherFormat{" .geo .geo_unrolled .brep .step .stp .iges .igs ", "a geometry, not a mesh",
                "mesh it with `gmsh -3 {in} -format msh41 -o {msh}` (-2 for triangles)", nullptr, false},
    OtherFormat{" .vtkhdf ", "a VTKHDF file", "{paraview}; ParaView 5.11 reads version 1 of the format alone"},
    OtherFormat{" .h5 .hdf5 .hdf ", "an HDF5 file", "if it belongs to an .xdmf file, name that"},
    OtherFormat{" .nc ", "a NetCDF file", "", "exodus"},
    OtherFormat{" .tgz ", "a TAR archive", "unpack it with `tar -xzf {in}`"},
    OtherFormat{" .bz2 ", "a file packed by bzip2", "unpack it with `bzip2 -dc {in} > {unpacked}`"},
    OtherFormat{" .xz ", "a file packed by xz", "unpack it with `xz -dc {in} > {unpacked}`"},
    OtherFormat{" .zst ", "a file packed by zstd", "unpack it with `zstd -dc {in} > {unpacked}`"},
    OtherFormat{" .zip ", "a ZIP archive", "unpack it with `unzip {in}`"},
    OtherFormat{" .tar ", "a TAR archive", "unpack it with `tar -xf {in}`"},
    OtherFormat{" .csv .npy .npz .txt ", "a table, not a mesh",
                "name the mesh first; points go with --points, values with --field NAME=FILE", nullptr, false},
};

const OtherFormat* by_suffix(std::string_view suffix) {
    const auto is_it = [&](const OtherFormat& format) { return has_word(format.suffixes, suffix); };
    const auto* const found = std::ranges::find_if(formats, is_it);
    return found == formats.end() ? nullptr : found;
}

constexpr OtherFormat fluent{"", "a mesh of Fluent", "", "ansys"};
constexpr OtherFormat freefem{"", "a mesh of FreeFem",
                              "make it a file of Medit with {freefem}; a mesh in space with mesh3 and readmesh3"};

constexpr OtherFormat flat_poly{"", "a PLC in the plane, not a mesh",
                                "mesh it with Triangle, whose .node and .ele are read", nullptr, false};

/// A count and the dimension 2.
bool is_flat_poly(std::string_view head) {
    const std::string_view count = first_word(head, '#');
    if (count.empty()) return false;
    const std::string_view rest = head.substr(static_cast<std::size_t>(count.data() + count.size() - head.data()));
    return first_word(rest.substr(0, rest.find('\n')), '#') == "2";
}

/// Three counts on the first line.
bool is_freefem(std::string_view head) {
    const std::vector<std::string_view> words = cut_fields(head.substr(0, head.find('\n')), " \r", "");
    return words.size() == 3 && std::ranges::all_of(words, [](std::string_view word) {
               return word.find_first_not_of("0123456789") == std::string_view::npos;
           });
}

/// The next line that is neither blank nor a comment; taken off.
std::string_view next_line_of(std::string_view& text, std::string_view comment) {
    while (!text.empty()) {
        std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
        if (!line.empty() && !line.starts_with(comment)) return line;
    }
    return {};
}

/// A keyword of Abaqus, behind comments.
bool is_abaqus(std::string_view head) {
    const std::string_view line = next_line_of(head, "**");
    return line.size() > 1 && line[0] == '*' && std::isalpha(static_cast<unsigned char>(line[1])) != 0;
}

/// Five counts, then an integer and three coordinates.
bool is_ucd(std::string_view head) {
    const auto are = [](std::string_view line, std::size_t integers, std::size_t reals) {
        const std::vector<std::string_view> words = cut_fields(line, " \t\r", "");
        if (words.size() != integers + reals) return false;
        for (std::size_t i = 0; i < words.size(); ++i) {
            if (i < integers ? !whole_number<std::uint64_t>(words[i]) : !real_of_word(words[i], true)) return false;
        }
        return true;
    };
    return are(next_line_of(head, "#"), 5, 0) && are(next_line_of(head, "#"), 1, 3);
}

/// HDF5, NetCDF and ZIP hold many formats: which, is told by the suffix, if it is that of one of these, each with one
/// of its suffixes.
const OtherFormat* container(std::string_view path, std::initializer_list<std::string_view> held,
                             std::string_view otherwise) {
    const OtherFormat* const format = other_format_by_suffix(path);
    const bool is_held =
        std::ranges::any_of(held, [&](std::string_view suffix) { return by_suffix(suffix) == format; });
    return is_held ? format : by_suffix(otherwise);
}

using base::shell_word;

/// x.vtu of x.vtu.xz; plain-x.vtu of x.vtu.
std::string unpacked_name(const std::string& path) {
    for (const std::string_view suffix : {".bz2", ".xz", ".zst"}) {
        if (path.ends_with(suffix)) return path.substr(0, path.size() - suffix.size());
    }
    return path.substr(0, path.rfind('/') + 1) + "plain-" + path.substr(path.rfind('/') + 1);
}

/// ParaView's Python, which makes one grid of any data set, in blocks or not.
std::string paraview_command(const std::string& in, const std::string& out,
                             const std::string& grid = "MergeBlocks(OpenDataFile(sys.argv[1]))") {
    return "`pvpython -c 'import sys; from paraview.simple import *; SaveData(sys.argv[2], " + grid + ")' " +
           shell_word(in) + " " + shell_word(out) + "`";
}

/// ParaView tells formats by their suffixes; a case of OpenFOAM has an empty file to name it.
std::string by_paraview(const std::string& path) {
    const std::string stem = stem_of(path);
    if (std::error_code ignored; std::filesystem::is_directory(path, ignored)) {
        const std::string foam = path + "/case.foam";
        return "convert it with `touch " + shell_word(foam) + "` and " +
               paraview_command(foam, path + "/case-grid.vtu");
    }
    if (has_suffix(path, ".vtkhdf"))
        return "convert it with `cp " + shell_word(path) + " " + shell_word(stem + ".hdf") + "` and " +
               paraview_command(stem + ".hdf", stem + "-grid.vtu");
    if (has_one_of(path, {".cgns", ".cas", ".foam", ".openfoam"}))
        return "convert it with " + paraview_command(path, stem + "-grid.vtu");
    return "name the folder of the case";
}

}  // namespace

std::string_view first_word(std::string_view text, char comment) {
    while (true) {
        text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
        if (!text.starts_with(comment)) return text.substr(0, text.find_first_of(" \t\r\n"));
        text.remove_prefix(std::min(text.find('\n'), text.size()));
    }
}

const OtherFormat* other_format_by_suffix(std::string_view path) {
    const std::string suffix = suffix_of(std::string(without_gz(path)));
    return suffix.empty() ? nullptr : by_suffix(lower(suffix));
}

const OtherFormat* packed_format(std::string_view head) {
    using std::string_view_literals::operator""sv;
    for (const auto& [bytes, suffix] : {std::pair("BZh"sv, ".bz2"),
                                        {"\3757zXZ\0"sv, ".xz"},
                                        {"\x28\xb5\x2f\xfd"sv, ".zst"},
                                        {"PK\x03\x04"sv, ".zip"},
                                        {"\x93NUMPY"sv, ".npy"}}) {
        if (head.starts_with(bytes)) return by_suffix(suffix);
    }
    return nullptr;
}

const OtherFormat* other_format_by_content(std::string_view head, std::string_view path, bool strict) {
    if (const OtherFormat* packed = packed_format(head); packed != nullptr) return packed;
    if (head.starts_with("\x89HDF\r\n\x1a\n"))
        return container(path, {".med", ".cgns", ".exo", ".vtkhdf", ".h5m", ".hmf", ".cas"}, ".h5");
    if (head.starts_with("CDF\x01") || head.starts_with("CDF\x02") || head.starts_with("CDF\x05"))
        return container(path, {".exo"}, ".nc");
    const std::string_view text = head.starts_with("\xEF\xBB\xBF") ? head.substr(3) : head;
    if (text.find("<Xdmf") != std::string_view::npos) return by_suffix(".xdmf");
    if (text.find("<dolfin") != std::string_view::npos) return by_suffix(".xml");
    if (text.find("FoamFile") != std::string_view::npos) return by_suffix(".foam");
    if (has_suffix(path, ".poly") && is_flat_poly(text)) return &flat_poly;
    if (text.starts_with("ISO-10303-21")) return by_suffix(".step");
    const bool msh = has_suffix(path, ".msh");
    if (msh && text.starts_with('(')) return &fluent;
    if (msh && is_freefem(text)) return &freefem;
    if (msh && is_abaqus(text)) return by_suffix(".inp");
    if (text.starts_with("ply")) return by_suffix(".ply");
    if (strict) return nullptr;
    const std::string_view word = first_word(text, '%');
    if (word.starts_with("NDIME=")) return by_suffix(".su2");
    if (first_word(text, '#') == "mesh3d") return by_suffix(".vol");
    if (is_abaqus(text)) return by_suffix(".inp");
    if (is_ucd(text)) return by_suffix(".avs");
    if (word == "-1") return by_suffix(".unv");
    if (text.starts_with("OFF") || text.starts_with("solid ")) return by_suffix(".stl");
    if (word == "SOL" || word == "CEND" || word == "BEGIN") return by_suffix(".bdf");
    return nullptr;
}

std::string gmsh_command(const std::string& path) {
    return "`gmsh " + shell_word(path) + " -save -save_all -format msh41 -o " + shell_word(stem_of(path) + "-new.msh") +
           "`";
}

std::string one_grid_command(const std::string& path) {
    return paraview_command(path, stem_of(path) + "-grid.vtu");
}

std::string to_simplices(const std::string& path) {
    return "cut them into simplices with " + paraview_command(path, stem_of(path) + "-simplices.vtu",
                                                              "Tetrahedralize(MergeBlocks(OpenDataFile(sys.argv[1])))");
}

bool in_plane(std::span<const double> points, double z) {
    bool level = true;
    for (std::size_t i = 2; i < points.size(); i += 3) level = level && points[i] == z;
    return level;
}

std::string plane_remedy(std::span<const double> points, const std::string& path) {
    if (const double z = points.size() < 3 ? 0 : points[2]; z != 0 && in_plane(points, z))
        return "the mesh lies in the plane z = " + base::shortest(z) + ": give its nodes z = 0";
    if (path.empty()) return "only what lies in the plane z = 0 is taken";
    const std::string file = stem_of(path) + ".stl", stl = shell_word(file);
    // meshio reads no files of VTK but these two.
    const bool paraview = is_vtk_file(path) && !has_one_of(path, {".vtu", ".vtk"});
    return "a surface in space is no mesh here; if it is closed, fill it: " +
           (paraview ? paraview_command(path, file, "ExtractSurface(MergeBlocks(OpenDataFile(sys.argv[1])))")
                     : "`meshio convert " + shell_word(path) + " " + stl + "`") +
           ", then `barycert mesh " + stl + "`";
}

std::string freefem_command(const std::string& path) {
    const std::string script = "mesh Th = readmesh(\"" + path + "\"); savemesh(Th, \"" + stem_of(path) + ".mesh\");";
    return "`echo " + shell_word(script) + " | FreeFem++ -nw -f /dev/stdin`";
}

Error other_format_error(const OtherFormat& format, const std::string& path) {
    std::string remedy =
        fmt::format(fmt::runtime(format.remedy), fmt::arg("in", shell_word(path)), fmt::arg("gmsh", gmsh_command(path)),
                    fmt::arg("msh", shell_word(stem_of(path) + ".msh")), fmt::arg("freefem", freefem_command(path)),
                    fmt::arg("unpacked", shell_word(unpacked_name(path))), fmt::arg("paraview", by_paraview(path)));
    return file_error("file.format", path,
                      std::string("this is ") + format.what + (format.is_mesh ? ", which is not read" : ""),
                      formats_read, {}, std::move(remedy));
}

}  // namespace barycert::io
