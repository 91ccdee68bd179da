// .node and .ele files.
#include <array>
#include <string_view>

#include "barycert/base/large_pages.hpp"
#include "barycert/io/tetgen/integer_row.hpp"
#include "barycert/io/tetgen/tetgen_reader.hpp"

namespace barycert::io {
namespace {

std::vector<double*> make_attributes(std::vector<Field>& fields, std::size_t count, std::size_t rows) {
    std::vector<double*> columns;
    if (rows == 0) return columns;  // a count that no row bears out may be anything
    fields.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        fields[i].name = "attribute" + std::to_string(i);
        base::resize_large(fields[i].data, rows);
        columns.push_back(fields[i].data.data());
    }
    return columns;
}

Error cannot_mean(const TextTable& table, const std::string& what, std::string expected, std::int64_t found,
                  std::string remedy) {
    return header_error(table, what + " in the header", std::move(expected), std::to_string(found), std::move(remedy));
}

/// The fast path of a linear cell without attributes. False: the scanner has not moved, and nothing is known.
template <std::size_t Corners>
bool scan_plain_cell(Scanner& scanner, std::size_t row, int base, std::int64_t count, Mesh::Index* cells) {
    std::array<std::uint32_t, Corners + 1> values{};
    const char* const after = scan_plain_row(scanner.at, values);
    if (after == nullptr || values[0] != row + static_cast<std::size_t>(base)) return false;
    bool good = true;
    for (std::size_t i = 0; i < Corners; ++i) {
        const std::uint32_t index = values[i + 1] - static_cast<std::uint32_t>(base);
        good = good && index < static_cast<std::uint64_t>(count);
        cells[row * Corners + i] = static_cast<Mesh::Index>(index);
    }
    if (good) scanner.at = after;
    return good;
}

}  // namespace

Status TetgenReader::prepare_nodes() {
    constexpr std::array names{"nodes", "dimensions", "attributes", "markers"};
    Result<TextTable> opened = open_table(stem_ + ".node", names, options_.threads);
    if (!opened) return opened.error();
    TextTable& table = nodes_ = std::move(*opened);

    const std::int64_t dimension = header_field(table, 1, 3);
    const std::int64_t attributes = header_field(table, 2, 0);
    const std::int64_t markers = header_field(table, 3, 0);
    if (dimension != 2 && dimension != 3) {
        return cannot_mean(table, "bad dimension", "2 or 3", dimension,
                           "the header is: nodes, dimension, attributes, markers");
    }
    if (markers > 1) {
        return cannot_mean(table, "bad number of markers", "0 or 1", markers, "declare further columns as attributes");
    }
    table.columns = {{ColumnKind::id, 1, "id"},
                     {ColumnKind::real, static_cast<std::size_t>(dimension), "coordinate"},
                     {ColumnKind::real, static_cast<std::size_t>(attributes), "attribute"},
                     {ColumnKind::integer, static_cast<std::size_t>(markers), "marker"}};
    const std::int64_t count = table.header[0];
    const std::string more = header_text({count, dimension, attributes + 1, markers});
    table.surplus_remedy = markers == 0
                               ? "if the last column is a marker, make the header " +
                                     header_text({count, dimension, attributes, 1}) + "; if it is an attribute, " + more
                               : "if there is one attribute more, make the header " + more;
    const std::vector<std::string_view> first = table.first_row();
    std::int64_t id = 0;
    table.base = !first.empty() && scan_integer(first.front().data(), id) != nullptr && id == 1 ? 1 : 0;
    if (Status room = check_room(table); !room) return room;

    mesh_.index_base = table.base;
    mesh_.dimension = static_cast<int>(dimension);
    base::resize_large(mesh_.points, table.rows * static_cast<std::size_t>(dimension));
    point_attributes_ = make_attributes(mesh_.point_fields, static_cast<std::size_t>(attributes), table.rows);
    if (markers != 0) base::resize_large(mesh_.point_markers, table.rows);

    table.parse = parse_block_by([base = static_cast<std::size_t>(table.base),
                                  size = static_cast<std::size_t>(dimension), points = mesh_.points.data(),
                                  fields = point_attributes_.data(), field_count = point_attributes_.size(),
                                  marks = mesh_.point_markers.empty() ? nullptr : mesh_.point_markers.data()](
                                     Scanner& scanner, std::size_t row) {
        if (!scan_id(scanner, row + base)) return false;
        for (std::size_t axis = 0; axis < size; ++axis) {
            if (!scanner.separator() || !scanner.real(points[row * size + axis])) return false;
        }
        if (!scan_fields(scanner, fields, field_count, row)) return false;
        if (marks != nullptr && (!scanner.separator() || !scanner.integer(marks[row]))) return false;
        return scanner.end_row();
    });
    return Done{};
}

