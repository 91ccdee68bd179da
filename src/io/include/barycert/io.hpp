/// Files in and out: meshes of TetGen and Triangle, streams of points, rows of results.
#pragma once

#include <memory>

#include "barycert/plc.hpp"
#include "barycert/surface.hpp"

namespace barycert {

// Gmsh's .msh files: meshes in and out. read_mesh and write_mesh come here for what ends in .msh.

struct GmshReadOptions {
    /// Which step in time fields are read of; not set: the first of each. A field with a single step is read anyway.
    std::optional<std::int64_t> step = {};
    int threads = 0;  ///< 0: as many as the machine has
};

/// Reads a .msh file of version 4.1, 4.0 or 2.x, text or binary of either byte order.
///
/// - Elements of dimension 3 make a mesh of dimension 3; where there are none, polygons one of dimension 2, with z = 0.
///   What is no simplex of order 1 or 2, or of several types, makes Mesh::shapes: of higher orders by its corners, but
///   simplices up to order 4 with all nodes.
/// - Elements of a lower dimension are left out, with a Note; `cell_numbers` are positions among all elements.
/// - Nodes stand in the order of the file whatever their tags, those of no cell included.
/// - Cell fields "gmsh:physical" (the tag of the cell's group, 0 for none; absent if no cell has one) and
///   "gmsh:geometrical" (that of its entity; absent if 1 for all cells, or 0). Cell labels "gmsh:physical_name", if a
///   group of cells has a name, and "gmsh:tag", the elements' tags, unless they are 1, 2, 3, ... in their order.
/// - $NodeData and $ElementData become fields of the view's name. Nodes and cells without a value have NaN.
/// - What else there is (values at the nodes of elements, interpolation schemes, periodic nodes) is left out: Notes.
///
/// Error: the file is missing, cut off, contradicts itself, has a coordinate that is not finite, two nodes of one tag,
/// a cell with an unknown node, other types of cells (which are named), no cells, or triangles off the plane z = 0.
/// Memory is bounded by a multiple of the file's size; where it is short: Error.
Result<Mesh> read_gmsh(const std::string& path, const GmshReadOptions& options = {});

/// One section of values of a .msh file.
struct GmshStep {
    std::string field;  ///< the view's name
    bool of_cells = false;
    int components = 1;
    std::int64_t step = 0;
    double time = 0;

    friend bool operator==(const GmshStep&, const GmshStep&) = default;
};

/// The steps of all $NodeData and $ElementData, in the order of the file; only their headers are read. Returns an Error
/// as read_gmsh does for these sections; a file that has no mesh is no error.
Result<std::vector<GmshStep>> gmsh_steps(const std::string& path);

/// The nodes, `dimension` coordinates a node. In dimension 2 every z must be 0. Elements are not read.
Result<std::vector<double>> read_gmsh_points(const std::string& path, int dimension, int threads = 0);

struct GmshWriteOptions {
    enum class Version : std::uint8_t { v41, v22 };
    Version version = Version::v41;
    bool binary = true;
};

/// Writes nodes, cells, and fields as $NodeData and $ElementData. Every double reads back to the same bits; in text,
/// NaN loses its payload.
///
/// - The cell field "gmsh:physical" becomes groups, named by the cell labels "gmsh:physical_name", and
///   "gmsh:geometrical" the entities. Where that cannot be (tags that are no integers of 32 bits; in 4.1, an entity in
///   several groups), they are $ElementData, which reads back the same. In 4.1 each group needs an entity: without
///   "gmsh:geometrical" they are numbered from 1, and read_gmsh gives them as that field.
/// - Elements have the tags of the label "gmsh:tag" if these are positive and differ, else cell_numbers from 1.
/// - point_markers become $NodeData "marker". Faces, neighbours and other labels are not written.
///
/// The file appears whole or not at all. Error: the mesh is inconsistent; a name of two fields of one kind, or with a
/// line break or a quote in it; the file cannot be written.
Status write_gmsh(const Mesh& mesh, const std::string& path, const GmshWriteOptions& options = {});

// Files of VTK: meshes, points and series. VTK itself is not needed.

/// Which step of a series (.pvd, .vtu.series) is meant: at most one of these. None: the first.
struct StepChoice {
    std::optional<std::size_t> number = {};  ///< from 0, in the order of the file
    std::optional<double> time = {};         ///< exactly as the file has it
    bool last = false;

