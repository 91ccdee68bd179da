#include "app/jobs/mesh_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/jobs/field_files.hpp"
#include "app/jobs/job_files.hpp"
#include "barycert/environment.hpp"
#include "barycert/figure.hpp"
#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/raster.hpp"
#include "barycert/render_job.hpp"
#include "barycert/result.hpp"
#include "barycert/sampler.hpp"
#include "barycert/simplex.hpp"
#include "barycert/surface.hpp"
#include "barycert/table.hpp"
#include "core/base/range.hpp"
#include "core/base/strict_math.hpp"
#include "core/base/text.hpp"
#include "core/base/vectors.hpp"
#include "draw/viewer/page.hpp"
#include "files/format.hpp"
#include "mesh/part.hpp"
#include "mesh/pulling.hpp"
#include "mesh/surface/edges.hpp"
#include "mesh/surface/parts.hpp"

namespace barycert::jobs {
namespace {

using Vector = std::array<double, 3>;

constexpr Rgba dark_grey{40, 40, 40, 255}, marked_red{200, 16, 46, 255};
constexpr double thin = 0.7, thick = 1.4;

/// The part of the surface with normal.x <= offset. Points on edges are those that a slice has there, to the bit.
Surface behind(const Surface& whole, const Plane& plane) {
    const HalfSpace half{{-plane.normal[0], -plane.normal[1], -plane.normal[2]}, plane.offset};
    Surface out;
    out.dimension = whole.dimension;
    for (const Field& f : whole.point_fields) out.point_fields.push_back({f.name, f.components, {}});
    for (const Field& f : whole.cell_fields) out.cell_fields.push_back({f.name, f.components, {}});
    // Points by their ends; a point of the whole is both.
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> numbers;
    const auto row = [&](std::int32_t point) {
        const auto i = static_cast<std::size_t>(point);
        std::vector<double> all(whole.points.begin() + static_cast<std::ptrdiff_t>(3 * i),
                                whole.points.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
        for (const Field& f : whole.point_fields) all.push_back(f.data[i]);
        return all;
    };
    const auto add = [&](std::int32_t a, std::int32_t b, const std::vector<double>& at_point) {
        const auto [at, is_new] = numbers.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(out.point_count()));
        if (is_new) {
            out.points.insert(out.points.end(), at_point.begin(), at_point.begin() + 3);
            for (std::size_t k = 0; k < out.point_fields.size(); ++k)
                out.point_fields[k].data.push_back(at_point[3 + k]);
            out.mesh_edges.push_back(whole.mesh_edges[2 * static_cast<std::size_t>(a)]);
            out.mesh_edges.push_back(whole.mesh_edges[2 * static_cast<std::size_t>(b) + (a == b ? 1 : 0)]);
        }
        return at->second;
    };
    std::vector<bool> inside(whole.point_count());
    for (std::size_t i = 0; i < inside.size(); ++i) {
        const std::span<const double> at = std::span(whole.points).subspan(3 * i, 3);
        inside[i] = !clip_segment(3, at, at, half).value().empty;
    }
    for (std::size_t t = 0; t < whole.cell_count(); ++t) {
        std::vector<std::int32_t> polygon;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::int32_t a = whole.cells[3 * t + c], b = whole.cells[3 * t + (c + 1) % 3];
            const bool a_in = inside[static_cast<std::size_t>(a)], b_in = inside[static_cast<std::size_t>(b)];
            if (a_in) polygon.push_back(add(a, a, row(a)));
            if (a_in == b_in) continue;
            const ClippedSegment kept = clip_segment(3, row(a), row(b), half).value();
            if (kept.new_a || kept.new_b) polygon.push_back(add(a, b, kept.new_a ? kept.a : kept.b));
        }
        polygon.erase(std::unique(polygon.begin(), polygon.end()), polygon.end());
        for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
            out.cells.insert(out.cells.end(), {polygon[0], polygon[i], polygon[i + 1]});
            out.mesh_cells.push_back(whole.mesh_cells[t]);
            for (std::size_t k = 0; k < out.cell_fields.size(); ++k)
                out.cell_fields[k].data.push_back(whole.cell_fields[k].data[t]);
        }
    }
    return out;
}

