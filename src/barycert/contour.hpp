/// Whole jobs, files to files: iso-surfaces, iso-lines and slices of meshes. What `barycert render iso` and `barycert
/// render slice` call. Output files appear whole or not at all.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "barycert/picture.hpp"
#include "barycert/pipeline.hpp"
#include "barycert/result.hpp"
#include "barycert/surface.hpp"
#include "barycert/table.hpp"
#include "barycert/view.hpp"

namespace barycert {

struct ContourJob {
    std::string mesh;      ///< as for read_mesh
    StepChoice step = {};  ///< of a series
    std::vector<FieldFile> field_files = {};
    Curved curved = Curved::straight;  ///< what becomes of curved cells

    // Either: the field of nodes and its value; a field of several components as NAME.0, NAME.1, ...
    std::string field;
    std::optional<double> value = {};
    // Or a plane; then `field`, which may be one of cells, is what a picture shows, or what a surface carries along.
    std::optional<Plane> plane = {};

    std::vector<std::string> fields = {};          ///< to carry along, see Sampler::build; empty: all. Not for pictures
    std::string output;                            ///< .vtp, .ply, .off or .png; segments not as .off or .png
    std::optional<std::array<double, 2>> range{};  ///< of the colours of a picture
    std::int64_t width = 800;                      ///< of a picture of a section, in pixels, without bar and caption
    ViewOptions view = {};                         ///< of a picture of an iso-surface, but for its range
    std::string colours;  ///< the field, of nodes or cells, that colours it; named as `field`; empty: grey

    std::optional<VtkData> vtk_data = {};  ///< of a .vtp file; not set: raw
    int threads = 0;                       ///< 0: as many as the machine has
    std::string report;                    ///< as SamplingJob::report
    std::string program = "barycert";
    std::function<void(const JobProgress&)> progress = {};
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

struct ContourSeconds {
    double mesh = 0;  ///< reading the mesh and the files of fields
    double cut = 0;
    double sample = 0;  ///< of a picture: index and values
    double write = 0;
    double total = 0;
};

/// What a job did: what its reports are made of.
struct ContourSummary {
    std::string mesh, field, output;
    CurvedCells curved;  ///< of the mesh: cut with straight sides
    std::optional<double> value;
    std::optional<Plane> plane;
    std::uint64_t nodes = 0, cells = 0;
    int dimension = 3, threads = 1;

    std::uint64_t points = 0, parts = 0;  ///< of the surface; parts are triangles, in the plane segments
    CutCounts counts;
    std::vector<std::string> fields;  ///< in the file
    SurfaceFile file;
    Notes notes;  ///< of the mesh
    /// Of what is cut, the field or normal.x: its least and greatest number at nodes of cells. NaN if there is none.
    double low = 0, high = 0;

    std::optional<PixelGrid> pixels;  ///< of a picture of a section
    SliceCounts picture;
    SampleCounts samples;
    std::optional<RasterSize> view;  ///< of a picture of an iso-surface
    ViewCounts drawn;
    std::string colours;
    ContourSeconds seconds;
};

/// Returns an Error, and writes nothing, if the job contradicts itself, an input cannot be read, an output is an input
/// or cannot be written, or there is nothing to draw in a picture. An empty surface is written, and told.
Result<ContourSummary> contour_files(const ContourJob& job);

}  // namespace barycert
