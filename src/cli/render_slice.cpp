// barycert render slice: a plane through a mesh, as a picture or a surface.

#include <CLI/CLI.hpp>

#include <memory>
#include <optional>

#include "command.hpp"
#include "contour_options.hpp"
#include "files.hpp"
#include "options.hpp"
#include "render.hpp"

namespace barycert::cli {
namespace {

std::optional<Plane> plane_of(const std::string& text) {
    if (text.size() > 2 && text[0] >= 'x' && text[0] <= 'z' && text[1] == '=') {
        const std::optional<double> offset = finite(text.substr(2));
        if (!offset) return std::nullopt;
        Plane plane{{0, 0, 0}, *offset};
        plane.normal[static_cast<std::size_t>(text[0] - 'x')] = 1;
        return plane;
    }
    const auto n = finite_numbers(text, ',');
    if (!n || n->size() != 4 || ((*n)[0] == 0 && (*n)[1] == 0 && (*n)[2] == 0)) return std::nullopt;
    return Plane{{(*n)[0], (*n)[1], (*n)[2]}, (*n)[3]};
}

}  // namespace

void add_render_slice(CLI::App& render, int& exit_code) {
    auto* sub =
        render.add_subcommand("slice", "Cut a mesh of tetrahedra by a plane: a picture of a field, or a surface");
    sub->footer(
        "Sides of nodes are exact, for the four numbers of the plane as they are read. By the suffix of the output:\n"
        ".png         the field in colours, with a colour bar and a scale of lengths; seen from where the normal\n"
        "             points to, z upwards. Values are exact at the pixels' middles, which are rounded to doubles.\n"
        ".vtp .ply    triangles with all fields, correctly rounded; .off: without fields. Normals along the plane's.\n"
        "Exit codes: 0 done; 2 usage or input error, a picture of nothing included.");
    const auto job = std::make_shared<ContourJob>();
    const auto quiet = std::make_shared<bool>(false);
    file_option(*sub, "MESH", job->mesh, mesh_help)->required();
    sub->add_option_function<std::string>(
           "--plane",
           [job](const std::string& text) {
               job->plane = plane_of(text);
               if (!job->plane)
                   refuse_option("--plane",
                                 "an axis and where, such as z=0.5, or NX,NY,NZ,D, finite numbers, a normal that is "
                                 "not zero, such as 0,0,1,0.5",
                                 text);
           },
           "All points with NX x + NY y + NZ z = D; or of one axis: x=D, y=D, z=D")
        ->required()
        ->type_name("NX,NY,NZ,D");
    sub->add_option(
           "--field", job->field,
           "Picture: the field of nodes or cells that it shows, or what is made of it, as sample names it: NAME.x or "
           "NAME.0, |NAME|. Surface: carry this one only")
        ->type_name("NAME");
    file_option(*sub, "--output", job->output, "The section: .png .vtp .ply .off")->required();
    sub->add_option("--width", job->width, "Picture: pixels across the section")
        ->capture_default_str()
        ->check(CLI::Range(1, 1000000).description(""))
        ->type_name("PIXELS");
    sub->add_option_function<std::string>(
           "--range",
           [job](const std::string& text) {
               const auto ends = finite_numbers(text, ',');
               if (!ends || ends->size() != 2 || !((*ends)[0] < (*ends)[1]))
                   throw CLI::ValidationError("--range",
                                              "expected MIN,MAX, finite numbers, MIN < MAX, found \"" + text + '"');
               job->range = {(*ends)[0], (*ends)[1]};
           },
           "Picture: the values of the first and the last colour; default: min and max of the values drawn")
        ->type_name("MIN,MAX");
    add_contour_options(*sub, *job, *quiet);
    sub->callback([=, &exit_code] {
        const Status ok = check_picture_only(*sub, job->output, {"--width"});
        exit_code = ok ? run_contour(*job, *quiet) : fail(ok.error());
    });
}

}  // namespace barycert::cli
