// Meshes in memory: check, locate, sample and resample, held against each other and against slow twins that ask the
// oracle of every cell.
#include <bit>
#include <cmath>

#include "barycert/certificate.hpp"
#include "barycert/check.hpp"
#include "barycert/check_results.hpp"
#include "barycert/defect.hpp"
#include "barycert/fix.hpp"
#include "barycert/grid.hpp"
#include "barycert/locator.hpp"
#include "barycert/measures.hpp"
#include "barycert/not_finite.hpp"
#include "barycert/oracle.hpp"
#include "barycert/plc.hpp"
#include "barycert/sampler.hpp"
#include "barycert/surface.hpp"
#include "barycert/surface_report.hpp"
#include "mesh/locate/locator_data.hpp"
#include "tests/fuzz/drawn.hpp"
#include "tests/fuzz/same.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/mesh/check/judge.hpp"
#include "tests/mesh/locate/judge.hpp"

namespace barycert::fuzz {
namespace {

using testing::Held;
using testing::PointJudge;

constexpr std::size_t max_cells = 12, max_points = 8;

/// The verdict, the pairs that overlap, the cells that are flat: as the judge has them, who meets every cell with every
/// other one. Numbers of many digits take him a hundred times as long as all else: then he is asked of one mesh in 16.
CheckReport checked(const Drawn& drawn, Draws& draws) {
    const Mesh& mesh = drawn.mesh;
    CheckReport report = check_mesh(mesh, {.threads = 1, .contacts = 0});
    const bool long_numbers = drawn.numbers != Numbers::lattice && drawn.numbers != Numbers::fine;
    const bool wide = drawn.numbers == Numbers::scaled || drawn.numbers == Numbers::any;
    const bool asked = draws.below(16) == 15;  // bytes that have run out are 0
    if ((long_numbers && !asked) || mesh.cell_count() > (wide ? 2 : 6)) return report;
    const testing::Judgement j = testing::judge(mesh);
    expect(report.certified() == j.complex, "the verdict is wrong");
    expect(report.degenerate == j.degenerate, "the number of degenerate cells is wrong");
    const Defect* const overlaps = report.find(DefectKind::overlapping_cells);
    expect((overlaps == nullptr ? 0 : overlaps->count) == j.overlaps.size(), "the number of overlaps is wrong");
    for (std::size_t i = 0; overlaps != nullptr && i < overlaps->places.size(); ++i)
        expect(overlaps->places[i].cells == j.overlaps[i], "an overlap is wrong");
    expect(!j.complex || report.volume.equal, "the volumes of a complex are wrong");
    return report;
}

/// By walks, by candidates, alone with a hint, in all cells.
Table located(const Locator& locator, const Locator& plain, const std::vector<double>& points, unsigned hint) {
    const Mesh& mesh = locator.mesh();
    const Result<Table> rows = locator.locate(points, 1), others = plain.locate(points, 1),
                        all = locator.locate_all(points, 1);
    expect(rows && others && all, "points are not located");
    expect(rows->cells == others->cells && rows->features == others->features, "walks and candidates differ");
    const PointJudge judge(mesh);
    const auto d = static_cast<std::size_t>(mesh.dimension);
    for (std::size_t i = 0; i < rows->row_count(); ++i) {
        const double* const point = points.data() + d * i;
        const std::vector<Held> holders = judge.holders(point);
        const Held owner = holders.empty() ? Held{} : holders.front();
        expect(rows->cells[i] == owner.cell && rows->features[i] == owner.feature, "an owner is wrong");
        const Mesh::Index near = mesh.cells.empty() ? -1 : static_cast<Mesh::Index>(hint % mesh.cell_count());
        const Result<Location> one = locator.locate(point, near);
        expect(bool(one) && one->cell == owner.cell && one->feature == owner.feature, "an owner from a hint is wrong");
        const std::size_t begin = all->point_begin[i], count = all->point_begin[i + 1] - begin;
        expect(count == std::max<std::size_t>(1, holders.size()), "the number of holders is wrong");
        for (std::size_t k = 0; k < holders.size(); ++k)
            expect(all->cells[begin + k] == holders[k].cell && all->features[begin + k] == holders[k].feature,
                   "a holder is wrong");
    }
    return *all;
}

bool same_value(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
}

/// Every value of the field of nodes: the exact one, rounded once; that of the field of cells: the owner's.
void expect_values(const Mesh& mesh, const Table& rows, const std::vector<double>& points) {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    const std::vector<double>& t = mesh.point_fields.front().data;
    for (std::size_t i = 0; i < rows.row_count(); ++i) {
        const Mesh::Index cell = rows.cells[i];
        double value = std::nan(""), of_cell = value;
        if (cell >= 0) {
            Case c = testing::case_of(mesh, cell, points.data() + d * i);
            const std::size_t first = static_cast<std::size_t>(cell) * (d + 1);
            for (std::size_t k = 0; k <= d; ++k) c.values[k] = t[static_cast<std::size_t>(mesh.cells[first + k])];
            value = ask_oracle(c).value;
            of_cell = mesh.cell_fields.front().data[static_cast<std::size_t>(cell)];
        }
        expect(same_value(rows.value(i, 0), value), "a value is wrong");
        expect(same_value(rows.value(i, 1), of_cell), "a value of a cell is wrong");
    }
}

/// The same bits from every cell that holds a point (V2).
void expect_seamless(const Sampler& sampler, const Table& all) {
    Table rows;
    rows.dimension = all.dimension;
    rows.cells = all.cells;
    rows.features = all.features;
    expect(bool(sampler.evaluate(all.points, {.threads = 1}, rows)), "known owners are not sampled");
    for (std::size_t i = 0; i + 1 < all.point_begin.size(); ++i) {
        for (std::size_t k = all.point_begin[i] + 1; k < all.point_begin[i + 1]; ++k)
            expect(std::bit_cast<std::uint64_t>(rows.value(k, 0)) == std::bit_cast<std::uint64_t>(rows.value(k - 1, 0)),
                   "a value jumps where cells meet");
    }
}

/// A grid cell by cell, and point by point.
void expect_grid(const Sampler& sampler, Draws& draws) {
    const Mesh& mesh = sampler.locator().mesh();
    Bounds3 box = bounds_of_cells(mesh);
    std::array<std::int64_t, 3> counts{1, 1, 1};
    for (int k = 0; k < mesh.dimension; ++k) counts[static_cast<std::size_t>(k)] = 1 + draws.below(4);
    const Result<Grid> grid = grid_over(mesh.dimension, counts, box.low, box.high);
    if (!grid) return;
    const Result<Table> rows = resample(sampler, *grid, {.threads = 1});
    expect(bool(rows), "a grid is not sampled", rows ? "" : rows.error().message());
    std::vector<double> points;
    for (std::int64_t z = 0; z < counts[2]; ++z) {
        for (std::int64_t y = 0; y < counts[1]; ++y) {
            for (std::int64_t x = 0; x < counts[0]; ++x) {
                points.insert(points.end(), {grid->coordinate(0, x), grid->coordinate(1, y)});
                if (mesh.dimension == 3) points.push_back(grid->coordinate(2, z));
            }
        }
    }
    const Result<Table> one_by_one = sampler.sample(points, {.threads = 1});
    expect(bool(one_by_one), "the points of a grid are not sampled");
    expect(rows->cells == one_by_one->cells && rows->features == one_by_one->features &&
               same_numbers(rows->values, one_by_one->values, Payload::kept),
           "a grid and its points differ");
}

}  // namespace

BARYCERT_FUZZ_TARGET(meshes, {std::size_t{32} << 20, 256}) {
    Draws draws(input);
    Drawn drawn = draw_mesh(draws, max_cells, max_points);
    Mesh& mesh = drawn.mesh;
    const CheckReport report = checked(drawn, draws);

    const unsigned hint = draws.byte();
    const auto of_values = static_cast<Numbers>(draws.below(5));
    Field t{"T", 1, {}}, q{"q", 1, {}};
    for (std::size_t i = 0; i < mesh.point_count(); ++i) t.data.push_back(draw_number(draws, of_values));
    for (std::size_t i = 0; i < mesh.cell_count(); ++i) q.data.push_back(static_cast<double>(i));
    mesh.point_fields = {t};
    mesh.cell_fields = {q};

    const Result<Locator> locator = Locator::build(mesh, {.threads = 1}),
                          plain = Locator::build(mesh, {.prove = Prove::never, .threads = 1});
    expect(locator && plain, "a consistent mesh is not indexed");
    expect(locator->certified() == report.certified(), "check and locator differ on the certificate");
    expect(!locator->certified() || locator->contested_cells() == 0, "a certified mesh has contested cells");
    const Defect* const repeated = report.find(DefectKind::repeated_node);
    expect(locator->degenerate_cells() == report.degenerate + (repeated == nullptr ? 0 : repeated->count),
           "check and locator differ on degenerate cells");
    // So few points are located without the table of bins that are empty: for one input in eight it is made, where it
    // can be.
    if (hint % 8 == 7) locate::LocatorData::of(*locator).policy.prepare(1'000'000);
    const Table all = located(*locator, *plain, drawn.points, hint / 8);

    const Result<std::vector<FieldChoice>> fields = choose_fields(mesh, {});
    expect(bool(fields), "fields are not chosen");
    const Result<Sampler> sampler = Sampler::build(*locator, *fields);
    expect(bool(sampler), "a sampler is not built");
    const Result<Table> rows = sampler->sample(drawn.points, {.threads = 1});
    expect(bool(rows), "points are not sampled");
    expect_values(mesh, *rows, drawn.points);
    if (report.certified()) expect_seamless(*sampler, all);
    expect_grid(*sampler, draws);
}

}  // namespace barycert::fuzz
