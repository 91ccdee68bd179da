/// A map from points to cells, saved and loaded: locate once, sample many fields and time steps.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "barycert/core/result.hpp"
#include "barycert/core/simplex.hpp"
#include "barycert/mesh/mesh.hpp"

namespace barycert {

/// One row a point, or one a point and cell that holds it. A value: apply it by Sampler::evaluate.
struct LocationMap {
    int dimension = 3;
    bool all = false;            ///< rows name every cell that holds a point, not the owner alone
    std::vector<double> points;  ///< dimension coordinates a row
    std::vector<Mesh::Index> cells;
    std::vector<Feature> features;
    std::uint64_t mesh = 0;  ///< fingerprint of the points and cells of the mesh it was made for
};

/// Of coordinates and cells: what a map depends on. Fields may change.
std::uint64_t mesh_fingerprint(const Mesh& mesh);

/// Writes rows block by block, so memory does not grow with their number; the file appears whole at commit().
class MapWriter;

/// The format: see map_file.cpp. Errors: the file cannot be read; it is no map, of another version, cut off or changed
/// (a checksum tells); an index is out of range for `mesh`, or the map was made for another mesh.
Result<LocationMap> read_map(const std::string& path, const Mesh& mesh);

}  // namespace barycert