template <int Corners>
void TetgenReader::set_cell_parser() {
    constexpr std::size_t first_order = Corners == 3 || Corners == 6 ? 3 : 4;
    constexpr std::size_t mids = static_cast<std::size_t>(Corners) - first_order;
    cells_.parse = parse_block_by([base = cells_.base, count = limit_of(nodes_), cells = mesh_.cells.data(),
                                   mid_nodes = mesh_.mid_nodes.data(), fields = cell_attributes_.data(),
                                   field_count = cell_attributes_.size()](Scanner& scanner, std::size_t row) {
        if (mids == 0 && field_count == 0 && scan_plain_cell<first_order>(scanner, row, base, count, cells)) {
            return true;
        }
        if (!scan_id(scanner, row + static_cast<std::size_t>(base))) return false;
        if (!scan_indices<first_order>(scanner, base, count, cells + row * first_order)) return false;
        if (mids != 0 && !scan_indices<mids>(scanner, base, count, mid_nodes + row * mids)) return false;
        return scan_fields(scanner, fields, field_count, row) && scanner.end_row();
    });
}

Status TetgenReader::prepare_cells() {
    constexpr std::array names{"cells", "corners", "attributes"};
    if (!exists(".ele")) {
        return Error{.what = "there are nodes but no cells",
                     .file = stem_ + ".ele",
                     .line = 0,
                     .expected = "an .ele file beside " + nodes_.file,
                     .found = "no such file",
                     .remedy = "mesh the nodes first, or put the .ele file there"};
    }
    Result<TextTable> opened = open_table(stem_ + ".ele", names, options_.threads);
    if (!opened) return opened.error();
    TextTable& table = cells_ = std::move(*opened);

    const bool flat = mesh_.dimension == 2;
    const std::int64_t corners = header_field(table, 1, flat ? 3 : 4);
    const std::int64_t attributes = header_field(table, 2, 0);
    if (flat ? corners != 3 && corners != 6 : corners != 4 && corners != 10) {
        return cannot_mean(
            table, "bad number of corners",
            flat ? "3 or 6, for the .node file has 2 dimensions" : "4 or 10, for the .node file has 3 dimensions",
            corners, "check that the files belong together and hold triangles (2D) or tetrahedra (3D)");
    }
    table.base = mesh_.index_base;
    table.base_is_given = true;
    table.columns = {{ColumnKind::id, 1, "id"},
                     {ColumnKind::index, static_cast<std::size_t>(corners), "corner", limit_of(nodes_), "nodes"},
                     {ColumnKind::real, static_cast<std::size_t>(attributes), "attribute"}};
    table.surplus_remedy =
        "if there is one attribute more, make the header " + header_text({table.header[0], corners, attributes + 1});
    if (Status room = check_room(table); !room) return room;

    base::resize_large(mesh_.cells, table.rows * mesh_.corners());
    base::resize_large(mesh_.mid_nodes, table.rows * (static_cast<std::size_t>(corners) - mesh_.corners()));
    cell_attributes_ = make_attributes(mesh_.cell_fields, static_cast<std::size_t>(attributes), table.rows);
    switch (corners) {
        case 3:
            set_cell_parser<3>();
            break;
        case 4:
            set_cell_parser<4>();
            break;
        case 6:
            set_cell_parser<6>();
            break;
        default:
            set_cell_parser<10>();
    }
    return Done{};
}

}  // namespace barycert::io
