#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "barycert/environment.hpp"
#include "barycert/locator.hpp"
#include "barycert/map.hpp"
#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/simplex.hpp"
#include "barycert/surface.hpp"
#include "barycert/table.hpp"
#include "core/base/text.hpp"
#include "core/shape_functions.hpp"
#include "files/input_file.hpp"
#include "files/output_file.hpp"
#include "io/map/map_format.hpp"
#include "mesh/cell_types.hpp"

namespace barycert {

namespace {

/// The fingerprint of a mesh or a surface.
std::uint64_t fingerprint(const auto& mesh) {
    std::uint64_t h = sample::map_step(0, static_cast<std::uint64_t>(mesh.dimension));
    h = sample::map_step(h, mesh.points.size());
    for (const double x : mesh.points)
        h = sample::map_step(h, std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x));  // -0.0 is the same place
    h = sample::map_step(h, mesh.cells.size());
    for (std::size_t i = 0; i < mesh.cells.size(); i += 2) {
        const std::uint64_t low = static_cast<std::uint32_t>(mesh.cells[i]);
        const std::uint64_t high = i + 1 < mesh.cells.size() ? static_cast<std::uint32_t>(mesh.cells[i + 1]) : 0;
        h = sample::map_step(h, high << 32 | low);
    }
    return h;
}

sample::MapHeader header_of(const auto& mesh, bool all) {
    return {.dimension = static_cast<std::uint8_t>(mesh.dimension),
            .all = static_cast<std::uint8_t>(all),
            .nodes = mesh.point_count(),
            .cells = mesh.cell_count(),
            .fingerprint = fingerprint(mesh)};
}

/// The header for a mesh some of whose cells are not taken as straight simplices: its fingerprint has their nodes, too.
sample::MapHeader header_of(const Mesh& mesh, bool all, const BuildOptions& located) {
    sample::MapHeader header = header_of(mesh, all);
    const auto has_products = [](std::uint8_t type) { return core::isoparametric::linear_reference(type) != nullptr; };
    const bool multilinear = located.interpolation == CellInterpolation::multilinear;
    if (multilinear && std::ranges::any_of(mesh.shapes.types, has_products)) header.taken = 1;
    if (located.curved != Curved::straight) {
        const bool exact = located.curved == Curved::exact;
        if (curved_cells(mesh, nullptr, exact).cells != 0 ||
            std::ranges::any_of(mesh.shapes.types, mesh::is_curved_simplex))
            header.taken |= 2;
        // Where nodes are off by rounding, and count as middles otherwise.
        if (exact && mesh.shapes.types.empty() && curved_cells(mesh).rounded_cells != 0) header.taken |= 4;
    }
    const auto add = [&](const auto& numbers) {
        for (const auto number : numbers)
            header.fingerprint = sample::map_step(header.fingerprint, static_cast<std::uint32_t>(number));
    };
    if (header.taken == 0) return header;
    add(mesh.shapes.types);
    add(mesh.shapes.nodes);
    add(mesh.mid_nodes);
    return header;
}

std::string words_of(std::uint16_t taken) {
    constexpr std::array words{"straight cells, linear", "multilinear cells", "curved cells",
                               "curved and multilinear cells"};
    return std::string(words[taken & 3U]) + ((taken & 4U) != 0 ? ", with every node as it is" : "");
}

}  // namespace

std::uint64_t mesh_fingerprint(const Mesh& mesh) {
    const ExactEnvironment environment;
    return fingerprint(mesh);
}
std::uint64_t mesh_fingerprint(const Surface& surface) {
    const ExactEnvironment environment;
    return fingerprint(surface);
}

namespace sample {

struct MapWriterData {
    MapWriterData(std::string path, const MapHeader& header)
        : name(std::move(path)), head(header), file(name), checksum(header.fingerprint) {}

    Status check(const TableView& rows) const {
        const std::size_t dimension = head.dimension, count = rows.row_count();
        if (rows.points.size() != dimension * count || rows.features.size() != count)
            return file_error("argument.size", name, "the arrays of a map do not fit together",
                              std::to_string(dimension) + " coordinates, a cell and a feature a row",
                              std::to_string(rows.points.size()) + " coordinates, " + std::to_string(count) +
                                  " cells, " + std::to_string(rows.features.size()) + " features");
        for (std::size_t i = 0; i < count; ++i) {
            const double* const point = rows.points.data() + dimension * i;
            const auto feature = static_cast<unsigned>(rows.features[i]);
            const char* const fault = map_row_fault(point, head.dimension, rows.cells[i], feature, head.cells);
            if (fault == nullptr) continue;
            return file_error("argument.value", name,
                              "row " + std::to_string(head.rows + pending.row_count() + i) + " is not valid in a map",
                              fault,
                              "coordinates " + base::joined(std::span(point, dimension), " ", base::shortest) +
                                  ", cell " + std::to_string(rows.cells[i]) + ", feature " + std::to_string(feature),
                              "write results of a Locator on the same mesh");
        }
        return Done{};
    }

