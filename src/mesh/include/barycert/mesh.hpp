/// A mesh with its fields, in memory.
///
/// Tetrahedra in 3-space or triangles in the plane; cells of other shapes are cut into these. All indices are 0-based
/// positions in file order, whatever base the file used. Coordinates are finite doubles in the file's own unit.
///
/// Example:
///
///     Mesh mesh;
///     mesh.dimension = 2;
///     mesh.points = {0, 0, 1, 0, 0, 1, 1, 1};
///     mesh.cells = {0, 1, 2, 1, 3, 2};
///     mesh.point_fields = {{"T", 1, {20, 21, 22, 23}}};
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "barycert/result.hpp"

namespace barycert {

// Columns that are carried through as they are: regions, names of materials, ids and times of points.

struct Column {
    enum class Type : std::uint8_t { integer, number, text };  ///< in the order of the alternatives of `values`
    using Values = std::variant<std::vector<std::int64_t>, std::vector<double>, std::vector<std::string>>;

    std::string name;
    Values values;  ///< one an entity

    Type type() const { return static_cast<Type>(values.index()); }
    std::size_t size() const {
        return std::visit([](const auto& all) { return all.size(); }, values);
    }
};

/// A column without its values.
struct ColumnFormat {
    std::string name;
    Column::Type type = Column::Type::integer;
    /// The longest text that may come, in bytes; and in characters if all are UTF-8, else 0. NPY files need them.
    std::size_t max_bytes = 0, max_characters = 0;

    friend bool operator==(const ColumnFormat&, const ColumnFormat&) = default;
};

/// An empty column of that format.
inline Column empty_column(const ColumnFormat& format) {
    Column column{format.name, {}};
    if (format.type == Column::Type::number) column.values = std::vector<double>();
    if (format.type == Column::Type::text) column.values = std::vector<std::string>();
    return column;
}

/// One value of `components` numbers at each node or cell: entity i, component c stands at data[i * components + c].
struct Field {
    std::string name;
    int components = 1;
    std::vector<double> data;
};

/// The order in which a file lists the nodes at mid-edges of a second-order cell, by the corners of their edges.
enum class MidEdgeOrder : std::uint8_t {
    none,      ///< linear cells
    vtk,       ///< 01 12 02 03 13 23 (TetGen 1.4, VTK); triangles 01 12 02
    tetgen15,  ///< 23 03 01 12 13 02 (TetGen 1.5, 1.6)
    gmsh,      ///< 01 12 02 03 23 13
    triangle,  ///< 12 02 01 (Triangle)
};

struct Mesh {
    using Index = std::int32_t;

    /// Cells that are no simplices, as their file has them. Pulling cuts each cell and each of its faces at its node of
    /// lowest number, so that neighbours agree. The simplices are the mesh's `cells`; `parts` has the index of the
    /// first of each.
    struct Shapes {
        std::vector<std::uint8_t> types;      ///< VTK's numbers, 5 to 16 and 42; empty in a mesh of simplices
        std::vector<std::int64_t> ends;       ///< for each shape, the end of its nodes in `nodes`
        std::vector<Index> nodes;             ///< the nodes of all shapes, each in VTK's order
        std::vector<std::int64_t> face_ends;  ///< for each shape, the end of its faces; empty if there are no polyhedra
        std::vector<std::int64_t> ring_ends;  ///< for each face of a polyhedron, the end of its nodes in `rings`
        std::vector<Index> rings;             ///< the nodes of the faces of polyhedra
        std::vector<Index> parts;             ///< for each shape, the first of its cells; then the number of all cells
        std::vector<std::uint16_t> inside;    ///< for each cell, which facets and edges lie inside (mesh/pulling.hpp)

        std::size_t count() const { return types.size(); }
        std::span<const Index> nodes_of(std::size_t shape) const {
            const std::int64_t begin = shape == 0 ? 0 : ends[shape - 1];
            return {nodes.data() + begin, nodes.data() + ends[shape]};
        }
        friend bool operator==(const Shapes&, const Shapes&) = default;
    };

    int dimension = 3;           ///< 2: triangles in the plane; 3: tetrahedra
    std::vector<double> points;  ///< dimension coordinates a node
    std::vector<Index> cells;    ///< dimension + 1 vertices a cell
    Shapes shapes;               ///< what `cells` were cut from; empty if the file has simplices
    /// Increasing coordinates along each axis of a grid whose nodes and cells are not listed (ReadOptions::list_grids);
    /// the first axis runs fastest. Then points, cells and shapes are empty. Else these are empty.
    std::array<std::vector<double>, 3> axes;

    /// Nodes at mid-edges in the order `vtk` whatever the file's, 6 a tetrahedron or 3 a triangle; empty if linear.
    std::vector<Index> mid_nodes;
    MidEdgeOrder mid_edge_order = MidEdgeOrder::none;  ///< the order found in the file, and written again

