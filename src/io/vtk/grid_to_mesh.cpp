#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "barycert/error_codes.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "core/base/finite.hpp"
#include "core/base/large_pages.hpp"
#include "core/base/text.hpp"
#include "core/vtk_cell.hpp"
#include "io/errors.hpp"
#include "io/in_space.hpp"
#include "io/mesh_notes.hpp"
#include "io/other_formats.hpp"
#include "io/parallel.hpp"
#include "io/vtk/numbers.hpp"
#include "io/vtk/raw_grid.hpp"
#include "mesh/cell_types.hpp"
#include "mesh/consistency.hpp"
#include "mesh/facets/facet_triangles.hpp"

namespace barycert::io {
namespace {

std::string name_of(std::uint8_t type) {
    return cell_types()[type].name() + " (type " + std::to_string(type) + ")";
}

/// How many cells there are of each type, if there are any.
using TypeCounts = std::map<std::uint8_t, std::size_t>;

/// "7944 vtkLine, 2564 vtkTriangle" of the types for which `is_one` holds.
template <class IsOne>
std::string counts_by_name(const TypeCounts& counts, bool with_numbers, IsOne is_one) {
    return base::joined(counts, ", ", [&](const TypeCounts::value_type& one) {
        const auto [type, count] = one;
        if (!is_one(type)) return std::string();
        return std::to_string(count) + " " + (with_numbers ? name_of(type) : cell_types()[type].name());
    });
}

bool is_uniform(const std::vector<std::uint8_t>& types) {
    return types.size() < 2 || std::memcmp(types.data(), types.data() + 1, types.size() - 1) == 0;
}

TypeCounts count_types(const RawGrid& grid) {
    if (grid.types.empty()) return {};
    if (is_uniform(grid.types)) return {{grid.types.front(), grid.types.size()}};
    std::array<std::size_t, 256> all{};
    for (const std::uint8_t type : grid.types) ++all[type];
    TypeCounts counts;
    for (std::size_t type = 0; type < all.size(); ++type) {
        if (all[type] != 0) counts[static_cast<std::uint8_t>(type)] = all[type];
    }
    return counts;
}

/// Makes triangles of all polygons in space, by their corners, where there are no cells that fill it.
void cut_polygons(RawGrid& grid, const TypeCounts& counts, const std::string& path, InSpace& space, Notes& notes) {
    std::size_t polygons = 0;
    for (const auto& [type, count] : counts) {
        const CellKind kind = cell_types()[type].kind;
        if (kind == CellKind::other || cell_types()[type].dimension() == 3) return;
        polygons += kind == CellKind::surface ? count : 0;
    }
    const bool mixed = counts.contains(vtk_quadratic_triangle) && counts.contains(vtk_triangle);
    if ((polygons == 0 && !mixed) || in_plane(grid.points)) return;
    RawCells cells;
    std::vector<std::int32_t> rows;  // the polygon of each triangle
    std::size_t uncut = 0, by_corners = 0;
    for (std::size_t cell = 0; cell < grid.types.size(); ++cell) {
        const CellType& type = cell_types()[grid.types[cell]];
        const std::span nodes = grid.cells.nodes(cell);
        if (type.kind == CellKind::lower) continue;
        by_corners += mesh::corners_of(type, nodes).size() < nodes.size() && type.kind == CellKind::surface ? 1 : 0;
        uncut += surface::add_triangles(grid.points, type, nodes, cells.connectivity);
        rows.resize(cells.connectivity.size() / 3, static_cast<std::int32_t>(cell));
    }
    if (rows.empty()) return;
    const auto note = [&](std::size_t count, const char* what, Note::Kind kind) {
        if (count != 0) notes.push_back({kind, std::to_string(count) + what, path, true});
    };
    note(polygons, " polygons, which are cut into triangles of their corners", Note::Kind::converted);
    note(by_corners, " polygons of a higher order: they are taken by their corners", Note::Kind::converted);
    note(uncut, " polygons that are no simple ones, and cannot be cut", Note::Kind::left_out);
    for (std::size_t i = 1; i <= rows.size(); ++i) cells.ends.push_back(static_cast<std::int64_t>(3 * i));
    grid.cells = std::move(cells);
    grid.types.assign(rows.size(), vtk_triangle);
    keep_rows(grid.cell_arrays, rows);
    space.facets = std::move(rows);
}

/// The dimension of the cells that make the mesh.
int choose(const TypeCounts& counts, const RawGrid& grid, const std::string& path) {
    int dimension = 0;
    for (const auto& [type, count] : counts) dimension = std::max(dimension, cell_types()[type].dimension());
    const std::string others =
        counts_by_name(counts, true, [](std::uint8_t type) { return cell_types()[type].kind == CellKind::other; });
    if (!others.empty())
        refuse_file("mesh.cell-type", path, "cells whose corners are not known",
                    "polygons, polyhedra and what has a shape of its own", others, to_simplices(path));
    if (dimension == 0)
        refuse_file("mesh.empty", path, "the file contains no mesh",
                    "cells that fill space, or polygons in the plane z = 0",
                    std::to_string(grid.types.size()) + " cells of other kinds",
                    "name a file with cells; this one may contain points only");
    return dimension;
}

/// Cells have as many nodes as their type has.
void check_cells(const RawGrid& grid, const std::string& path) {
    const std::array<CellType, 256>& types = cell_types();
    if (!grid.types.empty() && is_uniform(grid.types)) {
        // As most files have it: each cell ends behind those before it.
        const auto nodes = static_cast<std::int64_t>(types[grid.types.front()].nodes);
        std::int64_t end = 0, differs = 0;
        for (const std::int64_t own : grid.cells.ends) {
            end += nodes;
            differs |= own ^ end;
        }
        if (differs == 0 && nodes != 0) return;
    }
    for (std::size_t cell = 0; cell < grid.types.size(); ++cell) {
        const std::size_t nodes = grid.cells.nodes(cell).size();
        const CellType& type = types[grid.types[cell]];
        if (type.kind == CellKind::lower || type.kind == CellKind::other) continue;
        const std::size_t least = type.corners;
        if (type.nodes != 0 ? nodes != type.nodes : nodes < least)
            refuse_file("mesh.node-count", path, "the nodes of cell " + std::to_string(cell) + " (from 0)",
                        (type.nodes != 0 ? std::to_string(type.nodes) : std::to_string(least) + " or more") + " in a " +
                            name_of(grid.types[cell]),
                        std::to_string(nodes));
        if (type.linear == vtk_polyhedron && grid.faces.face_ends.empty())
            refuse_file("mesh.faces", path, "the faces of cell " + std::to_string(cell) + " (from 0)",
                        "those of a polyhedron", "none");
    }
}

/// Cells that stand for others, or for none: bits of the array ghost_name.
constexpr unsigned duplicate_cell = 1, refined_cell = 8, hidden_cell = 32;

/// The numbers of the cells that make the mesh; empty if that is all of them. Ghosts are counted.
std::vector<Mesh::Index> kept_cells(const RawGrid& grid, int dimension, std::size_t& ghosts) {
    const auto ghost = std::ranges::find_if(grid.cell_arrays, &RawArray::is_ghost_flags);
    const auto is_ghost = [&](std::size_t cell) {
        if (ghost == grid.cell_arrays.end()) return false;
        const double flags = ghost->numbers()[cell];
        return flags >= 0 && flags < 256 &&
               (static_cast<unsigned>(flags) & (duplicate_cell | refined_cell | hidden_cell)) != 0;
    };
    const std::array<CellType, 256>& types = cell_types();
    std::vector<Mesh::Index> kept;
    if (ghost == grid.cell_arrays.end() && is_uniform(grid.types)) return kept;
    for (std::size_t cell = 0; cell < grid.types.size(); ++cell) {
        if (types[grid.types[cell]].dimension() != dimension) continue;
        if (is_ghost(cell)) {
            ++ghosts;
        } else {
            kept.push_back(static_cast<Mesh::Index>(cell));
        }
    }
    if (kept.size() == grid.types.size()) kept.clear();
    return kept;
}

/// Corners and mid-edge nodes of the cells that were chosen, in the order of the file.
void copy_cells(RawGrid& grid, std::size_t nodes, std::size_t count, Mesh& mesh) {
    const std::size_t corners = mesh.corners(), mids = nodes - corners;
    if (mesh.cell_numbers.empty() && mids == 0) {
        mesh.cells = std::move(grid.cells.connectivity);
        return;
    }
    base::resize_large(mesh.cells, count * corners);
    base::resize_large(mesh.mid_nodes, count * mids);
    in_parts(count, std::size_t{1} << 15, [&](std::size_t first, std::size_t last) {
        for (std::size_t cell = first; cell < last; ++cell) {
            const auto own = static_cast<std::size_t>(mesh.cell_number(static_cast<Mesh::Index>(cell)));
            const std::span from = grid.cells.nodes(own);
            std::copy_n(from.data(), corners, mesh.cells.data() + cell * corners);
            std::copy_n(from.data() + corners, mids, mesh.mid_nodes.data() + cell * mids);
        }
    });
}

/// The cells that were chosen, by their corners.
void copy_shapes(const RawGrid& grid, std::size_t count, const std::string& path, Mesh& mesh) {
    Mesh::Shapes& shapes = mesh.shapes;
    const bool polyhedra = !grid.faces.face_ends.empty();
    std::size_t by_corners = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const auto cell = static_cast<std::size_t>(mesh.cell_number(static_cast<Mesh::Index>(i)));
        const CellType& type = cell_types()[grid.types[cell]];
        const std::span nodes = grid.cells.nodes(cell);
        if (mesh.dimension == 2 && mesh::corners_of(type, nodes).size() < 3)
            refuse_file("mesh.node-count", path, "the nodes of cell " + std::to_string(cell) + " (from 0)",
                        (type.number == vtk_quadratic_polygon ? "6 or more in a " : "3 or more in a ") +
                            name_of(grid.types[cell]),
                        std::to_string(nodes.size()));
        by_corners += mesh::add_shape(mesh, grid.types[cell], nodes) ? 0 : 1;
        if (!polyhedra) continue;
        const RawFaces& faces = grid.faces;
        for (auto f = cell == 0 ? 0 : faces.face_ends[cell - 1]; f != faces.face_ends[cell]; ++f) {
            const auto face = static_cast<std::size_t>(f);
            shapes.rings.insert(shapes.rings.end(), faces.rings.begin() + (face == 0 ? 0 : faces.ring_ends[face - 1]),
                                faces.rings.begin() + faces.ring_ends[face]);
            shapes.ring_ends.push_back(static_cast<std::int64_t>(shapes.rings.size()));
        }
        shapes.face_ends.push_back(static_cast<std::int64_t>(shapes.ring_ends.size()));
    }
    note_by_corners(by_corners, path, mesh);
}

/// Makes doubles of integers, if these are exact: the field that they would be in a file of these cells alone.
void make_field(RawArray& array) {
    const auto is_double = [](std::int64_t n) {
        double x = 0;
        return convert_number(n, x);
    };
    const std::vector<std::int64_t>* const integers = array.integers();
    if (integers != nullptr && std::ranges::all_of(*integers, is_double))
        array.values = std::vector<double>(integers->begin(), integers->end());
}

/// The cells that make a mesh, and their points; the rows of the other cells go.
void take_cells(RawGrid& grid, const std::string& path, InSpace* space, Mesh& mesh) {
    check_cells(grid, path);
    if (space != nullptr) cut_polygons(grid, count_types(grid), path, *space, mesh.notes);
    const TypeCounts counts = count_types(grid);
    mesh.dimension = choose(counts, grid, path);
    // Simplices of one type are the mesh's cells themselves.
    const auto is_other = [&](std::uint8_t type) { return cell_types()[type].dimension() != mesh.dimension; };
    TypeCounts own = counts;
    std::erase_if(own, [&](const auto& one) { return is_other(one.first); });
    const CellType& type = cell_types()[own.begin()->first];
    const bool simplices = own.size() == 1 && (type.kind == CellKind::tetrahedron || type.kind == CellKind::triangle);
    std::size_t ghosts = 0;
    mesh.cell_numbers = kept_cells(grid, mesh.dimension, ghosts);
    const std::size_t cells = mesh.cell_numbers.empty() && ghosts == 0 ? grid.types.size() : mesh.cell_numbers.size();
    if (cells == 0)
        refuse_file("mesh.empty", path, "the file contains no mesh", "cells of its own",
                    std::to_string(ghosts) + " ghost cells (vtkGhostType)", "name the file of all pieces (.pvtu)");
    const auto leave_out = [&](bool there_are, std::string what) {
        if (there_are) mesh.notes.push_back({Note::Kind::left_out, std::move(what), path, true});
    };
    leave_out(cells + ghosts != grid.types.size(), std::to_string(grid.types.size() - cells - ghosts) +
                                                       " cells that are no " +
                                                       (!simplices            ? "cells of the mesh's dimension: "
                                                        : mesh.dimension == 3 ? "tetrahedra: "
                                                                              : "triangles: ") +
                                                       counts_by_name(counts, false, is_other));
    leave_out(ghosts != 0, std::to_string(ghosts) +
                               " ghost cells, which stand for cells of other pieces or are hidden (vtkGhostType)");
    simplices ? copy_cells(grid, type.nodes, cells, mesh) : copy_shapes(grid, cells, path, mesh);
    if (simplices && type.nodes != mesh.corners()) mesh.mid_edge_order = MidEdgeOrder::vtk;
    grid.cells.connectivity = {};
    mesh.points = to_points(std::move(grid.points), mesh.dimension, path,
                            simplices && mesh.mid_nodes.empty() ? path : "", "point", space);
    if (!mesh.cell_numbers.empty()) {
        keep_rows(grid.cell_arrays, mesh.cell_numbers);
        std::ranges::for_each(grid.cell_arrays, make_field);
    }
}

/// Whether a mesh can be of axes alone: without ghosts, in space or in the plane z = 0, coordinates increasing.
bool may_be_axes(const RawGrid& grid) {
    const auto& [x, y, z] = grid.unlisted->axes;
    return std::ranges::count(grid.cell_arrays, ghost_name, &RawArray::name) == 0 && mesh::is_increasing(x) &&
           mesh::is_increasing(y) && (mesh::is_increasing(z) || z == std::vector{0.0});
}

}  // namespace

