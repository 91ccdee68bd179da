/// The data sets of XML files.
#pragma once

#include <string>
#include <string_view>

#include "barycert/io/vtk/raw_grid.hpp"
#include "barycert/io/vtk/xml_tree.hpp"

namespace barycert::io {

/// The data set of one file: UnstructuredGrid or PolyData; where only points are wanted, ImageData, RectilinearGrid or
/// StructuredGrid as well. `bytes` is all of the file.
Result<RawGrid> read_xml(std::string_view bytes, const XmlTree& tree, const std::string& path, Part part);

/// VTK's numbers of the types of cells in a section of polygon data, by their number of nodes. VTK numbers the cells of
/// all sections in this order, whatever the order in the file.
enum Section : std::size_t { vertices, lines, polygons, strips, section_count };
std::uint8_t type_in(Section section, std::int64_t nodes);

}  // namespace barycert::io
