/// Inputs to begin with that are written by hand.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace barycert::fuzz {

struct SeedText {
    const char* target;
    const char* name;
    std::string text;
};

inline const std::vector<SeedText> collection_texts{
    {"vtk_collection", "pvtu",
     R"(<VTKFile type="PUnstructuredGrid" version="0.1"><PUnstructuredGrid GhostLevel="0">
<Piece Source="p0.vtu"/><Piece Source="p1.vtu"/></PUnstructuredGrid></VTKFile>)"},
    {"vtk_collection", "vtm",
     R"(<VTKFile type="vtkMultiBlockDataSet" version="1.0"><vtkMultiBlockDataSet><Block index="0" name="b">
<DataSet index="0" name="a" file="p0.vtu"/></Block><DataSet index="1" file="p1.vtu"/></vtkMultiBlockDataSet></VTKFile>)"},
    {"vtk_collection", "vtpd",
     R"(<VTKFile type="vtkPartitionedDataSet"><vtkPartitionedDataSet><DataSet file="p1.vtu"/></vtkPartitionedDataSet></VTKFile>)"},
    {"vtk_collection", "pvd",
     R"(<VTKFile type="Collection"><Collection><DataSet timestep="0" part="0" file="p0.vtu"/>
<DataSet timestep="0" part="1" file="p1.vtu"/><DataSet timestep="1.5" file="in.pvtu"/></Collection></VTKFile>)"},
    {"vtk_collection", "series",
     R"({"file-series-version": "1.0", "files": [{"name": "p0.vtu", "time": 0}, {"name": "p1.vtu", "time": 1e3}]})"},
    {"vtk_collection", "itself",
     R"(<VTKFile type="PUnstructuredGrid"><PUnstructuredGrid><Piece Source="in.pvtu"/></PUnstructuredGrid></VTKFile>)"},
};

