/// Files of VTK: meshes, points and series. VTK itself is not needed.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "barycert/column.hpp"
#include "barycert/mesh.hpp"
#include "barycert/notes.hpp"
#include "barycert/result.hpp"
#include "barycert/vtk_data.hpp"

namespace barycert {

/// Which step of a series (.pvd, .vtu.series) is meant: at most one of these. None: the first.
struct StepChoice {
    std::optional<std::size_t> number = {};  ///< from 0, in the order of the file
    std::optional<double> time = {};         ///< exactly as the file has it
    bool last = false;

    bool made() const { return number || time || last; }
};

/// Reads a mesh: an unstructured grid or polygon data in XML (.vtu, .vtp) or in the legacy format (.vtk); the pieces of
/// a partitioned one (.pvtu), of the blocks of a multiblock data set (.vtm, .vtpd, .vtpc); a step of a series
/// (.pvd, .vtu.series, .vtp.series). Which of them it is, is told by its first bytes. ASCII, base64, raw, compressed by
/// zlib, LZ4 or LZMA, of either byte order, in one piece or several.
///
/// - Tetrahedra make a mesh of dimension 3. Where there are none, triangles make one of dimension 2, and all points
///   must have z = 0. All cells are linear or all are quadratic (VTK_QUADRATIC_TETRA, VTK_QUADRATIC_TRIANGLE), whose
///   mid-edge nodes go to mid_nodes.
/// - Vertices, lines and, beside tetrahedra, triangles are left out, as are ghost cells (vtkGhostType: duplicate,
///   refined, hidden), with their rows of the cell arrays. cell_numbers then says which cells of the file stay; those
///   of several files count on.
/// - Of a collection with unstructured grids, polygon data and other grids are left out; where there are none, polygon
///   data are the mesh.
/// - Nodes of pieces are kept as they are. Where the file gives their global numbers (GlobalIds, GlobalNodeId), nodes
///   of one number and place are one.
/// - Arrays of any numeric type and any number of components become fields of the same name, exactly. Strings of cells,
///   and 64-bit integers of one component that no doubles represent, become cell_labels. Other arrays are left out: of
///   strings of points, without a name, missing in one of the pieces. Of arrays with time steps the first is read.
/// - A point array "marker" of 64-bit integers, one a point, becomes point_markers: write_vtk keeps them there.
///
/// Mesh::notes tells what was left out or converted (float32 to double), and where pieces may share nodes.
///
/// Error: a step is chosen, and there is no series, or no such step; the file, or one that it names, is missing, cut
/// off, contradicts itself, has a coordinate that is not finite,
/// an index that is no point, more than 2147483647 points or cells, cells of other types (they are named), no cells of
/// its dimension, or triangles off the plane z = 0; XML with a document type; memory is short. Memory is bounded by
/// what the file holds once it is decompressed.
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

/// A step of a series: files that make one data set.
struct SeriesStep {
    double time = 0;
    std::vector<std::string> files;  ///< as they can be opened
};

/// The steps of a series (.pvd, or ParaView's .vtu.series) in the order of the file: entries of one time that follow
/// each other are one step. Error: no such file; no well-formed XML, another kind; an entry without a file, a time that
/// is no finite number.
Result<std::vector<SeriesStep>> read_series(const std::string& path);

/// Writes the mesh as its path ends: .vtu as write_vtu does; .vtk in the legacy format, binary (`data` raw) or as text
/// (ascii). read_vtk reads the same mesh from either, to the bits of every double, but for faces, neighbours and the
/// index base; in ascii a NaN loses its payload.
///
/// A legacy file is of version 4.2, which every reader of the format knows, and of 5.1 from 2^31 numbers of cells on.
/// It appears whole or not at all and is written as it is made. Names of fields may hold any bytes.
///
/// Error: an ending that is neither; compression of a legacy file, which knows none; as write_vtu, but for what
/// concerns XML; in a legacy file a name that takes more than 200 bytes there (all but letters and digits may take
/// three), which VTK's own readers would not read, or the name METADATA or NULL_ARRAY, which mean something else there.
Status write_vtk(const Mesh& mesh, const std::string& path, VtkData data = VtkData::raw);

/// Writes points, cells and fields as one piece of XML (unstructured grid), for every reader of VTU files.
///
/// - Triangles get z = 0. Where there are mid-edge nodes, cells are quadratic ones. Corners keep their order, so a cell
///   of negative volume stays one.
/// - Fields are Float64 arrays under their own names, with their components; any value may be in them, NaN and infinity
///   too. point_markers are an Int64 array "marker"; cell labels are Int64 and String arrays. Faces and neighbours have
///   no place in the format.
/// - Every double reads back to the same bits, NaNs with their payloads (but in ascii, and VTK's own reader of ascii
///   knows no NaN), and the same mesh gives the same bytes on any number of threads.
///
/// The file appears whole or not at all; beside the mesh little memory is taken.
///
/// Error: the mesh is inconsistent; a field has no name, the name of another one of its kind (of "marker", where there
/// are markers), or a name that XML cannot hold (not UTF-8, or control characters but for tab and line breaks); a label
/// that holds a zero byte; the file cannot be written; memory is short.
Status write_vtu(const Mesh& mesh, const std::string& path, VtkData data = VtkData::raw);

}  // namespace barycert
