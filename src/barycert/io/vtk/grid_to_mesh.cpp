#include "barycert/io/vtk/grid_to_mesh.hpp"

#include <vtkCellType.h>
#include <vtkCellTypes.h>

#include <array>
#include <cmath>
#include <utility>

#include "barycert/base/text.hpp"

namespace barycert::io {
namespace {

enum class Kind : std::uint8_t { tetrahedron, triangle, lower, other };

struct CellType {
    Kind kind = Kind::other;
    std::size_t nodes = 0;  ///< of tetrahedra and triangles
};

CellType cell_type(std::uint8_t type) {
    switch (type) {
        case VTK_TETRA:
            return {Kind::tetrahedron, 4};
        case VTK_QUADRATIC_TETRA:
            return {Kind::tetrahedron, 10};
        case VTK_TRIANGLE:
            return {Kind::triangle, 3};
        case VTK_QUADRATIC_TRIANGLE:
            return {Kind::triangle, 6};
        case VTK_EMPTY_CELL:
        case VTK_VERTEX:
        case VTK_POLY_VERTEX:
        case VTK_LINE:
        case VTK_POLY_LINE:
        case VTK_QUADRATIC_EDGE:
            return {Kind::lower, 0};
        default:
            return {};
    }
}

std::string name_of(std::uint8_t type) {
    return std::string(vtkCellTypes::GetClassNameFromTypeId(type)) + " (type " + std::to_string(type) + ")";
}

/// Which cells make the mesh.
struct Choice {
    Kind kind = Kind::other;
    std::size_t nodes = 0;
    std::size_t cells = 0;
};

Result<Choice> choose(const RawGrid& grid, const std::string& path) {
    std::array<std::size_t, 256> counts{};
    for (const std::uint8_t type : grid.types) ++counts[type];
    std::string others;
    for (std::size_t type = 0; type < counts.size(); ++type) {
        if (counts[type] == 0 || cell_type(static_cast<std::uint8_t>(type)).kind != Kind::other) continue;
        others += (others.empty() ? "" : ", ") + std::to_string(counts[type]) + " " +
                  name_of(static_cast<std::uint8_t>(type));
    }
    if (!others.empty()) {
        return Error{.what = "cells that are neither tetrahedra nor triangles",
                     .file = path,
                     .line = 0,
                     .expected = "tetrahedra or triangles, linear or quadratic",
                     .found = others,
                     .remedy = "cut them into simplices with vtkDataSetTriangleFilter (Tetrahedralize in ParaView)"};
    }
    constexpr std::array<std::pair<std::uint8_t, std::uint8_t>, 2> pairs{
        {{VTK_TETRA, VTK_QUADRATIC_TETRA}, {VTK_TRIANGLE, VTK_QUADRATIC_TRIANGLE}}};
    for (const auto& [linear, quadratic] : pairs) {
        if (counts[linear] != 0 && counts[quadratic] != 0) {
            return Error{.what = "linear and quadratic cells in one mesh",
                         .file = path,
                         .line = 0,
                         .expected = "cells of one type",
                         .found = std::to_string(counts[linear]) + " " + name_of(linear) + ", " +
                                  std::to_string(counts[quadratic]) + " " + name_of(quadratic),
                         .remedy = "make all cells linear, or all quadratic"};
        }
        for (const std::uint8_t type : {linear, quadratic}) {
            if (counts[type] != 0) return Choice{cell_type(type).kind, cell_type(type).nodes, counts[type]};
        }
    }
    return Error{.what = "the file contains no mesh",
                 .file = path,
                 .line = 0,
                 .expected = "tetrahedra or triangles",
                 .found = std::to_string(grid.types.size()) + " cells of other kinds",
                 .remedy = "name a file with cells; this one may contain points only"};
}

/// Corners and mid-edge nodes of the cells that were chosen, in the order of the file.
Status copy_cells(const RawGrid& grid, const Choice& choice, const std::string& path, Mesh& mesh) {
    const std::size_t corners = mesh.corners(), points = grid.points.size() / 3;
    mesh.cells.reserve(choice.cells * corners);
    mesh.mid_nodes.reserve(choice.cells * (choice.nodes - corners));
    const auto error = [&](std::size_t cell, std::string what, std::string expected, std::string found) {
        return Error{.what = std::move(what) + " of cell " + std::to_string(cell) + " (from 0)",
                     .file = path,
                     .line = 0,
                     .expected = std::move(expected),
                     .found = std::move(found)};
    };
    std::size_t begin = 0;
    for (std::size_t cell = 0; cell < grid.types.size(); ++cell) {
        const auto end = static_cast<std::size_t>(grid.ends[cell]);
        const std::size_t first = std::exchange(begin, end);
        for (std::size_t i = first; i < end; ++i) {
            const std::int32_t node = grid.connectivity[i];
            if (node < 0 || static_cast<std::size_t>(node) >= points) {
                return error(cell, "a node", "a point below " + std::to_string(points), std::to_string(node));
            }
        }
        const CellType type = cell_type(grid.types[cell]);
        if (type.kind == Kind::lower) continue;
        if (end - first != type.nodes) {
            return error(cell, "the nodes", std::to_string(type.nodes) + " in a " + name_of(grid.types[cell]),
                         std::to_string(end - first));
        }
        if (type.kind != choice.kind) continue;
        for (std::size_t i = first; i < end; ++i) {
            (i < first + corners ? mesh.cells : mesh.mid_nodes).push_back(grid.connectivity[i]);
        }
    }
    return Done{};
}

/// The rows of the cells that were chosen.
void keep_rows(const RawGrid& grid, Kind kind, Field& field) {
    const auto components = static_cast<std::size_t>(field.components);
    std::size_t to = 0;
    for (std::size_t cell = 0; cell < grid.types.size(); ++cell) {
        if (cell_type(grid.types[cell]).kind != kind) continue;
        for (std::size_t c = 0; c < components; ++c) field.data[to++] = field.data[cell * components + c];
    }
    field.data.resize(to);
}

/// Fields out of arrays of `rows` rows.
void take_fields(std::vector<RawArray>& arrays, std::vector<Field>& fields, std::vector<VtkLeftOut::Array>* left_out) {
    for (RawArray& array : arrays) {
        if (array.fault.empty()) {
            fields.push_back(std::move(array.field));
        } else if (left_out != nullptr) {
            left_out->push_back({std::move(array.field.name), std::move(array.fault)});
        }
    }
}

Error coordinate_error(const std::string& path, std::size_t point, const char* what, std::string expected, double found,
                       std::string remedy) {
    return {.what = std::string(what) + " of point " + std::to_string(point) + " (from 0)",
            .file = path,
            .line = 0,
            .expected = std::move(expected),
            .found = base::shortest(found),
            .remedy = std::move(remedy)};
}

}  // namespace

Result<std::vector<double>> to_points(std::vector<double> points, int dimension, const std::string& path) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!std::isfinite(points[i])) {
            constexpr std::array<const char*, 3> names{"x", "y", "z"};
            return coordinate_error(path, i / 3, names[i % 3], "a finite number", points[i], "correct the point");
        }
    }
    if (dimension == 3) return points;
    std::size_t to = 0;
    for (std::size_t i = 0; i < points.size(); i += 3) {
        if (points[i + 2] != 0) {
            return coordinate_error(path, i / 3, "z", "0, as the mesh is 2D", points[i + 2],
                                    "project onto the plane z = 0; surfaces in space are not meshes here");
        }
        points[to++] = points[i];
        points[to++] = points[i + 1];
    }
    points.resize(to);
    points.shrink_to_fit();
    return points;
}

