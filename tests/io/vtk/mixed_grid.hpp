/// A grid of several kinds of cells with arrays of every type, and what read_vtk is to make of it.
#pragma once

#include <vtkCharArray.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkLongArray.h>
#include <vtkLongLongArray.h>
#include <vtkShortArray.h>
#include <vtkSignedCharArray.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedIntArray.h>
#include <vtkUnsignedLongArray.h>
#include <vtkUnsignedShortArray.h>

#include <array>
#include <cmath>

#include "tests/io/vtk/vtk_files.hpp"

namespace barycert::testing {

/// Two tetrahedra with a vertex, a line and triangles among them, and arrays of every type.
inline vtkSmartPointer<vtkUnstructuredGrid> mixed_grid() {
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const auto& [x, y, z] :
         {std::array{0.0, 0.0, 0.0}, {0.1, 0.0, 0.0}, {0.0, 0.1, 0.0}, {0.0, 0.0, 0.1}, {1.0, 1.0, 1.0}}) {
        points->InsertNextPoint(x, y, z);
    }
    grid->SetPoints(points);
    const auto add = [&](int type, std::vector<vtkIdType> nodes) {
        grid->InsertNextCell(type, static_cast<vtkIdType>(nodes.size()), nodes.data());
    };
    add(VTK_VERTEX, {4});
    add(VTK_TETRA, {0, 1, 2, 3});
    add(VTK_TRIANGLE, {0, 1, 2});
    add(VTK_POLY_LINE, {0, 1, 2});
    add(VTK_TETRA, {1, 2, 3, 4});
    add(VTK_QUADRATIC_EDGE, {0, 1, 2});
    vtkPointData* const data = grid->GetPointData();
    data->AddArray(array_of<vtkBitArray>("bit", 1, {1, 0, 0, 1, 1}));
    data->AddArray(array_of<vtkCharArray>("char", 1, {-128, 127, 0, 1, 2}));
    data->AddArray(array_of<vtkSignedCharArray>("signed char", 1, {-128, 127, 0, 1, 2}));
    data->AddArray(array_of<vtkUnsignedCharArray>("unsigned char", 1, {255, 127, 0, 1, 2}));
    data->AddArray(array_of<vtkShortArray>("short", 1, {-32768, 32767, 0, 1, 2}));
    data->AddArray(array_of<vtkUnsignedShortArray>("unsigned short", 1, {65535, 32767, 0, 1, 2}));
    data->AddArray(array_of<vtkIntArray>("int", 2, {-2147483648.0, 2147483647, 0, 1, 2, 3, 4, 5, 6, 7}));
    data->AddArray(array_of<vtkUnsignedIntArray>("unsigned int", 1, {4294967295.0, 1, 2, 3, 4}));
    data->AddArray(array_of<vtkLongArray>("long", 1, {-0x1p62, 0x1p53, 3, 4, 5}));
    data->AddArray(array_of<vtkLongLongArray>("long long", 1, {-0x1p62, 0x1p53, 3, 4, 5}));
    data->AddArray(array_of<vtkUnsignedLongArray>("unsigned long", 1, {0x1p63, 0x1p53, 3, 4, 5}));
    data->AddArray(array_of<vtkIdTypeArray>("id", 1, {0, 1, 2, 3, 4}));
    data->AddArray(array_of<vtkFloatArray>("float", 3, {0.1, 0.2, 0.3, 1e-45, 3e38, -0.5, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
    data->AddArray(array_of<vtkDoubleArray>("double", 1, {0.1, 5e-324, 1e308, -0.0, 3}));
    vtkNew<vtkStringArray> words;
    words->SetName("words");
    for (const char* word : {"a b", "", "c\nd", "ä", "e"}) words->InsertNextValue(word);
    data->AddArray(words);
    grid->GetCellData()->AddArray(array_of<vtkIntArray>("cell", 2, {0, 0, 1, 10, 2, 20, 3, 30, 4, 40, 5, 50}));
    vtkNew<vtkDoubleArray> time;
    time->SetName("TimeValue");
    time->InsertNextValue(0.5);
    grid->GetFieldData()->AddArray(time);
    return grid;
}

/// `digits`: how far a number of the array of doubles may be off, as a share of it.
inline void expect_mixed(const std::string& path, double digits, bool narrow = false) {
    const Result<Mesh> read = read_quietly(path);
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(read->dimension, 3);
    EXPECT_EQ(read->cells, (std::vector<Mesh::Index>{0, 1, 2, 3, 1, 2, 3, 4}));
    EXPECT_EQ(read->cell_numbers, (std::vector<Mesh::Index>{1, 4}));
    EXPECT_EQ(notes_of(*read),
              (std::vector<std::string>{
                  "4 cells that are no tetrahedra: 1 vtkVertex, 1 vtkPolyLine, 1 vtkTriangle, 1 vtkQuadraticEdge",
                  "point array \"words\": it holds text, which points of a mesh cannot carry"}));
    EXPECT_TRUE(read->notes[0].important);
    EXPECT_EQ(read->notes[0].file, path);
    ASSERT_EQ(read->cell_fields.size(), 1U);
    EXPECT_EQ(read->cell_fields[0].name, "cell");
    EXPECT_EQ(read->cell_fields[0].data, (std::vector<double>{1, 10, 4, 40}));
    std::vector<std::string> converted{"float32 to double: point array \"float\""};
    if (narrow) converted.emplace_back("float32 to double: the coordinates");
    EXPECT_EQ(notes_of(*read, Note::Kind::converted), converted);
    EXPECT_EQ(read->points[3], narrow ? static_cast<double>(0.1F) : 0.1);
    const auto grid = mixed_grid();
    ASSERT_EQ(read->point_fields.size(), 14U);
    for (const Field& field : read->point_fields) {
        SCOPED_TRACE(field.name);
        vtkDataArray* const array = grid->GetPointData()->GetArray(field.name.c_str());
        ASSERT_NE(array, nullptr);
        ASSERT_EQ(field.components, array->GetNumberOfComponents());
        ASSERT_EQ(field.data.size(), 5U * static_cast<std::size_t>(field.components));
        for (std::size_t i = 0; i < field.data.size(); ++i) {
            const double expected =
                array->GetTuple(static_cast<vtkIdType>(i) / field.components)[static_cast<int>(i) % field.components];
            const double near = field.name == "double" ? std::abs(expected) * digits : 0;
            EXPECT_LE(std::abs(field.data[i] - expected), near) << i;
        }
    }
}

}  // namespace barycert::testing
