/// Small good files of a tetrahedron with a field "f", to be changed.
#pragma once

#include <string>

namespace barycert::testing {

inline const std::string xml =
    "<VTKFile type='UnstructuredGrid' byte_order='LittleEndian'>\n<UnstructuredGrid>\n"
    "<Piece NumberOfPoints='4' NumberOfCells='1'>\n<PointData>\n"
    "<DataArray type='Float32' Name='f' format='ascii'>1 2 3 4</DataArray>\n</PointData>\n<Points>\n"
    "<DataArray type='Float64' NumberOfComponents='3'>0 0 0 1 0 0 0 1 0 0 0 0.5</DataArray>\n</Points>\n<Cells>\n"
    "<DataArray type='Int64' Name='connectivity'>0 1 2 3</DataArray>\n"
    "<DataArray type='Int64' Name='offsets'>4</DataArray>\n<DataArray type='UInt8' Name='types'>10</DataArray>\n"
    "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";

inline const std::string legacy =
    "# vtk DataFile Version 4.2\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0 1 0 0 0 1 0 0 0 0.5\n"
    "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\nPOINT_DATA 4\nFIELD FieldData 1\nf 1 4 float\n1 2 3 4\n";

}  // namespace barycert::testing
