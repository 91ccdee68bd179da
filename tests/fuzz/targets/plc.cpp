// Piecewise linear complexes. The first byte: .poly (with .node behind a form feed), .smesh, .off, .stl, .ply.
#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"

#include <array>
#include <cmath>

#include "tests/fuzz/files.hpp"
#include "tests/fuzz/target.hpp"

namespace barycert::fuzz {
namespace {

void expect_whole_plc(const Plc& plc) {
    const std::size_t points = plc.point_count();
    expect(plc.points.size() % 3 == 0 && plc.holes.size() % 3 == 0 && plc.regions.size() % 5 == 0,
           "half a point was read");
    expect(plc.attributes.size() == points * static_cast<std::size_t>(plc.attribute_count),
           "attributes that do not fit were read");
    expect(plc.point_markers.empty() || plc.point_markers.size() == points, "markers that do not fit were read");
    for (const double x : plc.points) expect(std::isfinite(x), "a coordinate that is not finite was read");
    for (const PlcFacet& facet : plc.facets) {
        for (const auto& ring : facet.polygons) {
            for (const std::int32_t i : ring)
                expect(i >= 0 && static_cast<std::size_t>(i) < points, "an index out of range was read");
        }
    }
}

}  // namespace

BARYCERT_FUZZ_TARGET(plc) {
    static std::array<InputFile, 5> files{InputFile("in.poly"), InputFile("in.smesh"), InputFile("in.off"),
                                          InputFile("in.stl"), InputFile("in.ply")};
    static InputFile node("in.node");
    const std::size_t lines = lines_of(input);
    const std::size_t which = input.empty() ? 0 : static_cast<unsigned char>(input.front()) % files.size();
    if (!input.empty()) input.remove_prefix(1);
    const std::string& path = files[which].put(which < 2 ? next_part(input) : input);
    node.put(which < 2 ? input : std::string_view());
    const Result<Plc> plc = read_plc(path);
    if (!plc) return expect_useful(plc.error(), lines);
    expect_whole_plc(*plc);
}

}  // namespace barycert::fuzz
