#include <algorithm>
#include <bit>
#include <utility>

#include "barycert/base/input_file.hpp"
#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/map.hpp"
#include "barycert/sample/map/map_format.hpp"

namespace barycert {
namespace sample {

// Read, not mapped: a file that is cut off meanwhile is then an error and not the end of the process.
struct MapReaderData {
    explicit MapReaderData(std::string path) : name(std::move(path)) {}

    Error damage(std::string what, std::string expected, std::string found) const {
        return {.what = std::move(what),
                .file = name,
                .expected = std::move(expected),
                .found = std::move(found),
                .remedy = "create the map again, or copy it again"};
    }

    Status open(const Mesh& mesh) {
        Result<base::InputFile> opened = base::InputFile::open(name, "save the map to a regular file first");
        if (!opened) return opened.error();
        file = std::move(*opened);
        size = file.size();
        if (Status good = read_header(); !good) return good;
        return check_mesh(mesh);
    }

    /// `count` bytes from `from` on, into `bytes`.
    Status fill(std::uint64_t from, std::size_t count) {
        bytes.resize(count);
        const Result<std::size_t> got = file.read_at(from, bytes, name);
        if (!got) return got.error();
        if (*got == count) return Done{};
        return damage("the map is cut off", std::to_string(size) + " bytes", std::to_string(from + *got));
    }

    Status read_header() {
        const auto begin = static_cast<std::size_t>(std::min<std::uint64_t>(size, map_header_size));
        if (Status filled = fill(0, begin); !filled) return filled;
        const std::size_t known = std::min(begin, map_magic.size());
        if (size == 0 || std::string_view(bytes.data(), known) != map_magic.substr(0, known))
            return Error{.what = "not a map",
                         .file = name,
                         .expected = "a file written by barycert as a map",
                         .found = size == 0 ? "an empty file" : "other bytes at its beginning",
                         .remedy = "name a map; the mesh and the points are other files"};
        if (size < map_header_size)
            return damage("the map is cut off", "a header of " + std::to_string(map_header_size) + " bytes",
                          std::to_string(size));
        const char* const at = bytes.data();
        // First, for the rest of the header may mean something else in another version.
        if (const auto version = get_little<std::uint32_t>(at + 8); version != map_version)
            return Error{.what = "a map of another version",
                         .file = name,
                         .expected = "version " + std::to_string(map_version),
                         .found = "version " + std::to_string(version),
                         .remedy = "create the map again with this version, or read it with the version that wrote it"};
        constexpr std::size_t before = map_header_size - map_checksum_size;
        const bool whole = map_checksum({at, before}, 0) == get_little<std::uint64_t>(at + before);
        const auto dimension = static_cast<unsigned char>(at[12]), all = static_cast<unsigned char>(at[13]);
        if (!whole || (dimension != 2 && dimension != 3) || all > 1 || get_little<std::uint16_t>(at + 14) != 0)
            return damage("the header of the map is damaged", "the bytes that were written", "others");
        const auto word = [&](std::size_t i) { return get_little<std::uint64_t>(at + 16 + 8 * i); };
        head = {static_cast<int>(dimension), all == 1, word(0), word(1), word(2), word(3)};
        // A row takes more than a byte: no product below can overflow.
        const std::uint64_t blocks = head.rows / map_block_rows, rest = head.rows % map_block_rows;
        std::uint64_t expected = map_header_size;
        if (head.rows <= size) {
            expected += blocks * (map_block_size(head.dimension, map_block_rows) + map_checksum_size);
            if (rest != 0) expected += map_block_size(head.dimension, rest) + map_checksum_size;
        }
        if (head.rows > size || expected != size)
            return damage(
                head.rows > size || size < expected ? "the map is cut off" : "the map has bytes after its end",
                head.rows > size ? std::to_string(head.rows) + " rows" : std::to_string(expected) + " bytes",
                std::to_string(size) + (head.rows > size ? " bytes" : ""));
        offset = map_header_size;
        checksum = head.fingerprint;
        return Done{};
    }

