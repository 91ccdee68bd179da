/// A simplicial mesh with its fields, in memory.
///
/// Tetrahedra in 3-space or triangles in the plane. All indices are 0-based positions in file order, whatever base
/// the file used. Coordinates are finite doubles in the file's own unit.
#pragma once

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
    /// Of text: the longest that may come, in bytes; and in characters, if all are UTF-8, else 0. NPY files need them.
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

    int dimension = 3;           ///< 2: triangles in the plane; 3: tetrahedra
    std::vector<double> points;  ///< dimension coordinates a node
    std::vector<Index> cells;    ///< dimension + 1 vertices a cell

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

    /// The number in the file, from 0, of each cell, ascending. Empty if no cell of the file was left out.
    std::vector<Index> cell_numbers;
    Notes notes;  ///< what its readers left out, converted or guessed

    int index_base = 0;  ///< 0 or 1: the base of the file it came from, used again by the writer

    /// What users know the cell as.
    Index cell_number(Index cell) const {
        return cell_numbers.empty() || cell < 0 ? cell : cell_numbers[static_cast<std::size_t>(cell)];
    }
    std::size_t corners() const { return static_cast<std::size_t>(dimension) + 1; }
    std::size_t point_count() const { return points.size() / static_cast<std::size_t>(dimension); }
    std::size_t cell_count() const { return cells.size() / corners(); }
    std::size_t face_count() const { return faces.size() / 3; }
};

}  // namespace barycert
