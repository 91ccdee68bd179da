// One error of each kind, planted in rows that are right.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

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
#include "core/base/random.hpp"

namespace barycert::testing {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A mesh with a field of nodes and one of cells, points in its box, and rows that are right.
class Verify : public ::testing::Test {
protected:
    Verify() : mesh_(read_mesh(BARYCERT_DATA_DIR "/meshes/cube-hole").value()) {
        Field field{"T", 1, {}}, region{"region", 1, {}};
        for (std::size_t i = 0; i < mesh_.point_count(); ++i)
            field.data.push_back(1 + mesh_.points[3 * i] + 2 * mesh_.points[3 * i + 1] * mesh_.points[3 * i + 2]);
        for (std::size_t i = 0; i < mesh_.cell_count(); ++i) region.data.push_back(static_cast<double>(i));
        mesh_.point_fields = {field};
        mesh_.cell_fields = {region};
        sampler_.emplace(Sampler::build(mesh_).value());
        base::Random random(3);
        const Bounds3 box = bounds_of_cells(mesh_);
        for (std::size_t i = 0; i < 3 * rows_; ++i)
            points_.push_back(random.uniform(box.low[i % 3] - 0.1, box.high[i % 3] + 0.1));
        const Table table = sampler_->sample(points_).value();
        values_ = table.values;
        cells_.assign(table.cells.begin(), table.cells.end());
        inside_ = row_where([&](std::size_t i) { return cells_[i] >= 0; });
        outside_ = row_where([&](std::size_t i) { return cells_[i] < 0; });
    }

    template <class Is>
    std::size_t row_where(Is is) const {
        std::size_t row = 0;
        while (!is(row)) ++row;
        return row;
    }

    Verdicts measured(const ClaimedRows& rows, const VerifyOptions& options) const {
        const Verifier verifier(*sampler_, options);
        Verdicts found = verifier.verify(rows).value();
        EXPECT_TRUE(verifier.measure(found));
        return found;
    }
    Verdicts verify(VerifyOptions options = {}) const { return measured({points_, cells_, {}, values_, 0}, options); }
    Verdicts verify_values(VerifyOptions options = {}) const {
        return measured({points_, {}, {}, values_, 0}, options);
    }