    void put_block() {
        bytes.clear();
        const auto put = [&](const auto& numbers) {
            bytes.append(reinterpret_cast<const char*>(numbers.data()), std::span(numbers).size_bytes());
        };
        put(pending.points);
        put(pending.cells);
        put(pending.features);
        bytes.resize(map_block_size(head.dimension, pending.row_count()));
        checksum = map_checksum(bytes, checksum);
        file.write(bytes);
        file.write({reinterpret_cast<const char*>(&checksum), sizeof checksum});
        head.rows += pending.row_count();
        clear_map_rows(pending);
    }

    std::string name;
    MapHeader head;  // head.rows: those written so far, without those pending
    base::OutputFile file;
    std::uint64_t checksum;  // of the last block
    Table pending;           // fewer rows than a block has
    std::string bytes;
    Status state = Done{};  // what every further call tells
    bool done = false;
};

// Read, not mapped: a file that is cut off meanwhile is then an error and not the end of the process.
struct MapReaderData {
    MapReaderData(std::string path, base::InputFile input) : name(std::move(path)), file(std::move(input)) {}

    Error damage(std::string what, std::string expected, std::string found) const {
        return file_error("file.truncated", name, std::move(what), std::move(expected), std::move(found),
                          "create the map again, or copy it again");
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
        if (size == 0 || !map_magic.starts_with(std::string_view(bytes).substr(0, map_magic.size())))
            return file_error("file.format", name, "not a map", "a file written by barycert as a map",
                              size == 0 ? "an empty file" : "other bytes at its beginning",
                              "name a map; the mesh and the points are other files");
        if (size < map_header_size)
            return damage("the map is cut off", "a header of " + std::to_string(map_header_size) + " bytes",
                          std::to_string(size));
        std::memcpy(&head, bytes.data(), sizeof head);
        // First, for the rest of the header may mean something else in another version.
        if (head.version != map_version)
            return file_error("file.version", name, "a map of another version",
                              "version " + std::to_string(map_version), "version " + std::to_string(head.version),
                              "create the map again with this version, or read it with the version that wrote it");
        if (head.checksum != head.right_checksum() || (head.dimension != 2 && head.dimension != 3) || head.all > 1 ||
            head.taken > 7)
            return damage("the header of the map is damaged", "the bytes that were written", "others");
        // A row takes more than a byte: no product below can overflow.
        if (head.rows > size)
            return damage("the map is cut off", std::to_string(head.rows) + " rows", std::to_string(size) + " bytes");
        const std::uint64_t blocks = head.rows / map_block_rows, rest = head.rows % map_block_rows;
        std::uint64_t expected =
            map_header_size + blocks * (map_block_size(head.dimension, map_block_rows) + map_checksum_size);
        if (rest != 0) expected += map_block_size(head.dimension, rest) + map_checksum_size;
        if (expected != size)
            return damage(size < expected ? "the map is cut off" : "the map has bytes after its end",
                          std::to_string(expected) + " bytes", std::to_string(size));
        offset = map_header_size;
        checksum = head.fingerprint;
        return Done{};
    }

    /// `is`: what it is held against; `cells`: as a word.
    Status check(const MapHeader& is, const char* cells) const {
        const bool alike = head.dimension == is.dimension && head.nodes == is.nodes && head.cells == is.cells;
        if (alike && head.taken != is.taken)
            return file_error("map.cells", name, "the map was made of cells taken otherwise", words_of(head.taken),
                              words_of(is.taken),
                              "take them as the map does (interpolation, curved cells), or create the map again");
        if (alike && head.fingerprint == is.fingerprint) return Done{};
        const auto size_of = [](std::uint64_t nodes, std::uint64_t count, const char* word) {
            return "one of " + std::to_string(nodes) + " nodes and " + std::to_string(count) + ' ' + word;
        };
        // In space they may be tetrahedra or triangles: the file does not tell.
        return file_error(
            "map.mesh", name, "the map was made for another mesh",
            size_of(head.nodes, head.cells, head.dimension == 2 ? "triangles" : "cells"),
            alike ? "one of that size with other coordinates or cells" : size_of(is.nodes, is.cells, cells),
            "name the mesh of the map, or create the map again for this mesh");
    }

    Status next_block() {
        const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(head.rows - row, map_block_rows));
        const std::size_t length = map_block_size(head.dimension, count);
        if (Status filled = fill(offset, length + map_checksum_size); !filled) return filled;
        const std::uint64_t found = map_checksum({bytes.data(), length}, checksum);
        if (found != map_word(bytes.data() + length))
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
        const std::size_t dimension = head.dimension;
        const char* at = bytes.data();
        block.points.resize(count * dimension);
        block.cells.resize(count);
        block.features.resize(count);
        std::memcpy(block.points.data(), at, 8 * dimension * count);
        std::memcpy(block.cells.data(), at += 8 * dimension * count, 4 * count);
        at += 4 * count;
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
    std::uint64_t size = file.size();
    std::uint64_t offset = 0;    // of the next block
    std::uint64_t row = 0;       // the first of the next block
    std::uint64_t checksum = 0;  // of the last block
    std::string bytes;
    Table block;                 // the last one read
    std::size_t given = 0;       // rows of it
    std::optional<Error> error;  // what every further call tells
};

}  // namespace sample

