/// The steps of read_tetgen. The grammar stands in tetgen_reader.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "barycert/io.hpp"
#include "barycert/io/tetgen/row_errors.hpp"
#include "barycert/io/tetgen/text_table.hpp"
#include "barycert/mesh.hpp"

namespace barycert::io {

/// An index of 0 to limit - 1 after the base is taken off.
inline bool scan_index(Scanner& scanner, std::int64_t base, std::int64_t limit, Mesh::Index& index) {
    std::int64_t value = 0;
    if (!scanner.integer(value)) return false;
    value -= base;
    index = static_cast<Mesh::Index>(value);
    return static_cast<std::uint64_t>(value) < static_cast<std::uint64_t>(limit);
}

inline bool scan_id(Scanner& scanner, std::size_t expected) {
    std::int64_t value = 0;
    return scanner.integer(value) && value == static_cast<std::int64_t>(expected);
}

inline bool scan_fields(Scanner& scanner, double* const* fields, std::size_t count, std::size_t row) {
    for (std::size_t i = 0; i < count; ++i) {
        if (!scanner.separator() || !scanner.real(fields[i][row])) return false;
    }
    return true;
}

/// A cell across a facet, or -1.
inline bool scan_neighbour(Scanner& scanner, std::int64_t base, std::int64_t limit, Mesh::Index& index) {
    std::int64_t value = 0;
    if (!scanner.integer(value)) return false;
    index = static_cast<Mesh::Index>(value == -1 ? -1 : value - base);
    return value == -1 || static_cast<std::uint64_t>(value - base) < static_cast<std::uint64_t>(limit);
}

template <int Count>
bool scan_indices(Scanner& scanner, std::int64_t base, std::int64_t limit, Mesh::Index* indices) {
    for (int i = 0; i < Count; ++i) {
        if (!scanner.separator() || !scan_index(scanner, base, limit, indices[i])) return false;
    }
    return true;
}

/// The header's field i, or what stands for it if the header is shorter.
inline std::int64_t header_field(const TextTable& table, std::size_t i, std::int64_t otherwise) {
    return i < table.header.size() ? table.header[i] : otherwise;
}

/// The numbers of a header, in quotes.
std::string header_text(std::initializer_list<std::int64_t> numbers);

inline std::int64_t limit_of(const TextTable& table) {
    return static_cast<std::int64_t>(table.rows);
}

/// One read, step by step.
class TetgenReader {
public:
    TetgenReader(std::string stem, const ReadOptions& options) : stem_(std::move(stem)), options_(options) {}

    Result<Mesh> read();

private:
    bool exists(const char* suffix) const;

    // Each reads a header, takes the memory and sets the parser of the rows.
    Status prepare_nodes();
    Status prepare_cells();
    Status prepare_faces();
    Status prepare_neighbours();
    template <int Corners>
    void set_cell_parser();
    template <int Corners>
    void set_face_parser(bool markers, bool adjacent);
    Status settle_mid_edge_order();

    std::string stem_;
    ReadOptions options_;
    Mesh mesh_;
    TextTable nodes_, cells_;
    std::unique_ptr<TextTable> faces_, neighbours_;  // where there is such a file
    std::vector<double*> point_attributes_, cell_attributes_;
};

}  // namespace barycert::io
