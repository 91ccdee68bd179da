#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "core/base/large_pages.hpp"
#include "core/base/text.hpp"
#include "core/base/workers.hpp"
#include "core/vtk_cell.hpp"
#include "io/errors.hpp"
#include "io/gmsh/msh_file.hpp"
#include "io/gmsh/msh_parts.hpp"
#include "io/mesh_notes.hpp"
#include "mesh/cell_types.hpp"
#include "mesh/part.hpp"

namespace barycert::io {
namespace {

// Numbers, orders and node counts of Gmsh's documentation ("MSH file format") and of GmshDefines.h. The serendipity
// types of higher order have fewer nodes than the complete ones of the same order.
constexpr auto element_types = [] {
    return std::to_array<ElementType>(
        {{1, vtk_line, 1, 2},          {2, vtk_triangle, 1, 3},      {3, vtk_quad, 1, 4},
         {4, vtk_tetra, 1, 4},         {5, vtk_hexahedron, 1, 8},    {6, vtk_wedge, 1, 6},
         {7, vtk_pyramid, 1, 5},       {8, vtk_line, 2, 3},          {9, vtk_triangle, 2, 6},
         {10, vtk_quad, 2, 9},         {11, vtk_tetra, 2, 10},       {12, vtk_hexahedron, 2, 27},
         {13, vtk_wedge, 2, 18},       {14, vtk_pyramid, 2, 14},     {15, vtk_vertex, 1, 1},
         {16, vtk_quad, 2, 8},         {17, vtk_hexahedron, 2, 20},  {18, vtk_wedge, 2, 15},
         {19, vtk_pyramid, 2, 13},     {20, vtk_triangle, 3, 9},     {21, vtk_triangle, 3, 10},
         {22, vtk_triangle, 4, 12},    {23, vtk_triangle, 4, 15},    {24, vtk_triangle, 5, 15},
         {25, vtk_triangle, 5, 21},    {26, vtk_line, 3, 4},         {27, vtk_line, 4, 5},
         {28, vtk_line, 5, 6},         {29, vtk_tetra, 3, 20},       {30, vtk_tetra, 4, 35},
         {31, vtk_tetra, 5, 56},       {36, vtk_quad, 3, 16},        {37, vtk_quad, 4, 25},
         {38, vtk_quad, 5, 36},        {42, vtk_triangle, 6, 28},    {43, vtk_triangle, 7, 36},
         {44, vtk_triangle, 8, 45},    {45, vtk_triangle, 9, 55},    {46, vtk_triangle, 10, 66},
         {47, vtk_quad, 6, 49},        {48, vtk_quad, 7, 64},        {49, vtk_quad, 8, 81},
         {50, vtk_quad, 9, 100},       {51, vtk_quad, 10, 121},      {62, vtk_line, 6, 7},
         {63, vtk_line, 7, 8},         {64, vtk_line, 8, 9},         {65, vtk_line, 9, 10},
         {66, vtk_line, 10, 11},       {71, vtk_tetra, 6, 84},       {72, vtk_tetra, 7, 120},
         {73, vtk_tetra, 8, 165},      {74, vtk_tetra, 9, 220},      {75, vtk_tetra, 10, 286},
         {90, vtk_wedge, 3, 40},       {91, vtk_wedge, 4, 75},       {92, vtk_hexahedron, 3, 64},
         {93, vtk_hexahedron, 4, 125}, {94, vtk_hexahedron, 5, 216}, {118, vtk_pyramid, 3, 30},
         {119, vtk_pyramid, 4, 55}});
}();

/// Gmsh's word for elements whose corners are those of the cell.
std::string_view word_of(VtkCell linear) {
    switch (linear) {
        case vtk_vertex:
            return "point";
        case vtk_line:
            return "line";
        case vtk_triangle:
            return "triangle";
        case vtk_quad:
            return "quadrangle";
        case vtk_tetra:
            return "tetrahedron";
        case vtk_hexahedron:
            return "hexahedron";
        case vtk_wedge:
            return "prism";
        default:
            return "pyramid";
    }
}

/// "8 points, 120 lines".
std::string counted_types(const TypeCounts& counts) {
    return base::joined(counts, ", ", [](const TypeCounts::value_type& one) {
        const auto [type, count] = one;
        std::string name(word_of(type->linear));
        const bool greek = name.ends_with("on");  // polyhedron, polyhedra
        if (count != 1 && greek) name.replace(name.size() - 2, 2, "a");
        if (count != 1 && !greek) name += 's';
        return std::to_string(count) + " " + name + (type->order > 1 ? " of order " + std::to_string(type->order) : "");
    });
}

/// Keeps the types of the highest dimension. Refuses a file that has none above 1.
TypeCounts choose(const MshFile& file, TypeCounts counts) {
    int dimension = 0;
    for (const auto& [type, count] : counts) dimension = std::max(dimension, type->dimension());
    std::erase_if(counts, [&](const auto& one) { return one.first->dimension() < dimension; });
    if (dimension > 1) return counts;
    const std::string found = counted_types(counts);
    refuse_file("mesh.empty", file.path(), "the file contains no mesh",
                "cells that fill space, or polygons in the plane z = 0", found.empty() ? "no elements" : found,
                "mesh the geometry in Gmsh; if there are physical groups, it saves these alone: give the volume one, "
                "or add -save_all");
}

/// Takes the tags of nodes and gives their positions.
bool take_node(auto& row, const TagIndex& nodes, Mesh::Index& node) {
    std::int64_t tag = 0;
    if (!row.tag(tag, "the tag of a node")) return false;
    node = nodes.find(tag);
    return node >= 0 || row.refuse({"mesh.node-index", "an unknown node", "the tag of a node of $Nodes", tag,
                                    "check that the file is complete"});
}

/// Numbers before the nodes of an element.
struct Head {
    std::int64_t tag = 0;
    std::array<std::int64_t, 2> groups{};  ///< physical, geometrical
};

bool take_head(auto& row, int version, const ElementBlock& block, Head& head) {
    if (!row.tag(head.tag, "the tag of an element")) return false;
    if (version == 41 && head.tag < 0)
        return row.refuse({"mesh.numbering", "bad tag of an element", "a number that is not negative", head.tag});
    if (version != 22) return true;
    std::int64_t value = 0;
    for (int i = 0; row.text && i < 2; ++i) {  // the type and the number of tags, which are known
        if (!row.integer(value, "a number")) return false;
    }
    for (std::size_t k = 0; k < block.tags; ++k) {
        if (!row.integer(value, "a tag of an element")) return false;
        if (k < 2) head.groups[k] = value;
    }
    return true;
}

struct Target {
    const MshFile& file;
    const MshElements& elements;
    const TagIndex& nodes;
    MshCells& cells;
    std::size_t mids;

