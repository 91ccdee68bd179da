// Pictures of cells.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/report/check/check_pictures.hpp"
#include "barycert/check.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh.hpp"
#include "core/base/finite.hpp"
#include "draw/picture.hpp"

namespace barycert::report {
namespace {

constexpr double width = 240, height = 184, margin = 34, top = 20;

struct Shown {
    std::string title;
    View view;
    double stretch = 1;  ///< of what is drawn upwards
};

/// Contents of a card: normalised vertices of one or two cells, and a common point.
struct Scene {
    std::size_t corners = 4;
    std::vector<Vector> points;
    std::vector<Mesh::Index> nodes;
    std::optional<Vector> common;

    Points cell(std::size_t i) const { return Points(points).subspan(i * corners, corners); }
    std::size_t cells() const { return points.size() / corners; }
};

Scene scene_of(const Mesh& mesh, const Exhibit& e) {
    Scene scene;
    scene.corners = mesh.corners();
    std::vector<const double*> at;
    for (const Mesh::Index cell : e.cells) {
        if (cell < 0) continue;
        for (const Mesh::Index node : mesh.corners_of(static_cast<std::size_t>(cell))) {
            scene.nodes.push_back(node);
            at.push_back(mesh.point(node));
        }
    }
    const Normalised normalised(mesh.dimension, at);
    scene.points = normalised.points();
    if (e.contact != nullptr && base::all_finite(e.contact->common.point))
        scene.common = normalised.place(e.contact->common.point.data());
    return scene;
}

Eigen::AlignedBox2d frame(const Scene& scene, const View& view) {
    Eigen::AlignedBox2d box;
    for (const Vector& p : scene.points) box.extend(view(p).head<2>());
    return box;
}

std::vector<Shown> views_of(const Mesh& mesh, const Scene& scene) {
    std::vector<Shown> views;
    if (mesh.dimension == 2) {
        views.push_back({"as it lies", {}});
        const View along = broad_view(scene.points, 1);  // the longest way to the right
        const Eigen::Vector2d size = frame(scene, along).sizes();
        if (size[1] < 0.1 * size[0] && size[1] > 0) {
            const double factor = 0.5 * size[0] / size[1];
            views.push_back({fmt::format("turned, stretched {:.2g}-fold upwards", factor), along, factor});
        }
        return views;
    }
    if (scene.cells() == 1) {
        const auto edge = sharpest_edge(scene.points);
        const Mesh::Index from = scene.nodes[edge[0]], to = scene.nodes[edge[1]];
        if (from != to) views.push_back({fmt::format("along edge {}–{}", from, to), along_edge(scene.points, edge)});
    }
    if (views.empty()) views.push_back({"from the side", broad_view(scene.points, 0)});
    views.push_back({"from above", broad_view(scene.points, 1)});
    return views;
}

/// Pixels for the numbers of a view.
struct Placing {
    const Shown& shown;
    Eigen::Vector2d middle;
    double scale;

    Pixel operator()(const Vector& p) const {
        const Vector q = shown.view(p);
        return {width / 2 + scale * (q[0] - middle[0]),
                top + (height - top) / 2 - scale * shown.stretch * (q[1] - middle[1])};
    }
};

/// Faces towards the eye are filled; edges of none of them are dashed.
void draw_tetrahedron(Picture& svg, const Placing& at, Points t, std::string_view colour) {
    const auto facing = [&](std::size_t corner) {  // the face opposite to it
        const Vector &a = t[(corner + 1) % 4], &b = t[(corner + 2) % 4], &c = t[(corner + 3) % 4];
        const Vector n = (b - a).cross(c - a);
        return n.dot(at.shown.view.z) * (n.dot(t[corner] - a) > 0 ? -1 : 1) > -1e-12;
    };
    const double volume = (t[1] - t[0]).cross(t[2] - t[0]).dot(t[3] - t[0]);
    const bool flat = std::fabs(volume) < 1e-15;  // of a cell of size 1: no edge is behind another
    std::array<bool, 4> front{};
    for (std::size_t i = 0; i < 4; ++i) {
        front[i] = flat || facing(i);
        if (front[i])
            svg.area({at(t[(i + 1) % 4]), at(t[(i + 2) % 4]), at(t[(i + 3) % 4])}, fmt::format("face {}", colour));
    }
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = i + 1; j < 4; ++j) {
            bool seen = false;
            for (std::size_t k = 0; k < 4; ++k) seen |= k != i && k != j && front[k];
            svg.line(at(t[i]), at(t[j]), fmt::format("edge {}{}", colour, seen ? "" : " far"));
        }
    }
}

