#include "tests/fuzz/points_round_trip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "barycert/gmsh_files.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/vtk_files.hpp"
#include "tests/fuzz/files.hpp"
#include "tests/fuzz/same.hpp"
#include "tests/fuzz/target.hpp"

namespace barycert::fuzz {
namespace {

/// All points of a file with what is carried.
struct AllPoints {
    std::vector<double> points;
    std::vector<ColumnFormat> formats;
    std::vector<Column> carried;
};

void append(Column& to, Column& from) {
    std::visit(
        [&](auto& values) {
            auto& more = std::get<std::decay_t<decltype(values)>>(from.values);
            values.insert(values.end(), more.begin(), more.end());
        },
        to.values);
}

/// Writes the points as rows outside every cell. Nothing if the sink refuses their names.
bool write_rows(const AllPoints& all, int dimension, const std::string& out, std::size_t lines) {
    const std::size_t rows = all.points.size() / static_cast<std::size_t>(dimension);
    const Result<std::unique_ptr<TableSink>> sink =
        open_table(without_file(out), {.dimension = dimension, .carried = all.formats});
    if (!sink) return expect_useful(sink.error(), lines), false;
    const std::vector<Mesh::Index> cells(rows, -1);
    const std::vector<Feature> features(rows, Feature::outside);
    Status done = (*sink)->write(
        {.dimension = dimension, .points = all.points, .cells = cells, .features = features, .carried = all.carried});
    if (done) done = (*sink)->commit();
    if (!done) expect_useful(done.error(), lines);
    return bool(done);
}

bool has_line_ends(const std::vector<Column>& columns) {
    const auto has = [](const std::string& text) { return text.find_first_of("\r\n") != std::string::npos; };
    return std::any_of(columns.begin(), columns.end(), [&](const Column& column) {
        const auto* const texts = std::get_if<std::vector<std::string>>(&column.values);
        return has(column.name) || (texts != nullptr && std::any_of(texts->begin(), texts->end(), has));
    });
}

Result<AllPoints> all_points(const std::string& path, int dimension, const PointOptions& options, std::size_t block) {
    const Result<std::unique_ptr<PointSource>> source = open_points(path, dimension, options);
    if (!source) return source.error();
    AllPoints all{.points = {}, .formats = (*source)->carried(), .carried = {}};
    for (const ColumnFormat& format : all.formats) all.carried.push_back(empty_column(format));
    std::vector<Column> columns;
    while (true) {
        const std::size_t before = all.points.size();
        const Result<std::size_t> count = (*source)->read(block, all.points);
        if (!count) {
            const Result<std::size_t> still = (*source)->read(block, all.points);
            expect(!still, "a source that has failed goes on");
            return count.error();
        }
        expect(*count <= block && all.points.size() == before + *count * static_cast<std::size_t>(dimension),
               "a source says another number of points than it gives");
        (*source)->take_carried(columns);
        expect(columns.size() == all.formats.size(), "a source carries other columns than it says");
        for (std::size_t i = 0; i < columns.size(); ++i) {
            expect(columns[i].name == all.formats[i].name && columns[i].type() == all.formats[i].type &&
                       columns[i].size() == *count,
                   "a source carries another column than it says", all.formats[i].name);
            append(all.carried[i], columns[i]);
        }
        if (*count < block) break;
    }
    const std::uint64_t rows = all.points.size() / static_cast<std::size_t>(dimension);
    expect((*source)->count().value_or(rows) == rows, "a source knows another number of points than it has");
    for (const double x : all.points) expect(std::isfinite(x), "a coordinate that is not finite was read");
    return all;
}

}  // namespace

void read_and_write_points(std::string_view input, InputFile& file) {
    static const std::array<std::string, 3> outs{scratch_path("out.csv"), scratch_path("out.npy"),
                                                 scratch_path("out.vtu")};
    const unsigned how = input.empty() ? 0 : static_cast<unsigned char>(input.front());
    if (!input.empty()) input.remove_prefix(1);
    const int dimension = (how & 1) != 0 ? 2 : 3;
    PointOptions options{.columns = {}, .keep = {}, .typed = (how & 4) != 0};
    if ((how & 2) != 0) options.keep = {"all"};
    if ((how & 8) != 0) options.columns = {dimension == 2 ? "1,2" : "2,1,3"};
    if ((how & 16) != 0) options.keep = {"new=a", "b"};
    const std::string& out = outs[(how >> 5) % outs.size()];
    const std::string& path = file.put(input);
    const std::size_t lines = lines_of(input);

    const Result<AllPoints> all = all_points(path, dimension, options, 1000);
    const Result<AllPoints> in_blocks = all_points(path, dimension, options, 3);
    expect(bool(all) == bool(in_blocks), "points are read or not by how many are asked for at a time");
    if (!all) {
        expect(all.error().message() == in_blocks.error().message(), "errors differ by how many points are asked for",
               all.error().message() + " / " + in_blocks.error().message());
        return expect_useful(all.error(), lines);
    }
    expect(same_numbers(all->points, in_blocks->points, Payload::kept), "points differ by how many are asked for");
    expect_same(all->carried, in_blocks->carried);

    if (!write_rows(*all, dimension, out, lines)) return;
    const PointOptions by_place{.columns = {dimension == 2 ? "1,2" : "1,2,3"}};
    const bool vtk = out.ends_with(".vtu");
    // A CSV file may have line ends within quotes, which this project writes and does not read.
    if (out.ends_with(".csv") && has_line_ends(all->carried)) return;
    const Result<AllPoints> again = all_points(out, dimension, vtk ? PointOptions{} : by_place, 1000);
    expect(bool(again), "rows that were written are not read", again ? "" : again.error().message());
    expect(same_numbers(all->points, again->points, Payload::kept), "other points came back");
}

}  // namespace barycert::fuzz