/// The cells of a mesh in the plane.
Surface cells_of(const Mesh& mesh, const CutOptions& fields) {
    Surface surface = surface::facets_of(mesh);
    for (const Field* f : fields.point_fields) surface.point_fields.push_back(*f);
    for (const Field* f : fields.cell_fields) surface.cell_fields.push_back(*f);
    return surface;
}

FigureSurface coloured(const Surface& s) {
    FigureSurface out{.points = s.points, .triangles = s.cells};
    if (!s.point_fields.empty()) {
        out.point_values = s.point_fields.front().data;
    } else if (!s.cell_fields.empty()) {
        out.triangle_values = s.cell_fields.front().data;
    }
    return out;
}

}  // namespace

MeshFigure::MeshFigure(const Mesh& mesh, const SceneChoice& show, std::string colours, int threads, Notes& notes)
    : mesh_(&mesh), show_(show), colours_(std::move(colours)), threads_(threads), notes_(notes) {
    figure_.dimension = mesh.dimension;
    choose_cells();
}

/// By threshold and box.
void MeshFigure::choose_cells() {
    const Mesh& mesh = *mesh_;
    if (!show_.threshold && !show_.box) return;
    std::vector<bool> kept(mesh.cell_count(), true);
    const auto drop = [&](auto leaves_out) {
        for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = kept[i] && !leaves_out(i);
    };
    const auto d = static_cast<std::size_t>(mesh.dimension);
    if (show_.threshold) {
        const SceneChoice::Threshold& within = *show_.threshold;
        const FieldChoice of = field_of_numbers(mesh, within.field, made_, notes_);
        const std::vector<double>& data = of.field->data;
        const auto out = [&](double x) { return !(within.low <= x && x <= within.high); };
        drop([&](std::size_t i) {
            if (of.of_cells) return out(data[i]);
            const auto is_out = [&](Mesh::Index node) { return out(data[static_cast<std::size_t>(node)]); };
            return std::ranges::any_of(mesh.corners_of(i), is_out);
        });
    }
    if (show_.box) {
        const auto& box = *show_.box;
        drop([&](std::size_t i) {
            return std::ranges::any_of(mesh.corners_of(i), [&](Mesh::Index node) {
                const double* const p = mesh.point(node);
                bool inside = true;
                for (std::size_t k = 0; k < d; ++k) inside = inside && box.first[k] < p[k] && p[k] < box.second[k];
                return inside;
            });
        });
    }
    if (!mesh.cell_numbers.empty()) {
        // A cell of several parts goes with the first that is left out.
        std::vector<bool> whole(static_cast<std::size_t>(*std::ranges::max_element(mesh.cell_numbers)) + 1, true);
        for (std::size_t i = 0; i < kept.size(); ++i)
            if (!kept[i]) whole[static_cast<std::size_t>(mesh.cell_numbers[i])] = false;
        drop([&](std::size_t i) { return !whole[static_cast<std::size_t>(mesh.cell_numbers[i])]; });
    }
    std::vector<Mesh::Index> cells;
    for (std::size_t i = 0; i < kept.size(); ++i)
        if (kept[i]) cells.push_back(static_cast<Mesh::Index>(i));
    if (cells.empty())
        refuse("picture.empty", "", "no cell is left to draw", "a threshold or box that leaves some", "none");
    mesh::Submesh part = mesh::part_of(mesh, std::move(cells));
    chosen_ = std::move(part.mesh);
    nodes_ = part.nodes;
    if (chosen_.cell_numbers.empty()) chosen_.cell_numbers = part.cells;
    for (const Field& f : mesh.point_fields) chosen_.point_fields.push_back(mesh::rows_of(f, part.nodes));
    for (const Field& f : mesh.cell_fields) chosen_.cell_fields.push_back(mesh::rows_of(f, part.cells));
    mesh_ = &chosen_;
}

/// The field that colours.
CutOptions MeshFigure::carried() {
    CutOptions options{.threads = threads_};
    if (colours_.empty()) return options;
    shown_ = field_of_numbers(*mesh_, colours_, made_, notes_);
    (shown_.of_cells ? options.cell_fields : options.point_fields).push_back(shown_.field);
    return options;
}

