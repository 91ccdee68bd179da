/// The job that draws pictures.
///
/// Example:
///
///     RenderJob job;
///     job.picture = PictureKind::mesh;
///     job.mesh = "part.1";
///     job.field = "T";
///     job.output = "part.png";
///     const RenderReport report = render_files(job).value();
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/figure.hpp"
#include "barycert/job.hpp"
#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/raster.hpp"
#include "barycert/result.hpp"
#include "barycert/scene.hpp"
#include "barycert/surface.hpp"
#include "barycert/weights.hpp"

namespace barycert {

/// The colours of a picture of values.
struct ColourRange {
    std::string field;
    double low = 0, high = 0;         ///< NaN if no value is finite
    std::uint64_t without_value = 0;  ///< triangles, drawn in grey
};

/// The largest difference of a texture coordinate from the correctly rounded perspective-correct one, and where.
struct TexelError {
    double texels = 0;
    std::int32_t column = 0, row = 0;  ///< row counted from the bottom
};

/// Results of drawing.
struct RenderReport : MeshReport {
    std::string picture;  ///< gradient, texture, cube, clip, mesh, scene
    std::string input;    ///< the scene, mesh or image; empty if there is none
    std::string output;
    RasterSize size;
    int samples = 1;  ///< of a pixel, across and up; counts are of these
    RenderCounts counts;
    FillMethod method = FillMethod::barycentric;
    Interpolation interpolation = Interpolation::perspective;
    Rounding rounding = Rounding::plain;
    std::optional<ColourRange> colours;
    std::optional<TexelError> texel_error;
    double seconds = 0;  ///< from the options to the file
};

/// Pictures that a RenderJob draws: the scene of a file; a triangle with a red, a green and a blue corner; an image on
/// a square or triangle; a checkerboard on a cube in perspective, with the largest error of its texture coordinates; a
/// triangle and segments before and after clipping by a box; the boundary of a mesh of tetrahedra, or a mesh of
/// triangles.
enum class PictureKind : std::uint8_t { scene, gradient, texture, cube, clip, mesh };

constexpr std::string_view name(PictureKind p) {
    constexpr std::array<std::string_view, 6> names{"scene", "gradient", "texture", "cube", "clip", "mesh"};
    return names[static_cast<std::size_t>(p)];
}

/// Parts of a mesh that a picture shows: its boundary, in the plane its cells; or, where slices, iso-surfaces or marked
/// cells are named, these. Cells that threshold or box leave out are not shown, nor is anything before the plane.
struct SceneChoice {
    bool surface = true;   ///< false: no boundary
    bool edges = false;    ///< of cells, on what is drawn
    bool outline = false;  ///< where the boundary bends by 30 degrees or more; in the plane all of it
    /// Cut open: parts with normal.x above the offset are left out. The section closes the cut.
    std::optional<Plane> plane = {};
    /// Cells with a node inside are left out.
    std::optional<std::pair<std::array<double, 3>, std::array<double, 3>>> box = {};
    struct Threshold {
        std::string field;  ///< as `field` of the job
        double low = 0, high = 0;
    };
    std::optional<Threshold> threshold = {};  ///< cells whose value, or those at whose nodes, are all within
    std::string iso_field;
    std::vector<double> iso = {};  ///< values of its iso-surfaces
    std::vector<Plane> slices = {};
    /// A field of nodes of as many components as there are coordinates; in colours of the field if there is no surface.
    std::string arrows;
    std::int64_t arrow_count = 400;        ///< about so many
    std::vector<double> points = {};       ///< coordinates of discs, in colours of the field there
    double point_size = 6;                 ///< pixels across
    BuildOptions location = {};            ///< of these points
    std::vector<Mesh::Index> marked = {};  ///< cells by their numbers, in red
};

/// A picture as a file. `mesh` and the members of MeshJob that belong to it are for PictureKind::mesh alone.
struct RenderJob : MeshJob {
    PictureKind picture = PictureKind::scene;
    std::string output;         ///< .png; of a mesh also .svg or .pdf
    FigureOptions figure = {};  ///< size, method, rounding and samples of all pictures; the rest of that of a mesh
    SceneChoice show = {};      ///< of a mesh
    std::string points;         ///< a file of points to be among those of `show`, as for open_points
    std::vector<std::string> columns = {};                     ///< of its coordinates: PointOptions::columns
    std::string scene;                                         ///< a file (.json)
    Interpolation interpolation = Interpolation::perspective;  ///< of a cube
    std::string image;                                         ///< of a texture: .png; empty: one of 2 by 2 texels
    bool triangle = false;                                     ///< what that is put on; else a square
    std::pair<double, double> coordinates{0, 1};               ///< u and v at its lower left and upper right
    Wrap wrap = Wrap::clamp;
    Filter filter = Filter::nearest;
    std::string field;  ///< of a mesh: NAME, point:NAME, cell:NAME, each perhaps with .K for component K; empty: grey
    int threads = 0;    ///< 0: as many as the machine has
};

/// Draws a picture. Of a mesh it draws the facets that only one cell has, in the colours of nodes or of that cell.
/// Error: the job contradicts itself; an input cannot be read; a mesh has no such field or component, or no cells;
/// errors of render and write_figure; the file cannot be written.
Result<RenderReport> render_files(const RenderJob& job);

/// The same of a mesh in memory, to the file `path`: .png, .svg, .pdf or .html.
Status write_mesh_figure(const std::string& path, const Mesh& mesh, const SceneChoice& show, const std::string& field,
                         const FigureOptions& options);

}  // namespace barycert
