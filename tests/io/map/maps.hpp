/// Maps for tests, and a second writer of the format, made from its description in map.hpp alone.
#pragma once

#include <bit>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "barycert/map.hpp"
#include "core/base/random.hpp"
#include "tests/io/tetgen/mesh_files.hpp"
#include "tests/io/tetgen/random_mesh.hpp"

namespace barycert::testing {

inline constexpr std::size_t block_rows = 8192;

inline Table any_rows(base::Random& random, int dimension, std::size_t cells, std::size_t count) {
    Table rows;
    for (std::size_t i = 0; i < count; ++i) {
        for (int axis = 0; axis < dimension; ++axis) rows.points.push_back(any_double(random));
        const bool outside = cells == 0 || random.below(4) == 0;
        rows.cells.push_back(outside ? -1 : static_cast<Mesh::Index>(random.below(cells)));
        Feature feature = outside ? Feature::outside : static_cast<Feature>(random.below(4));
        if (dimension == 2 && feature == Feature::face) feature = Feature::edge;
        rows.features.push_back(feature);
    }
    return rows;
}

inline void append(Table& to, const Table& more) {
    to.points.insert(to.points.end(), more.points.begin(), more.points.end());
    to.cells.insert(to.cells.end(), more.cells.begin(), more.cells.end());
    to.features.insert(to.features.end(), more.features.begin(), more.features.end());
}

inline bool same(const Table& a, const Table& b) {
    const auto bits = [](const std::vector<double>& values) {
        std::vector<std::uint64_t> words;
        for (const double x : values) words.push_back(std::bit_cast<std::uint64_t>(x));
        return words;
    };
    return bits(a.points) == bits(b.points) && a.cells == b.cells && a.features == b.features;
}

inline Status write_map(const std::string& path, const Mesh& mesh, bool all, const Table& rows) {
    Result<MapWriter> writer = MapWriter::open(path, mesh, all);
    if (!writer) return writer.error();
    if (Status written = writer->write(rows.view()); !written) return written;
    return writer->commit();
}

/// All rows of a map, `most` at a time.
inline Result<Table> read_map(const std::string& path, const Mesh& mesh, std::size_t max = 1000) {
    Result<MapReader> reader = MapReader::open(path, mesh);
    if (!reader) return reader.error();
    Table whole, block;
    while (true) {
        const Result<std::size_t> count = reader->read(max, block);
        if (!count) return count.error();
        if (*count == 0) return whole;
        append(whole, block);
    }
}

/// The second writer: what a file may hold, right or wrong, with checksums that fit.
struct PlainMap {
    std::string magic =
        "\x89"
        "BCM\r\n\x1A\n";
    std::uint32_t version = 1;
    std::uint8_t dimension = 3, all = 0;
    std::uint16_t taken = 0;
    std::uint64_t row_count = 0, nodes = 0, cell_count = 0, fingerprint = 0;
    std::vector<double> points;
    std::vector<std::int32_t> cells;
    std::vector<std::uint8_t> features;

    PlainMap(const Mesh& mesh, const Table& rows)
        : dimension(static_cast<std::uint8_t>(mesh.dimension)),
          row_count(rows.cells.size()),
          nodes(mesh.point_count()),
          cell_count(mesh.cell_count()),
          fingerprint(mesh_fingerprint(mesh)),
          points(rows.points),
          cells(rows.cells) {
        for (const Feature f : rows.features) features.push_back(static_cast<std::uint8_t>(f));
    }

    std::string bytes() const {
        static_assert(std::endian::native == std::endian::little);
        std::string text = magic;
        add(text, version);
        add(text, dimension);
        add(text, all);
        add(text, taken);
        add(text, row_count);
        add(text, nodes);
        add(text, cell_count);
        add(text, fingerprint);
        add(text, checksum(text, 0));
        std::uint64_t last = fingerprint;
        for (std::size_t first = 0; first < cells.size(); first += block_rows) {
            const std::size_t end = std::min(first + block_rows, cells.size());
            std::string block;
            for (std::size_t i = first * dimension; i < end * dimension; ++i) add(block, points[i]);
            for (std::size_t i = first; i < end; ++i) add(block, cells[i]);
            for (std::size_t i = first; i < end; ++i) add(block, features[i]);
            while (block.size() % 8 != 0) block += '\0';
            last = checksum(block, last);
            add(block, last);
            text += block;
        }
        return text;
    }

private:
    template <class T>
    static void add(std::string& text, T value) {
        char buffer[sizeof(T)];
        std::memcpy(buffer, &value, sizeof(T));
        text.append(buffer, sizeof(T));
    }
    static std::uint64_t checksum(const std::string& text, std::uint64_t h) {
        for (std::size_t i = 0; i < text.size(); i += 8) {
            std::uint64_t word;
            std::memcpy(&word, text.data() + i, 8);
            h = base::mix64((h ^ word) + 0x9e3779b97f4a7c15ULL);
        }
        return h;
    }
};

}  // namespace barycert::testing
