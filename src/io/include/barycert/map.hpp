/// A map from points to cells in a file: locate once, sample many fields and time steps.
///
/// A row is a point and a cell that holds it, or -1; in 3D it takes 29 bytes. doc/formats.md has the format. A change
/// within 8 bytes of a file is always detected, any other is missed once in 2^64.
///
/// Example:
///
///     const Mesh mesh{.dimension = 2, .points = {0, 0, 1, 0, 0, 1}, .cells = {0, 1, 2}};
///     MapReader map = MapReader::open("points.map", mesh).value();  // an Error where it is of another mesh
///     Table rows;
///     while (map.read(1000, rows).value() != 0) rows = {};
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "barycert/locator.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/surface.hpp"
#include "barycert/table.hpp"

namespace barycert {

namespace sample {
struct MapHeader;
struct MapWriterData;
struct MapReaderData;
}  // namespace sample

/// A hash of coordinates and cells: what a map depends on, beside nodes of cells that are taken as curved or
/// multilinear. Fields, markers, faces, neighbours and nodes at mid-edges may change; 0.0 and -0.0 are the same
/// coordinate. Reads the whole mesh once. It is the checksum, from 0, of these words: the dimension; the number of
/// coordinates, then the bits of each as float64, -0.0 as 0.0; the number of corners of cells, then two of them a word,
/// the first in its low half, 0 after the last.
std::uint64_t mesh_fingerprint(const Mesh& mesh);
std::uint64_t mesh_fingerprint(const Surface& surface);

/// Writes rows block by block: memory does not grow with their number. The file appears whole at commit(), or not at
/// all.
class MapWriter {
public:
    /// A map for points in `mesh`, which need not stay. `all`: there is a row for every cell that holds a point.
    /// `located`: how the locator was built that knows them. Errors: a path that cannot be written; a pipe or device.
    static Result<MapWriter> open(const std::string& path, const Mesh& mesh, bool all,
                                  const BuildOptions& located = {});
    /// A map to the nearest triangles of a surface: `cells` are triangles, features those in which nearest points lie.
    static Result<MapWriter> open(const std::string& path, const Surface& surface);

    /// Appends the points, cells and features of the rows. Errors: sizes that do not fit together; a row that no map
    /// can hold (a coordinate that is not finite, a cell that is not in the mesh, a feature that it does not have);
    /// disk full and the like. After an error, and after commit(), nothing can be written, and each call tells so.
    Status write(const TableView& rows);

    /// Makes the file appear, unless something failed.
    Status commit();

private:
    static Result<MapWriter> begin(const std::string& path, const sample::MapHeader& header);
    explicit MapWriter(std::unique_ptr<sample::MapWriterData> data);
    std::unique_ptr<sample::MapWriterData, void (*)(sample::MapWriterData*)> data_;
};

/// Reads rows block by block, each checked before it is given.
class MapReader {
public:
    /// Errors: the file cannot be read; it is no map, of another version, damaged in its header, cut off or too long;
    /// it was made for another mesh, or by a locator that takes its cells otherwise. `mesh` need not stay.
    static Result<MapReader> open(const std::string& path, const Mesh& mesh, const BuildOptions& located = {});
    static Result<MapReader> open(const std::string& path, const Surface& surface);

    int dimension() const;
    bool all() const;            ///< as MapWriter::open was told
    std::uint64_t rows() const;  ///< in the whole file

    /// Replaces points, cells and features of `rows` by the next rows, at most `max_rows` >= 1, and returns how many:
    /// fewer only at the end, 0 after it. Errors: the file cannot be read, was cut off or changed; a row that no map
    /// can hold. `rows` is empty then, and every later call returns the same error.
    Result<std::size_t> read(std::size_t max_rows, Table& rows);

private:
    static Result<MapReader> begin(const std::string& path, const sample::MapHeader& of, const char* cells);
    explicit MapReader(std::unique_ptr<sample::MapReaderData> data);
    std::unique_ptr<sample::MapReaderData, void (*)(sample::MapReaderData*)> data_;
};

}  // namespace barycert
