/// Files of VtiWriter as VTK's own reader sees them.
#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkXMLImageDataReader.h>

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "tests/io/tetgen/mesh_files.hpp"
#include "tests/io/vti/vti_files.hpp"

namespace barycert::testing {
namespace {

void expect_array(vtkImageData* image, const char* name, int type, int components, const Bytes& bytes) {
    SCOPED_TRACE(name);
    vtkDataArray* const array = image->GetPointData()->GetArray(name);
    ASSERT_NE(array, nullptr);
    EXPECT_EQ(array->GetDataType(), type);
    EXPECT_EQ(array->GetNumberOfComponents(), components);
    ASSERT_EQ(static_cast<std::size_t>(array->GetNumberOfValues() * array->GetDataTypeSize()), bytes.size());
    EXPECT_EQ(std::memcmp(array->GetVoidPointer(0), bytes.data(), bytes.size()), 0);
}

void expect_image(const io::VtiGrid& grid) {
    std::size_t points = 1;
    for (const std::int64_t count : grid.counts) points *= static_cast<std::size_t>(count);
    base::Random random(points);
    const std::vector<io::ArrayFormat> arrays{{"vtkValidPointMask", 1, io::NumberType::int8},
                                              {"feature", 1, io::NumberType::uint8},
                                              {"cell", 1, io::NumberType::int32},
                                              {"id", 1, io::NumberType::int64},
                                              {"single", 2, io::NumberType::float32},
                                              {"u <&\"'> Größe\t", 3, io::NumberType::float64},
                                              {"T", 1, io::NumberType::float64}};
    const std::vector<Bytes> data{any_bytes(random, points),     any_bytes(random, points),
                                  any_bytes(random, 4 * points), any_bytes(random, 8 * points),
                                  any_bytes(random, 8 * points), any_bytes(random, 24 * points),
                                  any_bytes(random, 8 * points)};
    const TemporaryFolder folder;
    const Status status = write_in_blocks(folder / "g.vti", grid, arrays, data, 3, true);
    ASSERT_TRUE(status) << status.error().message();
    vtkNew<vtkXMLImageDataReader> reader;
    reader->SetFileName((folder / "g.vti").c_str());
    ASSERT_EQ(reader->CanReadFile((folder / "g.vti").c_str()), 1);
    reader->Update();
    ASSERT_EQ(reader->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
    vtkImageData* const image = reader->GetOutput();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(image->GetDimensions()[axis], grid.counts[axis]);
        EXPECT_EQ(image->GetOrigin()[axis], grid.origin[axis]);
        EXPECT_EQ(image->GetSpacing()[axis], grid.spacing[axis] == 0 ? 1 : grid.spacing[axis]);
    }
    ASSERT_EQ(image->GetPointData()->GetNumberOfArrays(), 7);
    expect_array(image, "vtkValidPointMask", VTK_SIGNED_CHAR, 1, data[0]);
    expect_array(image, "feature", VTK_UNSIGNED_CHAR, 1, data[1]);
    expect_array(image, "cell", VTK_INT, 1, data[2]);
    expect_array(image, "id", image->GetPointData()->GetArray("id")->GetDataType(), 1, data[3]);
    expect_array(image, "single", VTK_FLOAT, 2, data[4]);
    expect_array(image, arrays[5].name.c_str(), VTK_DOUBLE, 3, data[5]);
    expect_array(image, "T", VTK_DOUBLE, 1, data[6]);
}

TEST(Vti, VtkReadsGridsToTheBits) {
    expect_image({{7, 11, 5}, {0.1, -1e300, 1.0 / 3}, {0.1, 2, 1e-10}});
    expect_image({{40, 30, 1}, {-1, -2, 0}, {0.3, 0.7, 0}});
    expect_image({{1, 1, 1}, {5e-324, 1e308, 0.1}, {0, 0, 0}});
    expect_image({{64, 64, 64}, {0, 0, 0}, {1e-3, 1e-3, 1e-3}});
}

}  // namespace
}  // namespace barycert::testing