std::string draw(const Scene& scene, const Shown& shown, double scale, const std::string& title) {
    Picture svg(width, height, title);
    const Placing at{shown, frame(scene, shown.view).center(), scale};
    svg.text({width / 2, 13}, shown.title, "view m");
    std::vector<Label> labels;
    for (std::size_t c = 0; c < scene.cells(); ++c) {
        const std::string_view colour = c == 0 ? "a" : "b";
        const Points t = scene.cell(c);
        if (t.size() == 3) {
            svg.area({at(t[0]), at(t[1]), at(t[2])}, fmt::format("face {}", colour));
            for (std::size_t i = 0; i < 3; ++i) svg.line(at(t[i]), at(t[(i + 1) % 3]), fmt::format("edge {}", colour));
        } else {
            draw_tetrahedron(svg, at, t, colour);
        }
    }
    for (std::size_t i = 0; i < scene.points.size(); ++i) {
        const Pixel p = at(scene.points[i]);
        svg.circle(p, 2.2, "node");
        labels.push_back({p, std::to_string(scene.nodes[i]), "id"});
    }
    if (scene.common) {
        svg.circle(at(*scene.common), 4, "witness", "common point");
        labels.push_back({at(*scene.common), "common point", "id bad"});
    }
    place_labels(svg, std::move(labels), top);
    return svg_markup(svg);
}

/// The same for all views of a scene, so that they can be compared; one that is stretched has its own.
double scale_of(const std::vector<Shown>& views, const Scene& scene) {
    double scale = std::numeric_limits<double>::infinity();
    for (const Shown& v : views) {
        const Eigen::Vector2d size = frame(scene, v.view).sizes();
        if (size[0] > 0) scale = std::min(scale, (width - 2 * margin) / size[0]);
        if (size[1] > 0) scale = std::min(scale, (height - top - 2 * margin) / (v.stretch * size[1]));
    }
    return std::isfinite(scale) ? scale : 1;
}

std::string measure_text(double x) {
    return std::isinf(x) ? "∞" : std::isnan(x) ? "unknown" : fmt::format("{:.4g}", x + 0.0);
}

std::string facts(const CheckReport& r, const Mesh& mesh, Mesh::Index cell, std::string_view swatch) {
    const CellMeasures& m = r.measures;
    const auto c = static_cast<std::size_t>(cell);
    std::string out = fmt::format("<p>{}<b>cell {}</b>, nodes {}<br/>", swatch, r.cell_number(cell),
                                  fmt::join(mesh.corners_of(c), " "));
    if (std::isnan(m.volume[c])) return out + "not measured: it has a node twice</p>\n";
    out += fmt::format("angles {}° to {}°, {} {}<br/>", measure_text(m.min_angle[c]), measure_text(m.max_angle[c]),
                       r.dimension == 2 ? "area" : "volume",
                       std::isinf(m.volume[c])                     ? "beyond the largest double"
                       : m.volume[c] == 0 && m.orientation[c] != 0 ? "too small for a double"
                                                                   : measure_text(m.volume[c]));
    const double kappa = m.condition[c];
    return out + fmt::format("condition {}{}, aspect {}, radius / edge {}</p>\n", measure_text(kappa),
                             std::isfinite(kappa) ? fmt::format(" ({:.1f} bits)", std::max(0.0, std::log2(kappa))) : "",
                             measure_text(m.aspect[c]), measure_text(m.radius_edge[c]));
}

/// The cell from two sides at one scale, with the numbers of its nodes; what is known of it. `number`: in the map.
std::string exhibit_card(const CheckReport& r, const Mesh& mesh, const Exhibit& e, std::size_t number) {
    const Scene scene = scene_of(mesh, e);
    const std::vector<Shown> views = views_of(mesh, scene);
    const double scale = scale_of(views, scene);
    std::string out =
        fmt::format("<figure class=\"card\"><h3><span class=\"badge{}\">{}</span> {}</h3>\n<div class=\"views\">",
                    e.defect ? " problem" : "", number, xml_escaped(e.what));
    const bool pair = e.cells[1] >= 0;
    const auto cells = r.cell_number(e.cells);
    const std::string title =
        pair ? fmt::format("cells {} and {}", cells[0], cells[1]) : fmt::format("cell {}", cells[0]);
    for (const Shown& v : views) out += draw(scene, v, scale, title + ", " + v.title);
    out += "</div>\n";
    if (e.cells[0] >= 0) out += facts(r, mesh, e.cells[0], pair ? "<i class=\"swatch a\"></i>" : "");
    if (pair) out += facts(r, mesh, e.cells[1], "<i class=\"swatch b\"></i>");
    return out + "</figure>\n";
}

}  // namespace

std::string exhibits(const CheckReport& r, const Mesh& mesh) {
    constexpr std::size_t max_drawn = 6;
    std::vector<Exhibit> all = defect_cells(r, mesh, max_drawn);
    const std::size_t bad = all.size();
    std::ranges::move(worst_cells(r, mesh, max_drawn), std::back_inserter(all));
    if (all.empty()) return "";
    std::string out = "<h2>Where the worst cells are</h2>\n" + exhibit_map(r, mesh, all);
    const auto cards = [&](std::string_view title, std::size_t first, std::size_t last) {
        if (first == last) return;
        out += fmt::format("<h2>{}</h2>\n<div class=\"figures\">\n", title);
        for (std::size_t i = first; i < last; ++i) out += exhibit_card(r, mesh, all[i], i + 1);
        out += "</div>\n";
    };
    cards("Cells with defects", 0, bad);
    cards(r.dimension == 2 ? "The cells with the smallest angles" : "The cells with the smallest dihedral angles", bad,
          all.size());
    return out;
}

}  // namespace barycert::report