std::vector<double> to_points(std::vector<double> points, int dimension, const std::string& path,
                              const std::string& triangles, const std::string& one, InSpace* space) {
    const auto refuse = [&](ErrorCode code, std::size_t number, const char* expected, const std::string& remedy) {
        const std::string of = " of " + one + " " + std::to_string(number / 3) + " (from 0)";
        refuse_file(code, path, "xyz"[number % 3] + of, expected, base::shortest(points[number]), remedy);
    };
    if (!base::all_finite(points))
        refuse("mesh.coordinate", base::first_not_finite(points), "a finite number", "correct the point");
    if (dimension == 3) return points;
    std::size_t to = 0;
    const bool in_space = space != nullptr && !in_plane(points);
    if (in_space) space->points = points;
    for (std::size_t i = 0; i < points.size(); i += 3) {
        if (points[i + 2] != 0 && !in_space)  // those before have lost their z
            refuse("mesh.off-plane", i + 2, "0, as the mesh is 2D",
                   plane_remedy(i == 0 ? points : std::vector<double>(), triangles));
        points[to++] = points[i];
        points[to++] = points[i + 1];
    }
    points.resize(to);
    points.shrink_to_fit();
    return points;
}

std::string list_of(const std::vector<std::string>& names) {
    const std::size_t listed = std::min<std::size_t>(names.size(), 10);
    const std::string text = base::joined(std::span(names).first(listed), ", ", in_quotes);
    return listed == names.size() ? text : text + " and " + std::to_string(names.size() - listed) + " others";
}

