/// The output of VTK itself, as its writers write it: every verdict of `barycert verify` is that of a judge that asks
/// the oracle cell by cell, and errors that are planted in VTK's arrays are named.
#include <gtest/gtest.h>
#include <vtkCellTreeLocator.h>
#include <vtkCharArray.h>
#include <vtkDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProbeFilter.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_job.hpp"
#include "barycert/check_results.hpp"
#include "barycert/contour_job.hpp"
#include "barycert/defect.hpp"
#include "barycert/figure.hpp"
#include "barycert/fix.hpp"
#include "barycert/gmsh_files.hpp"
#include "barycert/grid.hpp"
#include "barycert/job.hpp"
#include "barycert/measures.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/plc.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/render_job.hpp"
#include "barycert/sample_job.hpp"
#include "barycert/series.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/surface_report.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/verify.hpp"
#include "barycert/verify_job.hpp"
#include "barycert/vtk_files.hpp"
#include "core/base/random.hpp"
#include "tests/io/tetgen/mesh_files.hpp"
#include "tests/mesh/locate/judge.hpp"
#include "tests/mesh/locate/points.hpp"
#include "tests/mesh/sample/points/rows.hpp"

namespace barycert::testing {
namespace {

/// A mesh that VTK reads from a file of ours and probes; its fields: T of nodes, v of nodes with three components, and
/// `cell` of cells, the number of each. VTK's probe gives every point the number of the cell that it took.
class VtkOutput : public ::testing::Test {
protected:
    VtkOutput() : mesh_(read_mesh(BARYCERT_DATA_DIR "/meshes/cube-hole").value()), judge_(mesh_) {
        Field t{"T", 1, {}}, v{"v", 3, {}}, cell{"cell", 1, {}};
        for (std::size_t i = 0; i < mesh_.point_count(); ++i) {
            const double* const x = mesh_.points.data() + 3 * i;
            t.data.push_back(std::sin(5 * x[0]) + x[1] * x[2]);
            v.data.insert(v.data.end(), {x[0] * x[1], 2 + x[1] * x[2], -5 + x[2] * x[0]});
        }
        for (std::size_t i = 0; i < mesh_.cell_count(); ++i) cell.data.push_back(static_cast<double>(i));
        mesh_.point_fields = {t, v};
        mesh_.cell_fields = {cell};
        mesh_path_ = folder_ / "mesh.vtu";
        EXPECT_TRUE(write_vtk(mesh_, mesh_path_));
        reader_->SetFileName(mesh_path_.c_str());
        reader_->Update();
    }

    vtkSmartPointer<vtkDataSet> probe(vtkDataSet* where) {
        vtkNew<vtkProbeFilter> filter;
        filter->SetInputData(where);
        filter->SetSourceData(reader_->GetOutput());
        filter->SetCellLocatorPrototype(vtkNew<vtkCellTreeLocator>());
        filter->Update();
        return vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0));
    }

    vtkSmartPointer<vtkDataSet> probe(const std::vector<double>& coordinates) {
        vtkNew<vtkPoints> points;
        points->SetDataTypeToDouble();
        for (std::size_t i = 0; i < coordinates.size() / 3; ++i) points->InsertNextPoint(coordinates.data() + 3 * i);
        vtkNew<vtkPolyData> where;
        where->SetPoints(points);
        return probe(where);
    }

    std::string write(vtkDataSet* data, int mode = vtkXMLWriter::Appended, int compressor = vtkXMLWriter::NONE) {
        const bool image = vtkImageData::SafeDownCast(data) != nullptr;
        const std::string path = folder_ / (image ? "results.vti" : "results.vtp");
        vtkSmartPointer<vtkXMLWriter> writer;
        if (image) {
            writer = vtkSmartPointer<vtkXMLImageDataWriter>::New();
        } else {
            writer = vtkSmartPointer<vtkXMLPolyDataWriter>::New();
        }
        writer->SetInputData(data);
        writer->SetFileName(path.c_str());
        writer->SetDataMode(mode);
        writer->SetCompressorType(compressor);
        EXPECT_EQ(writer->Write(), 1);
        return path;
    }

