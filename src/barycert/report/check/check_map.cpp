// Where in the mesh the exhibits are.

#include <Eigen/Geometry>
#include <algorithm>

#include "barycert/base/arena.hpp"
#include "barycert/draw/axes.hpp"
#include "barycert/mesh/adjacency.hpp"
#include "barycert/report/check/check_pictures.hpp"
#include "barycert/report/check/check_words.hpp"

namespace barycert::report {
namespace {

constexpr double map_width = 640, tallest = 440, map_margin = 40;
constexpr std::size_t max_marks = 3000;

/// From somewhat above and aside, z upwards.
View oblique() {
    constexpr double azimuth = -1.05, elevation = 0.42;  // about 60 and 24 degrees
    const double ca = std::cos(azimuth), sa = std::sin(azimuth), ce = std::cos(elevation), se = std::sin(elevation);
    return {{-sa, ca, 0}, {-se * ca, -se * sa, ce}, {ce * ca, ce * sa, se}};
}

/// The cells that have a boundary: others could not be asked for their facets.
Mesh proper_cells(const Mesh& mesh) {
    Mesh proper;
    proper.dimension = mesh.dimension;
    proper.points = mesh.points;
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        const auto all = nodes_of(mesh, cell);
        const bool twice = std::ranges::any_of(all, [&](Mesh::Index i) { return std::ranges::count(all, i) != 1; });
        if (drawable(mesh, cell) && !twice) proper.cells.insert(proper.cells.end(), all.begin(), all.end());
    }
    return proper;
}

/// A facet of the boundary. In 2D the last node is the first again, and there is no normal.
struct HullFacet {
    std::array<Mesh::Index, 3> nodes{};
    Vector normal = Vector::Zero();  ///< outward, of length 1
};

struct Outline {
    std::vector<std::array<Mesh::Index, 2>> edges;    ///< of the boundary, if they are few enough; else
    std::vector<std::array<Mesh::Index, 2>> creases;  ///< where it bends by more than 40 degrees, if these are; and
    std::vector<HullFacet> facets;                    ///< some of its facets
    std::size_t boundary = 0;                         ///< facets in all
};

Vector point_at(const Mesh& mesh, Mesh::Index node) {
    const double* const p = node_at(mesh, node);
    return {p[0], p[1], mesh.dimension == 2 ? 0 : p[2]};
}

/// The box of all cells that have a place.
Eigen::AlignedBox3d box_of(const Mesh& mesh) {
    Eigen::AlignedBox3d box;
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        if (!drawable(mesh, cell)) continue;
        for (const Mesh::Index node : nodes_of(mesh, cell)) box.extend(point_at(mesh, node));
    }
    return box;
}

/// As Normalised does it, but of the whole mesh: no overflow in normals.
std::vector<HullFacet> hull_of(const Mesh& mesh, const Normalised& normalised) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    std::vector<HullFacet> hull;
    for (const std::int64_t at : mesh::hull_facets(mesh, mesh::compute_neighbours(mesh))) {
        const auto nodes = nodes_of(mesh, static_cast<std::size_t>(at) / (d + 1));
        const Mesh::Index opposite = nodes[static_cast<std::size_t>(at) % (d + 1)];
        HullFacet f;
        std::ranges::remove_copy(nodes, f.nodes.begin(), opposite);
        if (d == 2) {
            f.nodes[2] = f.nodes[0];
        } else {
            const auto place = [&](Mesh::Index i) { return normalised.place(node_at(mesh, i)); };
            const Vector a = place(f.nodes[0]);
            f.normal = unit((place(f.nodes[1]) - a).cross(place(f.nodes[2]) - a));
            if (f.normal.dot(place(opposite) - a) > 0) f.normal = -f.normal;
        }
        hull.push_back(f);
    }
    return hull;
}

Outline outline_of(const Mesh& mesh, const Normalised& normalised, const View& view) {
    const std::vector<HullFacet> hull = hull_of(mesh, normalised);
    Outline out;
    out.boundary = hull.size();
    std::vector<std::pair<std::array<Mesh::Index, 2>, std::size_t>> edges;  // of which facets
    for (std::size_t f = 0; f < hull.size(); ++f) {
        const auto& n = hull[f].nodes;
        for (std::size_t i = 0; i < (mesh.dimension == 2 ? 1U : 3U); ++i)
            edges.push_back({{std::min(n[i], n[(i + 1) % 3]), std::max(n[i], n[(i + 1) % 3])}, f});
    }
    std::ranges::sort(edges);
    constexpr double bend = 0.77;  // cosine of 40 degrees
    std::size_t all = 0;
    for (std::size_t i = 0; i < edges.size(); ++all) {
        const std::size_t first = i;
        bool crease = false;
        for (; i < edges.size() && edges[i].first == edges[first].first; ++i)
            crease |= hull[edges[i].second].normal.dot(hull[edges[first].second].normal) < bend;
        if (all < max_marks) out.edges.push_back(edges[first].first);
        if (crease && out.creases.size() <= max_marks) out.creases.push_back(edges[first].first);
    }
    if (all > max_marks) out.edges.clear();
    if (out.creases.size() > max_marks / 2 || !out.edges.empty()) out.creases.clear();
    if (!out.edges.empty()) return out;
    std::vector<std::size_t> seen;  // from in front
    for (std::size_t f = 0; f < hull.size(); ++f) {
        if (mesh.dimension == 2 || hull[f].normal.dot(view.z) > 0) seen.push_back(f);
    }
    const std::size_t room = std::max<std::size_t>(max_marks - out.creases.size(), 1);
    const std::size_t step = (seen.size() + room - 1) / room;
    for (std::size_t i = 0; i < seen.size(); i += step) out.facets.push_back(hull[seen[i]]);
    return out;
}

