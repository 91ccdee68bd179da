#include "barycert/io/other_formats.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include "barycert/base/shell_word.hpp"
#include "barycert/io/formats.hpp"

namespace barycert::io {
namespace {

constexpr const char* foam_remedy =
    "open it in ParaView (touch case.foam in the folder of the case), apply Merge Blocks and Tetrahedralize, and save "
    "it as .vtu";

// In the order in which they are looked for. Suffixes of several formats (.dat, .e) stand with the likelier one.
constexpr std::array formats{
    OtherFormat{" .mesh .meshb ", "a mesh of Medit", Way::gmsh, ""},
    OtherFormat{" .inp ", "a mesh of Abaqus", Way::meshio, ""},
    OtherFormat{" .xdmf .xmf ", "an XDMF file", Way::meshio, ""},
    OtherFormat{" .med .rmed .mmed ", "a MED file of Salome or Code_Aster", Way::meshio, ""},
    OtherFormat{" .cgns ", "a CGNS file", Way::pyvista, ""},
    OtherFormat{" .exo .e .ex2 .exii .g ", "an Exodus file", Way::meshio, ""},
    OtherFormat{" .vol ", "a mesh of Netgen", Way::meshio, ""},
    OtherFormat{" .su2 ", "a mesh of SU2", Way::meshio, ""},
    OtherFormat{" .unv .universal ", "a universal file of I-deas", Way::gmsh, ""},
    OtherFormat{" .bdf .nas .fem ", "a file of Nastran", Way::gmsh_or_meshio, ""},
    OtherFormat{" .foam .openfoam ", "a case of OpenFOAM", Way::other, foam_remedy},
    OtherFormat{" .xml ", "an XML file, perhaps a mesh of DOLFIN", Way::meshio, ""},
    OtherFormat{" .avs .ugrid .mdpa .f3grid .h5m .hmf .post .dato .tec .dat ", "a mesh of another program", Way::meshio,
                ""},
    OtherFormat{" .cas ", "a case of Fluent", Way::pyvista, ""},
    OtherFormat{" .off .stl .ply .poly .smesh ", "a PLC (a surface), not a mesh", Way::surface, ""},
    OtherFormat{" .obj ", "a surface, not a mesh", Way::other,
                "convert it with `meshio convert IN.obj OUT.stl`, then mesh it with `barycert mesh OUT.stl`"},
    OtherFormat{" .geo .geo_unrolled .brep .step .stp .iges .igs ", "a geometry, not a mesh", Way::mesher, ""},
    OtherFormat{" .vtkhdf ", "a VTKHDF file", Way::pyvista, ""},
    OtherFormat{" .h5 .hdf5 .hdf ", "an HDF5 file", Way::other,
                "if it belongs to an .xdmf file, convert that: `meshio convert IN.xdmf OUT.vtu`"},
    OtherFormat{" .nc ", "a NetCDF file", Way::meshio, ""},
    OtherFormat{" .gz .tgz ", "a file packed by gzip", Way::unpack, "gunzip -k"},
    OtherFormat{" .bz2 ", "a file packed by bzip2", Way::unpack, "bunzip2 -k"},
    OtherFormat{" .xz ", "a file packed by xz", Way::unpack, "unxz -k"},
    OtherFormat{" .zst ", "a file packed by zstd", Way::unpack, "unzstd"},
    OtherFormat{" .zip ", "a ZIP archive", Way::unpack, "unzip"},
    OtherFormat{" .tar ", "a TAR archive", Way::unpack, "tar -xf"},
    OtherFormat{" .csv .npy .npz .txt ", "a table, not a mesh", Way::other,
                "name the mesh first; points go with --points, values with --field NAME=FILE"},
};

const OtherFormat* by_suffix(std::string_view suffix) {
    const std::string word = " " + std::string(suffix) + " ";
    for (const OtherFormat& format : formats) {
        if (format.suffixes.find(word) != std::string_view::npos) return &format;
    }
    return nullptr;
}

constexpr OtherFormat fluent{"", "a mesh of Fluent", Way::other,
                             "convert it with `meshio convert --input-format ansys IN.msh OUT.vtu`, and name OUT.vtu"};
constexpr OtherFormat freefem{"", "a mesh of FreeFem", Way::other,
                              "in FreeFem, write it with savevtk(\"OUT.vtu\", Th), and name OUT.vtu"};

/// The first word of the text that is no comment.
std::string_view first_word(std::string_view text, char comment) {
    while (true) {
        const std::size_t at = text.find_first_not_of(" \t\r\n");
        if (at == std::string_view::npos) return {};
        text.remove_prefix(at);
        if (text.front() != comment) return text.substr(0, text.find_first_of(" \t\r\n"));
        const std::size_t feed = text.find('\n');
        if (feed == std::string_view::npos) return {};
        text.remove_prefix(feed);
    }
}

std::string lower(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(),
                   [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
    return out;
}

/// Three counts on the first line.
bool is_freefem(std::string_view head) {
    const std::string_view line = head.substr(0, head.find('\n'));
    std::size_t words = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == ' ' || line[i] == '\r') continue;
        if (std::isdigit(static_cast<unsigned char>(line[i])) == 0) return false;
        if (i == 0 || line[i - 1] == ' ') ++words;
    }
    return words == 3;
}

/// HDF5, NetCDF and ZIP hold many formats: which, is told by the suffix, if that is one of these.
const OtherFormat* container(std::string_view path, std::string_view suffixes, std::string_view otherwise) {
    const OtherFormat* const format = other_format_by_suffix(path);
    if (format != nullptr && suffixes.find(std::string(" ") + format->what) != std::string_view::npos) return format;
    return by_suffix(otherwise);
}

using base::shell_word;

}  // namespace

