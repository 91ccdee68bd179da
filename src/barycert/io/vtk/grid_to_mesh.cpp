#include "barycert/io/vtk/grid_to_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "barycert/base/finite.hpp"
#include "barycert/base/text.hpp"
#include "barycert/io/other_formats.hpp"
#include "barycert/io/vtk/cell_types.hpp"
#include "barycert/io/vtk/parallel.hpp"

namespace barycert::io {
namespace {

enum class Kind : std::uint8_t { tetrahedron, triangle, lower, other };

struct CellType {
    Kind kind = Kind::other;
    std::size_t nodes = 0;  ///< of tetrahedra and triangles
};

CellType cell_type(std::uint8_t type) {
    switch (type) {
        case vtk_tetra:
            return {Kind::tetrahedron, 4};
        case vtk_quadratic_tetra:
            return {Kind::tetrahedron, 10};
        case vtk_triangle:
            return {Kind::triangle, 3};
        case vtk_quadratic_triangle:
            return {Kind::triangle, 6};
        case vtk_empty_cell:
        case vtk_vertex:
        case vtk_poly_vertex:
        case vtk_line:
        case vtk_poly_line:
        case vtk_quadratic_edge:
        case vtk_cubic_line:
        case vtk_lagrange_curve:
            return {Kind::lower, 0};
        default:
            return {};
    }
}

std::string name_of(std::uint8_t type) {
    return vtk_class_name(type) + " (type " + std::to_string(type) + ")";
}

using TypeCounts = std::array<std::size_t, 256>;

/// "7944 vtkLine, 2564 vtkTriangle" of the types for which `is_one` holds.
template <class IsOne>
std::string counts_by_name(const TypeCounts& counts, bool with_numbers, IsOne is_one) {
    std::string text;
    for (std::size_t type = 0; type < counts.size(); ++type) {
        const auto number = static_cast<std::uint8_t>(type);
        if (counts[type] == 0 || !is_one(number)) continue;
        text += (text.empty() ? "" : ", ") + std::to_string(counts[type]) + " " +
                (with_numbers ? name_of(number) : vtk_class_name(number));
    }
    return text;
}

/// Which cells make the mesh.
struct Choice {
    Kind kind = Kind::other;
    std::size_t nodes = 0;
    std::size_t cells = 0;
};

bool is_uniform(const std::vector<std::uint8_t>& types) {
    return types.size() < 2 || std::memcmp(types.data(), types.data() + 1, types.size() - 1) == 0;
}

TypeCounts count_types(const RawGrid& grid) {
    TypeCounts counts{};
    if (is_uniform(grid.types)) {
        if (!grid.types.empty()) counts[grid.types.front()] = grid.types.size();
        return counts;
    }
    for (const std::uint8_t type : grid.types) ++counts[type];
    return counts;
}

/// Polygons of any order: triangles, once they are cut, and nothing more.
bool is_surface(std::uint8_t type) {
    constexpr std::array<std::uint8_t, 15> surfaces{6, 7, 8, 9, 23, 28, 30, 34, 36, 61, 62, 69, 70, 76, 77};
    return cell_type(type).kind != Kind::tetrahedron &&
           (cell_type(type).kind != Kind::other || std::find(surfaces.begin(), surfaces.end(), type) != surfaces.end());
}

Result<Choice> choose(const TypeCounts& counts, const RawGrid& grid, const std::string& path) {
    const std::size_t cells = grid.types.size();
    const std::string others =
        counts_by_name(counts, true, [](std::uint8_t type) { return cell_type(type).kind == Kind::other; });
    if (!others.empty()) {
        return Error{.what = "cells that are neither tetrahedra nor triangles",
                     .file = path,
                     .line = 0,
                     .expected = "tetrahedra or triangles, linear or quadratic",
                     .found = others,
                     .remedy = std::all_of(grid.types.begin(), grid.types.end(), is_surface) && !in_plane(grid.points)
                                   ? plane_remedy(grid.points, {})
                                   : to_simplices(path)};
    }
    constexpr std::array<std::pair<std::uint8_t, std::uint8_t>, 2> pairs{
        {{vtk_tetra, vtk_quadratic_tetra}, {vtk_triangle, vtk_quadratic_triangle}}};
    for (const auto& [linear, quadratic] : pairs) {
        if (counts[linear] != 0 && counts[quadratic] != 0) {
            return Error{.what = "linear and quadratic cells in one mesh",
                         .file = path,
                         .line = 0,
                         .expected = "cells of one type",
                         .found = std::to_string(counts[linear]) + " " + name_of(linear) + ", " +
                                  std::to_string(counts[quadratic]) + " " + name_of(quadratic),
                         .remedy = "make all cells linear, or all quadratic: " + to_simplices(path)};
        }
        for (const std::uint8_t type : {linear, quadratic}) {
            if (counts[type] != 0) return Choice{cell_type(type).kind, cell_type(type).nodes, counts[type]};
        }
    }
    return Error{.what = "the file contains no mesh",
                 .file = path,
                 .line = 0,
                 .expected = "tetrahedra or triangles",
                 .found = std::to_string(cells) + " cells of other kinds",
                 .remedy = "name a file with cells; this one may contain points only"};
}

Error error_of_cell(const std::string& path, std::size_t cell, std::string what, std::string expected,
                    std::string found) {
    return {.what = std::move(what) + " of cell " + std::to_string(cell) + " (from 0)",
            .file = path,
            .line = 0,
            .expected = std::move(expected),
            .found = std::move(found)};
}

/// Every node a point, and the simplices with as many nodes as their type has.
Status check_cells(const RawGrid& grid, const std::string& path) {
    const std::size_t points = grid.point_count();
    if (!grid.checked_nodes) {
        const std::size_t wrong = first_wrong_node(grid.connectivity, 0, points);
        if (wrong != grid.connectivity.size()) {
            std::size_t cell = 0;
            while (static_cast<std::size_t>(grid.ends[cell]) <= wrong) ++cell;
            return error_of_cell(path, cell, "a node", "a point below " + std::to_string(points),
                                 std::to_string(grid.connectivity[wrong]));
        }
    }
    if (!grid.types.empty() && is_uniform(grid.types)) {
        // As most files have it: each cell ends behind those before it.
        const auto nodes = static_cast<std::int64_t>(cell_type(grid.types.front()).nodes);
        std::int64_t end = 0, differs = 0;
        for (const std::int64_t own : grid.ends) {
            end += nodes;
            differs |= own ^ end;
        }
        if (differs == 0 && nodes != 0) return Done{};
    }
    std::int64_t begin = 0;
    for (std::size_t cell = 0; cell < grid.types.size(); ++cell) {
        const auto nodes = static_cast<std::size_t>(grid.ends[cell] - std::exchange(begin, grid.ends[cell]));
        const CellType type = cell_type(grid.types[cell]);
        if (type.kind == Kind::lower || nodes == type.nodes) continue;
        return error_of_cell(path, cell, "the nodes", std::to_string(type.nodes) + " in a " + name_of(grid.types[cell]),
                             std::to_string(nodes));
    }
    return Done{};
}

/// Cells that stand for others, or for none: bits of VTK's array of that name.
constexpr const char* ghost_name = "vtkGhostType";
constexpr unsigned duplicate_cell = 1, refined_cell = 8, hidden_cell = 32;

/// The numbers of the cells that make the mesh; empty if that is all of them. Others are counted.
std::vector<Mesh::Index> kept_cells(const RawGrid& grid, const Choice& choice, TypeCounts& left_out,
                                    std::size_t& ghosts) {
    const Field* ghost = nullptr;
    for (const RawArray& array : grid.cell_arrays) {
        if (array.field.name == ghost_name && array.fault.empty() && !array.has_labels && array.field.components == 1)
            ghost = &array.field;
    }
    const auto is_ghost = [&](std::size_t cell) {
        if (ghost == nullptr) return false;
        const double flags = ghost->data[cell];
        return flags >= 0 && flags < 256 &&
               (static_cast<unsigned>(flags) & (duplicate_cell | refined_cell | hidden_cell)) != 0;
    };
    std::vector<Mesh::Index> kept;
    if (choice.cells == grid.types.size() && ghost == nullptr) return kept;
    kept.reserve(choice.cells);
    for (std::size_t cell = 0; cell < grid.types.size(); ++cell) {
        if (cell_type(grid.types[cell]).kind != choice.kind) {
            ++left_out[grid.types[cell]];
        } else if (is_ghost(cell)) {
            ++ghosts;
        } else {
            kept.push_back(static_cast<Mesh::Index>(cell));
        }
    }
    if (kept.size() == grid.types.size()) kept.clear();
    return kept;
}

/// Corners and mid-edge nodes of the cells that were chosen, in the order of the file.
void copy_cells(RawGrid& grid, const Choice& choice, Mesh& mesh) {
    const std::size_t corners = mesh.corners(), count = choice.cells, mids = choice.nodes - corners;
    if (mesh.cell_numbers.empty() && mids == 0) {
        mesh.cells = std::move(grid.connectivity);
        return;
    }
    make_room(mesh.cells, count * corners);
    mesh.cells.resize(count * corners);
    make_room(mesh.mid_nodes, count * mids);
    mesh.mid_nodes.resize(count * mids);
    in_parts(count, std::size_t{1} << 15, [&](std::size_t first, std::size_t last) {
        for (std::size_t cell = first; cell < last; ++cell) {
            const auto own = static_cast<std::size_t>(mesh.cell_number(static_cast<Mesh::Index>(cell)));
            const std::int32_t* const from =
                grid.connectivity.data() + (static_cast<std::size_t>(grid.ends[own]) - choice.nodes);
            std::copy_n(from, corners, mesh.cells.data() + cell * corners);
            std::copy_n(from + corners, mids, mesh.mid_nodes.data() + cell * mids);
        }
    });
}

template <class T>
void keep_rows(std::vector<T>& values, std::size_t components, const std::vector<Mesh::Index>& rows) {
    std::size_t to = 0;
    for (const Mesh::Index row : rows) {
        const std::size_t from = static_cast<std::size_t>(row) * components;
        for (std::size_t c = 0; c < components; ++c, ++to) {
            if (to != from + c) values[to] = std::move(values[from + c]);
        }
    }
    values.resize(to);
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

void note_left_out(const TypeCounts& left_out, std::size_t ghosts, Kind kind, const std::string& path, Notes& notes) {
    std::size_t cells = 0;
    for (const std::size_t count : left_out) cells += count;
    if (cells != 0) {
        notes.push_back({Note::Kind::left_out,
                         std::to_string(cells) + " cells that are no " +
                             (kind == Kind::tetrahedron ? "tetrahedra: " : "triangles: ") +
                             counts_by_name(left_out, false, [](std::uint8_t) { return true; }),
                         path, true});
    }
    if (ghosts != 0) {
        notes.push_back({Note::Kind::left_out,
                         std::to_string(ghosts) + " ghost cells, which stand for cells of other pieces or are hidden "
                                                  "(vtkGhostType)",
                         path, true});
    }
}

}  // namespace

Result<std::vector<double>> to_points(std::vector<double> points, int dimension, const std::string& path,
                                      const std::string& triangles) {
    std::size_t faulty = points.size();
    for (std::size_t first = 0; first < points.size() && faulty == points.size(); first += std::size_t{1} << 16) {
        const std::size_t last = std::min(points.size(), first + (std::size_t{1} << 16));
        if (base::all_finite({points.data() + first, last - first})) continue;
        for (faulty = first; std::isfinite(points[faulty]);) ++faulty;
    }
    if (faulty != points.size()) {
        constexpr std::array<const char*, 3> names{"x", "y", "z"};
        return coordinate_error(path, faulty / 3, names[faulty % 3], "a finite number", points[faulty],
                                "correct the point");
    }
    if (dimension == 3) return points;
    std::size_t to = 0;
    for (std::size_t i = 0; i < points.size(); i += 3) {
        if (points[i + 2] != 0) {
            return coordinate_error(path, i / 3, "z", "0, as the mesh is 2D", points[i + 2],
                                    // Those before have lost their z.
                                    plane_remedy(i == 0 ? points : std::vector<double>(), triangles));
        }
        points[to++] = points[i];
        points[to++] = points[i + 1];
    }
    points.resize(to);
    points.shrink_to_fit();
    return points;
}

std::string list_of(const std::vector<std::string>& names) {
    constexpr std::size_t most = 10;
    std::string text;
    for (std::size_t i = 0; i < names.size() && i < most; ++i) text += (i == 0 ? "" : ", ") + in_quotes(names[i]);
    if (names.size() > most) text += " and " + std::to_string(names.size() - most) + " others";
    return text;
}

void take_fields(std::vector<RawArray>& arrays, const std::string& what, const std::string& path,
                 std::vector<Field>& fields, std::vector<Column>* labels, Notes& notes) {
    std::vector<std::string> narrow;
    for (RawArray& array : arrays) {
        if (array.fault.empty() && array.has_labels && labels == nullptr) array.fault = "it holds no doubles";
        if (!array.fault.empty()) {
            notes.push_back(
                {Note::Kind::left_out, what + " " + in_quotes(array.field.name) + ": " + array.fault, path});
            continue;
        }
        if (array.is_narrow) narrow.push_back(array.field.name);
        if (array.has_labels) {
            labels->push_back({std::move(array.field.name), std::move(array.labels)});
        } else {
            fields.push_back(std::move(array.field));
        }
    }
    if (!narrow.empty())
        notes.push_back({Note::Kind::converted, "float32 to double: " + what + " " + list_of(narrow), path});
}

void note_the_rest(const RawGrid& grid, const std::string& path, Notes& notes) {
    if (grid.narrow_points) notes.push_back({Note::Kind::converted, "float32 to double: the coordinates", path});
    if (!grid.loose_arrays.empty()) {
        notes.push_back({Note::Kind::left_out,
                         "arrays of neither points nor cells (field data): " + list_of(grid.loose_arrays), path});
    }
    if (grid.has_steps)
        notes.push_back(
            {Note::Kind::left_out, "all steps but the first of arrays with several time steps", path, true});
}

Result<Mesh> to_mesh(RawGrid grid, const std::string& path) {
    const TypeCounts counts = count_types(grid);
    Result<Choice> choice = choose(counts, grid, path);
    if (!choice) return choice.error();
    Mesh mesh;
    mesh.dimension = choice->kind == Kind::tetrahedron ? 3 : 2;
    if (Status s = check_cells(grid, path); !s) return s.error();
    mesh.notes = std::move(grid.notes);
    TypeCounts left_out{};
    std::size_t ghosts = 0;
    mesh.cell_numbers = kept_cells(grid, *choice, left_out, ghosts);
    choice->cells -= ghosts;
    if (choice->cells == 0) {
        return Error{.what = "the file contains no mesh",
                     .file = path,
                     .expected = "cells of its own",
                     .found = std::to_string(ghosts) + " ghost cells (vtkGhostType)",
                     .remedy = "name the file of all pieces (.pvtu)"};
    }
    note_left_out(left_out, ghosts, choice->kind, path, mesh.notes);
    copy_cells(grid, *choice, mesh);
    if (choice->nodes != mesh.corners()) mesh.mid_edge_order = MidEdgeOrder::vtk;
    grid.connectivity = {};
    Result<std::vector<double>> points =
        to_points(std::move(grid.points), mesh.dimension, path, mesh.mid_nodes.empty() ? path : "");
    if (!points) return points.error();
    mesh.points = std::move(*points);
    if (!mesh.cell_numbers.empty()) {
        for (RawArray& array : grid.cell_arrays) {
            const auto components = static_cast<std::size_t>(array.field.components);
            if (!array.fault.empty()) continue;
            if (array.has_labels) {
                std::visit([&](auto& values) { keep_rows(values, 1, mesh.cell_numbers); }, array.labels);
                make_field_of_doubles(array);
            } else {
                keep_rows(array.field.data, components, mesh.cell_numbers);
            }
        }
    }
    // Point markers are an array like any other but for its name and type.
    for (std::size_t i = 0; i < grid.point_arrays.size(); ++i) {
        RawArray& array = grid.point_arrays[i];
        if (array.field.name != marker_name || !array.has_labels || !array.fault.empty()) continue;
        mesh.point_markers = std::move(std::get<std::vector<std::int64_t>>(array.labels));
        grid.point_arrays.erase(grid.point_arrays.begin() + static_cast<std::ptrdiff_t>(i));
        break;
    }
    take_fields(grid.point_arrays, "point array", path, mesh.point_fields, nullptr, mesh.notes);
    take_fields(grid.cell_arrays, "cell array", path, mesh.cell_fields, &mesh.cell_labels, mesh.notes);
    note_the_rest(grid, path, mesh.notes);
    return mesh;
}

}  // namespace barycert::io