struct Map {
    const Mesh& mesh;
    Normalised normalised;
    View view;
    double scale = 1, height = 0;

    Map(const Mesh& of, const Eigen::AlignedBox3d& box)
        : mesh(of),
          normalised(of.dimension, {box.min().data(), box.max().data()}),
          view(of.dimension == 2 ? View{} : oblique()) {
        Eigen::Vector2d half = Eigen::Vector2d::Zero();  // of what the box takes
        for (unsigned i = 0; i < 8; ++i) half = half.cwiseMax(view(corner(i)).head<2>().cwiseAbs());
        if (half[0] > 0) scale = (map_width / 2 - map_margin) / half[0];
        if (half[1] > 0) scale = std::min(scale, (tallest / 2 - map_margin) / half[1]);
        height = 2 * (scale * half[1] + map_margin);
    }

    /// Of the box; bit k of the index is the side along axis k.
    Vector corner(unsigned i) const {
        const std::vector<Vector>& ends = normalised.points();
        return {ends[i & 1U][0], ends[i >> 1U & 1U][1], ends[i >> 2U][2]};
    }

    Pixel at(const Vector& v) const {
        const Vector q = view(v);
        return {map_width / 2 + scale * q[0], height / 2 - scale * q[1]};
    }
    Pixel node(Mesh::Index i) const { return at(normalised.place(node_at(mesh, i))); }

    Pixel middle(std::span<const Mesh::Index> nodes) const {
        Pixel p;
        for (const Mesh::Index i : nodes) {
            p.x += node(i).x / static_cast<double>(nodes.size());
            p.y += node(i).y / static_cast<double>(nodes.size());
        }
        return p;
    }
    Pixel cell(Mesh::Index c) const { return middle(nodes_of(mesh, static_cast<std::size_t>(c))); }
};

void draw_box(Picture& svg, const Map& map, int d) {
    std::vector<std::pair<Pixel, Pixel>> edges;
    for (unsigned i = 0; i < (d == 2 ? 4U : 8U); ++i) {
        for (unsigned k = 0; k < static_cast<unsigned>(d); ++k) {
            if ((i >> k & 1U) == 0) edges.emplace_back(map.at(map.corner(i)), map.at(map.corner(i | 1U << k)));
        }
    }
    svg.lines(edges, "box");
    // Names of the axes at edges that lie in front and below.
    const auto name = [&](unsigned from, unsigned to, const char* text, double dx, double dy) {
        const Pixel a = map.at(map.corner(from)), b = map.at(map.corner(to));
        svg.text({(a.x + b.x) / 2 + dx, (a.y + b.y) / 2 + dy}, text, "tick m");
    };
    name(0, 1, "x", d == 2 ? 0 : -8, 16);
    if (d == 2) {
        name(0, 2, "y", -12, 4);
    } else {
        name(1, 3, "y", 8, 16);
        name(0, 4, "z", -10, 4);
    }
}

void draw_outline(Picture& svg, const Map& map, const Outline& outline, int d) {
    // Three shades, by how much a facet is turned to a light from above and in front.
    std::array<std::vector<Pixel>, 3> dots;
    const Vector light = Vector(0.3, -0.5, 0.9).normalized();
    for (const HullFacet& f : outline.facets) {
        const double bright = f.normal.dot(light);
        dots[d == 2 || bright < 0.2 ? 0
             : bright < 0.7         ? 1
                                    : 2]
            .push_back(d == 2 ? map.node(f.nodes[0]) : map.middle(f.nodes));
    }
    for (std::size_t i = 0; i < dots.size(); ++i) svg.dots(dots[i], fmt::format("dots l{}", i));
    for (const auto& [edges, style] : {std::pair(&outline.edges, "hull"), std::pair(&outline.creases, "crease")}) {
        std::vector<std::pair<Pixel, Pixel>> segments;
        for (const auto& [a, b] : *edges) segments.emplace_back(map.node(a), map.node(b));
        svg.lines(segments, style);
    }
}

