/// Weights of points as a sparse matrix in an NPZ file, which scipy.sparse.load_npz reads.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"

namespace barycert::io {

/// A matrix of a row a point and a column a node, in compressed rows: `data` float64, `indices` and `indptr` int32, or
/// int64 where there are 2^31 entries or more, `shape` int64, `format` "csr"; besides, `cell` int64, an entry a row.
/// Memory does not grow with the number of rows: what has to wait for its place in the file waits on disk beside it.
class WeightsFile {
public:
    virtual ~WeightsFile() = default;

    static Result<std::unique_ptr<WeightsFile>> open(const std::string& path, std::uint64_t nodes);

    /// Appends rows: as many entries each as `counts` tells, nodes ascending, and the cell, -1 for none.
    virtual Status write(std::span<const std::uint8_t> counts, std::span<const Mesh::Index> nodes,
                         std::span<const double> weights, std::span<const Mesh::Index> cells) = 0;

    virtual Status commit() = 0;
};

}  // namespace barycert::io
