#include "io/vtk/out_grid.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "barycert/mesh.hpp"
#include "barycert/result.hpp"
#include "barycert/table.hpp"
#include "core/vtk_cell.hpp"
#include "io/vtk/out_file.hpp"

namespace barycert::io {

std::vector<std::int64_t> face_streams(const Mesh::Shapes& shapes, std::vector<std::int64_t>& ends) {
    std::vector<std::int64_t> stream;
    std::int64_t face = 0, node = 0;
    for (std::size_t cell = 0; cell < shapes.count(); ++cell) {
        if (shapes.types[cell] == vtk_polyhedron) {
            stream.push_back(shapes.face_ends[cell] - face);
            for (; face < shapes.face_ends[cell]; ++face) {
                const std::int64_t end = shapes.ring_ends[static_cast<std::size_t>(face)];
                stream.push_back(end - node);
                for (; node < end; ++node) stream.push_back(shapes.rings[static_cast<std::size_t>(node)]);
            }
        }
        ends.push_back(shapes.types[cell] == vtk_polyhedron ? static_cast<std::int64_t>(stream.size()) : -1);
    }
    return stream;
}

Status write_grid(OutGrid grid, const std::string& path, VtkData data) {
    const auto end = [&](std::size_t i) { return grid.end(i); };
    const auto type = [&](std::size_t i) { return grid.type_of(i); };
    const bool wide = grid.connectivity.count > std::numeric_limits<std::int32_t>::max();
    std::vector<std::int64_t> stream, ends;
    std::vector<OutArray> cells{std::move(grid.connectivity),
                                wide ? array_made<std::int64_t>("offsets", grid.cells, end)
                                     : array_made<std::int32_t>("offsets", grid.cells, end),
                                array_made<std::uint8_t>("types", grid.cells, type)};
    if (grid.shapes != nullptr && !grid.shapes->face_ends.empty()) {
        stream = face_streams(*grid.shapes, ends);
        cells.push_back(array_in_memory<std::int64_t>("faces", stream));
        cells.push_back(array_in_memory<std::int64_t>("faceoffsets", ends));
    }
    return write_xml({.data_set = "UnstructuredGrid",
                      .piece = " NumberOfPoints=\"" + std::to_string(grid.points.count / 3) + "\" NumberOfCells=\"" +
                               std::to_string(grid.cells) + "\"",
                      .sections = {{"PointData", std::move(grid.point_arrays)},
                                   {"CellData", std::move(grid.cell_arrays)},
                                   {"Points", {std::move(grid.points)}},
                                   {"Cells", std::move(cells)}}},
                     path, data);
}

std::string with_ends(const std::vector<std::string>& texts) {
    std::string all;
    for (const std::string& text : texts) all.append(text).push_back('\0');
    return all;
}

}  // namespace barycert::io
