// Iso-surfaces, iso-lines and slices, to files of surfaces and pictures.

#include "barycert/contour_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "app/jobs/field_files.hpp"
#include "app/jobs/job_files.hpp"
#include "app/jobs/mesh_figure.hpp"
#include "barycert/environment.hpp"
#include "barycert/error_codes.hpp"
#include "barycert/figure.hpp"
#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/raster.hpp"
#include "barycert/render_job.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/surface.hpp"
#include "barycert/table.hpp"
#include "core/base/strict_math.hpp"
#include "core/base/text.hpp"
#include "core/base/vectors.hpp"
#include "files/format.hpp"
#include "files/input_file.hpp"
#include "mesh/index/box_tree.hpp"
#include "mesh/sample/quantity/quantities.hpp"
#include "mesh/surface/parts.hpp"
#include "mesh/threads/arena.hpp"

namespace barycert {

using base::Use;
namespace {

using base::cross, base::dot, base::shortest;
using jobs::refuse;
using jobs::refuse_member;
using jobs::Stopwatch;
using jobs::tell_stage;
using Vector = std::array<double, 3>;

bool is_picture(const ContourJob& job) {
    return is_figure_name(job.output);
}

void check_job(const ContourJob& job) {
    if (job.value.has_value() == job.plane.has_value())
        refuse(job.value ? ErrorCode("option.conflict") : ErrorCode("option.missing"), "", "what to cut at",
               "a value or a plane", job.value ? "both" : "neither");
    const bool picture = is_picture(job);
    if (!picture && !base::is_written_as(job.output, Use::surface))
        jobs::refuse_output(job.output, "a surface (" + base::suffix_list_written(Use::surface) + ") or a picture (" +
                                            base::suffix_list_written(Use::picture) + ")");
    for (const auto& [member, given] :
         {std::pair("job.colours", !job.colours.empty()), {"job.range", !!job.figure.range}}) {
        if (!picture && given)
            refuse_member("option.unfit", std::string(member), "", std::string(member) + " is for pictures", "", "",
                          "leave it out, or name a .png file");
    }
    if (job.field.empty() && (picture || job.value))
        refuse_member("option.missing", "job.field", "",
                      picture ? "a picture shows a field" : "which field has the value", "job.field NAME", "none");
    if (job.plane && !picture && !job.field.empty() && !job.fields.empty())
        refuse_member("option.conflict", "job.fields", "", "job.field and job.fields", "one of them", "",
                      "job.fields names several");
    if (picture && !job.fields.empty())
        refuse_member("option.unfit", "job.fields", "", "job.fields cannot be combined with a picture", "", "",
                      "job.field names what it shows");
    jobs::check_vtk_data(job.vtk_data, job.output);
    if (job.width < 1 || job.width > 1000000)
        refuse_member("option.value", "job.width", "", "job.width", "1 to 1000000", std::to_string(job.width));
    jobs::check_files(job, {}, {{"job.output", job.output}});
}

/// Sets low and high to those of at(node) over the nodes of cells.
template <class At>
void set_range(const Mesh& mesh, At at, ContourReport& report) {
    using Range = std::pair<double, double>;
    Range range = base::parallel_reduce(
        mesh.cells.size(), std::size_t{1} << 15, Range{HUGE_VAL, -HUGE_VAL},
        [&](std::size_t begin, std::size_t end, Range& so_far) {
            const ExactEnvironment environment;  // threads that were there before have theirs
            for (std::size_t i = begin; i != end; ++i) {
                const double x = at(static_cast<std::size_t>(mesh.cells[i]));
                if (std::isfinite(x)) so_far = {std::min(so_far.first, x), std::max(so_far.second, x)};
            }
        },
        [](Range& all, const Range& part) {
            all = {std::min(all.first, part.first), std::max(all.second, part.second)};
        });
    if (range.first > range.second) range.first = range.second = std::numeric_limits<double>::quiet_NaN();
    // A zero may come with either sign, as threads come.
    report.low = range.first + 0.0;
    report.high = range.second + 0.0;
}

constexpr std::int64_t max_pixels = std::int64_t{1} << 27;

/// Axes of the picture, to the right and up, and the point of the plane nearest to the origin.
struct Frame {
    Vector right, up, foot;