Result<Mesh> to_mesh(RawGrid grid, const std::string& path, VtkLeftOut* left_out) {
    const Result<Choice> choice = choose(grid, path);
    if (!choice) return choice.error();
    Mesh mesh;
    mesh.dimension = choice->kind == Kind::tetrahedron ? 3 : 2;
    if (Status s = copy_cells(grid, *choice, path, mesh); !s) return s.error();
    if (choice->nodes != mesh.corners()) mesh.mid_edge_order = MidEdgeOrder::vtk;
    grid.connectivity = {};
    Result<std::vector<double>> points = to_points(std::move(grid.points), mesh.dimension, path);
    if (!points) return points.error();
    mesh.points = std::move(*points);
    if (left_out != nullptr)
        *left_out = {.cells = grid.types.size() - choice->cells, .point_arrays = {}, .cell_arrays = {}};
    for (RawArray& array : grid.cell_arrays) {
        if (array.fault.empty() && choice->cells != grid.types.size()) keep_rows(grid, choice->kind, array.field);
    }
    take_fields(grid.point_arrays, mesh.point_fields, left_out != nullptr ? &left_out->point_arrays : nullptr);
    take_fields(grid.cell_arrays, mesh.cell_fields, left_out != nullptr ? &left_out->cell_arrays : nullptr);
    mesh.point_markers = std::move(grid.point_markers);
    return mesh;
}

}  // namespace barycert::io
