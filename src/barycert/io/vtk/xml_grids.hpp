/// The points of grids in XML files: image data, rectilinear and structured grids.
#pragma once

#include <string>
#include <string_view>

#include "barycert/io/vtk/raw_grid.hpp"
#include "barycert/io/vtk/xml_arrays.hpp"

namespace barycert::io {

/// Whether a data set of that type is one of these grids.
bool is_structured(std::string_view type);

/// The points of the only piece, x running fastest. Those of image data are origin + spacing * index, rounded twice, as
/// VTK has them. Error: an extent that is none, or not that of the whole; more points than a mesh can have, or than
/// the file has numbers for; image data that are turned (a Direction).
Status read_grid_points(const XmlTree& tree, const XmlArrays& arrays, const XmlElement& data, const XmlElement& piece,
                        const std::string& type, RawGrid& grid);

}  // namespace barycert::io
