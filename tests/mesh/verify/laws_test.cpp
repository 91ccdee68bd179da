// R1 to R4 and D1 on random meshes, good and bad: claims are made by the oracle, cell by cell, and spoiled on purpose.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "barycert/gmsh_files.hpp"
#include "barycert/grid.hpp"
#include "barycert/mesh_files.hpp"
#include "barycert/plc_files.hpp"
#include "barycert/point_files.hpp"
#include "barycert/series.hpp"
#include "barycert/surface_files.hpp"
#include "barycert/table_files.hpp"
#include "barycert/tetgen_files.hpp"
#include "barycert/verify.hpp"
#include "barycert/vtk_files.hpp"
#include "tests/mesh/check/random_complexes.hpp"
#include "tests/mesh/locate/judge.hpp"
#include "tests/mesh/locate/points.hpp"
#include "tests/mesh/sample/points/rows.hpp"

namespace barycert::testing {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Claims that a tool might make about points, and the verdict on each row.
struct Claims {
    std::vector<std::int64_t> cells;
    std::vector<std::uint8_t> inside;
    std::vector<double> values;
    std::vector<RowVerdict> verdicts;
};

/// A tool that takes any of the cells that contain a point, and is wrong now and then.
Claims claims_of(const Mesh& mesh, const std::vector<double>& points, base::Random& random) {
    const PointJudge judge(mesh);
    const auto d = static_cast<std::size_t>(mesh.dimension);
    Claims claims;
    for (std::size_t i = 0; i < points.size() / d; ++i) {
        const double* const at = points.data() + d * i;
        const std::vector<Held> held = judge.holders(at);
        const int spoil = random.integer(0, 7);
        const bool inside = !held.empty(), said = spoil == 0 ? !inside : inside;
        std::int64_t cell = -1;
        RowVerdict verdict = RowVerdict::right;
        if (inside) cell = held[random.below(held.size())].cell;
        double value =
            inside ? true_value(mesh, mesh.point_fields[0], 0, static_cast<Mesh::Index>(cell), at) : not_a_number;
        double region = inside ? mesh.cell_fields[0].data[static_cast<std::size_t>(cell)] : not_a_number;
        if (inside && !said) {
            cell = -1;
            value = region = not_a_number;
            verdict = RowVerdict::missed;
        } else if (!inside && said) {
            cell = static_cast<std::int64_t>(random.below(mesh.cell_count()));
            value = region = 0;
            verdict = RowVerdict::invented;
        } else if (inside && spoil == 1) {
            value += 3;
            verdict = RowVerdict::wrong_value;
        } else if (inside && spoil == 2) {
            cell = random.integer(-1, 0) == 0 ? static_cast<std::int64_t>(random.below(mesh.cell_count()))
                                              : static_cast<std::int64_t>(mesh.cell_count() + random.below(3));
            bool holds = false;
            for (const Held h : held) holds = holds || h.cell == cell;
            if (!holds) verdict = RowVerdict::wrong_cell;
        }
        claims.cells.push_back(cell);
        claims.inside.push_back(said ? 1 : 0);
        claims.values.insert(claims.values.end(), {value, region});
        claims.verdicts.push_back(verdict);
    }
    return claims;
}

/// Small values of nodes; every cell has a value of its own, so that the wrong cell's is off by at least 1.
void add_fields(Mesh& mesh, base::Random& random) {
    Field field{"T", 1, {}}, region{"region", 1, {}};
    for (std::size_t i = 0; i < mesh.point_count(); ++i) field.data.push_back(random.uniform(-1, 1));
    for (std::size_t i = 0; i < mesh.cell_count(); ++i) region.data.push_back(static_cast<double>(i));
    mesh.point_fields = {field};
    mesh.cell_fields = {region};
}

std::uint64_t count(const std::vector<RowVerdict>& all, RowVerdict wanted) {
    return static_cast<std::uint64_t>(std::count(all.begin(), all.end(), wanted));
}

void expect_verdicts(const Verdicts& found, const std::vector<RowVerdict>& right, const std::string& what) {
    EXPECT_EQ(found.rows, right.size()) << what;
    EXPECT_EQ(found.right, count(right, RowVerdict::right)) << what;
    EXPECT_EQ(found.missed, count(right, RowVerdict::missed)) << what;
    EXPECT_EQ(found.invented, count(right, RowVerdict::invented)) << what;
    EXPECT_EQ(found.wrong_cell, count(right, RowVerdict::wrong_cell)) << what;
    EXPECT_EQ(found.wrong_value, count(right, RowVerdict::wrong_value)) << what;
    EXPECT_EQ(found.rows, found.right + found.wrong()) << what;
}

TEST(VerifyLaws, R1R2R3R4AnyCellThatContainsThePointIsRight) {
    for (const int d : {2, 3}) {
        for (std::uint64_t n = 0; n < 150 && !::testing::Test::HasFailure(); ++n) {
            base::Random random = base::Random::stream(91, n, static_cast<std::uint64_t>(d));
            Mesh mesh = n % 3 == 0   ? random_soup(d, random)
                        : n % 3 == 1 ? grown_complex(d, random)
                                     : damaged_box(d, random);
            if (mesh.cell_count() == 0) continue;
            add_fields(mesh, random);
            const std::vector<double> points = awkward_points(mesh, 4, random);
            const Claims claims = claims_of(mesh, points, random);
            const Sampler sampler = Sampler::build(mesh).value();
            VerifyOptions options;
            options.examples = points.size();
            const Verifier verifier(sampler, options);
            ClaimedRows rows{points, claims.cells, claims.inside, claims.values, 0};
            const std::string what = "mesh " + std::to_string(n) + " of dimension " + std::to_string(d);
            Verdicts found = verifier.verify(rows).value();
            ASSERT_LE(found.invented, max_measured);
            ASSERT_TRUE(verifier.measure(found));
            expect_verdicts(found, claims.verdicts, what);
            for (const WrongRow& row : found.examples) EXPECT_EQ(row.verdict, claims.verdicts[row.row]) << what;
            EXPECT_EQ(found.examples.size(), found.wrong()) << what;
            // Without cells, wrong ones cannot be told.
            rows.cells = {};
            std::vector<RowVerdict> less = claims.verdicts;
            std::replace(less.begin(), less.end(), RowVerdict::wrong_cell, RowVerdict::right);
            expect_verdicts(verifier.verify(rows).value(), less, what + ", no cells");
        }
    }
}

TEST(VerifyLaws, D1BlocksAndThreads) {
    base::Random random = base::Random::stream(92, 1, 3);
    Mesh mesh = damaged_box(3, random);
    while (mesh.cell_count() == 0) mesh = damaged_box(3, random);
    add_fields(mesh, random);
    const std::vector<double> points = awkward_points(mesh, 200, random);
    const Claims claims = claims_of(mesh, points, random);
    const Sampler sampler = Sampler::build(mesh).value();
    const std::size_t count = points.size() / 3;
    const ClaimedRows rows{points, claims.cells, claims.inside, claims.values, 0};
    VerifyOptions options;
    options.examples = 7;
    Verdicts whole = Verifier(sampler, options).verify(rows).value();
    ASSERT_TRUE(Verifier(sampler, options).measure(whole));
    EXPECT_GT(whole.invented, 0U);
    for (const int threads : {1, 2, 5}) {
        options.threads = threads;
        const Verifier verifier(sampler, options);
        Verdicts pieces;
        for (std::size_t first = 0; first < count;) {
            const std::size_t size = std::min<std::size_t>(count - first, 1 + random.below(500));
            const ClaimedRows part{rows.points.subspan(3 * first, 3 * size), rows.cells.subspan(first, size),
                                   rows.inside.subspan(first, size), rows.values.subspan(2 * first, 2 * size), first};
            pieces.add(verifier.verify(part).value(), options.examples);
            first += size;
        }
        ASSERT_TRUE(verifier.measure(pieces));
        EXPECT_EQ(pieces.invented_distance, whole.invented_distance);
        EXPECT_EQ(pieces.invented_measured, whole.invented_measured);
        EXPECT_EQ(pieces.right, whole.right);
        EXPECT_EQ(pieces.wrong_value, whole.wrong_value);
        EXPECT_EQ(pieces.by_other_cell, whole.by_other_cell);
        ASSERT_EQ(pieces.examples.size(), whole.examples.size());
        for (std::size_t i = 0; i < whole.examples.size(); ++i)
            EXPECT_EQ(pieces.examples[i].row, whole.examples[i].row);
        for (std::size_t c = 0; c < 2; ++c) {
            EXPECT_EQ(pieces.columns[c].by_ulps, whole.columns[c].by_ulps);
            EXPECT_EQ(pieces.columns[c].by_relative, whole.columns[c].by_relative);
            EXPECT_EQ(pieces.columns[c].max_relative, whole.columns[c].max_relative);
        }
    }
}

TEST(VerifyLaws, D1TheSameRowsAreMeasuredWhateverTheParts) {
    base::Random random = base::Random::stream(93, 1, 3);
    Mesh mesh = read_mesh(BARYCERT_DATA_DIR "/meshes/cube-hole").value();
    mesh.point_fields.clear();
    mesh.cell_fields.clear();
    const Sampler sampler = Sampler::build(mesh).value();
    const Bounds3 box = bounds_of_cells(mesh);
    const std::size_t count = max_measured + 700;
    std::vector<double> points;
    for (std::size_t i = 0; i < count; ++i) {
        points.push_back(box.high[0] + random.uniform(0.1, 2));
        for (const int k : {1, 2}) points.push_back(random.uniform(box.low[k], box.high[k]));
    }
    const std::vector<std::uint8_t> inside(count, 1);
    const Verifier verifier(sampler, {});
    Verdicts whole = verifier.verify({points, {}, inside, {}, 0}).value();
    ASSERT_TRUE(verifier.measure(whole));
    EXPECT_EQ(whole.invented, count);
    EXPECT_EQ(whole.invented_measured, max_measured);
    EXPECT_GT(whole.invented_distance, 0);
    Verdicts pieces;
    for (std::size_t first = 0; first < count; first += 170) {
        const std::size_t size = std::min<std::size_t>(count - first, 170);
        const std::span all(points);
        pieces.add(verifier.verify({all.subspan(3 * first, 3 * size), {}, {inside.data(), size}, {}, first}).value(),
                   verifier.options().examples);
    }
    ASSERT_TRUE(verifier.measure(pieces));
    EXPECT_EQ(pieces.invented_measured, max_measured);
    EXPECT_EQ(pieces.invented_distance, whole.invented_distance);
}

}  // namespace
}  // namespace barycert::testing