void take_fields(std::vector<RawArray>& arrays, const std::string& what, const std::string& path,
                 std::vector<Field>& fields, std::vector<Column>* labels, Notes& notes) {
    std::vector<std::string> narrow;
    for (RawArray& array : arrays) {
        if (array.fault.empty() && array.has_labels() && labels == nullptr) array.fault = "it holds no doubles";
        if (!array.fault.empty()) {
            notes.push_back({Note::Kind::left_out, what + " " + in_quotes(array.name) + ": " + array.fault, path});
            continue;
        }
        if (array.type == NumberType::float32) narrow.push_back(array.name);
        if (array.has_labels()) {
            labels->push_back({std::move(array.name), std::move(array.values)});
        } else {
            fields.push_back({std::move(array.name), array.components, std::move(array.numbers())});
        }
    }
    if (!narrow.empty())
        notes.push_back({Note::Kind::converted, "float32 to double: " + what + " " + list_of(narrow), path});
}

void note_narrow_points(const RawGrid& grid, const std::string& path, Notes& notes) {
    if (grid.narrow_points) notes.push_back({Note::Kind::converted, "float32 to double: the coordinates", path});
}

Mesh to_mesh(RawGrid grid, const std::string& path, InSpace* space, bool list_grids) {
    if (grid.unlisted && (list_grids || !may_be_axes(grid))) grid.list(path);
    Mesh mesh;
    mesh.notes = std::move(grid.notes);
    if (grid.unlisted) {
        mesh.axes = std::move(grid.unlisted->axes);
        mesh.dimension = mesh.axes[2].size() == 1 ? 2 : 3;
    } else {
        take_cells(grid, path, space, mesh);
    }
    // Point markers are an array like any other but for its name and type.
    const auto markers = std::ranges::find_if(grid.point_arrays, [](RawArray& array) {
        return array.name == marker_name && array.integers() != nullptr && array.fault.empty();
    });
    if (markers != grid.point_arrays.end()) {
        mesh.point_markers = std::move(*markers->integers());
        grid.point_arrays.erase(markers);
    }
    take_fields(grid.point_arrays, "point array", path, mesh.point_fields, nullptr, mesh.notes);
    take_fields(grid.cell_arrays, "cell array", path, mesh.cell_fields, &mesh.cell_labels, mesh.notes);
    note_narrow_points(grid, path, mesh.notes);
    const auto leave_out = [&](bool there_are, const std::string& what, bool important) {
        if (there_are) mesh.notes.push_back({Note::Kind::left_out, what, path, important});
    };
    leave_out(!grid.loose_arrays.empty(),
              "arrays of neither points nor cells (field data): " + list_of(grid.loose_arrays), false);
    leave_out(grid.has_steps, "all steps but the first of arrays with several time steps", true);
    cut_into_simplices(mesh, path);
    return mesh;
}

}  // namespace barycert::io
