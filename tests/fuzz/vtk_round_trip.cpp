#include "tests/fuzz/vtk_round_trip.hpp"

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

void read_and_write_vtk(const std::string& path, std::size_t lines, const std::string& out, VtkData data) {
    const Result<Mesh> mesh = read_vtk(path);
    if (!mesh) return expect_useful(mesh.error(), lines);
    expect_whole(*mesh);
    // Names that one format can hold, and another not, are refused.
    if (const Status done = write_vtk(*mesh, without_file(out), data); !done) return expect_useful(done.error(), lines);
    const Result<Mesh> again = read_vtk(out);
    expect(bool(again), "a mesh that was written is not read", again ? "" : again.error().message());
    expect_same(*mesh, *again, data == VtkData::ascii ? Payload::lost : Payload::kept);
}

}  // namespace barycert::fuzz
