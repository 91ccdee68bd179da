/// Rows of any number into .vtu files: what is kept beside the target on the way.
#include <limits>

#include "tests/io/vtk/mesh_notes.hpp"

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "files/spool.hpp"

namespace barycert::testing {
namespace {

TEST(VtkRows, SpoolsKeepAllBytes) {
    const TemporaryFolder folder;
    for (const std::size_t count : {std::size_t{0}, std::size_t{3}, std::size_t{1000000}}) {
        base::Spool spool(folder / "x.vtu");
        std::vector<double> all;
        for (std::size_t i = 0; i < count; i += 1000) {
            std::vector<double> some;
            for (std::size_t k = i; k < std::min(count, i + 1000); ++k) some.push_back(static_cast<double>(k) + 0.5);
            ASSERT_TRUE(spool.append(std::span<const double>(some)));
            all.insert(all.end(), some.begin(), some.end());
        }
        ASSERT_TRUE(spool.finish());
        EXPECT_EQ(bits_of({spool.values<double>().begin(), spool.values<double>().end()}), bits_of(all));
        EXPECT_EQ(folder.file_count(), 0U);
    }
}

TEST(VtkRows, OfEveryKindComeBack) {
    const TemporaryFolder folder;
    TableFormat format{
        .dimension = 3, .fields = {{"T", 1}, {"u", 2}}, .distances = true, .carried = {}, .vtk_data = {}};
    format.carried = {{"id", Column::Type::integer}, {"time", Column::Type::number}, {"name", Column::Type::text}};
    for (const VtkData data : {VtkData::raw, VtkData::zlib, VtkData::lz4, VtkData::lzma, VtkData::ascii}) {
        SCOPED_TRACE(name(data));
        format.vtk_data = data;
        auto sink = open_table(folder / "r.vtu", format).value();
        std::vector<double> points, values, distances, times, t, u;
        std::vector<std::int64_t> ids;
        for (int block = 0; block < 40; ++block) {
            Table rows;
            Column id{"id", std::vector<std::int64_t>()}, time{"time", std::vector<double>()},
                name{"name", std::vector<std::string>()};
            for (int i = 0; i < 5000; ++i) {
                const double x = block + i * 0.1;
                rows.points.insert(rows.points.end(), {x, -x, 0.1 * x});
                rows.cells.push_back(i % 7 - 1);
                rows.features.push_back(i % 7 == 0 ? Feature::outside : Feature::interior);
                rows.values.insert(rows.values.end(), {x / 3, x / 7, -x});
                rows.distances.push_back(x);
                std::get<0>(id.values).push_back((std::int64_t{1} << 60U) + i);
                std::get<1>(time.values).push_back(x * x);
                std::get<2>(name.values).push_back(i % 2 == 0 ? "" : "p" + std::to_string(i));
                t.push_back(x / 3);
                u.insert(u.end(), {x / 7, -x});
            }
            rows.carried = {id, time, name};
            points.insert(points.end(), rows.points.begin(), rows.points.end());
            ASSERT_TRUE(sink->write(rows.view()));
            EXPECT_EQ(folder.file_count(), 0U);
        }
        ASSERT_TRUE(sink->commit());
        const Result<PointData> read = read_vtk_point_data(folder / "r.vtu", 3);
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_EQ(bits_of(read->points), bits_of(points));
        const auto field = [&](const std::string& name) -> const std::vector<double>& {
            for (const Field& f : read->fields) {
                if (f.name == name) return f.data;
            }
            static const std::vector<double> none;
            return none;
        };
        EXPECT_EQ(bits_of(field("T")), bits_of(t));
        EXPECT_EQ(bits_of(field("u")), bits_of(u));
        EXPECT_EQ(field("cell")[0], -1);
        EXPECT_EQ(field("vtkValidPointMask")[1], 1);
        EXPECT_EQ(field("time").size(), t.size());
        EXPECT_EQ(field("distance").size(), t.size());
        EXPECT_TRUE(read->notes.empty());
        ASSERT_EQ(read->labels.size(), 2U);  // ids that no double holds, texts
        const auto& kept = std::get<std::vector<std::int64_t>>(read->labels[0].values);
        const auto& names = std::get<std::vector<std::string>>(read->labels[1].values);
        ASSERT_EQ(kept.size(), t.size());
        ASSERT_EQ(names.size(), t.size());
        EXPECT_EQ(kept[5001], (std::int64_t{1} << 60U) + 1);
        EXPECT_EQ(names[5001], "p1");
        EXPECT_EQ(names[5002], "");
        std::filesystem::remove(folder / "r.vtu");
    }
}

TEST(VtkRows, ThatDoNotFit) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const TemporaryFolder folder;
    const std::vector<double> points{0, 0, 0, 1, 1, 1}, bad{0, 0, infinity, 1, 1, 1}, two{1, 2};
    const std::vector<Mesh::Index> cells{1, 1}, none{-1, 1};
    const std::vector<Feature> features{Feature::interior, Feature::interior};
    const TableView good{.dimension = 3, .points = points, .cells = cells, .features = features};
    const auto written = [&](const TableFormat& format, const TableView& rows) -> Status {
        auto sink = open_table(folder / "p.vtu", format);
        if (!sink) return sink.error();
        if (Status s = (*sink)->write(rows); !s) return s;
        return (*sink)->commit();
    };
    const auto refused = [&](const TableFormat& format, const TableView& rows, const std::string& what) {
        const Status status = written(format, rows);
        ASSERT_FALSE(status) << what;
        EXPECT_EQ(status.error().what, what);
        EXPECT_EQ(status.error().file, folder / "p.vtu");
        EXPECT_EQ(folder.file_count(), 0U);
    };
    const auto with = [&](auto change) {
        TableView rows = good;
        change(rows);
        return rows;
    };
    const std::string sizes = "the parts of a block of rows have different sizes";
    refused({.dimension = 1}, good, "points of rows can have 2 or 3 coordinates");
    refused({}, with([](TableView& r) { r.points = r.points.first(5); }), sizes);
    refused({}, with([](TableView& r) { r.cells = r.cells.first(1); }), sizes);
    refused({.distances = true}, with([&](TableView& r) { r.distances = std::span(two).first(1); }), sizes);
    refused({.fields = {{"f", 1}}}, with([&](TableView& r) { r.values = std::span(two).first(1); }), sizes);
    refused({}, with([&](TableView& r) { r.points = bad; }), "cannot write the points: a coordinate is not finite");
    refused({.fields = {{"f", 0}}}, good, "cannot write the points: a field has no components");
    const TableView values = with([&](TableView& r) { r.values = two; });
    refused({.fields = {{"", 1}}}, values, "cannot write the points: a field has no name");
    refused({.fields = {{"\xff", 1}}}, values,
            "cannot write the points: the name of field \"\xff\" has bytes that XML cannot hold");
    refused({.fields = {{"f", 1}, {"f", 1}}}, values, "two columns of the rows would have the same name");
    refused({.fields = {{"distance", 1}}, .distances = true}, with([&](TableView& r) { r.values = r.distances = two; }),
            "cannot write the points: two fields are named \"distance\"");
    // A point outside may be anywhere.
    EXPECT_TRUE(written({}, with([&](TableView& r) {
                            r.points = bad;
                            r.cells = none;
                        })));
}

}  // namespace
}  // namespace barycert::testing
