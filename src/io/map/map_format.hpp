/// The parts of a map file that its writer and its reader share. See map.hpp.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "barycert/mesh.hpp"
#include "barycert/simplex.hpp"
#include "barycert/table.hpp"
#include "core/base/random.hpp"

namespace barycert::sample {

static_assert(std::endian::native == std::endian::little, "maps are written as numbers stand in memory");

inline constexpr std::string_view map_magic = "\x89\x42\x43\x4D\r\n\x1A\n";
inline constexpr std::uint32_t map_version = 1;
inline constexpr std::size_t map_checksum_size = 8;
inline constexpr std::size_t map_block_rows = 8192;

constexpr std::uint64_t map_step(std::uint64_t h, std::uint64_t word) {
    return base::mix64((h ^ word) + 0x9e3779b97f4a7c15ULL);
}

inline std::uint64_t map_word(const char* at) {
    std::uint64_t word = 0;
    std::memcpy(&word, at, sizeof word);
    return word;
}

/// Requires: the size is a multiple of 8.
inline std::uint64_t map_checksum(std::string_view bytes, std::uint64_t h) {
    for (std::size_t i = 0; i < bytes.size(); i += 8) h = map_step(h, map_word(bytes.data() + i));
    return h;
}

/// As it stands in the file.
struct MapHeader {
    std::array<char, 8> magic{};  ///< none in a file without its end, which must not pass for a map
    std::uint32_t version = map_version;
    std::uint8_t dimension = 3, all = 0;
    std::uint16_t taken = 0;  ///< how cells are: 1, multilinear; 2, curved; 4, with every node as it is
    std::uint64_t rows = 0, nodes = 0, cells = 0, fingerprint = 0;
    std::uint64_t checksum = 0;  ///< of what is before

    std::string_view bytes() const { return {reinterpret_cast<const char*>(this), sizeof *this}; }
    std::uint64_t right_checksum() const { return map_checksum(bytes().substr(0, sizeof *this - sizeof checksum), 0); }
};
inline constexpr std::size_t map_header_size = sizeof(MapHeader);
static_assert(map_header_size == 56);

/// Bytes of a block of so many rows, without its checksum: a multiple of 8.
constexpr std::size_t map_block_size(int dimension, std::size_t rows) {
    return (rows * (8 * static_cast<std::size_t>(dimension) + 5) + 7) / 8 * 8;
}

inline void clear_map_rows(Table& rows) {
    rows.points.clear();
    rows.cells.clear();
    rows.features.clear();
}

/// Appends rows [first, last) of `from`: what a map has of them.
inline void append_map_rows(const TableView& from, int dimension, std::size_t first, std::size_t last, Table& to) {
    const auto append = [&](auto numbers, std::size_t width, auto& out) {
        const auto some = numbers.subspan(width * first, width * (last - first));
        out.insert(out.end(), some.begin(), some.end());
    };
    append(from.points, static_cast<std::size_t>(dimension), to.points);
    append(from.cells, 1, to.cells);
    append(from.features, 1, to.features);
}

/// Says what a row that no map can hold should have had; nullptr if a map can hold it. One text for writer and reader.
inline const char* map_row_fault(const double* point, int dimension, Mesh::Index cell, unsigned feature,
                                 std::uint64_t cell_count) {
    for (int axis = 0; axis < dimension; ++axis) {
        if (cell != -1 && !std::isfinite(point[axis])) return "finite coordinates where there is a cell";
    }
    if (cell < -1 || (cell >= 0 && static_cast<std::uint64_t>(cell) >= cell_count))
        return "a cell of the mesh, or -1 for none";
    if (feature > static_cast<unsigned>(Feature::outside)) return "a feature: interior, face, edge, vertex or outside";
    if ((cell == -1) != (feature == static_cast<unsigned>(Feature::outside)))
        return "the feature outside with cell -1, and nowhere else";
    if (dimension == 2 && feature == static_cast<unsigned>(Feature::face))
        return "in two dimensions any feature but a face";
    return nullptr;
}

}  // namespace barycert::sample