    std::vector<Field> point_fields;          ///< attributes of a .node file are attribute0, attribute1, ...
    std::vector<Field> cell_fields;           ///< likewise of an .ele file
    std::vector<Column> cell_labels;          ///< of cells, and no fields: texts, integers that no double represents
    std::vector<std::int64_t> point_markers;  ///< empty, or one a node

    std::vector<Index> faces;                ///< 3 corners a face of the .face file; empty in 2D or if there is none
    std::vector<Index> face_mid_nodes;       ///< as in the file: 3 a face, or empty
    std::vector<std::int64_t> face_markers;  ///< empty, or one a face

    /// Cell across the facet opposite to each corner, -1 where there is none: dimension + 1 a cell, or empty.
    std::vector<Index> neighbours;

    /// The number in the file, from 0, of each cell, ascending; the parts of a shape have one. Empty: as in the file.
    std::vector<Index> cell_numbers;
    /// Cells of a higher order that are taken by their corners: their other nodes, and values there, are left out.
    std::uint64_t by_corners = 0;
    Notes notes;  ///< what its readers left out, converted or guessed

    int index_base = 0;  ///< 0 or 1: the base of the file it came from, used again by the writer

    /// The number by which users know the cell.
    Index cell_number(Index cell) const {
        return cell_numbers.empty() || cell < 0 ? cell : cell_numbers[static_cast<std::size_t>(cell)];
    }
    std::size_t corners() const { return static_cast<std::size_t>(dimension) + 1; }
    /// Returns the coordinates of a node, and the nodes of a cell. Requires is_listed().
    const double* point(Index node) const {
        return points.data() + static_cast<std::size_t>(dimension) * static_cast<std::size_t>(node);
    }
    std::span<const Index> corners_of(std::size_t cell) const {
        return std::span(cells).subspan(cell * corners(), corners());
    }
    bool is_listed() const { return axes[0].empty(); }
    std::size_t point_count() const {
        return is_listed() ? points.size() / static_cast<std::size_t>(dimension) : count_along_axes(0);
    }
    std::size_t cell_count() const { return is_listed() ? cells.size() / corners() : count_along_axes(1); }
    /// Cells as users know them.
    std::size_t whole_count() const { return shapes.types.empty() ? cell_count() : shapes.count(); }
    std::size_t face_count() const { return faces.size() / 3; }

private:
    std::size_t count_along_axes(std::size_t less) const {
        return (axes[0].size() - less) * (axes[1].size() - less) * (dimension == 2 ? 1 : axes[2].size() - less);
    }
};

/// Simplices of order 2 to 4 whose sides are not straight. Locators and samplers take them as they are (locator.hpp).
/// Everything else takes straight sides: its results are exact for these, and hold for the file's own shapes only up to
/// about `max_deviation`.
///
/// The deviation of a node is its distance from its place in the straight cell, divided by a length. In a cell of order
/// 2 the place is the middle of an edge, and the length that of the edge; in order 3 and 4 the place lies amid corners,
/// and the length is that of the longest edge between these. The node is
///   straight  if it is exactly there, or there up to rounding: on each axis it is one of the two numbers nearest to
///             the place among doubles, floats if all coordinates are floats, or decimal numbers of the mesh's digits
///             (mesh/straight_nodes.hpp); the last two at most 1/1000 of the edge off. A node off by rounding is taken
///             as being there in a mesh whose cells are all of one type of order 2; in others (Mesh::shapes) it is
///             taken as the file has it;
///   a curve   otherwise.
struct CurvedCells {
    std::uint64_t cells = 0;          ///< with a node off by a curve
    double max_deviation = 0;         ///< of such nodes
    std::uint64_t rounded_cells = 0;  ///< cells with a node off by rounding, curved or not
    double max_rounded = 0;           ///< the largest deviation of such a node
    std::uint64_t by_corners = 0;     ///< Mesh::by_corners
    bool mapped = false;              ///< curved cells are taken as they are
    bool rounded_too = false;         ///< if `mapped`, nodes off by rounding are taken as they are, too (Mesh::shapes)
};

/// Measures the curved cells. Ignores cells with an index that is no node, and coordinates that are not finite. `each`,
/// if given, gets for each cell a bit for each of its mid-edge nodes that is off the middle by a curve (for cells among
/// shapes 1 if any is); it is empty if no node is. `exact`: a node off by rounding is a curve, too.
CurvedCells curved_cells(const Mesh& mesh, std::vector<std::uint8_t>* each = nullptr, bool exact = false);

/// Describes them in a sentence or more, joined by "; "; empty if all sides are straight and no cell is taken by its
/// corners.
std::string message(const CurvedCells& curved);

/// Ways to take curved cells. `exact`: as isoparametric, with each node as it is, off by rounding or not.
enum class Curved : std::uint8_t { isoparametric, straight, refuse, exact };

/// Measures the curved cells as `curved` takes them. Error: there are curved cells, and `curved` is Curved::refuse.
/// `file` is what the user calls the mesh.
Result<CurvedCells> measure_curved(const Mesh& mesh, const std::string& file, Curved curved);

}  // namespace barycert