viewer::PageScene MeshFigure::page(const FigureOptions& options) const {
    if (!figure_.arrows.empty() || !figure_.points.empty() || options.labels)
        refuse("option.unfit", "", "pages have no arrows, points or labels", "surfaces and lines", "",
               "name a file with one of " + base::suffix_list_written(base::Use::picture));
    viewer::PageScene scene{mesh_, drawn_, {}, {}, shown_.field, nodes_, figure(options)};
    const auto add = [](std::vector<const Field*>& to, const std::vector<Field>& fields) {
        for (const Field& f : fields) to.push_back(&f);
    };
    add(scene.point_fields, mesh_->point_fields);
    add(scene.cell_fields, mesh_->cell_fields);
    std::vector<const Field*>& of = shown_.of_cells ? scene.cell_fields : scene.point_fields;
    if (shown_.field != nullptr && std::ranges::count(of, shown_.field) == 0) of.push_back(shown_.field);
    // A cut would show a section of all the mesh.
    const bool some = show_.plane || !show_.slices.empty() || !show_.iso.empty() || !show_.marked.empty();
    if (some || !show_.surface) scene.most_cells = 0;
    return scene;
}

FigureCounts MeshFigure::write(const std::string& path, FigureOptions options) const {
    if (options.bar_title.empty()) options.bar_title = colours_.empty() ? show_.iso_field : colours_;
    FigureCounts counts;
    if (base::is_written_as(path, base::Use::page)) {
        viewer::write_page(path, page(options), counts).value();
    } else {
        write_figure(path, figure(options), &counts).value();
    }
    return counts;
}

void MeshFigure::add_mesh() {
    const CutOptions options = carried();
    const bool plane = mesh_->dimension == 2;
    for (const auto& [given, what] : {std::pair(show_.plane.has_value(), "a plane that cuts open"),
                                      {!show_.slices.empty(), "a slice"},
                                      {!show_.iso.empty(), "an iso-surface"}})
        if (given && plane)
            refuse("option.unfit", "", std::string(what) + " is of meshes in space", "", "triangles in the plane");
    for (const Plane& cut : show_.slices) add_cut(surface::section(*mesh_, cut, options).value().surface, "a slice");
    if (!show_.iso.empty()) {
        const FieldChoice of = field_of_numbers(*mesh_, show_.iso_field, made_, notes_);
        if (of.of_cells)
            refuse("field.location", "", "field \"" + show_.iso_field + "\" is one of cells", "a field of nodes", "");
        CutOptions carries = options;
        if (colours_.empty()) {
            shown_ = of;
            carries.point_fields.push_back(of.field);
        }
        for (const double value : show_.iso)
            add_cut(isosurface(*mesh_, *of.field, value, carries).value().surface, "the iso-surface of a value");
    }
    // Where something else is to be seen, the surface would hide it.
    const bool others = !show_.slices.empty() || !show_.iso.empty() || !show_.marked.empty();
    if (others && show_.plane)
        refuse("option.conflict", "", "cutting open by a plane is for the boundary", "",
               "slices, iso-surfaces or marked cells", "leave one of them out");
    if (show_.surface && !others) {
        Surface whole = plane ? cells_of(*mesh_, options) : boundary(*mesh_, options).value();
        add(show_.plane ? behind(whole, *show_.plane) : std::move(whole));
        if (show_.plane) add(slice(*mesh_, *show_.plane, options).value().surface);
    }
    if (!show_.marked.empty()) add_marked();
    if (!show_.arrows.empty()) add_arrows();
    if (!show_.points.empty()) add_points();
    if (show_.outline || !show_.marked.empty()) add_outline();
    if (figure_.surfaces.empty() && figure_.lines.empty() && figure_.arrows.empty() && figure_.points.empty())
        refuse("picture.empty", "", "nothing to draw", "a surface, lines, arrows or points", "none of these");
}

void MeshFigure::add_cut(Surface surface, const char* what) {
    if (surface.cells.empty())
        refuse("picture.empty", "", std::string(what) + " is empty", "one that cuts cells", "none", "choose another");
    add(std::move(surface));
}

void MeshFigure::add(Surface surface) {
    if (surface.cells.empty()) return;
    const Surface& kept = surfaces_.emplace_back(std::move(surface));
    figure_.surfaces.push_back(coloured(kept));
    drawn_.push_back({&kept});
    if (show_.edges) add_edges(kept);
}