    Verdicts verify(const std::string& path, bool exact = false) {
        VerifyJob job;
        job.mesh = mesh_path_;
        job.results = path;
        job.options.exact = exact;
        const Result<VerifyReport> summary = verify_files(job);
        EXPECT_TRUE(summary) << summary.error().message();
        EXPECT_EQ(summary->mask_column, "vtkValidPointMask");
        EXPECT_EQ(summary->cell_column, "cell");
        EXPECT_EQ(summary->columns, (std::vector<std::string>{"T", "v.0", "v.1", "v.2"}));
        return summary->verdicts;
    }

    static vtkDoubleArray* doubles(vtkDataSet* data, const char* name) {
        return vtkDoubleArray::SafeDownCast(data->GetPointData()->GetArray(name));
    }
    static vtkCharArray* mask(vtkDataSet* data) {
        return vtkCharArray::SafeDownCast(data->GetPointData()->GetArray("vtkValidPointMask"));
    }

    /// The verdict on a row, by the oracle. `holders` gets the cells that contain its point.
    RowVerdict judged(vtkDataSet* data, vtkIdType row, std::vector<Held>& holders) const {
        double at[3];
        data->GetPoint(row, at);
        holders = judge_.holders(at);
        const bool said = mask(data)->GetValue(row) != 0;
        if (holders.empty()) return said ? RowVerdict::invented : RowVerdict::right;
        if (!said) return RowVerdict::missed;
        const auto cell = static_cast<Mesh::Index>(doubles(data, "cell")->GetValue(row));
        if (std::none_of(holders.begin(), holders.end(), [&](const Held& h) { return h.cell == cell; }))
            return RowVerdict::wrong_cell;
        const bool right = std::any_of(holders.begin(), holders.end(), [&](const Held& h) {
            for (const Field& field : mesh_.point_fields) {
                for (int c = 0; c < field.components; ++c) {
                    const double value = true_value(mesh_, field, static_cast<std::size_t>(c), h.cell, at);
                    const double told = doubles(data, field.name.c_str())->GetComponent(row, c);
                    if (!(std::fabs(told - value) <= 1e-9 * range_of(field, c))) return false;
                }
            }
            return true;
        });
        return right ? RowVerdict::right : RowVerdict::wrong_value;
    }

    static double range_of(const Field& field, int component) {
        double low = field.data[static_cast<std::size_t>(component)], high = low;
        for (std::size_t i = static_cast<std::size_t>(component); i < field.data.size();
             i += static_cast<std::size_t>(field.components)) {
            low = std::min(low, field.data[i]);
            high = std::max(high, field.data[i]);
        }
        return high - low;
    }

    /// All counts are the judge's.
    void expect_judged(vtkDataSet* data, const Verdicts& v) {
        std::array<std::uint64_t, 5> count{};
        std::uint64_t inside = 0;
        std::vector<Held> holders;
        for (vtkIdType row = 0; row < data->GetNumberOfPoints(); ++row) {
            ++count[static_cast<std::size_t>(judged(data, row, holders))];
            inside += holders.empty() ? 0 : 1;
        }
        EXPECT_EQ(v.rows, static_cast<std::uint64_t>(data->GetNumberOfPoints()));
        EXPECT_EQ(v.inside, inside);
        EXPECT_EQ(v.right, count[static_cast<std::size_t>(RowVerdict::right)]);
        EXPECT_EQ(v.missed, count[static_cast<std::size_t>(RowVerdict::missed)]);
        EXPECT_EQ(v.invented, count[static_cast<std::size_t>(RowVerdict::invented)]);
        EXPECT_EQ(v.wrong_cell, count[static_cast<std::size_t>(RowVerdict::wrong_cell)]);
        EXPECT_EQ(v.wrong_value, count[static_cast<std::size_t>(RowVerdict::wrong_value)]);
    }

    /// Points of which VTK's every answer is right, by the judge: what is planted there is alone.
    vtkSmartPointer<vtkDataSet> right_rows() {
        base::Random random(8);
        const Bounds3 box = bounds_of_cells(mesh_);
        std::vector<double> some;
        for (std::size_t i = 0; i < 900; ++i)
            some.push_back(random.uniform(box.low[i % 3] - 0.05, box.high[i % 3] + 0.05));
        const vtkSmartPointer<vtkDataSet> probed = probe(some);
        std::vector<double> right;
        std::vector<Held> holders;
        for (vtkIdType row = 0; row < probed->GetNumberOfPoints(); ++row) {
            if (judged(probed, row, holders) != RowVerdict::right || holders.size() > 1) continue;
            const double* const x = some.data() + 3 * row;
            right.insert(right.end(), x, x + 3);
        }
        return probe(right);
    }