    bool take_head_of(auto& row, const ElementBlock& block, std::size_t i) const {
        Head head;
        if (!take_head(row, file.version(), block, head)) return false;
        cells.tags[i] = head.tag;
        if (file.version() != 22) return true;
        cells.physical[i] = static_cast<double>(head.groups[0]);
        cells.geometrical[i] = static_cast<double>(head.groups[1]);
        return true;
    }
};

template <std::size_t Corners>
void read_chosen(const Target& to, std::span<const Run> runs) {
    const int version = to.file.version();
    std::int64_t* const tags = to.cells.tags.data();
    Mesh::Index* const corners = to.cells.mesh.cells.data();
    Mesh::Index* const mid_nodes = to.cells.mesh.mid_nodes.data();
    double* const physical = to.cells.physical.data();
    double* const geometrical = to.cells.geometrical.data();
    parse_runs(to.file, "Elements", runs, [&, mids = to.mids](auto& row, const Run& run, std::size_t i) {
        const char* const start = row.at();
        // A row of small integers, of which so many stand before the corners.
        const auto take_plain = [&]<std::size_t Before>() {
            std::array<std::uint32_t, Before + Corners> plain{};
            if (!row.plain(plain)) return false;
            tags[i] = plain[0];
            bool good = Before == 1 || plain[2] == 2;
            for (std::size_t k = 0; k < Corners; ++k)
                good &= (corners[i * Corners + k] = to.nodes.find(plain[Before + k])) >= 0;
            if constexpr (Before != 1) {
                physical[i] = plain[3];
                geometrical[i] = plain[4];
            }
            if (!good) row.back(start);
            return good;
        };
        if (mids == 0 && (version == 22 ? take_plain.template operator()<5>() : take_plain.template operator()<1>()))
            return true;
        if (!to.take_head_of(row, to.elements.blocks[run.id], i)) return false;
        for (std::size_t k = 0; k < Corners; ++k) {
            if (!take_node(row, to.nodes, corners[i * Corners + k])) return false;
        }
        for (std::size_t k = 0; k < mids; ++k) {
            if (!take_node(row, to.nodes, mid_nodes[i * mids + k])) return false;
        }
        return true;
    });
}

/// Simplices of order 2 to 4, whose nodes are all kept: the place of each in VTK's order; empty of others.
std::vector<std::size_t> kept_places(const ElementType& type) {
    constexpr std::array<std::uint8_t, 10> third{11, 10, 15, 14, 13, 12, 17, 19, 18, 16};
    constexpr std::array<std::uint8_t, 22> fourth{15, 14, 13, 21, 20, 19, 18, 17, 16, 25, 26,
                                                  27, 33, 31, 32, 28, 29, 30, 22, 23, 24, 34};
    const bool solid = type.linear == vtk_tetra;
    if (!type.is_simplex() || mesh::simplex_order(type.dimension(), type.nodes) != type.order) return {};
    std::vector<std::size_t> places(type.nodes);
    std::iota(places.begin(), places.end(), std::size_t{0});
    if (!solid) return places;
    if (type.order == 2) std::swap(places[8], places[9]);
    const auto move = [&](const auto& order, std::size_t first) {
        for (std::size_t i = 0; i < order.size(); ++i) places[order[i]] = first + i;
    };
    if (type.order == 3) move(third, 10);
    if (type.order == 4) move(fourth, 13);
    return places;
}

/// Elements of several types, or none of which is a mesh's own: by their corners, but for curved simplices.
void read_shapes(const Target& to, std::span<const Run> runs) {
    Mesh::Shapes& shapes = to.cells.mesh.shapes;
    std::map<const ElementType*, std::vector<std::size_t>> kept;
    for (const Run& run : runs) {
        const ElementType& own = *to.elements.blocks[run.id].type;
        const auto [places, is_new] = kept.try_emplace(&own);
        if (is_new) places->second = kept_places(own);
        const bool whole = !places->second.empty();
        const std::uint8_t type = !whole                 ? own.linear
                                  : own.dimension() == 3 ? vtk_lagrange_tetra
                                                         : vtk_lagrange_triangle;
        const auto corners = static_cast<std::int64_t>(whole ? own.nodes : mesh::cell_type(type).corners);
        shapes.types.insert(shapes.types.end(), run.count, type);
        for (std::size_t i = 0; i < run.count; ++i)
            shapes.ends.push_back((shapes.ends.empty() ? 0 : shapes.ends.back()) + corners);
    }
    shapes.nodes.resize(static_cast<std::size_t>(shapes.ends.back()));
    parse_runs(to.file, "Elements", runs, [&](auto& row, const Run& run, std::size_t i) {
        const ElementBlock& block = to.elements.blocks[run.id];
        if (!to.take_head_of(row, block, i)) return false;
        const std::vector<std::size_t>& places = kept.at(block.type);
        const std::size_t corners = places.empty() ? mesh::cell_type(shapes.types[i]).corners : places.size();
        const auto end = static_cast<std::size_t>(shapes.ends[i]);
        for (std::size_t k = 0; k < block.type->nodes; ++k) {
            Mesh::Index node = 0;
            if (!take_node(row, to.nodes, node)) return false;
            if (k < corners) shapes.nodes[end - corners + (places.empty() ? k : places[k])] = node;
        }
        return true;
    });
}

/// In 2.x Gmsh writes an element of several groups once for each, one after the other. All but the first go.
void drop_repeats(MshCells& cells, std::size_t corners, std::size_t mids) {
    const std::size_t count = cells.tags.size();
    Mesh::Shapes& shapes = cells.mesh.shapes;
    const auto nodes_of = [&](std::size_t i) {
        if (shapes.types.empty()) return std::span<const Mesh::Index>(&cells.mesh.cells[i * corners], corners);
        return shapes.nodes_of(i);
    };
    const auto repeats = [&](std::size_t i) {
        return std::ranges::equal(nodes_of(i), nodes_of(i - 1)) && cells.geometrical[i] == cells.geometrical[i - 1] &&
               cells.physical[i] != cells.physical[i - 1];
    };
    std::size_t first = 1;
    while (first < count && !repeats(first)) ++first;
    if (first >= count) return;
    std::vector<Mesh::Index> kept;
    for (std::size_t i = 0; i < count; ++i) {
        if (i == 0 || !repeats(i)) kept.push_back(static_cast<Mesh::Index>(i));
    }
    if (cells.mesh.cell_numbers.empty()) {
        cells.mesh.cell_numbers = kept;
    } else {
        mesh::keep_rows(cells.mesh.cell_numbers, 1, kept);
    }
    cells.repeated = count - kept.size();
    mesh::keep_rows(cells.mesh.cells, corners, kept);
    mesh::keep_rows(cells.mesh.mid_nodes, mids, kept);
    if (!shapes.types.empty()) {
        Mesh own;
        own.dimension = cells.mesh.dimension;
        for (const auto i : kept)
            mesh::add_shape(own, shapes.types[static_cast<std::size_t>(i)], nodes_of(static_cast<std::size_t>(i)));
        shapes = std::move(own.shapes);
    }
    mesh::keep_rows(cells.tags, 1, kept);
    mesh::keep_rows(cells.physical, 1, kept);
    mesh::keep_rows(cells.geometrical, 1, kept);
}

std::vector<std::uint8_t> mark_nodes(const MshFile& file, MshCells& cells, std::size_t node_count) {
    std::vector<std::uint8_t> used(node_count);
    constexpr std::size_t step = std::size_t{1} << 16;
    for (const auto* nodes : {&cells.mesh.cells, &cells.mesh.mid_nodes, &cells.mesh.shapes.nodes}) {
        base::share_work(file.threads(), (nodes->size() + step - 1) / step, [&](std::size_t part) {
            const auto some = std::span(*nodes).subspan(part * step);
            for (const Mesh::Index node : some.first(std::min(step, some.size())))
                std::atomic_ref(used[static_cast<std::size_t>(node)]).store(1, std::memory_order_relaxed);
            return true;
        });
    }
    cells.unused_nodes = static_cast<std::size_t>(std::count(used.begin(), used.end(), 0));
    return used;
}

/// Elements of a lower dimension: their nodes must be there, too.
void look_at_others(const Target& to, std::span<const Run> runs, const std::vector<std::uint8_t>& used) {
    std::atomic<bool> apart{false};
    const int version = to.file.version();
    parse_runs(to.file, "Elements", runs, [&](auto& row, const Run& run, std::size_t) {
        const ElementBlock& block = to.elements.blocks[run.id];
        Head head;
        if (!take_head(row, version, block, head)) return false;
        for (std::size_t k = 0; k < block.type->nodes; ++k) {
            Mesh::Index node = 0;
            if (!take_node(row, to.nodes, node)) return false;
            if (used[static_cast<std::size_t>(node)] == 0) apart = true;
        }
        return true;
    });
    to.cells.apart = apart;
}

}  // namespace

const ElementType* element_type(std::int64_t number) {
    const auto* const found = std::ranges::find(element_types, number, &ElementType::number);
    return found == element_types.end() ? nullptr : found;
}

const ElementType& simplex_element(int dimension, int order) {
    return *std::ranges::find_if(element_types, [&](const ElementType& type) {
        return type.is_simplex() && type.dimension() == dimension && type.order == order;
    });
}

MshCells read_msh_cells(const MshFile& file, const MshElements& elements, const MshNodes& nodes) {
    const TypeCounts types = choose(file, elements.counts);
    const ElementType& type = *types.begin()->first;
    const bool simplices = types.size() == 1 && type.order <= 2 && type.is_simplex();
    MshCells cells;
    cells.mesh.dimension = type.dimension();
    cells.left_out = elements.counts;
    for (const auto& [own, number] : types) {
        if (!simplices && own->order > 1 && kept_places(*own).empty()) cells.by_corners += number;
        cells.left_out.erase(own);
    }
    std::vector<Run> runs, others;
    std::size_t count = 0;
    for (const ElementBlock& block : elements.blocks) {
        const bool taken = types.contains(block.type);
        (taken ? runs : others).push_back(block.run);
        if (!taken) continue;
        runs.back().first = count;
        count += block.run.count;
        cells.partitioned = cells.partitioned || block.tags > 2;
    }
    const auto corners = static_cast<std::size_t>(cells.mesh.dimension) + 1;
    const Target target{file, elements, nodes.index, cells, simplices ? type.nodes - corners : 0};
    if (simplices) {
        base::resize_large(cells.mesh.cells, count * corners);
        base::resize_large(cells.mesh.mid_nodes, count * target.mids);
    }
    base::resize_large(cells.tags, count);
    if (file.version() == 22) {
        base::resize_large(cells.geometrical, count);
        base::resize_large(cells.physical, count);
    }

    !simplices ? read_shapes(target, runs) : corners == 4 ? read_chosen<4>(target, runs) : read_chosen<3>(target, runs);
    if (count != elements.count) {
        cells.mesh.cell_numbers.reserve(count);
        for (const Run& run : runs) {
            for (std::size_t i = 0; i < run.count; ++i)
                cells.mesh.cell_numbers.push_back(static_cast<Mesh::Index>(elements.blocks[run.id].run.first + i));
        }
    }
    if (file.version() == 22) drop_repeats(cells, corners, target.mids);
    const std::vector<std::uint8_t> used = mark_nodes(file, cells, nodes.points.size() / 3);
    look_at_others(target, others, used);
    return cells;
}

void note_cells(MshCells& cells, bool partitioned, const std::string& path) {
    const auto left_out = [&](std::string text, bool important) {
        cells.mesh.notes.push_back({Note::Kind::left_out, std::move(text), path, important});
    };
    const std::string others = counted_types(cells.left_out);
    // Gmsh writes points, lines and triangles of the boundary beside nearly all meshes. That changes no result; to tell
    // it each time would teach users to look away. But of a wire nothing is left.
    if (!others.empty())
        left_out("elements of a lower dimension: " + others + (cells.apart ? "; some have nodes that no cell has" : ""),
                 cells.apart);
    note_by_corners(cells.by_corners, path, cells.mesh);
    if (cells.repeated != 0)
        left_out(std::to_string(cells.repeated) +
                     " elements that repeat the one before them for a further physical group: gmsh:physical has the "
                     "first group of each cell",
                 true);
    if (cells.unused_nodes != 0)
        left_out(std::to_string(cells.unused_nodes) +
                     " nodes of no cell: no value is taken from them; all nodes keep their numbers",
                 false);
    if (cells.partitioned || partitioned) left_out("partitions of the mesh: it is read as one", false);
}

}  // namespace barycert::io