    static constexpr std::size_t rows_ = 500;
    Mesh mesh_;
    std::optional<Sampler> sampler_;
    std::vector<double> points_, values_;
    std::vector<std::int64_t> cells_;
    std::size_t inside_ = 0, outside_ = 0;
};

TEST_F(Verify, RowsThatAreRight) {
    VerifyOptions exact;
    exact.exact = true;
    for (const Verdicts& v : {verify(), verify(exact), verify_values(), verify_values(exact)}) {
        EXPECT_EQ(v.right, rows_);
        EXPECT_EQ(v.wrong(), 0U);
        EXPECT_GT(v.inside, 100U);
        EXPECT_GT(v.outside, 100U);
        EXPECT_EQ(v.columns[0].identical, v.inside);
        EXPECT_EQ(v.columns[0].by_ulps[0], v.inside);
        EXPECT_TRUE(v.examples.empty());
    }
}

TEST_F(Verify, OneUlp) {
    values_[2 * inside_] = std::nextafter(values_[2 * inside_], 100);
    const Verdicts v = verify();
    EXPECT_EQ(v.right, rows_);
    EXPECT_EQ(v.columns[0].identical + 1, v.inside);
    EXPECT_EQ(v.columns[0].max_ulps, 1);
    EXPECT_EQ(v.columns[0].by_ulps[2], 1U) << "1 <= ulps < 2";
    EXPECT_EQ(v.columns[0].over, 0U);
    VerifyOptions exact;
    exact.exact = true;
    const Verdicts strict = verify(exact);
    EXPECT_EQ(strict.wrong_value, 1U);
    ASSERT_EQ(strict.examples.size(), 1U);
    EXPECT_EQ(strict.examples[0].row, inside_);
    EXPECT_EQ(strict.examples[0].ulps, 1);
    EXPECT_EQ(strict.examples[0].claimed, values_[2 * inside_]);
}

TEST_F(Verify, ToleranceIsOfTheRange) {
    const Verifier verifier(*sampler_, {});
    const double range = verifier.ranges()[0];
    EXPECT_GT(range, 1);
    values_[2 * inside_] += 0.9e-9 * range;
    EXPECT_EQ(verify().wrong_value, 0U);
    values_[2 * inside_] += 0.2e-9 * range;
    const Verdicts v = verify();
    EXPECT_EQ(v.wrong_value, 1U);
    EXPECT_EQ(v.columns[0].over, 1U);
    EXPECT_NEAR(v.columns[0].max_relative, 1.1e-9, 1e-15);
    EXPECT_EQ(v.columns[0].by_relative[10], 1U) << "1e-9 to 1e-8";
}

TEST_F(Verify, RowsShifted) {
    std::rotate(values_.begin(), values_.begin() + 2, values_.end());
    const Verdicts v = verify();
    EXPECT_GT(v.wrong_value, v.inside / 4);
    EXPECT_GT(v.missed + v.wrong_value, v.inside / 2);
}

TEST_F(Verify, MissedAndInvented) {
    values_[2 * inside_] = values_[2 * inside_ + 1] = nan;
    values_[2 * outside_] = values_[2 * outside_ + 1] = 0;
    const Verdicts v = verify_values();
    EXPECT_EQ(v.missed, 1U);
    EXPECT_EQ(v.invented, 1U);
    EXPECT_EQ(v.invented_zero, 1U);
    ASSERT_EQ(v.examples.size(), 2U);
    EXPECT_EQ(v.examples[0].verdict, RowVerdict::missed);
    EXPECT_EQ(v.examples[0].exact.cell, cells_[inside_]);
    EXPECT_EQ(v.examples[1].row, outside_);
    const double infinite = std::numeric_limits<double>::infinity();
    const Nearest nearest = sampler_->locator().nearest(points_.data() + 3 * outside_, infinite).value();
    EXPECT_EQ(v.examples[1].distance, nearest.distance);
    EXPECT_EQ(v.invented_distance, nearest.distance);
    EXPECT_EQ(v.invented_near, 0U) << "a point somewhere outside";
    VerifyOptions zero;
    zero.outside_value = 0;
    EXPECT_EQ(verify_values(zero).invented, 0U) << "0 stands for outside";
    // The mask speaks before values do.
    std::vector<std::uint8_t> mask(rows_);
    for (std::size_t i = 0; i < rows_; ++i) mask[i] = cells_[i] >= 0 ? 1 : 0;
    const Verdicts masked = Verifier(*sampler_, {}).verify({points_, {}, mask, values_, 0}).value();
    EXPECT_EQ(masked.missed + masked.invented, 0U);
    EXPECT_EQ(masked.wrong_value, 1U) << "inside by the mask, and without a value";
    EXPECT_EQ(masked.columns[0].missing, 1U);
}

TEST_F(Verify, NodesBelongToSeveralCells) {
    // At a node every cell around it may be named, with its own region.
    const Mesh::Index node = mesh_.cells[4 * 10];
    std::vector<double> at(mesh_.points.begin() + 3 * node, mesh_.points.begin() + 3 * node + 3);
    const Location owner = sampler_->locator().locate(at.data()).value();
    std::size_t right = 0;
    for (std::size_t cell = 0; cell < mesh_.cell_count(); ++cell) {
        const bool holds = std::count(mesh_.cells.begin() + 4 * static_cast<std::ptrdiff_t>(cell),
                                      mesh_.cells.begin() + 4 * static_cast<std::ptrdiff_t>(cell) + 4, node) != 0;
        const std::vector<std::int64_t> cells{static_cast<std::int64_t>(cell)};
        const std::vector<double> values{mesh_.point_fields[0].data[static_cast<std::size_t>(node)],
                                         static_cast<double>(cell)};
        const Verdicts v = Verifier(*sampler_, {}).verify({at, cells, {}, values, 0}).value();
        EXPECT_EQ(v.right, holds ? 1U : 0U) << cell;
        EXPECT_EQ(v.wrong_cell, holds ? 0U : 1U) << cell;
        EXPECT_EQ(v.by_other_cell, holds && static_cast<Mesh::Index>(cell) != owner.cell ? 1U : 0U) << cell;
        right += v.right;
    }
    EXPECT_GT(right, 3U);
}

TEST_F(Verify, InfinityIsAnError) {
    values_[2 * inside_] = std::numeric_limits<double>::infinity();
    const Verdicts v = verify();
    EXPECT_EQ(v.wrong_value, 1U);
    EXPECT_EQ(v.columns[0].max_relative, std::numeric_limits<double>::infinity());
    EXPECT_EQ(v.columns[0].by_relative.back(), 1U);
    EXPECT_EQ(v.columns[0].by_ulps.back(), 1U);
}

TEST_F(Verify, ExamplesAreTheWorst) {
    VerifyOptions options;
    options.examples = 3;
    double off = 1;
    std::size_t last = 0, planted = 0;
    for (std::size_t i = 0; i < rows_; ++i) {
        if (cells_[i] < 0) continue;
        values_[2 * i] += off;
        off += 1;
        last = i;
        ++planted;
    }
    const Verdicts v = verify(options);
    EXPECT_EQ(v.wrong_value, planted);
    ASSERT_EQ(v.examples.size(), 3U);
    EXPECT_EQ(v.examples[0].row, last);
    EXPECT_GT(v.examples[1].relative, v.examples[2].relative);
}

TEST_F(Verify, Errors) {
    const Verifier verifier(*sampler_, {});
    std::vector<double> few(values_.begin(), values_.end() - 1);
    EXPECT_FALSE(verifier.verify({points_, cells_, {}, few, 0}));
    few = points_;
    few.pop_back();
    EXPECT_FALSE(verifier.verify({few, cells_, {}, values_, 0}));
    const std::vector<std::int64_t> cells(3);
    EXPECT_FALSE(verifier.verify({points_, cells, {}, values_, 0}));
    points_[7] = nan;
    const auto bad = verifier.verify({points_, cells_, {}, values_, 100});
    ASSERT_FALSE(bad);
    EXPECT_NE(bad.error().message().find("point 102"), std::string::npos) << bad.error().message();
}

}  // namespace
}  // namespace barycert::testing
