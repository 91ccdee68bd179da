// barycert render: pictures of scenes and meshes; the rest of its subcommands have files of their own.

#include <algorithm>
#include <utility>

#include "barycert/base/nearest_name.hpp"
#include "options/mistyped.hpp"
#include "reports.hpp"

namespace barycert::cli {
namespace {

constexpr const char* pictures_remedy = "`barycert render --help` lists the pictures";

struct PictureArguments {
    RenderJob job;
    Reports reports{Reports::Text::summary};
};

int run_picture(PictureArguments& a) {
    return a.reports.summarise(a.job, render_files, render_json, render_text);
}

int run_scene_file(PictureArguments& a, const std::vector<std::string>& pictures) {
    if (a.job.scene.empty())
        return fail({.what = "nothing to draw",
                     .expected = "the name of a picture, or a scene (.json)",
                     .remedy = pictures_remedy});
    if (const Status named = check_picture_name(a.job.scene, pictures); !named) return fail(named.error());
    if (a.job.output.empty())
        return fail({.what = "--output is required", .remedy = "name the picture: --output FILE.png"});
    return run_picture(a);
}

void add_outputs(const Options& o, PictureArguments& a, bool required = true) {
    o.text("--output", a.job.output, "The picture: .png")->required(required);
    a.reports.file(o, "--json", json_summary);
    a.reports.quiet(o, "Print no summary");
}

void add_methods(const Options& o, ViewOptions& view) {
    o.choice<FillMethod>(
        "--method", view.method,
        {{"barycentric", FillMethod::barycentric},
         {"scanline", FillMethod::scanline},
         {"bilinear", FillMethod::bilinear}},
        "How values are found at pixels: by the weights at each (default); by constant steps; along auxiliary lines");
    o.rounding(view.rounding, "plain: computed in double (default); correct: the exact values, rounded once");
}

/// One of the small pictures; `more` declares what comes before the options that all have.
template <class More>
void add_picture(const Options& render, PictureKind picture, RasterSize size, const std::string& about, More more) {
    const Options o = render.below(name(picture), about, done_or_error);
    const auto a = std::make_shared<PictureArguments>();
    a->job.picture = picture;
    a->job.view.size = size;
    more(o, a->job);
    add_outputs(o, *a);
    o.size(a->job.view.size);
    if (picture != PictureKind::clip) add_methods(o, a->job.view);
    o.run([a] { return run_picture(*a); });
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

void add_mesh(const Options& render) {
    const Options o = render.below(
        "mesh", "The boundary of a mesh, lit, in the colours of a field",
        "Triangles in the plane are drawn from above. Colours go from dark violet (low) to light yellow (high); grey: "
        "no\n"
        "finite value. Second-order cells are drawn with straight sides.\nExit codes: 0 done; 2 usage or input error.");
    const auto a = std::make_shared<PictureArguments>();
    RenderJob& job = a->job;
    job.picture = PictureKind::mesh;
    o.mesh(job.mesh);
    o.step(job.step);
    o.text("--field", job.field,
           "The field: A, point:A or cell:A; A.1 is its component 1; default: none, the mesh is grey", "NAME");
    o.field_files(job.field_files, "--field-file");
    o.range(job.view.range, "");
    o.camera(job.view, "");
    o.negative("--no-bar", job.view.bar, "Draw no colour bar");
    add_outputs(o, *a);
    o.size(job.view.size);
    add_methods(o, job.view);
    o.curved(job.curved);
    o.threads(job.threads);
    o.run([a] { return run_picture(*a); });
}

}  // namespace

Status check_picture_name(const std::string& word, const std::vector<std::string>& pictures) {
    if (word.ends_with(".json") || std::find(pictures.begin(), pictures.end(), word) != pictures.end()) return Done{};
    return Error{.what = "no such picture",
                 .expected = "the name of a picture, or a scene (.json)",
                 .found = '"' + word + '"',
                 .remedy = base::did_you_mean(word, pictures, pictures_remedy)};
}

void add_render(const Options& program) {
    const Options o = program.below(
        "render", "Pictures of meshes and scenes, surfaces in meshes, and what the shortcuts of rasterisers cost", "");
    const auto a = std::make_shared<PictureArguments>();
    o.text("SCENE", a->job.scene, "A scene (.json)");
    add_outputs(o, *a, false);
    o.app().require_subcommand(0, 1);
    const auto nothing = [](const Options&, RenderJob&) {};
    add_picture(o, PictureKind::gradient, {400, 400}, "A triangle with a red, a green and a blue corner", nothing);
    add_picture(o, PictureKind::texture, {400, 400}, "A picture on a square or a triangle", add_texture);
    add_picture(
        o, PictureKind::cube, {480, 400},
        "A checkerboard on the faces of a cube in perspective, and the largest error of its texture coordinates",
        add_cube);
    add_picture(o, PictureKind::clip, {640, 320},
                "A triangle and segments with colours, before and after clipping by a box", nothing);
    add_mesh(o);
    add_render_contours(o);
#ifdef BARYCERT_WITH_AUDIT
    add_render_tables(o);
#endif
    // After the pictures, which would take it over.
    o.app().footer(with_command_name(
        "`barycert render SCENE.json --output FILE.png` draws a scene; doc/rendering.md describes its file. Coverage "
        "is\n"
        "exact: a pixel belongs to the triangle that holds its centre, and on a common side to exactly one of the "
        "two.\n"
        "`barycert help render PICTURE` explains each picture. Exit codes: 0 done; 2 usage or input error."));
    o.app().callback([a, o] {
        if (o.app().get_subcommands().empty()) o.exit_with(run_scene_file(*a, command_names(o.app())));
    });
}

}  // namespace barycert::cli