    bool made() const { return number || time || last; }
};

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

/// A step of a series: files that make one data set.
struct SeriesStep {
    double time = 0;
    std::vector<std::string> files;  ///< as they can be opened
};

/// The steps of a series in the order of the file. In a .pvd file entries of one time that follow each other are one
/// step. Error: no such file; no series; an entry without a file; a time not finite, or in a .series file not its own.
Result<std::vector<SeriesStep>> read_series(const std::string& path);

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

// Piecewise linear complexes (PLCs): polygons in space that bound and cut the region to be meshed.
//
// TetGen gets arrays: its own loaders read `010` as 8 and `1.0D+03` as 1, shift columns at a `nan`, ignore node numbers
// and crash on truncated files. In: .poly .smesh (nodes in the file or in STEM.node); .off, .obj; .stl and .ply, text
// or binary. Memory stays within a small multiple of the file's size. A number with which the file ends is taken, and
// told, for more digits may have been cut. Indices in memory are 0-based.

inline constexpr std::array<std::string_view, 6> plc_extensions{".poly", ".smesh", ".off", ".stl", ".ply", ".obj"};

/// The paths of the files that the PLC may be in: `path`, and STEM.node beside STEM.poly or STEM.smesh.
std::vector<std::string> plc_files(const std::string& path);

/// Reads the PLC in the format of the path's extension, from files or pipes. An error names file and, of text, line.
Result<Plc> read_plc(const std::string& path);

// Meshes in any of these formats.

struct ReadOptions {
    bool faces = true;       ///< read STEM.face if it is there, and Medit's triangles beside tetrahedra
    bool neighbours = true;  ///< read STEM.neigh if it is there
    int threads = 0;         ///< 0: as many as the machine has
    StepChoice step = {};    ///< of a series; Error: one is chosen, and there is no series
    /// False: image data and rectilinear grids of one piece without ghosts get Mesh::axes instead of points and cells,
    /// 8 bytes a node and less time. Locator::locate and Sampler::sample alone take them, with the same answers.
    bool list_grids = true;
};

/// Reads a mesh: TetGen's or Triangle's files by their stem or any one of them; a file of Gmsh, .msh, or Medit, .mesh
/// and .meshb; VTK's .vtu, .vtk, .vtp, .pvtu, .vtm, .pvd and .vtu.series. The format is told by the first bytes, or
/// else by the suffix. Error: a file of another format is named as what it is, with the command that converts it.
Result<Mesh> read_mesh(const std::string& path, const ReadOptions& options = {});

/// Reads triangles in space.
///
/// - .stl (text or binary; corners of equal coordinates are one node), .ply (text or binary), .off, .obj; .poly and
///   .smesh (read_plc); triangles of any file that read_mesh takes. Second-order triangles by their corners.
/// - A polygon is cut into triangles of its own corners: four corners at the lower one, unless only the other diagonal
///   leaves triangles that turn one way; more by a triangulation in the projection along the longest axis of its
///   normal, whose signs are exact. So is a facet of a PLC, with its holes. What cannot be cut (it crosses itself, or
///   is flat) is left out, and told. Surface::facets says which cells are of one polygon.
/// - Properties of .ply files that are numbers, and fields of meshes, are fields.
///
/// Error: as in read_plc and read_mesh; tetrahedra; no triangles.
Result<Surface> read_surface(const std::string& path, const ReadOptions& options = {});

/// A mesh, or triangles in space: of files that either may be in, triangles with z = 0 throughout are a mesh.
Result<std::variant<Mesh, Surface>> read_mesh_or_surface(const std::string& path, const ReadOptions& options = {});

/// The paths of all files that read_mesh(path) may read.
std::vector<std::string> mesh_files(const std::string& path);

/// STEM of STEM.node, STEM.ele, STEM.face or STEM.neigh; any other path as it is.
std::string tetgen_stem(const std::string& path);

/// The paths of the files that a mesh may be in, by its stem or any one of them: STEM.node, .ele, .face, .neigh.
std::vector<std::string> tetgen_files(const std::string& path);

/// Reads STEM.node and STEM.ele. `path` is the stem or the path of any one of its files.
Result<Mesh> read_tetgen(const std::string& path, const ReadOptions& options = {});

struct WriteOptions {
    std::string comment = {};     ///< TetGen's files: the last line of each, after "# "; empty: none
    VtkData data = VtkData::raw;  ///< VTK's files
};

/// Writes STEM.node and STEM.ele, and STEM.face and STEM.neigh where the mesh has faces and neighbours. Every double
/// reads back to the same bits. No file is left half-written.
Status write_tetgen(const Mesh& mesh, const std::string& stem, const WriteOptions& options = {});

/// Writes the mesh as its path ends: .msh, .vtu and .vtk, and TetGen's files by .node, .ele or a
/// stem. Error: another suffix; as these writers.
Status write_mesh(const Mesh& mesh, const std::string& path, const WriteOptions& options = {});

/// The files that write_mesh may write, or replace: the path, or STEM.node, .ele, .face, .neigh. Error: another suffix.
Result<std::vector<std::string>> written_mesh_files(const std::string& path);

// Streams of points: CSV and NPY files, block by block, so that memory does not grow with their number; the nodes of
// .node files and meshes.
//
// Coordinates are finite doubles (but see PointOptions); decimal numbers are rounded to nearest, ties to even. What
// cannot be read without a guess is an Error.
//
// The coordinates are the columns that PointOptions names; or x, y, z; Points:0, Points:1, Points:2; or Points_0,
// Points_1, Points_2, in any case and any place; or, in a file that names none, all columns, if they are as many as the
// dimension. Beside a mesh in the plane a column z must be 0 throughout.
//
// CSV    (also .txt .dat .xyz .tsv, and what comes from a pipe) One point a line, in UTF-8. The first line settles the
//        separator: the first of semicolon, comma and tab that it holds outside quotes, or else blanks. It is a header
//        if it names the coordinates, or if none of its fields is a number. Every line has as many fields. Fields may
//        stand in double quotes. Blank lines, and lines that begin with #, are passed over. Lines end in LF or CR LF;
//        the last may lack its end, but not where the file would end within a value that is read: 0.2 may be the
//        beginning of 0.25. At most 1 MiB a line. A named pipe is waited for.
// NPY    Versions 1 to 3; numbers of any integer or floating type up to 64 bits, of either byte order. One array of
//        shape (n, columns), in C or Fortran order, or a structured one of shape (n,): a field of several numbers is
//        the columns NAME.0, NAME.1, ... An integer that no double represents is an Error.
// .node  TetGen's and Triangle's grammar, see io/tetgen/tetgen_reader.cpp. Columns: attribute0, attribute1, ..., and
//        marker. All of it is in memory.
// meshes Any file that read_mesh takes. Columns: the fields of nodes, and marker. All of it is in memory.

/// Which columns of a file of points are taken for what.
struct PointOptions {
    /// Those of the coordinates, in the order of the axes: names, or numbers from 1. One text may hold several, with
    /// commas between them. Empty: see above.
    std::vector<std::string> columns = {};

