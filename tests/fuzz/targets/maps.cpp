// Maps from points to cells. The first byte: the dimension, and whether magic, version, fingerprint and checksums are
// made right first, without which nothing behind them would ever be read.
#include "barycert/map.hpp"

#include <algorithm>
#include <bit>

#include "io/map/map_format.hpp"
#include "tests/fuzz/files.hpp"
#include "tests/fuzz/small_meshes.hpp"
#include "tests/fuzz/target.hpp"

namespace barycert::fuzz {
namespace {

/// Checksums of the header and of each block that is there whole, as the header tells its rows.
void mend(std::string& bytes, const Mesh& mesh) {
    using namespace sample;
    if (bytes.size() < map_header_size) return;
    MapHeader head;
    std::memcpy(&head, bytes.data(), sizeof head);
    map_magic.copy(head.magic.data(), map_magic.size());
    head.version = map_version;
    head.dimension = static_cast<std::uint8_t>(mesh.dimension);
    head.nodes = mesh.point_count();
    head.cells = mesh.cell_count();
    head.fingerprint = mesh_fingerprint(mesh);
    head.checksum = head.right_checksum();
    bytes.replace(0, map_header_size, head.bytes());
    std::uint64_t chain = head.fingerprint;
    std::size_t at = map_header_size;
    for (std::uint64_t row = 0; row < head.rows; row += map_block_rows) {
        const std::size_t size = map_block_size(
            mesh.dimension, static_cast<std::size_t>(std::min<std::uint64_t>(map_block_rows, head.rows - row)));
        if (bytes.size() - at < size + map_checksum_size) return;
        chain = map_checksum(std::string_view(bytes).substr(at, size), chain);
        std::memcpy(bytes.data() + at + size, &chain, sizeof chain);
        at += size + map_checksum_size;
    }
}

/// The rows, to the end or to an error.
Result<Table> all_rows(MapReader& reader, std::size_t block) {
    Table all, rows;
    all.dimension = reader.dimension();
    while (true) {
        const Result<std::size_t> count = reader.read(block, rows);
        if (!count) return count.error();
        expect(*count == rows.cells.size() && rows.cells.size() == rows.features.size() &&
                   rows.points.size() == rows.cells.size() * static_cast<std::size_t>(all.dimension),
               "rows that do not fit together were read");
        all.points.insert(all.points.end(), rows.points.begin(), rows.points.end());
        all.cells.insert(all.cells.end(), rows.cells.begin(), rows.cells.end());
        all.features.insert(all.features.end(), rows.features.begin(), rows.features.end());
        if (*count < block) return all;
    }
}

}  // namespace

BARYCERT_FUZZ_TARGET(maps) {
    static InputFile file("in.map");
    static const std::string out = scratch_path("out.map");
    const unsigned how = input.empty() ? 0 : static_cast<unsigned char>(input.front());
    std::string bytes(input.substr(std::min<std::size_t>(1, input.size())));
    const Mesh& mesh = small_mesh((how & 1) != 0 ? 2 : 3);
    if ((how & 2) != 0) mend(bytes, mesh);
    Result<MapReader> reader = MapReader::open(file.put(bytes), mesh);
    if (!reader) return expect_useful(reader.error(), 0);
    const Result<Table> rows = all_rows(*reader, 1 + how / 16);
    if (!rows) return expect_useful(rows.error(), 0);
    expect(rows->row_count() == reader->rows(), "a map with another number of rows than it says was read");

    Result<MapWriter> writer = MapWriter::open(without_file(out), mesh, reader->all());
    expect(bool(writer) && writer->write(rows->view()) && writer->commit(), "a map that was read is not written");
    Result<MapReader> again = MapReader::open(out, mesh);
    expect(bool(again), "a map that was written is not read");
    const Result<Table> same = all_rows(*again, 1000);
    // Points that are in no cell may have coordinates that are NaN.
    const auto same_bits = [](double x, double y) {
        return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
    };
    expect(bool(same) && std::ranges::equal(same->points, rows->points, same_bits) && same->cells == rows->cells &&
               same->features == rows->features && again->all() == reader->all(),
           "another map came back");
}

}  // namespace barycert::fuzz