Result<MapWriter> MapWriter::begin(const std::string& path, const sample::MapHeader& head) {
    auto data = std::make_unique<sample::MapWriterData>(path, head);
    if (Status opened = data->file.status(); !opened) return opened.error();
    if (!data->file.can_replace())
        return file_error("file.pipe", path, "cannot write a map to a pipe or device",
                          "a regular file: the number of rows is written into its header at the end", {},
                          "name a regular file");
    data->file.write(head.bytes());
    return MapWriter(std::move(data));
}
Result<MapWriter> MapWriter::open(const std::string& path, const Mesh& mesh, bool all, const BuildOptions& located) {
    const ExactEnvironment environment;
    return begin(path, header_of(mesh, all, located));
}
Result<MapWriter> MapWriter::open(const std::string& path, const Surface& surface) {
    const ExactEnvironment environment;
    return begin(path, header_of(surface, false));
}

Status MapWriter::write(const TableView& rows) {
    const ExactEnvironment environment;
    sample::MapWriterData& to = *data_;
    if (!to.state) return to.state;
    if (to.done)
        return to.state = file_error("argument.value", to.name, "rows after the end of a map", {}, {},
                                     "write them before commit()");
    if (to.state = to.check(rows); !to.state) return to.state;
    for (std::size_t row = 0; row < rows.row_count();) {
        const std::size_t room = sample::map_block_rows - to.pending.row_count();
        const std::size_t end = row + std::min(rows.row_count() - row, room);
        sample::append_map_rows(rows, to.head.dimension, row, end, to.pending);
        row = end;
        if (to.pending.row_count() == sample::map_block_rows) to.put_block();
    }
    return to.state = to.file.status();
}

Status MapWriter::commit() {
    sample::MapWriterData& to = *data_;
    if (!to.state || to.done) return to.state;
    if (to.pending.row_count() != 0) to.put_block();
    sample::map_magic.copy(to.head.magic.data(), sample::map_magic.size());
    to.head.checksum = to.head.right_checksum();
    to.file.replace(0, to.head.bytes());
    to.state = to.file.commit();
    to.done = to.state.has_value();
    return to.state;
}

MapWriter::MapWriter(std::unique_ptr<sample::MapWriterData> data)
    : data_(data.release(), [](sample::MapWriterData* d) { delete d; }) {}

Result<MapReader> MapReader::begin(const std::string& path, const sample::MapHeader& of, const char* cells) {
    Result<base::InputFile> opened = base::InputFile::open(path, "save the map to a regular file first");
    if (!opened) return opened.error();
    auto data = std::make_unique<sample::MapReaderData>(path, std::move(*opened));
    if (Status good = data->read_header(); !good) return good.error();
    if (Status good = data->check(of, cells); !good) return good.error();
    return MapReader(std::move(data));
}
Result<MapReader> MapReader::open(const std::string& path, const Mesh& mesh, const BuildOptions& located) {
    const ExactEnvironment environment;
    return begin(path, header_of(mesh, false, located), mesh.dimension == 2 ? "triangles" : "cells");
}
Result<MapReader> MapReader::open(const std::string& path, const Surface& surface) {
    const ExactEnvironment environment;
    return begin(path, header_of(surface, false), "triangles in space");
}

int MapReader::dimension() const {
    return data_->head.dimension;
}
bool MapReader::all() const {
    return data_->head.all != 0;
}
std::uint64_t MapReader::rows() const {
    return data_->head.rows;
}
Result<std::size_t> MapReader::read(std::size_t max_rows, Table& rows) {
    const ExactEnvironment environment;
    sample::MapReaderData& from = *data_;
    rows.dimension = from.head.dimension;
    sample::clear_map_rows(rows);
    if (from.error) return *from.error;
    while (rows.row_count() < max_rows) {
        if (from.given == from.block.row_count()) {
            if (from.row == from.head.rows) break;
            if (Status next = from.next_block(); !next) {
                sample::clear_map_rows(rows);
                return *(from.error = next.error());
            }
        }
        const std::size_t end = from.given + std::min(max_rows - rows.row_count(), from.block.row_count() - from.given);
        sample::append_map_rows(from.block.view(), rows.dimension, from.given, end, rows);
        from.given = end;
    }
    return rows.row_count();
}

MapReader::MapReader(std::unique_ptr<sample::MapReaderData> data)
    : data_(data.release(), [](sample::MapReaderData* d) { delete d; }) {}

}  // namespace barycert