    vtkIdType first_row(vtkDataSet* data, bool inside) {
        vtkIdType row = 0;
        while ((mask(data)->GetValue(row) != 0) != inside) ++row;
        return row;
    }

    TemporaryFolder folder_;
    Mesh mesh_;
    PointJudge judge_;
    std::string mesh_path_;
    vtkNew<vtkXMLUnstructuredGridReader> reader_;
};

TEST_F(VtkOutput, ProbedPoints) {
    base::Random random(2);
    // Nodes, edges, faces, inside, outside, and an ulp from each: VTK is wrong at some of them, in every way.
    std::vector<double> points = awkward_points(mesh_, 25, random);
    std::vector<double> near;
    for (std::size_t i = 0; i < points.size() / 3; ++i) {
        const double* const x = points.data() + 3 * i;
        if (std::all_of(x, x + 3, [](double c) { return std::fabs(c) < 10; })) near.insert(near.end(), x, x + 3);
    }
    ASSERT_GT(near.size(), 900U);
    const vtkSmartPointer<vtkDataSet> probed = probe(near);
    const Verdicts v = verify(write(probed));
    expect_judged(probed, v);
    EXPECT_GT(v.right, 100U);
    EXPECT_GT(v.invented + v.wrong_cell, 0U) << "VTK takes points within a tolerance";
}

TEST_F(VtkOutput, ProbedImage) {
    vtkNew<vtkImageData> image;
    image->SetDimensions(9, 8, 7);
    image->SetOrigin(-0.1, 0, 0.05);
    image->SetSpacing(0.15, 1.0 / 7, 0.15);
    const vtkSmartPointer<vtkDataSet> probed = probe(image);
    const Verdicts v = verify(write(probed));
    expect_judged(probed, v);
    EXPECT_GT(v.right, 300U);
}

TEST_F(VtkOutput, EveryEncodingIsTheSame) {
    base::Random random(5);
    const vtkSmartPointer<vtkDataSet> probed = probe(inner_points(mesh_, 200, random));
    const Verdicts raw = verify(write(probed));
    for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended}) {
        for (const int compressor : {vtkXMLWriter::NONE, vtkXMLWriter::ZLIB, vtkXMLWriter::LZ4, vtkXMLWriter::LZMA}) {
            const Verdicts v = verify(write(probed, mode, compressor));
            EXPECT_EQ(v.right, raw.right);
            EXPECT_EQ(v.wrong(), raw.wrong());
            for (std::size_t c = 0; c < raw.columns.size(); ++c) {
                EXPECT_EQ(v.columns[c].identical, raw.columns[c].identical) << mode << ' ' << compressor;
                EXPECT_EQ(v.columns[c].max_relative, raw.columns[c].max_relative) << mode << ' ' << compressor;
            }
        }
    }
}