    explicit Frame(const Plane& plane) {
        const Vector n = base::unit(plane.normal);
        const bool level = n[0] == 0 && n[1] == 0;
        const Vector vertical = level ? Vector{0, 1, 0} : Vector{0, 0, 1};
        const double along = dot(vertical, n);
        up = base::unit({vertical[0] - along * n[0], vertical[1] - along * n[1], vertical[2] - along * n[2]});
        right = cross(up, n);
        // offset / |normal|, of halves, for the length may be too large a number.
        const Vector& m = plane.normal;
        const double distance = 0.5 * plane.offset / dot({0.5 * m[0], 0.5 * m[1], 0.5 * m[2]}, n);
        foot = {distance * n[0], distance * n[1], distance * n[2]};
        for (Vector* const v : {&right, &up, &foot}) {
            for (double& x : *v) x += 0.0;  // no -0
        }
    }
};

/// Pixels over the box of these points (3 coordinates each) of a section. Error: it has no area, or too many pixels.
Result<PixelGrid> pixels_over(const Plane& plane, const std::vector<double>& points, std::int64_t width) {
    const Frame frame(plane);
    index::Box box = index::empty_box;
    for (std::size_t i = 0; i < points.size(); i += 3) {
        const Vector x = base::minus({points[i], points[i + 1], points[i + 2]}, frame.foot);
        const Vector at{dot(x, frame.right), dot(x, frame.up), 0};
        box.add({at, at});
    }
    const auto& [low, high] = box;
    const double across = high[0] - low[0], tall = high[1] - low[1];
    if (!(across > 0) || !(tall > 0) || !std::isfinite(across) || !std::isfinite(tall))
        return about(
            "job.plane",
            file_error("surface.empty", "", "the section has no area", "a plane that goes through the mesh",
                       points.empty() ? "no cell on both sides of it" : "a point or a line", "choose another offset"));
    PixelGrid grid;
    grid.width = width;
    grid.pixel = across / static_cast<double>(width);
    const double lines = std::max(1.0, std::round(tall / grid.pixel));
    if (!(lines * static_cast<double>(width) <= static_cast<double>(max_pixels)) || !(grid.pixel > 0))
        return about("job.width",
                     file_error("picture.too-large", "", "the picture would be too large",
                                "at most " + std::to_string(max_pixels) + " pixels",
                                std::to_string(width) + " by " + base::shortest(lines), "choose a smaller job.width"));
    grid.height = static_cast<std::int64_t>(lines);
    // Lines are centred in the box.
    const double first[2] = {low[0] + 0.5 * grid.pixel, low[1] + 0.5 * (tall - (lines - 1) * grid.pixel)};
    for (std::size_t k = 0; k < 3; ++k) {
        grid.origin[k] = frame.foot[k] + first[0] * frame.right[k] + first[1] * frame.up[k];
        grid.step_right[k] = grid.pixel * frame.right[k];
        grid.step_up[k] = grid.pixel * frame.up[k];
    }
    return grid;
}

class Contour {
public:
    explicit Contour(const ContourJob& job) : job_(job) { show_.edges = job.edges; }

