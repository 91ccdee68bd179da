// Gmsh's .msh files of all versions.
#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"

#include <algorithm>

#include "tests/fuzz/files.hpp"
#include "tests/fuzz/same.hpp"
#include "tests/fuzz/target.hpp"

namespace barycert::fuzz {
namespace {

/// Written in one of the four ways, and read.
Mesh written(const Mesh& mesh, const GmshWriteOptions& options) {
    static const std::string path = scratch_path("out.msh");
    const Status done = write_gmsh(mesh, without_file(path), options);
    expect(bool(done), "a mesh that was read is not written", done ? "" : done.error().message());
    Result<Mesh> again = read_gmsh(path, {.threads = 1});
    expect(bool(again), "a mesh that was written is not read", again ? "" : again.error().message());
    return std::move(*again);
}

bool names_can_be_written(const Mesh& mesh) {
    for (const std::vector<Field>* const fields : {&mesh.point_fields, &mesh.cell_fields}) {
        for (std::size_t i = 0; i < fields->size(); ++i) {
            if ((*fields)[i].name.find_first_of("\"\r\n") != std::string::npos) return false;
            for (std::size_t k = 0; k < i; ++k) {
                if ((*fields)[i].name == (*fields)[k].name) return false;
            }
        }
    }
    return true;
}

/// Groups stand after other fields, and entities that groups made necessary are an addition: both as documented.
std::vector<Field> comparable(std::vector<Field> fields, const std::vector<Field>& original) {
    const auto is_entities = [](const Field& field) { return field.name == "gmsh:geometrical"; };
    if (std::none_of(original.begin(), original.end(), is_entities)) std::erase_if(fields, is_entities);
    std::sort(fields.begin(), fields.end(), [](const Field& a, const Field& b) { return a.name < b.name; });
    return fields;
}

}  // namespace

BARYCERT_FUZZ_TARGET(gmsh) {
    static InputFile file("in.msh");
    const std::size_t lines = lines_of(input);
    const std::string& path = file.put(input);
    const Result<std::vector<GmshStep>> steps = gmsh_steps(path);
    if (!steps) expect_useful(steps.error(), lines);
    for (const int dimension : {2, 3}) {
        const Result<std::vector<double>> points = read_gmsh_points(path, dimension, 1);
        if (!points) expect_useful(points.error(), lines);
    }
    const Result<Mesh> mesh = read_gmsh(path, {.threads = 1});
    if (!mesh) return expect_useful(mesh.error(), lines);
    expect_whole(*mesh);

    // Names of fields that differ in their quotes alone, or have some, were read and are not written.
    if (!names_can_be_written(*mesh)) return;
    const bool binary = input.size() % 2 != 0;
    const GmshWriteOptions options{
        input.size() % 4 < 2 ? GmshWriteOptions::Version::v41 : GmshWriteOptions::Version::v22, binary};
    // Parts that are left out of a file give others other numbers: the labels of a second writing are those of the
    // first.
    const Mesh once = written(*mesh, options), twice = written(once, options);
    const Payload payload = binary ? Payload::kept : Payload::lost;
    expect_same(once, twice, payload);
    if (!mesh->shapes.types.empty()) return;  // it was written as simplices
    Mesh first = *mesh, second = once;
    first.cell_fields = comparable(mesh->cell_fields, mesh->cell_fields);
    second.cell_fields = comparable(once.cell_fields, mesh->cell_fields);
    first.cell_labels.clear();
    second.cell_labels.clear();
    expect_same(first, second, payload);
}

}  // namespace barycert::fuzz
