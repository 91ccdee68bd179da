/// Meshes on pages, where people turn them, cut them by a plane, and ask them for cells, weights and values.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "barycert/figure.hpp"
#include "barycert/mesh.hpp"
#include "barycert/raster.hpp"
#include "barycert/result.hpp"
#include "barycert/surface.hpp"

namespace barycert::viewer {

struct PageSurface {
    const Surface* surface = nullptr;  ///< of triangles, cut out of the mesh; of a mesh in the plane: its cells
    std::optional<Rgba> colour = {};   ///< without it, the field's
    bool clear = false;                ///< may be seen through
};

/// A text at a point, in three coordinates.
struct PageLabel {
    std::array<double, 3> at{};
    std::string text = {};
    bool bad = false;  ///< in red, else in blue
};

struct PageScene {
    const Mesh* mesh = nullptr;  ///< its cells are numbered as cell_number says
    std::vector<PageSurface> surfaces = {};
    std::vector<const Field*> point_fields = {}, cell_fields = {};  ///< to choose from
    const Field* field = nullptr;                                   ///< of these: the one that is shown first
    std::vector<Mesh::Index> nodes = {};                            ///< their numbers, if not their own
    Figure figure = {};                                             ///< the same as a picture
    std::vector<PageLabel> labels = {};
    bool see_through = false;        ///< at first, what may be
    std::size_t most_cells = 50000;  ///< of more, those alone that a surface lies in; then a plane shows no section
};

/// A figure in HTML, well-formed XML: `still`, markup, which the viewer replaces where it runs. One a page.
std::string turning_figure(const PageScene& scene, std::string_view still);

/// A page of the scene alone. Error: as draw_figure, for the still picture; the file cannot be written.
Status write_page(const std::string& path, const PageScene& scene, FigureCounts& counts);

}  // namespace barycert::viewer