    ContourReport run() {
        Stopwatch whole, watch;
        mesh_ = jobs::open_mesh_with_fields(job_, job_.threads, report_);
        report_.seconds.mesh = watch.lap();
        report_.field = job_.field;
        report_.output = job_.output;
        report_.value = job_.value;
        report_.plane = job_.plane;
        const bool picture = is_picture(job_);
        if (job_.plane && mesh_.dimension == 2)
            refuse("mesh.dimension", job_.mesh, "a plane cuts meshes of tetrahedra", "", "triangles in the plane",
                   "draw a mesh of triangles by `" + job_.program + " resample --grid`");
        if (picture && job_.value && mesh_.dimension == 2)
            refuse_member("option.unfit", "job.output", job_.output, "iso-lines cannot be written as a picture",
                          ".vtp or .ply", "", "choose another name");
        const bool exact = picture && job_.plane && (job_.figure.samples == 1 || is_computed_at_points());
        if (exact && job_.edges)
            refuse_member("option.unfit", "job.edges", "",
                          "edges of cells are drawn over triangles, not over values at pixels", "more than one sample",
                          "one, or a field that is computed at each point");
        Cut cut = exact ? cut_plane({.threads = job_.threads}) : cut_with_fields();
        report_.counts = cut.counts;
        report_.points = cut.surface.point_count();
        report_.parts = cut.surface.cell_count();
        report_.seconds.build = watch.lap();
        if (!picture) {
            write(cut.surface);
        } else if (job_.plane) {
            draw_section(std::move(cut.surface), exact);
        } else {
            draw_view(std::move(cut.surface));
        }
        report_.seconds.total = whole.lap();
        return std::move(report_);
    }

private:
    /// A quantity that is computed at each point, such as a length, is no interpolation of what the nodes have.
    bool is_computed_at_points() const {
        return sample::shape_of(mesh_, sample::number_named(mesh_, job_.field).value()).value().at_points;
    }

    Cut cut_plane(const CutOptions& options) {
        tell_stage(job_, "cutting");
        const auto height = [&](std::size_t i) {
            const double* const x = mesh_.points.data() + 3 * i;
            return dot(job_.plane->normal, {x[0], x[1], x[2]});
        };
        set_range(mesh_, height, report_);
        return surface::section(mesh_, *job_.plane, options).value();
    }

    Cut cut_with_fields() {
        CutOptions options{.threads = job_.threads};
        const auto carry = [&](const FieldChoice& c, const std::string& name) {
            (c.of_cells ? options.cell_fields : options.point_fields).push_back(c.field);
            report_.fields.push_back(name);
        };
        // To carry along, a field need not be one number.
        std::vector<FieldChoice> chosen =
            is_picture(job_) ? std::vector<FieldChoice>()
                             : sample::quantities_named(
                                   mesh_, job_.plane && !job_.field.empty() ? std::vector{job_.field} : job_.fields)
                                   .value();
        sample::make_all_fields(mesh_, chosen, made_, report_.notes).value();
        // A picture needs the field that colours it, and no other.
        const std::string& colours = job_.plane ? job_.field : job_.colours;
        if (!is_picture(job_)) {
            for (const FieldChoice& c : chosen) carry(c, c.field->name);
        } else if (!colours.empty()) {
            carry(jobs::field_of_numbers(mesh_, colours, made_, report_.notes), colours);
        }
        if (job_.plane) return cut_plane(options);
        const FieldChoice column = jobs::field_of_numbers(mesh_, job_.field, made_, report_.notes);
        const Field& field = *column.field;
        if (column.of_cells)
            refuse_member("field.location", "job.field", "", "field \"" + job_.field + "\" is one of cells",
                          "a field of nodes", "a number for each cell",
                          "a field of cells jumps from cell to cell: there is no surface on which it has a value");
        tell_stage(job_, "cutting");
        const auto value = [&](std::size_t i) { return field.data[i]; };
        set_range(mesh_, value, report_);
        Result<Cut> cut = mesh_.dimension == 2 ? isoline(mesh_, field, *job_.value, options)
                                               : isosurface(mesh_, field, *job_.value, options);
        return std::move(cut).value();
    }

    void write(Surface& surface) {
        Stopwatch watch;
        for (Mesh::Index& cell : surface.mesh_cells) cell = mesh_.cell_number(cell);
        tell_stage(job_, "writing " + job_.output);
        report_.file = write_surface(surface, job_.output, job_.vtk_data.value_or(VtkData::raw)).value();
        std::erase_if(report_.fields,
                      [&](const std::string& name) { return std::ranges::count(report_.file.left_out, name) != 0; });
        report_.seconds.write = watch.lap();
    }

