/// The job that checks a mesh, and repairs it if asked; or a surface, or a PLC (.poly, .smesh): then options of meshes
/// are errors.
///
/// Example:
///
///     CheckJob job;
///     job.mesh = "part.1";
///     job.fix = "fixed.vtu";
///     const bool good = check_files(job).value().certified();
#pragma once

#include <optional>
#include <string>

#include "barycert/check.hpp"
#include "barycert/fix.hpp"
#include "barycert/job.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/surface.hpp"
#include "barycert/table.hpp"

namespace barycert {

struct CheckJob : MeshJob {
    CheckOptions options = {};  ///< but for plc and progress
    std::string plc;            ///< a PLC, whose facets are to be unions of faces of cells
    std::string measures;       ///< a .vtu file: the mesh with measures and defects of each cell; .vtp: the surface
    std::string picture;        ///< a .png file: see draw_checked(); of surfaces and PLCs
    bool plot = false;          ///< check_plot() will be called: of meshes alone
    /// Where to write a repaired copy, one of them at most: VTK's or Gmsh's file, or a stem of TetGen's. `fix` merges
    /// coincident nodes, drops degenerate and duplicate cells and turns negative ones; fix_orientation turns alone.
    std::string fix, fix_orientation;
    std::optional<double> merge_within = {};  ///< of `fix`: nodes of cells at most so far apart are merged
    std::optional<VtkData> vtk_data = {};     ///< of outputs in a format of VTK; not set: raw
};

/// A mesh repaired and written, and what the check says of the file when it is read again.
struct FixedMesh {
    std::string file;
    FixReport done;
    Notes notes = {};  ///< what of the mesh the file cannot hold
    CheckReport after;
};

/// A mesh that was checked, and what was done with it.
struct CheckedMesh {
    Mesh mesh;             ///< the mesh; without cells if a surface or a PLC was checked
    Surface surface;       ///< the surface, if report.surface is set; for a PLC, the triangles of its facets
    std::string name;      ///< what the user calls it, without the suffix of TetGen's files
    std::string artifact;  ///< the file that it is in: of several the first that is there
    CheckReport report;
    std::optional<FixedMesh> fixed;  ///< without `after` where there is no copy
    bool copied = false;             ///< the copy was written and checked
    Status written = Done{};         ///< the first output that could not be written, or why there is no copy

    /// Whether the copy is certified, or the mesh if there is no copy.
    bool certified() const { return (copied ? fixed->after : report).certified(); }
};

/// Returns an Error, and writes nothing, if the job contradicts itself, an input cannot be read, or an output is an
/// input or cannot be written. Errors after the mesh is checked do not cost the report: CheckedMesh::written.
Result<CheckedMesh> check_files(const CheckJob& job);

}  // namespace barycert
