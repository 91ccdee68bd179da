// Pictures of scenes and of meshes, and small ones that show what rasterising does.

#include "barycert/render_job.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/jobs/job_files.hpp"
#include "app/jobs/mesh_figure.hpp"
#include "barycert/environment.hpp"
#include "barycert/figure.hpp"
#include "barycert/mesh.hpp"
#include "barycert/point_files.hpp"
#include "barycert/raster.hpp"
#include "barycert/result.hpp"
#include "barycert/scene.hpp"
#include "barycert/weights.hpp"
#include "files/format.hpp"
#include "files/named_file.hpp"

namespace barycert {

using base::FormatKind;
using base::Use;
namespace {

using jobs::refuse;
using jobs::refuse_member;

void set_texture(const RenderJob& job, Scene& scene) {
    scene.texture = Texture{four_colours(), job.wrap, job.filter};
    if (!job.image.empty()) scene.texture->image = read_png(job.image).value();
    const auto [low, high] = job.coordinates;
    if (job.triangle) {
        scene.positions = {-1, -1, 0, 1, 1, -1, 0, 1, 0, 1, 0, 1};
        scene.texture_coordinates = {low, low, high, low, 0.5 * low + 0.5 * high, high};
        scene.triangles = {0, 1, 2};
    } else {
        scene.positions = {-1, -1, 0, 1, 1, -1, 0, 1, 1, 1, 0, 1, -1, 1, 0, 1};
        scene.texture_coordinates = {low, low, high, low, high, high, low, high};
        scene.triangles = {0, 1, 2, 0, 2, 3};
    }
}

void set_cube(const RenderJob& job, Scene& scene) {
    scene.interpolation = job.interpolation;
    scene.texture = Texture{checkerboard(8, 8).value(), Wrap::clamp, Filter::nearest};
    // Faces of the cube from -1 to 1: their middles, and two axes on which u and v go from 0 to 1.
    constexpr Vector3 faces[6][3] = {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},  {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                                     {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}}, {{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}},
                                     {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}}, {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};
    constexpr double corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (const auto& [middle, u, v] : faces) {
        const auto first = static_cast<std::int32_t>(scene.positions.size() / 4);
        for (const auto& c : corners) {
            for (std::size_t k = 0; k < 3; ++k) scene.positions.push_back(middle[k] + c[0] * u[k] + c[1] * v[k]);
            scene.positions.push_back(1);
            for (const double x : c) scene.texture_coordinates.push_back(x > 0 ? 1 : 0);
        }
        for (const std::int32_t k : {0, 1, 2, 0, 2, 3}) scene.triangles.push_back(first + k);
    }
    const Matrix4 view = look_at({1.6, 1.5, 2.4}, {0, -0.1, 0.13}, {0, 1, 0}).value();
    scene.to_clip = perspective(62, 1.0 * scene.size.width / scene.size.height, 0.5, 10).value() * view;
}

/// x, y, red, green, blue.
using ColouredPoint = std::array<double, 5>;

constexpr std::array<ColouredPoint, 3> triangle{{{-1.5, -0.9, 1, 0, 0}, {1.35, -1.4, 0, 1, 0}, {0.35, 1.6, 0, 0, 1}}};
constexpr std::array<std::array<ColouredPoint, 2>, 4> segments{{
    {{{-1.7, 0.2, 1, 0.6, 0}, {-0.1, 1.7, 0.5, 0, 0.8}}},   // cuts a corner
    {{{-1.6, -1.3, 1, 0.6, 0}, {1.7, 1.25, 0.5, 0, 0.8}}},  // goes through
    {{{0.6, -0.7, 1, 0.6, 0}, {0.85, 0.5, 0.5, 0, 0.8}}},   // inside
    {{{1.2, 1.7, 1, 0.6, 0}, {1.75, -0.4, 0.5, 0, 0.8}}},   // outside
}};

/// Draws into two square panels beside each other, as large as they fit; later triangles in front.
class ClipScene {
public:
    explicit ClipScene(Scene& scene) : scene_(scene) {
        const double aspect = 1.0 * scene.size.width / scene.size.height;
        const double half = std::max(2 * half_panel / aspect, half_panel);
        scene.to_clip = scaling({1 / (half * aspect), 1 / half, 1});
        pixel_ = 2 * half / scene.size.height;
    }