    /// The section has no area, or too much: told with planes that cut the mesh.
    [[noreturn]] void refuse_section(const Surface& section, Error error) const {
        error.file = job_.mesh;
        if (!section.points.empty()) throw Exception(error);
        const auto& [n, at] = *job_.plane;
        const double low = report_.low, high = report_.high;
        const bool touches = at == low || at == high;
        error.found =
            fmt::format("D = {}, {} the cells are from {} to {}", shortest(at),
                        touches ? "a plane that only touches the boundary:" : "where", shortest(low), shortest(high));
        const double inwards = at == low ? low + (high - low) / 1000 : high - (high - low) / 1000;
        const auto axis = static_cast<std::size_t>(std::find(n.begin(), n.end(), 1.0) - n.begin());
        const bool along_axis = axis < 3 && std::count(n.begin(), n.end(), 0.0) == 2;
        error.remedy = fmt::format("{}: job.plane {}{}", touches ? "move it inwards" : "choose D between them",
                                   along_axis ? std::string{"xyz"[axis], '='} : normal_text() + ',',
                                   shortest(touches ? inwards : low / 2 + high / 2));
        throw Exception(error);
    }

    std::string normal_text() const { return base::joined(job_.plane->normal, ",", shortest); }

    /// Axes, and names of axes, of the plane.
    FigureOptions options_of(const Frame& frame) const {
        FigureOptions options = job_.figure;
        if (options.bar_title.empty()) options.bar_title = job_.field;
        if (options.title.empty() && options.axes != Axes::none)
            options.title = fmt::format("plane {},{}", normal_text(), shortest(job_.plane->offset));
        const auto name = [](const Vector& along) -> std::string {
            for (std::size_t k = 0; k < 3; ++k)
                if (std::fabs(along[k]) == 1) return std::string(along[k] < 0 ? "-" : "") + "xyz"[k];
            return fmt::format("along ({:.3g}, {:.3g}, {:.3g})", along[0], along[1], along[2]);
        };
        options.axis_names = {name(frame.right), name(frame.up)};
        const auto& n = job_.plane->normal;
        for (std::size_t k = 0; k < 3; ++k)
            if (job_.figure.title.empty() && std::count(n.begin(), n.end(), 0.0) == 2 && n[k] == 1)
                options.title = fmt::format("{} = {}", "xyz"[k], shortest(job_.plane->offset + 0.0));
        return options;
    }

    void draw_section(Surface section, bool exact) {
        Stopwatch watch;
        const Frame frame(*job_.plane);
        const Result<PixelGrid> over = pixels_over(*job_.plane, section.points, job_.width);
        if (!over) refuse_section(section, over.error());
        const PixelGrid& pixels = report_.pixels.emplace(*over);
        FigureOptions options = options_of(frame);
        report_.fields = {job_.field};
        if (exact) return draw_values(pixels, frame, options);
        if (std::max(pixels.width, pixels.height) > max_raster_side)
            refuse_member("picture.too-large", "job.width", job_.output, "the picture would be too large",
                          fmt::format("at most {} pixels a side", max_raster_side),
                          fmt::format("{} by {}", pixels.width, pixels.height), "choose a smaller job.width");
        options.window = {static_cast<std::int32_t>(pixels.width), static_cast<std::int32_t>(pixels.height)};
        tell_stage(job_, "drawing");
        jobs::MeshFigure figure(mesh_, show_, job_.field, job_.threads, report_.notes);
        figure.add_section(std::move(section), frame.right, frame.up);
        report_.drawn = figure.write(job_.output, options);
        if (std::isnan(report_.drawn.low)) refuse_empty(pixels);
        report_.view = options.window;
        report_.colours = job_.field;
        report_.seconds.sample = watch.lap();
    }

    [[noreturn]] void refuse_empty(const PixelGrid& pixels) const {
        refuse_member("picture.empty", "job.width", job_.output, "nothing to draw",
                      "a pixel whose middle is in the mesh, where the field is finite",
                      fmt::format("{} x {} pixels without one", pixels.width, pixels.height),
                      "give more pixels, job.width N, or another field");
    }

