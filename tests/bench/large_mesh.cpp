#include "large_mesh.hpp"

#include <tetgen.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace {

namespace fs = std::filesystem;

void set_unit_cube(tetgenio& plc) {
    plc.firstnumber = 0;
    plc.numberofpoints = 8;
    plc.pointlist = new REAL[24];
    for (int i = 0; i < 8; ++i) {
        for (int axis = 0; axis < 3; ++axis) plc.pointlist[3 * i + axis] = (i >> axis) & 1;
    }
    constexpr int corners[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
    plc.numberoffacets = 6;
    plc.facetlist = new tetgenio::facet[6];
    for (int i = 0; i < 6; ++i) {
        tetgenio::facet& facet = plc.facetlist[i];
        tetgenio::init(&facet);
        facet.numberofpolygons = 1;
        facet.polygonlist = new tetgenio::polygon[1];
        tetgenio::init(&facet.polygonlist[0]);
        facet.polygonlist[0].numberofvertices = 4;
        facet.polygonlist[0].vertexlist = new int[4];
        std::copy_n(corners[i], 4, facet.polygonlist[0].vertexlist);
    }
}

}  // namespace

std::string large_mesh_stem() {
    const char* const named = std::getenv("BARYCERT_BENCH_DIR");
    const fs::path folder = named != nullptr ? fs::path(named) : fs::temp_directory_path();
    fs::create_directories(folder);
    const std::string stem = (folder / "barycert-cube-2m").string();
    if (fs::exists(stem + ".node") && fs::exists(stem + ".ele")) return stem;
    std::fprintf(stderr, "making %s.node and .ele ...\n", stem.c_str());
    const Silence silence;
    tetgenio plc, mesh;
    set_unit_cube(plc);
    char switches[] = "Qpq1.4a1e-6";
    tetrahedralize(switches, &plc, &mesh);
    const std::string unfinished = stem + "-unfinished";  // an interrupted run must not leave half a mesh for the next
    mesh.save_nodes(const_cast<char*>(unfinished.c_str()));
    mesh.save_elements(const_cast<char*>(unfinished.c_str()));
    fs::rename(unfinished + ".node", stem + ".node");
    fs::rename(unfinished + ".ele", stem + ".ele");
    return stem;
}
