#include "draw/viewer/page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <new>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/figure.hpp"
#include "barycert/mesh.hpp"
#include "barycert/raster.hpp"
#include "barycert/result.hpp"
#include "barycert/surface.hpp"
#include "draw/colour_map.hpp"
#include "draw/picture.hpp"
#include "draw/view.hpp"
#include "files/deflate.hpp"
#include "files/embedded.hpp"
#include "files/json_text.hpp"
#include "files/output_file.hpp"
#include "mesh/part.hpp"

BARYCERT_EMBED(barycert_viewer, BARYCERT_VIEWER);
BARYCERT_EMBED(barycert_three, BARYCERT_THREE);

namespace barycert::viewer {
namespace {

using namespace draw;
using Json = nlohmann::ordered_json;

/// Deflated, in base64. Memory: three times the bytes.
std::string packed(std::string_view bytes) {
    const std::string out = base::deflated(bytes, 6);
    if (out.empty()) throw std::bad_alloc();
    return base64(out);
}

/// The data that viewer.js unpacks: a header, and arrays that it names by their numbers.
class PageData {
public:
    Json header;

    template <class T>
    std::size_t add(const std::vector<T>& numbers) {
        constexpr const char* type = std::is_same_v<T, double> ? "f8" : std::is_same_v<T, float> ? "f4" : "i4";
        arrays_.push_back({type, numbers.size()});
        const std::size_t bytes = sizeof(T) * numbers.size(), at = bytes_.size();
        bytes_.resize(at + (bytes + 7) / 8 * 8);
        if (bytes != 0) std::memcpy(bytes_.data() + at, numbers.data(), bytes);
        return arrays_.size() - 1;
    }

    /// As floats, if that is exact.
    std::size_t add_exactly(const std::vector<double>& numbers) {
        const auto fits = [](double x) { return std::isnan(x) || static_cast<float>(x) == x; };
        return std::ranges::all_of(numbers, fits) ? add(std::vector<float>(numbers.begin(), numbers.end()))
                                                  : add(numbers);
    }

    std::string text() {
        header["arrays"] = std::move(arrays_);
        const std::string json = base::json_text(header, -1);
        const auto length = static_cast<std::uint32_t>(json.size());
        std::string all(sizeof length, '\0');
        std::memcpy(all.data(), &length, sizeof length);
        all += json;
        all.resize((all.size() + 7) / 8 * 8);
        return packed(all + bytes_);
    }

private:
    Json arrays_ = Json::array();
    std::string bytes_;
};

/// Three coordinates a point.
std::vector<double> in_space(const std::vector<double>& points, std::size_t d) {
    if (d == 3) return points;
    std::vector<double> out;
    for (std::size_t i = 0; i < points.size(); i += 2) out.insert(out.end(), {points[i], points[i + 1], 0});
    return out;
}

/// The cells that a page has of the mesh; all, if they are few enough.
mesh::Submesh cells_of(const PageScene& scene) {
    std::vector<Mesh::Index> cells;
    for (const PageSurface& s : scene.surfaces)
        cells.insert(cells.end(), s.surface->mesh_cells.begin(), s.surface->mesh_cells.end());
    for (std::size_t i = 0; scene.mesh->cell_count() <= scene.most_cells && i < scene.mesh->cell_count(); ++i)
        cells.push_back(static_cast<Mesh::Index>(i));
    std::ranges::sort(cells);
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return mesh::part_of(*scene.mesh, std::move(cells));
}

/// By their places in `kept`, which ascends and has all of them.
std::vector<Mesh::Index> renumbered(std::vector<Mesh::Index> all, const std::vector<Mesh::Index>& kept) {
    for (Mesh::Index& i : all) i = static_cast<Mesh::Index>(std::ranges::lower_bound(kept, i) - kept.begin());
    return all;
}

Json surface_json(const PageSurface& s, const mesh::Submesh& kept, PageData& data) {
    const Surface& of = *s.surface;
    Json out{{"triangles", data.add(of.cells)},
             {"cells", data.add(renumbered(of.mesh_cells, kept.cells))},
             {"ends", data.add(renumbered(of.mesh_edges, kept.nodes))},
             {"clear", s.clear}};
    bool nodes = true;
    for (std::size_t i = 0; i < of.mesh_edges.size(); i += 2) nodes = nodes && of.mesh_edges[i] == of.mesh_edges[i + 1];
    if (!nodes) out["points"] = data.add(of.points);
    if (s.colour) out["colour"] = *s.colour;
    return out;
}

void add_fields(const PageScene& scene, const mesh::Submesh& kept, PageData& data) {
    Json all = Json::array();
    data.header["field"] = -1;
    for (const auto& [fields, rows, of_cells] :
         {std::tuple(&scene.point_fields, &kept.nodes, false), {&scene.cell_fields, &kept.cells, true}}) {
        for (const Field* const f : *fields) {
            if (f == scene.field) data.header["field"] = all.size();
            all.push_back({{"name", f->name},
                           {"unit", f == scene.field ? scene.figure.options.unit : ""},
                           {"components", f->components},
                           {"ofCells", of_cells},
                           {"values", data.add_exactly(mesh::rows_of(*f, *rows).data)}});
        }
    }
    data.header["fields"] = std::move(all);
}

/// The script that runs the figure, and stands behind it.
std::string viewer_script() {
    const std::string code = std::string(&barycert_three[0], &barycert_three_end[0]) + "\n" +
                             std::string(&barycert_viewer[0], &barycert_viewer_end[0]);
    // Neither "less than" nor "and" signs, see the pages of reports.
    return fmt::format(R"(<script type="text/plain" id="viewer">{}</script>
<script>
(async function () {{
  async function unpacked(element) {{
    const bytes = Uint8Array.from(atob(element.textContent), function (c) {{ return c.charCodeAt(0); }});
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer();
  }}
  const script = document.createElement("script");
  script.textContent = new TextDecoder().decode(await unpacked(document.getElementById("viewer")));
  document.body.append(script);
  const figure = document.querySelector("figure.turning");
  viewMesh(figure, await unpacked(figure.querySelector("script")));
}})();
</script>
)",
                       packed(code));
}

}  // namespace

