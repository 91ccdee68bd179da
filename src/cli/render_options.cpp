#include "render_options.hpp"

#include <CLI/CLI.hpp>

#include <chrono>

#include "barycert/environment.hpp"
#include "barycert/report.hpp"
#include "command.hpp"
#include "files.hpp"
#include "options.hpp"

namespace barycert::cli {
namespace {

Status check_picture_files(const PictureOptions& o, const std::vector<base::NamedFile>& inputs) {
    if (!o.output.ends_with(".png"))
        return Error{.what = "pictures are PNG files",
                     .file = o.output,
                     .expected = "a name that ends in .png",
                     .remedy = "choose another name for --output"};
    std::vector<base::NamedFile> outputs{{"--output", o.output}, {"--json", o.json}};
    if (!o.quiet && o.json != "-") outputs.push_back({"the summary", "-"});
    return base::check_outputs(inputs, std::move(outputs));
}

Status tell_summary(const PictureOptions& o, const RenderReport& summary) {
    Status json = Done{};
    if (!o.json.empty()) json = write_output(o.json, render_json(summary, measure_environment()));
    if (o.quiet) return json;
    if (o.json == "-") {
        tell(render_text(summary, false));
        return json;
    }
    Status told = write_output("-", render_text(summary, colour_on_stdout()));
    return json ? told : json;
}

}  // namespace

void add_picture_options(CLI::App& sub, PictureOptions& o, bool required) {
    file_option(sub, "--output", o.output, "The picture: .png")->required(required);
    file_option(sub, "--json", o.json, "Write the summary as JSON; - is stdout");
    sub.add_flag("--quiet", o.quiet, "Print no summary");
}

void add_size_option(CLI::App& sub, RasterSize& size) {
    sub.add_option_function<std::string>(
           "--size",
           [&size](const std::string& text) {
               const std::string expected =
                   "width and height in pixels, 1 to " + std::to_string(max_raster_side) + ", such as 640x480";
               const auto sides = numbers_of<std::int64_t>("--size", text, 'x', count_of, expected.c_str());
               if (sides.size() != 2 || std::max(sides[0], sides[1]) > max_raster_side)
                   refuse_option("--size", expected, text);
               size = {static_cast<std::int32_t>(sides[0]), static_cast<std::int32_t>(sides[1])};
           },
           "Width and height in pixels; default: " + std::to_string(size.width) + 'x' + std::to_string(size.height))
        ->type_name("WxH");
}

void add_method_options(CLI::App& sub, FillMethod& method, Rounding& rounding) {
    choice_option<FillMethod>(
        sub, "--method", method,
        {{"barycentric", FillMethod::barycentric},
         {"scanline", FillMethod::scanline},
         {"bilinear", FillMethod::bilinear}},
        "How values are found at pixels: by the weights at each (default); by constant steps; along "
        "auxiliary lines");
    choice_option<Rounding>(sub, "--rounding", rounding, {{"correct", Rounding::correct}, {"plain", Rounding::plain}},
                            "plain: computed in double (default); correct: the exact values, rounded once");
}

int run_picture(const PictureOptions& o, const std::vector<base::NamedFile>& inputs,
                const std::function<Result<RenderReport>()>& work) {
    if (const Status ok = check_picture_files(o, inputs); !ok) return fail(ok.error());
    const auto begin = std::chrono::steady_clock::now();
    Result<RenderReport> summary = work();
    if (!summary) return fail(summary.error());
    summary->seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (!o.quiet) tell_important(summary->notes);
    const Status told = tell_summary(o, *summary);
    return told ? exit_clean : fail(told.error());
}

RenderReport summary_of(const std::string& picture, const PictureOptions& o, const Scene& scene) {
    RenderReport summary;
    summary.picture = picture;
    summary.output = o.output;
    summary.size = scene.size;
    summary.method = scene.method;
    summary.interpolation = scene.interpolation;
    summary.rounding = scene.rounding;
    return summary;
}

int run_scene(const PictureOptions& o, const std::string& picture, const std::vector<base::NamedFile>& inputs,
              const std::function<Result<Scene>()>& make) {
    return run_picture(o, inputs, [&]() -> Result<RenderReport> {
        const Result<Scene> scene = make();
        if (!scene) return scene.error();
        RenderReport summary = summary_of(picture, o, *scene);
        if (!inputs.empty()) summary.input = inputs.front().path;
        const Result<Image> image = render(*scene, &summary.counts);
        if (!image) return image.error();
        if (Status written = write_png(o.output, *image); !written) return written.error();
        return summary;
    });
}

}  // namespace barycert::cli