void MeshFigure::add_section(Surface surface, const Vector& right, const Vector& up) {
    std::vector<double> flat;
    flat.reserve(surface.points.size() / 3 * 2);
    for (std::size_t i = 0; i < surface.points.size(); i += 3) {
        const Vector p{surface.points[i], surface.points[i + 1], surface.points[i + 2]};
        flat.push_back(base::dot(p, right) + 0.0);
        flat.push_back(base::dot(p, up) + 0.0);
    }
    figure_.dimension = 2;
    surface.points = std::move(flat);
    add(std::move(surface));
}

void MeshFigure::add_lines(const std::vector<double>& points, std::vector<std::int32_t> segments, double width,
                           Rgba colour) {
    if (segments.empty()) return;
    figure_.lines.push_back({points, indices_.emplace_back(std::move(segments)), width, colour});
}

/// True for an edge between two nodes, but not if it cuts a face of a cell in two, or lies in one.
bool MeshFigure::is_cell_edge(Mesh::Index cell, Mesh::Index a, Mesh::Index b) const {
    const auto& inside = mesh_->shapes.inside;
    if (inside.empty()) return true;
    const std::size_t corners = mesh_->corners();
    unsigned zeros = 0;
    for (std::size_t i = 0; i < corners; ++i) {
        const Mesh::Index node = mesh_->cells[corners * static_cast<std::size_t>(cell) + i];
        if (node != a && node != b) zeros |= 1U << i;
    }
    return mesh::feature_of_whole(inside[static_cast<std::size_t>(cell)], zeros, mesh_->dimension) == Feature::edge;
}

/// Adds the edges of cells where the surface is a boundary, and the edges where cells meet where it cuts through them.
void MeshFigure::add_edges(const Surface& surface) {
    std::vector<std::int32_t> segments;
    surface::for_edges(surface, [&](std::span<const surface::TriangleEdge> edge) {
        const auto cell_of = [&](const surface::TriangleEdge& e) {
            return surface.mesh_cells[static_cast<std::size_t>(e.second)];
        };
        const auto [a, b] = edge[0].first;
        std::set<Mesh::Index> nodes;
        for (const std::size_t p : {static_cast<std::size_t>(a), static_cast<std::size_t>(b)})
            nodes.insert({surface.mesh_edges[2 * p], surface.mesh_edges[2 * p + 1]});
        const bool same =
            edge.size() == 2 && mesh_->cell_number(cell_of(edge[0])) == mesh_->cell_number(cell_of(edge[1]));
        // An edge of the mesh, or a piece of one; or a line through facets and cells.
        if (nodes.size() == 2 ? is_cell_edge(cell_of(edge[0]), *nodes.begin(), *nodes.rbegin()) : !same)
            segments.insert(segments.end(), {a, b});
    });
    add_lines(figure_.dimension == 2 ? numbers_.emplace_back(surface.points) : surface.points, std::move(segments),
              thin, dark_grey);
}

void MeshFigure::add_outline() {
    Surface whole = boundary(*mesh_, {.threads = threads_}).value();
    const Surface& surface = surfaces_.emplace_back(show_.plane ? behind(whole, *show_.plane) : std::move(whole));
    add_lines(surface.points, surface::outline_of(surface), thick, dark_grey);
}

/// Cells by their numbers in the file, whole.
void MeshFigure::add_marked() {
    const std::set marked(show_.marked.begin(), show_.marked.end());
    std::set missing = marked;
    std::vector<Mesh::Index> cells;
    for (Mesh::Index i = 0; static_cast<std::size_t>(i) < mesh_->cell_count(); ++i) {
        if (!marked.contains(mesh_->cell_number(i))) continue;
        missing.erase(mesh_->cell_number(i));
        cells.push_back(i);
    }
    if (!missing.empty())
        refuse("option.value", "", "no such cell to mark",
               "numbers of cells that are drawn, as they are in the file, from 0", std::to_string(*missing.begin()));
    if (!colours_.empty() && figure_.surfaces.empty())
        refuse_member("option.unfit", "job.field", "", "nothing to colour by job.field",
                      "a surface beside marked cells, which are red", "none");
    Surface& surface = surfaces_.emplace_back(surface::facets_of(*mesh_, std::move(cells)));
    figure_.surfaces.push_back({.points = surface.points, .triangles = surface.cells, .colour = marked_red});
    drawn_.push_back({&surface, marked_red});
    if (show_.edges) add_edges(surface);
}

