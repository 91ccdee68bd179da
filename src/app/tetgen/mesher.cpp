#include "app/tetgen/mesher.hpp"

#include <tetgen.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/plc.hpp"

namespace barycert {
namespace {

/// tetgenio frees its arrays by delete[].
template <class T>
T* owned_copy(const std::vector<T>& from) {
    if (from.empty()) return nullptr;
    T* copy = new T[from.size()];
    std::copy(from.begin(), from.end(), copy);
    return copy;
}

void fill_facet(const PlcFacet& from, tetgenio::facet& to) {
    tetgenio::init(&to);
    to.polygonlist = new tetgenio::polygon[from.polygons.size()];
    for (const std::vector<std::int32_t>& ring : from.polygons) {
        tetgenio::polygon& polygon = to.polygonlist[to.numberofpolygons++];
        tetgenio::init(&polygon);
        polygon.vertexlist = owned_copy(ring);
        polygon.numberofvertices = static_cast<int>(ring.size());
    }
    to.holelist = owned_copy(from.holes);
    to.numberofholes = static_cast<int>(from.holes.size() / 3);
}

void fill(const Plc& plc, tetgenio& in) {
    in.firstnumber = 0;
    in.numberofpoints = static_cast<int>(plc.point_count());
    in.pointlist = owned_copy(plc.points);
    in.numberofpointattributes = plc.attribute_count;
    in.pointattributelist = owned_copy(plc.attributes);
    in.pointmarkerlist = owned_copy(plc.point_markers);
    in.facetlist = new tetgenio::facet[plc.facets.size()];
    if (plc.has_facet_markers) in.facetmarkerlist = new int[plc.facets.size()];
    for (const PlcFacet& facet : plc.facets) {
        if (plc.has_facet_markers) in.facetmarkerlist[in.numberoffacets] = facet.marker;
        fill_facet(facet, in.facetlist[in.numberoffacets++]);
    }
    in.holelist = owned_copy(plc.holes);
    in.numberofholes = static_cast<int>(plc.holes.size() / 3);
    in.regionlist = owned_copy(plc.regions);
    in.numberofregions = static_cast<int>(plc.regions.size() / 5);
}

template <class To, class From>
std::vector<To> copied(const From* from, std::size_t n) {
    return from == nullptr ? std::vector<To>{} : std::vector<To>(from, from + n);
}

std::vector<Field> fields_of(const double* values, std::size_t entities, int count) {
    std::vector<Field> fields;
    for (int a = 0; a < count; ++a) {
        Field& field = fields.emplace_back(Field{.name = "attribute" + std::to_string(a), .components = 1, .data = {}});
        for (std::size_t i = 0; i < entities; ++i)
            field.data.push_back(values[i * static_cast<std::size_t>(count) + static_cast<std::size_t>(a)]);
    }
    return fields;
}

Mesh mesh_of(const tetgenio& out) {
    const auto nodes = static_cast<std::size_t>(out.numberofpoints);
    const auto cells = static_cast<std::size_t>(out.numberoftetrahedra);
    const auto corners = static_cast<std::size_t>(out.numberofcorners);
    const auto faces = static_cast<std::size_t>(out.numberoftrifaces);
    Mesh mesh;
    mesh.points = copied<double>(out.pointlist, 3 * nodes);
    mesh.point_fields = fields_of(out.pointattributelist, nodes, out.numberofpointattributes);
    mesh.point_markers = copied<std::int64_t>(out.pointmarkerlist, nodes);
    mesh.cell_fields = fields_of(out.tetrahedronattributelist, cells, out.numberoftetrahedronattributes);
    for (std::size_t i = 0; i < cells; ++i) {
        const int* cell = out.tetrahedronlist + i * corners;
        mesh.cells.insert(mesh.cells.end(), cell, cell + 4);
        if (corners != 10) continue;
        // TetGen 1.5 lists the edges 23 03 01 12 13 02; Mesh keeps 01 12 02 03 13 23.
        mesh.mid_edge_order = MidEdgeOrder::tetgen15;
        for (const std::size_t edge : {2U, 3U, 5U, 1U, 4U, 0U}) mesh.mid_nodes.push_back(cell[4 + edge]);
    }
    mesh.faces = copied<Mesh::Index>(out.trifacelist, 3 * faces);
    mesh.face_mid_nodes = copied<Mesh::Index>(out.o2facelist, 3 * faces);
    mesh.face_markers = copied<std::int64_t>(out.trifacemarkerlist, faces);
    mesh.neighbours = copied<Mesh::Index>(out.neighborlist, 4 * cells);
    return mesh;
}

}  // namespace

Mesh make_mesh(const Plc& plc, std::string switches) {
    tetgenio in, out;
    fill(plc, in);
    tetrahedralize(switches.data(), &in, &out);
    return mesh_of(out);
}

std::pair<std::string_view, std::string_view> meaning_of(int code) {
    if (code == 1) return {"TetGen ran out of memory", "ask for larger cells"};
    if (code == 2) return {"TetGen met an internal error", "try other options, or repair the PLC"};
    if (code == 3) return {"TetGen found facets that intersect", "repair them"};
    if (code == 4)
        return {"the PLC has a feature too small for TetGen's tolerance",
                "remove it, or lower the tolerance by `--switches pT1e-12`"};
    if (code == 5) return {"two facets lie too close to each other", "repair them, or try --keep-boundary"};
    if (code == 10) return {"TetGen refuses the PLC", "repair it"};
    return {"TetGen failed with an unknown code", "try other options, or repair the PLC"};
}

}  // namespace barycert