    void begin_panel(bool right) {
        left_ = right ? half_panel : -half_panel;
        z_ = 0.9;
    }

    void add_triangle(const ColouredPoint& a, const ColouredPoint& b, const ColouredPoint& c) {
        for (const ColouredPoint* p : {&a, &b, &c}) {
            scene_.positions.insert(scene_.positions.end(), {left_ + (*p)[0], (*p)[1], z_, 1});
            scene_.colours.insert(scene_.colours.end(), p->begin() + 2, p->end());
            scene_.triangles.push_back(static_cast<std::int32_t>(scene_.triangles.size()));
        }
        z_ -= 0x1p-8;
    }

    /// A line some pixels wide.
    void add_line(const ColouredPoint& a, const ColouredPoint& b, double pixels) {
        const double dx = b[0] - a[0], dy = b[1] - a[1], length = std::hypot(dx, dy);
        if (!(length > 0)) return;
        const double part = 0.5 * pixels * pixel_ / length;
        const auto moved = [&](ColouredPoint p, double side) {
            p[0] -= side * part * dy;
            p[1] += side * part * dx;
            return p;
        };
        add_triangle(moved(a, 1), moved(a, -1), moved(b, -1));
        add_triangle(moved(a, 1), moved(b, -1), moved(b, 1));
    }

