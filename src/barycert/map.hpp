/// A map from points to cells in a file: locate once, sample many fields and time steps.
///
/// The file, version 1. All numbers are little-endian; a row is a point and a cell that holds it, or -1.
///
///   header, 56 bytes
///      0  8  magic: 89 42 43 4D 0D 0A 1A 0A (0x89, "BCM", and what a transfer as text would change)
///      8  4  version: 1
///     12  1  dimension: 2 or 3
///     13  1  1: the rows name every cell that holds a point, a row each; 0: one row a point, its owner
///     14  2  0
///     16  8  rows
///     24  8  nodes of the mesh
///     32  8  cells of the mesh
///     40  8  mesh_fingerprint of the mesh
///     48  8  checksum of the 48 bytes before, from 0
///   blocks of 8192 rows, the last one of what remains, of n rows each:
///      coordinates, float64, `dimension` a row, row after row; n cells, int32; n features, one byte: 0 interior, 1
///      face, 2 edge, 3 vertex, 4 outside; zeros up to a multiple of 8 bytes; checksum of all that, from the checksum
///      of the block before, or from the fingerprint in the first block.
///
/// The checksum of 8-byte words w from h: for each w, h = mix64((h ^ w) + 0x9e3779b97f4a7c15), modulo 2^64, mix64 as in
/// base/random.hpp. Each step is a bijection in h and in w, so that a change within one word is always found; any other
/// is missed once in 2^64. Blocks are chained, so that none can change places or come from another map.
///
/// In 3D a row takes 29 bytes and a block 8 more.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/table.hpp"

namespace barycert {

namespace sample {
struct MapWriterData;
struct MapReaderData;
}  // namespace sample

/// A hash of coordinates and cells: what a map depends on. Fields, markers, faces, neighbours and nodes at mid-edges
/// may change; 0.0 and -0.0 are the same coordinate. Reads the whole mesh once. It is the checksum, from 0, of these
/// words: the dimension; the number of coordinates, then the bits of each as float64, -0.0 as 0.0; the number of
/// corners of cells, then two of them a word, the first in its low half, 0 after the last.
std::uint64_t mesh_fingerprint(const Mesh& mesh);

/// Writes rows block by block: memory does not grow with their number. The file appears whole at commit(), or not at
/// all.
class MapWriter {
public:
    /// A map for points in `mesh`, which need not stay. `all`: there is a row for every cell that holds a point.
    /// Errors: a path that cannot be written; a pipe or device.
    static Result<MapWriter> open(const std::string& path, const Mesh& mesh, bool all);

    MapWriter(MapWriter&&) noexcept;
    MapWriter& operator=(MapWriter&&) noexcept;
    ~MapWriter();

    /// Appends the points, cells and features of the rows. Errors: sizes that do not fit together; a row that no map
    /// can hold (a coordinate that is not finite, a cell that is not in the mesh, a feature that the cell does not have
    /// there); disk full and the like. After an error, and after commit(), nothing can be written, and each call tells
    /// so.
    Status write(const TableView& rows);

    /// Makes the file appear, unless something failed.
    Status commit();

private:
    explicit MapWriter(std::unique_ptr<sample::MapWriterData> data);
    std::unique_ptr<sample::MapWriterData> data_;
};

/// Reads rows block by block, each checked before it is given.
class MapReader {
public:
    /// Errors: the file cannot be read; it is no map, of another version, damaged in its header, cut off or too long;
    /// it was made for another mesh. `mesh` need not stay.
    static Result<MapReader> open(const std::string& path, const Mesh& mesh);

    MapReader(MapReader&&) noexcept;
    MapReader& operator=(MapReader&&) noexcept;
    ~MapReader();

    int dimension() const;
    bool all() const;            ///< as MapWriter::open was told
    std::uint64_t rows() const;  ///< in the whole file

    /// Replaces points, cells and features of `rows` by the next rows, at most `max_rows` (at least 1), and returns how
    /// many: fewer only at the end, 0 after it. Errors: the file cannot be read or was cut off meanwhile; bytes were
    /// changed; a row that no map can hold. `rows` is empty then, and every later call returns the same error.
    Result<std::size_t> read(std::size_t max_rows, Table& rows);

private:
    explicit MapReader(std::unique_ptr<sample::MapReaderData> data);
    std::unique_ptr<sample::MapReaderData> data_;
};

}  // namespace barycert
