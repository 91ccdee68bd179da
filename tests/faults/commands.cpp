#include "commands.hpp"

#include <cctype>
#include <filesystem>

#include <gtest/gtest.h>

namespace barycert::faults {
namespace {

using cli_test::mesh;

std::string data(const std::string& name) {
    return std::string(BARYCERT_DATA_DIR) + "/" + name;
}

/// A run that nothing disturbs.
void made(const test::Scratch& folder, const Words& arguments) {
    const auto r = cli_test::run(arguments, {.folder = folder.folder()});
    EXPECT_LE(r.code, 1) << r.err;
}

}  // namespace

void put_inputs(const test::Scratch& folder) {
    std::string points = "x,y,z\n";
    for (int i = 0; i < 40; ++i)
        points +=
            std::to_string(i * 0.031) + "," + std::to_string(i % 7 * 0.15) + "," + std::to_string(i % 5 * 0.2) + "\n";
    folder.put("p.csv", points);
    made(folder, {"sample", mesh("cube-hole"), "--points", "p.csv", "--output", "p.npy", "--save-map", "map"});
    made(folder, {"sample", mesh("cube-hole"), "--points", "p.csv", "--rounding", "plain", "--output", "results.csv"});
    made(folder,
         {"audit", "--count", "20", "--kernel", "tetrahedron.cramer", "--witnesses", "w.json", "--json", "b.json"});
    made(folder, {"render", "gradient", "--output", "texture.png"});
}

const std::vector<Command>& commands() {
    const std::string cube = mesh("cube-hole");
    static const std::vector<Command> all{
        {"audit",
         {"audit", "--count", "10", "--kernel", "tetrahedron.cramer", "--kernel", "tetrahedron.kahan", "--json",
          "a.json", "--html", "a.html", "--witnesses", "aw.json"}},
        {"audit_baseline", {"audit", "--count", "20", "--kernel", "tetrahedron.cramer", "--baseline", "b.json"}},
        {"audit_library", {"audit", "--count", "10", "--kernel-library", BARYCERT_USER_KERNEL, "--json", "a.json"}},
        {"gaps", {"gaps", mesh("plate"), "--count", "200", "--json", "g.json"}},
        {"check", {"check", cube, "--json", "c.json", "--html", "c.html", "--fix-orientation", "fixed"}},
        {"check_vtu", {"check", data("vtk/bracket.vtu"), "--fix-orientation", "fixed.vtu"}},
        {"check_msh", {"check", data("gmsh/halves.msh"), "--quiet", "--html", "c.html", "--sarif", "c.sarif"}},
        {"sample_csv", {"sample", cube, "--points", "p.csv", "--output", "o.csv", "--save-map", "m"}},
        {"sample_stdout", {"sample", cube, "--points", "p.csv", "--output", "-"}},
        {"sample_npy", {"sample", cube, "--points", "p.npy", "--output", "o.npy", "--json", "o.json"}},
        {"sample_map", {"sample", cube, "--map", "map", "--output", "o.csv"}},
        {"sample_vtu", {"sample", cube, "--points", "p.csv", "--outside", "nearest", "--output", "o.vtu"}},
        {"resample_vti", {"resample", cube, "--grid", "6x6x6", "--output", "o.vti"}},
        {"resample_png", {"resample", mesh("plate"), "--grid", "30x30", "--fields", "attribute0", "--output", "o.png"}},
        {"resample_onto", {"resample", cube, "--onto", mesh("bracket"), "--outside", "nearest", "--output", "o.node"}},
        {"resample_vtu", {"resample", cube, "--onto", data("vtk/bracket.vtu"), "--output", "o.vtu"}},
        {"verify", {"verify", cube, "--results", "results.csv", "--exact", "--json", "v.json", "--html", "v.html"}, 1},
        {"render_mesh",
         {"render", "mesh", mesh("bracket"), "--size", "40x30", "--output", "o.png", "--json", "o.json"}},
        {"render_slice", {"render", "slice", cube, "--plane", "0,0,1,0.25", "--output", "o.vtp"}},
        {"render_iso", {"render", "iso", cube, "--field", "attribute1", "--value", "0.1", "--output", "o.ply"}},
        {"render_scene", {"render", data("scenes/crossing.json"), "--output", "o.png"}},
        {"render_texture", {"render", "texture", "--image", "texture.png", "--output", "o.png"}},
        {"render_drift", {"render", "drift", "--count", "5", "--output", "o.svg", "--json", "o.json"}},
        {"search", {"search", "tetrahedron.cramer", "--steps", "300", "--json", "s.json", "--witnesses", "s.w"}},
        {"replay", {"replay", "w.json"}},
        {"kernels", {"kernels"}},
        {"families", {"families"}},
        {"help", {"help", "render", "iso"}},
        {"help_man", {"help", "--man", "."}},
#ifdef BARYCERT_TETGEN_PROGRAM
        {"mesh", {data("plc/cube-hole.poly"), "--output", "o"}, 0, BARYCERT_TETGEN_PROGRAM, true},
#endif
    };
    return all;
}

Files files_of(const test::Scratch& folder) {
    Files files;
    for (const std::string& name : folder.names())
        if (std::filesystem::is_regular_file(folder.path(name))) files[name] = cli_test::read_file(folder.path(name));
    return files;
}

std::string without_ticks(std::string html) {
    for (const std::string begin : {"<text class=\"tick", "<path class=\"axis"}) {
        const std::string end = begin.starts_with("<text") ? "</text>" : "/>";
        for (auto at = html.find(begin); at != std::string::npos; at = html.find(begin, at)) {
            const auto last = html.find(end, at);
            html.erase(at, last == std::string::npos ? last : last + end.size() - at);
        }
    }
    return html;
}

std::string without_numbers(const std::string& text) {
    std::string result;
    bool in_number = false;
    for (const char c : text) {
        const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
        const bool goes_on = in_number && (c == '.' || c == 'e' || c == '-' || c == '+');
        const bool blank = std::isspace(static_cast<unsigned char>(c)) != 0;
        if (digit && !in_number) result += '#';
        if (blank) {
            if (!result.ends_with(' ')) result += ' ';
        } else if (!digit && !goes_on) {
            result += c;
        }
        in_number = digit || goes_on;
    }
    return result;
}

}  // namespace barycert::faults