const OtherFormat* other_format_by_suffix(std::string_view path) {
    const std::size_t dot = path.find_last_of("./");
    if (dot == std::string_view::npos || path[dot] == '/') return nullptr;
    return by_suffix(lower(path.substr(dot)));
}

const OtherFormat* packed_format(std::string_view head) {
    using std::string_view_literals::operator""sv;
    struct Magic {
        std::string_view bytes, suffix;
    };
    constexpr std::array magics{Magic{"\x1f\x8b"sv, ".gz"},
                                Magic{"BZh"sv, ".bz2"},
                                Magic{"\xfd"
                                      "7zXZ\0"sv,
                                      ".xz"},
                                Magic{"\x28\xb5\x2f\xfd"sv, ".zst"},
                                Magic{"PK\x03\x04"sv, ".zip"},
                                Magic{"\x93NUMPY"sv, ".npy"}};
    for (const Magic& magic : magics) {
        if (head.starts_with(magic.bytes)) return by_suffix(magic.suffix);
    }
    return nullptr;
}

const OtherFormat* other_format_by_content(std::string_view head, std::string_view path, bool strict) {
    if (const OtherFormat* packed = packed_format(head); packed != nullptr) return packed;
    constexpr std::string_view in_hdf5 =
        " a MED file of Salome or Code_Aster; a CGNS file; an Exodus file; a VTKHDF file; a mesh of another program; a "
        "case of Fluent;";
    if (head.starts_with("\x89HDF\r\n\x1a\n")) return container(path, in_hdf5, ".h5");
    if (head.starts_with("CDF\x01") || head.starts_with("CDF\x02") || head.starts_with("CDF\x05"))
        return container(path, " an Exodus file;", ".nc");
    const std::string_view text = head.starts_with("\xEF\xBB\xBF") ? head.substr(3) : head;
    if (first_word(text, '#') == "MeshVersionFormatted" || first_word(text, '#') == "MeshVersionUnformatted")
        return by_suffix(".mesh");
    if (text.find("<Xdmf") != std::string_view::npos) return by_suffix(".xdmf");
    if (text.find("<dolfin") != std::string_view::npos) return by_suffix(".xml");
    if (text.find("FoamFile") != std::string_view::npos) return by_suffix(".foam");
    if (text.starts_with("ISO-10303-21")) return by_suffix(".step");
    const bool msh = has_suffix(path, ".msh");
    if (msh && text.starts_with('(')) return &fluent;
    if (msh && is_freefem(text)) return &freefem;
    if (strict) return nullptr;
    const std::string_view word = first_word(text, '%');
    if (word.starts_with("NDIME=")) return by_suffix(".su2");
    if (first_word(text, '#') == "mesh3d") return by_suffix(".vol");
    if (lower(word).starts_with("*heading") || lower(word).starts_with("*node")) return by_suffix(".inp");
    if (word == "-1") return by_suffix(".unv");
    if (text.starts_with("OFF") || text.starts_with("solid ")) return by_suffix(".stl");
    if (text.starts_with("ply")) return by_suffix(".ply");
    if (word == "SOL" || word == "CEND" || word == "BEGIN") return by_suffix(".bdf");
    return nullptr;
}

std::string gmsh_command(const std::string& path, const std::string& more) {
    const std::size_t dot = path.find_last_of("./");
    const std::string stem = dot != std::string::npos && path[dot] == '.' ? path.substr(0, dot) : path;
    return "`gmsh " + shell_word(path) + more + " -save -format msh41 -o " + shell_word(stem + "-new.msh") + "`";
}

Error other_format_error(const OtherFormat& format, const std::string& path) {
    const std::size_t dot = path.find_last_of("./");
    const std::string stem = dot != std::string::npos && path[dot] == '.' ? path.substr(0, dot) : path;
    const std::string in = shell_word(path);
    std::string remedy;
    switch (format.way) {
        case Way::meshio:
            remedy = "convert it with `meshio convert " + in + " " + shell_word(stem + ".vtu") + "`";
            break;
        case Way::gmsh:
            remedy = "convert it with `gmsh " + in + " -save -format msh41 -o " + shell_word(stem + ".msh") + "`";
            break;
        case Way::gmsh_or_meshio:
            remedy = "convert it with `gmsh " + in + " -save -format msh41 -o " + shell_word(stem + ".msh") +
                     "`, or, if it has lines GRID*, with `meshio convert " + in + " " + shell_word(stem + ".vtu") + "`";
            break;
        case Way::mesher:
            remedy = "mesh it with `gmsh -3 " + in + " -format msh41 -o " + shell_word(stem + ".msh") +
                     "` (-2 for triangles)";
            break;
        case Way::surface:
            remedy = "mesh it first with `barycert mesh " + in + "`";
            break;
        case Way::pyvista:
            remedy = "convert it with `python3 -c \"import pyvista; pyvista.read('" + path +
                     "').combine().triangulate().save('" + stem + ".vtu')\"`, or in ParaView";
            break;
        case Way::unpack:
            remedy = std::string("unpack it with `") + format.remedy + " " + in + "`";
            break;
        case Way::other:
            remedy = format.remedy;
            break;
    }
    const bool mesh = std::string_view(format.what).find("not a mesh") == std::string_view::npos;
    return {.what = std::string("this is ") + format.what + (mesh ? ", which is not read" : ""),
            .file = path,
            .expected = formats_read,
            .remedy = std::move(remedy)};
}

}  // namespace barycert::io
