#include "barycert/map.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "barycert/base/output_file.hpp"
#include "barycert/base/text.hpp"
#include "barycert/environment.hpp"
#include "barycert/sample/map/map_format.hpp"

namespace barycert {

std::uint64_t mesh_fingerprint(const Mesh& mesh) {
    const ExactEnvironment environment;
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

namespace sample {

struct MapWriterData {
    MapWriterData(std::string path, const MapHeader& header)
        : name(std::move(path)), head(header), file(name), checksum(header.fingerprint) {}

    Status fail(Error e) {
        error = std::move(e);
        return error;
    }

    Status begin() {
        if (Status opened = file.status(); !opened) return fail(opened.error());
        if (!file.can_replace())
            return fail({.what = "cannot write a map to a pipe or device",
                         .file = name,
                         .expected = "a regular file: the number of rows is written into its header at the end",
                         .remedy = "name a regular file"});
        const std::array<char, map_header_size> no_header{};  // a file without its end must not pass for a map
        file.write({no_header.data(), no_header.size()});
        return Done{};
    }

    Status check(const TableView& rows) {
        const auto dimension = static_cast<std::size_t>(head.dimension);
        const std::size_t count = rows.row_count();
        if (rows.points.size() != dimension * count || rows.features.size() != count)
            return fail({.what = "the arrays of a map do not fit together",
                         .file = name,
                         .expected = std::to_string(dimension) + " coordinates, a cell and a feature a row",
                         .found = std::to_string(rows.points.size()) + " coordinates, " + std::to_string(count) +
                                  " cells, " + std::to_string(rows.features.size()) + " features"});
        for (std::size_t i = 0; i < count; ++i) {
            const double* const point = rows.points.data() + dimension * i;
            const auto feature = static_cast<unsigned>(rows.features[i]);
            const char* const fault = map_row_fault(point, head.dimension, rows.cells[i], feature, head.cells);
            if (fault == nullptr) continue;
            std::string found = "coordinates";
            for (std::size_t axis = 0; axis < dimension; ++axis) found += ' ' + base::shortest(point[axis]);
            return fail(
                {.what = "row " + std::to_string(head.rows + pending.row_count() + i) + " is not valid in a map",
                 .file = name,
                 .expected = fault,
                 .found = found + ", cell " + std::to_string(rows.cells[i]) + ", feature " + std::to_string(feature),
                 .remedy = "write results of a Locator on the same mesh"});
        }
        return Done{};
    }

    void put_block() {
        const std::size_t size = map_block_size(head.dimension, pending.row_count());
        bytes.assign(size + map_checksum_size, '\0');
        char* at = bytes.data();
        for (const double x : pending.points) at = put_little(at, std::bit_cast<std::uint64_t>(x));
        for (const Mesh::Index cell : pending.cells) at = put_little(at, static_cast<std::uint32_t>(cell));
        for (const Feature feature : pending.features) at = put_little(at, static_cast<std::uint8_t>(feature));
        checksum = map_checksum({bytes.data(), size}, checksum);
        put_little(bytes.data() + size, checksum);
        file.write({bytes.data(), bytes.size()});
        head.rows += pending.row_count();
        clear_map_rows(pending);
    }

    std::array<char, map_header_size> header() const {
        std::array<char, map_header_size> all{};
        char* at = std::copy(map_magic.begin(), map_magic.end(), all.data());
        at = put_little(at, map_version);
        at = put_little(at, static_cast<std::uint8_t>(head.dimension));
        at = put_little(at, static_cast<std::uint8_t>(head.all)) + 2;
        for (const std::uint64_t x : {head.rows, head.nodes, head.cells, head.fingerprint}) at = put_little(at, x);
        put_little(at, map_checksum({all.data(), map_header_size - map_checksum_size}, 0));
        return all;
    }

    std::string name;
    MapHeader head;  // head.rows: those written so far, without those pending
    base::OutputFile file;
    std::uint64_t checksum;  // of the last block
    Table pending;           // fewer rows than a block has
    std::vector<char> bytes;
    Error error;  // what every further call tells
    bool done = false;
};

}  // namespace sample

Result<MapWriter> MapWriter::open(const std::string& path, const Mesh& mesh, bool all) {
    const ExactEnvironment environment;
    const sample::MapHeader head{mesh.dimension, all, 0, mesh.point_count(), mesh.cell_count(), mesh_fingerprint(mesh)};
    auto data = std::make_unique<sample::MapWriterData>(path, head);
    if (Status begun = data->begin(); !begun) return begun.error();
    return MapWriter(std::move(data));
}

Status MapWriter::write(const TableView& rows) {
    const ExactEnvironment environment;
    sample::MapWriterData& to = *data_;
    if (!to.error.what.empty()) return to.error;
    if (to.done)
        return to.fail(
            {.what = "rows after the end of a map", .file = to.name, .remedy = "write them before commit()"});
    if (Status fits = to.check(rows); !fits) return fits;
    for (std::size_t row = 0; row < rows.row_count();) {
        const std::size_t room = sample::map_block_rows - to.pending.row_count();
        const std::size_t end = row + std::min(rows.row_count() - row, room);
        sample::append_map_rows(rows, to.head.dimension, row, end, to.pending);
        row = end;
        if (to.pending.row_count() == sample::map_block_rows) to.put_block();
    }
    if (Status written = to.file.status(); !written) return to.fail(written.error());
    return Done{};
}

Status MapWriter::commit() {
    sample::MapWriterData& to = *data_;
    if (!to.error.what.empty()) return to.error;
    if (to.done) return Done{};
    if (to.pending.row_count() != 0) to.put_block();
    const auto header = to.header();
    to.file.replace(0, {header.data(), header.size()});
    if (Status committed = to.file.commit(); !committed) return to.fail(committed.error());
    to.done = true;
    return Done{};
}

MapWriter::MapWriter(std::unique_ptr<sample::MapWriterData> data) : data_(std::move(data)) {}
MapWriter::MapWriter(MapWriter&&) noexcept = default;
MapWriter& MapWriter::operator=(MapWriter&&) noexcept = default;
MapWriter::~MapWriter() = default;

}  // namespace barycert
