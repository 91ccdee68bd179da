// Where in the mesh the exhibits are.

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <deque>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/report/check/check_measures.hpp"
#include "app/report/check/check_pictures.hpp"
#include "app/report/check/check_words.hpp"
#include "app/report/common/terminal_text.hpp"
#include "barycert/check.hpp"
#include "barycert/defect.hpp"
#include "barycert/figure.hpp"
#include "barycert/mesh.hpp"
#include "barycert/raster.hpp"
#include "barycert/result.hpp"
#include "barycert/surface.hpp"
#include "core/base/text.hpp"
#include "draw/layout.hpp"
#include "draw/picture.hpp"
#include "draw/viewer/page.hpp"
#include "mesh/part.hpp"
#include "mesh/surface/edges.hpp"

namespace barycert::report {
namespace {

/// The cells that have a boundary: others could not be asked for their facets.
mesh::Submesh proper_cells(const CheckReport& r, const Mesh& mesh) {
    std::vector<Mesh::Index> cells;
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        const auto all = mesh.corners_of(cell);
        const bool twice = std::ranges::any_of(all, [&](Mesh::Index i) { return std::ranges::count(all, i) != 1; });
        if (drawable(mesh, cell) && !twice) cells.push_back(static_cast<Mesh::Index>(cell));
    }
    mesh::Submesh part = mesh::part_of(mesh, std::move(cells));
    part.mesh.cell_numbers.clear();
    for (const Mesh::Index cell : part.cells)
        part.mesh.cell_numbers.push_back(static_cast<Mesh::Index>(r.cell_number(cell)));
    return part;
}

Vector point_at(const Mesh& mesh, Mesh::Index node) {
    const double* const p = mesh.point(node);
    return {p[0], p[1], mesh.dimension == 2 ? 0 : p[2]};
}

Vector middle_of(const Mesh& mesh, Mesh::Index cell) {
    Vector middle = Vector::Zero();
    for (const Mesh::Index node : mesh.corners_of(static_cast<std::size_t>(cell)))
        middle += point_at(mesh, node) / static_cast<double>(mesh.corners());
    return middle;
}

/// The box of all cells that have a place.
Eigen::AlignedBox3d box_of(const Mesh& mesh) {
    Eigen::AlignedBox3d box;
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        if (!drawable(mesh, cell)) continue;
        for (const Mesh::Index node : mesh.corners_of(cell)) box.extend(point_at(mesh, node));
    }
    return box;
}

/// Returns the cells with defects.
std::vector<Mesh::Index> problem_cells(const CheckReport& r, const Mesh& mesh) {
    DefectSet breaking = 0;
    for (const DefectText& t : defect_texts) {
        if (t.breaks) breaking |= defect_bit(t.kind);
    }
    std::vector<Mesh::Index> cells;
    for (std::size_t cell = 0; cell < r.measures.defects.size(); ++cell) {
        if ((r.measures.defects[cell] & breaking) != 0 && drawable(mesh, cell))
            cells.push_back(static_cast<Mesh::Index>(cell));
    }
    return cells;
}

/// The exhibits by their numbers, and the middle of the first cell of each.
std::string legend(const CheckReport& r, const Mesh& mesh, const std::vector<Exhibit>& exhibits) {
    std::string out = "<table><tr><th></th><th>cells</th><th>middle of the first one</th></tr>\n";
    for (std::size_t i = 0; i < exhibits.size(); ++i) {
        const Exhibit& e = exhibits[i];
        const auto number = [](Mesh::Index c) { return c < 0 ? "" : std::to_string(c); };
        const auto rounded = [](double x) { return fmt::format("{:.4g}", x + 0.0); };
        out += fmt::format("<tr><td><span class=\"badge{}\">{}</span></td><td>{}</td><td>({})</td></tr>\n",
                           e.defect ? " problem" : "", i + 1, joined(r.cell_number(e.cells), ", ", number),
                           coordinates(middle_of(mesh, e.cells[0]), mesh.dimension, rounded));
    }
    return out + "</table>\n";
}

std::string extent(const Eigen::AlignedBox3d& box, int d) {
    return joined(std::span("xyz").first(static_cast<std::size_t>(d)), ", ", [&](char axis) {
        const auto k = axis - 'x';
        return fmt::format("{} from {} to {}", axis, base::shortest(box.min()[k]), base::shortest(box.max()[k]));
    });
}

