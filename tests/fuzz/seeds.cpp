// fuzz_seeds FOLDER: writes the inputs with which the fuzzer begins, FOLDER/TARGET/NAME, by the library's own writers
// and by hand: tests/fuzz/corpus was made so. corpus/baselines, others, elf and scenes hold files of other programs
// besides.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "barycert/audit.hpp"
#include "barycert/baseline.hpp"
#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/choices.hpp"
#include "barycert/defect.hpp"
#include "barycert/environment.hpp"
#include "barycert/family.hpp"
#include "barycert/finding.hpp"
#include "barycert/fix.hpp"
#include "barycert/gmsh_files.hpp"
#include "barycert/inverse_rules.hpp"
#include "barycert/kernels.hpp"
#include "barycert/map.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/raster.hpp"
#include "barycert/rule_audit.hpp"
#include "barycert/series.hpp"
#include "barycert/statistics.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/surface_rules.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/threshold.hpp"
#include "barycert/vtk_files.hpp"
#include "barycert/witness.hpp"
#include "tests/fuzz/files.hpp"
#include "tests/fuzz/seed_texts.hpp"
#include "tests/fuzz/small_meshes.hpp"
#include "tests/fuzz/target.hpp"

namespace barycert::fuzz {
namespace {

std::filesystem::path folder;

void put(const std::string& target, const std::string& name, const std::string& bytes) {
    std::filesystem::create_directories(folder / target);
    std::ofstream(folder / target / name, std::ios::binary) << bytes;
}

void must(const Status& status) {
    expect(bool(status), "a seed cannot be written", status ? "" : status.error().message());
}

std::string written(const Mesh& mesh, const char* suffix, VtkData data) {
    const std::string path = scratch_path(std::string("seed") + suffix);
    must(write_vtk(mesh, path, data));
    return bytes_of(path);
}

/// One tetrahedron, or one triangle, with nodes amid its edges.
Mesh second_order(int dimension) {
    Mesh mesh;
    mesh.dimension = dimension;
    mesh.mid_edge_order = MidEdgeOrder::vtk;
    if (dimension == 2) {
        mesh.points = {0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0, 1};
        mesh.cells = {0, 1, 2};
        mesh.mid_nodes = {3, 4, 5};
    } else {
        mesh.points = {0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1};
        mesh.cells = {0, 1, 2, 3};
        mesh.mid_nodes = {4, 5, 6, 7, 8, 9};
    }
    return mesh;
}

Mesh with_labels(Mesh mesh) {
    mesh.cell_labels = {{"material", std::vector<std::string>{"steel", "a \"b\""}},
                        {"id", std::vector<std::int64_t>{(std::int64_t{1} << 60) + 1, -7}}};
    for (std::size_t i = 0; i < mesh.point_count(); ++i) mesh.point_markers.push_back(static_cast<std::int64_t>(i) - 1);
    return mesh;
}

Mesh with_faces(Mesh mesh) {
    mesh.faces = {0, 1, 2, 2, 3, 4};
    mesh.face_markers = {-1, 5};
    mesh.neighbours = {1, -1, -1, -1, -1, -1, -1, 0};
    mesh.index_base = 1;
    return mesh;
}

struct NamedMesh {
    const char* name;
    Mesh mesh;
};

std::vector<NamedMesh> meshes() {
    return {{"flat", small_mesh(2)},
            {"solid", small_mesh(3)},
            {"labels", with_labels(small_mesh(3))},
            {"flat2", second_order(2)},
            {"solid2", second_order(3)}};
}

void seed_tetgen(const std::string& name, const Mesh& mesh) {
    const std::string stem = scratch_path("seed-" + name);
    must(write_tetgen(mesh, stem, {.comment = "made"}));
    std::string all = bytes_of(stem + ".node") + '\f' + bytes_of(stem + ".ele");
    if (!mesh.faces.empty()) all += '\f' + bytes_of(stem + ".face") + '\f' + bytes_of(stem + ".neigh");
    put("tetgen", name, all);
    put("node", name, (mesh.dimension == 2 ? '\3' : '\2') + bytes_of(stem + ".node"));
}

void seed_meshes() {
    for (const NamedMesh& m : meshes()) {
        seed_tetgen(m.name, m.mesh);
        for (std::size_t i = 0; i < vtk_data_names.size(); ++i) {
            const std::string bytes = written(m.mesh, ".vtu", static_cast<VtkData>(i));
            const std::string name = std::string(m.name) + '-' + std::string(vtk_data_names[i]);
            put("vtk_xml", name, bytes);
            if (i == 0) put("mesh_file", name, '\2' + bytes);
            if (i == 0 || i == 4) put("vtk_points", name, (m.mesh.dimension == 2 ? '\3' : '\2') + bytes);
        }
        for (const VtkData data : {VtkData::raw, VtkData::ascii})
            put("vtk_legacy", std::string(m.name) + '-' + std::string(name(data)), written(m.mesh, ".vtk", data));
        for (int i = 0; i < 4; ++i) {
            const std::string path = scratch_path("seed.msh");
            must(
                write_gmsh(m.mesh, path,
                           {i / 2 == 0 ? GmshWriteOptions::Version::v41 : GmshWriteOptions::Version::v22, i % 2 == 0}));
            put("gmsh", std::string(m.name) + (i / 2 == 0 ? "-41" : "-22") + (i % 2 == 0 ? "-binary" : "-text"),
                bytes_of(path));
        }
    }
    seed_tetgen("faces", with_faces(small_mesh(3)));
    const Result<Surface> surface = boundary(small_mesh(3));
    for (const VtkData data : {VtkData::raw, VtkData::ascii}) {
        const std::string path = scratch_path("seed.vtp");
        expect(surface && write_surface(*surface, path, data), "a seed cannot be written");
        put("vtk_xml", "surface-" + std::string(name(data)), bytes_of(path));
        put("vtk_points", "surface-" + std::string(name(data)), '\2' + bytes_of(path));
    }
}

/// Files that name one file, two files, and themselves.
void seed_collections() {
    const std::string raw = written(small_mesh(3), ".vtu", VtkData::raw),
                      ascii = written(small_mesh(3), ".vtu", VtkData::ascii);
    for (const SeedText& text : collection_texts)
        put("vtk_collection", text.name, text.text + '\f' + raw + '\f' + ascii);
}

void seed_rows() {
    const Mesh& mesh = small_mesh(3);
    const std::vector<double> points{0.25, 0.25, 0.25, 1, 1, 1.5, -1, 0x1p-1074, 1e300};
    const std::vector<Mesh::Index> cells{0, 1, -1};
    const std::vector<Feature> features{Feature::interior, Feature::vertex, Feature::outside};
    const std::vector<double> values{0.625, 1, std::numeric_limits<double>::quiet_NaN()};
    const std::vector<Column> carried{{"id", std::vector<std::int64_t>{1, -2, 3}},
                                      {"time", std::vector<double>{0, 0.5, 1}},
                                      {"tag", std::vector<std::string>{"a", "b c", ""}}};
    TableFormat format;
    format.fields = {{"T", 1}};
    for (const Column& column : carried) format.carried.push_back({column.name, column.type(), 8, 8});
    for (const char* const suffix : {".csv", ".npy", ".vtu"}) {
        const std::string path = scratch_path(std::string("rows") + suffix);
        const Result<std::unique_ptr<TableSink>> sink = open_table(path, format);
        expect(bool(sink), "a seed cannot be written");
        must((*sink)->write(
            {.points = points, .cells = cells, .features = features, .values = values, .carried = carried}));
        must((*sink)->commit());
        const std::string bytes = bytes_of(path), name = std::string("rows") + (suffix + 1);
        const char kind = suffix[1] == 'c' ? '\0' : suffix[1] == 'n' ? '\1' : '\2';
        put("verify", name, static_cast<char>(kind + 4) + bytes);
        if (kind == 0) put("csv", name, '\2' + bytes), put("fields", "csv", '\2' + bytes);
        if (kind == 1) put("npy", name, '\2' + bytes), put("fields", "npy", '\3' + bytes);
        if (kind == 2) put("vtk_points", name, '\2' + bytes);
    }
    const std::string path = scratch_path("seed.map");
    Result<MapWriter> map = MapWriter::open(path, mesh, false);
    expect(bool(map), "a seed cannot be written");
    must(map->write({.points = points, .cells = cells, .features = features}));
    must(map->commit());
    put("maps", "solid", '\2' + bytes_of(path));
    put("maps", "solid-unmended", '\0' + bytes_of(path));
}

void seed_witnesses() {
    AuditReport report;
    report.kernels.resize(1);
    for (const Simplex s : all_simplices) {
        Witness w;
        w.kernel = "k", w.reason = "opposite_sign", w.family = "f";
        w.seed = 1, w.index = 2, w.magnitude = 0.5;
        w.c.simplex = s;
        for (std::size_t i = 0; i < w.c.vertices.size(); ++i) w.c.vertices[i] = static_cast<double>(i * i % 7);
        w.c.point = {0.5, 0x1.8p-3, 1};
        w.c.values = {1, 2, 3, 4};
        report.kernels.front().witnesses = {w};
        put("witnesses", std::string(name(s)), witnesses_json(report));
    }
    Witness w = report.kernels.front().witnesses.front();
    w.c = {Simplex::triangle, {0, 0, 1, 4, 0, 2, 0, 4, 3}, {1, 1}, {}, true};
    w.mesh = "m", w.cell = 3, w.detail = "d";
    report.kernels.front().witnesses = {w, w};
    put("witnesses", "two", witnesses_json(report));
}

void seed_pictures() {
    const std::string path = scratch_path("seed.png");
    must(write_png(path, four_colours()));
    put("png", "four", bytes_of(path));
}

/// By hand, for nothing here writes them.
void seed_medit() {
    const auto integers = [](std::initializer_list<std::int32_t> all) {
        return std::string(reinterpret_cast<const char*>(all.begin()), 4 * all.size());
    };
    std::string bytes = integers({1, 1, 3, 20, 3, 4, 96, 4});
    for (std::int32_t node = 0; node < 4; ++node)
        bytes += integers({node == 1 ? 0x3f800000 : 0, node == 2 ? 0x3f800000 : 0, node == 3 ? 0x3f800000 : 0, node});
    bytes += integers({8, 128, 1, 1, 2, 3, 4, 5, 66, 152, 1, 1, 1, 0x3f000000, 54, 0});
    put("medit", "binary", '\0' + bytes);
    put("medit", "binary-fields", '\1' + bytes);
}

void seed_all() {
    seed_meshes();
    seed_medit();
    seed_collections();
    seed_rows();
    seed_witnesses();
    seed_pictures();
    for (const SeedText& text : seed_texts) put(text.target, text.name, std::string(text.text));
}

}  // namespace
}  // namespace barycert::fuzz

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: fuzz_seeds FOLDER\n");
        return 2;
    }
    barycert::fuzz::folder = argv[1];
    barycert::fuzz::seed_all();
    return 0;
}