    void end_panel() {
        constexpr ColouredPoint box[5] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
        for (std::size_t i = 0; i < 4; ++i) add_line(box[i], box[i + 1], 2);
    }

private:
    static constexpr double half_panel = 1.9;  ///< half the side of a panel
    Scene& scene_;
    double left_ = 0, z_ = 0, pixel_ = 0;
};

/// The shapes as they are, and beside them what is left in the box: that of the clip volume with w = 1.
void set_clip(Scene& scene) {
    ClipScene s(scene);
    s.begin_panel(false);
    s.add_triangle(triangle[0], triangle[1], triangle[2]);
    for (const auto& [a, b] : segments) s.add_line(a, b, 4);
    s.end_panel();
    s.begin_panel(true);
    std::vector<double> rows, polygon;
    for (const ColouredPoint& p : triangle) rows.insert(rows.end(), {p[0], p[1], 0, 1, p[2], p[3], p[4]});
    clip_triangle(rows, polygon).value();
    const auto corner = [&](std::size_t i) {
        const double* const row = polygon.data() + 7 * i;
        return ColouredPoint{row[0], row[1], row[4], row[5], row[6]};
    };
    for (std::size_t i = 1; i + 1 < polygon.size() / 7; ++i) s.add_triangle(corner(0), corner(i), corner(i + 1));
    for (const auto& [a, b] : segments) {
        const ClippedSegment part = clip_segment(2, a, b, ClipBox{{-1, -1, 0}, {1, 1, 0}}).value();
        const auto end = [](const std::vector<double>& row) {
            return ColouredPoint{row[0], row[1], row[2], row[3], row[4]};
        };
        if (!part.empty) s.add_line(end(part.a), end(part.b), 4);
    }
    s.end_panel();
}

Scene small_picture(const RenderJob& job) {
    Scene scene;
    scene.size = job.figure.size;
    if (job.picture == PictureKind::clip) {
        set_clip(scene);
        return scene;
    }
    scene.method = job.figure.method;
    scene.rounding = job.figure.rounding;
    if (job.picture == PictureKind::texture) set_texture(job, scene);
    if (job.picture == PictureKind::cube) set_cube(job, scene);
    if (job.picture == PictureKind::gradient) {
        scene.positions = {-0.9, -0.8, 0, 1, 0.9, -0.8, 0, 1, 0, 0.9, 0, 1};
        scene.colours = {1, 0, 0, 0, 1, 0, 0, 0, 1};
        scene.triangles = {0, 1, 2};
    }
    return scene;
}

void draw_mesh(const RenderJob& job, RenderReport& report) {
    const jobs::ThreadLimit limit(job.threads);
    const Mesh mesh = jobs::open_mesh_with_fields(job, job.threads, report);
    if (mesh.cells.empty()) refuse("mesh.empty", job.mesh, "the mesh has no cells", "", "", "there is nothing to draw");
    if (job.figure.scale > 0 && mesh.dimension == 3)
        refuse_member("option.unfit", "job.scale", job.mesh, "job.scale is for meshes in the plane", "",
                      "tetrahedra in space", "use job.size");
    report.input = job.mesh;
    report.samples = job.figure.samples;
    report.method = job.figure.method;
    report.rounding = job.figure.rounding;
    try {
        SceneChoice show = job.show;
        show.location = {.curved = job.curved, .threads = job.threads};
        if (!job.points.empty()) {
            const auto points = open_points(job.points, mesh.dimension, {.columns = job.columns}).value();
            while (points->read(1U << 20, show.points).value() != 0) continue;
            if (show.points.empty())
                refuse_member("picture.empty", "job.points", job.points, "there are no points to draw", "", "");
        }
        jobs::MeshFigure figure(mesh, show, job.field, job.threads, report.notes);
        jobs::tell_stage(job, "drawing");
        figure.add_mesh();
        FigureOptions options = job.figure;
        if (base::is_written_as(job.output, Use::page) && options.title.empty())
            options.title = std::filesystem::path(job.mesh).filename().string();
        const FigureCounts counts = figure.write(job.output, options);
        report.size = counts.size;
        report.counts = counts.render;
        if (!std::isnan(counts.low) || counts.without_value != 0)
            report.colours = {job.field.empty() ? job.show.iso_field : job.field, counts.low, counts.high,
                              counts.without_value};
    } catch (const Exception& e) {
        Error error = e.error();
        if (error.file.empty()) error.file = job.mesh;
        throw Exception(error);
    }
}

/// The largest difference of u or v at a pixel from the correctly rounded one.
TexelError texel_error(Scene scene, const PixelValues& drawn) {
    scene.method = FillMethod::barycentric;
    scene.interpolation = Interpolation::perspective;
    scene.rounding = Rounding::correct;
    PixelValues exact;
    render(scene, nullptr, &exact).value();
    const double texels[2] = {1.0 * scene.texture->image.width, 1.0 * scene.texture->image.height};
    TexelError worst;
    for (std::size_t i = 0; i < drawn.data.size(); ++i) {
        const double error = std::abs(drawn.data[i] - exact.data[i]) * texels[i % 2];
        if (!(error > worst.texels)) continue;  // NaN where nothing is drawn
        const auto pixel = static_cast<std::int32_t>(i / 2);
        worst = {error, pixel % scene.size.width, pixel / scene.size.width};
    }
    return worst;
}

Image draw_scene(const RenderJob& job, RenderReport& report) {
    const bool of_file = job.picture == PictureKind::scene, cube = job.picture == PictureKind::cube;
    const Scene scene = of_file ? read_scene(job.scene).value() : small_picture(job);
    report.input = of_file ? job.scene : job.image;
    report.size = scene.size;
    report.samples = scene.samples;
    report.method = scene.method;
    report.interpolation = scene.interpolation;
    report.rounding = scene.rounding;
    PixelValues coordinates;
    Image image = render(scene, &report.counts, cube ? &coordinates : nullptr).value();
    if (cube) report.texel_error = texel_error(scene, coordinates);
    return image;
}

std::vector<base::NamedFile> inputs_of(const RenderJob& job) {
    if (job.picture == PictureKind::mesh) return jobs::input_files(job, {{"job.points", job.points}});
    std::vector<base::NamedFile> inputs{{"job.image", job.image}};
    if (job.picture != PictureKind::scene) return inputs;
    inputs.push_back({"the scene", job.scene});
    for (const std::string& path : scene_files(job.scene)) inputs.push_back({"an image of the scene", path});
    return inputs;
}

}  // namespace

Result<RenderReport> render_files(const RenderJob& job) try {
    const ExactEnvironment environment;
    const bool mesh = job.picture == PictureKind::mesh, page = base::is_written_as(job.output, Use::page);
    if (mesh ? !is_figure_name(job.output) && !page : base::kind_of(job.output) != FormatKind::png)
        jobs::refuse_output(job.output, mesh ? base::suffix_list_written(Use::picture) + " or .html" : ".png");
    jobs::check_outputs(job, inputs_of(job), {{"job.output", job.output}});
    jobs::Stopwatch time;
    RenderReport report;
    if (job.picture == PictureKind::mesh) {
        draw_mesh(job, report);
    } else {
        write_png(job.output, draw_scene(job, report)).value();
    }
    report.picture = name(job.picture);
    report.output = job.output;
    report.seconds = time.lap();
    return report;
} catch (const Exception& e) {
    return e.error();
}

}  // namespace barycert