constexpr Rgba red{200, 16, 46, 255}, blue{0, 114, 178, 255}, grey{128, 128, 128, 255};

/// The mesh with these cells: it turns, if that is not too much for a page.
std::string picture_of(const CheckReport& r, const Mesh& mesh, const std::vector<Exhibit>& exhibits, bool& turns) {
    const bool all = std::ranges::none_of(r.defects, leaves_cells_out), plane = mesh.dimension == 2;
    const mesh::Submesh part = all ? mesh::Submesh() : proper_cells(r, mesh);
    const Mesh& proper = all ? mesh : part.mesh;
    const auto facets = [&](std::vector<Mesh::Index> cells) {
        std::vector<Mesh::Index> own;
        std::ranges::sort(cells);
        for (const Mesh::Index cell : cells) {
            const auto at = std::ranges::lower_bound(part.cells, cell);
            if (all || (at != part.cells.end() && *at == cell))
                own.push_back(all ? cell : static_cast<Mesh::Index>(at - part.cells.begin()));
        }
        return surface::facets_of(proper, std::move(own));
    };
    const Result<Surface> hull = boundary(proper, {.threads = r.threads});
    if (!hull || hull->cells.empty()) return "";
    const Surface skin = plane ? surface::facets_of(proper) : Surface();
    viewer::PageScene scene{&proper, {{plane ? &skin : &*hull, {}, !plane}}};
    scene.figure = {.dimension = mesh.dimension, .options = {.size = {640, 460}, .background{}, .bar = false}};
    const auto segments = surface::outline_of(*hull);
    scene.figure.lines = {{hull->points, segments, 1, grey}};
    scene.nodes = part.nodes;
    const std::vector<Mesh::Index> problems = problem_cells(r, mesh);
    std::vector<Mesh::Index> rest;
    for (const Exhibit& e : exhibits) {
        if (!e.defect && !std::ranges::binary_search(problems, e.cells[0])) rest.push_back(e.cells[0]);
        const Vector at = middle_of(mesh, e.cells[0]);
        scene.labels.push_back({{at[0], at[1], at[2]}, std::to_string(&e - exhibits.data() + 1), e.defect});
    }
    const Surface bad = facets(problems), worst = facets(rest);
    for (const auto& [cells, colour] : {std::pair(&bad, red), {&worst, blue}}) {
        if (cells->cells.empty()) continue;
        scene.surfaces.push_back({cells, colour});
        scene.figure.surfaces.push_back({.points = cells->points, .triangles = cells->cells, .colour = colour});
    }
    FigureCounts counts;
    const Result<Picture> still = laid_out(scene.figure, Form::image, counts);
    std::string markup = still ? svg_markup(*still) : "";
    constexpr std::size_t most_triangles = 200000;
    turns = scene.surfaces.front().surface->cell_count() <= most_triangles;
    if (!turns) return markup;
    std::deque<Field> fields;
    for (Measure& m : measures_of(r)) {
        const Field& f = fields.emplace_back(Field{m.name, 1, std::move(m.values)});
        if (!all) fields.back() = mesh::rows_of(f, part.cells);
        scene.cell_fields.push_back(&fields.back());
    }
    if (bad.cells.empty()) scene.field = &fields[4];
    scene.see_through = !bad.cells.empty();
    scene.most_cells = 10000;  // with six measures each
    return viewer::turning_figure(scene, markup);
}

}  // namespace

std::string exhibit_map(const CheckReport& r, const Mesh& mesh, const std::vector<Exhibit>& exhibits) {
    const Eigen::AlignedBox3d box = box_of(mesh);
    if (box.isEmpty()) return "";
    bool turns = false;
    const std::string picture = picture_of(r, mesh, exhibits, turns);
    std::string drawn = turns || picture.empty() ? "" : " The mesh is too large to turn on a page.";
    const bool defects = exhibits.front().defect, others = !exhibits.back().defect;
    if (defects) drawn += " Red: cells with defects.";
    if (others) drawn += " Blue: the cells with the smallest angles, which need not be wrong";
    if (others) drawn += mesh.dimension == 3 ? ", and may lie inside." : ".";
    return fmt::format(
        "<div class=\"map\">{}<div>{}</div></div>\n<p class=\"small\">The box of the cells: {}.{} Those with numbers "
        "are drawn below.</p>\n",
        picture, legend(r, mesh, exhibits), extent(box, mesh.dimension), drawn);
}

}  // namespace barycert::report