inline const std::vector<SeedText> seed_texts{
    {"csv", "plain", "\1x,y\n0.1,2\n3,-4e-300\n"},
    {"csv", "quoted", std::string("\0", 1) + "a;\"x\";y;z\r\n# comment\r\n\"t;u\"\"v\";1;2;3\r\n;4;5;6\r\n"},
    {"csv", "blanks",
     "\12"
     "1 2 3\n\n 4\t5  6 \n"},
    {"csv", "paraview", std::string("\0", 1) + "\"T\",\"Points:0\",\"Points:1\",\"Points:2\"\n1,0.5,0.25,0.125\n"},
    {"csv", "typed", "\6x,y,z,n,t\n1,2,3,4,five\n1,2,3,-9223372036854775808,nan\n"},
    {"fields", "rows", std::string("\0", 1) + "# T\n1, 2;3\t4\nnan inf -inf 0x1p3\n"},
    {"fields", "column", "\4n,T\n1,0.5\n2,1e3\n"},
    {"npy", "c_order",
     std::string("\0", 1) + std::string("\x93NUMPY\x01\x00\x46\x00", 10) +
         "{'descr': '<f8', 'fortran_order': False, 'shape': (1, 3), }         \n" + std::string(24, '\0')},
    {"npy", "fortran",
     "\1" + std::string("\x93NUMPY\x02\x00\x46\x00\x00\x00", 12) +
         "{'descr': '>i2', 'fortran_order': True, 'shape': (2, 2), }          \n" + std::string(8, '\1')},
    {"npy", "structured",
     std::string("\2") + std::string("\x93NUMPY\x01\x00\x66\x00", 10) +
         "{'descr': [('p', '<f4', (3,)), ('s', '|S2'), ('u', '<U1')], "
         "'fortran_order': False, 'shape': (1,), }\n" +
         std::string(18, 'a')},
    {"plc", "poly",
     std::string("\0", 1) + "4 3 1 1\n1 0 0 0 5 1\n2 1 0 0 5 2\n3 0 1 0 5 3\n4 0 0 1 5 4\n2 1\n1 0 7\n3 1 2 3\n"
                            "2 1 8\n4 1 2 3 4\n2 1 3\n1 .1 .2 .3\n1\n1 .5 .5 .5\n1\n1 .1 .1 .1 2 -1\n"},
    {"plc", "poly_apart", std::string("\0", 1) + "0 3 0 0\n1 0\n1\n3 0 1 2\n0\n\f3 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n"},
    {"plc", "smesh",
     "\1"
     "3 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n1 1\n3 0 1 2 9\n0\n0\n"},
    {"plc", "off", "\2OFF\n# c\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n4 0 1 2 3\n"},
    {"plc", "stl_text",
     "\3solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
     "endfacet\nendsolid s\n"},
    {"plc", "stl_binary", "\3" + std::string(80, ' ') + std::string("\1\0\0\0", 4) + std::string(50, '\0')},
    {"plc", "ply",
     "\4ply\nformat ascii 1.0\ncomment c\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
     "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
    {"vtk_points", "image",
     "\2<VTKFile type=\"ImageData\" version=\"0.1\"><ImageData WholeExtent=\"0 1 0 1 0 1\" Origin=\"0 1 2\" "
     "Spacing=\".5 1 2\"><Piece Extent=\"0 1 0 1 0 1\"><PointData><DataArray type=\"Int32\" Name=\"T\" "
     "format=\"ascii\">1 2 3 4 5 6 7 8</DataArray></PointData></Piece></ImageData></VTKFile>"},
    {"vtk_points", "rectilinear",
     "\2<VTKFile type=\"RectilinearGrid\"><RectilinearGrid WholeExtent=\"0 1 0 0 0 1\"><Piece Extent=\"0 1 0 0 0 "
     "1\"><Coordinates>"
     "<DataArray type=\"Float32\" format=\"ascii\">0 1</DataArray><DataArray type=\"Float32\" "
     "format=\"ascii\">0</DataArray>"
     "<DataArray type=\"Float64\" format=\"ascii\">2 3</DataArray></Coordinates></Piece></RectilinearGrid></VTKFile>"},
    {"vtk_points", "structured",
     "\2<VTKFile type=\"StructuredGrid\"><StructuredGrid WholeExtent=\"0 1 0 0 0 0\"><Piece Extent=\"0 1 0 0 0 "
     "0\"><Points>"
     "<DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 2 3</DataArray></Points></Piece>"
     "</StructuredGrid></VTKFile>"},
    {"vtk_points", "legacy_structured",
     "\2# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_GRID\nDIMENSIONS 2 1 1\n"
     "POINTS 2 float\n0 0 0 1 2 3\nPOINT_DATA 2\nSCALARS s int 1\nLOOKUP_TABLE default\n1 2\n"},
    {"vtk_xml", "base64",
     "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
     "byte_order=\"LittleEndian\"><UnstructuredGrid>"
     "<Piece NumberOfPoints=\"3\" NumberOfCells=\"1\"><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" "
     "format=\"binary\">JAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAA==</DataArray></Points><Cells>"
     "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray><DataArray type=\"Int64\" "
     "Name=\"offsets\" format=\"ascii\">3</DataArray><DataArray type=\"UInt8\" Name=\"types\" "
     "format=\"ascii\">5</DataArray>"
     "</Cells><CellData><DataArray type=\"UInt8\" Name=\"vtkGhostType\" "
     "format=\"ascii\">0</DataArray></CellData></Piece>"
     "</UnstructuredGrid></VTKFile>\n"},
    {"vtk_legacy", "old",
     "# vtk DataFile Version 2.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0 0 1 0\n0 0 1\n"
     "CELLS 2 9\n4 0 1 2 3\n3 0 1 2\nCELL_TYPES 2\n10 5\nPOINT_DATA 4\nVECTORS v double\n0 0 1 1 2 3 4 5 6 7 8 9\n"
     "CELL_DATA 2\nFIELD f 2\na 1 2 long\n5 6\nb%20c 2 2 char\n1 2 3 4\n"},
    {"vtk_legacy", "polydata",
     "# vtk DataFile Version 4.2\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 double\n0 0 0 1 0 0 0 1 0\n"
     "VERTICES 1 2\n1 0\nLINES 1 3\n2 0 1\nPOLYGONS 1 4\n3 0 1 2\nMETADATA\nINFORMATION 0\n\n"},
    {"medit", "solid",
     std::string("\0", 1) +
         "MeshVersionFormatted 2\nDimension 3\nVertices\n5\n0 0 0 1\n1 0 0 2\n0 1 0 0\n0 0 1 0\n1 1 1 0\n"
         "Edges 1 1 2 3\nTriangles 1 1 2 3 4\nTetrahedra 2 # two\n1 2 3 4 5\n2 3 4 5 6\nEnd\n"},
    {"medit", "second_order",
     std::string("\0", 1) + "MeshVersionFormatted 1\nDimension\n2\nVertices 6 0 0 0 2 0 0 0 2 0 1 0 0 1 1 0 0 1 0\n"
                            "TrianglesP2 1 1 2 3 4 5 6 9\nSolAtTriangles 1 1 1 .5\n"},
    {"vtk_legacy", "shapes",
     "# vtk DataFile Version 3.0\ns\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 11 double\n0 0 0 1 0 0 1 1 0 0 1 0\n"
     "0 0 1 1 0 1 1 1 1 0 1 1.5\n.5 .5 2 2 0 0 2 0 1\nCELLS 4 27\n8 0 1 2 3 4 5 6 7\n6 1 9 2 5 10 6\n5 4 5 6 7 8\n"
     "4 0 1 3 4\nCELL_TYPES 4\n12 13 14 10\nPOINT_DATA 11\nSCALARS T double\nLOOKUP_TABLE default\n"
     "0 1 2 3 4 5 6 7 8 9 10\nCELL_DATA 4\nSCALARS q double\nLOOKUP_TABLE default\n1 2 3 4\n"},
    {"vtk_legacy", "flat_shapes",
     "# vtk DataFile Version 3.0\ns\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n0 0 0 1 0 0 1 1 0 0 1 0\n"
     "2 0 0 2 1 0 3 0 0 3 2 0\nCELLS 4 19\n4 0 1 2 3\n4 1 4 2 5\n5 4 6 7 5 2\n2 0 1\nCELL_TYPES 4\n9 8 7 3\n"},
    {"vtk_legacy", "strip",
     "# vtk DataFile Version 3.0\ns\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 float\n0 0 0 0 1 0 1 0 0 1 1 0 2 0 0\n"
     "CELLS 1 6\n5 0 1 2 3 4\nCELL_TYPES 1\n6\n"},
    {"vtk_legacy", "image",
     "# vtk DataFile Version 3.0\ni\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 3 2 2\nORIGIN 0 0 -1\n"
     "SPACING .5 1 2\nPOINT_DATA 12\nSCALARS T double\nLOOKUP_TABLE default\n0 1 2 3 4 5 6 7 8 9 10 11\n"},
    {"vtk_legacy", "rectilinear",
     "# vtk DataFile Version 3.0\nr\nASCII\nDATASET RECTILINEAR_GRID\nDIMENSIONS 3 2 1\nX_COORDINATES 3 double\n"
     "0 1 4\nY_COORDINATES 2 float\n-1 1\nZ_COORDINATES 1 double\n0\nCELL_DATA 2\nSCALARS q double\n"
     "LOOKUP_TABLE default\n1 2\n"},
    {"vtk_legacy", "structured",
     "# vtk DataFile Version 3.0\ns\nASCII\nDATASET STRUCTURED_GRID\nDIMENSIONS 2 2 2\nPOINTS 8 double\n0 0 0 1 0 0\n"
     "0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 2\n"},
    {"vtk_xml", "polyhedron",
     R"(<VTKFile type="UnstructuredGrid" version="1.0"><UnstructuredGrid><Piece NumberOfPoints="5" NumberOfCells="1">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 1 1 0 0 1 0 0 0 1</DataArray></Points>
<Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3 4</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">5</DataArray><DataArray type="UInt8" Name="types" format="ascii">42
</DataArray><DataArray type="Int64" Name="faces" format="ascii">5 4 0 1 2 3 3 0 1 4 3 1 2 4 3 2 3 4 3 3 0 4</DataArray>
<DataArray type="Int64" Name="faceoffsets" format="ascii">22</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>)"},
    {"vtk_xml", "lagrange",
     R"(<VTKFile type="UnstructuredGrid" version="1.0"><UnstructuredGrid><Piece NumberOfPoints="10" NumberOfCells="1">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 3 0 0 0 3 0 1 0 0 2 -.5 0 2 1 0 1 2 0 0 2 0
0 1 0 1 1 0</DataArray></Points><Cells><DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3 4 5 6 7 8 9
</DataArray><DataArray type="Int64" Name="offsets" format="ascii">10</DataArray><DataArray type="UInt8" Name="types"
format="ascii">69</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>)"},
    {"vtk_xml", "vti",
     R"(<VTKFile type="ImageData" version="1.0"><ImageData WholeExtent="0 2 0 1 1 2" Origin="0 0 0" Spacing="1 .5 2">
<Piece Extent="0 2 0 1 1 2"><PointData><DataArray type="Float64" Name="T" format="ascii">0 1 2 3 4 5 6 7 8 9 10 11
</DataArray></PointData></Piece></ImageData></VTKFile>)"},
    {"vtk_xml", "vtr",
     R"(<VTKFile type="RectilinearGrid" version="1.0"><RectilinearGrid WholeExtent="0 2 0 1 0 0"><Piece Extent="0 2 0 1 0 0">
<CellData><DataArray type="Int32" Name="q" format="ascii">5 6</DataArray></CellData><Coordinates>
<DataArray type="Float64" Name="x" format="ascii">0 1 3</DataArray><DataArray type="Float64" Name="y" format="ascii">0 2
</DataArray><DataArray type="Float64" Name="z" format="ascii">0</DataArray></Coordinates></Piece></RectilinearGrid></VTKFile>)"},
    {"vtk_xml", "vts",
     R"(<VTKFile type="StructuredGrid" version="1.0"><StructuredGrid WholeExtent="0 1 0 1 0 1"><Piece Extent="0 1 0 1 0 1">
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 2
</DataArray></Points></Piece></StructuredGrid></VTKFile>)"},
    {"gmsh", "shapes",
     "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n11\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n"
     "8 0 1 1.5\n9 .5 .5 2\n10 2 0 0\n11 2 0 1\n$EndNodes\n$Elements\n3\n1 5 2 0 1 1 2 3 4 5 6 7 8\n"
     "2 6 2 0 1 2 10 3 6 11 7\n3 7 2 0 1 5 6 7 8 9\n$EndElements\n"},
    {"gmsh", "third_order",
     "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 10 1 10\n2 1 0 10\n1\n2\n3\n4\n5\n6\n7\n8\n9\n10\n0 0 0\n3 0 0\n"
     "0 3 0\n1 0 0\n2 -.5 0\n2 1 0\n1 2 0\n0 2 0\n0 1 0\n1 1 0\n$EndNodes\n$Elements\n1 1 1 1\n2 1 21 1\n"
     "1 1 2 3 4 5 6 7 8 9 10\n$EndElements\n"},
    {"medit", "shapes",
     std::string("\0", 1) +
         "MeshVersionFormatted 2\nDimension 3\nVertices\n11\n0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\n0 0 1 0\n1 0 1 0\n"
         "1 1 1 0\n0 1 1.5 0\n.5 .5 2 0\n2 0 0 0\n2 0 1 0\nHexahedra 1\n1 2 3 4 5 6 7 8 1\nPrisms 1\n2 10 3 6 11 7 2\n"
         "Pyramids 1\n5 6 7 8 9 3\nTetrahedra 1\n1 2 4 5 4\nEnd\n"},
    {"medit", "fields",
     "\1MeshVersionFormatted 2\nDimension 3\nSolAtVertices 2\n3 1 2 3\n1 2 3 4 5 6 7 8 9 nan\n1 2 3 4 5 6 7 8 9 "
     "-inf\nEnd\n"},
    {"mesh_file", "abaqus", "\3*HEADING\n*NODE\n1, 0, 0, 0\n*ELEMENT, TYPE=C3D4\n"},
    {"mesh_file", "nothing", std::string("\0", 1)},
    {"expressions", "all", "T\n|v|\ngrad(T)\nv.x\ngrad(v.1)\nmean(q)\n|grad(mean(cell:q))|\npoint:T\n"},
    {"rules", "audit", "worst_weight_ulp>1.5"},
    {"rules", "verify", "missed>3"},
    {"scenes", "small",
     R"({"size": [8, 6], "background": [0, 0, 0], "positions": [[-0.8, -0.7, 0.3], [0.8, -0.5, 0.3], [0, 0.8, -0.6]],
"colours": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "triangles": [[0, 1, 2]], "rounding": "correct"})"},
    {"meshes", "box", std::string("\2\0\1\0\3\4\1\1\2\2\3\0\2\3\1\1", 16)},
    {"meshes", "flat", std::string("\3\0\1\2\3\4\1\1\2\2\3\0\2\3\1\1", 16)},
    {"meshes", "soup", std::string("\0\0\5\2\1\2\3\0\1\2\3\0\2\3\1\1\0\1\2\3\1\2\3\4\0\4\0\1\2\1\0\2\3\1", 34)},
    {"nearest", "box", std::string("\2\0\1\0\3\4\1\1\2\2\3\0\2\3\1\1", 16)},
    {"weights", "tetrahedron", std::string("\3\0\1\0\0\0\0\1\0\0\0\1\0\0\0\1\1\1\1\1\2\3", 22)},
};

}  // namespace barycert::fuzz
