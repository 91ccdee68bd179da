#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_job.hpp"
#include "barycert/check_results.hpp"
#include "barycert/contour_job.hpp"
#include "barycert/defect.hpp"
#include "barycert/figure.hpp"
#include "barycert/fix.hpp"
#include "barycert/gmsh_files.hpp"
#include "barycert/grid.hpp"
#include "barycert/job.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/plc.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/render_job.hpp"
#include "barycert/sample_job.hpp"
#include "barycert/series.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/verify.hpp"
#include "barycert/verify_job.hpp"
#include "barycert/vtk_files.hpp"
#include "bindings.hpp"

namespace barycert::python {

template <>
inline constexpr Words<Axes> words<Axes>{
    "axes=", {{{"automatic", Axes::automatic}, {"box", Axes::box}, {"triad", Axes::triad}, {"none", Axes::none}}}};

namespace {

/// Options by name; what nobody asked for is an Error.
class Options {
public:
    explicit Options(const py::dict& given) : left_(given.attr("copy")()) {}

    template <class T>
    void operator()(const char* name, T& to) const {
        if (!left_.contains(name)) return;
        try {
            to = left_.attr("pop")(name).template cast<T>();
        } catch (const py::cast_error&) {
            throw Exception({.code = "option.value",
                             .what = "the option " + std::string(name) + " is of another type; see Mesh.plot"});
        }
    }
    void finish() const {
        for (const auto& [name, value] : left_)
            throw Exception(
                {.code = "option.value", .what = "no such option", .found = py::str(name), .remedy = "see Mesh.plot"});
    }

private:
    py::dict left_;
};

/// Normal and offset.
using GivenPlane = std::pair<std::array<double, 3>, double>;

void take(const Options& given, SceneChoice& show) {
    given("surface", show.surface);
    given("edges", show.edges);
    given("outline", show.outline);
    given("box", show.box);
    std::optional<GivenPlane> clip;
    given("clip", clip);
    if (clip) show.plane = Plane{clip->first, clip->second};
    std::vector<GivenPlane> slices;
    given("slices", slices);
    for (const auto& [normal, offset] : slices) show.slices.push_back({normal, offset});
    std::optional<std::tuple<std::string, double, double>> threshold;
    given("threshold", threshold);
    if (threshold) std::apply([&](auto&... of) { show.threshold = {of...}; }, *threshold);
    given("iso", show.iso);
    given("iso_field", show.iso_field);
    given("arrows", show.arrows);
    given("arrow_count", show.arrow_count);
    given("point_size", show.point_size);
    py::array_t<double, py::array::c_style | py::array::forcecast> points;
    given("points", points);
    show.points.assign(points.data(), points.data() + points.size());
    given("marked", show.marked);
}

void take(const Options& given, FigureOptions& o) {
    std::pair<std::int32_t, std::int32_t> size{o.size.width, o.size.height};
    given("size", size);
    o.size = {size.first, size.second};
    std::string view;
    given("view", view);
    std::optional<std::pair<double, double>> camera = angles_of(view);
    if (!view.empty() && !camera)
        throw Exception(
            {.code = "option.value", .what = "the view", .expected = "iso, +x, -x, +y, -y, +z or -z", .found = view});
    given("camera", camera);
    if (camera) std::tie(o.camera.azimuth, o.camera.elevation) = *camera;
    given("zoom", o.camera.zoom);
    given("parallel", o.camera.parallel);
    given("resolution", o.resolution);
    given("samples", o.samples);
    given("background", o.background);
    given("axes", o.axes);
    given("title", o.title);
    given("unit", o.unit);
    given("colormap", o.colour_map);
    given("range", o.range);
    given("log", o.log);
    given("labels", o.labels);
    given("bar", o.bar);
}

void plot(MeshObject& object, const std::string& field, const py::dict& options, const std::string& path) {
    SceneChoice show;
    FigureOptions figure;
    const Options given(options);
    take(given, show);
    take(given, figure);
    given.finish();
    if (show.iso_field.empty()) show.iso_field = field;
    show.location = object.geometry()->options;
    const py::gil_scoped_release unlocked;
    write_mesh_figure(path, object.whole(), show, field, figure).value();
}

void plot_line(MeshObject& object, std::vector<double> from, std::vector<double> to, std::int64_t count,
               const std::vector<std::string>& fields, const py::dict& options, const std::string& path) {
    FigureOptions figure;
    const Options given(options);
    take(given, figure);
    given.finish();
    const std::shared_ptr<BoundSampler> of = object.sampler(fields, {});
    const py::gil_scoped_release unlocked;
    write_line_plot(path, of->sampler, {std::move(from), std::move(to), count}, figure).value();
}

}  // namespace

void bind_figure(py::module_& module) {
    module.def("plot", &plot);
    module.def("plot_line", &plot_line);
}

}  // namespace barycert::python
