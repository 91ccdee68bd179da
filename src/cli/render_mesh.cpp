// barycert render mesh: the boundary of a mesh, lit, coloured by a field.

#include <CLI/CLI.hpp>

#include <memory>

#include "barycert/io.hpp"
#include "barycert/jobs/job_files.hpp"
#include "command.hpp"
#include "files.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "render.hpp"
#include "render_options.hpp"
#include "sampling_options.hpp"

namespace barycert::cli {
namespace {

struct MeshPicture {
    PictureOptions files;
    MeshPictureJob job;
    bool no_bar = false;
};

Result<RenderReport> draw_mesh(MeshPicture& p) {
    Progress progress(!p.files.quiet && stderr_is_terminal());
    progress.stage("reading " + p.job.mesh);
    p.job.output = p.files.output;
    p.job.view.bar = !p.no_bar;
    return render_mesh_file(p.job);
}

}  // namespace

void add_render_mesh(CLI::App& render, int& exit_code) {
    auto* sub = render.add_subcommand("mesh", "The boundary of a mesh, lit, in the colours of a field");
    sub->footer(
        "Triangles in the plane are drawn from above. Colours go from dark violet (low) to light yellow (high); grey: "
        "no\n"
        "finite value. Second-order cells are drawn with straight sides.\nExit codes: 0 done; 2 usage or input error.");
    const auto p = std::make_shared<MeshPicture>();
    file_option(*sub, "MESH", p->job.mesh, mesh_help)->required();
    step_options(*sub, p->job.step);
    sub->add_option("--field", p->job.field,
                    "The field: A, point:A or cell:A; A.1 is its component 1; default: none, the mesh is grey")
        ->type_name("NAME");
    add_field_files(*sub, p->job.field_files, "--field-file");
    sub->add_option_function<std::string>(
           "--range",
           [p](const std::string& text) {
               constexpr const char* expected = "MIN,MAX, finite numbers, MIN < MAX";
               const auto ends = numbers_of<double>("--range", text, ',', finite, expected);
               if (ends.size() != 2 || !(ends[0] < ends[1])) refuse_option("--range", expected, text);
               p->job.view.range = {ends[0], ends[1]};
           },
           "The values of the first and the last colour; default: min and max of the values drawn")
        ->type_name("MIN,MAX");
    const auto angle = [&](const char* name, double& degrees, const char* help) {
        sub->add_option_function<std::string>(
               name,
               [name, &degrees](const std::string& text) {
                   const auto x = finite(text);
                   if (!x) refuse_option(name, "degrees, a finite number", text);
                   degrees = *x;
               },
               help)
            ->type_name("DEGREES");
    };
    angle("--azimuth", p->job.view.azimuth, "Where the camera stands, from the x axis towards the y axis; default: 30");
    angle("--elevation", p->job.view.elevation, "How far above the xy plane; default: 25");
    sub->add_flag("--no-bar", p->no_bar, "Draw no colour bar");
    add_picture_options(*sub, p->files);
    add_size_option(*sub, p->job.view.size);
    add_method_options(*sub, p->job.view.method, p->job.view.rounding);
    curved_option(*sub, p->job.curved);
    threads_option(*sub, p->job.threads);
    sub->callback([=, &exit_code] {
        auto inputs = base::named_files("the mesh", mesh_files(p->job.mesh));
        for (const FieldFile& field : p->job.field_files) {
            for (base::NamedFile& file : jobs::input_files("field " + field.name, field.path))
                inputs.push_back(std::move(file));
        }
        exit_code = run_picture(p->files, inputs, [&] { return draw_mesh(*p); });
    });
}

}  // namespace barycert::cli