    /// Columns to copy into the rows, likewise; "all" copies all but the coordinates; NEW=NAME renames one. Columns of
    /// files that name none are column1, column2, ...
    std::vector<std::string> keep = {};

    /// nan: points that are not finite are given as they are, and an empty field of a CSV file as NaN. Not for nodes of
    /// meshes, and not for a z that must be 0.
    NonfinitePoints nonfinite_points = NonfinitePoints::error;

    /// Of CSV: columns that are carried through become integers or numbers, if all their values are; texts otherwise.
    /// The file is read twice, and must not be a pipe. Without it they are texts, as they stand in the file.
    bool typed = false;
};

/// Points, block by block.
class PointSource {
public:
    virtual ~PointSource();

    /// Coordinates a point: 2 or 3, as asked for when opened.
    virtual int dimension() const = 0;

    /// The number of points, where it is known before the end.
    virtual std::optional<std::uint64_t> count() const = 0;

    /// Appends the coordinates of up to `max_points` points to `out` and returns how many: fewer only at the end, 0
    /// after it. On an Error the points before the fault may have been appended; it comes again from then on.
    virtual Result<std::size_t> read(std::size_t max_points, std::vector<double>& out) = 0;

    /// The columns that are carried through.
    virtual std::vector<ColumnFormat> carried() const { return {}; }

