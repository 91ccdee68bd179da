// PLCs from their files; TetGen's .poly and .smesh, with their nodes inside or in STEM.node.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "barycert/environment.hpp"
#include "barycert/plc.hpp"
#include "barycert/result.hpp"
#include "core/base/text.hpp"
#include "files/format.hpp"
#include "io/errors.hpp"
#include "io/paths.hpp"
#include "io/polygons/polygons.hpp"

namespace barycert::io {
namespace {

/// STEM.node, or STEM.node.gz, where the nodes of STEM.poly and STEM.smesh may be.
std::string node_path_of(const std::string& path) {
    return plain_or_packed(std::filesystem::path(without_gz(path)).replace_extension(".node").string());
}

/// Appends nodes: their header and then their rows. False: the header tells that they stand in a file of their own.
bool read_nodes(PlcText& in, Plc& plc) {
    in.need_line("the number of nodes");
    const std::size_t nodes = in.take_count("the number of nodes");
    if (in.words_left() > 0) {
        const int dimension = in.take_integer("the dimension");
        if (dimension != 3)
            in.fail("mesh.dimension", "cannot mesh", "dimension 3", std::to_string(dimension),
                    "mesh a PLC in the plane with Triangle");
    }
    plc.attribute_count = in.words_left() > 0 ? static_cast<int>(in.take_count("the number of attributes")) : 0;
    const int markers = in.words_left() > 0 ? in.take_integer("the number of markers") : 0;
    if (markers != 0 && markers != 1) in.fail("file.syntax", "cannot read", "0 or 1 markers", std::to_string(markers));
    in.need_end("the numbers of nodes, dimensions, attributes and markers");
    for (std::size_t i = 0; i < nodes; ++i) {
        in.need_line("node", i + 1, nodes);
        const std::int32_t id = in.take_integer("a node's number");
        if (i == 0) {
            if (id != 0 && id != 1)
                in.fail("mesh.numbering", "cannot read", "numbering from 0 or 1", std::to_string(id));
            plc.index_base = id;
        }
        const std::size_t expected = i + static_cast<std::size_t>(plc.index_base);
        if (id < 0 || static_cast<std::size_t>(id) != expected)
            in.fail("mesh.numbering", "nodes are not numbered in order", std::to_string(expected), std::to_string(id));
        for (int axis = 0; axis < 3; ++axis) plc.points.push_back(in.take_number("a coordinate"));
        for (int a = 0; a < plc.attribute_count; ++a) plc.attributes.push_back(in.take_number("an attribute"));
        // A marker may be left out and is 0 then, as in TetGen.
        if (markers == 1) plc.point_markers.push_back(in.words_left() > 0 ? in.take_integer("a marker") : 0);
        in.need_end("its number, three coordinates, and what the header announces of attributes and markers");
    }
    return nodes > 0;
}

std::string read_text(const std::string& path) {
    return read_surface_text(path, Separators::blanks_and_commas, [](PlcText& in) {
        Plc ignored;
        read_nodes(in, ignored);
    });
}

/// A ring of nodes; it may run over several lines.
std::vector<std::int32_t> read_polygon(PlcText& in, const Plc& plc) {
    const std::size_t n = in.take_count("the number of a polygon's corners");
    if (n == 0) in.fail("file.syntax", "cannot read", "a polygon with corners", "none");
    std::vector<std::int32_t> ring;
    ring.reserve(n);
    while (ring.size() < n) {
        if (in.words_left() == 0) in.need_line("a polygon's corner");
        const std::int32_t id = in.take_integer("a polygon's corner");
        const std::int64_t index = std::int64_t{id} - plc.index_base;
        if (index < 0 || index >= static_cast<std::int64_t>(plc.point_count())) {
            const std::size_t last = plc.point_count() - 1 + static_cast<std::size_t>(plc.index_base);
            in.fail("mesh.node-index", "no such node", std::to_string(plc.index_base) + " to " + std::to_string(last),
                    std::to_string(id));
        }
        ring.push_back(static_cast<std::int32_t>(index));
    }
    return ring;
}

std::size_t take_only_count(PlcText& in, std::string_view what) {
    const std::size_t count = in.take_count(what);
    in.need_end(what);
    return count;
}

/// Rows `number x y z ...`: 3 numbers each for holes, 4 or 5 for regions.
void read_seeds(PlcText& in, std::size_t count, std::string_view what, std::vector<double>& out) {
    for (std::size_t i = 0; i < count; ++i) {
        in.need_line(what);
        in.take_integer("its number");
        for (int axis = 0; axis < 3; ++axis) out.push_back(in.take_number(what));
        if (what == "a region") {
            out.push_back(in.take_number("a region's attribute"));
            out.push_back(in.words_left() > 0 ? in.take_number("a region's largest volume") : out.back());
        }
        in.need_end(what == "a region" ? "its number, a point, an attribute and a largest volume"
                                       : "its number and a point");
    }
}

/// One that the header does not announce is read, and not used, as by TetGen.
void read_facet_marker(PlcText& in, Plc& plc, PlcFacet& facet) {
    if (in.words_left() == 0) return;
    const std::int32_t marker = in.take_integer("a facet's marker");
    if (plc.has_facet_markers) facet.marker = marker;
    const Note note{Note::Kind::left_out, "markers of facets, which the header of the facets does not announce",
                    in.path()};
    if (!plc.has_facet_markers && std::ranges::find(plc.notes, note) == plc.notes.end()) plc.notes.push_back(note);
}

PlcFacet read_facet(PlcText& in, Plc& plc, bool one_polygon) {
    PlcFacet facet;
    in.need_line("a facet");
    if (one_polygon) {
        facet.polygons.push_back(read_polygon(in, plc));
        if (plc.has_facet_markers && in.words_left() > 0) facet.marker = in.take_integer("a facet's marker");
        in.need_end(plc.has_facet_markers ? "the corners of a facet, as many as it says, and a marker"
                                          : "the corners of a facet, as many as it says (no header announces markers)");
        return facet;
    }
    const std::size_t polygons = in.take_count("the number of a facet's polygons");
    if (polygons == 0) in.fail("file.syntax", "cannot read", "a facet with polygons", "none");
    const std::size_t holes = in.words_left() > 0 ? in.take_count("the number of a facet's holes") : 0;
    read_facet_marker(in, plc, facet);
    in.need_end("the numbers of polygons and holes, and a marker");
    for (std::size_t i = 0; i < polygons; ++i) {
        in.need_line("a polygon");
        facet.polygons.push_back(read_polygon(in, plc));
        in.need_end("the corners of a polygon, as many as it says");
    }
    read_seeds(in, holes, "a hole of a facet", facet.holes);
    return facet;
}

Plc plc_of(Polygons polygons) {
    Plc plc;
    plc.facets.resize(polygons.count());
    auto corner = polygons.rings.begin();
    for (std::size_t i = 0; i < plc.facets.size(); ++i) {
        const auto end = corner + (polygons.counts.empty() ? 3 : polygons.counts[i]);
        plc.facets[i].polygons.emplace_back(corner, end);
        corner = end;
    }
    plc.points = std::move(polygons.points);
    plc.index_base = polygons.index_base;
    plc.notes = std::move(polygons.notes);
    return plc;
}

Plc read_poly(const std::string& path, bool one_polygon_a_facet) {
    const std::string text = read_text(path);
    PlcText in(path, text, text.size(), Separators::blanks_and_commas);
    Plc plc;
    if (!read_nodes(in, plc)) {
        const std::string node_path = node_path_of(path), node_text = read_text(node_path);
        PlcText nodes(node_path, node_text, node_text.size(), Separators::blanks_and_commas);
        read_nodes(nodes, plc);
        nodes.note_last_number(plc.notes);
        plc.nodes_apart = true;
    }
    in.need_line("the number of facets");
    const std::size_t facets = in.take_count("the number of facets");
    plc.has_facet_markers = in.words_left() > 0 && in.take_integer("the number of markers") != 0;
    in.need_end("the numbers of facets and markers");
    for (std::size_t i = 0; i < facets; ++i) plc.facets.push_back(read_facet(in, plc, one_polygon_a_facet));
    if (in.next_line()) read_seeds(in, take_only_count(in, "the number of holes"), "a hole", plc.holes);
    if (in.next_line()) read_seeds(in, take_only_count(in, "the number of regions"), "a region", plc.regions);
    // TetGen does not look at it.
    if (in.next_line())
        plc.notes.push_back({Note::Kind::left_out,
                             "text behind the end of the PLC, from line " + std::to_string(in.line_number()) +
                                 " on: " + base::quoted(in.line()),
                             path, true});
    else
        in.note_last_number(plc.notes);
    return plc;
}

}  // namespace
}  // namespace barycert::io

namespace barycert {

using namespace io;

std::vector<std::string> plc_files(const std::string& path) {
    const base::FormatKind kind = base::kind_of(path);
    if (kind != base::FormatKind::poly && kind != base::FormatKind::smesh) return {path};
    return {path, node_path_of(path)};
}

Result<Plc> read_plc(const std::string& path) try {
    const ExactEnvironment environment;
    const FormatKind kind = base::kind_of(path);
    if (!base::is_read_as(path, base::Use::plc))
        return unknown_suffix(path, "unknown kind of PLC", "one of " + base::suffix_list_read(base::Use::plc),
                              "choose another file");
    Plc plc = kind == FormatKind::poly || kind == FormatKind::smesh ? read_poly(path, kind == FormatKind::smesh)
                                                                    : plc_of(read_polygons(path));
    if (plc.facets.empty()) return file_error("mesh.empty", path, "nothing to mesh: the PLC has no facets");
    if (plc.point_count() < 4) return file_error("mesh.empty", path, "nothing to mesh: a PLC needs four nodes");
    return plc;
} catch (const Exception& problem) {
    return problem.error();
}

}  // namespace barycert