/// At points of what is drawn, or at nodes: one in each box of a grid.
void MeshFigure::add_arrows() {
    const auto d = static_cast<std::size_t>(mesh_->dimension);
    const auto found = std::ranges::find(mesh_->point_fields, show_.arrows, &Field::name);
    const std::string vectors = base::joined(mesh_->point_fields, ", ", [&](const Field& f) {
        return static_cast<std::size_t>(f.components) == d ? f.name : std::string();
    });
    if (found == mesh_->point_fields.end() || static_cast<std::size_t>(found->components) != d)
        refuse("field.location", "", "arrows are of a field of nodes",
               fmt::format("one of {} components, of which there is: {}", d, vectors.empty() ? "none" : vectors),
               '"' + show_.arrows + '"');
    std::array<base::Range, 3> all{};
    for (std::size_t i = 0; i < mesh_->points.size(); ++i) all[i % d].add(mesh_->points[i]);
    double volume = 1, longest = 0;
    for (std::size_t k = 0; k < d; ++k) longest = std::max(longest, 2 * all[k].half());
    for (std::size_t k = 0; k < d; ++k) volume *= std::max(2 * all[k].half(), longest / 1000);
    const double side = std::pow(volume / static_cast<double>(show_.arrow_count), 1 / static_cast<double>(d));
    // Takes only those points of a surface that are nodes.
    std::vector<std::size_t> nodes;
    for (const Surface& s : surfaces_)
        for (std::size_t i = 0; i < s.mesh_edges.size(); i += 2)
            if (s.mesh_edges[i] == s.mesh_edges[i + 1]) nodes.push_back(static_cast<std::size_t>(s.mesh_edges[i]));
    for (std::size_t i = 0; surfaces_.empty() && i < mesh_->point_count(); ++i) nodes.push_back(i);
    std::map<std::array<std::int64_t, 3>, std::size_t> boxes;
    for (const std::size_t node : nodes) {
        std::array<std::int64_t, 3> box{};
        bool finite = true;
        for (std::size_t k = 0; k < d; ++k) {
            box[k] = static_cast<std::int64_t>(std::floor((mesh_->points[d * node + k] - all[k].low) / side));
            finite = finite && std::isfinite(found->data[d * node + k]);
        }
        if (finite) boxes.try_emplace(box, node);
    }
    const bool by_value = figure_.surfaces.empty() && shown_.field != nullptr;
    if (by_value && shown_.of_cells)
        refuse("field.location", "", "arrows have colours of a field of nodes", "one", base::quoted(colours_));
    std::vector<double>&points = numbers_.emplace_back(), &numbers = numbers_.emplace_back(),
    &values = numbers_.emplace_back();
    for (const auto& [box, node] : boxes) {
        for (std::size_t k = 0; k < d; ++k) {
            points.push_back(mesh_->points[d * node + k]);
            numbers.push_back(found->data[d * node + k]);
        }
        if (by_value) values.push_back(shown_.field->data[node]);
    }
    figure_.arrows.push_back(
        {.points = points, .vectors = numbers, .values = values, .longest = 1.2 * side, .colour = dark_grey});
}

/// In the cells that were chosen.
void MeshFigure::add_points() {
    FigurePoints& of = figure_.points.emplace_back(
        FigurePoints{.points = show_.points, .size = show_.point_size, .colour = dark_grey});
    if (shown_.field == nullptr) return;
    const Locator locator = Locator::build(*mesh_, show_.location).value();
    const Table rows = Sampler::build(locator, {shown_}).value().sample(show_.points, {.threads = threads_}).value();
    of.values = numbers_.emplace_back(rows.values);
    if (const std::uint64_t none = rows.counts.locations.outside; none != 0)
        notes_.push_back(
            {.text = fmt::format("values of {} of {} points, which lie in no cell: grey", none, rows.cells.size())});
}

}  // namespace barycert::jobs

namespace barycert {

Status write_mesh_figure(const std::string& path, const Mesh& mesh, const SceneChoice& show, const std::string& field,
                         const FigureOptions& options) try {
    const ExactEnvironment environment;
    Notes notes;
    jobs::MeshFigure figure(mesh, show, field, 0, notes);
    figure.add_mesh();
    (void)figure.write(path, options);
    return Done{};
} catch (const Exception& e) {
    return e.error();
}

}  // namespace barycert
