/// Pictures as jobs, files to files: what `barycert render` does and tells.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "barycert/notes.hpp"
#include "barycert/pipeline.hpp"
#include "barycert/result.hpp"
#include "barycert/view.hpp"

namespace barycert {

/// The colours of a picture of values.
struct ColourRange {
    std::string field;
    double low = 0, high = 0;         ///< NaN if no value is finite
    std::uint64_t without_value = 0;  ///< triangles, drawn in grey
};

/// The largest difference of an interpolated texture coordinate from the correctly rounded perspective-correct one,
/// over all pixels, and where.
struct TexelError {
    double texels = 0;
    std::int32_t column = 0, row = 0;  ///< row counted from the bottom
};

/// What was drawn.
struct RenderSummary {
    std::string picture;  ///< gradient, texture, cube, clip, mesh, scene
    std::string input;    ///< the scene, mesh or image; empty if there is none
    std::string output;
    CurvedCells curved;  ///< of the mesh: drawn with straight sides
    RasterSize size;
    RenderCounts counts;
    FillMethod method = FillMethod::barycentric;
    Interpolation interpolation = Interpolation::perspective;
    Rounding rounding = Rounding::plain;
    std::optional<ColourRange> colours;
    std::optional<TexelError> texel_error;
    Notes notes;         ///< of the mesh
    double seconds = 0;  ///< from the options to the file
};

/// The boundary of a mesh of tetrahedra, or a mesh of triangles in the plane, as a PNG file.
struct MeshPictureJob {
    std::string mesh;      ///< as for read_mesh
    StepChoice step = {};  ///< of a series
    std::vector<FieldFile> field_files = {};
    Curved curved = Curved::straight;  ///< what becomes of curved cells
    std::string field;   ///< NAME, point:NAME, cell:NAME, each perhaps with .K for component K; empty: grey
    std::string output;  ///< must end in .png
    ViewOptions view;
    int threads = 0;  ///< 0: as many as the machine has
};

/// Draws facets that one cell alone has; their colours are those of nodes, or of that cell. Returns an Error if the
/// mesh cannot be read, has no such field or component or no cells, as draw_surface does, or if the file cannot be
/// written.
Result<RenderSummary> render_mesh_file(const MeshPictureJob& job);

}  // namespace barycert