std::string turning_figure(const PageScene& scene, std::string_view still) {
    const mesh::Submesh kept = cells_of(scene);
    const Mesh& mesh = kept.mesh;
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const FigureOptions& o = scene.figure.options;
    PageData data;
    Json& h = data.header;
    const Space space(scene.figure);
    std::array<double, 3> middle{}, sides{};
    for (std::size_t k = 0; k < d; ++k) {
        middle[k] = space.box[k].middle();
        sides[k] = 2 * (space.box[k].half() / space.half);
    }
    std::vector<Mesh::Index> numbers, nodes = kept.nodes;
    for (const Mesh::Index cell : kept.cells) numbers.push_back(scene.mesh->cell_number(cell));
    for (Mesh::Index& node : nodes)
        if (!scene.nodes.empty()) node = scene.nodes[static_cast<std::size_t>(node)];
    h = {{"dimension", d},
         {"middle", middle},
         {"sides", sides},
         {"half", space.half},
         {"whole", mesh.cell_count() == scene.mesh->cell_count()},
         {"points", data.add(in_space(mesh.points, d))},
         {"cells", data.add(mesh.cells)},
         {"nodes", data.add(nodes)},
         {"numbers", data.add(numbers)}};
    h["told"] = Json::array();
    const auto tell = [&](bool so, std::string_view sentence) {
        if (so) h["told"].push_back(sentence);
    };
    tell(d == 3 && !h["whole"], "Cells inside are not on this page: a cut shows no section.");
    tell(!scene.mesh->shapes.inside.empty(), "Weights are those of the simplex that the cell was cut into.");
    tell(curved_cells(*scene.mesh).cells != 0, "Sides of curved cells are taken as straight.");
    h["camera"] = {{"azimuth", o.camera.azimuth},
                   {"elevation", o.camera.elevation},
                   {"zoom", o.camera.zoom},
                   {"parallel", o.camera.parallel}};
    h["seeThrough"] = scene.see_through;
    for (const char* const list : {"surfaces", "lines", "labels"}) h[list] = Json::array();
    for (const PageLabel& l : scene.labels) h["labels"].push_back({{"at", l.at}, {"text", l.text}, {"bad", l.bad}});
    for (const PageSurface& s : scene.surfaces) h["surfaces"].push_back(surface_json(s, kept, data));
    for (const FigureLines& l : scene.figure.lines) {
        std::vector<float> points;
        for (std::size_t i = 0; i < l.points.size(); i += d)
            for (const double x : space(&l.points[i])) points.push_back(static_cast<float>(x));
        h["lines"].push_back(
            {{"points", data.add(points)}, {"segments", data.add(std::vector(l.segments.begin(), l.segments.end()))}});
    }
    add_fields(scene, kept, data);
    if (o.range) h["range"] = *o.range;
    h["log"] = o.log;
    const ColourMap map = colour_map(o.colour_map).value();
    for (const Rgba& c : map)
        for (std::size_t k = 0; k < 3; ++k) h["map"].push_back(c[k]);
    return fmt::format(
        "<figure class=\"turning\"><div class=\"still\">{}</div>\n<script type=\"text/plain\">{}</script></figure>\n{}",
        still, data.text(), viewer_script());
}

Status write_page(const std::string& path, const PageScene& scene, FigureCounts& counts) {
    const ExactEnvironment environment;
    const Result<Image> image = draw_figure(scene.figure, &counts);
    if (!image) return image.error();
    const std::string title = xml_escaped(scene.figure.options.title.empty() ? "A mesh" : scene.figure.options.title);
    const std::string picture = fmt::format("<img alt=\"{}\" src=\"{}\" width=\"{}\" height=\"{}\"/>", title,
                                            data_uri("image/png", png_text(*image)), image->width, image->height);
    base::OutputFile file(path);
    file.write(fmt::format(R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"/><meta name="viewport" content="width=device-width,initial-scale=1"/>
<title>{0}</title><style>
:root{{color-scheme:light dark}}body{{margin:0 auto;padding:16px;max-width:1120px;background:#fff;color:#1d2227;font:15px/1.5 system-ui,sans-serif}}
@media (prefers-color-scheme:dark){{body{{background:#15191c;color:#e4e8eb}}}}@media print{{body{{background:#fff;color:#000}}}}
h1{{font-size:20px;margin:0 0 8px}}figure{{margin:0}}img{{max-width:100%;height:auto}}
</style></head><body><main><h1>{0}</h1>
{1}</main></body></html>
)",
                           title, turning_figure(scene, picture)));
    return file.commit();
}

}  // namespace barycert::viewer
