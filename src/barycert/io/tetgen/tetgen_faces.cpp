// .face and .neigh files.
#include <array>
#include <string_view>

#include "barycert/base/large_pages.hpp"
#include "barycert/io/tetgen/tetgen_reader.hpp"

namespace barycert::io {

template <int Corners>
void TetgenReader::set_face_parser(bool markers, bool adjacent) {
    constexpr int mids = Corners - 3;
    faces_->parse =
        parse_block_by([base = mesh_.index_base, nodes = limit_of(nodes_), cells = limit_of(cells_), adjacent,
                        faces = mesh_.faces.data(), mid_nodes = mesh_.face_mid_nodes.data(),
                        marks = markers ? mesh_.face_markers.data() : nullptr](Scanner& scanner, std::size_t row) {
            if (!scan_id(scanner, row + static_cast<std::size_t>(base))) return false;
            if (!scan_indices<3>(scanner, base, nodes, faces + row * 3)) return false;
            if (mids != 0 && !scan_indices<mids>(scanner, base, nodes, mid_nodes + row * mids)) return false;
            if (marks != nullptr && (!scanner.separator() || !scanner.integer(marks[row]))) return false;
            for (int side = 0; adjacent && side < 2; ++side) {  // checked, and told again by the neighbours
                Mesh::Index cell = 0;
                if (!scanner.separator() || !scan_neighbour(scanner, base, cells, cell)) return false;
            }
            return scanner.end_row();
        });
}

Status TetgenReader::prepare_faces() {
    constexpr std::array names{"faces", "markers"};
    Result<TextTable> opened = open_table(stem_ + ".face", names, options_.threads);
    if (!opened) return opened.error();
    faces_ = std::make_unique<TextTable>(std::move(*opened));
    TextTable& table = *faces_;
    if (mesh_.dimension == 2) {
        return header_error(table, "a mesh of triangles has no faces", {}, {},
                            "remove the .face file or do not ask for faces");
    }
    const std::int64_t markers = header_field(table, 1, 0);
    if (markers > 1) {
        return header_error(table, "bad number of markers in the header", "0 or 1", std::to_string(markers), {});
    }
    const auto marker_columns = static_cast<std::size_t>(markers);
    const std::size_t found = table.first_row().size();
    const std::size_t linear = 4 + marker_columns;  // id, corners, marker
    const bool mids = found == linear + 3 || found == linear + 5;
    const bool adjacent = found == linear + 2 || found == linear + 5;
    table.base = mesh_.index_base;
    table.base_is_given = true;
    table.columns = {{ColumnKind::id, 1, "id"},
                     {ColumnKind::index, mids ? 6U : 3U, "corner", limit_of(nodes_), "nodes"},
                     {ColumnKind::integer, marker_columns, "marker"},
                     {ColumnKind::neighbour, adjacent ? 2U : 0U, "cell", limit_of(cells_), "cells"}};
    table.surplus_remedy = markers == 0
                               ? "if the last column is a marker, make the header " + header_text({table.header[0], 1})
                               : "let all rows have as many columns as the first";
    if (Status room = check_room(table); !room) return room;

    base::resize_large(mesh_.faces, table.rows * 3);
    if (mids) base::resize_large(mesh_.face_mid_nodes, table.rows * 3);
    if (markers != 0) base::resize_large(mesh_.face_markers, table.rows);
    mids ? set_face_parser<6>(markers != 0, adjacent) : set_face_parser<3>(markers != 0, adjacent);
    return Done{};
}

Status TetgenReader::prepare_neighbours() {
    constexpr std::array names{"cells", "neighbours"};
    Result<TextTable> opened = open_table(stem_ + ".neigh", names, options_.threads);
    if (!opened) return opened.error();
    neighbours_ = std::make_unique<TextTable>(std::move(*opened));
    TextTable& table = *neighbours_;
    const std::size_t sides = mesh_.corners();
    const char* const remedy = "check that the files belong together, or remove the .neigh file";
    if (table.rows != cells_.rows) {
        return header_error(table, "the number of cells differs from that of the .ele file",
                            std::to_string(cells_.rows), std::to_string(table.rows), remedy);
    }
    const std::int64_t declared = header_field(table, 1, static_cast<std::int64_t>(sides));
    if (declared != static_cast<std::int64_t>(sides)) {
        return header_error(table, "bad number of neighbours in the header", std::to_string(sides),
                            std::to_string(declared), remedy);
    }
    table.base = mesh_.index_base;
    table.base_is_given = true;
    table.columns = {{ColumnKind::id, 1, "id"}, {ColumnKind::neighbour, sides, "neighbour", limit_of(cells_), "cells"}};
    table.surplus_remedy = "let each row have an id and " + std::to_string(sides) + " neighbours";
    if (Status room = check_room(table); !room) return room;

    base::resize_large(mesh_.neighbours, table.rows * sides);
    table.parse = parse_block_by([base = mesh_.index_base, sides, count = limit_of(table),
                                  neighbours = mesh_.neighbours.data()](Scanner& scanner, std::size_t row) {
        if (!scan_id(scanner, row + static_cast<std::size_t>(base))) return false;
        for (std::size_t side = 0; side < sides; ++side) {
            if (!scanner.separator()) return false;
            if (!scan_neighbour(scanner, base, count, neighbours[row * sides + side])) return false;
        }
        return scanner.end_row();
    });
    return Done{};
}

}  // namespace barycert::io
