/// VTK's files: meshes and points. VTK itself is not needed.
///
/// Example:
///
///     const Mesh mesh = read_vtk("run.pvd", {.last = true}).value();
///     write_vtu(mesh, "last.vtu", VtkData::zlib).value();
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/series.hpp"
#include "barycert/table.hpp"

namespace barycert {

/// Reads an unstructured grid or polygon data in XML (.vtu, .vtp) or in the legacy format (.vtk); the pieces of a
/// partitioned one (.pvtu) or of a multiblock data set (.vtm, .vtpd, .vtpc); a step of a series (.pvd, .vtu.series,
/// .vtp.series). The first bytes tell which of them a file is. ASCII, base64, raw, compressed by zlib, LZ4 or LZMA, of
/// either byte order.
///
/// - Cells of dimension 3 make a mesh of dimension 3; where there are none, polygons one of dimension 2, with z = 0.
///   What is no simplex of order 1 or 2, or of several types, makes Mesh::shapes: of higher orders by its corners, but
///   simplices up to order 4 with all nodes. Image data, rectilinear and structured grids (.vti .vtr .vts) have voxels,
///   pixels, hexahedra and quadrilaterals.
/// - Vertices, lines and, beside solids, polygons are left out, as are ghost cells (vtkGhostType: duplicate,
///   refined, hidden), with their rows of the cell arrays. cell_numbers then says which cells of the file stay; those
///   of several files count on.
/// - Of a collection with unstructured grids all else is left out; where there are none, structured grids are the mesh,
///   and without those polygon data.
/// - Nodes of pieces are kept as they are; of one global number (GlobalIds, GlobalNodeId) and place they are one.
/// - Arrays of numbers of any type become fields of the same name, exactly. Strings of cells, and 64-bit integers of
///   one component that no doubles represent, become cell_labels. Other arrays are left out: strings of points, without
///   a name, missing in one of the pieces. Of arrays with time steps the first is read.
/// - A point array "marker" of 64-bit integers, one a point, becomes point_markers.
///
/// Mesh::notes tells what was left out or converted (float32 to double), and where pieces may share nodes.
///
/// Error: a step is chosen, and there is none; the file, or one that it names, is missing, cut off, contradicts itself,
/// has a coordinate that is not finite, an index that is no point, more than 2147483647 points or cells, cells of other
/// types (which are named), no cells, or triangles off the plane z = 0; XML with a document type; memory is short.
/// Memory is bounded by what the file holds once it is decompressed.
Result<Mesh> read_vtk(const std::string& path, const StepChoice& step = {});

/// The path and, of a file that names files, theirs.
std::vector<std::string> vtk_mesh_files(const std::string& path);

/// The points of any .vtu, .vtp, .vti, .vtr, .vts, .pvtu, .pvtp, .vtm or .vtk (unstructured grid, polygon data,
/// structured grid), `dimension` coordinates a point. In dimension 2, every z must be 0. Points of image data are
/// origin + spacing * index, with two roundings, as VTK has them.
///
/// Error: as in read_vtk, as far as it concerns points; cells are not read.
Result<std::vector<double>> read_vtk_points(const std::string& path, int dimension);

/// Points with what stands at them.
struct PointData {
    int dimension = 3;
    std::vector<double> points;  ///< `dimension` coordinates a point
    std::vector<Field> fields;   ///< one value a point, as in read_vtk
    std::vector<Column> labels;  ///< the array "marker"
    Notes notes;
};

/// read_vtk_points with the point arrays of these names, or all. A name that is not there is no error.
Result<PointData> read_vtk_point_data(const std::string& path, int dimension,
                                      const std::optional<std::vector<std::string>>& names = std::nullopt);

/// Writes the mesh as its path ends: .vtu as write_vtu does; .vtk in the legacy format, binary (`data` raw) or as text
/// (ascii). read_vtk reads the same mesh from either, to the bits of every double, but for faces, neighbours and the
/// index base; in ascii a NaN loses its payload.
///
/// A legacy file is of version 4.2, and of 5.1 from 2^31 numbers of cells on. Names of fields may hold any bytes.
///
/// Error: another ending; compression of a legacy file; as write_vtu, but for what concerns XML; in a legacy file a
/// name that takes more than 200 bytes there (all but letters and digits may take three), which VTK's own readers
/// refuse, or METADATA or NULL_ARRAY, which mean something else there.
Status write_vtk(const Mesh& mesh, const std::string& path, VtkData data = VtkData::raw);

/// Writes points, cells and fields as one piece of XML (unstructured grid).
///
/// - Triangles get z = 0. Cells with mid-edge nodes are quadratic ones. Corners keep their order.
/// - Fields are Float64 arrays of any values, NaN and infinity too. point_markers are an Int64 array "marker"; cell
///   labels are Int64 and String arrays. Faces and neighbours have no place in the format.
/// - Every double reads back to the same bits, NaNs with their payloads (but in ascii, and VTK's own reader of ascii
///   knows no NaN), and the same mesh gives the same bytes on any number of threads.
///
/// The file appears whole or not at all. Error: the mesh is inconsistent; a field has no name, that of another one of
/// its kind (or "marker", where there are markers), or one that XML cannot hold (not UTF-8, or control characters but
/// for tab and line breaks); a label that holds a zero byte; the file cannot be written; memory is short.
Status write_vtu(const Mesh& mesh, const std::string& path, VtkData data = VtkData::raw);

}  // namespace barycert
