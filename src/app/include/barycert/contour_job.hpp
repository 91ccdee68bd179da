/// The job that makes iso-surfaces, iso-lines and slices of meshes.
///
/// Example:
///
///     ContourJob job;
///     job.mesh = "part.1";
///     job.field = "T";
///     job.value = 20;
///     job.output = "level.vtp";
///     const std::uint64_t triangles = contour_files(job).value().parts;
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "barycert/figure.hpp"
#include "barycert/job.hpp"
#include "barycert/raster.hpp"
#include "barycert/result.hpp"
#include "barycert/surface.hpp"
#include "barycert/table.hpp"

namespace barycert {

struct ContourJob : MeshJob {
    // Either: the field of nodes and its value; a field of several components as NAME.0, NAME.1, ...
    std::string field;
    std::optional<double> value = {};
    // Or a plane; then `field`, which may be one of cells, is what a picture shows, or what a surface carries along.
    std::optional<Plane> plane = {};

    std::vector<std::string> fields = {};  ///< to carry along, see Sampler::build; empty: all. Not for pictures
    std::string output;                    ///< .vtp, .ply, .off; .png, .svg, .pdf; segments as .vtp or .ply
    std::int64_t width = 800;              ///< of a picture of a section, in pixels, without axes and bar
    FigureOptions figure = {};             ///< of a picture
    bool edges = false;                    ///< of cells, on a picture
    bool outline = false;                  ///< of the mesh, on a picture of an iso-surface
    std::string colours;  ///< the field, of nodes or cells, that colours it; named as `field`; empty: grey
    std::optional<VtkData> vtk_data = {};  ///< of a .vtp file; not set: raw
    int threads = 0;                       ///< 0: as many as the machine has
};

/// Where the pixels of a picture of a plane lie. The middle of pixel (i, j), counted from the lower left, is
/// origin + i * step_right + j * step_up, each operation rounded: up to rounding on the plane. Seen from where the
/// normal points to, z upwards (y, if the normal has no other component than z).
struct PixelGrid {
    std::int64_t width = 0, height = 0;
    std::array<double, 3> origin{}, step_right{}, step_up{};
    double pixel = 0;  ///< the length of both steps, up to rounding

    std::array<double, 3> middle(std::int64_t i, std::int64_t j) const;
};

/// Results of a job, from which its reports are made.
struct ContourReport : MeshReport {
    std::string field, output;
    std::optional<double> value;
    std::optional<Plane> plane;
    std::uint64_t points = 0, parts = 0;  ///< of the surface; parts are triangles, in the plane segments
    CutCounts counts;
    std::vector<std::string> fields;  ///< in the file
    SurfaceFile file;
    /// The least and the greatest number, at nodes of cells, of what is cut: the field or normal.x. NaN if there is
    /// none.
    double low = 0, high = 0;
    std::optional<PixelGrid> pixels;  ///< of a picture of a section; with one sample a pixel values are those there
    SampleCounts samples;
    std::optional<RasterSize> view;  ///< of a picture that is drawn
    FigureCounts drawn;
    std::string colours;
    JobSeconds seconds;
};

/// Returns an Error, and writes nothing, if the job contradicts itself, an input cannot be read, an output is an input
/// or cannot be written, or there is nothing to draw in a picture. An empty surface is written; the report tells.
Result<ContourReport> contour_files(const ContourJob& job);

}  // namespace barycert