/// Cells with defects, some of them if they are many.
std::vector<Pixel> problem_marks(const CheckReport& r, const Mesh& mesh, const Map& map) {
    DefectSet breaking = 0;
    for (const DefectText& t : defect_texts) {
        if (t.breaks) breaking |= defect_bit(t.kind);
    }
    std::vector<Mesh::Index> cells;
    for (std::size_t cell = 0; cell < r.measures.defects.size(); ++cell) {
        if ((r.measures.defects[cell] & breaking) != 0 && drawable(mesh, cell))
            cells.push_back(static_cast<Mesh::Index>(cell));
    }
    std::vector<Pixel> marks;
    const std::size_t step = cells.size() / 500 + 1;
    for (std::size_t i = 0; i < cells.size(); i += step) marks.push_back(map.cell(cells[i]));
    return marks;
}

std::string cells_of(const CheckReport& r, const Exhibit& e, std::string_view between) {
    return joined(r.cell_number(e.cells), between, [](Mesh::Index c) { return c < 0 ? "" : std::to_string(c); });
}

/// The exhibits by their numbers, and the middle of the first cell of each.
std::string legend(const CheckReport& r, const Mesh& mesh, const std::vector<Exhibit>& exhibits) {
    std::string out = "<table><tr><th></th><th>cells</th><th>middle of the first one</th></tr>\n";
    for (std::size_t i = 0; i < exhibits.size(); ++i) {
        const Exhibit& e = exhibits[i];
        Vector middle = Vector::Zero();
        for (const Mesh::Index node : nodes_of(mesh, static_cast<std::size_t>(e.cells[0])))
            middle += point_at(mesh, node) / static_cast<double>(mesh.corners());
        const auto rounded = [](double x) { return fmt::format("{:.4g}", x + 0.0); };
        out += fmt::format("<tr><td><span class=\"badge{}\">{}</span></td><td>{}</td><td>({})</td></tr>\n",
                           e.defect ? " problem" : "", i + 1, cells_of(r, e, ", "),
                           coordinates(middle, mesh.dimension, rounded));
    }
    return out + "</table>\n";
}

std::string extent(const Eigen::AlignedBox3d& box, int d) {
    return joined(std::span("xyz").first(static_cast<std::size_t>(d)), ", ", [&](char axis) {
        const auto k = axis - 'x';
        return fmt::format("{} from {} to {}", axis, base::shortest(box.min()[k]), base::shortest(box.max()[k]));
    });
}

}  // namespace

std::string exhibit_map(const CheckReport& r, const Mesh& mesh, const std::vector<Exhibit>& exhibits) {
    const Eigen::AlignedBox3d box = box_of(mesh);
    if (box.isEmpty()) return "";
    const bool all = std::ranges::none_of(r.defects, leaves_cells_out);
    const Mesh proper = all ? Mesh() : proper_cells(mesh);
    const Map map(mesh, box);
    const Outline outline = base::in_arena(r.threads, mesh.cell_count(),
                                           [&] { return outline_of(all ? mesh : proper, map.normalised, map.view); });

    Picture svg(map_width, map.height, "the boundary of the mesh, and where the cells below are");
    draw_box(svg, map, mesh.dimension);
    draw_outline(svg, map, outline, mesh.dimension);
    const std::vector<Pixel> problems = problem_marks(r, mesh, map);
    svg.dots(problems, "problems");
    std::vector<Label> labels;
    for (std::size_t i = exhibits.size(); i-- > 0;) {  // the first on top
        const Exhibit& e = exhibits[i];
        const Pixel at = map.cell(e.cells[0]);
        svg.circle(at, 4, e.defect ? "spot problem" : "spot", "cell " + cells_of(r, e, " and "));
        labels.push_back({at, std::to_string(i + 1), e.defect ? "number bad" : "number"});
    }
    std::ranges::reverse(labels);
    place_labels(svg, std::move(labels));

    std::string drawn =
        outline.edges.empty()
            ? fmt::format("Grey: {} of its {} boundary facets{}.", grouped(outline.facets.size()),
                          grouped(outline.boundary), outline.creases.empty() ? "" : " and the edges where it bends")
            : fmt::format("Grey: the edges of its {} boundary facets.", grouped(outline.boundary));
    const bool red = !exhibits.empty() && exhibits.front().defect, blue = !exhibits.empty() && !exhibits.back().defect;
    if (red) drawn += " Numbers in red: cells with defects, drawn below.";
    if (blue) drawn += " Numbers in blue: the cells with the smallest angles, which need not be wrong.";
    if (!problems.empty()) drawn += " Red dots: cells with problems, some of them where they are many.";
    return fmt::format(
        "<figure><div class=\"map\">{}<div>{}</div></div>\n"
        "<p class=\"small\">The box of the cells: {}. {}</p></figure>\n",
        svg_markup(svg), legend(r, mesh, exhibits), extent(box, mesh.dimension), drawn);
}

}  // namespace barycert::report
