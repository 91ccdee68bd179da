#include "tests/fuzz/same.hpp"

#include <bit>
#include <cmath>
#include <cstdint>

#include "tests/fuzz/target.hpp"

namespace barycert::fuzz {
namespace {

void expect_same_fields(const std::vector<Field>& a, const std::vector<Field>& b, Payload payload, const char* what) {
    expect(a.size() == b.size(), "another number of fields came back", what);
    for (std::size_t i = 0; i < a.size(); ++i) {
        expect(a[i].name == b[i].name, "a field came back under another name", a[i].name + " as " + b[i].name);
        expect(a[i].components == b[i].components, "a field came back with other components", a[i].name);
        expect(same_numbers(a[i].data, b[i].data, payload), "a field came back with other values", a[i].name);
    }
}

void expect_indices(const std::vector<Mesh::Index>& indices, std::size_t below, bool or_none, const char* what) {
    for (const Mesh::Index i : indices)
        expect(i >= (or_none ? -1 : 0) && static_cast<std::int64_t>(i) < static_cast<std::int64_t>(below),
               "an index out of range was read", what);
}

void expect_fields(const std::vector<Field>& fields, std::size_t entities) {
    for (const Field& f : fields)
        expect(f.components > 0 && f.data.size() == entities * static_cast<std::size_t>(f.components),
               "a field that does not fit its mesh was read", f.name);
}

}  // namespace

bool same_numbers(const std::vector<double>& a, const std::vector<double>& b, Payload payload) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (payload == Payload::lost && std::isnan(a[i]) && std::isnan(b[i])) continue;
        if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
    }
    return true;
}

void expect_same(const std::vector<Column>& a, const std::vector<Column>& b) {
    expect(a.size() == b.size(), "another number of columns came back");
    for (std::size_t i = 0; i < a.size(); ++i) {
        expect(a[i].name == b[i].name, "a column came back under another name", a[i].name + " as " + b[i].name);
        expect(a[i].values.index() == b[i].values.index(), "a column came back in another type", a[i].name);
        const auto* const numbers = std::get_if<std::vector<double>>(&a[i].values);
        const bool same = numbers == nullptr
                              ? a[i].values == b[i].values
                              : same_numbers(*numbers, std::get<std::vector<double>>(b[i].values), Payload::kept);
        expect(same, "a column came back with other values", a[i].name);
    }
}

void expect_same(const Mesh& a, const Mesh& b, Payload payload) {
    expect(a.dimension == b.dimension, "another dimension came back");
    expect(same_numbers(a.points, b.points, Payload::kept), "other points came back");
    expect(a.cells == b.cells, "other cells came back");
    expect(a.mid_nodes == b.mid_nodes, "other mid-edge nodes came back");
    expect(a.mid_edge_order == b.mid_edge_order, "another order of mid-edge nodes came back");
    expect_same_fields(a.point_fields, b.point_fields, payload, "of nodes");
    expect_same_fields(a.cell_fields, b.cell_fields, payload, "of cells");
    expect_same(a.cell_labels, b.cell_labels);
    expect(a.point_markers == b.point_markers, "other markers came back");
    expect(a.faces == b.faces, "other faces came back");
    expect(a.face_mid_nodes == b.face_mid_nodes, "other mid-edge nodes of faces came back");
    expect(a.face_markers == b.face_markers, "other markers of faces came back");
    expect(a.neighbours == b.neighbours, "other neighbours came back");
    expect(a.index_base == b.index_base, "another index base came back");
}

void expect_whole(const Mesh& mesh) {
    expect(mesh.dimension == 2 || mesh.dimension == 3, "a dimension that no mesh has was read");
    const std::size_t nodes = mesh.point_count(), cells = mesh.cell_count();
    expect(mesh.points.size() % static_cast<std::size_t>(mesh.dimension) == 0, "half a node was read");
    expect(mesh.cells.size() % mesh.corners() == 0, "half a cell was read");
    for (const double x : mesh.points) expect(std::isfinite(x), "a coordinate that is not finite was read");
    expect_indices(mesh.cells, nodes, false, "cells");
    expect_indices(mesh.mid_nodes, nodes, false, "mid-edge nodes");
    expect_indices(mesh.faces, nodes, false, "faces");
    expect_indices(mesh.face_mid_nodes, nodes, false, "mid-edge nodes of faces");
    expect_indices(mesh.neighbours, cells, true, "neighbours");
    expect(mesh.mid_nodes.empty() || mesh.mid_nodes.size() == cells * (mesh.dimension == 2 ? 3 : 6),
           "mid-edge nodes that do not fit the cells were read");
    expect(mesh.neighbours.empty() || mesh.neighbours.size() == mesh.cells.size(),
           "neighbours that do not fit the cells were read");
    expect(mesh.point_markers.empty() || mesh.point_markers.size() == nodes, "markers that do not fit were read");
    expect(mesh.cell_numbers.empty() || mesh.cell_numbers.size() == cells, "cell numbers that do not fit were read");
    expect_fields(mesh.point_fields, nodes);
    expect_fields(mesh.cell_fields, cells);
    for (const Column& c : mesh.cell_labels) expect(c.size() == cells, "labels that do not fit were read", c.name);
}

}  // namespace barycert::fuzz