    /// Moves the carried columns of the points of the last read() to `columns`, a value a point.
    virtual void take_carried(std::vector<Column>& columns) { columns.clear(); }

    /// What of the file is left out, converted or guessed. Known when opened.
    virtual Notes notes() const { return {}; }
};

/// Opens the points of a CSV, NPY or .node file, of a mesh, or of VTK's files with or without cells (read_vtk_points);
/// "-" is CSV from the standard input. `dimension`: 2 or 3. Error: the file cannot be read, is of an unknown kind, or
/// has another dimension; there are no such columns.
Result<std::unique_ptr<PointSource>> open_points(const std::string& path, int dimension,
                                                 const PointOptions& options = {});

/// Points from memory, as they are. An incomplete last point is left out.
std::unique_ptr<PointSource> memory_points(std::vector<double> points, int dimension);

// Sampled values, row by row, into CSV and NPY files that appear whole or not at all.
//
// CSV  A header line x,y[,z],cell,feature,NAME...[,distance][,CARRIED...], then a line a row. Numbers are in their
//      shortest form that reads back to the same bits; nan, inf, -inf. Names and texts that hold a comma, a quote or a
//      line end, or that begin or end with a blank, are quoted, and quotes in them doubled.
// NPY  One structured array: x, y[, z] float64, cell int64, feature bytes of 8, each column float64, [distance
//      float64], carried columns int64, float64, or text: U, characters, if ColumnFormat::max_characters is not 0, else
//      S, bytes; all little-endian. Names must differ from one another; UTF-8.

/// What a file of rows has: points, cell, feature, the columns of the fields, and perhaps distances.
struct TableFormat {
    int dimension = 3;
    std::vector<TableField> fields = {};
    bool distances = false;                  ///< a column `distance` after the fields
    std::vector<ColumnFormat> carried = {};  ///< columns that are carried through: the last ones
    VtkData vtk_data = VtkData::raw;         ///< of a .vtu file

    std::vector<std::string> columns() const { return column_names(fields); }
};

/// Takes rows, block by block: a file, a picture, a mesh. Without a commit() nothing appears but on standard output.
class TableSink {
public:
    virtual ~TableSink();

    /// Appends the rows. Error: disk full and the like, or spans whose sizes do not fit together; then nothing appears.
    virtual Status write(const TableView& rows) = 0;

    /// Makes the file appear, if nothing failed. Nothing may be written after it.
    virtual Status commit() = 0;
};

/// Opens a CSV, NPY or .vtu file by the suffix of the path; "-" is CSV on the standard output. Error: another suffix;
/// the path cannot be written; NumPy would refuse a name.
Result<std::unique_ptr<TableSink>> open_table(const std::string& path, const TableFormat& format);

}  // namespace barycert
