// barycert render: pictures of scenes and meshes; the rest of its subcommands have files of their own.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "app/cli/command.hpp"
#include "app/cli/options.hpp"
#include "app/cli/reports.hpp"
#include "app/options/parser.hpp"
#include "barycert/figure.hpp"
#include "barycert/mesh.hpp"
#include "barycert/raster.hpp"
#include "barycert/render_job.hpp"
#include "barycert/report.hpp"
#include "barycert/result.hpp"
#include "barycert/scene.hpp"
#include "core/base/nearest_name.hpp"
#include "core/base/text.hpp"

namespace barycert::cli {
namespace {

constexpr const char* pictures_remedy = "`barycert render --help` lists the pictures";
constexpr const char* picture_or_scene = "the name of a picture, or a scene (.json)";

using PictureArguments = Arguments<RenderJob>;

int run_picture(PictureArguments& a) {
    return a.reports.summarise(a.job, render_files, render_json, render_text);
}

int run_scene_file(PictureArguments& a) {
    if (a.job.scene.empty())
        return fail({.code = "option.missing",
                     .what = "nothing to draw",
                     .expected = picture_or_scene,
                     .remedy = pictures_remedy});
    if (a.job.output.empty())
        return fail({.code = "option.missing",
                     .what = "--output is required",
                     .remedy = "name the picture: --output FILE.png"});
    return run_picture(a);
}

void add_outputs(const Options& o, PictureArguments& a, bool required = true) {
    o.text("--output", a.job.output,
           a.job.picture == PictureKind::mesh ? "The picture: " + pictures_help() + "; a page that turns: .html"
                                              : std::string("The picture: .png"))
        ->required(required);
    a.reports.file(o, "--json", json_summary);
    a.reports.quiet(o, "Print no summary");
}

void add_methods(const Options& o, FigureOptions& view) {
    o.choice<FillMethod>(
        "--method", view.method,
        {{"barycentric", FillMethod::barycentric},
         {"scanline", FillMethod::scanline},
         {"bilinear", FillMethod::bilinear}},
        "How values are found at pixels: by the weights at each (default); by constant steps; along auxiliary lines");
    o.rounding(view.rounding, "plain: computed in double (default); correct: the exact values, rounded once");
}

/// One of the small pictures; `more` declares what comes before the options that all have.
void add_picture(const Options& render, PictureKind picture, RasterSize size, const std::string& about,
                 void (*more)(const Options&, RenderJob&) = nullptr) {
    const auto& [o, a] = render.command(name(picture), about, done_or_error, run_picture);
    a.job.picture = picture;
    a.job.figure.size = size;
    if (more != nullptr) more(o, a.job);
    add_outputs(o, a);
    o.size(a.job.figure.size);
    if (picture != PictureKind::clip) add_methods(o, a.job.figure);
}

void add_texture(const Options& o, RenderJob& job) {
    o.text("--image", job.image, "The picture: .png; default: one of 2 by 2 texels");
    o.choice<bool>("--shape", job.triangle, {{"square", false}, {"triangle", true}},
                   "What it is put on; default: square");
    o.choice<Wrap>(
        "--wrap", job.wrap, {{"clamp", Wrap::clamp}, {"repeat", Wrap::repeat}, {"mirror", Wrap::mirror}},
        "What is beyond the picture: its rim (default), the picture again, or again and every other time reversed");
    o.choice<Filter>("--filter", job.filter, {{"nearest", Filter::nearest}, {"bilinear", Filter::bilinear}},
                     "The texel at a point (default), or between the four around it");
    o.parsed("--coordinates", "MIN,MAX",
             "u and v at the lower left and the upper right; default: 0,1, the picture once", "MIN,MAX, finite numbers",
             job.coordinates, ends_of);
}

void add_cube(const Options& o, RenderJob& job) {
    o.choice<Interpolation>("--interpolation", job.interpolation,
                            {{"perspective", Interpolation::perspective},
                             {"affine", Interpolation::affine},
                             {"projected-z", Interpolation::projected_z}},
                            "Of texture coordinates in the window: (v/w)/(1/w) (default); v itself, which is wrong; "
                            "with the projected z in place of w, which is wrong as well");
}

/// LOWX,HIGHX,LOWY,HIGHY,LOWZ,HIGHZ; or a plane.
bool set_clip(Text text, SceneChoice& show) {
    if ((show.plane = plane_of(text))) return true;
    const auto ends = numbers(',', finite, 6, 6)(text);
    if (!ends) return false;
    for (std::size_t i = 0; i < ends->size(); i += 2)
        if (!((*ends)[i] < (*ends)[i + 1])) return false;
    auto& [low, high] = show.box.emplace();
    for (std::size_t i = 0; i < ends->size(); ++i) (i % 2 == 0 ? low : high)[i / 2] = (*ends)[i];
    return true;
}

/// NAME=A,B,...
std::optional<std::pair<std::string, std::vector<double>>> named_numbers(Text text, std::size_t least,
                                                                         std::size_t most) {
    const std::size_t sign = text.rfind('=');
    if (sign == std::string::npos || sign == 0) return std::nullopt;
    const auto all = numbers(',', finite, least, most)(std::string_view(text).substr(sign + 1));
    return all ? std::optional(std::pair(text.substr(0, sign), *all)) : std::nullopt;
}

/// Adds options for the parts of the mesh to draw.
void add_choice(const Options& o, SceneChoice& show) {
    o.edges(show.edges, show.outline, "");
    o.flag("--no-surface", show.surface, "Without the boundary: --outline, --arrows, --points alone", false);
    o.taken("--clip", "PLANE|BOX",
            "Cut open: leave out where the normal of a plane points to, such as x > 0.5 for x=0.5, and close it by the "
            "section; or cells with a "
            "node in a box: XMIN,XMAX,YMIN,YMAX,ZMIN,ZMAX",
            "a plane such as x=0.5 or 1,0,0,0.5, or a box: six numbers, each MIN below its MAX",
            [&show](Text text) { return set_clip(text, show); });
    o.taken("--threshold", "NAME=MIN,MAX", "Only cells whose value is within, or the values at all of whose nodes are",
            "NAME=MIN,MAX, finite numbers, MIN <= MAX", [&show](Text text) {
                const auto given = named_numbers(text, 2, 2);
                if (given && given->second[0] > given->second[1]) return false;
                if (given) show.threshold = {given->first, given->second[0], given->second[1]};
                return given.has_value();
            });
    o.taken("--iso", "NAME=V,...", "In place of the boundary the iso-surfaces of a field of nodes",
            "NAME=V,..., finite numbers", [&show](Text text) {
                const auto given = named_numbers(text, 1, 100);
                if (given) std::tie(show.iso_field, show.iso) = *given;
                return given.has_value();
            });
    o.each("--slice", "PLANE", "In place of the boundary a section; may be repeated", [&show](Text text) {
        const auto plane = plane_of(text);
        if (!plane) refuse_option("--slice", "an axis and where, such as z=0.5, or NX,NY,NZ,D, finite numbers", text);
        show.slices.push_back(*plane);
    });
    auto* const arrows = o.text(
        "--arrows", show.arrows,
        "Arrows of a field of vectors at nodes of what is drawn; with --no-surface in the colours of --field", "NAME");
    o.integer<std::int64_t>("--arrow-count", show.arrow_count, 1, 1000000, "About how many of them, spread evenly")
        ->needs(arrows);
    o.taken("--mark", "CELL,...",
            "In place of the boundary these cells in red, by their numbers from 0, and the outline", "numbers of cells",
            [&show](Text text) {
                const auto all = numbers(',', base::whole_number<Mesh::Index>, 1, 100000)(text);
                if (all) show.marked = *all;
                return all.has_value() && std::ranges::min(*all) >= 0;
            });
}

void add_mesh(const Options& render) {
    const auto& [o, a] = render.command(
        "mesh", "A mesh in the colours of a field: its boundary, cut open, sections, iso-surfaces, arrows, points",
        "Triangles in the plane are drawn from above, on axes. Grey: no finite value. Second-order cells are drawn "
        "with\n"
        "straight sides. A pixel has 4 x 4 samples, each of which is drawn by exactly one of triangles that meet "
        "there.\n"
        "Exit codes: 0 done; 2 usage or input error.",
        run_picture);
    RenderJob& job = a.job;
    job.picture = PictureKind::mesh;
    o.mesh(job.mesh);
    o.step(job.step);
    o.text("--field", job.field,
           "The field: A, point:A or cell:A; A.1 is its component 1; default: none, the mesh is grey", "NAME");
    o.field_files(job.field_files, "--field-file");
    add_choice(o, job.show);
    auto* const points =
        o.text("--points", job.points,
               "Discs at the points of a table, in the colours of the field there; grey: outside", "FILE");
    o.text("--columns", job.columns, "Those of their coordinates, by name or by number from 1", "A,B,C")->needs(points);
    o.number("--point-size", job.show.point_size, 0, "Pixels across; default: 6", "PIXELS")->needs(points);
    o.figure(job.figure, "");
    o.view(job.figure, "");
    o.number("--scale", job.figure.scale, 0, "In the plane, in place of --size: pixels for a unit", "PIXELS")
        ->excludes(o.app().get_option("--size"));
    add_outputs(o, a);
    add_methods(o, job.figure);
    o.curved(job.curved);
    o.threads(job.threads);
}

}  // namespace

void add_render(const Options& program) {
    const auto& [o, a] = program.command(
        "render", "Pictures of meshes and scenes, surfaces in meshes, and what the shortcuts of rasterisers cost", "",
        run_scene_file);
    // The parser would take another word for a scene, too, and complain of the words behind it.
    const auto scene = [&job = a.job, app = &o.app()](const std::string& word) {
        const std::vector<std::string> pictures = command_names(*app);
        if (!word.ends_with(".json") && std::find(pictures.begin(), pictures.end(), word) == pictures.end())
            throw Exception(file_error("option.usage", {}, "no such picture", picture_or_scene, '"' + word + '"',
                                       base::did_you_mean(word, pictures, pictures_remedy)));
        job.scene = word;
        return true;
    };
    o.taken("SCENE", "FILE", "A scene (.json)", picture_or_scene, scene);
    add_outputs(o, a, false);
    add_picture(o, PictureKind::gradient, {400, 400}, "A triangle with a red, a green and a blue corner");
    add_picture(o, PictureKind::texture, {400, 400}, "A picture on a square or a triangle", add_texture);
    add_picture(
        o, PictureKind::cube, {480, 400},
        "A checkerboard on the faces of a cube in perspective, and the largest error of its texture coordinates",
        add_cube);
    add_picture(o, PictureKind::clip, {640, 320},
                "A triangle and segments with colours, before and after clipping by a box");
    add_mesh(o);
    add_render_contours(o);
#ifdef BARYCERT_AUDIT_COMMANDS
    add_render_tables(o);
#endif
    o.app().require_subcommand(0, 1);
    // After the pictures, which would take it over.
    o.app().footer(with_command_name(
        "`barycert render SCENE.json --output FILE.png` draws a scene; doc/rendering.md describes its file. Coverage\n"
        "is exact: a pixel belongs to the triangle that holds its centre, and on a common side to one of the two.\n"
        "`barycert help render PICTURE` explains each picture. Exit codes: 0 done; 2 usage or input error."));
}

}  // namespace barycert::cli