    /// The exact values at the middles of pixels.
    void draw_values(const PixelGrid& pixels, const Frame& frame, const FigureOptions& of) {
        Stopwatch watch;
        const auto count = static_cast<std::uint64_t>(pixels.width * pixels.height);
        BuildOptions options = jobs::build_options(job_, job_.threads);
        options.curved = Curved::straight;  // as the report says, and as the other pictures are
        const Locator locator = Locator::build(mesh_, options).value();
        const FieldChoice column = sample::number_named(mesh_, job_.field).value();
        const Sampler sampler = Sampler::build(locator, {column}).value();
        std::vector<double> values(count);
        std::vector<std::uint8_t> valid(count);
        sample(pixels, sampler, values, valid);
        report_.seconds.sample = watch.lap();
        if (std::none_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); })) refuse_empty(pixels);
        tell_stage(job_, "writing " + job_.output);
        Figure figure{.dimension = 2, .options = of};
        figure.grid = {.width = static_cast<std::size_t>(pixels.width),
                       .height = static_cast<std::size_t>(pixels.height),
                       .values = values,
                       .valid = valid,
                       .origin = {dot(pixels.origin, frame.right), dot(pixels.origin, frame.up)},
                       .spacing = {pixels.pixel, pixels.pixel}};
        write_figure(job_.output, figure, &report_.drawn).value();
        report_.seconds.write = watch.lap();
    }

    void draw_view(Surface surface) {
        if (surface.cells.empty())
            refuse_member("surface.empty", "job.value", job_.output, "the iso-surface is empty",
                          fmt::format("a value from {} to {}", shortest(report_.low), shortest(report_.high)),
                          shortest(*job_.value), "choose another value");
        Stopwatch watch;
        tell_stage(job_, "drawing");
        jobs::MeshFigure figure(mesh_, show_, job_.colours, job_.threads, report_.notes);
        figure.add(std::move(surface));
        if (job_.outline) figure.add_outline();
        report_.view = job_.figure.size;
        report_.colours = job_.colours;
        report_.drawn = figure.write(job_.output, job_.figure);
        report_.seconds.sample = watch.lap();
    }

    /// Lines of pixels at a time, so that memory is that of the values.
    void sample(const PixelGrid& pixels, const Sampler& sampler, std::vector<double>& values,
                std::vector<std::uint8_t>& valid) {
        const std::int64_t some = pixels.width * std::max<std::int64_t>(1, (std::int64_t{1} << 18) / pixels.width);
        const SampleOptions options{.threads = job_.threads};
        std::vector<double> points;
        Table rows;
        for (std::int64_t at = 0, all = pixels.width * pixels.height; at < all;) {
            points.clear();
            for (std::int64_t i = at; i < std::min(at + some, all); ++i) {
                const std::array<double, 3> x = pixels.middle(i % pixels.width, i / pixels.width);
                points.insert(points.end(), x.begin(), x.end());
            }
            sampler.sample(points, options, rows).value();
            report_.samples.add(rows.counts);
            for (std::size_t r = 0; r < rows.row_count(); ++r, ++at) {
                values[static_cast<std::size_t>(at)] = rows.value(r, 0);
                valid[static_cast<std::size_t>(at)] = rows.cells[r] >= 0 ? 1 : 0;
            }
            tell_stage(job_, fmt::format("pixels of {}", all), static_cast<std::uint64_t>(at));
        }
    }

    const ContourJob& job_;
    SceneChoice show_;
    Mesh mesh_;
    ContourReport report_;
    std::deque<Field> made_;
};

}  // namespace

std::array<double, 3> PixelGrid::middle(std::int64_t i, std::int64_t j) const {
    const ExactEnvironment environment;
    std::array<double, 3> at{};
    for (std::size_t k = 0; k < 3; ++k)
        at[k] = base::held((base::held(origin[k]) + static_cast<double>(i) * base::held(step_right[k])) +
                           static_cast<double>(j) * base::held(step_up[k]));
    return at;
}

Result<ContourReport> contour_files(const ContourJob& job) try {
    const ExactEnvironment environment;
    const base::RunFiles run_files;
    check_job(job);
    const jobs::ThreadLimit limit(job.threads);
    return Contour(job).run();
} catch (const Exception& e) {
    return e.error();
}

}  // namespace barycert
