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
    for (const double x : mesh.points) {
        h = sample::map_step(h, std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x));  // -0.0 is the same place
    }
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
    MapWriterData(std::string path, const MapHeader& header) : name(std::move(path)), head(header), file(name) {}

    Status begin();
    Status write(const TableView& rows);
    Status commit();

    std::string name;
    MapHeader head;  // head.rows: those written so far, without those pending
    base::OutputFile file;
    std::uint64_t checksum = 0;  // of the last block
    Table pending;               // fewer rows than a block has
    std::vector<char> bytes;
    Error error;  // what every further call tells
    bool done = false;

private:
    Status fail(Error e) {
        error = std::move(e);
        return error;
    }
    Status check(const TableView& rows);
    void put_block();
};

namespace {

std::array<char, map_header_size> header_bytes(const MapHeader& head) {
    std::array<char, map_header_size> bytes{};
    for (std::size_t i = 0; i < map_magic.size(); ++i) bytes[i] = map_magic[i];
    put_little<std::uint32_t>(&bytes[8], map_version);
    bytes[12] = static_cast<char>(head.dimension);
    bytes[13] = head.all ? 1 : 0;
    put_little<std::uint64_t>(&bytes[16], head.rows);
    put_little<std::uint64_t>(&bytes[24], head.nodes);
    put_little<std::uint64_t>(&bytes[32], head.cells);
    put_little<std::uint64_t>(&bytes[40], head.fingerprint);
    constexpr std::size_t before = map_header_size - map_checksum_size;
    put_little<std::uint64_t>(&bytes[before], map_checksum({bytes.data(), before}, 0));
    return bytes;
}

}  // namespace

Status MapWriterData::begin() {
    if (Status opened = file.status(); !opened) return fail(opened.error());
    if (!file.can_replace()) {
        return fail({.what = "cannot write a map to a pipe or device",
                     .file = name,
                     .expected = "a regular file: the number of rows is written into its header at the end",
                     .remedy = "name a regular file"});
    }
    checksum = head.fingerprint;
    const std::array<char, map_header_size> no_header{};  // a file without its end must not pass for a map
    file.write({no_header.data(), no_header.size()});
    return Done{};
}

Status MapWriterData::check(const TableView& rows) {
    const auto& points = rows.points;
    const auto& cells = rows.cells;
    const auto& features = rows.features;
    const auto dimension = static_cast<std::size_t>(head.dimension);
    if (points.size() != dimension * cells.size() || features.size() != cells.size()) {
        return fail({.what = "the arrays of a map do not fit together",
                     .file = name,
                     .expected = std::to_string(dimension) + " coordinates, a cell and a feature a row",
                     .found = std::to_string(points.size()) + " coordinates, " + std::to_string(cells.size()) +
                              " cells, " + std::to_string(features.size()) + " features"});
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const double* const point = points.data() + dimension * i;
        const auto feature = static_cast<unsigned>(features[i]);
        const char* const fault = map_row_fault(point, head.dimension, cells[i], feature, head.cells);
        if (fault == nullptr) continue;
        std::string found = "coordinates";
        for (std::size_t axis = 0; axis < dimension; ++axis) found += ' ' + base::shortest(point[axis]);
        return fail({.what = "row " + std::to_string(head.rows + pending.cells.size() + i) + " is not valid in a map",
                     .file = name,
                     .expected = fault,
                     .found = found + ", cell " + std::to_string(cells[i]) + ", feature " + std::to_string(feature),
                     .remedy = "write results of a Locator on the same mesh"});
    }
    return Done{};
}

Status MapWriterData::write(const TableView& rows) {
    if (!error.what.empty()) return error;
    if (done)
        return fail({.what = "rows after the end of a map", .file = name, .remedy = "write them before commit()"});
    if (Status fits = check(rows); !fits) return fits;
    const auto dimension = static_cast<std::size_t>(head.dimension);
    for (std::size_t row = 0; row < rows.row_count();) {
        const std::size_t step = std::min(rows.row_count() - row, map_block_rows - pending.row_count());
        const auto coordinates = rows.points.subspan(row * dimension, step * dimension);
        pending.points.insert(pending.points.end(), coordinates.begin(), coordinates.end());
        for (std::size_t i = row; i < row + step; ++i) {
            pending.cells.push_back(rows.cells[i]);
            pending.features.push_back(rows.features[i]);
        }
        row += step;
        if (pending.cells.size() == map_block_rows) put_block();
    }
    if (Status written = file.status(); !written) return fail(written.error());
    return Done{};
}

void MapWriterData::put_block() {
    const std::size_t rows = pending.cells.size();
    const std::size_t size = map_block_size(head.dimension, rows);
    bytes.assign(size + map_checksum_size, '\0');
    char* at = bytes.data();
    for (const double x : pending.points) {
        put_little(at, std::bit_cast<std::uint64_t>(x));
        at += 8;
    }
    for (const Mesh::Index cell : pending.cells) {
        put_little(at, static_cast<std::uint32_t>(cell));
        at += 4;
    }
    for (const Feature feature : pending.features) *at++ = static_cast<char>(feature);
    checksum = map_checksum({bytes.data(), size}, checksum);
    put_little(bytes.data() + size, checksum);
    file.write({bytes.data(), bytes.size()});
    head.rows += rows;
    pending.points.clear();
    pending.cells.clear();
    pending.features.clear();
}

Status MapWriterData::commit() {
    if (!error.what.empty()) return error;
    if (done) return Done{};
    if (!pending.cells.empty()) put_block();
    const std::array<char, map_header_size> header = header_bytes(head);
    file.replace(0, {header.data(), header.size()});
    if (Status committed = file.commit(); !committed) return fail(committed.error());
    done = true;
    return Done{};
}

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
    return data_->write(rows);
}

Status MapWriter::commit() {
    return data_->commit();
}

MapWriter::MapWriter(std::unique_ptr<sample::MapWriterData> data) : data_(std::move(data)) {}
MapWriter::MapWriter(MapWriter&&) noexcept = default;
MapWriter& MapWriter::operator=(MapWriter&&) noexcept = default;
MapWriter::~MapWriter() = default;

}  // namespace barycert