TEST_F(VtkOutput, PlantedErrorsAreNamed) {
    using Plant = std::function<void(vtkDataSet*)>;
    const vtkSmartPointer<vtkDataSet> probed = right_rows();
    const vtkIdType in = first_row(probed, true), out = first_row(probed, false);
    const Verdicts before = verify(write(probed));
    const std::uint64_t rows = before.rows;
    ASSERT_EQ(before.right, rows);
    ASSERT_GT(before.inside, 50U);
    ASSERT_GT(before.outside, 50U);
    const auto with = [&](const Plant& plant) {
        const vtkSmartPointer<vtkDataSet> copy = vtkSmartPointer<vtkDataSet>::Take(probed->NewInstance());
        copy->DeepCopy(probed);
        plant(copy);
        return verify(write(copy));
    };

    Verdicts v = with([&](vtkDataSet* d) { mask(d)->SetValue(in, 0); });
    EXPECT_EQ(v.missed, 1U);
    EXPECT_EQ(v.right, rows - 1);
    ASSERT_EQ(v.examples.size(), 1U);
    EXPECT_EQ(v.examples[0].row, static_cast<std::uint64_t>(in));

    v = with([&](vtkDataSet* d) { mask(d)->SetValue(out, 1); });
    EXPECT_EQ(v.invented, 1U);
    EXPECT_EQ(v.right, rows - 1);
    EXPECT_EQ(v.invented_zero, 1U) << "VTK writes 0 where it finds no cell";

    v = with(
        [&](vtkDataSet* d) { doubles(d, "cell")->SetValue(in, std::fmod(doubles(d, "cell")->GetValue(in) + 7, 100)); });
    EXPECT_EQ(v.wrong_cell, 1U);
    EXPECT_EQ(v.right, rows - 1);

    v = with([&](vtkDataSet* d) { doubles(d, "T")->SetValue(in, doubles(d, "T")->GetValue(in) + 1e-6); });
    EXPECT_EQ(v.wrong_value, 1U);
    EXPECT_EQ(v.columns[0].over, 1U);

    v = with([&](vtkDataSet* d) { doubles(d, "T")->SetValue(in, std::numeric_limits<double>::quiet_NaN()); });
    EXPECT_EQ(v.wrong_value, 1U);
    EXPECT_EQ(v.columns[0].missing, 1U);

    // Two components swapped, in one row.
    v = with([&](vtkDataSet* d) {
        double* const row = doubles(d, "v")->GetPointer(3 * in);
        std::swap(row[0], row[2]);
    });
    EXPECT_EQ(v.wrong_value, 1U);
    EXPECT_EQ(v.columns[1].over, 1U);
    EXPECT_EQ(v.columns[2].over, 0U);
    EXPECT_EQ(v.columns[3].over, 1U);

    // The value of a neighbour's nearest point: of the row before, for all that are inside.
    v = with([&](vtkDataSet* d) {
        double* const values = doubles(d, "T")->GetPointer(0);
        std::rotate(values, values + rows - 1, values + rows);
    });
    EXPECT_GT(v.wrong_value, before.inside / 2);
    EXPECT_EQ(v.missed + v.invented + v.wrong_cell, 0U);

    // All arrays of a row, mask included, are those of the row before.
    v = with([&](vtkDataSet* d) {
        for (int a = 0; a < d->GetPointData()->GetNumberOfArrays(); ++a) {
            vtkDataArray* const array = d->GetPointData()->GetArray(a);
            vtkSmartPointer<vtkDataArray> copy = vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
            copy->DeepCopy(array);
            for (vtkIdType row = 1; row < static_cast<vtkIdType>(rows); ++row) array->SetTuple(row, row - 1, copy);
        }
    });
    EXPECT_GT(v.missed, 10U);
    const int first = mask(probed)->GetValue(0), last = mask(probed)->GetValue(static_cast<vtkIdType>(rows) - 1);
    EXPECT_EQ(static_cast<int>(v.missed) - static_cast<int>(v.invented), last - first);
    EXPECT_GT(v.wrong_cell, before.inside / 4);
}

TEST_F(VtkOutput, OneUlp) {
    const vtkSmartPointer<vtkDataSet> probed = right_rows();
    const vtkIdType in = first_row(probed, true);
    // Correctly rounded throughout, then one ulp off in one row.
    for (vtkIdType row = 0; row < probed->GetNumberOfPoints(); ++row) {
        if (mask(probed)->GetValue(row) == 0) continue;
        double at[3];
        probed->GetPoint(row, at);
        const auto cell = static_cast<Mesh::Index>(doubles(probed, "cell")->GetValue(row));
        for (const Field& field : mesh_.point_fields) {
            for (int c = 0; c < field.components; ++c) {
                const double value = true_value(mesh_, field, static_cast<std::size_t>(c), cell, at);
                doubles(probed, field.name.c_str())->SetComponent(row, c, value);
            }
        }
    }
    Verdicts v = verify(write(probed), true);
    EXPECT_EQ(v.right, v.rows);
    vtkDoubleArray* const t = doubles(probed, "T");
    t->SetValue(in, std::nextafter(t->GetValue(in), 100));
    v = verify(write(probed), true);
    EXPECT_EQ(v.wrong_value, 1U);
    ASSERT_EQ(v.examples.size(), 1U);
    EXPECT_EQ(v.examples[0].row, static_cast<std::uint64_t>(in));
    EXPECT_EQ(v.examples[0].ulps, 1);
    v = verify(write(probed));
    EXPECT_EQ(v.wrong(), 0U);
    EXPECT_EQ(v.columns[0].identical + 1, v.inside);
}

}  // namespace
}  // namespace barycert::testing
