// TetGen's and Triangle's files: .node, .ele, .face and .neigh, with form feeds between them. The last two may be
// missing.
#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "tests/fuzz/files.hpp"
#include "tests/fuzz/same.hpp"
#include "tests/fuzz/target.hpp"

namespace barycert::fuzz {

BARYCERT_FUZZ_TARGET(tetgen) {
    static InputFile node("in.node"), ele("in.ele"), face("in.face"), neigh("in.neigh");
    const std::size_t lines = lines_of(input);
    const std::string stem = tetgen_stem(node.put(next_part(input)));
    ele.put(next_part(input));
    for (InputFile* const file : {&face, &neigh}) {
        if (input.empty()) file->remove();
        if (!input.empty()) file->put(next_part(input));
    }
    const Result<Mesh> mesh = read_tetgen(stem, {.threads = 1});
    if (!mesh) return expect_useful(mesh.error(), lines);
    expect_whole(*mesh);

    static const std::string out = scratch_path("out");
    // Where a mesh has none, those of another one are in the way.
    for (const char* const suffix : {".node", ".ele", ".face", ".neigh"}) without_file(out + suffix);
    const Status written = write_tetgen(*mesh, out);
    expect(bool(written), "a mesh that was read is not written", written ? "" : written.error().message());
    const Result<Mesh> again =
        read_tetgen(out, {.faces = !mesh->faces.empty(), .neighbours = !mesh->neighbours.empty(), .threads = 1});
    expect(bool(again), "a mesh that was written is not read", again ? "" : again.error().message());
    expect_same(*mesh, *again, Payload::lost);
}

}  // namespace barycert::fuzz