    Status check_mesh(const Mesh& mesh) const {
        const bool alike =
            head.dimension == mesh.dimension && head.nodes == mesh.point_count() && head.cells == mesh.cell_count();
        if (alike && head.fingerprint == mesh_fingerprint(mesh)) return Done{};
        const auto size_of = [](int dimension, std::uint64_t nodes, std::uint64_t cells) {
            return "one of " + std::to_string(nodes) + " nodes and " + std::to_string(cells) +
                   (dimension == 2 ? " triangles" : " tetrahedra");
        };
        return Error{.what = "the map was made for another mesh",
                     .file = name,
                     .expected = size_of(head.dimension, head.nodes, head.cells),
                     .found = alike ? "one of that size with other coordinates or cells"
                                    : size_of(mesh.dimension, mesh.point_count(), mesh.cell_count()),
                     .remedy = "name the mesh of the map, or create the map again for this mesh"};
    }

    Status next_block() {
        const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(head.rows - row, map_block_rows));
        const std::size_t length = map_block_size(head.dimension, count);
        if (Status filled = fill(offset, length + map_checksum_size); !filled) return filled;
        const std::uint64_t found = map_checksum({bytes.data(), length}, checksum);
        if (found != get_little<std::uint64_t>(bytes.data() + length))
            return damage("rows " + std::to_string(row) + " to " + std::to_string(row + count - 1) + " are damaged",
                          "the bytes that were written", "others");
        if (Status decoded = decode(count); !decoded) return decoded;
        checksum = found;
        offset += length + map_checksum_size;
        row += count;
        given = 0;
        return Done{};
    }

    Status decode(std::size_t count) {
        const auto dimension = static_cast<std::size_t>(head.dimension);
        const char* at = bytes.data();
        block.points.resize(count * dimension);
        block.cells.resize(count);
        block.features.resize(count);
        for (double& x : block.points) {
            x = std::bit_cast<double>(get_little<std::uint64_t>(at));
            at += 8;
        }
        for (Mesh::Index& cell : block.cells) {
            cell = static_cast<Mesh::Index>(get_little<std::uint32_t>(at));
            at += 4;
        }
        for (std::size_t i = 0; i < count; ++i) {
            const auto feature = static_cast<unsigned char>(at[i]);
            const char* const fault =
                map_row_fault(&block.points[dimension * i], head.dimension, block.cells[i], feature, head.cells);
            if (fault != nullptr)
                return damage("row " + std::to_string(row + i) + " is not valid in a map", fault,
                              "cell " + std::to_string(block.cells[i]) + ", feature " + std::to_string(feature));
            block.features[i] = static_cast<Feature>(feature);
        }
        return Done{};
    }

    std::string name;
    MapHeader head;
    base::InputFile file;
    std::uint64_t size = 0;      // of the file
    std::uint64_t offset = 0;    // of the next block
    std::uint64_t row = 0;       // the first of the next block
    std::uint64_t checksum = 0;  // of the last block
    std::vector<char> bytes;
    Table block;            // the last one read
    std::size_t given = 0;  // rows of it
    Error error;            // what every further call tells
};

}  // namespace sample

Result<MapReader> MapReader::open(const std::string& path, const Mesh& mesh) {
    const ExactEnvironment environment;
    auto data = std::make_unique<sample::MapReaderData>(path);
    if (Status opened = data->open(mesh); !opened) return opened.error();
    return MapReader(std::move(data));
}

int MapReader::dimension() const {
    return data_->head.dimension;
}
bool MapReader::all() const {
    return data_->head.all;
}
std::uint64_t MapReader::rows() const {
    return data_->head.rows;
}
Result<std::size_t> MapReader::read(std::size_t max_rows, Table& rows) {
    const ExactEnvironment environment;
    sample::MapReaderData& from = *data_;
    rows.dimension = from.head.dimension;
    sample::clear_map_rows(rows);
    if (!from.error.what.empty()) return from.error;
    while (rows.row_count() < max_rows) {
        if (from.given == from.block.row_count()) {
            if (from.row == from.head.rows) break;
            if (Status next = from.next_block(); !next) {
                sample::clear_map_rows(rows);
                return from.error = next.error();
            }
        }
        const std::size_t end = from.given + std::min(max_rows - rows.row_count(), from.block.row_count() - from.given);
        sample::append_map_rows(from.block.view(), rows.dimension, from.given, end, rows);
        from.given = end;
    }
    return rows.row_count();
}

MapReader::MapReader(std::unique_ptr<sample::MapReaderData> data) : data_(std::move(data)) {}
MapReader::MapReader(MapReader&&) noexcept = default;
MapReader& MapReader::operator=(MapReader&&) noexcept = default;
MapReader::~MapReader() = default;

}  // namespace barycert
